// Verdict on the accuracy of a library in one line.
#pragma once

#include <string>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// Returns "as good as single precision for 15 of 17 targets; not for MAP1_COLOR_4, AUTO_NORMAL", by the tests
// of level quality about the accuracy of values and normals; empty if none of them decided anything.
std::string single_precision_in_words(const RunResult& record);

}  // namespace evalcts::reports
