// Value and first derivatives of several maps at one point.
#pragma once

#include <reference/normal.h>

#include <vector>

namespace evalcts::reference {

// The derivatives are those with respect to the normalised coordinates.
struct Jet {
  Rational value, u, v;
};

// Of each component. Throws as the functions of normal.h do.
std::vector<Jet> jets(VertexSurface surface, const Argument& u, const Argument& v);

// a = p_u and b = p_v; for four components a = w * p_u - w_u * p, which is w^2 * q_u, and b likewise.
Tangents cleared_tangents(const std::vector<Jet>& jets);

Vector cross(const Vector& a, const Vector& b);

}  // namespace evalcts::reference
