// The data in the page, which its script (js/model.js) reads and renders on demand.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include "comparison.h"
#include "side_by_side.h"

namespace evalcts::reports {

// Returns JSON text that is safe within a script element. Each string, record, failure and list of commands
// occurs once and is referred to by its number, so that implementations with equal results need little space.
//
// earlier: the number of columns, at the end, that are earlier results. comparisons: those of each current
// column with each other column. since: the pairs of current and earlier results. sources: see PageOptions.
std::string page_data(const std::vector<Column>& columns, std::size_t earlier, const std::vector<Row>& rows,
                      const Catalogue& catalogue, const std::vector<Comparison>& comparisons,
                      const Comparisons& since, const std::string& sources);

}  // namespace evalcts::reports
