// Several records beside each other: columns are records, rows are tests.
#pragma once

#include <string>
#include <vector>

#include "reports/record.h"

namespace evalcts::reports {

// A record with a label that no other has: its name, and where several have that, where it comes from or
// which it is.
struct Column {
  Record record;
  std::string label;
};
// Throws FormatError.
std::vector<Column> read_columns(const std::vector<nlohmann::json>& results);

// One test across the records; null where a record does not have it.
struct Row {
  std::string name;
  std::vector<const TestResult*> outcomes;

  const TestResult& worst() const;
  // A record that lacks the test has no opinion.
  bool differs() const;
};
// In the order of first appearance. They point into the columns.
std::vector<Row> read_rows(const std::vector<Column>& columns);

}  // namespace evalcts::reports
