// Writes the summary in Markdown for a pull request.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/results/conclusion.h>
#include "comparison.h"
#include "evalcts/reports.h"
#include "quality.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kMostTests = 10;     // tests of each kind of change and of each record
constexpr std::size_t kMostOfLine = 2000;  // columns of a command or of a conclusion

std::string counts_table(const std::vector<Column>& columns) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < kVerdicts; ++i)
    for (const Column& column : columns)
      if (column.record.counts[i]) {
        verdicts.push_back(static_cast<Verdict>(i));
        break;
      }
  std::string out = "| | unexpected | tests |", rule = "| --- | --: | --: |";
  for (const Verdict verdict : verdicts) {
    out += fmt::format(" {} |", text_of(verdict).label);
    rule += " --: |";
  }
  out += "\n" + rule + "\n";
  for (const Column& column : columns) {
    const RunResult& record = column.record;
    const std::uint64_t unexpected = record.unexpected_count();
    out += fmt::format("| {} | {} | {} |", markdown_cell(column.label),
                       unexpected ? fmt::format("**{}**", unexpected) : "0", record.total());
    for (const Verdict verdict : verdicts)
      out += fmt::format(" {} |", record.counts[static_cast<std::size_t>(verdict)]);
    out += "\n";
  }
  return out + "\n";
}

// Returns a line with the conclusion of the run, and a line about the implementation that was judged.
std::string about(const Column& column) {
  const RunResult& record = column.record;
  const ImplementationRecord& implementation = record.implementation;
  std::vector<std::string> parts;
  for (const std::string* part : {&implementation.vendor, &implementation.renderer, &implementation.version})
    if (!part->empty()) parts.push_back(markdown_code(*part));
  if (!implementation.context_library.empty())
    parts.push_back("contexts of " + markdown_code(implementation.context_library));
  if (!implementation.note.empty()) parts.push_back("**note**: " + markdown_code(implementation.note));
  for (const std::string& quality : quality_in_words(record)) parts.push_back(markdown_code(quality));
  return fmt::format("* {}: {}\n", markdown_code(column.label),
                     markdown_code(conclusion_of(record).text, kMostOfLine)) +
         (parts.empty() ? "" : fmt::format("  * {}\n", join(parts, ", ")));
}

std::string changes_of(const Comparison& pair) {
  std::string out = fmt::format("* {}: {}\n", markdown_code(pair.label), pair.headline());
  for (const std::string& caveat : pair.caveats) out += "  * " + markdown_code(caveat) + "\n";
  // The headline has the numbers of the other kinds, and the page lists them.
  for (const ChangeKind kind : {ChangeKind::kRegression, ChangeKind::kNewFailure, ChangeKind::kFix}) {
    std::size_t told = 0;
    for (const Change& change : pair.changes) {
      if (change.kind != kind || ++told > kMostTests) continue;
      out += fmt::format("  * {}: {}, {}\n", text_of(kind).word, markdown_code(change.now->name),
                         markdown_code(words_of(change)));
    }
    if (told > kMostTests) out += fmt::format("  * and {} more\n", told - kMostTests);
  }
  return out;
}

std::string failures_of(const Column& column) {
  std::vector<const TestRecord*> tests;
  for (const TestRecord& test : column.record.tests)
    if (test.is_unexpected()) tests.push_back(&test);
  std::stable_sort(tests.begin(), tests.end(),
                   [](const TestRecord* a, const TestRecord* b) { return a->severity() < b->severity(); });
  std::string out;
  for (std::size_t i = 0; i < tests.size() && i < kMostTests; ++i) {
    const TestRecord& test = *tests[i];
    out += fmt::format(
        "* {}: {} {}", markdown_code(column.label),
        test.is_unexpected_pass() ? std::string_view("unexpected pass") : text_of(test.verdict).label,
        markdown_code(test.name));
    if (!test.message.empty()) out += ": " + markdown_code(test.message);
    out += "\n";
    if (!test.rerun.empty())
      out += fmt::format("  * run just this test: {}\n", markdown_code(test.rerun, kMostOfLine));
  }
  if (tests.size() > kMostTests)
    out += fmt::format("* {}: and {} more\n", markdown_code(column.label), tests.size() - kMostTests);
  return out;
}

// Returns the distinct bugs of one record, most important first.
std::string bugs_of(const Column& column) {
  const RunResult& record = column.record;
  if (record.bugs.empty()) return {};
  std::string out = fmt::format(
      "\n{}: {}\n\n| bug | level | verdict | tests | unexpected | requirement | known in | ID |\n"
      "| --- | --- | --- | --: | --: | --- | --- | --- |\n",
      markdown_code(column.label), count(record.bugs.size(), "distinct bug"));
  for (const Bug& bug : record.bugs) {
    const auto unexpected = std::ranges::count_if(record.tests, [&](const TestRecord& test) {
      return test.is_bad() && test.is_unexpected() && std::ranges::binary_search(bug.tests, test.name);
    });
    const std::string requirement = bug.requirements.empty() ? "" : bug.requirements.front().text();
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(bug.title),
                       name_of(bug.level), text_of(bug.verdict).label, bug.tests.size(), unexpected,
                       markdown_cell(requirement), bug.known_in.empty() ? "" : markdown_cell(bug.known_in),
                       markdown_cell(bug.id));
  }
  if (!record.bugs_note.empty()) out += "\n" + markdown_code(record.bugs_note, kMostOfLine) + "\n";
  return out;
}

}  // namespace

std::string markdown_summary(const std::vector<RunResult>& results, const std::vector<RunResult>& before) {
  const std::vector<Column> columns = label_columns(results), earlier = label_columns(before);
  std::string out = "## OpenGL evaluators: conformance\n\n";
  if (columns.empty()) return out + "No results.\n";
  out += counts_table(columns);
  for (const Column& column : columns) out += about(column);

  if (!before.empty()) {
    const Comparisons comparisons = compare(columns, earlier);
    out += "\n### Changes\n\n";
    for (const Comparison& pair : comparisons.pairs) out += changes_of(pair);
    for (const std::string& label : comparisons.only_now)
      out += fmt::format("* {}: not in the earlier results\n", markdown_code(label));
    for (const std::string& label : comparisons.only_before)
      out += fmt::format("* {}: only in the earlier results\n", markdown_code(label));
  }

  std::string bugs;
  for (const Column& column : columns) bugs += bugs_of(column);
  if (!bugs.empty()) out += "\n### Bugs\n" + bugs;

  std::string failures;
  for (const Column& column : columns) failures += failures_of(column);
  if (!failures.empty()) out += "\n### Unexpected\n\n" + failures;
  return out;
}

}  // namespace evalcts::reports
