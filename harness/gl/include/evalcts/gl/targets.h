// Lists of the targets of maps and of the capabilities of evaluators.
#pragma once

#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts::gl {

// Returns all 18 targets of maps, the one-dimensional ones first.
const std::vector<GLenum>& all_targets();
// Returns all 18 targets and AUTO_NORMAL: the evaluator capabilities of Enable.
const std::vector<GLenum>& all_caps();

}  // namespace evalcts::gl
