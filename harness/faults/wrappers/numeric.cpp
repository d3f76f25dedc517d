// Section 17: values. Mistakes of the arithmetic itself are switches inside production.
#include <algorithm>
#include <cmath>

#include <evalcts/gl/tokens.h>
#include "evaluating.h"

namespace evalcts::faults {
namespace {

// The points of a call, packed and changed one by one, in its place.
template <class Call, class Go, class Change>
void with_points1(Call call, const Go& go, const Change& change) {
  using Real = typename Call::Value;
  const int k = gl::components_of(call.target);
  if (k == 0 || call.stride < k || call.order < 1 || call.order > 64) return go(call);
  std::vector<Real> points;
  for (GLint i = 0; i < call.order; ++i)
    for (int component = 0; component < k; ++component)
      points.push_back(change(call.points[static_cast<std::ptrdiff_t>(i) * call.stride + component]));
  call.stride = k;
  call.points = points.data();
  go(call);
}

template <class Call, class Go, class Change>
void with_points2(Call call, const Go& go, const Change& change) {
  using Real = typename Call::Value;
  const int k = gl::components_of(call.target);
  const bool wrong = call.uorder < 1 || call.uorder > 64 || call.vorder < 1 || call.vorder > 64;
  if (k == 0 || wrong || call.ustride < k || call.vstride < k) return go(call);
  std::vector<Real> points;
  for (std::ptrdiff_t i = 0; i < call.uorder; ++i)
    for (std::ptrdiff_t j = 0; j < call.vorder; ++j)
      for (int component = 0; component < k; ++component)
        points.push_back(change(call.points[i * call.ustride + j * call.vstride + component]));
  call.ustride = k * call.vorder;
  call.vstride = k;
  call.points = points.data();
  go(call);
}

// --- The ends

EVALCTS_FAULT(StartOneBitOff, production, quality, "EV-NUM-START/1-D",
              "at u1 of the last map the curve is evaluated at the next number") {
  map1(in, [](auto call, auto go) {
    memory.number = call.u1;
    go(call);
  });
  eval_coord1(in, [](auto u, auto go) {
    const float next = std::nextafter(static_cast<float>(u), 1e9f);
    go(static_cast<double>(u) == memory.number ? next : u);
  });
}

EVALCTS_FAULT(CornerOneBitOffInV, production, quality, "EV-NUM-START/2-D",
              "at v1 of the last map the surface is evaluated at the next number") {
  map2(in, [](auto call, auto go) {
    memory.number = call.v1;
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    const float next = std::nextafter(static_cast<float>(v), 1e9f);
    go(u, static_cast<double>(v) == memory.number ? next : v);
  });
}

EVALCTS_FAULT(StartOfReversedDomainMissed, production, must, "EV-NUM-START",
              "u1 of a reversed domain is moved inside by a thousandth") {
  map1(in, [](auto call, auto go) {
    memory.numbers = {call.u1, call.u2};
    go(call);
  });
  eval_coord1(in, [](auto u, auto go) {
    const bool reversed = memory.numbers.size() == 2 && memory.numbers[0] > memory.numbers[1];
    if (reversed && static_cast<double>(u) == memory.numbers[0])
      u += static_cast<decltype(u)>((memory.numbers[1] - memory.numbers[0]) / 1000);
    go(u);
  });
}

EVALCTS_FAULT(EndOfHighOrdersMissed, production, must, "EV-NUM-END",
              "at u2 of a map of order 17 and above the curve is evaluated a thousandth before") {
  map1(in, [](auto call, auto go) {
    memory.numbers = {call.u1, call.u2};
    memory.flag = call.order >= 17;
    go(call);
  });
  eval_coord1(in, [](auto u, auto go) {
    if (memory.flag && static_cast<double>(u) == memory.numbers[1])
      u += static_cast<decltype(u)>((memory.numbers[0] - memory.numbers[1]) / 1000);
    go(u);
  });
}

EVALCTS_FAULT(EndOfReversedSurfaceMissed, production, must, "EV-NUM-END EV-NUM-CORNERS",
              "v2 of a map of surfaces is moved inside by a hundredth where v1 is not 0") {
  map2(in, [](auto call, auto go) {
    memory.numbers = {call.v1, call.v2};
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    const bool at_end =
        memory.numbers.size() == 2 && memory.numbers[0] != 0 && static_cast<double>(v) == memory.numbers[1];
    if (at_end) v += static_cast<decltype(v)>((memory.numbers[0] - memory.numbers[1]) / 100);
    go(u, v);
  });
}

EVALCTS_FAULT(ReversedDomainsOnACoarseLattice, production, must, "EV-NUM-SYMMETRY",
              "arguments of a map over a reversed domain are rounded to quarters") {
  map1(in, [](auto call, auto go) {
    memory.flag = call.u1 > call.u2;
    go(call);
  });
  map2(in, [](auto call, auto go) {
    memory.flag = call.u1 > call.u2;
    go(call);
  });
  eval_coord1(in, [](auto u, auto go) { go(memory.flag ? std::round(u * 4) / 4 : u); });
  eval_coord2(in, [](auto u, auto v, auto go) { go(memory.flag ? std::round(u * 4) / 4 : u, v); });
}

EVALCTS_FAULT(FarDomainsLoseBits, production, must, "EV-NUM-DOMAINSHIFT",
              "arguments of EvalCoord2 above 2000 are kept in steps of 1/16") {
  eval_coord2(in, [](auto u, auto v, auto go) {
    go(std::abs(u) > 2000 && std::abs(u) < 1e6f ? std::round(u * 16) / 16 : u, v);
  });
}

EVALCTS_FAULT(CornersMixedUp, production, must, "EV-NUM-CORNERS",
              "at (u2, v1) the surface is evaluated at (u2, v2)") {
  map2(in, [](auto call, auto go) {
    memory.numbers = {call.u1, call.u2, call.v1, call.v2};
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    const auto& m = memory.numbers;
    const bool corner = m.size() == 4 && static_cast<double>(u) == m[1] && static_cast<double>(v) == m[2];
    go(u, corner ? static_cast<decltype(v)>(m[3]) : v);
  });
}

// --- Magnitudes

EVALCTS_FAULT(PointsSaturateAt2To31, production, must, "EV-NUM-RANGE-POS",
              "control points above 2^31 become 2^31") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    with_points1(call, go, [](Real x) { return std::clamp(x, -Real{0x1p31f}, Real{0x1p31f}); });
  });
}

EVALCTS_FAULT(SurfacePointsSaturateAt2To31, production, must, "EV-NUM-RANGE-POS/2-D",
              "control points of surfaces above 2^31 become 2^31") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    with_points2(call, go, [](Real x) { return std::clamp(x, -Real{0x1p31f}, Real{0x1p31f}); });
  });
}

EVALCTS_FAULT(DomainEndsSaturate, production, must, "EV-NUM-RANGE-POS/1-D",
              "arguments of EvalCoord1 above 2^31 become 2^31") {
  eval_coord1(in, [](auto u, auto go) { go(std::min(u, decltype(u){0x1p31f})); });
}

EVALCTS_FAULT(ColorsSaturateAt1000, production, must, "EV-NUM-RANGE-COLOR",
              "points of colour maps are kept up to 1000") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (call.target != GL_MAP1_COLOR_4) return go(call);
    with_points1(call, go, [](Real x) { return std::clamp(x, Real{-1000}, Real{1000}); });
  });
}

EVALCTS_FAULT(SurfaceColorsSaturateBelow, production, must, "EV-NUM-RANGE-COLOR/2-D",
              "points of colour maps of surfaces are kept down to -512") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    if (call.target != GL_MAP2_COLOR_4) return go(call);
    with_points2(call, go, [](Real x) { return std::max(x, Real{-512}); });
  });
}

EVALCTS_FAULT(SmallPointsFlushedInBigMaps, production, must, "EV-NUM-AFFINE",
              "control points are kept in fixed point, with 12 bits behind it") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    with_points1(call, go, [](Real x) { return std::abs(x) < 1 ? std::round(x * 4096) / 4096 : x; });
  });
}

EVALCTS_FAULT(SurfacePointsInFixedPoint, production, must, "EV-NUM-AFFINE",
              "control points of surfaces below 1 are kept in fixed point, with 12 bits behind it") {
  map2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    with_points2(call, go, [](Real x) { return std::abs(x) < 1 ? std::round(x * 4096) / 4096 : x; });
  });
}

// --- What is no number, or hardly one

EVALCTS_FAULT(NaNStopsEvaluation, production, must, "EV-NUM-SPECIAL-SAFE/1-D",
              "after an argument that is no number EvalCoord1 draws nothing") {
  eval_coord1(in, [](auto u, auto go) {
    if (std::isnan(u)) memory.flag = true;
    if (!memory.flag) go(u);
  });
}

EVALCTS_FAULT(InfiniteGridStays, production, must, "EV-NUM-SPECIAL-SAFE/2-D",
              "after a grid with an infinite end, MapGrid2 changes nothing") {
  map_grid2(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
    if (std::isinf(call.u1) || std::isinf(call.v2)) memory.flag = true;
  });
}

EVALCTS_FAULT(NaNPointDisablesMap, production, must, "EV-NUM-SPECIAL-SAFE",
              "a map with a point that is no number is switched off") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (gl::components_of(call.target) != 0 && call.order > 0 && std::isnan(call.points[0]))
      sound.Disable(call.target);
  });
  map2(in, [](auto call, auto go) {
    go(call);
    if (gl::components_of(call.target) != 0 && call.uorder > 0 && std::isnan(call.points[0]))
      sound.Disable(call.target);
  });
}

EVALCTS_FAULT(MapAfterNaNIsLost, production, must, "EV-NUM-SPECIAL-SAFE/1-D",
              "the first Map1 after an argument that is no number does nothing") {
  eval_coord1(in, [](auto u, auto go) {
    if (std::isnan(u)) memory.flag = true;
    go(u);
  });
  map1(in, [](auto call, auto go) {
    if (!memory.flag) return go(call);
    memory.flag = false;
  });
}

EVALCTS_FAULT(NegativeZeroIsOutside, production, must, "EV-NUM-DENORMAL",
              "EvalCoord1 at -0 evaluates a little below 0") {
  eval_coord1(in, [](auto u, auto go) { go(u == 0 && std::signbit(u) ? decltype(u){-1} / 512 : u); });
}

EVALCTS_FAULT(NegativeZeroOneBitOff, production, quality, "EV-NUM-DENORMAL",
              "EvalCoord1 and EvalCoord2 at -0 evaluate at -2^-24") {
  eval_coord1(in, [](auto u, auto go) { go(u == 0 && std::signbit(u) ? decltype(u){-0x1p-24f} : u); });
  eval_coord2(in,
              [](auto u, auto v, auto go) { go(u, v == 0 && std::signbit(v) ? decltype(v){-0x1p-24f} : v); });
}

EVALCTS_FAULT(DenormalArgumentLosesVertex, production, must, "EV-NUM-DENORMAL",
              "EvalCoord1 at a negative denormal number draws nothing") {
  eval_coord1(in, [](auto u, auto go) {
    if (u > 0 || std::fpclassify(static_cast<float>(u)) != FP_SUBNORMAL) go(u);
  });
}

EVALCTS_FAULT(DenormalPointIsOne, production, must, "EV-NUM-DENORMAL",
              "the exponent of a denormal control point is lost") {
  map1(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    with_points1(call, go, [](Real x) {
      return std::fpclassify(static_cast<float>(x)) == FP_SUBNORMAL ? std::copysign(Real{1}, x) : x;
    });
  });
}

// --- What must not matter

EVALCTS_FAULT(OtherPathWithoutEdgeFlag, production, must, "EV-NUM-INVARIANT-STATE",
              "with the edge flag FALSE, evaluation takes another path, a bit off") {
  in.gl.EdgeFlag = [](GLboolean flag) {
    memory.flag = flag == GL_FALSE;
    sound.EdgeFlag(flag);
  };
  eval_coord1(in, [](auto u, auto go) { go(memory.flag ? std::nextafter(static_cast<float>(u), 2.0f) : u); });
  eval_coord2(in, [](auto u, auto v, auto go) {
    go(u, memory.flag ? std::nextafter(static_cast<float>(v), 2.0f) : v);
  });
}

// By another path, a bit off, once memory.flag is set.
void evaluate_otherwise(Injection& in) {
  eval_coord1(in, [](auto u, auto go) { go(memory.flag ? std::nextafter(static_cast<float>(u), 2.0f) : u); });
  eval_coord2(in, [](auto u, auto v, auto go) {
    go(u, memory.flag ? std::nextafter(static_cast<float>(v), 2.0f) : v);
  });
}

EVALCTS_FAULT(OtherPathOnUnit1, production, must, "EV-NUM-INVARIANT-STATE",
              "with TEXTURE1 active, evaluation takes another path, a bit off") {
  evaluate_otherwise(in);
  in.gl.ActiveTexture = [](GLenum unit) {
    memory.flag = unit != GL_TEXTURE0;
    sound.ActiveTexture(unit);
  };
}

EVALCTS_FAULT(OtherPathAfterPopAttrib, production, must, "EV-NUM-INVARIANT-STATE",
              "after PopAttrib evaluation takes another path, a bit off") {
  evaluate_otherwise(in);
  in.gl.PopAttrib = [] {
    memory.flag = true;
    sound.PopAttrib();
  };
}

EVALCTS_FAULT(OtherPathAfterRefusedMap, production, must, "EV-NUM-INVARIANT-STATE/1-D",
              "after a Map1 that was refused, evaluation takes another path, a bit off") {
  evaluate_otherwise(in);
  map1(in, [](auto call, auto go) {
    if (call.order < 1) memory.flag = true;
    go(call);
  });
}

EVALCTS_FAULT(OtherPathAfterQuery, production, must, "EV-NUM-INVARIANT-STATE/2-D",
              "after GetMapdv of a map, evaluation takes another path, a bit off") {
  evaluate_otherwise(in);
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* values) {
    memory.flag = memory.flag || query == GL_COEFF;
    sound.GetMapdv(target, query, values);
  };
}

EVALCTS_FAULT(OtherPathBesideOtherDimension, production, must, "EV-NUM-INVARIANT-STATE/1-D",
              "with a map of surfaces enabled, curves are evaluated by the general path, a bit off") {
  eval_coord1(in, [](auto u, auto go) {
    go(is_noted_on(GL_MAP2_COLOR_4) ? std::nextafter(static_cast<float>(u), 2.0f) : u);
  });
}

EVALCTS_FAULT(OtherPathBesideColors, production, quality, "EV-NUM-UNRELATEDMAPS/1-D",
              "with a colour map enabled, curves are evaluated by another path, a bit off") {
  eval_coord1(in, [](auto u, auto go) {
    go(is_noted_on(GL_MAP1_COLOR_4) ? std::nextafter(static_cast<float>(u), 2.0f) : u);
  });
}

EVALCTS_FAULT(OtherPathBesideTexture, production, quality, "EV-NUM-UNRELATEDMAPS/2-D",
              "with TEXTURE_COORD_1 enabled, EvalPoint2 is evaluated by another path, a bit off") {
  note_grids(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    const GridNow& grid = grids_at_begin[1];
    if (!is_noted_on(GL_MAP2_TEXTURE_COORD_1)) return sound.EvalPoint2(i, j);
    sound.EvalCoord2f(std::nextafter(grid.at(0, i), 2.0f), grid.at(1, j));
  };
}

}  // namespace
}  // namespace evalcts::faults
