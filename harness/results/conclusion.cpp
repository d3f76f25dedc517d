// Counts what decides the exit code of a run, and says it in one line.
#include <evalcts/results/conclusion.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <evalcts/results/text.h>

namespace evalcts {

Conclusion conclusion_of(const RunResult& result) {
  Conclusion out;
  if (!result.has_started()) {
    out.text = "Not judged: " + (result.reason.empty() ? "no reason recorded" : result.reason);
    return out;
  }
  const auto counted = [&](Verdict verdict) { return result.counts[static_cast<std::size_t>(verdict)]; };
  out.internal_errors = counted(Verdict::kInternalError);
  out.supported = result.total() - counted(Verdict::kNotSupported);
  out.observed = out.supported - counted(Verdict::kNotObservable);

  const std::uint64_t known = result.expected_failure_count();
  std::vector<std::string> passes;
  for (const TestRecord& test : result.tests)
    if (test.is_unexpected_pass()) passes.push_back(test.name);
  const std::uint64_t failures = result.unexpected_count() - out.internal_errors - passes.size();
  if (out.internal_errors) out.problems.push_back(count(out.internal_errors, "internal error"));
  if (failures)
    out.problems.push_back(known || !result.baseline.empty() ? count(failures, "new failure")
                                                             : count(failures, "failure"));
  std::vector<std::string> notes;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (names.empty()) return;
    (result.strict ? out.problems : notes)
        .push_back(fmt::format("{}{}: {}", count(names.size(), one, many), result.strict ? " (--strict)" : "",
                               first_of(names)));
  };
  add(passes, "unexpected pass", "unexpected passes");
  add(result.stale_baseline_entries, "stale baseline entry", "stale baseline entries");

  std::vector<std::string> parts = out.problems;
  if (parts.empty())
    parts.push_back(
        fmt::format("No {}failures{}", known ? "new " : "", result.is_complete() ? "" : " so far"));
  if (known)
    parts.push_back(fmt::format("{} known", known) +
                    (result.baseline.empty() ? "" : fmt::format(" (baseline {})", result.baseline)));
  parts.insert(parts.end(), notes.begin(), notes.end());
  if (is_mostly_unobserved(out.observed, out.supported))
    parts.push_back(fmt::format("only {} of {} tests could be observed", out.observed, out.supported));
  if (!result.is_complete()) {
    const std::string reason = result.status ? result.reason : "status unknown";
    parts.push_back("not complete" + (reason.empty() ? "" : ": " + reason));
  }
  out.text = fmt::format("{}", fmt::join(parts, "; "));
  return out;
}

}  // namespace evalcts
