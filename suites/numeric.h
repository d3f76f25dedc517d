// Constants, deliveries and checks for the tests about particular values (numeric.cpp, unrelated_state.cpp).
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "grid_cases.h"

namespace evalcts::suite_numeric {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Domains. Some have ends that are not exact in single precision, or a width that is rounded.
inline constexpr Interval kDomains[] = {{0, 1},       {2, 5},         {1, -3},
                                        {0.1f, 0.7f}, {-1e-3f, 1e5f}, {1000, 1000.25}};

// Return the deliveries of cases with curves, with surfaces, and with curves that are not lifted to surfaces.
// Forms with arrays of arguments are not among them, because they have a requirement of their own (EV-API-V),
// nor are repeated lists.
std::vector<gl::Delivery> of_curves();
std::vector<gl::Delivery> of_surfaces();
std::vector<gl::Delivery> in_one_dimension();

bool same_bits(float a, float b);

void fail(Test& t, const gl::Case& c, const std::string& what, const std::string& why, float expected,
          float got);

// Fails for each value of the attributes in which two vertices of the same index differ, -0 counting as +0.
// `got` has at least as many vertices as `expected`; `name(i)` describes vertex i, `why` the expected value.
void expect_same(Test& t, const gl::Case& c, std::span<const ObservedVertex> expected,
                 std::span<const ObservedVertex> got, Attributes attributes, const std::string& why,
                 const std::function<std::string(std::size_t)>& name);

// Defines and enables a random map of each target. The domain and the order hold for u and v.
void define_random(Test& t, gl::Case& c, const Kinds& kinds, int order, const Interval& domain);

void evaluate_at(gl::Case& c, bool two, double u);

}  // namespace evalcts::suite_numeric
