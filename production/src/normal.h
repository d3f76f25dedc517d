// The normal of a surface in homogeneous coordinates.
#pragma once

#include <array>

namespace glev {

// The unit vector along q_u x q_v with q = (x, y, z) / w: for p = (x, y, z, w) and its derivatives, each up
// to a positive factor. Scales on the way, so that the size of a surface does not matter. (0,0,0) where the
// product is zero or not finite.
std::array<double, 3> UnitNormal(std::array<double, 4> p, std::array<double, 4> p_u,
                                 std::array<double, 4> p_v);

}  // namespace glev
