// Several records beside each other: columns are records, rows are tests.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// A record with a label that no other has: its name, and where several have that, where it comes from or
// which it is.
struct Column {
  RunResult record;
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
// In the order of first appearance. They point into the columns.
std::vector<Row> read_rows(const std::vector<Column>& columns);

}  // namespace evalcts::reports
