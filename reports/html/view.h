// Makes the parts of the page that need no script: the data for index.mustache, as strings in the order of
// the page. Mustache looks up a missing name in the enclosing sections, so every name that a section uses is
// set in it, to false if there is nothing to show.
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

// Returns the text, or false if it is empty: an empty string would show the section in Mustache.
inline data optional_text(const std::string& text) { return text.empty() ? data(false) : data(text); }

// Sets "name" and "symbol" of `out`.
void set_verdict(data& out, Verdict verdict);

// Returns the CSS class of a verdict, not considering the baseline: "bad", "notice", "good" or "none".
const char* class_of(Verdict verdict);

// Adds a row "term", "value", "code" of a list of definitions, unless the value is empty.
void add_row(data& rows, const char* term, const std::string& value, bool code = false);

// Returns a fragment of the address with these names and values, as js/state.js reads it.
std::string link(const std::vector<std::pair<std::string, std::string>>& state);
std::string link_to_test(const std::string& name);
// Returns the address of a file relative to the page.
std::string link_to_file(const std::string& path);

// Returns the share of the measured values that are not correctly rounded: "20 % (96)".
std::string share(const Accuracy& accuracy);

// Returns the table of counts: "verdicts", its header, and "rows", one for each column. The first `current`
// columns are current results; the earlier results follow.
data overview(const std::vector<Column>& columns, std::size_t current, const Comparisons& compared);

// Returns the distinct bugs, which the page shows without scripts.
data bugs(const std::vector<Column>& columns);

// Returns the facts about the run of one record: the library, the time, the options and so on. files: paths
// relative to the page, to which it links.
data card(const Column& column, const std::vector<std::string>& files);

// Returns one row for each ambiguous passage of which an implementation has shown its reading.
data readings(const std::vector<Column>& columns, const Catalogue& catalogue);

}  // namespace evalcts::reports::view
