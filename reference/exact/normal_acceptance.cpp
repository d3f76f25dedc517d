// The acceptance rule for automatic normals. vectors/INTERPRETING.md states it.
//
// An implementation has x, y, z, w and their derivatives with errors E. From these it computes one of the
// pairs of tangents
//   a = p_u, b = p_v;   a = w*p_u - w_u*p, b likewise;   q_u = (p_u - q*w_u)/w, q_v likewise, q = p/w,
// and their cross product. The quotient rule gives a/w'^2, where w' is w with its error. All components have
// the same w', so the error of w' scales the normal and does not turn it. The quotient rule needs one or two
// operations more than the 3 that the acceptance rule allows. The K + 3 operations of the derivatives cover
// these, because K counts 5*n operations and no order of evaluation needs more than 4*n. Every pair therefore
// gives a normal of the second form below, with an m' that satisfies the first condition:
//   |m' - m| <= d   and   m' * (1 +- 10*eps) / w'^4,
// The bounds of direction and length follow from both.
//
// Every result here is an upper bound, computed as a sum of positive terms in binary64. It is accurate to one
// part in 2^44 (fewer than 300 roundings) and is widened by more than that.
#include <reference/normal.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "direction.h"
#include "homogeneous.h"
#include "jet.h"

namespace evalcts::reference {
namespace {

constexpr double kEpsilon = 10738 * 0x1p-30;
constexpr double kSmallestNormal = 0x1p-126;
constexpr double kLargest = 0x1p32;  // the largest magnitude that the GL promises to represent
constexpr double kRoundings = 0x1p-42;

// The magnitude |x| of a value and the bound E of its error.
struct Estimate {
  double magnitude = 0, error = 0;
  double most() const { return magnitude + error; }
};

// The magnitudes |R_ij| of a net.
struct Magnitudes {
  int rows, columns;
  std::vector<double> values;

  double at(int i, int j) const { return values[static_cast<std::size_t>(i) * columns + j]; }
  double largest() const { return *std::max_element(values.begin(), values.end()); }
};

Magnitudes magnitudes(const Surface& surface) {
  Magnitudes result{surface.uorder, surface.vorder, {}};
  for (int i = 0; i < surface.uorder; ++i) {
    for (int j = 0; j < surface.vorder; ++j) {
      result.values.push_back(std::abs(surface.points[i * surface.ustride + j * surface.vstride]));
    }
  }
  return result;
}

// Return the nets of |R_(i+1)j| + |R_ij| and of |R_i(j+1)| + |R_ij|.
Magnitudes sums_u(const Magnitudes& net) {
  Magnitudes result{net.rows - 1, net.columns, {}};
  for (int i = 0; i < result.rows; ++i) {
    for (int j = 0; j < result.columns; ++j) result.values.push_back(net.at(i + 1, j) + net.at(i, j));
  }
  return result;
}

Magnitudes sums_v(const Magnitudes& net) {
  Magnitudes result{net.rows, net.columns - 1, {}};
  for (int i = 0; i < result.rows; ++i) {
    for (int j = 0; j < result.columns; ++j) result.values.push_back(net.at(i, j + 1) + net.at(i, j));
  }
  return result;
}

// The quantities |t|, |s|, T and S of one direction.
struct Range {
  double t, s, widened_t, widened_s;
};

Range range_of(const Direction& d, bool single) {
  return {d.t().to_double(), d.s().to_double(), d.widened_t(single).to_double(),
          d.widened_s(single).to_double()};
}

// Returns C(n,i) * t^i * s^(n-i) for i = 0..n.
std::vector<double> weights(int n, double t, double s) {
  std::vector<double> result(n + 1);
  double power = 1;
  for (int i = 0; i <= n; ++i, power *= t) result[i] = static_cast<double>(binomial(n, i)) * power;
  power = 1;
  for (int i = n; i >= 0; --i, power *= s) result[i] *= power;
  return result;
}

// The weights of one degree: of W(|t|,|s|), of W(T,S), and of U.
struct Weights {
  std::vector<double> plain, widened, binomials;

  Weights(int n, const Range& r)
      : plain(weights(n, r.t, r.s)), widened(weights(n, r.widened_t, r.widened_s)) {
    const double extent = std::pow(std::max({1.0, r.t, r.s}), n);
    binomials = weights(n, 1, 1);
    for (double& x : binomials) x *= extent;
  }
};

// Returns A*W(T,S) - W(|t|,|s|) + U over the net.
double error_bound(const Magnitudes& net, const Weights& u, const Weights& v, int k) {
  double inner = 0, outer = 0, under = 0;
  for (int i = 0; i < net.rows; ++i) {
    for (int j = 0; j < net.columns; ++j) {
      const double r = net.at(i, j);
      inner += u.plain[i] * v.plain[j] * r;
      outer += u.widened[i] * v.widened[j] * r;
      under += u.binomials[i] * v.binomials[j] * std::max(1.0, r);
    }
  }
  const double x = k * kEpsilon;
  return (1 + x + x * x + kRoundings) * outer - inner + k * kSmallestNormal * under;
}

// Estimates of the value of one component and of its derivatives p_u and p_v.
struct JetEstimate {
  Estimate value, u, v;
};

std::vector<JetEstimate> estimates(VertexSurface surface, const std::vector<Jet>& jets, const Direction& u,
                                   const Direction& v, bool single) {
  const int n = u.degree, m = v.degree;
  const Range u_range = range_of(u, single), v_range = range_of(v, single);
  const Weights along_u(n, u_range), along_v(m, v_range);
  std::vector<JetEstimate> result(jets.size());
  const auto magnitude = [](const Rational& x) { return std::abs(x.to_double()); };
  for (std::size_t c = 0; c < jets.size(); ++c) {
    const Magnitudes net = magnitudes(surface[c]);
    result[c].value = {magnitude(jets[c].value),
                       error_bound(net, along_u, along_v, operations(n, m, single))};
    if (n > 0) {
      result[c].u = {magnitude(jets[c].u), n * error_bound(sums_u(net), Weights(n - 1, u_range), along_v,
                                                           operations(n - 1, m, single) + 3)};
    }
    if (m > 0) {
      result[c].v = {magnitude(jets[c].v), m * error_bound(sums_v(net), along_u, Weights(m - 1, v_range),
                                                           operations(n, m - 1, single) + 3)};
    }
  }
  return result;
}

// Returns E of x*y - z*w: (1 + 3*eps) * [(|x|+E)*(|y|+E) + (|z|+E)*(|w|+E)] - |x*y| - |z*w|.
double difference_error(const Estimate& x, const Estimate& y, const Estimate& z, const Estimate& w) {
  const auto product = [](const Estimate& f, const Estimate& g) {
    return f.error * g.magnitude + f.magnitude * g.error + f.error * g.error +
           3 * kEpsilon * f.most() * g.most();
  };
  return product(x, y) + product(z, w);
}

using Estimates = std::array<Estimate, 3>;

// Returns |a| and E_a of each component of the tangent in u or v. `derivative` is the corresponding member.
Estimates tangent_estimates(const std::vector<JetEstimate>& jets, const Vector& tangent,
                            Estimate JetEstimate::*derivative) {
  Estimates result;
  for (int c = 0; c < 3; ++c) {
    const JetEstimate& p = jets[c];
    if (jets.size() == 3) {
      result[c] = p.*derivative;
    } else {
      const JetEstimate& w = jets[3];
      result[c] = {std::abs(tangent[c].to_double()),
                   difference_error(w.value, p.*derivative, w.*derivative, p.value)};
    }
  }
  return result;
}

// d
double cross_error(const Estimates& a, const Estimates& b) {
  return std::hypot(difference_error(a[1], b[2], a[2], b[1]), difference_error(a[2], b[0], a[0], b[2]),
                    difference_error(a[0], b[1], a[1], b[0]));
}

double size(const Vector& m) { return std::hypot(m[0].to_double(), m[1].to_double(), m[2].to_double()); }

bool is_between(double x, double low, double high) { return low <= x && x <= high; }

// Returns true if single precision can square the intermediate values without loss, before and after the
// division by w, with derivatives in t or in u. (This bounds |w| as well, because w^4 is their ratio.)
bool sizes_are_ordinary(const Estimates& a, double u_width, const Estimates& b, double v_width, double m,
                        double w) {
  const auto all_within = [](const Estimates& tangent, double limit) {
    return std::all_of(tangent.begin(), tangent.end(), [&](const Estimate& x) { return x.most() <= limit; });
  };
  for (const double w2 : {1.0, w * w}) {
    for (const bool in_domain : {false, true}) {
      const double du = in_domain ? u_width : 1, dv = in_domain ? v_width : 1;
      if (!all_within(a, kLargest * w2 * du) || !all_within(b, kLargest * w2 * dv) ||
          !is_between(m / (w2 * w2 * du * dv), 1 / kLargest, kLargest)) {
        return false;
      }
    }
  }
  return true;
}

bool values_must_apply(VertexSurface surface, const Direction& u, const Direction& v, int range) {
  if (!u.must_applies() || !v.must_applies()) return false;
  double largest = 0;
  for (const Surface& component : surface) largest = std::max(largest, magnitudes(component).largest());
  const Rational growth = u.growth() * v.growth();
  return growth <= Rational::power_of_two(kFullRange) &&
         growth * Rational(largest) <= Rational::power_of_two(range);
}

Rational outward(double x) { return Rational(x * (1 + kRoundings)); }

}  // namespace

NormalAcceptance normal_acceptance(VertexSurface surface, const Argument& u, const Argument& v, int range) {
  const std::vector<Jet> exact = jets(surface, u, v);
  const Tangents tangents = cleared_tangents(exact);
  NormalAcceptance result{cross(tangents.u, tangents.v), false, std::nullopt, std::nullopt};

  const Surface& first = surface.front();
  const Direction along_u{first.uorder - 1, first.u1, first.u2, u};
  const Direction along_v{first.vorder - 1, first.v1, first.v2, v};
  const bool single = along_u.is_single() && along_v.is_single() &&
                      std::all_of(surface.begin(), surface.end(), points_are_single);
  const std::vector<JetEstimate> jets = estimates(surface, exact, along_u, along_v, single);
  const Estimate w = jets.size() == 4 ? jets[3].value : Estimate{1, 0};
  const Estimates a = tangent_estimates(jets, tangents.u, &JetEstimate::u);
  const Estimates b = tangent_estimates(jets, tangents.v, &JetEstimate::v);
  const double m = size(result.m);
  const double d = cross_error(a, b);

  result.must_applies =
      values_must_apply(surface, along_u, along_v, range) &&
      sizes_are_ordinary(a, along_u.width().to_double(), b, along_v.width().to_double(), m, w.magnitude);
  const bool judged = d < m / 4 && w.error < w.magnitude / 2;  // false if a number is NaN
  if (!judged || !std::isfinite(m)) return result;

  result.bound = outward(2 * d / m + 10 * kEpsilon);

  // |m'*(1 + 10*eps)/w'^4 - m/w^4| is largest for w' = |w| - Ew =: w * (1 - f) and m' = |m| + d, as 1/w^4 is
  // convex: [d + 10*eps*(|m| + d) + |m|*(1 - (1-f)^4)] / w'^4.
  const double f = w.error / w.magnitude, rest = 1 - f;
  const double turned = d + 10 * kEpsilon * (m + d) + m * f * (1 + rest) * (1 + rest * rest);
  const double vector_bound = turned / std::pow(w.magnitude * rest, 4);
  if (std::isfinite(vector_bound)) result.vector_bound = outward(vector_bound);
  return result;
}

Rational normal_method_allowance() { return Rational(2) / 1000; }

Rational normal_quality_bound(const Rational& bound) { return bound * Rational::power_of_two(-7); }

}  // namespace evalcts::reference
