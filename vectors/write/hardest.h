// Finds the arguments whose values are hardest to round by exhaustive search.
#pragma once

#include <reference/bernstein.h>

#include <vector>

namespace evalcts::vectors {

// Returns the arguments, among the binary32 in [low, high), 0 < low, whose exact values are nearest to a
// midpoint of two binary32 but not equal to it, the nearest first. Returns at most `count`, all within 2^-18
// of the gap between the two numbers. The values have to be in the range of normal binary32. Takes some 10 ns
// for each argument.
std::vector<float> hardest_arguments(const reference::Curve& curve, float low, float high, std::size_t count);

}  // namespace evalcts::vectors
