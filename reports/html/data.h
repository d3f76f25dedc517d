// The data in the page: what its script renders on demand. page.js reads it back.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include "comparison.h"
#include "side_by_side.h"

namespace evalcts::reports {

// Returns JSON text that may stand in a script element. Each string and each record, failure and list of
// commands stands in it once and is referred to by its number, so that implementations which agree cost
// little.
//
// earlier: of the columns, the number of those at the end that are earlier results. comparisons: between any
// of the columns. since: those with earlier results.
std::string page_data(const std::vector<Column>& columns, std::size_t earlier, const std::vector<Row>& rows,
                      const Catalogue& catalogue, const std::vector<Comparison>& comparisons,
                      const Comparisons& since);

}  // namespace evalcts::reports
