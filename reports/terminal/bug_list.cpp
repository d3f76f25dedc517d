// Writes the distinct bugs for a terminal, each with its minimal program.
#include <fmt/format.h>

#include <set>

#include "evalcts/reports.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kMostTestsOfBug = 5;  // without --verbose

std::string bold(const std::string& text, bool colour) {
  return colour ? fmt::format("\x1b[1m{}\x1b[0m", text) : text;
}

std::string bug_text(const Bug& bug, std::size_t number, const Catalogue& catalogue, bool colour,
                     bool verbose) {
  std::string out = bold(fmt::format("{}. {}", number, one_line(bug.title)), colour) + "\n";
  const auto line = [&](const std::string& label, const std::string& words) {
    if (!words.empty()) out += fmt::format("   {}: {}\n", label, one_line(words));
  };
  out += fmt::format("   {}: {}, {}; {}, {}{}\n", one_line(bug.id), text_of(bug.verdict).label,
                     name_of(bug.level), count(bug.tests.size(), "failing test"),
                     count(bug.explains.size(), "requirement"),
                     bug.breaks_real_programs ? "; real programs draw wrong" : "");
  for (const RequirementId& id : bug.requirements) {
    const Requirement* const requirement = catalogue.find(id);
    line(id.text(), requirement ? fmt::format("{} [{}]", requirement->text, requirement->source) : "");
  }
  if (!bug.known.empty()) line("known", fmt::format("{}, in {}", bug.known, bug.known_in));
  if (bug.outside_evaluators) line("note", "explicit vertices instead of evaluations show it as well");
  line("not reduced", bug.why_not_reduced);
  line("what differs", in_plain_numbers(bug.failure.what));
  line("expected", in_plain_numbers(bug.failure.expected));
  line("captured", in_plain_numbers(bug.failure.captured));
  if (bug.failure.expected.empty() && bug.failure.captured.empty()) line("message", bug.failure.message);
  if (!bug.failure.calls.empty())
    out += fmt::format("   {}:\n", bug.is_reduced() ? "minimal program" : "case");
  for (const std::string& call : bug.failure.calls) out += "     " + one_line(call) + "\n";
  std::vector<std::string> tests(
      bug.tests.begin(),
      bug.tests.begin() + static_cast<std::ptrdiff_t>(verbose ? bug.tests.size()
                                                              : std::min(bug.tests.size(), kMostTestsOfBug)));
  if (tests.size() < bug.tests.size())
    tests.push_back(fmt::format("and {} more", bug.tests.size() - tests.size()));
  line("tests", join(tests, ", "));
  return out;
}

}  // namespace

std::string bug_list(const RunResult& record, const Catalogue& catalogue, bool colour, bool verbose) {
  std::set<std::string> explained;  // a recorded program may show several bugs
  for (const Bug& bug : record.bugs) explained.insert(bug.tests.begin(), bug.tests.end());
  std::string out =
      bold(fmt::format("{}: {} behind {}", record.heading("(unnamed)"),
                       count(record.bugs.size(), "distinct bug"), count(explained.size(), "failing test")),
           colour) +
      "\n";
  for (std::size_t i = 0; i < record.bugs.size(); ++i)
    out += "\n" + bug_text(record.bugs[i], i + 1, catalogue, colour, verbose);
  if (!record.bugs_note.empty()) out += "\nnote: " + one_line(record.bugs_note) + "\n";
  return out;
}

}  // namespace evalcts::reports
