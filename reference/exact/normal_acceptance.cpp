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
// The errors E are those of the accuracy rule. Every number that is computed from them is an upper bound, a
// sum of positive terms in binary64, accurate to one part in 2^44 (fewer than 300 roundings). The A of each E
// and the results are widened by more than that.
#include <reference/normal.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy_rule.h"
#include "tangents.h"

namespace evalcts::reference {
namespace {

constexpr double kEpsilon = 10738 * 0x1p-30;
constexpr double kLargest = 0x1p32;  // the largest magnitude that the GL promises to represent
constexpr double kRoundings = 0x1p-42;

// The magnitude |x| of a value and the bound E of its error.
struct Estimate {
  double magnitude = 0, error = 0;
  double most() const { return magnitude + error; }
};
Estimate estimate(const Rational& x, const Rational& error) {
  return {std::abs(x.to_double()), error.to_double()};
}

// Estimates of the value of one component and of its derivatives p_u and p_v.
struct JetEstimate {
  Estimate value, u, v;
};

// The weights of the bounds of values and of derivatives in one direction.
struct BoundBasis {
  BoundBasis(const Coordinate& at, bool single)
      : degree(at.degree()), value(at, degree, single), derivative(at, std::max(degree - 1, 0), single) {}

  int degree;
  BoundWeights value, derivative;
};

// `net`: the magnitudes of the control values.
JetEstimate estimate_of(const Jet& jet, const Net& net, const BoundBasis& u, const BoundBasis& v,
                        bool single) {
  const int n = u.degree, m = v.degree;
  JetEstimate result;
  result.value =
      estimate(jet.value, error_bound(net, u.value, v.value, operations(n, m, single), kRoundings));
  if (n > 0) {
    const int k = operations(n - 1, m, single) + 3;
    result.u = estimate(jet.u, n * error_bound(neighbours_u(net, 1), u.derivative, v.value, k, kRoundings));
  }
  if (m > 0) {
    const int k = operations(n, m - 1, single) + 3;
    result.v = estimate(jet.v, m * error_bound(neighbours_v(net, 1), u.value, v.derivative, k, kRoundings));
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

Rational outward(double x) { return Rational(x * (1 + kRoundings)); }

}  // namespace

NormalAcceptance normal_acceptance(VertexSurface surface, const Argument& u, const Argument& v, int range) {
  const std::vector<Jet> exact = vertex_jets(surface, u, v);
  const auto [tangent_a, tangent_b] = cleared_tangents(exact);
  NormalAcceptance result{cross(tangent_a, tangent_b), false, std::nullopt, std::nullopt};

  const Coordinate along_u(surface.front().u, u), along_v(surface.front().v, v);
  const bool single =
      along_u.is_single() && along_v.is_single() && std::ranges::all_of(surface, points_are_single);
  const BoundBasis u_basis(along_u, single), v_basis(along_v, single);
  std::vector<JetEstimate> jets;
  Rational largest_value;
  for (std::size_t c = 0; c < surface.size(); ++c) {
    const Net net = magnitudes(integer_net(surface[c]));
    jets.push_back(estimate_of(exact[c], net, u_basis, v_basis, single));
    largest_value = std::max(largest_value, largest(net));
  }
  const Estimate w = jets.size() == 4 ? jets[3].value : Estimate{1, 0};
  const Estimates a = tangent_estimates(jets, tangent_a, &JetEstimate::u);
  const Estimates b = tangent_estimates(jets, tangent_b, &JetEstimate::v);
  const double m = size(result.m);
  const double d = cross_error(a, b);

  result.must_applies =
      must_applies(along_u, along_v, largest_value, range) &&
      sizes_are_ordinary(a, along_u.width.to_double(), b, along_v.width.to_double(), m, w.magnitude);
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
