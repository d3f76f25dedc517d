// Exact tangents and normals of a surface, from its jets.
#include <reference/normal.h>

#include <algorithm>
#include <stdexcept>

#include "jet.h"

namespace evalcts::reference {
namespace {

Vector operator/(Vector vector, const Rational& divisor) {
  for (Rational& component : vector) component /= divisor;
  return vector;
}

// Returns w^2, the factor by which cleared_tangents() are larger than the tangents; 1 for three components.
Rational cleared_factor(const std::vector<Jet>& jets) {
  if (jets.size() == 3) return 1;
  const Rational& w = jets[3].value;
  if (w.is_zero()) throw std::domain_error("w is zero: the surface has no point here");
  return w * w;
}

}  // namespace

Tangents tangents(VertexSurface surface, const Argument& u, const Argument& v) {
  const std::vector<Jet> jets = reference::jets(surface, u, v);
  const Rational factor = cleared_factor(jets);
  const Tangents cleared = cleared_tangents(jets);
  return {cleared.u / factor, cleared.v / factor};
}

Vector normal_vector(VertexSurface surface, const Argument& u, const Argument& v) {
  const std::vector<Jet> jets = reference::jets(surface, u, v);
  const Rational factor = cleared_factor(jets);
  const Tangents cleared = cleared_tangents(jets);
  return cross(cleared.u, cleared.v) / (factor * factor);
}

bool is_degenerate(const Vector& m) {
  return std::all_of(m.begin(), m.end(), [](const Rational& component) { return component.is_zero(); });
}

}  // namespace evalcts::reference
