// Tests the register of known bugs: its data, its signs and versions, and the mistakes that are found in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <evalcts/gl/case_json.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/runner/question.h>

namespace evalcts {
namespace {

TEST(KnownBugs, AreWhole) {
  EXPECT_GE(known_bugs().size(), 10u);
  EXPECT_EQ(lint(known_bugs()), std::vector<std::string>());
  for (const KnownBug& bug : known_bugs()) {
    if (bug.program.empty()) continue;
    EXPECT_NO_THROW(gl::parse_case(bug.program)) << bug.id;
    EXPECT_LE(gl::parse_case(bug.program).commands().size(), 20u) << bug.id;
  }
}

// A run does not notice if a pattern stands for no test.
TEST(KnownBugs, ExpectFailuresOfTestsThatExist) {
  const std::vector<ListedTest> all = list_tests(FAULTY_SUITE_PROGRAM);
  for (const KnownBug& bug : known_bugs())
    for (const FailingTests& failing : bug.tests)
      for (const std::string& tests : failing.tests)
        EXPECT_TRUE(
            std::ranges::any_of(all, [&](const ListedTest& test) { return stands_for(tests, test.name); }))
            << bug.id << ": " << tests;
}

TEST(KnownBugs, MistakesAreNamed) {
  std::vector<KnownBug> bugs = parse_known_bugs(
      R"({"bugs": [{"id": "a", "title": "t", "affects": {"product": "Mesa", "first": "20.3", "last": "26.2"},
      "requirements": ["EV-MAP1-COPY"], "clause": "c", "program": [["GetError"]], "expected": "e", "captured": "x",
      "cause": "c", "real_programs": "r", "verified": "v", "signs": [{"cause": "s", "captured": "0"}],
      "findings": [{"name": "F", "requirement": "EV-MAP1-COPY", "what": "w", "program": [["GetError"]]}],
      "tests": [{"tests": ["A.B*"]}, {"renderer": "softpipe", "status": "Flaky", "tests": ["A.C"]}]}]})");
  EXPECT_EQ(lint(bugs), std::vector<std::string>());
  bugs.push_back(bugs[0]);
  EXPECT_EQ(lint(bugs), (std::vector<std::string>{"a: another bug has the same ID",
                                                  "a: another bug has the sign 's: : : 0: ', too",
                                                  "a: another finding has the name 'F', too"}));
  bugs.pop_back();
  bugs[0].clause.clear();
  bugs[0].requirements = {"EV-NO-SUCH"};
  EXPECT_EQ(lint(bugs),
            (std::vector<std::string>{"a: 'clause' is missing", "a: unknown requirement EV-NO-SUCH"}));
  bugs[0].requirements = {"EV-MAP1-COPY"};
  bugs[0].clause = "c";
  bugs[0].crashes = true;
  bugs[0].signs[0].captured = "(";
  bugs[0].tests[1].status = "Sometimes";
  EXPECT_EQ(lint(bugs).size(), 3u)
      << "a crash with signs, a sign that is not a regular expression, and a status";
  bugs[0].tests.clear();
  EXPECT_EQ(lint(bugs).size(), 3u) << "no tests";
  EXPECT_THROW(parse_known_bugs("{"), FormatError);
}

TEST(KnownBugs, HaveSignsWithRelationsOfNumbers) {
  const auto matches = [](const std::string& relation, const std::string& expected,
                          const std::string& captured) {
    Failure failure;
    failure.expected = expected;
    failure.captured = captured;
    return BugSign{"c", "", "", "", relation}.matches("c", failure);
  };
  EXPECT_TRUE(matches("more", "2 vertices", "3 vertices"));
  EXPECT_FALSE(matches("more", "2 vertices", "1 vertices"));
  EXPECT_TRUE(matches("less", "2 LINES of 2 vertices", "1 LINES of 2 vertices"));
  EXPECT_TRUE(matches("near", "[-3.01e-37, 3.01e-37]", "-9.93410723e-08 (-0x1.aaaaaap-24)"));
  EXPECT_TRUE(matches("near", "[999.749964, 1000.25004]", "1002 (0x1.f5p+9)"));
  EXPECT_FALSE(matches("near", "[0.999829975, 1.00017002]", "0 (0x0p+0)"));
  EXPECT_FALSE(matches("near", "[0.5, 0.6]", "-nan (-nan)"));
  EXPECT_TRUE(matches("", "anything", "else"));
}

TEST(KnownBugs, AffectVersionsOfAProduct) {
  const AffectedVersions affected = {"Mesa", "20.3", "26.2", "llvmpipe"};
  EXPECT_EQ(affected.text(), "Mesa 20.3 to 26.2 with llvmpipe");
  EXPECT_EQ((AffectedVersions{"NVIDIA", "580", "580", ""}.text()), "NVIDIA 580");
  const auto contains = [&](const std::string& version, const std::string& renderer) {
    ImplementationRecord implementation;
    implementation.version = version;
    implementation.renderer = renderer;
    return affected.contains(implementation);
  };
  EXPECT_TRUE(contains("4.5 (Compatibility Profile) Mesa 22.3.6", "llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(contains("4.5 Mesa 20.3.0", "llvmpipe"));
  EXPECT_TRUE(contains("4.6 (Compatibility Profile) Mesa 26.2.6-1", "llvmpipe"));
  EXPECT_FALSE(contains("4.5 Mesa 20.2.9", "llvmpipe"));
  EXPECT_FALSE(contains("4.5 Mesa 26.3.0", "llvmpipe"));
  EXPECT_FALSE(contains("4.5 Mesa 22.3.6", "softpipe"));
  EXPECT_FALSE(contains("4.6.0 NVIDIA 580.159.04", "llvmpipe"));
  EXPECT_FALSE(contains("Mesa", "llvmpipe"));
}

}  // namespace
}  // namespace evalcts
