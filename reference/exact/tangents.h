// Tangents of a vertex map at one point, before the division by w.
#pragma once

#include <reference/normal.h>

#include <vector>

namespace evalcts::reference {

// Returns the jet of each component. Throws the exceptions of normal.h.
std::vector<Jet> vertex_jets(VertexSurface surface, const Argument& u, const Argument& v);

// The vectors a = p_u and b = p_v; for four components, a = w * p_u - w_u * p, which is w^2 * q_u, and b
// likewise.
struct Tangents {
  Vector a, b;
};
Tangents cleared_tangents(const std::vector<Jet>& jets);

Vector cross(const Vector& a, const Vector& b);

}  // namespace evalcts::reference
