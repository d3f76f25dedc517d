// Makes a program that shows a defect small enough to debug.
#pragma once

#include <functional>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::fuzz {

// The smallest program found for which `still` holds, as it does for `program`: commands removed, sizes,
// orders and counts lowered, values moved towards 0, 1 and small integers, until none of this can go on or
// `still` has been asked `most` times. `smaller` is called with each success.
gl::Case shrink(const gl::Case& program, const std::function<bool(const gl::Case&)>& still, int most,
                const std::function<void(const gl::Case&)>& smaller = {});

// The program itself, and with all commands in plainer forms, in which the same cause is likely to show: only
// EvalCoordf and points; all that in one dimension.
std::vector<gl::Case> forms_of(const gl::Case& program);

}  // namespace evalcts::fuzz
