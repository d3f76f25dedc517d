// The maps of a plan along one row of vertices: v stays, u runs.
#pragma once

#include <array>
#include <cstddef>

#include "production/src/bernstein.h"
#include "production/src/parameter.h"
#include "production/src/plan.h"
#include "production/src/target.h"

namespace glev {

// What depends on v alone is computed once, by MoveTo; plans of one-dimensional maps ignore it. All of it in
// the default environment.
class Row {
 public:
  explicit Row(const glev_plan& plan) : plan_(plan) {}
  Row(const glev_plan& plan, const GridArgument& v) : Row(plan) { MoveTo(v); }
  Row(const Row&) = delete;  // curves_ point into points_
  Row& operator=(const Row&) = delete;

  void MoveTo(const GridArgument& v);

  const glev_plan& plan() const { return plan_; }

  // All values of an attribute that has a map, correctly rounded, the missing ones (0,0,0,1)'s.
  template <std::size_t kCount>
  void At(Attribute attribute, const GridArgument& u, float (&result)[kCount]) const {
    const std::array<float, 4> values = ValuesAt(attribute, u);
    for (std::size_t k = 0; k < kCount; ++k) result[k] = values[k];
  }

  // The unit normal. For plans with automatic normals.
  std::array<float, 3> NormalAt(const GridArgument& u) const;

 private:
  std::array<float, 4> ValuesAt(Attribute attribute, const GridArgument& u) const;
  // In double.
  static std::array<double, 4> PlainAt(const Curve& curve, const GridArgument& u,
                                       std::array<double, 4> value);

  const glev_plan& plan_;
  GridArgument v_{};
  std::array<Curve, kAttributes> curves_;
  std::array<Curve, 2> tangents_;
  std::array<std::array<double, kMaxOrder * 4>, kAttributes + 2> points_;  // of these curves
};

}  // namespace glev
