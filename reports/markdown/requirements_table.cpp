// The Markdown table of requirements by record.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evalcts/reports.h"
#include "side_by_side.h"
#include "text.h"

namespace evalcts::reports {
namespace {

constexpr std::size_t kMostOfText = 100;  // columns of a requirement's text

struct Tally {
  std::size_t bad = 0, decided = 0;

  void add_violation() {
    ++bad;
    ++decided;
  }
  void add_pass() { ++decided; }
  std::string text() const {
    if (decided == 0) return "not observed";
    return bad == 0 ? "pass" : fmt::format("**{}** of {}", bad, decided);
  }
};

std::string table_head(const std::string& first, const std::vector<Column>& columns) {
  std::string head = "| " + first + " |", rule = "| --- |";
  for (const Column& column : columns) {
    head += " " + markdown_cell(column.label) + " |";
    rule += " --- |";
  }
  return head + "\n" + rule + "\n";
}

}  // namespace

std::string requirements_table(const std::vector<RunResult>& results, const Catalogue& catalogue) {
  const std::vector<Column> columns = label_columns(results);
  std::string out = "# Requirements by implementation\n\n";
  for (const Column& column : columns) {
    const ImplementationRecord& implementation = column.record.implementation;
    out += fmt::format("* {}: {}, {}\n", markdown_cell(column.label), markdown_cell(implementation.renderer),
                       markdown_cell(implementation.version));
  }

  std::map<std::string, std::vector<Tally>> tallies;
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const TestRecord& test : columns[i].record.tests) {
      const auto tally = [&](const RequirementId& id) -> Tally& {
        std::vector<Tally>& row = tallies[id.text()];
        row.resize(columns.size());
        return row[i];
      };
      const bool passes = test.verdict == Verdict::kPass || test.verdict == Verdict::kQualityWarning;
      for (const RequirementId& id : test.requirements) {
        Tally& of_row = tally(id);
        if (passes) of_row.add_pass();
      }
      for (const RequirementId& id : test.blamed()) tally(id).add_violation();
    }
  std::vector<std::string> violated;
  for (const auto& [id, row] : tallies)
    if (std::ranges::any_of(row, [](const Tally& tally) { return tally.bad > 0; })) violated.push_back(id);
  const auto place_of = [&](const std::string& id) {
    const Requirement* const requirement = catalogue.find(id);
    return requirement ? requirement->place : catalogue.requirements.size();
  };
  std::ranges::stable_sort(violated, {}, place_of);
  out += fmt::format(
      "\n## Violated requirements\n\n{} of {} requirements. Bold: tests that found a violation, of those "
      "that "
      "decided the requirement. Tests that fail because of another requirement are ignored.\n\n",
      violated.size(), tallies.size());
  out += table_head("requirement", columns);
  for (const std::string& id : violated) {
    const Requirement* const requirement = catalogue.find(id);
    out += fmt::format("| {}{} |", markdown_cell(id),
                       requirement ? ": " + markdown_cell(cut(requirement->text, kMostOfText)) : "");
    for (const Tally& tally : tallies[id]) out += " " + tally.text() + " |";
    out += "\n";
  }

  if (columns.size() < 2) return out;
  const std::vector<Row> rows = read_rows(columns);
  out +=
      "\n## Tests that do not have the same verdict everywhere\n\nTests that no implementation fails are "
      "left "
      "out.\n\n";
  out += table_head("test", columns);
  for (const Row& row : rows) {
    if (!row.differs() || !row.worst().is_bad()) continue;
    out += fmt::format("| {} |", markdown_cell(row.name));
    for (const TestRecord* outcome : row.outcomes)
      out += fmt::format(" {} |", outcome ? text_of(outcome->verdict).label : std::string_view("no test"));
    out += "\n";
  }
  return out;
}

}  // namespace evalcts::reports
