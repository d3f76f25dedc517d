// The parts of the page that stand in it as they are, with and without scripts: what index.mustache shows, as
// strings in the order in which it shows them. Mustache looks up a missing name in the enclosing sections, so
// every name a section uses is set in it, if only to false.
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

// The class that colours a verdict if nothing is known of it: "bad", "notice", "good" or "none".
const char* class_of(Verdict verdict);

// A row "term", "value", "code" of a list of definitions; none where the value is empty.
void add_row(data& rows, const char* term, const std::string& value, bool code = false);

// Fragments of the address, as js/state.js reads them: each name with its value.
std::string link(const std::vector<std::pair<std::string, std::string>>& state);
std::string link_to_test(const std::string& name);

// The share of measured values that are not correctly rounded: "20 % (96)".
std::string share(const Accuracy& accuracy);

// The table of counts: "verdicts", the header, and "rows", one for each column. The first `current` columns
// are compared with the earlier results after them.
data overview(const std::vector<Column>& columns, std::size_t current, const Comparisons& compared);

// The distinct bugs, for a reader without scripts.
data bugs(const std::vector<Column>& columns);

// The circumstances of one record.
data card(const Column& column);

// One row for each ambiguous text on which an implementation has shown its reading.
data readings(const std::vector<Column>& columns, const Catalogue& catalogue);

}  // namespace evalcts::reports::view
