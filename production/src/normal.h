// Automatic normals: n = m / |m|, m = a x b, where for VERTEX_3 a = p_u and b = p_v, for VERTEX_4 a = w p_u -
// w_u p and b = w p_v - w_v p: w^2 times the derivatives of (x, y, z) / w. Derivatives are by the normalised
// coordinates. The degrees are omitted, because positive factors do not matter.
//
// The majorants of components k, from the largest magnitudes P, U and V of the components of control points
// and of their differences (which are the control points of the tangents):
//   A_k = U_k, B_k = V_k for VERTEX_3, A_k = P_w U_k + U_w P_k, B_k = P_w V_k + V_w P_k for VERTEX_4,
//   M_k = A_i B_j + A_j B_i.
// Inside the domain |p_k| <= P_k, ..., |m_k| <= M_k; outside, each factor grows with growth_of().
//
// In double, with u = 2^-53 and degrees n and m, the sums of products with weights t^i s^(n-i) have these
// roundings, to first order: for each degree 3 of t or s, 1 of a product and 1 of a sum; and 1 of a
// difference, 4 of a coefficient and 1 of a product in each direction. The error is c_p = (5 (n + m) + 6) u
// of P and c = (5 (n + m - 1) + 7) u of U and V. A difference of two products adds the errors of their
// factors and 2 u, so
//   VERTEX_4: c_a = c_p + c + 2 u, VERTEX_3: c_a = c;   |error of m_k| <= E_k = (2 c_a + 2 u) M_k.
// The error of the unit vector is at most |E| / |m|, and a few u for its length.
//
// A component with |m_k| <= E_k cannot be distinguished from zero and becomes +0, which moves n by at most
// E_k / |m|. So if |m| >= 2^31 |E|, the error before rounding to float is at most 2^-30, and that of the
// result 2^-25 + 2^-30. Otherwise the same is computed in double-double with computed bounds, which is
// sufficient for |m| >= 2^-60 |M| at ordinary orders (see enclosure.h). For smaller |m|, the result may be
// less accurate, and is (0,0,0) if no component can be distinguished from zero. If a component of m is zero,
// that of the result is +0.
//
// The nets are scaled by powers of two so that nothing overflows and only negligible terms underflow. If
// magnitudes are outside 2^-300 to 2^300 or not finite, there is no error bound, but results are finite.
//
// The operations are IEEE operations in a fixed order, without fused operations. The kernels of normals-inl.h
// use the same operations, so results have the same bits on every instruction set.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "bernstein.h"
#include "parameter.h"
#include "target.h"

namespace glev {

// Returns the unit vector along q_u x q_v with q = (x, y, z) / w, for p = (x, y, z, w) and its derivatives,
// each up to a positive factor. Intermediate results are scaled, so the size of a surface does not matter.
// Returns (0,0,0) if the product is zero or not finite. Computes in double without an error bound.
std::array<double, 3> unit_normal(std::array<double, 4> p, std::array<double, 4> p_u,
                                  std::array<double, 4> p_v);

// The nets from which normals are computed.
enum NormalNet { kPoint, kTangentU, kTangentV, kNets };

// The largest magnitude of each component of the three nets.
using NormalMajorants = std::array<std::array<double, 4>, kNets>;

// The bounds derived above, for a plan, inside the domain.
struct NormalBounds {
  std::array<double, kNets> scale = {1, 1, 1};
  std::array<double, 3> error{};                                   // E_k of the scaled nets
  double least_square = std::numeric_limits<double>::quiet_NaN();  // least |m|^2 for double; NaN: no bound
};

NormalBounds bound_normals(const Surface& vertex, const NormalMajorants& largest);

// One row of a plan, with constant v. move_to() computes the quantities that depend on v once for all normals
// of the row. Requires the default floating-point environment.
class NormalRow {
 public:
  explicit NormalRow(const glev_plan& plan) : plan_(plan) {}
  // Moves to a row. Computes nothing if the plan has no automatic normals, and the points of kPoint only if
  // normals depend on them or with_points is set.
  void move_to(const GridArgument& v, bool with_points = false);

  const glev_plan& plan() const { return plan_; }
  const GridArgument& v() const { return v_; }

  // Returns the unit normal at u. The plan must have automatic normals.
  std::array<float, 3> normal_at(const GridArgument& u) const;

  // For the kernels: the control points of the row, four values apart, and the factor by which bounds grow
  // outside the domain, for each factor of a product; infinity if double is not sufficient.
  const double* points(NormalNet net) const { return points_[net].data(); }
  double growth() const { return growth_; }

 private:
  const glev_plan& plan_;
  GridArgument v_{};
  double growth_ = HUGE_VAL;
  std::array<std::array<double, kMaxOrder * 4>, kNets> points_;
};

}  // namespace glev
