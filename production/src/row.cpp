#include "production/src/row.h"

#include "production/src/fault.h"
#include "production/src/normal.h"

namespace glev {
void Row::MoveTo(const GridArgument& v) {
  v_ = v;
  const auto cut = [&](const Surface& surface, std::size_t slot) -> Curve {
    if (surface.components == 0) return {};
    const bool same_start = GLEV_FAULTY(VFromStartOfU) && surface.domain[1].u2 != surface.domain[0].u1;
    const Domain domain = {surface.domain[same_start ? 0 : 1].u1, surface.domain[1].u2};
    return CurveAt(surface, Locate(domain, v), points_[slot].data());
  };
  for (std::size_t a = 0; a < kAttributes; ++a) {
    const auto attribute = static_cast<Attribute>(a);
    if (IsPlain()) curves_[a] = cut(plan_.surface(attribute), a);
  }
  if (!plan_.automatic_normals()) return;
  if (!IsPlain()) return normals_.MoveTo(v);
  if (GLEV_FAULTY(TangentsOfTheFirstRow) && tangents_[0].components != 0) return;
  for (std::size_t direction : {0, 1}) {
    tangents_[direction] = cut(plan_.tangent(static_cast<int>(direction)), kAttributes + direction);
  }
}

void Row::ValuesAt(Attribute attribute, const GridArgument& u, float* values) const {
  if (!IsPlain()) return glev::ValuesAt(plan_, attribute, u, v_, values);
  const Curve& curve = curves_[static_cast<std::size_t>(attribute)];
  const std::array<double, 4> plain = PlainAt(curve, u, {0, 0, 0, 1});
  for (int k = 0; k < 4; ++k) values[k] = static_cast<float>(plain[k]);
}

std::array<double, 4> Row::PlainAt(const Curve& curve, const GridArgument& u, std::array<double, 4> value) {
  if (curve.components != 0) Evaluate(curve, Locate(curve.domain, u), value.data());
  return value;
}

std::array<float, 3> Row::NormalAt(const GridArgument& u) const {
  if (!IsPlain()) return normals_.At(u);
  const auto vertex = static_cast<std::size_t>(Attribute::kVertex);
  const std::array<double, 3> normal = UnitNormal(PlainAt(curves_[vertex], u, {0, 0, 0, 1}),
                                                  PlainAt(tangents_[0], u, {}), PlainAt(tangents_[1], u, {}));
  return {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])};
}

}  // namespace glev
