// Value and first derivatives of several maps at one point.
#pragma once

#include <reference/normal.h>

#include <vector>

namespace evalcts::reference {

// A value and its derivatives with respect to the normalised coordinates.
struct Jet {
  Rational value, u, v;
};

// Returns the jet of each component. Throws the exceptions of normal.h.
std::vector<Jet> jets(VertexSurface surface, const Argument& u, const Argument& v);

// Returns a = p_u and b = p_v; for four components, a = w * p_u - w_u * p, which is w^2 * q_u, and b
// likewise.
Tangents cleared_tangents(const std::vector<Jet>& jets);

Vector cross(const Vector& a, const Vector& b);

}  // namespace evalcts::reference
