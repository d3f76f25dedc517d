// Tests changes and their wording, merged shards, and the pages in Markdown.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "comparison.h"
#include "evalcts/reports.h"
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

json outcome(const std::string& name, const std::string& verdict, const json& mismatches = json::array()) {
  return {{"name", name}, {"verdict", verdict}, {"mismatches", mismatches}};
}

json result(const std::string& name, const std::vector<json>& tests) {
  return {{"format", "evalcts-results-1"},      {"status", "complete"}, {"depth", "full"}, {"seed", 1},
          {"implementation", {{"name", name}}}, {"tests", tests}};
}

// Returns the word for the kind of change of one test; empty if nothing has changed.
std::string change(const json& before, const json& now, const json& other_depth = nullptr) {
  json earlier = result("x", {before});
  if (!other_depth.is_null()) earlier["depth"] = other_depth;
  const std::vector<RunResult> old = results_of({earlier}), current = results_of({result("x", {now})});
  const std::vector<Column> a = label_columns(old), b = label_columns(current);
  const Comparisons all = compare(b, a);
  if (all.pairs.size() != 1 || all.pairs[0].changes.size() > 1) return "?";
  return all.pairs[0].changes.empty() ? "" : std::string(text_of(all.pairs[0].changes[0].kind).word);
}

TEST(Comparison, Kinds) {
  const struct {
    const char *before, *now, *kind;
  } cases[] = {{"pass", "pass", ""},
               {"fail", "fail", ""},
               {"not-supported", "not-supported", ""},
               {"pass", "fail", "regression"},
               {"quality-warning", "timeout", "regression"},
               {"not-observable", "fail", "regression"},
               {"fail", "crash", "regression"},
               {"pass", "internal-error", "regression"},
               {"crash", "fail", "fails differently"},
               {"fail", "pass", "fix"},
               {"crash", "quality-warning", "fix"},
               {"fail", "not-observable", "no longer judged"},
               {"pass", "skipped", "no longer judged"},
               {"pass", "quality-warning", "other change"},
               {"not-supported", "pass", "other change"}};
  for (const auto& [before, now, kind] : cases)
    EXPECT_EQ(change(outcome("A.b", before), outcome("A.b", now)), kind) << before << ", " << now;
}

// A known failure does not hide a new one if the same cases were run.
TEST(Comparison, FurtherCasesAreARegression) {
  const json two = outcome("A.b", "fail", {"u=0: x", "u=1: x"}),
             other = outcome("A.b", "fail", {"u=1: x", "u=2: y"}), one = outcome("A.b", "fail", {"u=1: x"});
  EXPECT_EQ(change(two, two), "");
  EXPECT_EQ(change(two, other), "regression");
  EXPECT_EQ(change(two, one), "fails differently");
  EXPECT_EQ(change(two, other, "quick"), "");
  EXPECT_EQ(change(outcome("A.b", "fail"), other), "");  // earlier mismatches were not recorded
  EXPECT_TRUE(contains(changes_of({result("x", {other})}, {result("x", {two})}).text,
                       "A.b (fail, in more cases: u=2: y)"));
}

// A record of very many mismatches has the first ones and the signature of all.
TEST(Comparison, WhatIsBeyondTheRecordedMismatchesIsNoRegression) {
  json before = outcome("A.b", "fail", {"u=0: x", "u=1: x"});
  before["signature_of_all"] = "600-1";
  EXPECT_EQ(change(before, before), "");
  EXPECT_EQ(change(before, outcome("A.b", "fail", {"u=0: x", "u=2: y"})), "fails differently");
  EXPECT_EQ(change(before, outcome("A.b", "fail", {"u=0: x", "u=0: y"})), "regression");
  json other = before;
  other["signature_of_all"] = "600-2";
  EXPECT_EQ(change(before, other), "fails differently");
}

TEST(Comparison, NewAndVanishedTests) {
  const Changes told = changes_of({result("x", {outcome("A.new", "pass"), outcome("A.bad", "fail")})},
                                  {result("x", {outcome("A.gone", "fail")})});
  EXPECT_EQ(told.regressions, 0u);
  EXPECT_EQ(told.text,
            "x since the earlier results: 1 new failing test, 1 new test, 1 vanished test\n"
            "  new failure      A.bad (fail)\n"
            "  new test         A.new (pass)\n"
            "  vanished         A.gone (fail)\n");
}

TEST(Comparison, ByName) {
  const json pass = json::array({outcome("A.b", "pass")}), fail = json::array({outcome("A.b", "fail")});
  // One record on each side: these are compared although their names differ.
  EXPECT_EQ(changes_of({result("new", fail)}, {result("old", pass)}).regressions, 1u);
  json again = result("x", fail);
  again["pass"] = "reuse-context";
  json again_before = again;
  again_before["tests"] = pass;
  const Changes told = changes_of({result("x", pass), again, result("y", pass)},
                                  {again_before, result("x", pass), result("z", pass)});
  EXPECT_EQ(told.regressions, 1u);
  EXPECT_EQ(told.text,
            "x since the earlier results: nothing has changed\n"
            "x, one shared context since the earlier results: 1 regression\n"
            "  regression       A.b (pass, now fail)\n"
            "y: not in the earlier results\n"
            "z: only in the earlier results\n");
}

TEST(Comparison, WhatNoLongerStartsIsARegression) {
  json now = result("x", json::array());
  now["status"] = "not-started";
  now["reason"] = "no such library";
  const Changes told = changes_of({now}, {result("x", {outcome("A.b", "pass")})});
  EXPECT_EQ(told.regressions, 1u);
  EXPECT_EQ(told.text,
            "x since the earlier results: no longer starts\n  It no longer starts: no such library\n");
  EXPECT_EQ(changes_of({now}, {now}).regressions, 0u);
}

TEST(Comparison, SaysWhatMakesItHard) {
  json quick = result("x", json::array()), seed = quick, stopped = quick;
  quick["depth"] = "quick";
  seed["seed"] = 2;
  stopped["status"] = "interrupted";
  const json whole = result("x", json::array());
  EXPECT_TRUE(contains(changes_of({whole}, {quick}).text, "The depths differ: full, before quick."));
  EXPECT_TRUE(contains(changes_of({whole}, {seed}).text, "The seeds differ: 1, before 2."));
  EXPECT_TRUE(contains(changes_of({whole}, {stopped}).text, "The earlier run is not complete."));
  EXPECT_TRUE(contains(changes_of({stopped}, {whole}).text, "The run is not complete."));
}

TEST(Comparison, FitsAScreen) {
  json before = json::array(), now = json::array();
  for (int i = 0; i < 100; ++i) {
    before.push_back(outcome("A." + std::to_string(i), "pass"));
    now.push_back(outcome("A." + std::to_string(i), "fail"));
    now.back()["message"] = std::string(300, 'x');
  }
  const std::string text = changes_of({result("x", now)}, {result("x", before)}).text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 8 + 1);
  EXPECT_TRUE(contains(text, "and 92 more; index.html shows all\n"));
}

// --- shards ------------------------------------------------------------------------------------------------

json shard(int number, int count, const std::vector<json>& tests) {
  json out = result("x", tests);
  out["shard"] = std::to_string(number) + "-of-" + std::to_string(count);
  out["readings"] = {{"C-TEXT", {"shard " + std::to_string(number)}}};
  return out;
}

TEST(Shards, TogetherAreTheWholeRun) {
  json first = shard(1, 2, {outcome("A.1", "pass"), outcome("A.3", "fail"), outcome("A.5", "pass")}),
       second = shard(2, 2, {outcome("A.2", "pass"), outcome("A.4", "crash")});
  first.update({{"started", "2026-11-28T11:27:22Z"}, {"seconds", 2.5}, {"host", "one"}});
  second.update({{"started", "2026-11-28T11:00:00Z"}, {"seconds", 1.5}, {"host", "two"}});
  for (const auto& given : {std::vector<json>{first, second}, {second, first}}) {
    const std::vector<RunResult> merged = merge_of(given);
    ASSERT_EQ(merged.size(), 1u);
    EXPECT_FALSE(merged[0].shard);
    EXPECT_EQ(merged[0].status, RunStatus::kComplete);
    std::string names;
    for (const TestRecord& test : merged[0].tests) names += test.name + " ";
    EXPECT_EQ(names, "A.1 A.2 A.3 A.4 A.5 ");
    EXPECT_EQ(merged[0].counts, (Counts{0, 1, 0, 1, 0, 0, 0, 0, 3}));
    EXPECT_EQ(merged[0].readings.at("C-TEXT"), (std::vector<std::string>{"shard 1", "shard 2"}));
    EXPECT_EQ(merged[0].started, "2026-11-28T11:00:00Z");
    EXPECT_EQ(merged[0].seconds, 4.0);
    EXPECT_EQ(merged[0].host, "one, two");
  }
}

TEST(Shards, FindTheSameBugs) {
  const auto shard = [](int number, json bugs) {
    json record = result("x", {outcome("A." + std::to_string(number), "fail")});
    record["shard"] = fmt::format("{}-of-2", number);
    record["bugs"] = std::move(bugs);
    record["bugs_note"] = number == 1 ? "1 of 2 was not reduced" : "";
    return record;
  };
  const json unreduced = {
      {"id", "EV-A-1"}, {"title", "a"}, {"tests", {"A.1"}}, {"why_not_reduced", "no time"}};
  const json reduced = {{"id", "EV-A-1"},     {"title", "a"},         {"tests", {"A.2"}},
                        {"verdict", "crash"}, {"explains", {"EV-A"}}, {"commands", {{"End"}}}};
  const json other = {{"id", "EV-B-2"}, {"title", "b"}, {"tests", {"A.2"}}, {"verdict", "fail"}};
  const std::vector<RunResult> merged =
      merge_of({shard(1, json::array({unreduced})), shard(2, json::array({reduced, other}))});
  ASSERT_EQ(merged.size(), 1u);
  ASSERT_EQ(merged[0].bugs.size(), 2u);
  const Bug& bug = merged[0].bugs[0];
  EXPECT_EQ(bug.id, "EV-A-1");
  EXPECT_EQ(bug.tests, (std::vector<std::string>{"A.1", "A.2"}));
  EXPECT_EQ(bug.verdict, Verdict::kCrash);
  EXPECT_TRUE(bug.is_reduced());
  EXPECT_EQ(bug.commands, R"([["End"]])");
  EXPECT_EQ(merged[0].bugs_note, "shard 1 of 2: 1 of 2 was not reduced");
}

TEST(Shards, WhatIsMissingIsSaid) {
  const std::vector<RunResult> merged = merge_of({shard(2, 3, {outcome("A.2", "pass")})});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].status, RunStatus::kInterrupted);
  EXPECT_EQ(merged[0].reason, "of 3 shards these are missing: 1, 3");
  json stopped = shard(1, 2, json::array());
  stopped["status"] = "interrupted";
  stopped["reason"] = "a full disk";
  EXPECT_EQ(merge_of({stopped, shard(2, 2, json::array())})[0].reason, "shard 1 of 2: a full disk");
}

TEST(Shards, OnlyOfOneRun) {
  const json one = shard(1, 2, json::array()), two = shard(2, 2, json::array());
  json quick = two, named = two, pass = two;
  quick["depth"] = "quick";
  named["implementation"]["name"] = "y";
  pass["pass"] = "reuse-context";
  for (const json& other : {quick, named, pass, shard(2, 3, json::array()), one, result("x", json::array())})
    EXPECT_EQ(merge_of({one, other}).size(), 2u) << other;
  // Two runs; a shard of one of them is missing.
  json old_one = one, new_one = one, new_two = two;
  old_one["origin"] = "old";
  new_one["origin"] = new_two["origin"] = "new";
  const std::vector<RunResult> merged = merge_of({old_one, new_one, new_two});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].status, RunStatus::kInterrupted);
  EXPECT_EQ(merged[1].status, RunStatus::kComplete);
}

TEST(Shards, OfDifferentLibrariesAreRefused) {
  json one = shard(1, 2, json::array()), two = shard(2, 2, json::array());
  one["implementation"]["version"] = "22.3.6";
  two["implementation"]["version"] = "23.0.0";
  EXPECT_THROW(merge_of({one, two}), FormatError);
}

TEST(Shards, WrongNumbersAreRefused) {
  for (const char* text :
       {"1", "0-of-2", "3-of-2", "1-of-", "-of-2", "1-of-2x", "-1-of-2", "1-of-99999999999", " 1-of-2"}) {
    json wrong = result("x", json::array());
    wrong["shard"] = text;
    EXPECT_THROW(merge_of({wrong}), FormatError) << text;
  }
}

// --- Markdown ----------------------------------------------------------------------------------------------

TEST(Markdown, CountsChangesAndFailures) {
  json fail = outcome("A.b", "fail");
  fail["message"] = "2 of 12 values";
  fail["rerun"] = "./evalcts run --filter A.b";
  EXPECT_EQ(markdown_of({result("x", {fail, outcome("A.c", "pass")}), result("y", {outcome("A.b", "pass")})},
                        {result("x", {outcome("A.b", "pass"), outcome("A.c", "fail")})}),
            R"(## OpenGL evaluators: conformance

| | unexpected | tests | fail | pass |
| --- | --: | --: | --: | --: |
| `x` | **1** | 2 | 1 | 1 |
| `y` | 0 | 1 | 0 | 1 |

* `x`: `1 failure`
* `y`: `No failures`

### Changes

* `x`: 1 regression, 1 fix
  * regression: `A.b`, `pass, now fail: 2 of 12 values`
  * fix: `A.c`, `fail, now pass`
* `y`: not in the earlier results

### Unexpected

* `x`: fail `A.b`: `2 of 12 values`
  * run just this test: `./evalcts run --filter A.b`
)");
}

TEST(Markdown, ListsTheDistinctBugs) {
  const std::string text = markdown_of({read_sample("results-osmesa.json")});
  EXPECT_TRUE(contains(text, R"(
### Bugs

`osmesa`: 4 distinct bugs

| bug | level | verdict | tests | unexpected | requirement | known in | ID |
| --- | --- | --- | --: | --: | --- | --- | --- |
| `EvalMesh2 behind CallList crashes` | must | crash | 1 | 1 | `EV-MESH2-FILL` |  | `EV-MESH2-FILL-1a2b` |
)")) << text;
  EXPECT_TRUE(contains(text, "| must | fail | 1 | 0 | `EV-MAP1-ERR-STRIDE` | `Mesa 21.0 to 22.3` |")) << text;
  EXPECT_TRUE(contains(text, "`1 of 4 failing tests was not reduced: the time for reduction was over`"))
      << text;
  EXPECT_FALSE(contains(markdown_of({read_sample("results-reference.json")}), "### Bugs"));
}

TEST(Markdown, NothingUnexpected) {
  const std::string text = markdown_of({read_sample("results-reference.json")});
  EXPECT_TRUE(contains(text, "\n* `reference`: `No failures`\n")) << text;
  EXPECT_FALSE(contains(text, "### Unexpected"));
  EXPECT_TRUE(contains(markdown_of({}), "No results."));
}

TEST(Markdown, SaysWhatIsNotWhole) {
  const std::string text = markdown_of({read_sample("results-osmesa.json"), read_sample("results-glx.json")});
  EXPECT_TRUE(contains(text, "; not complete: interrupted by SIGINT`\n"));
  EXPECT_TRUE(contains(text, "* `glx`: `Not judged: no X server: DISPLAY is not set`\n"));
}

TEST(Markdown, IsShort) {
  json tests = json::array();
  for (int i = 0; i < 100; ++i) tests.push_back(outcome("A." + std::to_string(i), "fail"));
  const std::string text = markdown_of({result("x", tests)});
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 30);
  EXPECT_TRUE(contains(text, "* `x`: and 90 more\n"));
}

// A test that violates another requirement than its own counts as a failure of that one, and does not decide
// its own.
TEST(Markdown, RequirementsThatAreViolatedElsewhere) {
  json elsewhere = outcome("A.a", "fail");
  elsewhere["requirements"] = {"EV-1", "EV-2"};
  elsewhere["violated"] = {"EV-2", "EV-3"};
  const json catalogue = {{"requirements",
                           {{{"id", "EV-1"}, {"text", "one"}},
                            {{"id", "EV-2"}, {"text", "two"}},
                            {{"id", "EV-3"}, {"text", "three"}}}}};
  const std::string table = table_of({result("x", {elsewhere})}, catalogue);
  EXPECT_FALSE(contains(table, "| `EV-1`"));
  EXPECT_TRUE(contains(table, "| `EV-2`: `two` | **1** of 1 |\n"));
  EXPECT_TRUE(contains(table, "| `EV-3`: `three` | **1** of 1 |\n"));
}

TEST(Markdown, RequirementsByResult) {
  const auto test = [](const std::string& name, const std::string& verdict, const std::string& requirement) {
    json record = outcome(name, verdict);
    record["requirements"] = {requirement};
    return record;
  };
  const json catalogue = {
      {"requirements", {{{"id", "EV-2"}, {"text", "the second"}}, {{"id", "EV-1"}, {"text", "one"}}}}};
  EXPECT_EQ(table_of({result("old", {test("A.a", "fail", "EV-1"), test("A.b", "pass", "EV-1"),
                                     test("A.c", "not-observable", "EV-2"), test("A.d", "pass", "EV-3")}),
                      result("new", {test("A.a", "pass", "EV-1"), test("A.b", "pass", "EV-1"),
                                     test("A.c", "crash", "EV-2"), test("A.d", "quality-warning", "EV-3")})},
                     catalogue),
            R"(# Requirements by implementation

* `old`: `  `, `  `
* `new`: `  `, `  `

## Violated requirements

2 of 3 requirements. Bold: tests that found a violation, of those that decided the requirement. Tests that fail because of another requirement are ignored.

| requirement | `old` | `new` |
| --- | --- | --- |
| `EV-2`: `the second` | not observed | **1** of 1 |
| `EV-1`: `one` | **1** of 2 | pass |

## Tests that do not have the same verdict everywhere

Tests that no implementation fails are left out.

| test | `old` | `new` |
| --- | --- | --- |
| `A.a` | fail | pass |
| `A.c` | not observed | crash |
)");
}

// Removes code spans: text between a run of backticks and the next run of the same length in the same line.
std::string without_code(const std::string& page) {
  const auto run_at = [&](std::size_t at) {
    return std::min(page.find_first_not_of('`', at), page.size()) - at;
  };
  std::string outside;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t run = run_at(at);
    if (run == 0) {
      outside += page[at++];
      continue;
    }
    std::size_t end = at + run;
    while (end < page.size() && page[end] != '\n' && run_at(end) != run)
      end += std::max(run_at(end), std::size_t{1});
    const bool is_span = end < page.size() && page[end] == '`';
    if (!is_span) outside.append(run, '`');
    at = is_span ? end + run : at + run;
  }
  return outside;
}

// Text of a record is in code spans only, and adds no bars to a table.
TEST(Markdown, HostileTextStaysInCode) {
  json record = hostile_record();
  std::string text = "a|b `code` ``two`` @somebody [link](x) <img src=x> \n# heading";
  record["implementation"]["name"] = text;
  record["tests"][0]["name"] = text;
  record["tests"][0]["message"] = "`";
  const std::string page = markdown_of({record}, {record});
  const std::string outside = without_code(page);
  for (const char* part : {"@", "<", "[", "`", "script", "heading", "code"})
    EXPECT_FALSE(contains(outside, part)) << part << "\n" << outside;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("|")) {
      EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 9) << line;
    }
}

}  // namespace
}  // namespace evalcts::reports
