// Verdicts of the tests of level quality, in one line each.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// Returns "as good as single precision for 15 of 17 targets; not for MAP1_COLOR_4, AUTO_NORMAL", by the tests
// of level quality about the accuracy of values and normals; empty if none of them decided anything.
std::string single_precision_in_words(const RunResult& record);

// Returns "not bit-identical: EvalPoint and EvalMesh (2 tests), AUTO_NORMAL on and off (4 tests)", by the
// tests of level quality that require equal bits where commands are equivalent; empty if none of them warns.
std::string equal_bits_in_words(const RunResult& record);

// Returns "memory grows by 4112 bytes with each Map1f", by the tests of level quality that measure it; empty
// if none of them warns.
std::string memory_in_words(const RunResult& record);

// Returns those of the texts above that are not empty.
std::vector<std::string> quality_in_words(const RunResult& record);

}  // namespace evalcts::reports
