// Section 13: grids.
#include <cmath>

#include "map_calls.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

EVALCTS_RULES(SegmentsInSixteenBits, production, must, "EV-GRID-SET1",
              "MAP1_GRID_SEGMENTS is kept in 16 bits",
              before(kMapGrid1, kSegments > 65535 && kSegments % 65536 != 0,
                     set(kSegments, kSegments % 65536)));

EVALCTS_FAULT(GridKeptAsStartAndStep, production, must, "EV-GRID-SET1",
              "the grid is kept as u1 and du: u2 is answered as u1 + n * du, in floats") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    memory.count = n;
    sound.MapGrid1f(n, u1, u2);
  };
  in.gl.GetFloatv = [](GLenum pname, GLfloat* v) {
    sound.GetFloatv(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN || memory.count < 1) return;
    const auto n = static_cast<GLfloat>(memory.count);
    const GLfloat step = (v[1] - v[0]) / n;
    v[1] = v[0] + n * step;
  };
}

EVALCTS_RULES(
    LargeGridEndsClamped, production, must, "EV-GRID-SET1", "MapGrid1d clamps the ends to what 2^32 holds",
    before(MapGrid1d, true,
           sequence({set(kU1, max(-0x1p32, min(kU1, 0x1p32))), set(kU2, max(-0x1p32, min(kU2, 0x1p32)))})));
EVALCTS_RULES(GridCountsExchanged, production, must, "EV-GRID-SET2",
              "MapGrid2d takes un for vn where v is reversed",
              before(MapGrid2d, kV1 > kV2, swap(kSegments, kVSegments)));
EVALCTS_RULES(GridEndsInterleaved, production, must, "EV-GRID-SET2",
              "GetDoublev answers MAP2_GRID_DOMAIN as u1, v1, u2, v2",
              after(GetDoublev, kName == GL_MAP2_GRID_DOMAIN, exchange(1, 2)));
EVALCTS_RULES(SquareGridAssumed, production, must, "EV-GRID-SET2",
              "MapGrid2f of one segment in u has one in v",
              before(MapGrid2f, kSegments == 1 && kVSegments > 1, set(kVSegments, 1)));

EVALCTS_FAULT(Grid1SharesU, production, must, "EV-GRID-INDEP",
              "MapGrid1f sets the interval of u of the two-dimensional grid as well") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    sound.MapGrid1f(n, u1, u2);
    GLfloat domain[4];
    GLint segments[2];
    sound.GetFloatv(GL_MAP2_GRID_DOMAIN, domain);
    sound.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments);
    sound.MapGrid2f(segments[0], u1, u2, segments[1], domain[2], domain[3]);
  };
}

EVALCTS_FAULT(Grid2SharesSegments, production, must, "EV-GRID-INDEP",
              "MapGrid2 sets the count of the one-dimensional grid as well") {
  map_grid2(in, [](auto call, auto go) {
    go(call);
    GLfloat domain[2];
    sound.GetFloatv(GL_MAP1_GRID_DOMAIN, domain);
    sound.MapGrid1f(call.un, domain[0], domain[1]);
  });
}

EVALCTS_RULES(NoSegmentsIsOne, production, must, "EV-GRID-ERR-N", "MapGrid1f of no segments is one of one",
              before(MapGrid1f, kSegments == 0, set(kSegments, 1)));
EVALCTS_RULES(LowestSegmentsOverflow, production, must, "EV-GRID-ERR-N",
              "n - 1 < 0 is checked, which overflows for the lowest int",
              before(kMapGrid1, kSegments == std::numeric_limits<GLint>::min(),
                     set(kSegments, std::numeric_limits<GLint>::max())));
EVALCTS_RULES(NegativeSegmentsIgnored, production, must, "EV-GRID-ERR-N",
              "MapGrid1 of -100 segments does nothing and raises nothing",
              skip(kMapGrid1, kSegments == -100));
EVALCTS_RULES(ProductOfCountsChecked, production, must, "EV-GRID-ERR-UN EV-GRID-ERR-VN",
              "two negative counts pass, as their product is positive",
              before(kMapGrid2, kSegments < 0 && kVSegments < 0,
                     sequence({set(kSegments, -kSegments), set(kVSegments, -kVSegments)})));
EVALCTS_RULES(UnZeroTaken, production, must, "EV-GRID-ERR-UN", "MapGrid2d takes un of 0 for 1",
              before(MapGrid2d, kSegments == 0 && kVSegments > 0, set(kSegments, 1)));
EVALCTS_RULES(BadUnIsInvalidOperation, production, must, "EV-GRID-ERR-UN",
              "a bad un alone raises INVALID_OPERATION",
              instead(kMapGrid2, kSegments<0 && kVSegments> 0, error(GL_INVALID_OPERATION)));
EVALCTS_RULES(VnUnchecked, production, must, "EV-GRID-ERR-VN",
              "MapGrid2f checks un twice, and cuts a bad vn to 1",
              before(MapGrid2f, true, set(kVSegments, max(kVSegments, 1))));
EVALCTS_RULES(VnCheckedOnlyBelowZero, production, must, "EV-GRID-ERR-VN", "vn of 0 passes, for 1",
              before(kMapGrid2, kVSegments == 0 && kSegments > 0, set(kVSegments, 1)));

EVALCTS_FAULT(UOfGridSetBeforeVn, production, must, "EV-GRID-ERR-NOEFFECT",
              "a MapGrid2 refused for vn has set un") {
  map_grid2(in, [](auto call, auto go) {
    if (call.un > 0 && call.vn <= 0) {
      GLfloat domain[4];
      GLint segments[2];
      sound.GetFloatv(GL_MAP2_GRID_DOMAIN, domain);
      sound.GetIntegerv(GL_MAP2_GRID_SEGMENTS, segments);
      sound.MapGrid2f(call.un, domain[0], domain[1], segments[1], domain[2], domain[3]);
    }
    go(call);
  });
}

EVALCTS_RULES(RefusedGridKeepsEnds, production, must, "EV-GRID-ERR-NOEFFECT",
              "a MapGrid1d refused for n has set the ends",
              after(MapGrid1d, kSegments <= 0, call(MapGrid1d, {state(GL_MAP1_GRID_SEGMENTS), kU1, kU2})));

EVALCTS_FAULT(GridOfPrimitiveSetAtEnd, production, must, "EV-GRID-ERR-NOEFFECT EV-BE-IGNORED",
              "MapGrid2 in a primitive raises its error and is carried out when the primitive ends") {
  follow_primitives(in);
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
    if (memory.numbers.size() != 6) return;
    const std::vector<double>& g = memory.numbers;
    sound.MapGrid2d(static_cast<GLint>(g[0]), g[1], g[2], static_cast<GLint>(g[3]), g[4], g[5]);
    memory.numbers.clear();
  };
  map_grid2(in, [](auto call, auto go) {
    go(call);
    if (memory.flag)
      memory.numbers = {static_cast<double>(call.un), static_cast<double>(call.u1),
                        static_cast<double>(call.u2), static_cast<double>(call.vn),
                        static_cast<double>(call.v1), static_cast<double>(call.v2)};
  });
}

EVALCTS_RULES(MapGrid1InLineStripSilent, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid1f in a LINE_STRIP raises no error", skip(MapGrid1f, kOpenMode == GL_LINE_STRIP));
EVALCTS_RULES(MapGrid2InPrimitiveIsInvalidValue, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid2d in a primitive raises INVALID_VALUE", before(MapGrid2d, kInside, set(kSegments, 0)));
EVALCTS_RULES(EqualGridEndsRefused, production, must, "EV-GRID-EQUAL",
              "MapGrid1 with u1 = u2 raises INVALID_VALUE, as Map1 does",
              before(kMapGrid1, kU1 == kU2 && kSegments > 1, set(kSegments, 0)));
EVALCTS_RULES(EqualGridEndsOfVWidened, production, must, "EV-GRID-EQUAL",
              "equal ends of v of a grid are moved apart, by 1",
              before(kMapGrid2, kV1 == kV2, set(kV2, kV1 + 1)));
EVALCTS_RULES(EqualGridEndsDrawOnePoint, production, must, "EV-GRID-EQUAL",
              "EvalMesh1 of a grid with equal ends draws its first point only",
              before(kMapGrid1, true, set(kFlag, kU1 == kU2)),
              before(EvalMesh1, kFlag&& kI2 > kI1, set(kI2, kI1)));
EVALCTS_RULES(ReversedGridSorted, production, must, "EV-GRID-REVERSED", "MapGrid1f sorts its ends",
              before(MapGrid1f, kU1 > kU2, swap(kU1, kU2)));

EVALCTS_FAULT(ReversedGridDrawnBackwards, production, must, "EV-GRID-REVERSED",
              "EvalMesh1 of a reversed grid draws from the last index to the first") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.flag = u1 > u2;
    go(n, u1, u2);
  });
  in.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    if (!memory.flag) return;
    for (ObservedPrimitive& primitive : primitives) std::ranges::reverse(primitive.vertices);
  };
}

EVALCTS_RULES(ReversedVOfGridSorted, production, must, "EV-GRID-REVERSED", "MapGrid2f sorts the ends of v",
              before(MapGrid2f, kV1 > kV2, swap(kV1, kV2)));

EVALCTS_FAULT(GridTakesDomainOfMap, production, must, "EV-GRID-NOTMAP/1-D",
              "Map1 of a vertex map sets the ends of the grid that evaluation uses") {
  map1(in, [](auto call, auto go) {
    if (call.target >= GL_MAP1_VERTEX_3)
      memory.numbers = {static_cast<double>(call.u1), static_cast<double>(call.u2)};
    go(call);
  });
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.count = n;
    go(n, u1, u2);
  });
  in.gl.EvalPoint1 = [](GLint i) {
    if (memory.numbers.empty() || memory.count < 1) return sound.EvalPoint1(i);
    const double& u1 = memory.numbers[0];
    sound.EvalCoord1d(u1 + i * (memory.numbers[1] - u1) / static_cast<double>(memory.count));
  };
}

EVALCTS_RULES(LargeCountsRefused, production, must, "EV-GRID-LARGE",
              "more than 2^24 segments, which no float counts, raise INVALID_VALUE",
              before(kMapGrid1, kSegments > 1 << 24, set(kSegments, 0)));
EVALCTS_RULES(ManyPointsRefused, production, must, "EV-GRID-LARGE",
              "a two-dimensional grid of more points than an int counts raises INVALID_VALUE",
              before(kMapGrid2, kSegments > 0 && kVSegments > 0 && kSegments * kVSegments > 0x1p31,
                     set(kSegments, 0)));
EVALCTS_RULES(LastOfLargestGridOverflows, production, must, "EV-GRID-LARGE",
              "the last point of 2^31-1 segments is that of index -1, as i + 1 overflows",
              before(EvalPoint1, kI == std::numeric_limits<GLint>::max(), set(kI, -1)));
EVALCTS_RULES(LastOfLargestGridIsFirst2, production, must, "EV-GRID-LARGE",
              "in two dimensions the last j of 2^31-1 is taken for 0",
              before(EvalPoint2, kJ == std::numeric_limits<GLint>::max(), set(kJ, 0)));

EVALCTS_FAULT(GridOfTheFirstEvaluation, production, must, "EV-GRID-LATE",
              "once points of a grid were evaluated, MapGrid1 of the same count moves none of them") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    if (!memory.flag || memory.count != n) {
      memory.flag = false;
      memory.count = n;
      memory.numbers = {static_cast<double>(u1), static_cast<double>(u2)};
    }
    go(n, u1, u2);
  });
  in.gl.EvalPoint1 = [](GLint i) {
    memory.flag = true;
    if (memory.numbers.empty()) return sound.EvalPoint1(i);
    const auto n = static_cast<double>(memory.count);
    const auto [u1, u2] = std::pair{memory.numbers[0], memory.numbers[1]};
    sound.EvalCoord1d(i == 0 ? u1 : i == memory.count ? u2 : ((n - i) * u1 + i * u2) / n);
  };
}

EVALCTS_RULES(GridRefusedOnOtherUnits, production, must, "EV-GRID-NOUNIT",
              "MapGrid2d raises INVALID_OPERATION with unit 1 active, as Map2 does",
              instead(MapGrid2d, kUnit != GL_TEXTURE0, error(GL_INVALID_OPERATION)));

EVALCTS_FAULT(GridPerUnit, production, must, "EV-GRID-NOUNIT",
              "MapGrid1 with unit 1 active sets a grid that unit 0 does not see") {
  in.gl.ActiveTexture = [](GLenum texture) {
    sound.ActiveTexture(texture);
    if (texture == GL_TEXTURE0 && memory.flag) sound.MapGrid1f(1, 0, 1);
    memory.flag = false;
    memory.count = texture != GL_TEXTURE0;
  };
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.flag = memory.count == 1;
    go(n, u1, u2);
  });
}

EVALCTS_FAULT(DoubleGridKeptApart, production, must, "EV-GRID-FD EV-API-FD/2-D",
              "GetDoublev answers the ends that MapGrid1d gave, although a MapGrid1f came after it") {
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    memory.numbers = {u1, u2};
    sound.MapGrid1d(n, u1, u2);
  };
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    sound.GetDoublev(pname, v);
    if (pname == GL_MAP1_GRID_DOMAIN && !memory.numbers.empty())
      std::copy(memory.numbers.begin(), memory.numbers.end(), v);
  };
}

EVALCTS_FAULT(DoubleGridInHalfPrecision, production, must, "EV-GRID-FD",
              "MapGrid2d rounds the ends to 11 bits") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    const auto half = [](double x) {
      int two = 0;
      const double part = std::frexp(x, &two);
      return std::ldexp(std::round(part * 2048) / 2048, two);
    };
    sound.MapGrid2d(un, half(u1), half(u2), vn, half(v1), half(v2));
  };
}

// ---- What only certain grids show

EVALCTS_RULES(Grid2OfOneRowIsGrid1, production, must, "EV-GRID-INDEP",
              "MapGrid2 of one segment in v sets the one-dimensional grid as well",
              after(kMapGrid2, kVSegments == 1 && kSegments > 0, call(MapGrid1d, {kSegments, kU1, kU2})));

EVALCTS_FAULT(SameCountsSameGrid, production, must, "EV-GRID-SET2",
              "MapGrid2 of the counts and the interval of u that are set leaves that of v") {
  map_grid2(in, [](auto call, auto go) {
    using Real = typename decltype(call)::Value;
    const std::vector<double> key = {static_cast<double>(call.un), static_cast<double>(call.u1),
                                     static_cast<double>(call.u2), static_cast<double>(call.vn)};
    if (memory.numbers.size() == 6 && std::equal(key.begin(), key.end(), memory.numbers.begin())) {
      call.v1 = static_cast<Real>(memory.numbers[4]);
      call.v2 = static_cast<Real>(memory.numbers[5]);
    }
    memory.numbers = key;
    memory.numbers.push_back(static_cast<double>(call.v1));
    memory.numbers.push_back(static_cast<double>(call.v2));
    go(call);
  });
}

EVALCTS_FAULT(SameEndsSameGrid, production, must, "EV-GRID-SET1",
              "MapGrid1 with the ends that are set leaves the count") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    const std::vector<double> ends = {static_cast<double>(u1), static_cast<double>(u2)};
    if (n > 0 && ends == memory.numbers) n = static_cast<GLint>(memory.count);
    if (n > 0) {
      memory.numbers = ends;
      memory.count = n;
    }
    go(n, u1, u2);
  });
}

EVALCTS_RULES(GridIgnoredInQuads, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid1 and MapGrid2 in QUADS do nothing and raise nothing",
              skip(kMapGrids, kOpenMode == GL_QUADS));
EVALCTS_RULES(GridRefusedOnLastUnit, production, must, "EV-GRID-NOUNIT",
              "MapGrid1f raises INVALID_OPERATION on units above 1, which have no evaluators",
              instead(MapGrid1f, kUnit > GL_TEXTURE1, error(GL_INVALID_OPERATION)));

}  // namespace
}  // namespace evalcts::faults
