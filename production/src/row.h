// The maps of a plan along one row of vertices: v stays, u runs.
#pragma once

#include <array>
#include <cstddef>

#include "production/src/bernstein.h"
#include "production/src/normal.h"
#include "production/src/parameter.h"
#include "production/src/plan.h"
#include "production/src/target.h"

namespace glev {

// Four values of an attribute that has a map, correctly rounded, the missing ones (0,0,0,1)'s. In the default
// environment.
inline void ValuesAt(const glev_plan& plan, Attribute attribute, const GridArgument& u, const GridArgument& v,
                     float* values) {
  const PreparedMap& map = plan.map(attribute);
  plan.kernels().point(map, u, v, values);
  for (int k = map.surface.components; k < 4; ++k) values[k] = k == 3 ? 1 : 0;
}

// What depends on v alone is computed once, by MoveTo; plans of one-dimensional maps ignore it. All of it in
// the default environment.
class Row {
 public:
  explicit Row(const glev_plan& plan) : plan_(plan), normals_(plan) {}
  Row(const glev_plan& plan, const GridArgument& v) : Row(plan) { MoveTo(v); }
  Row(const Row&) = delete;  // curves_ point into points_
  Row& operator=(const Row&) = delete;

  void MoveTo(const GridArgument& v);

  const glev_plan& plan() const { return plan_; }
  const GridArgument& v() const { return v_; }

  // What ValuesAt gives.
  void ValuesAt(Attribute attribute, const GridArgument& u, float* values) const;

  // The unit normal, as normal.h says. For plans with automatic normals.
  std::array<float, 3> NormalAt(const GridArgument& u) const;

 private:
  // In double.
  static std::array<double, 4> PlainAt(const Curve& curve, const GridArgument& u,
                                       std::array<double, 4> value);

  const glev_plan& plan_;
  GridArgument v_{};
  NormalRow normals_;
  std::array<Curve, kAttributes> curves_;
  std::array<Curve, 2> tangents_;
  std::array<std::array<double, kMaxOrder * 4>, kAttributes + 2> points_;  // of these curves
};

}  // namespace glev
