// Tests the reading of result records, and the properties that are derived from them.
#include <evalcts/results/run_result.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <evalcts/results/conclusion.h>
#include "evalcts/reports.h"
#include "samples.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

json record_of(const json& test) { return {{"tests", {test}}}; }

// Returns the message of the FormatError, or "accepted".
std::string refusal(const json& value) {
  try {
    read_run_result(value);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RunResult, ReadsEveryField) {
  const RunResult record = read_run_result(read_sample("results-osmesa.json"));
  EXPECT_EQ(record.evalcts_version, "0.1.0");
  EXPECT_EQ(record.status, RunStatus::kInterrupted);
  EXPECT_EQ(record.reason, "interrupted by SIGINT");
  EXPECT_EQ(record.command, "evalcts run --implementation osmesa --depth quick");
  EXPECT_EQ(record.started, "2026-11-28T11:27:22Z");
  EXPECT_EQ(record.seconds, 167.4);
  EXPECT_EQ(record.host, "a-host");
  EXPECT_EQ(record.depth, Depth::kQuick);
  const ImplementationRecord& implementation = record.implementation;
  EXPECT_EQ(implementation.name, "osmesa");
  EXPECT_EQ(implementation.library, "libOSMesa.so.8");
  EXPECT_EQ(implementation.vendor, "Mesa");
  EXPECT_EQ(implementation.renderer, "llvmpipe (LLVM 15.0.6, 256 bits)");
  EXPECT_EQ(implementation.version, "4.5 (Compatibility Profile) Mesa 22.3.6");
  EXPECT_EQ(implementation.machine, "x86_64 Linux");
  EXPECT_EQ(implementation.max_eval_order, 30);
  ASSERT_EQ(implementation.captures.size(), 3u);
  EXPECT_TRUE(implementation.captures[0].available);
  EXPECT_FALSE(implementation.captures[2].available);
  EXPECT_EQ(implementation.captures[2].reason, "not in this process");

  ASSERT_EQ(record.tests.size(), 11u);
  const TestRecord& test = record.tests[1];
  EXPECT_EQ(test.name, "Map1Values.Bezier/TEXTURE_COORD_1/d");
  EXPECT_EQ(test.requirements, (std::vector<RequirementId>{"EV-MAP1-BEZIER", "EV-MAP1-DOMAIN"}));
  EXPECT_EQ(test.source, "suites/map_values.cpp:34");
  EXPECT_EQ(test.level, Level::kMust);
  EXPECT_EQ(test.verdict, Verdict::kFail);
  EXPECT_EQ(test.cases, 12u);
  EXPECT_EQ(test.failed_cases, 2u);
  EXPECT_EQ(test.seed, 1u);
  EXPECT_EQ(test.seconds, 0.02);
  ASSERT_EQ(test.failures.size(), 2u);
  const Failure& failure = test.failures[0];
  EXPECT_EQ(failure.case_identity, "order=4 u=0x1p-1");
  EXPECT_EQ(failure.what, "texcoord[0].s of vertex 3");
  EXPECT_EQ(failure.expected, "[0.25, 0.2501] exact 0.25005 (0x1.000d1cp-2)");
  EXPECT_EQ(failure.captured, "0.3 (0x1.333334p-2)");
  EXPECT_EQ(failure.exact, "5001/20000");
  EXPECT_EQ(failure.ulp, 1676000.0);
  EXPECT_EQ(failure.condition_aware, 838000.0);
  EXPECT_EQ(failure.capture, "FeedbackBuffer");
  EXPECT_EQ(failure.calls.size(), 6u);
  ASSERT_TRUE(failure.plot);
  EXPECT_TRUE(failure.plot->is_cut);
  ASSERT_EQ(failure.plot->captured.size(), 1u);
  EXPECT_EQ(failure.plot->captured[0].mode, "GL_LINE_STRIP");
  ASSERT_EQ(failure.plot->captured[0].positions.size(), 4u);
  EXPECT_EQ(failure.plot->captured[0].positions[1], (std::array<float, 3>{0.5f, 0.25f, 0}));
  EXPECT_TRUE(std::isnan(failure.plot->captured[0].positions[2][0]));
  ASSERT_TRUE(test.failures[1].plot);
  EXPECT_EQ(
      test.failures[1].plot->pixels,
      (std::vector<PlottedPixels>{{10, 20, 2, 2, "000000ffffff808080ff0000", "000000ffffff82808000ff00"},
                                  {14, 20, 1, 1, "ffffff", "000000"}}));
  ASSERT_TRUE(test.accuracy);
  EXPECT_EQ(test.accuracy->values, 12u);
  EXPECT_EQ(test.accuracy->not_correctly_rounded, 2u);
  EXPECT_EQ(test.accuracy->ulp.error, 1676000.0);
  EXPECT_EQ(test.accuracy->condition_aware.error, 838000.0);
  EXPECT_EQ(test.accuracy->ulp.where, "order=4 u=0x1p-1");
}

TEST(RunResult, ReadsEveryFieldOfBugs) {
  const RunResult record = read_run_result(read_sample("results-osmesa.json"));
  ASSERT_EQ(record.bugs.size(), 4u);
  EXPECT_EQ(record.bugs_note, "1 of 4 failing tests was not reduced: the time for reduction was over");
  const Bug& bug = record.bugs[0];
  EXPECT_EQ(bug.id, "EV-MESH2-FILL-1a2b");
  EXPECT_EQ(bug.title, "EvalMesh2 behind CallList crashes");
  EXPECT_EQ(bug.cause, "crash: CallList, EvalMesh");
  EXPECT_EQ(bug.requirements, std::vector<RequirementId>{"EV-MESH2-FILL"});
  EXPECT_EQ(bug.clause, "GL 1.0 §5.1");
  EXPECT_EQ(bug.level, Level::kMust);
  EXPECT_EQ(bug.verdict, Verdict::kCrash);
  EXPECT_EQ(bug.failure.captured, "signal 11 (SIGSEGV, Segmentation fault)");
  EXPECT_EQ(bug.failure.calls.size(), 4u);
  EXPECT_EQ(bug.commands,
            R"([["NewList",1,"GL_COMPILE"],["CallList",2],["EvalMesh2","GL_FILL",0,1,0,1],["EndList"]])");
  EXPECT_TRUE(bug.outside_evaluators);
  EXPECT_TRUE(bug.is_reduced());
  EXPECT_EQ(bug.tests, std::vector<std::string>{"Map2Output.FillOrder"});
  EXPECT_EQ(bug.explains, std::vector<RequirementId>{"EV-MESH2-FILL"});
  EXPECT_FALSE(record.bugs[1].is_reduced());
  EXPECT_EQ(record.bugs[1].commands, "");
  EXPECT_EQ(record.bugs[3].known, "mesa-stride-not-checked");
  EXPECT_EQ(record.bugs[3].known_in, "Mesa 21.0 to 22.3");
  EXPECT_EQ(record.bug_of("Map2Output.HugeGrid"), &record.bugs[1]);
  EXPECT_EQ(record.bug_of("AutoNormal.Reversed"), nullptr);
}

TEST(RunResult, BugsAreSortedByImportance) {
  const auto bug = [](const char* id, Level level, Verdict verdict, std::size_t tests, bool breaks = false) {
    Bug made;
    made.id = id;
    made.level = level;
    made.verdict = verdict;
    made.tests.assign(tests, "A.b");
    made.breaks_real_programs = breaks;
    return made;
  };
  std::vector<Bug> bugs = {bug("quality", Level::kQuality, Verdict::kQualityWarning, 9),
                           bug("interpretation", Level::kInterpretation, Verdict::kCrash, 9),
                           bug("b", Level::kMust, Verdict::kFail, 2),
                           bug("a", Level::kMust, Verdict::kFail, 2),
                           bug("many", Level::kMust, Verdict::kFail, 3),
                           bug("hang", Level::kMust, Verdict::kTimeout, 1),
                           bug("crash", Level::kMust, Verdict::kCrash, 1),
                           bug("real", Level::kQuality, Verdict::kFail, 1, true)};
  sort_by_importance(bugs);
  std::string order;
  for (const Bug& each : bugs) order += each.id + " ";
  EXPECT_EQ(order, "real crash hang many a b interpretation quality ");
}

TEST(RunResult, CountsEveryVerdict) {
  const RunResult record = read_run_result(read_sample("results-osmesa.json"));
  EXPECT_EQ(record.counts, (Counts{1, 1, 1, 2, 1, 1, 1, 1, 2}));
  EXPECT_EQ(record.total(), 11u);
  EXPECT_EQ(record.expected_failure_count(), 1u);
  // internal-error, crash, timeout, one fail, and a pass that contradicts its baseline entry
  EXPECT_EQ(record.unexpected_count(), 5u);
}

// The line has a problem exactly if the exit code is not 0, and names each.
TEST(Conclusion, SaysWhatIsWrong) {
  const json pass = {{"name", "A.pass"}, {"verdict", "pass"}},
             fail = {{"name", "A.fail"}, {"verdict", "fail"}},
             known = {{"name", "A.known"}, {"verdict", "fail"}, {"expected_by_baseline", true}},
             fixed = {{"name", "A.fixed"}, {"verdict", "pass"}, {"baseline_reason", "was wrong"}},
             crash = {{"name", "A.crash"}, {"verdict", "crash"}},
             error = {{"name", "A.error"}, {"verdict", "internal-error"}},
             hidden = {{"name", "A.hidden"}, {"verdict", "not-observable"}};
  const auto of = [](const std::vector<json>& tests, json record = json::object()) {
    record["tests"] = tests;
    if (!record.contains("status")) record["status"] = "complete";
    const Conclusion conclusion = conclusion_of(read_run_result(record));
    return fmt::format("{}: {}", conclusion.problems.empty() ? "good" : "bad", conclusion.text);
  };
  const json mesa = {{"baseline", "mesa"}};
  json strict = mesa, stale = mesa;
  strict["strict"] = true;
  stale["stale_baseline_entries"] = {"A.1", "A.2", "A.3", "A.4", "A.5", "A.6", "A.7"};
  EXPECT_EQ(of({pass}), "good: No failures");
  EXPECT_EQ(of({pass, known}, mesa), "good: No new failures; 1 known (baseline mesa)");
  EXPECT_EQ(of({fail}), "bad: 1 failure");
  EXPECT_EQ(of({crash, fail, known}, mesa), "bad: 2 new failures; 1 known (baseline mesa)");
  EXPECT_EQ(of({error, fail}, mesa), "bad: 1 internal error; 1 new failure");
  EXPECT_EQ(of({fixed, known}, mesa),
            "good: No new failures; 1 known (baseline mesa); 1 unexpected pass: A.fixed");
  EXPECT_EQ(of({fixed, known}, strict),
            "bad: 1 unexpected pass (--strict): A.fixed; 1 known (baseline mesa)");
  EXPECT_EQ(of({pass}, stale),
            "good: No failures; 7 stale baseline entries: A.1, A.2, A.3, A.4, A.5 and 2 more");
  stale["stale_baseline_entries"] = {"A.1"};
  stale["strict"] = true;
  EXPECT_EQ(of({known}, stale), "bad: 1 stale baseline entry (--strict): A.1; 1 known (baseline mesa)");
  EXPECT_EQ(of({hidden}), "good: No failures; only 0 of 1 tests could be observed");
  EXPECT_EQ(of({pass}, {{"status", "interrupted"}, {"reason", "SIGINT"}}),
            "good: No failures so far; not complete: SIGINT");
  EXPECT_EQ(of({}, {{"status", "not-started"}, {"reason", "cannot load x.so"}}),
            "good: Not judged: cannot load x.so");
}

TEST(RunResult, UnexpectedIsWhatTheBaselineDoesNotExpect) {
  const auto unexpected = [](const char* verdict, bool expected, const char* reason) {
    const json test{{"verdict", verdict}, {"expected_by_baseline", expected}, {"baseline_reason", reason}};
    return read_run_result(record_of(test)).tests[0].is_unexpected();
  };
  EXPECT_FALSE(unexpected("pass", false, ""));
  EXPECT_FALSE(unexpected("pass", true, "fails now and then"));
  EXPECT_TRUE(unexpected("pass", false, "known to fail"));
  EXPECT_TRUE(unexpected("fail", false, ""));
  EXPECT_TRUE(unexpected("fail", false, "known to fail in other cases"));
  EXPECT_FALSE(unexpected("fail", true, "known to fail"));
  EXPECT_FALSE(unexpected("quality-warning", false, ""));
  EXPECT_FALSE(unexpected("not-observable", false, ""));
}

TEST(RunResult, EvidenceOfATestWithoutFailuresIsItsFailure) {
  const RunResult record = read_run_result(read_sample("results-osmesa.json"));
  const TestRecord& test = record.tests[2];
  ASSERT_EQ(test.failures.size(), 1u);
  EXPECT_EQ(test.failures[0].expected, "GL_INVALID_VALUE");
  EXPECT_EQ(test.failures[0].captured, "GL_NO_ERROR");
  EXPECT_TRUE(record.tests[0].failures.empty());
  EXPECT_TRUE(read_run_result(record_of({{"name", "A.b"}, {"verdict", "pass"}, {"expected", "1"}}))
                  .tests[0]
                  .failures.empty());
}

TEST(RunResult, MissingAndNullFieldsAreTolerated) {
  for (const json& value :
       {json::object(), json{{"status", nullptr}, {"tests", nullptr}, {"implementation", nullptr}}}) {
    const RunResult record = read_run_result(value);
    EXPECT_EQ(record.total(), 0u);
    EXPECT_FALSE(record.is_complete());
  }
  const RunResult record = read_run_result(
      record_of({{"name", "A.b"}, {"verdict", "fail"}, {"ulp", nullptr}, {"failures", {json::object()}}}));
  EXPECT_EQ(record.tests[0].failures.size(), 1u);
  EXPECT_FALSE(record.tests[0].failures[0].ulp);
}

TEST(RunResult, ATestWithoutAVerdictIsNoPass) {
  const RunResult record = read_run_result(record_of({{"message", "lost"}}));
  EXPECT_EQ(record.tests[0].verdict, Verdict::kInternalError);
  EXPECT_EQ(record.tests[0].name, "(unnamed tests[0])");
  EXPECT_EQ(record.tests[0].message, "the record holds no verdict for this test: lost");
}

TEST(RunResult, UnknownFieldsAreIgnored) { EXPECT_EQ(refusal({{"later", {{"x", 1}}}}), "accepted"); }

TEST(RunResult, WrongTypesAreRefusedByName) {
  EXPECT_EQ(refusal(json::array()), "the record: expected an object, found an array");
  EXPECT_EQ(refusal({{"status", 1}}), "status: expected a string, found a number");
  EXPECT_EQ(refusal({{"implementation", "osmesa"}}), "implementation: expected an object, found a string");
  EXPECT_EQ(refusal({{"implementation", {{"max_eval_order", 30.5}}}}),
            "implementation.max_eval_order: expected an integer, found a number");
  EXPECT_EQ(refusal({{"implementation", {{"captures", {{{"available", "yes"}}}}}}}),
            "implementation.captures[0].available: expected a boolean, found a string");
  EXPECT_EQ(refusal({{"tests", json::object()}}), "tests: expected an array, found an object");
  EXPECT_EQ(refusal({{"tests", {1}}}), "tests[0]: expected an object, found a number");
  EXPECT_EQ(refusal(record_of({{"ulp", "1"}})), "tests[0].ulp: expected a number, found a string");
  EXPECT_EQ(refusal(record_of({{"cases", -1}})),
            "tests[0].cases: expected a non-negative integer, found a number");
  EXPECT_EQ(refusal(record_of({{"requirements", "EV-A"}})),
            "tests[0].requirements: expected an array, found a string");
  EXPECT_EQ(refusal(record_of({{"requirements", {"EV-A", 2}}})),
            "tests[0].requirements[1]: expected a string, found a number");
  EXPECT_EQ(refusal(record_of({{"failures", {{{"calls", {true}}}}}})),
            "tests[0].failures[0].calls[0]: expected a string, found a boolean");
  EXPECT_EQ(refusal(record_of({{"accuracy", {{"values", "9"}}}})),
            "tests[0].accuracy.values: expected a non-negative integer, found a string");
  EXPECT_EQ(refusal({{"bugs", {{{"tests", {1}}}}}}), "bugs[0].tests[0]: expected a string, found a number");
  EXPECT_EQ(refusal({{"bugs", {{{"failure", "none"}}}}}),
            "bugs[0].failure: expected an object, found a string");
  EXPECT_EQ(refusal({{"summary", {{"pass", "3"}}}}),
            "summary.pass: expected a non-negative integer, found a string");
}

TEST(RunResult, UnknownWordsAreRefused) {
  EXPECT_EQ(refusal({{"format", "evalcts-results-2"}}), "format: unknown word \"evalcts-results-2\"");
  EXPECT_EQ(refusal({{"status", "done"}}), "status: unknown word \"done\"");
  EXPECT_EQ(refusal(record_of({{"level", "should"}})), "tests[0].level: unknown word \"should\"");
  EXPECT_EQ(refusal(record_of({{"verdict", "passed"}})), "tests[0].verdict: unknown word \"passed\"");
  EXPECT_EQ(refusal({{"summary", {{"passed", 1}}}}), "summary: unknown verdict \"passed\"");
}

TEST(RunResult, ATestStandsOnce) {
  EXPECT_EQ(refusal({{"tests", {{{"name", "A.b"}}, {{"name", "A.b"}}}}}),
            "tests[1].name: \"A.b\" occurs twice in this record");
}

TEST(RunResult, VeryManyMismatchesAreShortened) {
  TestRecord all;
  for (std::size_t i = 0; i <= kMostMismatches; ++i) all.mismatches.push_back(std::to_string(i));
  const std::string signature = all.signature();
  TestRecord shortened = all;
  shortened.shorten_mismatches();
  EXPECT_EQ(shortened.mismatches.size(), kMostMismatches);
  EXPECT_TRUE(std::ranges::is_sorted(shortened.mismatches));
  EXPECT_EQ(shortened.signature(), signature);
  all.mismatches.pop_back();
  all.shorten_mismatches();
  EXPECT_EQ(all.mismatches.size(), kMostMismatches);
  EXPECT_TRUE(all.signature_of_all.empty());
}

TEST(RunResult, SummaryCountsOnlyWithoutTests) {
  const RunResult summary_only = read_run_result({{"summary", {{"pass", 3}, {"fail", 2}}}});
  EXPECT_EQ(summary_only.total(), 5u);
  EXPECT_EQ(summary_only.unexpected_count(), 2u);
  const RunResult both = read_run_result({{"summary", {{"pass", 3}}}, {"tests", json::array()}});
  EXPECT_EQ(both.total(), 0u);
}

TEST(RunResult, SeverityPutsTheUnexpectedFirst) {
  const auto severity = [](const char* verdict, bool expected) {
    return read_run_result(record_of({{"verdict", verdict}, {"expected_by_baseline", expected}}))
        .tests[0]
        .severity();
  };
  EXPECT_LT(severity("internal-error", false), severity("crash", false));
  EXPECT_LT(severity("crash", false), severity("timeout", false));
  EXPECT_LT(severity("timeout", false), severity("fail", false));
  EXPECT_LT(severity("fail", false), severity("crash", true));
  const int unexpected_pass =
      read_run_result(record_of({{"verdict", "pass"}, {"baseline_reason", "known"}})).tests[0].severity();
  EXPECT_LT(severity("fail", true), unexpected_pass);
  EXPECT_LT(unexpected_pass, severity("quality-warning", false));
  EXPECT_LT(severity("quality-warning", false), severity("not-observable", false));
  EXPECT_LT(severity("skipped", false), severity("pass", false));
  EXPECT_EQ(severity("internal-error", true), severity("internal-error", false));
}

// The place of a crash is that of its innermost frames, ignoring the C library, recursion and outer frames.
TEST(RunResult, CrashesHaveAPlace) {
  const auto place = [](const char* verdict, const std::vector<std::string>& frames) {
    const json crash = {{"call", "glMap1f(GL_MAP1_INDEX, ...)"}, {"frames", frames}};
    const RunResult result =
        read_run_result({{"tests", {{{"name", "A.b"}, {"verdict", verdict}, {"crash", crash}}}}});
    EXPECT_EQ(parse_run_result(to_text(result)).tests[0].crash->frames, frames);
    return result.tests[0].place_of_death();
  };
  EXPECT_EQ(place("crash", {"libc.so.6+0x1", "gl+0x2", "gl+0x3", "gl+0x3", "gl+0x4", "gl+0x5"}),
            "gl+0x2 < gl+0x3 < gl+0x4");
  EXPECT_EQ(place("crash", {"libGL.so.1 glEnd+0x8"}), "libGL.so.1 glEnd+0x8");
  EXPECT_EQ(place("timeout", {"gl+0x2"}), "glMap1f");
}

TEST(RunResult, TextOfAFile) {
  const std::string head = R"({"format": "evalcts-results-1", "reason": )";
  EXPECT_EQ(parse_run_result(head + R"("fine"})").reason, "fine");
  // Brackets in strings do not count for the depth, even after escaped characters.
  const std::string brackets(200, '['), closed = std::string(90, '[') + std::string(90, ']');
  EXPECT_EQ(parse_run_result(head + "\"\\\\\\\"" + brackets + "\"}").reason, "\\\"" + brackets);
  EXPECT_NO_THROW(parse_run_result(head + "\"\", \"unknown\": [" + closed + ", " + closed + "]}"));
  std::string nested = head + R"("\\", "unknown": )";
  nested += brackets + std::string(200, ']') + "}";
  for (const std::string& bad :
       {std::string(), head, std::string("[]"), std::string("{}"), std::string(R"({"format": 1})"),
        std::string(R"({"format": "evalcts-ulp-2"})"), head + "1}", nested})
    EXPECT_THROW(parse_run_result(bad), FormatError) << bad;
}

TEST(Catalogue, Read) {
  const Catalogue catalogue = catalogue_of(read_sample("requirements.json"));
  EXPECT_EQ(catalogue.requirements.size(), 3u);
  EXPECT_EQ(catalogue.find("EV-MAP1-DOMAIN/1-D")->source, "GL 1.0 §5.1; glMap1 page");
  EXPECT_EQ(catalogue.find("EV-OTHER"), nullptr);
  EXPECT_THROW(catalogue_of(json::array()), FormatError);
  EXPECT_THROW(catalogue_of({{"requirements", {{{"text", "no id"}}}}}), FormatError);
}

}  // namespace
}  // namespace evalcts::reports
