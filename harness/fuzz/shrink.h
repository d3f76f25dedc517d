// Makes a program that shows a bug small enough to debug.
#pragma once

#include <functional>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::fuzz {

// The interestingness test of delta debugging: returns true if a candidate still shows the difference.
using InterestingnessTest = std::function<bool(const gl::Case&)>;

// Returns a smaller program that is interesting, as `program` must be. Removes commands,
// lowers orders and counts, and replaces values by 0, 1 and small integers, until no change succeeds or
// is_interesting() has been called `most` times. Calls `smaller` with each smaller program.
gl::Case shrink(const gl::Case& program, const InterestingnessTest& is_interesting, int most,
                const std::function<void(const gl::Case&)>& smaller = {});

// Returns the program itself and two plainer forms, which are likely to have the same cause: with EvalCoordf
// and points only, and the same in one dimension.
std::vector<gl::Case> forms_of(const gl::Case& program);

}  // namespace evalcts::fuzz
