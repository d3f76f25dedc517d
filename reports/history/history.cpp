// Orders the runs of a history, and writes it for a terminal.
#include "history/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <sstream>

#include "text.h"

namespace evalcts::reports {
namespace {

bool starts_with_digit(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0]));
}

// Returns "Mesa 22.3.6" for "4.5 (Compatibility Profile) Mesa 22.3.6": the first word before a number.
std::string product_of(const std::string& gl_version) {
  std::istringstream stream(gl_version);
  std::string before;
  for (std::string word; stream >> word; before = word)
    if (starts_with_digit(word) && !before.empty() && std::isalpha(static_cast<unsigned char>(before[0])))
      return before + " " + word;
  return gl_version;
}

// Returns the version as numbers and the words around them, so that "Mesa 9.0" comes before "Mesa 22.3".
std::vector<std::pair<std::uint64_t, std::string>> order_of(const std::string& version) {
  std::vector<std::pair<std::uint64_t, std::string>> parts;
  for (std::size_t i = 0; i < version.size();) {
    const bool is_number = starts_with_digit(version.substr(i));
    std::string part;
    for (; i < version.size() && starts_with_digit(version.substr(i)) == is_number; ++i) part += version[i];
    parts.emplace_back(is_number && part.size() < 10 ? std::stoull(part) : 0, is_number ? "" : part);
  }
  return parts;
}

std::vector<Step> steps_of(const std::vector<const PastRun*>& runs) {
  std::vector<Step> steps;
  const PastRun* before = nullptr;
  for (const PastRun* const run : runs) {
    Step step{run, {}, {}};
    if (before && before->has_bugs && run->has_bugs) {
      std::ranges::set_difference(run->bugs, before->bugs, std::back_inserter(step.came));
      std::ranges::set_difference(before->bugs, run->bugs, std::back_inserter(step.went));
    }
    before = run;
    steps.push_back(std::move(step));
  }
  return steps;
}

// Returns the last run of each version, in the order of the versions.
std::vector<const PastRun*> last_of_versions(const std::vector<const PastRun*>& by_date) {
  std::map<std::vector<std::pair<std::uint64_t, std::string>>, const PastRun*> last;
  for (const PastRun* const run : by_date) last[order_of(run->version)] = run;
  std::vector<const PastRun*> runs;
  for (const auto& [order, run] : last) runs.push_back(run);
  return runs;
}

std::uint64_t counted(const PastRun& run, Verdict verdict) {
  return run.counts[static_cast<std::size_t>(verdict)];
}

std::string names_of(const std::vector<PastRun::PastBug>& bugs) {
  std::vector<std::string> names;
  for (const PastRun::PastBug& bug : bugs) names.push_back(bug.id);
  return first_of(names);
}

}  // namespace

PastRun past_run(const RunResult& result, const std::string& run) {
  PastRun out;
  out.run = one_line(run);
  out.series = fmt::format("{}, {} depth", result.heading("(unnamed)"),
                           result.depth ? name_of(*result.depth) : "unknown");
  out.version = product_of(one_line(result.implementation.version));
  out.started = result.started;
  out.is_whole = result.is_complete() && result.filter.empty() && !result.shard;
  const auto failures = result.unexpected_count() + result.expected_failure_count();
  out.has_bugs = !result.bugs.empty() || failures == 0;
  for (const Bug& bug : result.bugs)
    out.bugs.push_back({one_line(bug.known.empty() ? bug.id : bug.known), one_line(bug.title)});
  std::ranges::sort(out.bugs);
  out.counts = result.counts;
  for (const TestRecord& test : result.tests) {
    out.new_failures += test.is_bad() && test.is_unexpected();
    out.known_failures += test.is_expected_failure();
  }
  return out;
}

std::vector<Series> series_of(const std::vector<PastRun>& runs) {
  std::map<std::string, std::vector<const PastRun*>> whole;
  std::map<std::string, std::size_t> left_out;
  for (const PastRun& run : runs) {
    std::vector<const PastRun*>& of_series = whole[run.series];
    if (run.is_whole)
      of_series.push_back(&run);
    else
      ++left_out[run.series];
  }
  std::vector<Series> all;
  for (auto& [name, of_series] : whole) {
    std::ranges::stable_sort(of_series, {}, [](const PastRun* run) { return run->started; });
    all.push_back({name, steps_of(of_series), steps_of(last_of_versions(of_series)), left_out[name]});
  }
  return all;
}

std::string bugs_in_words(const PastRun& run) { return run.has_bugs ? std::to_string(run.bugs.size()) : "-"; }

std::string date_in_words(const PastRun& run) {
  constexpr std::size_t kToMinutes = 16;  // of "2026-11-28T11:27:22Z"
  if (run.started.size() < kToMinutes) return "unknown";
  std::string date = one_line(run.started).substr(0, kToMinutes);
  std::ranges::replace(date, 'T', ' ');
  return date;
}

std::string step_in_words(const Step& step) {
  std::vector<std::string> parts;
  if (!step.came.empty())
    parts.push_back(fmt::format("{}: {}", count(step.came.size(), "new bug"), names_of(step.came)));
  if (!step.went.empty()) parts.push_back(fmt::format("{} gone: {}", step.went.size(), names_of(step.went)));
  return join(parts, "; ");
}

std::string history_text(const std::vector<PastRun>& runs, std::size_t columns) {
  constexpr std::size_t kMostOfVersion = 24;
  std::string out;
  const auto line = [&](const std::string& text) { out += (columns > 3 ? cut(text, columns) : text) + "\n"; };
  for (const Series& series : series_of(runs)) {
    line(fmt::format("History of {}: {}{}", series.name, count(series.by_date.size(), "run"),
                     series.left_out
                         ? fmt::format(", without {} of a part of the tests or not complete", series.left_out)
                         : ""));
    if (series.by_date.empty()) continue;
    line(fmt::format("  {:<16}  {:<{}} {:>5} {:>5} {:>5} {:>5} {:>5} {:>12}  {}", "started (UTC)", "version",
                     kMostOfVersion, "bugs", "new", "known", "crash", "hang", "not observed", "run"));
    for (const Step& step : series.by_date) {
      const PastRun& run = *step.run;
      line(fmt::format("  {:<16}  {:<{}} {:>5} {:>5} {:>5} {:>5} {:>5} {:>12}  {}", date_in_words(run),
                       cut(run.version, kMostOfVersion), kMostOfVersion, bugs_in_words(run), run.new_failures,
                       run.known_failures, counted(run, Verdict::kCrash), counted(run, Verdict::kTimeout),
                       counted(run, Verdict::kNotObservable), run.run));
      if (const std::string change = step_in_words(step); !change.empty()) line("    " + change);
    }
    line("  By version:");
    for (const Step& step : series.by_version) {
      const std::string change = step_in_words(step);
      line(fmt::format("    {}: bugs: {}{}", step.run->version.empty() ? "no version" : step.run->version,
                       bugs_in_words(*step.run), change.empty() ? "" : "; " + change));
    }
  }
  return out;
}

}  // namespace evalcts::reports
