// Several records side by side: columns are records, rows are tests or bugs.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// A record, which has to outlive the column, with a unique label: its name, followed by its origin if several
// records have this name, and by a number if that is not unique either.
struct Column {
  const RunResult& record;
  std::string label;
};
std::vector<Column> label_columns(const std::vector<RunResult>& results);

// One test across the records; the outcome is null if a record does not have the test.
struct Row {
  std::string name;
  std::vector<const TestRecord*> outcomes;

  const TestRecord& worst() const;
  // Returns true if the verdicts differ. Records without the test do not count.
  bool differs() const;
};
// Returns the rows in the order of first appearance. They point into the columns.
std::vector<Row> read_rows(const std::vector<Column>& columns);

// One bug across the records; `found` is null if a record does not have the bug. `bug` is that of the first
// record which has it, with the tests of all records.
struct BugRow {
  Bug bug;
  std::vector<const Bug*> found;
};
// Returns the bugs, most important first. They point into the columns.
std::vector<BugRow> read_bugs(const std::vector<Column>& columns);

}  // namespace evalcts::reports
