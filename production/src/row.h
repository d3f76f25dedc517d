// The maps of a plan along one row of vertices: v stays, u runs.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>

#include "production/src/bernstein.h"
#include "production/src/fault.h"
#include "production/src/normal.h"
#include "production/src/parameter.h"
#include "production/src/plan.h"
#include "production/src/target.h"

namespace glev {

// Rounds the first values to float, once.
template <class Floats, std::size_t kSize>
void RoundTo(Floats& result, const std::array<double, kSize>& values) {
  static_assert(std::size(Floats{}) <= kSize);
  for (std::size_t k = 0; k < std::size(result); ++k) result[k] = static_cast<float>(values[k]);
}

// What depends on v alone is computed once, by MoveTo. Arguments are double or GridArgument; plans of
// one-dimensional maps ignore v.
class Row {
 public:
  explicit Row(const glev_plan& plan) : plan_(plan) {}
  template <class Argument>
  Row(const glev_plan& plan, const Argument& v) : Row(plan) {
    MoveTo(v);
  }
  Row(const Row&) = delete;  // curves_ point into points_
  Row& operator=(const Row&) = delete;

  template <class Argument>
  void MoveTo(const Argument& v) {
    const auto cut = [&](const Surface& surface, std::size_t slot) -> Curve {
      if (surface.components == 0) return {};
      const bool same_start = GLEV_FAULTY(VFromStartOfU) && surface.domain[1].u2 != surface.domain[0].u1;
      const Domain domain = {surface.domain[same_start ? 0 : 1].u1, surface.domain[1].u2};
      return CurveAt(surface, Locate(domain, v), points_[slot].data());
    };
    for (std::size_t a = 0; a < kAttributes; ++a)
      curves_[a] = cut(plan_.surface(static_cast<Attribute>(a)), a);
    if (GLEV_FAULTY(TangentsOfTheFirstRow) && tangents_[0].components != 0) return;
    for (std::size_t direction : {0, 1}) {
      tangents_[direction] = cut(plan_.tangent(static_cast<int>(direction)), kAttributes + direction);
    }
  }

  const glev_plan& plan() const { return plan_; }

  using Values = std::array<double, 4>;

  // All four values of an attribute that has a map, the missing ones (0,0,0,1)'s.
  template <class Argument>
  Values At(Attribute attribute, const Argument& u) const {
    return ValueAt(curves_[static_cast<std::size_t>(attribute)], u, {0, 0, 0, 1});
  }

  // The unit normal where the vertex map has the value `position`. For plans with automatic normals.
  template <class Argument>
  std::array<double, 3> NormalAt(const Values& position, const Argument& u) const {
    return UnitNormal(position, ValueAt(tangents_[0], u, {}), ValueAt(tangents_[1], u, {}));
  }

 private:
  template <class Argument>
  static Values ValueAt(const Curve& curve, const Argument& u, Values value) {
    if (curve.components != 0) Evaluate(curve, Locate(curve.domain, u), value.data());
    return value;
  }

  const glev_plan& plan_;
  std::array<Curve, kAttributes> curves_;
  std::array<Curve, 2> tangents_;
  std::array<std::array<double, kMaxOrder * 4>, kAttributes + 2> points_;  // of these curves
};

}  // namespace glev
