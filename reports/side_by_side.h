// Several records beside each other: columns are records, rows are tests.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// A record, which has to live as long, with a label that no other has: its name, and if several have that,
// its origin or its number.
struct Column {
  const RunResult& record;
  std::string label;
};
std::vector<Column> label_columns(const std::vector<RunResult>& results);

// One test across the records; null where a record does not have it.
struct Row {
  std::string name;
  std::vector<const TestRecord*> outcomes;

  const TestRecord& worst() const;
  // A record that lacks the test has no opinion.
  bool differs() const;
};
// Returns the rows in the order of first appearance. They point into the columns.
std::vector<Row> read_rows(const std::vector<Column>& columns);

// One bug across the records; null where a record does not have it. `bug` is the first of them, with the
// tests of all.
struct BugRow {
  Bug bug;
  std::vector<const Bug*> found;
};
// Most important first. They point into the columns.
std::vector<BugRow> read_bugs(const std::vector<Column>& columns);

}  // namespace evalcts::reports
