// Writes results as JUnit XML, in the form that all CI systems read: a <testcase> contains at most one
// <failure>, <error> or <skipped>, with all text in it (Jenkins keeps only the first), and the counts agree
// with the elements.
#include <fmt/format.h>

#include <algorithm>

#include <kainjow/mustache.hpp>

#include <evalcts/results/run_result.h>
#include "evalcts/reports.h"
#include "reports_templates.h"
#include "text.h"

namespace evalcts::reports {
namespace {

namespace mustache = kainjow::mustache;

// The XML element in a testcase, with its attributes and text. The name of the element is empty for a pass.
struct Outcome {
  std::string element, type, message, body;
};

struct Totals {
  std::uint64_t tests = 0, failures = 0, errors = 0, skipped = 0;

  void add(const Outcome& outcome) {
    ++tests;
    failures += outcome.element == "failure";
    errors += outcome.element == "error";
    skipped += outcome.element == "skipped";
  }
};

// Returns the time as text. A negative time becomes 0, because the schemas do not allow a sign.
std::string seconds(double value) { return fmt::format("{:.6f}", std::max(value, 0.0)); }

// Returns everything that is recorded about the failures, for readers who have no other report.
std::string details(const TestRecord& test) {
  std::string out;
  const auto line = [&out](std::string_view label, const std::string& value) {
    if (!value.empty()) out += fmt::format("{}: {}\n", label, value);
  };
  line("message", test.message);
  line("requirements", join(texts_of(test.requirements), ", "));
  line("violated", join(texts_of(test.violated), ", "));
  line("level", name_of(test.level));
  line("baseline", test.baseline_reason);
  if (test.failed_cases && test.cases)
    line("failing cases", fmt::format("{} of {}", *test.failed_cases, *test.cases));
  if (test.seed) line("seed", fmt::format("{}", *test.seed));
  if (test.history) line("history", join(*test.history, ", "));
  line("repetition", repetition(test));
  line("run just this test", test.rerun);
  line("open it in a debugger", test.debug);
  line("make a C program of it", test.reproducer);
  for (const Failure& failure : test.failures) {
    out += "\n";
    line("case", failure.case_identity);
    line("message", failure.message);
    line("what", failure.what);
    line("expected", failure.expected);
    line("captured", failure.captured);
    line("exact", failure.exact);
    line("distance", distance(failure.ulp, failure.condition_aware));
    line("capture", failure.capture);
    if (!failure.calls.empty()) out += "calls:\n  " + join(failure.calls, "\n  ") + "\n";
  }
  return out;
}

Outcome outcome_of(const TestRecord& test) {
  const std::string word(text_of(test.verdict).word);
  const std::string message = one_line(test.message.empty() ? word : test.message);
  if (test.is_expected_failure()) {
    const std::string reason =
        test.baseline_reason.empty() ? "no reason given" : one_line(test.baseline_reason);
    return {"skipped", word, fmt::format("{} expected by the baseline: {}", word, reason), ""};
  }
  switch (test.verdict) {
    case Verdict::kFail:
      return {"failure", word, message, details(test)};
    case Verdict::kCrash:
    case Verdict::kTimeout:
    case Verdict::kInternalError:
      return {"error", word, message, details(test)};
    case Verdict::kNotObservable:
    case Verdict::kNotSupported:
    case Verdict::kSkipped:
      return {"skipped", word, test.message.empty() ? word : word + ": " + message, ""};
    case Verdict::kPass:
    case Verdict::kQualityWarning:
      break;
  }
  return {};
}

// Returns the text for system-out: what a reader should see although the testcase is not red.
std::string output_of(const TestRecord& test) {
  if (test.is_expected_failure()) return details(test);
  if (test.verdict == Verdict::kQualityWarning) return "quality-warning\n" + details(test);
  if (test.is_unexpected_pass()) return "unexpected pass; the baseline says: " + test.baseline_reason + "\n";
  return {};
}

mustache::data testcase(const std::string& classname, const std::string& name, double time,
                        const Outcome& outcome, const std::string& output) {
  mustache::data out;
  out.set("classname", one_line(classname));
  out.set("case_name", one_line(name));
  out.set("case_time", seconds(time));
  mustache::data element;
  element.set("element", outcome.element);
  element.set("type", outcome.type);
  element.set("message", outcome.message);
  element.set("body", outcome.body);
  out.set("outcome", outcome.element.empty() ? mustache::data(false) : element);
  out.set("output", output.empty() ? mustache::data(false) : mustache::data(output));
  return out;
}

}  // namespace

std::string junit(const RunResult& record) {
  const ImplementationRecord& implementation = record.implementation;
  const std::string suite = record.heading("unnamed");

  mustache::data page, properties(mustache::data::type::list), testcases(mustache::data::type::list);
  const auto property = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    mustache::data item;
    item.set("name", name);
    item.set("value", one_line(value));
    properties << item;
  };
  property("evalcts.version", record.evalcts_version);
  property("evalcts.command", record.command);
  property("evalcts.depth", record.depth ? name_of(*record.depth) : "");
  property("evalcts.pass", name_of(record.pass));
  property("evalcts.baseline.stale", join(record.stale_baseline_entries, ", "));
  property("evalcts.status", record.status ? name_of(*record.status) : "");
  property("evalcts.reason", record.reason);
  property("gl.library", implementation.library);
  property("gl.vendor", implementation.vendor);
  property("gl.renderer", implementation.renderer);
  property("gl.version", implementation.version);
  property("machine", implementation.machine);

  Totals totals;
  double time = 0;
  if (!record.is_complete()) {
    const std::string status = record.status ? name_of(*record.status) : "unknown";
    const Outcome outcome{record.has_started() ? "error" : "skipped", status,
                          one_line(record.reason.empty() ? "the run is not complete" : record.reason), ""};
    totals.add(outcome);
    testcases << testcase(suite + ".evalcts", "the run", 0, outcome, "");
  }
  for (const TestRecord& test : record.tests) {
    const Outcome outcome = outcome_of(test);
    totals.add(outcome);
    time += test.seconds.value_or(0);
    // Names are "Theme.Rule/parameters"; a name without a dot is its own theme.
    const std::size_t dot = test.name.find('.');
    const std::string theme = suite + "." + test.name.substr(0, dot);
    const std::string name = dot == std::string::npos ? test.name : test.name.substr(dot + 1);
    testcases << testcase(theme, name, test.seconds.value_or(0), outcome, output_of(test));
  }

  page.set("suite", suite);
  page.set("tests", fmt::format("{}", totals.tests));
  page.set("failures", fmt::format("{}", totals.failures));
  page.set("errors", fmt::format("{}", totals.errors));
  page.set("skipped", fmt::format("{}", totals.skipped));
  page.set("time", seconds(time));
  page.set("properties", properties);
  page.set("testcases", testcases);
  return mustache::mustache(kJunitTemplate).render(page);
}

}  // namespace evalcts::reports
