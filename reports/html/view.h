// The parts of the page's view model: what index.mustache shows, as strings in the order in which it shows
// them. Mustache looks up a missing name in the enclosing sections, so every name a section uses is set in
// it, if only to false.
#pragma once

#include <kainjow/mustache.hpp>
#include <map>
#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include <evalcts/results/run_result.h>
#include "comparison.h"
#include "side_by_side.h"

namespace evalcts::reports::view {

using kainjow::mustache::data;

inline data list() { return data(data::type::list); }

// Absent is false: in Mustache an empty string counts as there.
inline data optional_text(const std::string& text) { return text.empty() ? data(false) : data(text); }

// "word" and "symbol".
void set_verdict(data& out, Verdict verdict);

// "name", and "name_html": the same, escaped, with places where a line may break.
void set_name(data& out, const std::string& name);

// A row "term", "value", "code" of a list of definitions; none where the value is empty.
void add_row(data& rows, const char* term, const std::string& value, bool code = false);

// Ids that need no escaping in a fragment; different names give different ids.
std::string test_anchor(const std::string& name);
std::string requirement_anchor(const std::string& id);

// Of the values that were measured, those that are not correctly rounded: "20 % (96)".
std::string share(const Accuracy& accuracy);

// "expected", "unexpected", or nothing.
std::string baseline_note(const TestRecord& test);

// The summary of one record.
data card(const Column& column);

// Requirement by implementation: sections with rows of cells, in the order of the catalogue, what is not in
// it at the end.
struct Matrix {
  data sections;
  std::size_t rows = 0;
  std::map<std::string, std::size_t> numbers;  // of the rows, in order, by requirement
};
Matrix matrix(const std::vector<Row>& rows, const std::vector<Column>& columns, const Catalogue& catalogue);

// A test with its evidence from each record. `changes`: what has happened to it since the earlier results, in
// the order of the columns; null where nothing has.
data test(const Row& row, const std::vector<const Change*>& changes, const std::vector<Column>& columns,
          const Catalogue& catalogue, const Matrix& matrix);

// One entry for each pair of records that was compared.
data comparisons(const Comparisons& comparisons);

// One row for each ambiguous text on which an implementation has shown its reading.
data readings(const std::vector<Column>& columns, const Catalogue& catalogue);

}  // namespace evalcts::reports::view
