// Bernstein sums over integers. With t = a/c and 1 - t = b/c the value of a map is
//
//   SUM C(n,i) * a^i * b^(n-i) * R_i / c^n,
//
// and with a, b, c and the control values scaled to integers the sum is an integer: no fraction is ever
// reduced.
#pragma once

#include <reference/bernstein.h>

#include <cstdint>
#include <vector>

namespace evalcts::reference {

// Throws the exceptions of bernstein.h.
void check(const Surface& surface, const Argument& u = {}, const Argument& v = {});

// Returns C(n,i) for 0 <= i <= n < kMaxOrder.
std::uint64_t binomial(int n, int i);

// t = a/c and s = b/c, c > 0. For a Bernstein sum s = 1 - t; the acceptance bound needs other pairs too.
struct Homogeneous {
  Integer a, b, c;
};

// Returns the normalised coordinate of u in the domain of a direction. Both must be valid, see check().
Homogeneous homogenise(const Argument& u, const Direction& direction);

// Returns t and s, both >= 0, over a common denominator.
Homogeneous homogenise(const Rational& t, const Rational& s);

// C(n,i) * a^i * b^(n-i) for i = 0..n, which is c^n times the Bernstein polynomials.
struct Weights {
  std::vector<Integer> values;
  Integer denominator;  // c^n
};
Weights bernstein_weights(const Homogeneous& t, int n);

// The control values of a map as integers: R_ij = values[i * columns + j] * 2^exponent.
struct Net {
  int rows, columns;
  std::vector<Integer> values;
  std::int64_t exponent;
};
Net integer_net(const Surface& surface);

// Return the net of |R_ij|, and the weights without their signs.
Net magnitudes(Net net);
Weights magnitudes(Weights weights);

// Return the net of R_(i+1)j + sign * R_ij, and of R_i(j+1) + sign * R_ij.
Net neighbours_u(const Net& net, int sign);
Net neighbours_v(const Net& net, int sign);

// Returns SUM u_i * v_j * R_ij, divided by both denominators.
Rational bernstein_sum(const Net& net, const Weights& u, const Weights& v);

}  // namespace evalcts::reference
