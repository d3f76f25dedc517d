// The arguments that are hardest to round, found by trying all.
#pragma once

#include <reference/bernstein.h>

#include <vector>

namespace evalcts::vectors {

// Returns the binary32 in [low, high), 0 < low, at which the curve, whose values are normal binary32 there,
// lies nearest to the middle of two binary32, beginning with the nearest; values in the middle itself are
// left out. `count` of them, or fewer where fewer are within 2^-18 of the distance of the two. Takes some 10
// ns for each argument tried.
std::vector<float> hardest_arguments(const reference::Curve& curve, float low, float high, std::size_t count);

}  // namespace evalcts::vectors
