// Checks the oracle with interval arithmetic (MPFI) of about 400 digits, which shares no code with it. Each
// interval must contain the exact value, and must be narrow.
#include <gtest/gtest.h>
#include <reference/bernstein_form.h>
#include <reference/normal.h>
#include <reference/rounding.h>

#include <boost/multiprecision/mpfi.hpp>
#include <cmath>

#include "random_data.h"

namespace evalcts::reference {
namespace {

using Ball = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<400>>;

Ball ball(const Rational& x) {
  const Ball power = pow(Ball(2), static_cast<int>(std::abs(x.exponent())));
  const Ball quotient = Ball(x.numerator().str()) / Ball(x.denominator().str());
  return x.exponent() < 0 ? Ball(quotient / power) : Ball(quotient * power);
}

// Expects that the interval contains x and is not wider than 2^-600 of its scale.
void expect_in(const Ball& interval, const Rational& x, const Ball& scale) {
  const Ball difference = interval - ball(x);
  ASSERT_LE(lower(difference), 0);
  ASSERT_GE(upper(difference), 0);
  ASSERT_LE(width(interval), upper(Ball(scale * pow(Ball(2), -600)))) << x;
}

// Returns the direct sum, with incrementally computed binomial coefficients.
Ball bernstein_sum(const std::vector<Ball>& values, const Ball& t) {
  const int n = static_cast<int>(values.size()) - 1;
  Ball sum = 0, binomial = 1;
  for (int i = 0; i <= n; ++i) {
    sum += binomial * pow(t, i) * pow(Ball(1 - t), n - i) * values[i];
    binomial = binomial * (n - i) / (i + 1);
  }
  return sum;
}

std::vector<Ball> differences(const std::vector<Ball>& values) {
  std::vector<Ball> result;
  for (std::size_t i = 1; i < values.size(); ++i) result.push_back(values[i] - values[i - 1]);
  return result;
}

Ball derivative(const std::vector<Ball>& values, const Ball& t) {
  if (values.size() == 1) return 0;
  return static_cast<int>(values.size() - 1) * bernstein_sum(differences(values), t);
}

Ball largest(const std::vector<double>& values) {
  double most = 0x1p-1074;
  for (const double x : values) most = std::max(most, std::abs(x));
  return Ball(most);
}

// Returns a scale for sums that cancel: the sum of |t|^i |1-t|^(n-i) C(n,i), which is (|t| + |1-t|)^n.
Ball growth(const Ball& t, int n) { return pow(Ball(abs(t) + abs(Ball(1 - t))), n); }

TEST(Intervals, ContainValuesAndDerivativesOfCurves) {
  std::mt19937_64 random = make_generator();
  for (int round = 0; round < 300; ++round) {
    const int order = round % kMaxOrder + 1;
    const Data kind = static_cast<Data>(pick(random, 0, static_cast<int>(Data::kAnyFloat)));
    const std::vector<double> points = control_values(random, kind, order);
    const double u1 = uniform(random, -4, 4),
                 u2 = u1 + (pick(random, 0, 1) == 0 ? 1 : -1) * uniform(random, 0.1, 9);
    const bool is_grid = pick(random, 0, 1) == 0;
    const int segments = pick(random, 1, 99), index = pick(random, -5, segments + 5);
    const double coordinate = uniform(random, -6, 12);
    const Argument u = is_grid ? Argument::grid(index, segments, u2, u1) : Argument::coordinate(coordinate);
    const Ball x =
        is_grid ? Ball(Ball(index) * (Ball(u1) - Ball(u2)) / segments + Ball(u2)) : Ball(coordinate);
    const Ball t = (x - Ball(u1)) / (Ball(u2) - Ball(u1));
    std::vector<Ball> values;
    for (const double p : points) values.emplace_back(p);
    const Surface curve{points.data(), {1, order, u1, u2}};
    const Ball scale = largest(points) * growth(t, order - 1);
    SCOPED_TRACE(testing::Message() << "order " << order << " data " << static_cast<int>(kind));
    expect_in(bernstein_sum(values, t), BernsteinForm(curve).evaluate(u), scale);
    expect_in(derivative(values, t), jet(curve, u).u, scale * order * 4);
    if (HasFatalFailure()) return;
  }
}

// Normals of rational and other patches: m, and the components of m/|m| rounded to binary32.
TEST(Intervals, ContainNormals) {
  std::mt19937_64 random = make_generator();
  for (int round = 0; round < 200; ++round) {
    const int uorder = pick(random, 2, 7), vorder = pick(random, 2, 7), k = pick(random, 3, 4);
    const std::vector<double> points = control_values(random, Data::kFloats, uorder * vorder * k);
    const double u = uniform(random, 0, 1), v = uniform(random, 0, 1);
    std::vector<Surface> surface;
    std::vector<Ball> p, p_u, p_v;
    for (int c = 0; c < k; ++c) {
      surface.push_back({points.data() + c, {vorder * k, uorder}, {k, vorder}});
      std::vector<Ball> along_v, slopes;
      for (int i = 0; i < uorder; ++i) {
        std::vector<Ball> row;
        for (int j = 0; j < vorder; ++j) row.emplace_back(points[(i * vorder + j) * k + c]);
        along_v.push_back(bernstein_sum(row, Ball(v)));
        slopes.push_back(derivative(row, Ball(v)));
      }
      p.push_back(bernstein_sum(along_v, Ball(u)));
      p_u.push_back(derivative(along_v, Ball(u)));
      p_v.push_back(bernstein_sum(slopes, Ball(u)));
    }
    if (k == 4) {  // tangents of (x, y, z) / w
      for (int c = 0; c < 3; ++c) {
        p_u[c] = (p_u[c] * p[3] - p[c] * p_u[3]) / (p[3] * p[3]);
        p_v[c] = (p_v[c] * p[3] - p[c] * p_v[3]) / (p[3] * p[3]);
      }
    }
    std::vector<Ball> m;
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      m.push_back(p_u[d] * p_v[e] - p_u[e] * p_v[d]);
    }
    const Ball length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    const Vector exact = normal_vector(surface, Argument::coordinate(u), Argument::coordinate(v));
    const std::array<float, 3> rounded = rounded_unit_vector(exact);
    for (int c = 0; c < 3; ++c) {
      expect_in(m[c], exact[c], length);
      const Ball component = m[c] / length;
      // Both ends of such a narrow interval round to the same number.
      ASSERT_EQ(lower(component).convert_to<float>(), rounded[c]);
      ASSERT_EQ(upper(component).convert_to<float>(), rounded[c]);
    }
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace evalcts::reference
