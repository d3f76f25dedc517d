// Section 14: EvalPoint.
#include <algorithm>
#include <cmath>

#include "evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(StepInFixedPoint, production, must, "EV-POINT1-EQUIV EV-POINT-LIKEMESH",
              "EvalPoint1 keeps 16 bits behind the point of the step") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GridNow& grid = grids_at_begin[0];
    const float step = std::round((grid.domain[1] - grid.domain[0]) / grid.segments[0] * 65536) / 65536;
    i == grid.segments[0] ? sound.EvalPoint1(i)
                          : sound.EvalCoord1f(static_cast<float>(i) * step + grid.domain[0]);
  };
}

EVALCTS_FAULT(EvalPoint1TakesTheGridOfU, production, must, "EV-POINT1-EQUIV",
              "EvalPoint1 takes the grid of u of two dimensions where a vertex map of those is enabled") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    has_vertex_map(2) ? sound.EvalCoord1f(grids_at_begin[1].at(0, i)) : sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(StepOfVFromSegmentsOfU, production, must, "EV-POINT2-EQUIV",
              "EvalPoint2 divides the range of v by the segments of u, but for the last index") {
  note_grids(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    GridNow grid = grids_at_begin[1];
    if (j == grid.segments[1]) return sound.EvalPoint2(i, j);
    grid.segments[1] = grid.segments[0];
    const float u = i == grid.segments[0] ? grid.domain[1] : grid.at(0, i);
    sound.EvalCoord2f(u, grid.at(1, j));
  };
}

EVALCTS_FAULT(PointsFromTheLastEnd, production, must, "EV-POINT-EXACT-0",
              "EvalPoint1 counts from the last end of the grid: the first one is rounded") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GridNow& grid = grids_at_begin[0];
    const float step = (grid.domain[1] - grid.domain[0]) / static_cast<float>(grid.segments[0]);
    sound.EvalCoord1f(grid.domain[1] - static_cast<float>(grid.segments[0] - i) * step);
  };
}

EVALCTS_FAULT(FirstRowFromTheLastEnd, production, must, "EV-POINT-EXACT-0",
              "EvalPoint2 counts v from the last end of the grid: the first row is rounded") {
  note_grids(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    const GridNow& grid = grids_at_begin[1];
    const float step = (grid.domain[3] - grid.domain[2]) / static_cast<float>(grid.segments[1]);
    if (j != 0) return sound.EvalPoint2(i, j);
    sound.EvalCoord2f(i == grid.segments[0] ? grid.domain[1] : grid.at(0, i),
                      grid.domain[3] - static_cast<float>(grid.segments[1]) * step);
  };
}

EVALCTS_FAULT(LastRowByArithmetic, production, must, "EV-POINT-EXACT-N",
              "EvalPoint2 has no rule for the last index of v") {
  note_grids(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    const GridNow& grid = grids_at_begin[1];
    if (j != grid.segments[1]) return sound.EvalPoint2(i, j);
    sound.EvalCoord2f(i == grid.segments[0] ? grid.domain[1] : grid.at(0, i), grid.at(1, j));
  };
}

EVALCTS_FAULT(LastPointByArithmeticInLongGrids, production, must, "EV-POINT-EXACT-N",
              "EvalPoint1 has the rule for the last index up to 64 segments") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GridNow& grid = grids_at_begin[0];
    i == grid.segments[0] && i > 64 ? sound.EvalCoord1f(grid.at(0, i)) : sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(IndexIn16Bits, production, must, "EV-POINT1-EQUIV", "EvalPoint1 keeps 16 bits of its index") {
  in.gl.EvalPoint1 = [](GLint i) {
    sound.EvalPoint1(std::abs(i) < 1 << 20 ? static_cast<GLint>(static_cast<GLshort>(i)) : i);
  };
}

EVALCTS_FAULT(RowIn8Bits, production, must, "EV-POINT2-EQUIV", "EvalPoint2 keeps 8 bits of j") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    sound.EvalPoint2(i, std::abs(j) < 1 << 20 ? static_cast<GLint>(static_cast<GLbyte>(j)) : j);
  };
}

EVALCTS_FAULT(NegativeIndexOfListIsFirst, production, must, "EV-POINT-RANGE",
              "lists keep a negative index of EvalPoint1 as 0") {
  primitives(
      in, [] { memory.flag = is_compiling(); }, [] {});
  in.gl.EvalPoint1 = [](GLint i) { sound.EvalPoint1(memory.flag ? std::max(i, 0) : i); };
}

EVALCTS_FAULT(LastPointExactInRisingGridsOnly, production, must, "EV-POINT-EXACT-N",
              "EvalPoint1 has the rule for the last index where u1 is below u2") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GridNow& grid = grids_at_begin[0];
    const bool falling = i == grid.segments[0] && grid.domain[0] > grid.domain[1];
    falling ? sound.EvalCoord1f(grid.at(0, i)) : sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(LastPointOfOneSegmentByArithmetic, production, must, "EV-POINT-EXACT-N",
              "EvalPoint2 has no rule for the last index of u where that is 1") {
  note_grids(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    const GridNow& grid = grids_at_begin[1];
    if (i != 1 || grid.segments[0] != 1) return sound.EvalPoint2(i, j);
    sound.EvalCoord2f(grid.at(0, i), j == grid.segments[1] ? grid.domain[3] : grid.at(1, j));
  };
}

EVALCTS_FAULT(NegativeIndexIsFirst, production, must, "EV-POINT-RANGE",
              "EvalPoint2 takes a negative j as 0") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) { sound.EvalPoint2(i, std::max(j, 0)); };
}

EVALCTS_FAULT(IndexBeyondTheGridIsLast, production, must, "EV-POINT-RANGE",
              "EvalPoint1 takes an index above the segments by more than one as the last") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GLint last = grids_at_begin[0].segments[0];
    sound.EvalPoint1(i > last + 1 ? last : i);
  };
}

EVALCTS_FAULT(LowestIndexIsAnError, production, must, "EV-POINT-RANGE",
              "EvalPoint2 with the lowest int as j raises an error") {
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (j == -0x7FFFFFFF - 1) raise_inside();
    sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(PointsInSinglePrecision, production, quality, "EV-POINT-LIKEMESH",
              "EvalPoint rounds its argument to single precision, meshes do not") {
  note_grids(in);
  in.gl.EvalPoint1 = [](GLint i) {
    const GridNow& grid = grids_at_begin[0];
    sound.EvalCoord1f(i == grid.segments[0] ? grid.domain[1] : grid.at(0, i));
  };
}

}  // namespace
}  // namespace evalcts::faults
