#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evalcts/reports.h"
#include "reports/record.h"
#include "reports/text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kColumns = 100, kLines = 24;
constexpr std::size_t kTestsOfGroup = 3;  // more tests of one requirement tell little that is new

enum class Colour { kNone, kRed, kYellow, kGreen, kFaint, kBold };

Colour colour_of(Verdict verdict) {
  if (verdict <= Verdict::kFail) return Colour::kRed;
  if (verdict == Verdict::kQualityWarning) return Colour::kYellow;
  return verdict == Verdict::kPass ? Colour::kGreen : Colour::kFaint;
}

// Lines of clean text, cut to the screen if asked; colour goes around a whole line so that cutting cannot
// split it.
class Screen {
 public:
  Screen(bool colour, bool cut_lines) : colour_(colour), cut_lines_(cut_lines) {}

  void line(const std::string& text, Colour colour = Colour::kNone) {
    const std::string shown = cut_lines_ ? cut(one_line(text), kColumns) : one_line(text);
    out_ += paint(shown, colour) + "\n";
    ++lines_;
  }
  // Never cut: the end says what to do.
  void whole_line(const std::string& text, Colour colour) {
    out_ += paint(one_line(text), colour) + "\n";
    ++lines_;
  }
  // "head: part, part" on as many lines as that takes: no part is lost.
  void list(const std::string& head, const std::vector<std::string>& parts) {
    std::string pending = head;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string next = (i == 0 ? ": " : ", ") + parts[i];
      if (pending.size() + next.size() < kColumns) {
        pending += next;
      } else {
        line(pending + ",");
        pending = "  " + parts[i];
      }
    }
    line(pending);
  }
  std::size_t lines() const { return lines_; }
  const std::string& text() const { return out_; }

 private:
  std::string paint(const std::string& text, Colour colour) const {
    if (!colour_ || colour == Colour::kNone || text.empty()) return text;
    static constexpr const char* kCodes[] = {"", "31", "33", "32", "2", "1"};
    return fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<int>(colour)], text);
  }

  bool colour_, cut_lines_;
  std::string out_;
  std::size_t lines_ = 0;
};

// Failing tests that decide the same requirements, worst first.
struct Group {
  std::string requirements;
  std::vector<const TestResult*> tests;
  int severity() const { return tests.front()->severity(); }
};

std::vector<Group> group_by_requirement(const std::vector<const TestResult*>& worst_first) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> index;
  for (const TestResult* test : worst_first) {
    const std::string key =
        test->requirements.empty() ? "(no requirement recorded)" : join(test->requirements, ", ");
    const auto [it, inserted] = index.emplace(key, groups.size());
    if (inserted) groups.push_back({key, {}});
    groups[it->second].tests.push_back(test);
  }
  return groups;  // in the order of their first, that is their worst, test
}

std::string test_line(const TestResult& test) {
  std::string out = fmt::format("  {:<15} {}", text_of(test.verdict).word, test.name);
  if (test.expected_bad()) out += " (expected)";
  if (test.unexpected_pass()) out += " (the baseline expects otherwise: " + test.baseline_reason + ")";
  if (test.failed_cases.value_or(0) && test.cases)
    out += fmt::format(": {} of {}", *test.failed_cases, count(*test.cases, "case"));
  if (!test.message.empty()) out += ": " + test.message;
  return out;
}

void write_failure(Screen& screen, const Failure& failure) {
  std::vector<std::string> where;
  if (!failure.case_name.empty()) where.push_back(failure.case_name);
  if (!failure.what.empty()) where.push_back(failure.what);
  std::string first = "      " + join(where, "; ");
  const std::string far = distance(failure.ulp, failure.condition_aware);
  if (!far.empty()) first += (where.empty() ? "" : ": ") + far;
  if (where.empty() && far.empty()) first += failure.message;
  screen.line(first);
  std::string second;
  if (!failure.expected.empty()) second = "expected " + failure.expected;
  if (!failure.captured.empty()) second += (second.empty() ? "captured " : ", captured ") + failure.captured;
  if (!second.empty()) screen.line("      " + second);
}

void write_group(Screen& screen, const Group& group, bool verbose) {
  screen.line(group.requirements, Colour::kBold);
  const std::size_t shown = verbose ? group.tests.size() : std::min(group.tests.size(), kTestsOfGroup);
  for (std::size_t i = 0; i < shown; ++i) {
    const TestResult& test = *group.tests[i];
    screen.line(test_line(test), colour_of(test.verdict));
    if (verbose && !test.baseline_reason.empty()) screen.line("      baseline: " + test.baseline_reason);
    if (verbose) {
      for (const Failure& failure : test.failures) write_failure(screen, failure);
    }
  }
  if (shown < group.tests.size()) {
    screen.line(fmt::format("  and {} more of this requirement", count(group.tests.size() - shown, "test")));
  }
  if (verbose) return;
  for (const TestResult* test : group.tests) {
    if (const Failure* failure = test->most_telling()) {
      write_failure(screen, *failure);
      return;
    }
  }
}

std::size_t lines_of(const Group& group) {
  Screen probe(false, true);
  write_group(probe, group, false);
  return probe.lines();
}

void write_head(Screen& screen, const Record& record) {
  const Implementation& implementation = record.implementation;
  std::string head = record.heading("(unnamed)");
  std::vector<std::string> parts;
  for (const std::string* part :
       {&implementation.vendor, &implementation.renderer, &implementation.version}) {
    if (!part->empty()) parts.push_back(*part);
  }
  if (!parts.empty()) head += ": " + join(parts, ", ");
  screen.line(head, Colour::kBold);

  if (!record.complete()) {
    const std::string status = record.status.empty() ? "status unknown" : record.status;
    screen.whole_line(status + (record.reason.empty() ? "" : ": " + record.reason), Colour::kRed);
  }
  std::vector<std::string> counts;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    if (record.counts[i])
      counts.push_back(fmt::format("{} {}", record.counts[i], text_of(static_cast<Verdict>(i)).word));
  }
  screen.list(count(record.total(), "test"), counts);
}

// What decided nothing, one line for each verdict and reason.
void write_not_judged(Screen& screen, const Record& record) {
  std::map<std::pair<Verdict, std::string>, std::vector<std::string>> reasons;
  for (const TestResult& test : record.tests) {
    if (test.verdict > Verdict::kQualityWarning && test.verdict < Verdict::kPass) {
      reasons[{test.verdict, test.message}].push_back(test.name);
    }
  }
  if (reasons.empty()) return;
  screen.line("");
  screen.line("Not judged", Colour::kBold);
  for (const auto& [key, names] : reasons) {
    screen.line(
        fmt::format("  {}: {}", text_of(key.first).word, key.second.empty() ? "no reason given" : key.second),
        Colour::kFaint);
    screen.line("      " + join(names, " "));
  }
}

void write_captures(Screen& screen, const Record& record) {
  if (record.implementation.captures.empty()) return;
  screen.line("");
  screen.line("Captures", Colour::kBold);
  for (const Capture& capture : record.implementation.captures) {
    screen.line(fmt::format("  {}: {}{}{}", capture.name, capture.available ? "available" : "not available",
                            capture.reason.empty() ? "" : ", ", capture.reason));
  }
}

}  // namespace

std::string terminal_summary(const nlohmann::json& result, bool colour, bool verbose) {
  const Record record = read_record(result);
  Screen screen(colour, !verbose);
  write_head(screen, record);

  std::vector<const TestResult*> told;
  for (const TestResult& test : record.tests) {
    if (verbose ? test.bad() || test.unexpected() || test.verdict == Verdict::kQualityWarning
                : test.unexpected()) {
      told.push_back(&test);
    }
  }
  std::stable_sort(told.begin(), told.end(),
                   [](const TestResult* a, const TestResult* b) { return a->severity() < b->severity(); });

  // A blank line, the groups left out, stale entries, the verdict of the run.
  const std::size_t end_lines = 3 + (record.stale_baseline_entries.empty() ? 0 : 1);
  std::size_t tests_left = told.size();
  if (!told.empty()) screen.line("");
  for (const Group& group : group_by_requirement(told)) {
    if (!verbose && screen.lines() + lines_of(group) + end_lines > kLines) break;
    write_group(screen, group, verbose);
    tests_left -= group.tests.size();
  }
  if (verbose) {
    write_not_judged(screen, record);
    write_captures(screen, record);
  }

  screen.line("");
  if (tests_left)
    screen.line("and " + count(tests_left, "unexpected result") + " more; --verbose and index.html show all");
  if (!record.stale_baseline_entries.empty())
    screen.line("stale in the baseline, no such test: " + join(record.stale_baseline_entries, ", "),
                Colour::kYellow);
  const std::uint64_t unexpected = record.unexpected_count(), expected = record.expected_bad_count();
  std::vector<std::string> last;
  if (unexpected) last.push_back(count(unexpected, "unexpected result"));
  if (expected) last.push_back(count(expected, "failing test") + " as the baseline expects");
  if (!record.complete()) last.push_back("the run is not complete");
  if (last.empty() || (!unexpected && record.complete())) last.insert(last.begin(), "nothing unexpected");
  screen.line(join(last, ", "), unexpected          ? Colour::kRed
                                : record.complete() ? Colour::kGreen
                                                    : Colour::kYellow);
  return screen.text();
}

}  // namespace evalcts::reports
