// Section 13: grids.
#include <cmath>

#include "map_calls.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(SegmentsInSixteenBits, production, must, "EV-GRID-SET1",
              "MAP1_GRID_SEGMENTS is kept in 16 bits") {
  map_grid1(in,
            [](GLint n, auto u1, auto u2, auto go) { go(n > 65535 && n % 65536 ? n % 65536 : n, u1, u2); });
}

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

EVALCTS_FAULT(LargeGridEndsClamped, production, must, "EV-GRID-SET1",
              "MapGrid1d clamps the ends to what 2^32 holds") {
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    sound.MapGrid1d(n, std::clamp(u1, -0x1p32, 0x1p32), std::clamp(u2, -0x1p32, 0x1p32));
  };
}

EVALCTS_FAULT(GridCountsExchanged, production, must, "EV-GRID-SET2",
              "MapGrid2d takes un for vn where v is reversed") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    if (v1 > v2) std::swap(un, vn);
    sound.MapGrid2d(un, u1, u2, vn, v1, v2);
  };
}

EVALCTS_FAULT(GridEndsInterleaved, production, must, "EV-GRID-SET2",
              "GetDoublev answers MAP2_GRID_DOMAIN as u1, v1, u2, v2") {
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    sound.GetDoublev(pname, v);
    if (pname == GL_MAP2_GRID_DOMAIN) std::swap(v[1], v[2]);
  };
}

EVALCTS_FAULT(SquareGridAssumed, production, must, "EV-GRID-SET2",
              "MapGrid2f of one segment in u has one in v") {
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    sound.MapGrid2f(un, u1, u2, un == 1 && vn > 1 ? 1 : vn, v1, v2);
  };
}

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

EVALCTS_FAULT(NoSegmentsIsOne, production, must, "EV-GRID-ERR-N", "MapGrid1f of no segments is one of one") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) { sound.MapGrid1f(n == 0 ? 1 : n, u1, u2); };
}

EVALCTS_FAULT(LowestSegmentsOverflow, production, must, "EV-GRID-ERR-N",
              "n - 1 < 0 is checked, which overflows for the lowest int") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    go(n == std::numeric_limits<GLint>::min() ? std::numeric_limits<GLint>::max() : n, u1, u2);
  });
}

EVALCTS_FAULT(NegativeSegmentsIgnored, production, must, "EV-GRID-ERR-N",
              "MapGrid1 of -100 segments does nothing and raises nothing") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    if (n != -100) go(n, u1, u2);
  });
}

EVALCTS_FAULT(ProductOfCountsChecked, production, must, "EV-GRID-ERR-UN EV-GRID-ERR-VN",
              "two negative counts pass, as their product is positive") {
  map_grid2(in, [](auto call, auto go) {
    if (call.un < 0 && call.vn < 0) {
      call.un = -call.un;
      call.vn = -call.vn;
    }
    go(call);
  });
}

EVALCTS_FAULT(UnZeroTaken, production, must, "EV-GRID-ERR-UN", "MapGrid2d takes un of 0 for 1") {
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    sound.MapGrid2d(un == 0 && vn > 0 ? 1 : un, u1, u2, vn, v1, v2);
  };
}

EVALCTS_FAULT(BadUnIsInvalidOperation, production, must, "EV-GRID-ERR-UN",
              "a bad un alone raises INVALID_OPERATION") {
  map_grid2(in, [](auto call, auto go) {
    if (call.un < 0 && call.vn > 0) return leave_error(GL_INVALID_OPERATION);
    go(call);
  });
}

EVALCTS_FAULT(VnUnchecked, production, must, "EV-GRID-ERR-VN",
              "MapGrid2f checks un twice, and cuts a bad vn to 1") {
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    sound.MapGrid2f(un, u1, u2, std::max(vn, 1), v1, v2);
  };
}

EVALCTS_FAULT(VnCheckedOnlyBelowZero, production, must, "EV-GRID-ERR-VN", "vn of 0 passes, for 1") {
  map_grid2(in, [](auto call, auto go) {
    if (call.vn == 0 && call.un > 0) call.vn = 1;
    go(call);
  });
}

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

EVALCTS_FAULT(RefusedGridKeepsEnds, production, must, "EV-GRID-ERR-NOEFFECT",
              "a MapGrid1d refused for n has set the ends") {
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    sound.MapGrid1d(n, u1, u2);
    if (n > 0) return;
    GLint segments = 1;
    sound.GetIntegerv(GL_MAP1_GRID_SEGMENTS, &segments);
    sound.MapGrid1d(segments, u1, u2);
  };
}

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

EVALCTS_FAULT(MapGrid1InLineStripSilent, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid1f in a LINE_STRIP raises no error") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_LINE_STRIP;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (!memory.flag) sound.MapGrid1f(n, u1, u2);
  };
}

EVALCTS_FAULT(MapGrid2InPrimitiveIsInvalidValue, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid2d in a primitive raises INVALID_VALUE") {
  follow_primitives(in);
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    sound.MapGrid2d(memory.flag ? 0 : un, u1, u2, vn, v1, v2);
  };
}

EVALCTS_FAULT(EqualGridEndsRefused, production, must, "EV-GRID-EQUAL",
              "MapGrid1 with u1 = u2 raises INVALID_VALUE, as Map1 does") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) { go(u1 == u2 && n > 1 ? 0 : n, u1, u2); });
}

EVALCTS_FAULT(EqualGridEndsOfVWidened, production, must, "EV-GRID-EQUAL",
              "equal ends of v of a grid are moved apart, by 1") {
  map_grid2(in, [](auto call, auto go) {
    if (call.v1 == call.v2) call.v2 = call.v1 + 1;
    go(call);
  });
}

EVALCTS_FAULT(EqualGridEndsDrawOnePoint, production, must, "EV-GRID-EQUAL",
              "EvalMesh1 of a grid with equal ends draws its first point only") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.flag = u1 == u2;
    go(n, u1, u2);
  });
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, memory.flag && i2 > i1 ? i1 : i2);
  };
}

EVALCTS_FAULT(ReversedGridSorted, production, must, "EV-GRID-REVERSED", "MapGrid1f sorts its ends") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    sound.MapGrid1f(n, std::min(u1, u2), std::max(u1, u2));
  };
}

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

EVALCTS_FAULT(ReversedVOfGridSorted, production, must, "EV-GRID-REVERSED", "MapGrid2f sorts the ends of v") {
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    sound.MapGrid2f(un, u1, u2, vn, std::min(v1, v2), std::max(v1, v2));
  };
}

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

EVALCTS_FAULT(LargeCountsRefused, production, must, "EV-GRID-LARGE",
              "more than 2^24 segments, which no float counts, raise INVALID_VALUE") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) { go(n > 1 << 24 ? 0 : n, u1, u2); });
}

EVALCTS_FAULT(ManyPointsRefused, production, must, "EV-GRID-LARGE",
              "a two-dimensional grid of more points than an int counts raises INVALID_VALUE") {
  map_grid2(in, [](auto call, auto go) {
    if (call.un > 0 && call.vn > 0 && static_cast<double>(call.un) * call.vn > 0x1p31) call.un = 0;
    go(call);
  });
}

EVALCTS_FAULT(LastOfLargestGridOverflows, production, must, "EV-GRID-LARGE",
              "the last point of 2^31-1 segments is that of index -1, as i + 1 overflows") {
  in.gl.EvalPoint1 = [](GLint i) { sound.EvalPoint1(i == std::numeric_limits<GLint>::max() ? -1 : i); };
}

EVALCTS_FAULT(LastOfLargestGridIsFirst2, production, must, "EV-GRID-LARGE",
              "in two dimensions the last j of 2^31-1 is taken for 0") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    sound.EvalPoint2(i, j == std::numeric_limits<GLint>::max() ? 0 : j);
  };
}

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

EVALCTS_FAULT(GridRefusedOnOtherUnits, production, must, "EV-GRID-NOUNIT",
              "MapGrid2d raises INVALID_OPERATION with unit 1 active, as Map2 does") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    if (memory.flag) return leave_error(GL_INVALID_OPERATION);
    sound.MapGrid2d(un, u1, u2, vn, v1, v2);
  };
}

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

EVALCTS_FAULT(Grid2OfOneRowIsGrid1, production, must, "EV-GRID-INDEP",
              "MapGrid2 of one segment in v sets the one-dimensional grid as well") {
  map_grid2(in, [](auto call, auto go) {
    go(call);
    if (call.vn == 1 && call.un > 0)
      sound.MapGrid1d(call.un, static_cast<double>(call.u1), static_cast<double>(call.u2));
  });
}

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

EVALCTS_FAULT(GridIgnoredInQuads, production, must, "EV-GRID-ERR-BEGINEND",
              "MapGrid1 and MapGrid2 in QUADS do nothing and raise nothing") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_QUADS;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    if (!memory.flag) go(n, u1, u2);
  });
  map_grid2(in, [](auto call, auto go) {
    if (!memory.flag) go(call);
  });
}

EVALCTS_FAULT(GridRefusedOnLastUnit, production, must, "EV-GRID-NOUNIT",
              "MapGrid1f raises INVALID_OPERATION on units above 1, which have no evaluators") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture > GL_TEXTURE1;
    sound.ActiveTexture(texture);
  };
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (memory.flag) return leave_error(GL_INVALID_OPERATION);
    sound.MapGrid1f(n, u1, u2);
  };
}

}  // namespace
}  // namespace evalcts::faults
