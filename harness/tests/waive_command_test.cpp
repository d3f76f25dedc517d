// Tests `evalcts waive`, and the entries that --write-baseline writes.
#include <gtest/gtest.h>

#include "drill.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

class Waive : public DrillTest {
 protected:
  Waive() { reduces_failures_ = true; }

  // Judges a library with one failing test.
  Outcome run(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--filter", "Map1Errors.StrideBelowK/MAP1_VERTEX_*_f"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return drill("lenient", arguments);
  }
  Outcome waive(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"waive", "--run", folder_.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return evalcts(all);
  }
  std::string fails() const { return text_of("mine/drill-fails.txt"); }

  const std::string mine_ = (folder_ / "mine").string();
  const std::string test_ = "Map1Errors.StrideBelowK/MAP1_VERTEX_3_f";
};

TEST_F(Waive, ATestIsExpectedAndNoLonger) {
  ASSERT_EQ(run().code, 1);
  for (const auto& [arguments, message] :
       {std::pair(std::vector<std::string>{"StrideBelowK", "--baseline", mine_}, "a waiver needs its reason"),
        {{"StrideBelowK", "--baseline", mine_, "--reason", " "}, "a waiver needs its reason"},
        {{"StrideBelowK", "--reason", "x"}, "--baseline is required"},
        {{"Nothing", "--baseline", mine_, "--reason", "x"},
         "no failing test is called 'Nothing'; these failed"},
        {{"StrideBelowK", "--unwaive", "--baseline", mine_}, "not a directory"},
        {{"MAP1_VERTEX_4_f", "--baseline", mine_, "--reason", "x"}, "no failing test is called"}}) {
    const Outcome wrong = waive(arguments);
    EXPECT_EQ(wrong.code, 2) << wrong.text;
    EXPECT_TRUE(contains(wrong.text, message)) << wrong.text;
    EXPECT_FALSE(fs::exists(mine_));
  }

  const Outcome waived = waive({"StrideBelowK", "--reason", "issue 12", "--baseline", mine_});
  EXPECT_EQ(waived.code, 0) << waived.text;
  EXPECT_TRUE(contains(waived.text, "Waived 1 test: issue 12\n"));
  EXPECT_TRUE(contains(waived.text, "Baseline: " + mine_ + "/drill-fails.txt: 1 entry (1 new, 0 removed)\n"));
  EXPECT_TRUE(contains(fails(), "\n# issue 12\n" + test_ + ",Fail\n")) << fails();
  EXPECT_TRUE(contains(text_of("mine/drill-signatures.txt"), test_ + ",thorough,"));
  EXPECT_EQ(run({"--baseline", mine_}).code, 0);

  EXPECT_EQ(waive({test_, "--reason", "issue 13", "--baseline", mine_ + "/drill"}).code, 0);
  EXPECT_TRUE(contains(fails(), "\n# issue 13\n")) << fails();
  EXPECT_FALSE(contains(fails(), "issue 12"));

  EXPECT_EQ(waive({test_, "--unwaive", "--reason", "x", "--baseline", mine_}).code, 2);
  const Outcome removed = waive({test_, "--unwaive", "--baseline", mine_});
  EXPECT_EQ(removed.code, 0) << removed.text;
  EXPECT_TRUE(contains(removed.text, "drill-fails.txt: 0 entries (0 new, 1 removed)\n"));
  EXPECT_FALSE(contains(text_of("mine/drill-signatures.txt"), test_));
  EXPECT_EQ(run({"--baseline", mine_}).code, 1);
  const Outcome again = waive({test_, "--unwaive", "--baseline", mine_});
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(contains(again.text, "has no entry of a test or bug")) << again.text;
}

TEST_F(Waive, ABugMeansAllItsTests) {
  ASSERT_EQ(run().code, 1);
  const std::string id = results("drill")["bugs"][0]["id"];
  EXPECT_EQ(waive({id, "--reason", "issue 12", "--baseline", mine_}).code, 0);
  EXPECT_TRUE(contains(fails(), "\n# bug: " + id + ".\n# issue 12\n" + test_ + ",Fail\n")) << fails();
  EXPECT_EQ(run({"--baseline", mine_ + "/drill"}).code, 0);
  EXPECT_TRUE(
      contains(evalcts({"explain", id, "--run", folder_.string()}).text, id + ": a bug of drill in "));
  // The entry is found by the bug, without the run.
  fs::remove(folder_ / "results-drill.json");
  EXPECT_EQ(waive({id, "--unwaive", "--baseline", mine_}).code, 0);
  EXPECT_FALSE(contains(fails(), test_));
}

TEST_F(Waive, AWrittenBaselineIsNamedWithBugAndClause) {
  const Outcome outcome = run({"--baseline", mine_, "--write-baseline"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(
      contains(outcome.text, "\nBaseline: " + mine_ + "/drill-fails.txt: 1 entry (1 new, 0 removed)\n"))
      << outcome.text;
  const nlohmann::json bug = results("drill")["bugs"][0];
  const std::string id = bug["id"], clause = bug["clause"];
  EXPECT_TRUE(contains(fails(), "# bug: " + id + ".\n")) << fails();
  EXPECT_TRUE(contains(fails(), "[" + clause.substr(0, 6))) << fails();
  EXPECT_FALSE(contains(fails(), "not traced"));
  const Outcome quiet = run({"--baseline", mine_, "--write-baseline", "--quiet"});
  EXPECT_FALSE(contains(quiet.text, "Baseline: ")) << quiet.text;
}

}  // namespace
}  // namespace evalcts
