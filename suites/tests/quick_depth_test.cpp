// Tests that quick depth covers all pairs of parameters and of orders.
#include <evalcts/testkit/registration.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/capture/capture.h>
#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

using Texts = std::set<std::string>;

Texts without(const Texts& all, const Texts& some) {
  Texts left;
  std::ranges::set_difference(all, some, std::inserter(left, left.end()));
  return left;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts;
}

// Returns the values, the pairs of values, and the parts of deliveries of the tests of this depth, each with
// its suite.
Texts combined_at(Depth depth) {
  Texts all;
  for (const TestInfo& info : all_tests()) {
    if (info.from > depth) continue;
    const std::vector<std::string> values = split(info.parameters);
    const auto add = [&](const std::string& combined) {
      all.insert(info.suite + ": " + combined);
      if (!info.uses_lists) all.insert(info.suite + ": " + combined + " without lists");
    };
    for (std::size_t i = 0; i < values.size(); ++i) {
      add(values[i]);
      for (std::size_t k = 0; k < i; ++k) add(values[k] + " and " + values[i]);
    }
    for (const std::string& part : split(info.delivery)) all.insert(info.suite + ": " + part);
  }
  return all;
}

TEST(QuickDepth, HasEachPairOfParametersThatFullDepthHas) {
  const Texts full = combined_at(Depth::kFull);
  EXPECT_GT(full.size(), 900u);
  EXPECT_EQ(without(full, combined_at(Depth::kQuick)), Texts());
}

TEST(QuickDepth, HasATestOfEachName) {
  std::map<std::string, bool> has_quick;
  for (const TestInfo& info : all_tests()) {
    bool& quick = has_quick[info.suite + "." + split(info.name).front()];
    quick = quick || info.from == Depth::kQuick;
  }
  for (const auto& [name, quick] : has_quick) EXPECT_TRUE(quick) << name;
}

// Returns "1 < 3 and more" and so on for the orders of a surface.
std::string class_of(std::int64_t uorder, std::int64_t vorder) {
  const auto text = [](std::int64_t order) { return order < 3 ? std::to_string(order) : "3 and more"; };
  const char* relation = uorder < vorder ? "<" : uorder > vorder ? ">" : "=";
  return fmt::format("{} {} {}", text(uorder), relation, text(vorder));
}

// Adds the class of the orders of each enabled surface at each evaluation of the case, for example
// "MAP2_NORMAL: 1 < 2", and that of the vertex map as "AUTO_NORMAL: 1 < 2" if AUTO_NORMAL is enabled.
void add_orders(const gl::Case& c, Texts& seen) {
  std::map<GLenum, std::string> classes;
  std::set<GLenum> enabled;
  for (const gl::Command& command : c.commands()) {
    const auto integer = [&](std::size_t i) { return std::get<std::int64_t>(command.arguments.at(i)); };
    const std::string_view name = gl::name_of(command.entry);
    if (name == "glMap2f" || name == "glMap2d") {
      classes[static_cast<GLenum>(integer(0))] = class_of(integer(4), integer(8));
    } else if (name == "glEnable") {
      enabled.insert(static_cast<GLenum>(integer(0)));
    } else if (name == "glDisable") {
      enabled.erase(static_cast<GLenum>(integer(0)));
    } else if (name.starts_with("glEvalCoord2") || name == "glEvalPoint2" || name == "glEvalMesh2") {
      for (const auto& [target, orders] : classes) {
        if (!enabled.contains(target)) continue;
        seen.insert(parameter_name(target, 2) + ": " + orders);
        if (enabled.contains(GL_AUTO_NORMAL) && target >= GL_MAP2_VERTEX_3)
          seen.insert("AUTO_NORMAL: " + orders);
      }
    }
  }
}

TEST(QuickDepth, HasEachPairOfOrdersForValuesAndNormals) {
  Texts expected;
  for (const char* map :
       {"MAP2_VERTEX_3", "MAP2_VERTEX_4", "MAP2_COLOR_4", "MAP2_NORMAL", "MAP2_TEXTURE_COORD_1",
        "MAP2_TEXTURE_COORD_2", "MAP2_TEXTURE_COORD_3", "MAP2_TEXTURE_COORD_4", "AUTO_NORMAL"})
    for (int uorder = 1; uorder <= 4; ++uorder)
      for (int vorder = 1; vorder <= 4; ++vorder)
        expected.insert(fmt::format("{}: {}", map, class_of(uorder, vorder)));
  ASSERT_EQ(expected.size(), 9u * 11);

  const std::unique_ptr<Implementation> production = open_implementation({.name = "production"});
  Subject subject;
  subject.implementation = production.get();
  subject.info = inquire(*production);
  subject.depth = Depth::kQuick;
  Captures captures(*production, subject.info, nullptr);
  subject.captures = &captures;
  Texts seen;
  subject.before_case = [&](const gl::Case& c) { add_orders(c, seen); };
  for (const TestInfo& info : all_tests()) {
    if (info.from != Depth::kQuick || (info.suite != "Map2Values" && info.suite != "AutomaticNormals"))
      continue;
    TestRecord record;
    record.name = info.full_name();
    record.requirements = info.requirements;
    record.level = info.level;
    evalcts::Test(subject, record).run(info.body);
    if (record.verdict == Verdict::kNotObservable || record.verdict == Verdict::kNotSupported) continue;
    EXPECT_EQ(record.verdict, Verdict::kPass) << record.name << ": " << record.message;
  }
  EXPECT_EQ(without(expected, seen), Texts());
}

}  // namespace
}  // namespace evalcts
