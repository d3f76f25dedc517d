// Arranges the tests and bugs of several records in rows.
#include "side_by_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "text.h"

namespace evalcts::reports {

std::vector<Column> label_columns(const std::vector<RunResult>& results) {
  std::vector<Column> columns;
  std::map<std::string, int> records;
  for (const RunResult& record : results) {
    const std::string name = record.heading("(unnamed)");
    ++records[name];
    columns.push_back({record, name});
  }
  std::set<std::string> used;
  for (Column& column : columns) {
    if (records[column.label] > 1 && !column.record.origin.empty())
      column.label += fmt::format(" ({})", one_line(column.record.origin));
    const std::string label = column.label;
    for (int n = 2; !used.insert(column.label).second; ++n) column.label = fmt::format("{} ({})", label, n);
  }
  return columns;
}

const TestRecord& Row::worst() const {
  const TestRecord* out = nullptr;
  for (const TestRecord* test : outcomes) {
    if (test && (!out || test->severity() < out->severity())) out = test;
  }
  return *out;
}

bool Row::differs() const {
  const Verdict verdict = worst().verdict;
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [verdict](const TestRecord* test) { return test && test->verdict != verdict; });
}

std::vector<Row> read_rows(const std::vector<Column>& columns) {
  std::vector<Row> rows;
  std::map<std::string, std::size_t> index;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    for (const TestRecord& test : columns[column].record.tests) {
      const auto [it, inserted] = index.emplace(test.name, rows.size());
      if (inserted) rows.push_back({test.name, std::vector<const TestRecord*>(columns.size(), nullptr)});
      rows[it->second].outcomes[column] = &test;
    }
  }
  return rows;
}

std::vector<BugRow> read_bugs(const std::vector<Column>& columns) {
  std::map<std::string, std::vector<const Bug*>> by_id;
  std::vector<Bug> merged;
  std::map<std::string, std::size_t> place;
  for (std::size_t column = 0; column < columns.size(); ++column)
    for (const Bug& bug : columns[column].record.bugs) {
      std::vector<const Bug*>& found = by_id[bug.id];
      if (found.empty()) {
        place[bug.id] = merged.size();
        merged.push_back(bug);
      }
      found.resize(columns.size());
      found[column] = &bug;
      std::vector<std::string>& tests = merged[place[bug.id]].tests;
      tests.insert(tests.end(), bug.tests.begin(), bug.tests.end());
    }
  for (Bug& bug : merged) {
    std::sort(bug.tests.begin(), bug.tests.end());
    bug.tests.erase(std::unique(bug.tests.begin(), bug.tests.end()), bug.tests.end());
  }
  sort_by_importance(merged);
  std::vector<BugRow> rows;
  for (Bug& bug : merged) {
    std::vector<const Bug*>& found = by_id[bug.id];
    rows.push_back({std::move(bug), std::move(found)});
  }
  return rows;
}

}  // namespace evalcts::reports
