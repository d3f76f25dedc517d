// Tests the tests that declarations make: their names, order, requirements and depths.
#include <evalcts/testkit/registration.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace evalcts {
namespace {

struct Size {
  std::string name;
  int value;
};
const std::vector<Size> kSizes = {{"small", 1}, {"large", 9}};
const std::vector<GLenum> kTargets = {GL_MAP1_INDEX, GL_MAP1_NORMAL, GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4};
std::string run_so_far;

EVALCTS_TEST(Sample, Plain, kQuality, "EV-A", "EV-B/1-D")(Test&) { run_so_far += "plain "; };
EVALCTS_TEST(Sample, Sizes, kMust, "EV-A",
             combine(kTargets).combine(kSizes).filter([](GLenum target, const Size& size) {
               return target == GL_MAP1_NORMAL || size.value == 9;
             }))
(Test&, GLenum, const Size& size) { run_so_far += size.name + " "; };
EVALCTS_TEST(Sample, Expanded, kMust, "EV-A", combine(kSizes).expand([](const Size& size) {
  return std::vector<Size>{{"again", size.value + 1}};
}))
(Test&, const Size&, const Size& more) { run_so_far += std::to_string(more.value) + " "; };
EVALCTS_LIFTED_SUITE(Curves, Surfaces);
EVALCTS_TEST(Curves, Delivered, kMust, "EV-MAP1-BEZIER", "EV-A", "EV-B/1-D",
             combine(std::vector<GLenum>{GL_MAP1_INDEX}).by(gl::curve_deliveries()))
(Test&, GLenum){};

std::vector<TestInfo> named(const std::string& start) {
  std::vector<TestInfo> found;
  for (const TestInfo& info : all_tests())
    if (info.full_name().starts_with("Sample." + start)) found.push_back(info);
  return found;
}

std::vector<std::string> names_of(const std::vector<TestInfo>& tests) {
  std::vector<std::string> names;
  for (const TestInfo& info : tests) names.push_back(info.name);
  return names;
}

std::string names_run(const std::vector<TestInfo>& tests) {
  run_so_far.clear();
  Subject subject;
  for (const TestInfo& info : tests) {
    TestRecord record;
    Test test(subject, record);
    info.body(test);
  }
  return run_so_far;
}

TEST(Registration, OfATestWithoutParameters) {
  const std::vector<TestInfo> plain = named("Plain");
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_EQ(plain[0].requirements, (std::vector<RequirementId>{"EV-A", "EV-B/1-D"}));
  EXPECT_EQ(plain[0].level, Level::kQuality);
  EXPECT_EQ(plain[0].from, Depth::kQuick);
  EXPECT_EQ(names_run(plain), "plain ");
}

TEST(Registration, CombinesAndFilters) {
  const std::vector<TestInfo> sizes = named("Sizes");
  EXPECT_EQ(names_of(sizes), (std::vector<std::string>{"Sizes/MAP1_INDEX/large", "Sizes/MAP1_NORMAL/large",
                                                       "Sizes/MAP1_NORMAL/small", "Sizes/MAP1_VERTEX_3/large",
                                                       "Sizes/MAP1_VERTEX_4/large"}));
  EXPECT_EQ(names_run(sizes), "large large small large large ");
  // The suite has no other tests with these pairs of parameters.
  EXPECT_EQ(std::ranges::count(sizes, Depth::kQuick, &TestInfo::from), 5);
}

TEST(Registration, ExpandsEachCombination) {
  const std::vector<TestInfo> expanded = named("Expanded");
  EXPECT_EQ(names_of(expanded), (std::vector<std::string>{"Expanded/large/again", "Expanded/small/again"}));
  EXPECT_EQ(names_run(expanded), "10 2 ");
}

TEST(Registration, OneTestForEachDelivery) {
  const std::vector<gl::Delivery>& deliveries = gl::curve_deliveries();
  const std::vector<TestInfo>& tests = all_tests();
  for (const gl::Delivery& delivery : deliveries) {
    const std::string name =
        (delivery.lifted ? "Surfaces.Delivered/MAP2_INDEX/" : "Curves.Delivered/MAP1_INDEX/") + delivery.name;
    const auto found = std::ranges::find(tests, name, &TestInfo::full_name);
    ASSERT_NE(found, tests.end()) << name;
    std::vector<RequirementId> requirements = found->requirements;
    if (delivery.lists != gl::Lists::kNone) requirements.pop_back();
    EXPECT_EQ(texts_of(requirements), delivery.lifted
                                          ? (std::vector<std::string>{"EV-MAP2-BEZIER", "EV-B/2-D"})
                                          : (std::vector<std::string>{"EV-MAP1-BEZIER", "EV-A", "EV-B/1-D"}))
        << name;
    if (delivery.is_plain()) {
      EXPECT_EQ(found->from, Depth::kQuick) << name;
    }
  }
}

}  // namespace
}  // namespace evalcts
