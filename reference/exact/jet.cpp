// Exact values and first derivatives of all components of a surface, which share the weights of a point.
#include "jet.h"

#include <stdexcept>

#include "homogeneous.h"

namespace evalcts::reference {
namespace {

using Integers = std::vector<Integer>;

// Returns C(n,i) * a^i * b^(n-i), which is c^n times the Bernstein polynomials.
Integers bernstein_weights(const Homogeneous& t, int n) {
  Integers weights(n + 1);
  Integer power = 1;
  for (int i = 0; i <= n; ++i) {
    weights[i] = power * binomial(n, i);
    power *= t.a;
  }
  power = 1;
  for (int i = n; i >= 0; --i) {
    weights[i] *= power;
    power *= t.b;
  }
  return weights;
}

Integer dot(const Integers& weights, const Integer* values) {
  Integer sum = 0;
  for (const Integer& weight : weights) sum += weight * *values++;
  return sum;
}

Integers differences(const Integer* values, int count) {
  Integers result(count - 1);
  for (int i = 0; i + 1 < count; ++i) result[i] = values[i + 1] - values[i];
  return result;
}

// The weights of a map of degree n and of its derivative, with their common denominators c^n and c^(n-1).
struct Basis {
  int degree;
  Integers value, derivative;
  Integer value_denominator, derivative_denominator;

  Basis(const Homogeneous& t, int n)
      : degree(n), value(bernstein_weights(t, n)), value_denominator(1), derivative_denominator(1) {
    if (n == 0) return;
    derivative = bernstein_weights(t, n - 1);
    for (Integer& weight : derivative) weight *= n;
    derivative_denominator = pow(t.c, static_cast<unsigned>(n - 1));
    value_denominator = derivative_denominator * t.c;
  }
};

void check(VertexSurface surface) {
  if (surface.size() != 3 && surface.size() != 4) {
    throw std::invalid_argument("a vertex has three or four components");
  }
  const Surface& first = surface.front();
  for (const Surface& s : surface) {
    if (s.uorder != first.uorder || s.vorder != first.vorder || s.u1 != first.u1 || s.u2 != first.u2 ||
        s.v1 != first.v1 || s.v2 != first.v2) {
      throw std::invalid_argument("the components of a vertex are of the same orders over the same domain");
    }
  }
}

}  // namespace

std::vector<Jet> jets(VertexSurface surface, const Argument& u, const Argument& v) {
  check(surface);
  std::vector<Net> nets;
  for (const Surface& component : surface) nets.push_back(integer_net(component));
  const Surface& first = surface.front();
  const Basis along_u(homogenise(u, first.u1, first.u2), first.uorder - 1);
  const Basis along_v(homogenise(v, first.v1, first.v2), first.vorder - 1);

  std::vector<Jet> result;
  for (const Net& net : nets) {
    // Evaluation along v leaves two curves along u: the values, and the derivatives in v.
    Integers values, derivatives;
    for (int i = 0; i < net.rows; ++i) {
      const Integer* row = &net.values[static_cast<std::size_t>(i) * net.columns];
      values.push_back(dot(along_v.value, row));
      derivatives.push_back(dot(along_v.derivative, differences(row, net.columns).data()));
    }
    const Integer value = dot(along_u.value, values.data());
    const Integer by_u = dot(along_u.derivative, differences(values.data(), net.rows).data());
    const Integer by_v = dot(along_u.value, derivatives.data());
    result.push_back(
        {Rational(value, along_u.value_denominator * along_v.value_denominator, net.exponent),
         Rational(by_u, along_u.derivative_denominator * along_v.value_denominator, net.exponent),
         Rational(by_v, along_u.value_denominator * along_v.derivative_denominator, net.exponent)});
  }
  return result;
}

Tangents cleared_tangents(const std::vector<Jet>& jets) {
  Tangents result;
  for (int c = 0; c < 3; ++c) {
    const Jet& p = jets[c];
    if (jets.size() == 3) {
      result.u[c] = p.u;
      result.v[c] = p.v;
    } else {
      const Jet& w = jets[3];
      result.u[c] = w.value * p.u - w.u * p.value;
      result.v[c] = w.value * p.v - w.v * p.value;
    }
  }
  return result;
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace evalcts::reference
