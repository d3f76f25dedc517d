// Derivatives of the vertex map of a plan. Their control points are computed when they are needed.
#pragma once

#include <array>
#include <cmath>

#include "bernstein.h"
#include "enclosure.h"
#include "parameter.h"
#include "prepared_map.h"
#include "target.h"

struct glev_plan;

namespace glev {

// The derivatives, in the order of the attributes from TANGENT_U on.
inline constexpr std::array<Derivative, 5> kDerivatives = {{{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

// Computes the control points of a derivative without its factor, for `count` components from `first` on of a
// map with `components`. Returns the largest sum of the magnitudes of the differences of first order, for
// each of these components; NaN counts as infinite. `order`: of the map; must exceed that of the derivative.
std::array<double, 4> differences_of(const double* points, std::array<int, 2> order, int components,
                                     const Derivative& derivative, int first, int count, double* result);

// A derivative as a map of its own, for the kernels.
class DerivativeMap {
 public:
  DerivativeMap(const glev_plan& plan, const Derivative& derivative);
  DerivativeMap(const DerivativeMap&) = delete;
  DerivativeMap& operator=(const DerivativeMap&) = delete;

  // Returns null if the derivative has no control points, if they are not doubles, or if they are too many.
  const PreparedMap* map() const { return is_there_ ? &map_ : nullptr; }

 private:
  static constexpr int kMostValues = 1024;

  bool is_there_ = false;
  PreparedMap map_;
  std::array<double, kMostValues + 3> scaled_, lowest_;  // kernels read three values more
  std::array<double, centred_values(kMaxCentredDegree, kMaxCentredDegree)> centred_;
};

// A derivative of any map, for evaluation point by point: a factor times a surface whose control points are
// differences, of as many components at a time as there is room for.
class DerivativeNet {
 public:
  DerivativeNet(const glev_plan& plan, const Derivative& derivative);
  DerivativeNet(const DerivativeNet&) = delete;
  DerivativeNet& operator=(const DerivativeNet&) = delete;

  // Loads components from `first` on, and returns their number. The derivative must have control points.
  int load(int first);
  // Moves to a row.
  void move_to(const GridArgument& v);
  // Writes the loaded components at `u`: correctly rounded as floats, or within one ULP as doubles.
  template <class Real>
  void evaluate_at(const GridArgument& u, Real* values) const;

 private:
  static constexpr int kMostValues = kMaxOrder * kMaxOrder;

  const glev_plan& plan_;
  Derivative derivative_;
  int first_ = 0;
  double factor_ = 0;
  // Inside the domain, |value - V| is at most this for each loaded component, for values in double. Infinity
  // if there is no bound.
  std::array<double, 4> error_{};
  Surface surface_;
  GridArgument v_{};
  Curve curve_;  // along u at v_
  double growth_ = HUGE_VAL;
  std::array<double, kMaxOrder * 4> room_;
  std::array<double, kMostValues> points_;
};

// Returns the orders of the net of control points. The derivative is zero everywhere, and has no control
// points, if one of them is less than 1.
inline std::array<int, 2> order_of(const Surface& surface, const Derivative& derivative) {
  return {surface.degree[0] + 1 - derivative[0], surface.degree[1] + 1 - derivative[1]};
}
inline bool is_zero(const Surface& surface, const Derivative& derivative) {
  return surface.degree[0] < derivative[0] || surface.degree[1] < derivative[1];
}

}  // namespace glev
