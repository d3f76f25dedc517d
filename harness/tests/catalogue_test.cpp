#include "harness/cli/catalogue.h"

#include <gtest/gtest.h>

#include "harness/cli/wrap.h"

namespace evalcts {
namespace {

using nlohmann::json;

json requirements(json more = json::object()) {
  json first = {{"id", "A"}, {"section", "1"}};
  first.update(more);
  return {{"requirements", {first, {{"id", "B"}, {"section", "1"}}}}};
}

json tests(std::vector<std::string> decided) {
  return {{"tests", {{{"name", "T.t"}, {"requirements", decided}}}}};
}

TEST(Coverage, StatesOfARequirement) {
  EXPECT_EQ(coverage_of(requirements(), tests({"A"}))[0].state, "decided");
  EXPECT_EQ(coverage_of(requirements(), tests({"A/1-D", "A/2-D"}))[0].state, "decided");
  const Coverage half = coverage_of(requirements(), tests({"A/2-D"}))[0];
  EXPECT_EQ(half.state, "in part");
  EXPECT_EQ(half.lacks, "1-D");
  EXPECT_EQ(half.tests, std::vector<std::string>{"T.t"});
  EXPECT_EQ(coverage_of(requirements(), tests({"A"}))[1].state, "undecided");
}

TEST(Coverage, UndecidableWithReason) {
  const json whole = requirements({{"undecidable", "nobody can see it"}});
  const Coverage entry = coverage_of(whole, tests({"B"}))[0];
  EXPECT_EQ(entry.state, "undecidable");
  EXPECT_EQ(entry.reason, "nobody can see it");
  const json half = requirements({{"undecidable", {{"2-D", "too dark"}}}});
  EXPECT_EQ(coverage_of(half, tests({"A/1-D"}))[0].state, "in part");
  EXPECT_EQ(coverage_of(half, tests({"A/1-D"}))[0].reason, "too dark");
  EXPECT_EQ(coverage_of(half, tests({"B"}))[0].state, "undecided");
}

TEST(Coverage, LintOfUndecidable) {
  const json whole = requirements({{"undecidable", "nobody can see it"}});
  EXPECT_TRUE(lint(whole, tests({"B"})).empty());
  EXPECT_EQ(lint(whole, tests({"A"})).size(), 2u);
  EXPECT_EQ(lint(whole, tests({"A/1-D"})),
            std::vector<std::string>{"A/1-D is undecidable, but T.t decides it"});
  const json half = requirements({{"undecidable", {{"2-D", "too dark"}}}});
  EXPECT_TRUE(lint(half, tests({"A/1-D"})).empty());
  EXPECT_EQ(lint(half, tests({"A/2-D"})).size(), 1u);
  EXPECT_EQ(lint(requirements({{"undecidable", {{"3-D", "too dark"}}}}), tests({"B"})).size(), 1u);
  EXPECT_EQ(lint(requirements({{"undecidable", {{"1-D", ""}}}}), tests({"B"})).size(), 1u);
}

TEST(Wrap, BreaksBetweenWords) {
  EXPECT_EQ(cli::wrapped("one two three", 7, "  "), "one two\n  three");
  EXPECT_EQ(cli::wrapped("one two three", 8, "  ", 4), "one\n  two\n  three");
  EXPECT_EQ(cli::wrapped("abcdefghij klm", 5, "  "), "abcdefghij\n  klm");
  EXPECT_EQ(cli::wrapped("§§§ §§§", 7, ""), "§§§ §§§");
  EXPECT_EQ(cli::wrapped("", 10, "  "), "");
}

}  // namespace
}  // namespace evalcts
