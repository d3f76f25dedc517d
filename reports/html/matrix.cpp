#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

// The tests of one requirement in one record.
struct Cell {
  std::size_t tests = 0;
  std::array<std::size_t, kVerdicts> counts{};
  std::array<const TestRecord*, kVerdicts> first{};
  const TestRecord* worst = nullptr;
  bool all_expected = true;  // of those that are bad

  void add(const TestRecord& test) {
    const auto verdict = static_cast<std::size_t>(test.verdict);
    ++tests;
    if (counts[verdict]++ == 0) first[verdict] = &test;
    if (test.is_bad() && !test.is_expected_failure()) all_expected = false;
    if (!worst || test.severity() < worst->severity()) worst = &test;
  }
  // The verdict on the requirement: what any test found bad, then a warning, then a pass; undecided only
  // where all tests are.
  Verdict verdict() const {
    if (worst->is_bad()) return worst->verdict;
    if (counts[static_cast<std::size_t>(Verdict::kQualityWarning)]) return Verdict::kQualityWarning;
    return counts[static_cast<std::size_t>(Verdict::kPass)] ? Verdict::kPass : worst->verdict;
  }
  const TestRecord& example() const {
    return worst->is_bad() ? *worst : *first[static_cast<std::size_t>(verdict())];
  }
  // Of how many tests this is, and what the rest is where that is not plain.
  std::string note() const {
    std::string out;
    const std::size_t n = counts[static_cast<std::size_t>(verdict())];
    if (n != tests) out = fmt::format("{} of {}", n, tests);
    if (worst->is_bad() && all_expected) out += out.empty() ? "expected" : ", expected";
    return out;
  }
};

struct Line {
  std::vector<Cell> cells;
  std::size_t tests = 0;
};

data cell_view(const Cell& cell) {
  data out;
  if (!cell.worst) {
    out.set("word", "absent");
    out.set("symbol", false);
    out.set("shown", "no test here");
    out.set("anchor", false);
    out.set("note", false);
    return out;
  }
  set_verdict(out, cell.verdict());
  out.set("shown", std::string(text_of(cell.verdict()).word));
  out.set("anchor", test_anchor(cell.example().name));
  out.set("note", optional_text(cell.note()));
  return out;
}

}  // namespace

Matrix matrix(const std::vector<Row>& rows, const std::vector<Column>& columns, const Catalogue& catalogue) {
  std::map<std::string, Line> lines;
  for (const Row& row : rows) {
    std::vector<std::string> seen;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!row.outcomes[i]) continue;
      for (const std::string& id : texts_of(row.outcomes[i]->requirements)) {
        Line& line = lines[id];
        line.cells.resize(columns.size());
        line.cells[i].add(*row.outcomes[i]);
        if (std::find(seen.begin(), seen.end(), id) != seen.end()) continue;
        seen.push_back(id);
        ++line.tests;
      }
    }
  }
  // In the order of the catalogue; the halves of one requirement follow one another.
  using Place = std::pair<std::size_t, std::string>;
  std::map<Place, const Line*> ordered;
  for (const auto& [id, line] : lines) {
    const Requirement* known = catalogue.find(id);
    ordered[{known ? known->place : std::numeric_limits<std::size_t>::max(), id}] = &line;
  }

  Matrix out;
  out.sections = list();
  data section_rows = list();
  std::string section;
  const auto close = [&] {
    if (!section_rows.is_non_empty_list()) return;
    data item;
    item.set("section", section);
    item.set("rows", section_rows);
    out.sections << item;
    section_rows = list();
  };
  for (const auto& [place, line] : ordered) {
    const std::string& id = place.second;
    const Requirement* known = catalogue.find(id);
    const Requirement requirement = known ? *known : Requirement{};
    const std::string its_section =
        requirement.section.empty() ? "Not in the catalogue" : requirement.section;
    if (its_section != section) close();
    section = its_section;
    data cells = list();
    for (const Cell& cell : line->cells) cells << cell_view(cell);
    data item;
    item.set("id", id);
    item.set("anchor", requirement_anchor(id));
    item.set("text", optional_text(requirement.text));
    item.set("source", optional_text(requirement.source));
    item.set("since", optional_text(requirement.since));
    item.set("tests", count(line->tests, "test"));
    item.set("cells", cells);
    section_rows << item;
    out.numbers.emplace(id, out.rows++);
  }
  close();
  return out;
}

}  // namespace evalcts::reports::view
