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

// t = a/c and s = b/c, c > 0. For a Bernstein sum s = 1 - t; the acceptance bound needs other pairs too.
struct Homogeneous {
  Integer a, b, c;
};

// Returns the normalised coordinate of u in the domain. Throws std::domain_error if u1 = u2 or a number is
// not finite.
Homogeneous homogenise(const Argument& u, double u1, double u2);

// Returns t and s, both >= 0, over a common denominator.
Homogeneous homogenise(const Rational& t, const Rational& s);

// The control values of a curve (columns = 1) or surface as integers: R_ij = values[i * columns + j] *
// 2^exponent.
struct Net {
  int rows, columns;
  std::vector<Integer> values;
  std::int64_t exponent;
};

// Return the control values as integers. Throw std::invalid_argument for an invalid order, std::domain_error
// for a non-finite control value.
Net integer_net(const Curve& curve);
Net integer_net(const Surface& surface);

// Return the nets of R_(i+1)j - R_ij and of R_i(j+1) - R_ij.
Net differences_u(const Net& net);
Net differences_v(const Net& net);

// Returns the net of |R_ij|.
Net magnitudes(Net net);

// Return the Bernstein sum of the net and its magnitude. Without v, the net must have one column.
Evaluation bernstein_sum(const Net& net, const Homogeneous& u);
Evaluation bernstein_sum(const Net& net, const Homogeneous& u, const Homogeneous& v);

// Returns C(n,i) for 0 <= i <= n < kMaxOrder.
std::uint64_t binomial(int n, int i);

}  // namespace evalcts::reference
