// Writes the summary of a run for a terminal: distinct bugs, unexpected results and counts, as many as fit on
// the screen.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include <evalcts/results/conclusion.h>
#include "evalcts/reports.h"
#include "quality.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kMostRows = 4;  // of the screen, for one line of the text, without --verbose
constexpr std::size_t kAllRows = std::string::npos;
constexpr std::size_t kMostInFull = 8;  // failures, without --verbose
constexpr std::size_t kMostBugs = 24;
constexpr std::size_t kLinesInFull = 8;  // lines of the screen for a failure, with commands of two lines each
constexpr std::size_t kLinesAtEnd = 7;   // lines of the screen after the failures, with the prompt

enum class Colour { kNone, kRed, kYellow, kGreen, kFaint, kBold };

Colour colour_of(Verdict verdict) {
  if (verdict <= Verdict::kFail) return Colour::kRed;
  if (verdict == Verdict::kQualityWarning) return Colour::kYellow;
  return verdict == Verdict::kPass ? Colour::kGreen : Colour::kFaint;
}

// Returns the number of bytes of the first `columns` characters.
std::size_t bytes_of(const std::string& text, std::size_t columns) {
  std::size_t bytes = 0;
  for (; bytes < text.size(); ++bytes)
    if ((static_cast<unsigned char>(text[bytes]) & 0xC0) != 0x80 && columns-- == 0) break;
  return bytes;
}

// Text for the screen without control characters. Lines longer than the screen are broken between words, and
// cut after `most_rows` rows. `columns`: 0 if there is no screen; then lines are whole.
class Screen {
 public:
  Screen(bool colour, std::size_t columns, std::size_t most_rows)
      : colour_(colour), columns_(columns), most_rows_(most_rows) {}

  // `indent`: of further rows; 0: two more than that of the text.
  void line(const std::string& text, Colour colour = Colour::kNone, std::size_t indent = 0) {
    add(text, colour, indent, most_rows_);
  }
  // Adds a line of which all is shown, because its end says what to do.
  void whole_line(const std::string& text, Colour colour) { add(text, colour, 0, kAllRows); }
  // Adds a line that is never cut: a command, which has to work when it is copied.
  void uncut(const std::string& text, Colour colour = Colour::kNone) {
    out_ += paint(one_line(text), colour) + "\n";
  }
  // Adds "head: part, part" on as many lines as all parts need.
  void list(const std::string& head, const std::vector<std::string>& parts) {
    std::string pending = head;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string next = (i == 0 ? ": " : ", ") + parts[i];
      if (columns_ == 0 || pending.size() + next.size() < columns_) {
        pending += next;
      } else {
        line(pending + ",");
        pending = "  " + parts[i];
      }
    }
    line(pending);
  }
  const std::string& text() const { return out_; }

 private:
  std::string paint(const std::string& text, Colour colour) const {
    if (!colour_ || colour == Colour::kNone || text.empty()) return text;
    static constexpr const char* kCodes[] = {"", "31", "33", "32", "2", "1"};
    return fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<int>(colour)], text);
  }

  void add(const std::string& text, Colour colour, std::size_t indent, std::size_t most_rows) {
    std::string rest = one_line(text);
    const std::string margin(indent ? indent : std::min(rest.find_first_not_of(' '), rest.size()) + 2, ' ');
    for (std::size_t rows = 1; columns_ > 0 && bytes_of(rest, columns_) < rest.size(); ++rows) {
      if (rows == most_rows) {
        rest = cut(rest, columns_);
        break;
      }
      const std::size_t space = rest.rfind(' ', bytes_of(rest, columns_));
      const bool has_space = space != std::string::npos && space > margin.size();
      const std::size_t end = has_space ? space : bytes_of(rest, columns_);
      out_ += paint(rest.substr(0, end), colour) + "\n";
      rest = margin + rest.substr(end + has_space);
    }
    out_ += paint(rest, colour) + "\n";
  }

  bool colour_;
  std::size_t columns_, most_rows_;
  std::string out_;
};

// Sorts the tests so that one of each list of requirements is first, then the second of each, and so on: more
// tests of the same requirements say little that is new.
std::vector<const TestRecord*> one_of_each(const std::vector<const TestRecord*>& worst_first) {
  std::map<std::vector<RequirementId>, std::size_t> seen;
  std::vector<std::pair<std::size_t, const TestRecord*>> order;
  for (const TestRecord* test : worst_first) order.emplace_back(seen[test->requirements]++, test);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const TestRecord*> tests;
  for (const auto& [number, test] : order) tests.push_back(test);
  return tests;
}

// Returns " (flake: pass when run again)" or the like; empty without another outcome of a repetition.
std::string repetition_note(const TestRecord& test) {
  const std::string words = repetition(test);
  return words.empty() ? "" : " (" + words + ")";
}

// Returns the line for a test that is not described in full.
std::string test_line(const TestRecord& test) {
  std::string out = fmt::format("{:<15} {}{}", text_of(test.verdict).label, test.name, repetition_note(test));
  if (test.is_expected_failure())
    out += " (expected" + (test.baseline_reason.empty() ? "" : ": " + test.baseline_reason) + ")";
  if (test.is_unexpected_pass()) out += " (the baseline expects otherwise: " + test.baseline_reason + ")";
  if (test.failed_cases.value_or(0) && test.cases)
    out += fmt::format(": {} of {}", *test.failed_cases, count(*test.cases, "case"));
  if (!test.message.empty()) out += ": " + test.message;
  return out;
}

// Returns "position.x of vertex 3: expected [0.25, 0.2501], got 0.3 (1.7e+06 ULP)" or the like.
std::string comparison(const Failure& failure, const TestRecord& test) {
  if (failure.expected.empty() && failure.captured.empty())
    return in_plain_numbers(failure.message.empty() ? test.message : failure.message);
  std::string out = failure.what.empty() ? "" : in_plain_numbers(failure.what) + ": ";
  out += "expected " + (failure.expected.empty() ? "another answer" : in_plain_numbers(failure.expected));
  if (!failure.captured.empty()) out += ", got " + in_plain_numbers(failure.captured);
  const std::string far = distance(failure.ulp, failure.condition_aware);
  return far.empty() ? out : out + " (" + far + ")";
}

// Returns the violated requirement in one line: "EV-MAP1-COPY: its text... [GL 2.1 5.1]".
std::string demand(const TestRecord& test, const Catalogue& catalogue) {
  const std::vector<RequirementId> blamed = test.is_bad() ? test.blamed() : test.requirements;
  if (blamed.empty()) return "no requirement recorded";
  const std::string id = blamed.front().text();
  std::string others;
  if (blamed.size() > 1) others = fmt::format(" (and {} more)", blamed.size() - 1);
  const Requirement* requirement = catalogue.find(id);
  if (!requirement) return join(texts_of(blamed), ", ");
  return id + others + ": " + requirement->text +
         (requirement->source.empty() ? "" : " [" + requirement->source + "]");
}

// Returns the failing tests that the bug explains and that the baseline does not expect.
std::vector<const TestRecord*> unexpected_of(const Bug& bug, const RunResult& record) {
  std::vector<const TestRecord*> tests;
  for (const TestRecord& test : record.tests)
    if (test.is_bad() && test.is_unexpected() && std::ranges::binary_search(bug.tests, test.name))
      tests.push_back(&test);
  return tests;
}

// Writes a bug in two lines: its title; its verdict, number of tests and ID. If the baseline does not expect
// all its failures, two more lines: the difference, and the command that writes a C program.
void write_bug(Screen& screen, const Bug& bug, std::size_t number, const RunResult& record) {
  const std::vector<const TestRecord*> unexpected = unexpected_of(bug, record);
  constexpr std::size_t kIndent = 4;  // of the title
  screen.line(fmt::format("{:>2}. {}", number, bug.title),
              unexpected.empty() ? Colour::kNone : colour_of(bug.verdict), kIndent);
  std::string weight = fmt::format("    {}, {}: {}", text_of(bug.verdict).label, name_of(bug.level),
                                   count(bug.tests.size(), "test"));
  if (!unexpected.empty()) weight += fmt::format(" ({} unexpected)", unexpected.size());
  if (bug.breaks_real_programs) weight += ", real programs draw wrong";
  if (bug.outside_evaluators) weight += ", explicit vertices show it as well";
  if (!bug.is_reduced()) weight += ", not reduced";
  weight += "; " + (bug.known.empty() ? bug.id : bug.known);
  if (!bug.clause.empty()) weight += " [" + bug.clause + "]";
  screen.line(weight, Colour::kFaint);
  if (unexpected.empty()) return;
  const TestRecord& first = *unexpected.front();
  screen.line("    " + comparison(bug.failure, first));
  std::string command = first.reproducer;
  if (const std::size_t at = command.find(first.name); at != std::string::npos)
    screen.uncut("    C program: " + command.replace(at, first.name.size(), bug.id));
}

// Writes the distinct bugs, at most `most` of them.
void write_bugs(Screen& screen, const RunResult& record, std::size_t most) {
  std::size_t explained = 0;
  for (const Bug& bug : record.bugs) explained += bug.tests.size();
  screen.line("");
  const auto known = std::ranges::count_if(record.bugs, [](const Bug& bug) { return !bug.known.empty(); });
  screen.line(fmt::format("{} behind {}, most important first; {}", count(record.bugs.size(), "distinct bug"),
                          count(explained, "failing test"),
                          known == std::ssize(record.bugs) ? "all are known"
                          : known == 0                     ? "none is known"
                                                           : fmt::format("{} known", known)),
              Colour::kBold);
  for (std::size_t i = 0; i < record.bugs.size() && i < most; ++i)
    write_bug(screen, record.bugs[i], i + 1, record);
  if (record.bugs.size() > most) screen.line(fmt::format("and {} more", record.bugs.size() - most));
  screen.line("'evalcts bugs' shows each with its program, --verbose the failing tests");
}

// Writes an unexpected failure in five lines; all_cases: its other recorded cases as well.
void write_in_full(Screen& screen, const TestRecord& test, const Catalogue& catalogue, bool all_cases) {
  const Failure none{};
  const Failure& failure = test.failures.empty() ? none : test.failures.front();
  std::string first =
      fmt::format("{:<8} {}{}", text_of(test.verdict).label, test.name, repetition_note(test));
  if (test.failed_cases.value_or(0) && test.cases)
    first += fmt::format(": {} of {}", *test.failed_cases, count(*test.cases, "case"));
  if (!failure.case_identity.empty()) first += ", " + in_plain_numbers(failure.case_identity);
  screen.line(first, colour_of(test.verdict));
  screen.line("  " + comparison(failure, test));
  screen.line("  why: " + demand(test, catalogue));
  if (!test.rerun.empty()) screen.uncut("  rerun: " + test.rerun);
  std::string last;
  if (!test.reproducer.empty()) last += "  C program: " + test.reproducer;
  if (!test.debug.empty()) last += (last.empty() ? "  debugger: " : "   debugger: ") + test.debug;
  if (!last.empty()) screen.uncut(last);
  if (!all_cases) return;
  for (std::size_t i = 1; i < test.failures.size(); ++i)
    screen.line(fmt::format("    {}: {}", in_plain_numbers(test.failures[i].case_identity),
                            comparison(test.failures[i], test)));
}

void write_head(Screen& screen, const RunResult& record) {
  const ImplementationRecord& implementation = record.implementation;
  std::string head = record.heading("(unnamed)");
  if (!implementation.context_library.empty()) head += ", contexts of " + implementation.context_library;
  std::vector<std::string> parts;
  for (const std::string* part :
       {&implementation.vendor, &implementation.renderer, &implementation.version}) {
    if (!part->empty()) parts.push_back(*part);
  }
  if (!parts.empty()) head += ": " + join(parts, ", ");
  screen.line(head, Colour::kBold);
  if (!implementation.files.empty())
    screen.whole_line("loaded: " + join(implementation.files, ", "), Colour::kFaint);
  if (implementation.kind == "production")
    screen.line("  this project's own evaluator: it shows that the tests can pass", Colour::kFaint);
  if (implementation.kind == "reference")
    screen.line("  the executable specification: the tests agree with it, so they can pass", Colour::kFaint);
  if (!implementation.note.empty()) screen.whole_line("note: " + implementation.note, Colour::kYellow);

  std::vector<std::string> counts;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    if (record.counts[i])
      counts.push_back(fmt::format("{} {}", record.counts[i], text_of(static_cast<Verdict>(i)).label));
  }
  screen.list(count(record.total(), "test"), counts);

  std::map<std::string, std::size_t> unobserved;  // number of passes by what they do not cover
  for (const TestRecord& test : record.tests)
    if (test.verdict == Verdict::kPass && !test.unobserved.empty()) ++unobserved[test.unobserved];
  for (const auto& [what, tests] : unobserved)
    screen.line(fmt::format("  {} of these passes without {}: not observed", tests, what), Colour::kYellow);

  std::vector<std::string> unstable;
  for (const TestRecord& test : record.tests)
    if (test.verdict == Verdict::kNotObservable && test.flake) unstable.push_back(test.name);
  if (!unstable.empty())
    screen.whole_line(
        fmt::format("note: {} {} unstable: {} failed, and not when {} run again ({}{})",
                    count(unstable.size(), "test"), unstable.size() == 1 ? "is" : "are",
                    unstable.size() == 1 ? "it" : "they", unstable.size() == 1 ? "it was" : "they were",
                    unstable.front(), unstable.size() > 1 ? ", ..." : ""),
        Colour::kYellow);
}

// If much was not observed, says why: the captures that do not work, and the most frequent reason.
void write_why_unobserved(Screen& screen, const RunResult& record) {
  constexpr std::size_t kPart = 4;
  std::map<std::string, std::size_t> reasons;
  std::size_t tests = 0;
  for (const TestRecord& test : record.tests)
    if (test.verdict == Verdict::kNotObservable) {
      ++tests;
      ++reasons[test.message];
    }
  if (kPart * tests < record.total() || tests == 0) return;
  const auto most = std::ranges::max_element(reasons, {}, [](const auto& reason) { return reason.second; });
  screen.whole_line(fmt::format("note: {} of {} tests were not observed, {} of them because: {}", tests,
                                record.total(), most->second, most->first),
                    Colour::kYellow);
  for (const CaptureRecord& capture : record.implementation.captures)
    if (!capture.available)
      screen.whole_line(fmt::format("  {} does not work: {}", capture.name, capture.reason), Colour::kYellow);
  screen.whole_line("  docs/test-your-gl.md says what helps; --verbose lists all that was not judged",
                    Colour::kYellow);
}

// Writes one line about the commands that tests omit because the library crashes in them or rejects them.
void write_left_out(Screen& screen, const RunResult& record) {
  std::set<std::string> calls;
  std::size_t tests = 0;
  for (const TestRecord& test : record.tests) {
    tests += !test.left_out.empty();
    calls.insert(test.left_out.begin(), test.left_out.end());
  }
  if (tests > 0)
    screen.line(fmt::format("  {} run without commands that crash or are rejected: {}", count(tests, "test"),
                            join({calls.begin(), calls.end()}, ", ")),
                Colour::kYellow);
}

// Writes the tests that decided nothing, one line for each verdict and reason.
void write_not_judged(Screen& screen, const RunResult& record) {
  std::map<std::pair<Verdict, std::string>, std::vector<std::string>> reasons;
  for (const TestRecord& test : record.tests) {
    if (test.verdict > Verdict::kQualityWarning && test.verdict < Verdict::kPass) {
      reasons[{test.verdict, test.message}].push_back(test.name);
    }
  }
  if (reasons.empty()) return;
  screen.line("");
  screen.line("Not judged", Colour::kBold);
  for (const auto& [key, names] : reasons) {
    screen.line(fmt::format("  {}: {}", text_of(key.first).label,
                            key.second.empty() ? "no reason given" : key.second),
                Colour::kFaint);
    screen.line("      " + join(names, " "));
  }
}

void write_captures(Screen& screen, const RunResult& record) {
  if (record.implementation.captures.empty()) return;
  screen.line("");
  screen.line("Captures", Colour::kBold);
  for (const CaptureRecord& capture : record.implementation.captures) {
    screen.line(fmt::format("  {}: {}{}{}", capture.name, capture.available ? "available" : "not available",
                            capture.reason.empty() ? "" : ", ", capture.reason));
  }
}

// Names the baseline whose failures were expected, and the options that change it.
void write_baseline(Screen& screen, const RunResult& record) {
  if (!record.baseline.empty())
    screen.whole_line(
        fmt::format("baseline: {} (--baseline DIR adds failures that you know, none expects no failure)",
                    record.baseline),
        Colour::kFaint);
  else if (record.unexpected_count() > 0)
    screen.whole_line("baseline: none; 'evalcts waive' or --write-baseline records known failures",
                      Colour::kFaint);
}

void write_conclusion(Screen& screen, const RunResult& record, const std::string& head = {}) {
  const Conclusion conclusion = conclusion_of(record);
  const bool is_green =
      record.is_complete() && !is_mostly_unobserved(conclusion.observed, conclusion.supported);
  screen.whole_line(head + conclusion.text, !conclusion.problems.empty() ? Colour::kRed
                                            : is_green                   ? Colour::kGreen
                                                                         : Colour::kYellow);
}

}  // namespace

std::string terminal_line(const RunResult& record, bool colour) {
  Screen screen(colour, 0, kAllRows);
  write_conclusion(screen, record, record.heading("(unnamed)") + ": ");
  return screen.text();
}

std::string terminal_summary(const RunResult& record, const Catalogue& catalogue, bool colour, bool verbose,
                             std::size_t lines, std::size_t columns) {
  Screen screen(colour, columns, verbose ? kAllRows : kMostRows);
  write_head(screen, record);
  write_why_unobserved(screen, record);
  write_left_out(screen, record);

  std::vector<const TestRecord*> failing, others;  // tests to write in full, and in one line
  for (const TestRecord& test : record.tests) {
    if (test.is_bad() && test.is_unexpected()) {
      failing.push_back(&test);
    } else if (test.is_unexpected() ||
               (verbose && (test.is_bad() || test.verdict == Verdict::kQualityWarning))) {
      others.push_back(&test);
    }
  }
  // Tests that a bug explains are left to the list of bugs.
  if (!record.bugs.empty()) {
    write_bugs(screen, record, kMostBugs);
    if (!verbose)
      std::erase_if(failing, [&](const TestRecord* test) { return record.bug_of(test->name) != nullptr; });
  }

  const auto worse = [](const TestRecord* a, const TestRecord* b) { return a->severity() < b->severity(); };
  std::stable_sort(failing.begin(), failing.end(), worse);
  std::stable_sort(others.begin(), others.end(), worse);
  failing = one_of_each(failing);

  std::size_t left = 0, most = kMostInFull;
  if (lines > 0) {
    const std::string& head = screen.text();
    const std::size_t taken = kLinesAtEnd + static_cast<std::size_t>(std::ranges::count(head, '\n'));
    most = std::clamp(lines > taken ? (lines - taken) / kLinesInFull : 0, std::size_t{1}, kMostInFull);
  }
  if (!verbose && failing.size() > most) {
    left += failing.size() - most;
    failing.resize(most);
  }
  if (!verbose && others.size() > most) {
    left += others.size() - most;
    others.resize(most);
  }
  for (const TestRecord* test : failing) {
    screen.line("");
    write_in_full(screen, *test, catalogue, verbose);
  }
  if (!others.empty()) screen.line("");
  for (const TestRecord* test : others) screen.line(test_line(*test), colour_of(test->verdict));
  if (verbose) {
    write_not_judged(screen, record);
    write_captures(screen, record);
  }

  screen.line("");
  if (left)
    screen.line("and " + count(left, "unexpected result") + " more; --verbose and index.html show all");
  if (!record.bugs_note.empty()) screen.whole_line("note: " + record.bugs_note, Colour::kFaint);
  if (record.confirmed_by_group)
    screen.line("so many failed that " + count(record.confirmed_by_group, "unexpected failure") +
                " had another of the same kind run again instead");
  for (const std::string& quality : quality_in_words(record))
    screen.whole_line("quality: " + quality, Colour::kFaint);
  write_baseline(screen, record);
  write_conclusion(screen, record);
  return screen.text();
}

}  // namespace evalcts::reports
