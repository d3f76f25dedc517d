// Tests the register of known bugs: its data and versions, and the mistakes that are found in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <evalcts/gl/case_json.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/runner/worker.h>

namespace evalcts {
namespace {

TEST(KnownBugs, AreWhole) {
  EXPECT_GE(known_bugs().size(), 10u);
  EXPECT_EQ(lint(known_bugs()), std::vector<std::string>());
  for (const KnownBug& bug : known_bugs()) {
    if (bug.programs.empty()) continue;
    for (const BugProgram& program : bug.programs)
      EXPECT_NO_THROW(gl::parse_case(program.commands)) << bug.id << ": " << program.name;
    EXPECT_LE(gl::parse_case(bug.programs.front().commands).commands().size(), 20u) << bug.id;
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
      R"({"bugs": [{"id": "a", "title": "t", "affects": {"product": "Mesa", "first": "20.3", "last": "26.2",
      "tested": ["20.3.5", "26.2.6"]},
      "requirements": ["EV-MAP1-COPY"], "clause": "c", "expected": "e", "captured": "x",
      "cause": "c", "real_programs": "r", "verified": "v", "programs": [{"name": "F", "requirement": "EV-MAP1-COPY",
      "difference": "error; ; missing GL_INVALID_VALUE", "commands": [["GetError"]]}],
      "tests": [{"tests": ["A.B*"]}, {"renderer": "softpipe", "status": "Flaky", "tests": ["A.C"]}]}]})");
  EXPECT_EQ(lint(bugs), std::vector<std::string>());
  bugs.push_back(bugs[0]);
  EXPECT_EQ(lint(bugs), (std::vector<std::string>{"a: another bug has the same ID",
                                                  "a: another program has the name 'F', too"}));
  bugs.pop_back();
  bugs[0].clause.clear();
  bugs[0].requirements = {"EV-NO-SUCH"};
  EXPECT_EQ(lint(bugs),
            (std::vector<std::string>{"a: 'clause' is missing", "a: unknown requirement EV-NO-SUCH"}));
  bugs[0].requirements = {"EV-MAP1-COPY"};
  bugs[0].clause = "c";
  bugs[0].programs[0].requirement = "EV-NO-SUCH";
  bugs[0].programs.push_back({});
  bugs[0].tests[1].status = "Sometimes";
  EXPECT_EQ(lint(bugs).size(), 4u)
      << "a requirement, a difference and commands that are missing, and a status";
  bugs[0].tests.clear();
  EXPECT_EQ(lint(bugs).size(), 4u) << "no tests";
  EXPECT_THROW(parse_known_bugs("{"), FormatError);
}

TEST(Differences, HaveRelationsOfNumbersAndErrors) {
  EXPECT_EQ(relation_of(-9.9e-8, -3e-37, 3e-37), "near");
  EXPECT_EQ(relation_of(1002, 999.75, 1000.25), "near");
  EXPECT_EQ(relation_of(0, 0.99983, 1.00017), "far");
  EXPECT_EQ(relation_of(std::nan(""), 0.5, 0.6), "not a number");
  EXPECT_EQ(relation_of_errors("GL_NO_ERROR", "GL_INVALID_VALUE"), "missing GL_INVALID_VALUE");
  EXPECT_EQ(relation_of_errors("GL_INVALID_VALUE", "GL_NO_ERROR"), "spurious GL_INVALID_VALUE");
  EXPECT_EQ(relation_of_errors("GL_INVALID_VALUE", "GL_INVALID_ENUM"),
            "GL_INVALID_VALUE instead of GL_INVALID_ENUM");
}

TEST(Differences, AreAlikeInThePartsThatBothHave) {
  const Difference answer = {Difference::kAnswer, "GetMap GL_COEFF", "far"};
  EXPECT_EQ(answer.text(), "answer; GetMap GL_COEFF; far");
  EXPECT_EQ(parse_difference(answer.text()), answer);
  EXPECT_FALSE(parse_difference("answer; GetMap"));
  EXPECT_TRUE(answer.is_like({Difference::kAnswer, "", ""}));
  EXPECT_FALSE(answer.is_like({Difference::kAnswer, "GetMap GL_ORDER", ""}));
  EXPECT_FALSE(answer.is_like({Difference::kAnswer, "", "near"}));
  EXPECT_FALSE(answer.is_like({Difference::kError, "", ""}));
  EXPECT_EQ((Difference{Difference::kAnswer, "", "far"}.completed_by(answer)), answer);
  // A place without the rule agrees with each rule of its command.
  const Difference stride = {Difference::kError, "Map stride too small", ""},
                   map = {Difference::kError, "Map", ""};
  EXPECT_TRUE(stride.is_like(map) && map.is_like(stride));
  EXPECT_FALSE(stride.is_like({Difference::kError, "Map order below 1", ""}));
  EXPECT_FALSE(stride.is_like({Difference::kError, "MapGrid", ""}));
  EXPECT_EQ(map.completed_by(stride), stride);
}

TEST(Differences, HaveTheKindOfWhatWasCompared) {
  EXPECT_EQ(kind_of("texture coordinate 0.s of vertex 1"), "texture coordinate");
  EXPECT_EQ(kind_of("point 17: position.x of vertex 0"), "position");
  EXPECT_EQ(kind_of("number of vertices"), Difference::kVertices);
  EXPECT_EQ(kind_of("glGetError"), Difference::kError);
  EXPECT_EQ(kind_of("glIsEnabled"), Difference::kAnswer);
  EXPECT_EQ(kind_of("glReadPixels"), "");
}

TEST(KnownBugs, AffectVersionsOfAProduct) {
  const AffectedVersions affected = {
      "Mesa", "20.3", "26.2", "llvmpipe", "", {"20.3.5", "22.3.6", "26.2.6"}, {"20.2.1"}};
  EXPECT_EQ(affected.text(), "Mesa 20.3 to 26.2 with llvmpipe");
  EXPECT_EQ(affected.tested_text(), "20.3.5, 22.3.6 and 26.2.6 have the bug, 20.2.1 does not");
  EXPECT_EQ((AffectedVersions{"NVIDIA", "580", "580", "", "", {"580.1"}, {}}.text()), "NVIDIA 580");
  const auto contains = [&](const std::string& version, const std::string& renderer,
                            const std::string& kind = "osmesa") {
    ImplementationRecord implementation;
    implementation.kind = kind;
    implementation.version = version;
    implementation.renderer = renderer;
    return affected.may_contain(implementation);
  };
  EXPECT_TRUE(contains("4.5 (Compatibility Profile) Mesa 22.3.6", "llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(contains("4.5 Mesa 20.3.0", "llvmpipe"));
  EXPECT_TRUE(contains("4.6 (Compatibility Profile) Mesa 26.2.6-1", "llvmpipe"));
  EXPECT_FALSE(contains("4.5 Mesa 20.2.9", "llvmpipe"));
  EXPECT_TRUE(contains("4.5 Mesa 26.3.0", "llvmpipe"));
  EXPECT_FALSE(contains("4.5 Mesa 22.3.6", "llvmpipe", "library"));
  EXPECT_FALSE(contains("4.5 Mesa 22.3.6", "softpipe"));
  EXPECT_FALSE(contains("4.6.0 NVIDIA 580.159.04", "llvmpipe"));
  EXPECT_FALSE(contains("Mesa", "llvmpipe"));
}

}  // namespace
}  // namespace evalcts
