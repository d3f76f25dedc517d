// The usual methods to compute the normal of a surface, with arithmetic of limited accuracy.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "patch.h"
#include "perturbed.h"

namespace evalcts::reference {

// Method for the derivative of a curve: a curve of degree n - 1 over differences, the difference of two
// curves of degree n - 1 (the last step of de Casteljau), or the sum over differences of Bernstein
// polynomials.
enum class Slope { kOfDifferences, kOfLastStep, kOfWeights };
// The factors of the cross product.
enum class Tangent {
  kCleared,             // w*p_u - w_u*p
  kClearedFused,        // the same with fused operations
  kQuotient,            // (p_u - q*w_u)/w with q = p/w
  kQuotientReciprocal,  // the same with one reciprocal 1/w
  kQuotientOfCleared,   // (w*p_u - w_u*p)/(w*w)
};
enum class Unit { kDivision, kReciprocal, kReciprocalRoot };

constexpr Slope kSlopes[] = {Slope::kOfDifferences, Slope::kOfLastStep, Slope::kOfWeights};
constexpr Tangent kTangents[] = {Tangent::kCleared, Tangent::kClearedFused, Tangent::kQuotient,
                                 Tangent::kQuotientReciprocal, Tangent::kQuotientOfCleared};
constexpr Unit kUnits[] = {Unit::kDivision, Unit::kReciprocal, Unit::kReciprocalRoot};

struct NormalMethod {
  Parameter parameter;
  Method method;
  Slope slope;
  Tangent tangent;
  Unit unit;
  bool rows_first;       // along v first, then along u
  bool domain_variable;  // derivatives in u and v, not in t
};

using Reals = std::vector<long double>;
using RealVector = std::array<long double, 3>;

inline long double slope_by(Arithmetic& a, const NormalMethod& how, const Reals& r, Weights w) {
  const std::size_t n = r.size() - 1;
  if (n == 0) return 0;
  const Reals first(r.begin(), r.end() - 1), last(r.begin() + 1, r.end());
  switch (how.slope) {
    case Slope::kOfDifferences: {
      Reals differences;
      for (std::size_t i = 0; i < n; ++i) differences.push_back(a.sub(r[i + 1], r[i]));
      return a.mul(n, evaluate_by(a, how.method, differences, w));
    }
    case Slope::kOfLastStep:
      return a.mul(n, a.sub(evaluate_by(a, how.method, last, w), evaluate_by(a, how.method, first, w)));
    case Slope::kOfWeights: {
      // The weights are B_(i-1) - B_i of degree n - 1. Each polynomial is evaluated as a curve with a single
      // control value 1 and zeros otherwise.
      Reals weights;
      for (std::size_t i = 0; i < n; ++i) {
        Reals one(n, 0);
        one[i] = 1;
        weights.push_back(evaluate_by(a, how.method, one, w));
      }
      long double sum = a.mul(-weights[0], r[0]);
      for (std::size_t i = 1; i < n; ++i) sum = a.add(sum, a.mul(a.sub(weights[i - 1], weights[i]), r[i]));
      return a.mul(n, a.add(sum, a.mul(weights[n - 1], r[n])));
    }
  }
  return 0;
}

struct RealJet {
  long double value, u, v;
};

inline RealJet jet_by(Arithmetic& a, const NormalMethod& how, const Patch& patch, int c, Weights u,
                      Weights v) {
  // The net is split into curves along the direction that is evaluated first.
  const int lines = how.rows_first ? patch.uorder : patch.vorder;
  const int count = how.rows_first ? patch.vorder : patch.uorder;
  const Weights inner = how.rows_first ? v : u, outer = how.rows_first ? u : v;
  Reals values, slopes;
  for (int k = 0; k < lines; ++k) {
    Reals line;
    for (int l = 0; l < count; ++l) line.push_back(how.rows_first ? patch.at(k, l, c) : patch.at(l, k, c));
    values.push_back(evaluate_by(a, how.method, line, inner));
    slopes.push_back(slope_by(a, how, line, inner));
  }
  const long double value = evaluate_by(a, how.method, values, outer);
  long double along_outer = slope_by(a, how, values, outer);
  long double along_inner = count == 1 ? 0 : evaluate_by(a, how.method, slopes, outer);
  if (!how.rows_first) std::swap(along_outer, along_inner);
  return {value, along_outer, along_inner};
}

inline RealVector cross_by(Arithmetic& a, const NormalMethod& how, const RealVector& f, const RealVector& g) {
  RealVector m;
  for (int c = 0; c < 3; ++c) {
    const int y = (c + 1) % 3, z = (c + 2) % 3;
    m[c] = how.tangent == Tangent::kClearedFused ? a.fma(f[y], g[z], -a.mul(f[z], g[y]))
                                                 : a.sub(a.mul(f[y], g[z]), a.mul(f[z], g[y]));
  }
  return m;
}

// Returns dq/du x dq/dv. For cleared tangents, the result is divided by w^4 at the end if `clear`, otherwise
// it is w^4 times as long.
inline RealVector normal_by(Arithmetic& a, const NormalMethod& how, const Patch& patch, long double u,
                            long double v, bool clear) {
  const Weights along_u = parameter(a, how.parameter, u, patch.u1, patch.u2);
  const Weights along_v = parameter(a, how.parameter, v, patch.v1, patch.v2);
  std::array<RealJet, 4> p;
  for (int c = 0; c < patch.size; ++c) {
    p[c] = jet_by(a, how, patch, c, along_u, along_v);
    if (how.domain_variable) {
      p[c].u = a.div(p[c].u, a.sub(patch.u2, patch.u1));
      p[c].v = a.div(p[c].v, a.sub(patch.v2, patch.v1));
    }
  }
  if (patch.size == 3) return cross_by(a, how, {p[0].u, p[1].u, p[2].u}, {p[0].v, p[1].v, p[2].v});

  const RealJet& w = p[3];
  const long double r = how.tangent == Tangent::kQuotientReciprocal ? a.div(1, w.value) : 0;
  const auto tangent = [&](const RealJet& x, long double RealJet::*slope) {
    const auto cleared = [&] { return a.sub(a.mul(w.value, x.*slope), a.mul(w.*slope, x.value)); };
    switch (how.tangent) {
      case Tangent::kCleared:
        return cleared();
      case Tangent::kClearedFused:
        return a.fma(w.value, x.*slope, -a.mul(w.*slope, x.value));
      case Tangent::kQuotient:
        return a.div(a.sub(x.*slope, a.mul(a.div(x.value, w.value), w.*slope)), w.value);
      case Tangent::kQuotientReciprocal:
        return a.mul(a.sub(x.*slope, a.mul(a.mul(x.value, r), w.*slope)), r);
      case Tangent::kQuotientOfCleared:
        return a.div(cleared(), a.mul(w.value, w.value));
    }
    return 0.0L;
  };
  RealVector f, g;
  for (int c = 0; c < 3; ++c) {
    f[c] = tangent(p[c], &RealJet::u);
    g[c] = tangent(p[c], &RealJet::v);
  }
  RealVector m = cross_by(a, how, f, g);
  if (clear && (how.tangent == Tangent::kCleared || how.tangent == Tangent::kClearedFused)) {
    const long double w2 = a.mul(w.value, w.value), w4 = a.mul(w2, w2);
    for (long double& x : m) x = a.div(x, w4);
  }
  return m;
}

inline RealVector unit_by(Arithmetic& a, Unit how, const RealVector& m) {
  const long double square = a.add(a.add(a.mul(m[0], m[0]), a.mul(m[1], m[1])), a.mul(m[2], m[2]));
  RealVector unit;
  const long double factor = how == Unit::kReciprocalRoot ? a.round(1 / std::sqrt(square))
                             : how == Unit::kReciprocal   ? a.div(1, a.round(std::sqrt(square)))
                                                          : 0;
  const long double length = how == Unit::kDivision ? a.round(std::sqrt(square)) : 0;
  for (int c = 0; c < 3; ++c) unit[c] = how == Unit::kDivision ? a.div(m[c], length) : a.mul(m[c], factor);
  return unit;
}

}  // namespace evalcts::reference
