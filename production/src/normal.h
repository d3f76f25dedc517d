// Automatic normals: n = m / |m|, m = a x b, where for VERTEX_3 a = p_u and b = p_v, for VERTEX_4
// a = w p_u - w_u p and b = w p_v - w_v p: w^2 times the derivatives of (x, y, z) / w. Derivatives are by the
// normalised coordinates; positive factors do not matter, so the degrees are left out.
//
// The majorants of components k, from the largest magnitudes P, U and V of the components of control points
// and of their differences (which are the control points of the tangents):
//   A_k = U_k, B_k = V_k for VERTEX_3, A_k = P_w U_k + U_w P_k, B_k = P_w V_k + V_w P_k for VERTEX_4,
//   M_k = A_i B_j + A_j B_i.
// Inside the domain |p_k| <= P_k, ..., |m_k| <= M_k; outside, each factor grows with growth_of().
//
// In double, with u = 2^-53 and n, m the degrees, the sums of products with weights t^i s^(n-i) have, to
// first order, for each degree the 3 roundings of t or s, 1 of a product and 1 of a sum; 1 of a difference, 4
// of a coefficient and 1 of a product in each direction, which makes c_p = (5 (n + m) + 6) u of P, c = (5 (n
// + m - 1) + 7) u of U and V. A difference of two products adds the errors of their factors and 2 u, so
//   VERTEX_4: c_a = c_p + c + 2 u, VERTEX_3: c_a = c;   |error of m_k| <= E_k = (2 c_a + 2 u) M_k.
// The unit vector is off by at most |E| / |m|, and a few u for its length.
//
// What comes out: a component with |m_k| <= E_k cannot be told from zero and is +0, which moves n by E_k /
// |m| once more. So where |m| >= 2^31 |E|, what is rounded to float is off by at most 2^-30, and the result
// by 2^-25 + 2^-30. Elsewhere the same in double-double, whose bounds are computed along: that is good for
// |m| >= 2^-60 |M| at ordinary orders, see enclosure.h; below, the result is the best there is, up to (0,0,0)
// where no component can be told from zero. In particular where a component of m is zero that of the result
// is +0.
//
// The nets are scaled by powers of two so that nothing overflows and only what does not count underflows;
// where magnitudes differ too much for this (beyond 2^-300 to 2^300), and for what is not finite, nothing is
// claimed but finite results.
//
// Every operation is an IEEE operation in a certain order, without fused ones, and the kernels of
// normals-inl.h do the same: the same bits on every instruction set.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "bernstein.h"
#include "parameter.h"
#include "target.h"

namespace glev {

// The unit vector along q_u x q_v with q = (x, y, z) / w: for p = (x, y, z, w) and its derivatives, each up
// to a positive factor. Scales on the way, so that the size of a surface does not matter. (0,0,0) where the
// product is zero or not finite. In double, nothing is claimed.
std::array<double, 3> unit_normal(std::array<double, 4> p, std::array<double, 4> p_u,
                                  std::array<double, 4> p_v);

// The nets of normals.
enum NormalNet { kPoint, kTangentU, kTangentV, kNets };

// The largest magnitude of each component of the three nets.
using NormalMajorants = std::array<std::array<double, 4>, kNets>;

// The above for a plan, inside the domain.
struct NormalBounds {
  std::array<double, kNets> scale = {1, 1, 1};
  std::array<double, 3> error{};                                   // E of the scaled nets
  double least_square = std::numeric_limits<double>::quiet_NaN();  // of |m|; NaN: nothing is claimed
};

NormalBounds bound_normals(const Surface& vertex, const NormalMajorants& largest);

// One row of a plan: v is constant. What automatic normals need of v is computed once, by move_to. Needs the
// default floating-point environment.
class NormalRow {
 public:
  explicit NormalRow(const glev_plan& plan) : plan_(plan) {}
  // Computes nothing if the plan has no automatic normals. Computes the points of kPoint only if normals
  // depend on them, or with_points is set.
  void move_to(const GridArgument& v, bool with_points = false);

  const glev_plan& plan() const { return plan_; }
  const GridArgument& v() const { return v_; }

  // The unit normal at u. The plan must have automatic normals.
  std::array<float, 3> normal_at(const GridArgument& u) const;

  // For the kernels: control points of the row, four values apart, and what bounds are multiplied with for
  // each factor; infinite where double does not do.
  const double* points(NormalNet net) const { return points_[net].data(); }
  double growth() const { return growth_; }

 private:
  const glev_plan& plan_;
  GridArgument v_{};
  double growth_ = HUGE_VAL;
  std::array<std::array<double, kMaxOrder * 4>, kNets> points_;
};

}  // namespace glev
