// Exact derivatives and normals, from differences of the control values.
#include <reference/normal.h>

#include <algorithm>
#include <stdexcept>

#include "homogeneous.h"
#include "tangents.h"

namespace evalcts::reference {
namespace {

// The weights of a map in one direction, and of its derivative: that of a Bernstein sum of degree n is n
// times a sum of degree n - 1 over the differences.
struct Basis {
  Basis(const Direction& direction, const Argument& u) : degree(direction.order - 1) {
    const Homogeneous t = homogenise(u, direction);
    value = bernstein_weights(t, degree);
    if (degree > 0) derivative = bernstein_weights(t, degree - 1);
  }

  int degree;
  Weights value, derivative;
};

Jet jet(const Net& net, const Basis& u, const Basis& v) {
  return {bernstein_sum(net, u.value, v.value),
          u.degree == 0 ? 0 : u.degree * bernstein_sum(neighbours_u(net, -1), u.derivative, v.value),
          v.degree == 0 ? 0 : v.degree * bernstein_sum(neighbours_v(net, -1), u.value, v.derivative)};
}

// Returns w^4, the factor by which the product of cleared_tangents() is larger; 1 for three components.
Rational cleared_factor(const std::vector<Jet>& jets) {
  if (jets.size() == 3) return 1;
  const Rational& w = jets[3].value;
  if (w.is_zero()) throw std::domain_error("w is zero: the surface has no point here");
  return pow(w, 4);
}

bool are_same(const Direction& a, const Direction& b) {
  return a.order == b.order && a.first == b.first && a.last == b.last;
}

}  // namespace

Jet jet(const Surface& surface, const Argument& u, const Argument& v) {
  check(surface, u, v);
  return jet(integer_net(surface), Basis(surface.u, u), Basis(surface.v, v));
}

std::vector<Jet> vertex_jets(VertexSurface surface, const Argument& u, const Argument& v) {
  if (surface.size() != 3 && surface.size() != 4)
    throw std::invalid_argument("a vertex has three or four components");
  const Surface& first = surface.front();
  for (const Surface& component : surface) {
    if (!are_same(component.u, first.u) || !are_same(component.v, first.v))
      throw std::invalid_argument("the components of a vertex are of the same orders over the same domain");
    check(component, u, v);
  }
  const Basis along_u(first.u, u), along_v(first.v, v);  // shared by all components
  std::vector<Jet> jets;
  for (const Surface& component : surface) jets.push_back(jet(integer_net(component), along_u, along_v));
  return jets;
}

Tangents cleared_tangents(const std::vector<Jet>& jets) {
  Tangents result;
  for (int c = 0; c < 3; ++c) {
    const Jet& p = jets[c];
    if (jets.size() == 3) {
      result.a[c] = p.u;
      result.b[c] = p.v;
    } else {
      const Jet& w = jets[3];
      result.a[c] = w.value * p.u - w.u * p.value;
      result.b[c] = w.value * p.v - w.v * p.value;
    }
  }
  return result;
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector normal_vector(VertexSurface surface, const Argument& u, const Argument& v) {
  const std::vector<Jet> jets = vertex_jets(surface, u, v);
  const Rational factor = cleared_factor(jets);
  const Tangents tangents = cleared_tangents(jets);
  Vector m = cross(tangents.a, tangents.b);
  for (Rational& component : m) component /= factor;
  return m;
}

bool is_degenerate(const Vector& m) { return std::ranges::all_of(m, &Rational::is_zero); }

}  // namespace evalcts::reference
