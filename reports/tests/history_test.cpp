// Tests the history of runs: series, order of dates and versions, and its text and HTML.
#include "history/history.h"

#include <gtest/gtest.h>

#include "evalcts/reports.h"
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

PastRun run_of(const std::string& version, const std::string& started, const std::vector<std::string>& bugs,
               const json& more = json::object()) {
  json record = {{"format", "evalcts-results-1"},
                 {"status", "complete"},
                 {"depth", "full"},
                 {"started", started},
                 {"implementation", {{"name", "egl"}, {"version", version}}},
                 {"tests", json::array({{{"name", "A.b"}, {"verdict", bugs.empty() ? "pass" : "fail"}},
                                        {{"name", "A.c"}, {"verdict", "not-observable"}}})}};
  for (const std::string& bug : bugs)
    record["bugs"].push_back({{"id", bug},
                              {"title", "title of " + bug},
                              {"level", "must"},
                              {"verdict", "fail"},
                              {"failure", {{"case", "c"}}},
                              {"tests", {"A.b"}}});
  record.update(more);
  return past_run(results_of({record}).front(), "egl-" + started.substr(0, 10));
}

TEST(History, ComparesWholeRunsOfAnImplementationAndDepth) {
  const json filtered = {{"filter", "A.b"}}, interrupted = {{"status", "interrupted"}},
             quick = {{"depth", "quick"}};
  const std::vector<PastRun> runs = {run_of("4.5 Mesa 22.3.6", "2026-01-03T10:00:00Z", {}),
                                     run_of("4.5 Mesa 9.0", "2026-01-01T10:00:00Z", {"B"}),
                                     run_of("4.5 Mesa 22.3.6", "2026-01-02T10:00:00Z", {"B"}, filtered),
                                     run_of("4.5 Mesa 22.3.6", "2026-01-02T10:00:00Z", {"B"}, interrupted),
                                     run_of("4.5 Mesa 22.3.6", "2026-01-02T10:00:00Z", {"B"}, quick)};
  const std::vector<Series> series = series_of(runs);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].name, "egl, full depth");
  EXPECT_EQ(series[0].left_out, 2u);
  ASSERT_EQ(series[0].by_date.size(), 2u);
  EXPECT_EQ(series[0].by_date[0].run, &runs[1]);
  EXPECT_EQ(series[0].by_date[1].run, &runs[0]);
  EXPECT_EQ(step_in_words(series[0].by_date[1]), "1 gone: B");
  ASSERT_EQ(series[1].by_date.size(), 1u);
  EXPECT_EQ(series[1].by_date[0].run, &runs[4]);
}

TEST(History, VersionsAreComparedInTheirOrder) {
  const std::vector<PastRun> runs = {
      run_of("4.5 Mesa 22.3.6", "2026-01-01T10:00:00Z", {"B", "C"}),
      run_of("4.5 (Compatibility Profile) Mesa 9.0", "2026-01-02T10:00:00Z", {"A"}),
      run_of("4.5 Mesa 9.0", "2026-01-03T10:00:00Z", {"A", "B"})};
  const std::vector<Step> steps = series_of(runs)[0].by_version;
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].run, &runs[2]) << "the last run of the smaller version";
  EXPECT_EQ(step_in_words(steps[0]), "");
  EXPECT_EQ(steps[1].run->version, "Mesa 22.3.6");
  EXPECT_EQ(step_in_words(steps[1]), "1 new bug: C; 1 gone: A");
}

TEST(History, IsATableInTheTerminal) {
  const std::vector<PastRun> runs = {run_of("4.5 Mesa 22.3.6", "2026-01-01T10:00:00Z", {"B"}),
                                     run_of("", "", {"B"}, {{"bugs", json::array()}})};
  const std::string text = history_text(runs, 0);
  EXPECT_TRUE(contains(text, "History of egl, full depth: 2 runs\n")) << text;
  EXPECT_TRUE(
      contains(text,
               "\n  2026-01-01 10:00  Mesa 22.3.6                  1     1     0     0     0            1  "
               "egl-2026-01-01\n"))
      << text;
  EXPECT_TRUE(contains(text, "\n  unknown                                        -     1 ")) << text;
  std::istringstream lines(history_text(runs, 40));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 40u) << line;
}

TEST(History, IsASectionOfThePageWithoutMarkupOfRecords) {
  PageOptions options;
  const json result = read_sample("results-osmesa.json");
  EXPECT_FALSE(contains(html(results_of({result}), {}, options), "id=\"history\""));
  options.history = {run_of(hostile_text(), "2026-01-01T10:00:00Z", {hostile_text()}),
                     run_of("4.5 Mesa 22.3.6", "2026-01-02T10:00:00Z", {})};
  options.history.push_back(past_run(results_of({hostile_record()}).front(), hostile_text()));
  const std::string page = html(results_of({result}), {}, options);
  EXPECT_TRUE(contains(page, "<a href=\"#history\">"));
  EXPECT_TRUE(contains(page, "Bugs: 1 to 0"));
  EXPECT_TRUE(contains(page, "<polyline points=\"8.0,24.0 312.0,102.0 \""))
      << page.substr(page.find("<polyline"), 99);
  EXPECT_FALSE(contains(page, "<script>alert"));
  EXPECT_FALSE(contains(page, "\x1b"));
}

}  // namespace
}  // namespace evalcts::reports
