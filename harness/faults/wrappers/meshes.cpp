// Sections 15 and 16: what meshes draw, and their errors.
#include <algorithm>

#include "harness/faults/evaluating.h"

namespace evalcts::faults {
namespace {

bool is_mode1(GLenum mode) { return mode == GL_POINT || mode == GL_LINE; }
bool is_mode2(GLenum mode) { return is_mode1(mode) || mode == GL_FILL; }

// A mesh of curves as a loop of EvalCoord1f; argument(i) is what each index is evaluated at.
template <class Argument>
void loop1(GLenum mode, GLint i1, GLint i2, const Argument& argument) {
  if (!is_mode1(mode) || is_inside() || i1 > i2) return sound.EvalMesh1(mode, i1, i2);
  sound.Begin(mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP);
  for (GLint i = i1; i <= i2; ++i) sound.EvalCoord1f(argument(i));
  sound.End();
}

// The same for FILL: v(j) by the row.
template <class U, class V>
void loop_fill(GLint i1, GLint i2, GLint j1, GLint j2, const U& u, const V& v) {
  for (GLint j = j1; j < j2; ++j) {
    const GLfloat lower = v(j), upper = v(j + 1);
    sound.Begin(GL_QUAD_STRIP);
    for (GLint i = i1; i <= i2; ++i) {
      sound.EvalCoord2f(u(i), lower);
      sound.EvalCoord2f(u(i), upper);
    }
    sound.End();
  }
}

// --- EvalMesh1

EVALCTS_FAULT(CurvePointsBackwards, production, must, "EV-MESH1-POINT",
              "EvalMesh1 with POINT draws from i2 to i1, where i1 is 0") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_POINT || i1 != 0 || i2 <= 0 || is_inside()) return sound.EvalMesh1(mode, i1, i2);
    sound.Begin(GL_POINTS);
    for (GLint i = i2; i >= i1; --i) sound.EvalPoint1(i);
    sound.End();
  };
}

EVALCTS_FAULT(CurveOfEveryOtherSegment, production, must, "EV-MESH1-LINE",
              "EvalMesh1 with LINE draws GL_LINES, as the reference page says") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_LINE || is_inside()) return sound.EvalMesh1(mode, i1, i2);
    sound.Begin(GL_LINES);
    for (GLint i = i1; i <= i2; ++i) sound.EvalPoint1(i);
    sound.End();
  };
}

EVALCTS_FAULT(StripCutAfter64Vertices, production, must, "EV-MESH1-LINE",
              "EvalMesh1 with LINE begins another strip after 64 vertices") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_LINE || i1 > i2 || is_inside() || i2 - i1 > 1 << 20) return sound.EvalMesh1(mode, i1, i2);
    for (GLint i = i1; i <= i2; i += 64) sound.EvalMesh1(mode, i, std::min(i + 63, i2));
  };
}

EVALCTS_FAULT(PointsLostAfter255, production, must, "EV-MESH1-POINT",
              "EvalMesh1 with POINT counts its points in a byte") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const bool many = mode == GL_POINT && i2 >= i1 && i2 - i1 > 255;
    sound.EvalMesh1(mode, i1, many ? i1 + (i2 - i1) % 256 : i2);
  };
}

EVALCTS_FAULT(PartOfMeshFromTheBeginning, production, must, "EV-MESH1-COORDS EV-MESH1-SUBRANGE",
              "EvalMesh1 begins at the first end of the grid, whatever i1") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    i1 > 0 && i2 >= i1 ? sound.EvalMesh1(mode, 0, i2 - i1) : sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(PartOfMeshHasStepOfOneMore, production, must, "EV-MESH1-COORDS EV-MESH1-SUBRANGE",
              "EvalMesh1 of a part of the grid from index 1 on counts points instead of segments") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_inside() || i1 < 1) return sound.EvalMesh1(mode, i1, i2);
    const GridNow grid = grid_now(1);
    if (i2 >= grid.segments[0]) return sound.EvalMesh1(mode, i1, i2);
    sound.MapGrid1f(grid.segments[0] + 1, grid.domain[0], grid.domain[1]);
    sound.EvalMesh1(mode, i1, i2);
    sound.MapGrid1f(grid.segments[0], grid.domain[0], grid.domain[1]);
  };
}

EVALCTS_FAULT(LinesFromTheirOwnStart, production, quality, "EV-MESH1-SUBRANGE",
              "EvalMesh1 with LINE counts its steps from i1, in single precision") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    const float step = grid.at(0, 1) - grid.at(0, 0);
    if (mode != GL_LINE) return sound.EvalMesh1(mode, i1, i2);
    loop1(mode, i1, i2, [&](GLint i) {
      return i == grid.segments[0] ? grid.domain[1] : grid.at(0, i1) + static_cast<float>(i - i1) * step;
    });
  };
}

EVALCTS_FAULT(MeshAddsItsSteps, production, must, "EV-MESH1-NOACCUM",
              "EvalMesh1 adds the step to the last argument in single precision") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    const float step = (grid.domain[1] - grid.domain[0]) / static_cast<float>(grid.segments[0]);
    float u = grid.at(0, i1) - step;
    loop1(mode, i1, i2, [&](GLint i) {
      u += step;
      return i == grid.segments[0] ? grid.domain[1] : i == 0 ? grid.domain[0] : u;
    });
  };
}

EVALCTS_FAULT(CurveMeshByArithmeticAtItsLastIndex, production, must, "EV-MESH1-EXACT-N",
              "EvalMesh1 does its last vertex after the loop, and without the rule for the last index") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    if (i2 != grid.segments[0]) return sound.EvalMesh1(mode, i1, i2);
    loop1(mode, i1, i2, [&](GLint i) { return grid.at(0, i); });
  };
}

EVALCTS_FAULT(CurveMeshExactAtItsOwnEndOnly, production, must, "EV-MESH1-EXACT-N",
              "EvalMesh1 is exact at the last index where that is the last it draws") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    if (i2 <= grid.segments[0]) return sound.EvalMesh1(mode, i1, i2);
    loop1(mode, i1, i2, [&](GLint i) { return grid.at(0, i); });
  };
}

EVALCTS_FAULT(CurveMeshFromNegativeIndexInexact, production, must, "EV-MESH1-EXACT-0",
              "EvalMesh1 from a negative index is not exact at index 0") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    if (i1 >= 0) return sound.EvalMesh1(mode, i1, i2);
    const float step = (grid.domain[1] - grid.domain[0]) / static_cast<float>(grid.segments[0]);
    loop1(mode, i1, i2, [&](GLint i) {
      return i == grid.segments[0] ? grid.domain[1] : grid.at(0, i1) + static_cast<float>(i - i1) * step;
    });
  };
}

EVALCTS_FAULT(CurveMeshFromZeroInexact, production, must, "EV-MESH1-EXACT-0",
              "EvalMesh1 from index 0 counts down from the last end") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(1);
    if (i1 != 0) return sound.EvalMesh1(mode, i1, i2);
    const float step = (grid.domain[1] - grid.domain[0]) / static_cast<float>(grid.segments[0]);
    loop1(mode, i1, i2,
          [&](GLint i) { return grid.domain[1] - static_cast<float>(grid.segments[0] - i) * step; });
  };
}

EVALCTS_FAULT(NegativeIndicesCutOff, production, must, "EV-MESH1-NEGATIVE",
              "EvalMesh1 begins at 0 where i1 is negative and i2 is not") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i2 >= 0 ? std::max(i1, 0) : i1, i2);
  };
}

EVALCTS_FAULT(IndicesBeyondTheGridCutOff, production, must, "EV-MESH1-NEGATIVE",
              "EvalMesh1 with LINE ends at the last index of the grid") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GLint last = is_inside() ? i2 : grid_now(1).segments[0];
    sound.EvalMesh1(mode, i1, mode == GL_LINE && i1 <= last ? std::min(i2, last) : i2);
  };
}

EVALCTS_FAULT(CurveLoopTestsAtItsEnd, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with POINT draws i1 before it looks at i2") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, mode == GL_POINT ? std::max(i1, i2) : i2);
  };
}

EVALCTS_FAULT(EmptyCurveIsAnError, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with i1 above i2 by more than 1 raises INVALID_VALUE") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (i1 > i2 + 1 && is_mode1(mode)) raise_invalid_value();
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(EmptyCurveBackwards, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with LINE and i1 above i2 draws from i2 to i1") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    mode == GL_LINE&& i1 > i2 ? sound.EvalMesh1(mode, i2, i1) : sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(LineOfOneVertexIsAPoint, production, must, "EV-MESH1-SINGLE",
              "EvalMesh1 with LINE and i1 = i2 draws a point") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode == GL_LINE && i1 == i2 ? GL_POINT : mode, i1, i2);
  };
}

EVALCTS_FAULT(SinglePointIsNothing, production, must, "EV-MESH1-SINGLE",
              "EvalMesh1 with POINT and i1 = i2 draws nothing") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, mode == GL_POINT && i1 == i2 ? i1 - 1 : i2);
  };
}

EVALCTS_FAULT(FillTakenForCurves, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 takes FILL and draws nothing") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_FILL) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(BadModeOfCurveIsInvalidValue, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 raises INVALID_VALUE for the modes of Begin") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode <= GL_POLYGON) return raise_invalid_value();
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(BadModeOfCurveDrawsPoints, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 raises INVALID_ENUM for LINE_STRIP, and draws it") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode == GL_LINE_STRIP && !is_inside()) sound.EvalMesh1(GL_POINT, i1, i2);
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshInsideIsIgnored, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 between Begin and End does nothing, without the error, where its range is empty") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (!is_inside() || i1 <= i2) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshInsideDraws, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 between Begin and End raises the error and adds its first vertex") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_inside() && mode == GL_LINE) sound.EvalPoint1(i1);
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(ModeOfCurveUncheckedWithoutMap, production, must, "EV-MESH1-ERR-FIRST",
              "EvalMesh1 looks for a vertex map before it looks at the mode") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (has_vertex_map(1)) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(ModeOfEmptyCurveUnchecked, production, must, "EV-MESH1-ERR-FIRST",
              "EvalMesh1 with an empty range does not look at the mode") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (i1 <= i2) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshOfColorMapDraws, production, must, "EV-MESH1-NOVERTEX",
              "EvalMesh1 with a colour map and no vertex map draws the initial point") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_noted_on(GL_MAP1_COLOR_4) && !has_vertex_map(1) && is_mode1(mode) && !is_inside()) {
      sound.Begin(mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP);
      for (GLint i = i1; i <= i2; ++i) sound.Vertex4f(0, 0, 0, 1);
      sound.End();
    }
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshWithoutVertexMapIsAnError, production, must, "EV-MESH1-NOVERTEX",
              "EvalMesh1 without a vertex map raises INVALID_OPERATION") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (!has_vertex_map(1) && is_mode1(mode) && !is_inside()) sound.End();
    sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshTakesTheGridOfU, production, must, "EV-MESH1-ONLY1D",
              "EvalMesh1 takes the segments of u of the two-dimensional grid") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_inside() || !sound.IsEnabled(GL_MAP2_COLOR_4)) return sound.EvalMesh1(mode, i1, i2);
    const GridNow own = grid_now(1);
    sound.MapGrid1f(grid_now(2).segments[0], own.domain[0], own.domain[1]);
    sound.EvalMesh1(mode, i1, i2);
    sound.MapGrid1f(own.segments[0], own.domain[0], own.domain[1]);
  };
}

EVALCTS_FAULT(CurveMeshTakesTheColorMapOfSurfaces, production, must, "EV-MESH1-ONLY1D",
              "EvalMesh1 with a colour map of surfaces enabled colours by that of curves") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const bool wrong = !is_inside() && sound.IsEnabled(GL_MAP2_COLOR_4) && !sound.IsEnabled(GL_MAP1_COLOR_4);
    if (wrong) sound.Enable(GL_MAP1_COLOR_4);
    sound.EvalMesh1(mode, i1, i2);
    if (wrong) sound.Disable(GL_MAP1_COLOR_4);
  };
}

EVALCTS_FAULT(CurveMeshWhiteWithoutColorMap, production, must, "EV-MESH1-CURRENT",
              "vertices of EvalMesh1 without a colour map are opaque") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_inside()) return sound.EvalMesh1(mode, i1, i2);
    GLfloat now[4] = {};
    sound.GetFloatv(GL_CURRENT_COLOR, now);
    sound.Color4f(now[0], now[1], now[2], 1);
    sound.EvalMesh1(mode, i1, i2);
    sound.Color4f(now[0], now[1], now[2], now[3]);
  };
}

EVALCTS_FAULT(CurveMeshKeepsTheFirstTexCoord, production, must, "EV-MESH1-CURRENT",
              "a second EvalMesh1 has the texture coordinates that were current at the first") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_inside()) return sound.EvalMesh1(mode, i1, i2);
    GLfloat now[4] = {};
    sound.GetFloatv(GL_CURRENT_TEXTURE_COORDS, now);
    if (memory.numbers.empty()) memory.numbers = {now[0], now[1], now[2], now[3]};
    sound.TexCoord4dv(memory.numbers.data());
    sound.EvalMesh1(mode, i1, i2);
    sound.TexCoord4fv(now);
  };
}

EVALCTS_FAULT(CountOfCurvePointsOverflows, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 counts its vertices with an int, which overflows where i1 is far above i2") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const auto steps = static_cast<GLint>(static_cast<GLuint>(i2) - static_cast<GLuint>(i1));
    const bool overflown = i1 > i2 && steps >= 0 && steps < 1000;
    overflown ? sound.EvalMesh1(mode, 0, steps) : sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshInsideIsInvalidEnum, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 with LINE between Begin and End raises INVALID_ENUM") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    is_inside() && mode == GL_LINE ? raise_invalid_enum() : sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(CurveMeshAfterDisableOfItsMap, production, must, "EV-MESH1-NOVERTEX",
              "EvalMesh1 still draws the vertex map that was disabled last") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP1_VERTEX_3 || cap == GL_MAP1_VERTEX_4) memory.number = on ? 0 : cap;
  });
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const auto map = static_cast<GLenum>(memory.number);
    const bool stale = map != 0 && !is_inside() && !has_vertex_map(1);
    if (stale) sound.Enable(map);
    sound.EvalMesh1(mode, i1, i2);
    if (stale) sound.Disable(map);
  };
}

EVALCTS_FAULT(CurveMeshOfListNeedsItsMapAtOnce, production, must, "EV-MESH1-POINT",
              "EvalMesh1 goes into a list only where a vertex map is enabled while it is compiled") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const bool lost = is_mode1(mode) && !is_inside() && is_compiling() &&
                      !sound.IsEnabled(GL_MAP1_VERTEX_3) && !sound.IsEnabled(GL_MAP1_VERTEX_4);
    if (!lost) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(BadModeOfListLost, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 with a wrong mode is not compiled: its error is lost") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (is_mode1(mode) || is_inside() || !is_compiling()) sound.EvalMesh1(mode, i1, i2);
  };
}

// --- EvalMesh2

EVALCTS_FAULT(MeshOfListIn8Bits, production, must, "EV-MESH2-COORDS",
              "lists keep 8 bits of the indices of rows of EvalMesh2") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (is_inside() || !is_compiling()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.EvalMesh2(mode, i1, i2, static_cast<GLbyte>(j1), static_cast<GLbyte>(j2));
  };
}

EVALCTS_FAULT(LastCornerByArithmetic, production, must, "EV-MESH2-EXACT",
              "EvalMesh2 with POINT has the rules for the last indices, but not where both are") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_POINT || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    sound.Begin(GL_POINTS);
    for (GLint j = j1; j <= j2; ++j)
      for (GLint i = i1; i <= i2; ++i)
        i == grid.segments[0] && j == grid.segments[1] ? sound.EvalCoord2f(grid.at(0, i), grid.at(1, j))
                                                       : sound.EvalPoint2(i, j);
    sound.End();
  };
}

EVALCTS_FAULT(SurfaceMeshWithoutVertexMapSetsNormal, production, must, "EV-COORD-NOVERTEX",
              "EvalMesh2 with a normal map and no vertex map sets the current normal") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_noted_on(GL_MAP2_NORMAL) && !has_vertex_map(2) && !is_inside()) sound.Normal3f(0, 0, 1);
  };
}

EVALCTS_FAULT(QuadStripsCutAfter32Columns, production, must, "EV-MESH2-FILL",
              "EvalMesh2 with FILL begins another strip after 32 columns, and loses the quads between") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool wide = mode == GL_FILL && i2 > i1 && i2 - i1 < 1 << 16;
    if (!wide) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j < j2; ++j)
      for (GLint i = i1; i < i2; i += 32) sound.EvalMesh2(mode, i, std::min(i + 31, i2), j, j + 1);
  };
}

EVALCTS_FAULT(ColumnsOfAtMost64Vertices, production, must, "EV-MESH2-LINE",
              "strips along v of LINE end after 64 vertices") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 > i2 || j2 - j1 < 64)
      return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j <= j2; ++j) sound.EvalMesh2(GL_LINE, i1, i2, j, j);
    for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(GL_LINE, i, i, j1, j1 + 63);
  };
}

EVALCTS_FAULT(RowsCountedInAByte, production, must, "EV-MESH2-COORDS",
              "EvalMesh2 with POINT keeps the index of a row in 8 bits") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool far = mode == GL_POINT && j1 > 127 && j2 >= j1 && j2 / 256 == j1 / 256;
    far ? sound.EvalMesh2(mode, i1, i2, j1 % 256, j2 % 256) : sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(ModeOfEmptyColumnsUnchecked, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 with an empty range of i alone does not look at the mode") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (i1 <= i2 || j1 > j2) sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(CountOfRowsOverflows, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 counts its rows with an int, which overflows where j1 is far above j2") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const auto steps = static_cast<GLint>(static_cast<GLuint>(j2) - static_cast<GLuint>(j1));
    const bool overflown = j1 > j2 && steps >= 0 && steps < 1000;
    overflown ? sound.EvalMesh2(mode, i1, i2, 0, steps) : sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshAfterDisableOfItsMap, production, must, "EV-MESH2-NOVERTEX",
              "EvalMesh2 with FILL still draws the vertex map that was disabled last") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP2_VERTEX_3 || cap == GL_MAP2_VERTEX_4) memory.number = on ? 0 : cap;
  });
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const auto map = static_cast<GLenum>(memory.number);
    const bool stale = map != 0 && mode == GL_FILL && !is_inside() && !has_vertex_map(2);
    if (stale) sound.Enable(map);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (stale) sound.Disable(map);
  };
}

EVALCTS_FAULT(SurfacePointsByColumns, production, must, "EV-MESH2-POINT",
              "EvalMesh2 with POINT has j in its inner loop") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_POINT || i1 > i2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(mode, i, i, j1, j2);
  };
}

EVALCTS_FAULT(LastRowOfPointsForgotten, production, must, "EV-MESH2-POINT",
              "EvalMesh2 with POINT draws no row j2, but where it is the only one") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, mode == GL_POINT && j2 > j1 ? j2 - 1 : j2);
  };
}

// Rows and columns of LINE, each by itself.
void rows(GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint j = j1; j <= j2; ++j) sound.EvalMesh2(GL_LINE, i1, i2, j, j);
}
void columns(GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(GL_LINE, i, i, j1, j2);
}

EVALCTS_FAULT(ColumnsBeforeRows, production, must, "EV-MESH2-LINE",
              "EvalMesh2 with LINE draws the strips along v first") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 >= i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    columns(i1, i2, j1, j2);
    rows(i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(LastColumnForgotten, production, must, "EV-MESH2-LINE EV-MESH2-LINE-OVERLAP",
              "EvalMesh2 with LINE draws no strip along v at i2") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 >= i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    rows(i1, i2, j1, j2);
    columns(i1, i2 - 1, j1, j2);
  };
}

EVALCTS_FAULT(RowsAndColumnsInTurn, production, must, "EV-MESH2-LINE",
              "EvalMesh2 with LINE on square ranges draws a row and a column in turn") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 >= i2 || i2 - i1 != j2 - j1)
      return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint k = 0; k <= i2 - i1; ++k) {
      rows(i1, i2, j1 + k, j1 + k);
      columns(i1 + k, i1 + k, j1, j2);
    }
  };
}

EVALCTS_FAULT(ColumnsOverTheRangeOfU, production, must, "EV-MESH2-LINE",
              "the second loop of LINE goes over j as the misprinted page has it") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 >= i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    rows(i1, i2, j1, j2);
    columns(i1, std::min(i2, i1 + (j2 - j1)), j1, j2);
  };
}

EVALCTS_FAULT(InnerColumnsMerged, production, must, "EV-MESH2-LINE-OVERLAP",
              "EvalMesh2 with LINE draws strips along v at the borders only") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 >= i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    rows(i1, i2, j1, j2);
    columns(i1, i1, j1, j2);
    columns(i2, i2, j1, j2);
  };
}

EVALCTS_FAULT(QuadsByColumns, production, must, "EV-MESH2-FILL", "EvalMesh2 with FILL draws strips along v") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside() || i1 >= i2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint i = i1; i < i2; ++i) sound.EvalMesh2(mode, i, i + 1, j1, j2);
  };
}

EVALCTS_FAULT(RowsOfQuadsFromTheLast, production, must, "EV-MESH2-FILL",
              "EvalMesh2 with FILL draws its strips from j2 down") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside() || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j2; j-- > j1;) sound.EvalMesh2(mode, i1, i2, j, j + 1);
  };
}

EVALCTS_FAULT(QuadsTurnedRound, production, must, "EV-MESH2-FILL",
              "EvalMesh2 with FILL gives (i, j+1) before (i, j)") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j < j2; ++j) {
      sound.Begin(GL_QUAD_STRIP);
      for (GLint i = i1; i <= i2; ++i) {
        sound.EvalPoint2(i, j + 1);
        sound.EvalPoint2(i, j);
      }
      sound.End();
    }
  };
}

EVALCTS_FAULT(LastQuadOfOddStripsLost, production, must, "EV-MESH2-FILL",
              "EvalMesh2 with FILL loses the last quad where a strip has more than two and an odd number") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool odd = mode == GL_FILL && i2 - i1 > 2 && (i2 - i1) % 2 == 1;
    sound.EvalMesh2(mode, i1, odd ? i2 - 1 : i2, j1, j2);
  };
}

EVALCTS_FAULT(StepOfRowsFromSegmentsOfU, production, must, "EV-MESH2-COORDS",
              "EvalMesh2 divides the range of v by the segments of u") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow own = grid_now(2);
    const auto& [u1, u2, v1, v2] = own.domain;
    sound.MapGrid2f(own.segments[0], u1, u2, own.segments[0], v1, v2);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.MapGrid2f(own.segments[0], u1, u2, own.segments[1], v1, v2);
  };
}

EVALCTS_FAULT(PartOfSurfaceFromTheFirstRow, production, must, "EV-MESH2-COORDS",
              "EvalMesh2 with FILL begins at the first row of the grid, whatever j1, if i1 is not 0") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool wrong = mode == GL_FILL && i1 > 0 && j1 > 0 && j2 >= j1;
    wrong ? sound.EvalMesh2(mode, i1, i2, 0, j2 - j1) : sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(UpperRowByOneMoreStep, production, must, "EV-MESH2-EXACT",
              "EvalMesh2 with FILL adds a step to the lower row for the upper one") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const float step = (grid.domain[3] - grid.domain[2]) / static_cast<float>(grid.segments[1]);
    const auto exact = [&](int d, GLint i) {
      return i == grid.segments[d] ? grid.domain[2 * d + 1] : grid.at(d, i);
    };
    for (GLint j = j1; j < j2; ++j) {
      const float lower = exact(1, j), upper = lower + step;
      loop_fill(
          i1, i2, j, j + 1, [&](GLint i) { return exact(0, i); },
          [&](GLint row) { return row == j ? lower : upper; });
    }
  };
}

EVALCTS_FAULT(ColumnsEndByArithmetic, production, must, "EV-MESH2-EXACT",
              "strips along v of LINE have no rule for the last index of v") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 > i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    rows(i1, i2, j1, j2);
    for (GLint i = i1; i <= i2; ++i) {
      sound.Begin(GL_LINE_STRIP);
      for (GLint j = j1; j <= j2; ++j)
        sound.EvalCoord2f(i == grid.segments[0] ? grid.domain[1] : grid.at(0, i), grid.at(1, j));
      sound.End();
    }
  };
}

EVALCTS_FAULT(PointsOfLastColumnByArithmetic, production, must, "EV-MESH2-EXACT",
              "EvalMesh2 with POINT has no rule for the last index of u") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_POINT || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    sound.Begin(GL_POINTS);
    for (GLint j = j1; j <= j2; ++j)
      for (GLint i = i1; i <= i2; ++i)
        i == grid.segments[0]
            ? sound.EvalCoord2f(grid.at(0, i), j == grid.segments[1] ? grid.domain[3] : grid.at(1, j))
            : sound.EvalPoint2(i, j);
    sound.End();
  };
}

EVALCTS_FAULT(SurfaceExactBeforeItsLastColumn, production, must, "EV-MESH2-EXACT",
              "EvalMesh2 with FILL does its last column without the rule for the last index of u") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const GridNow grid = is_inside() ? GridNow{} : grid_now(2);
    if (mode != GL_FILL || is_inside() || i2 != grid.segments[0])
      return sound.EvalMesh2(mode, i1, i2, j1, j2);
    loop_fill(
        i1, i2, j1, j2, [&](GLint i) { return grid.at(0, i); },
        [&](GLint j) { return j == grid.segments[1] ? grid.domain[3] : grid.at(1, j); });
  };
}

EVALCTS_FAULT(RowsAddTheirSteps, production, must, "EV-MESH2-NOACCUM",
              "EvalMesh2 with FILL adds up the steps of v in single precision") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const float step = (grid.domain[3] - grid.domain[2]) / static_cast<float>(grid.segments[1]);
    float last = grid.at(1, j1);
    for (GLint j = j1; j < j2; ++j) {
      const float lower = last, upper = j + 1 == grid.segments[1] ? grid.domain[3] : last + step;
      last = upper;
      loop_fill(
          i1, i2, j, j + 1, [&](GLint i) { return i == grid.segments[0] ? grid.domain[1] : grid.at(0, i); },
          [&](GLint row) { return row == j ? lower : upper; });
    }
  };
}

EVALCTS_FAULT(RowsOfPointsAddTheirSteps, production, must, "EV-MESH2-NOACCUM",
              "EvalMesh2 with POINT adds up the steps of u in single precision") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_POINT || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const float step = (grid.domain[1] - grid.domain[0]) / static_cast<float>(grid.segments[0]);
    sound.Begin(GL_POINTS);
    for (GLint j = j1; j <= j2; ++j) {
      float u = grid.at(0, i1);
      for (GLint i = i1; i <= i2; ++i, u += step)
        sound.EvalCoord2f(i == grid.segments[0] ? grid.domain[1] : u,
                          j == grid.segments[1] ? grid.domain[3] : grid.at(1, j));
    }
    sound.End();
  };
}

EVALCTS_FAULT(CracksBetweenStrips, production, must, "EV-MESH2-SHAREDROW",
              "the upper side of a strip is evaluated one bit above the lower side of the next") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const float step = (grid.domain[3] - grid.domain[2]) / static_cast<float>(grid.segments[1]);
    const auto exact = [&](int d, GLint i) {
      return i == grid.segments[d] ? grid.domain[2 * d + 1] : grid.at(d, i);
    };
    for (GLint j = j1; j < j2; ++j)
      loop_fill(
          i1, i2, j, j + 1, [&](GLint i) { return exact(0, i); },
          [&](GLint row) {
            return row == j || row == grid.segments[1] ? exact(1, row) : exact(1, j) + step;
          });
  };
}

EVALCTS_FAULT(CrossingsOfLinesMissByABit, production, must, "EV-MESH2-SHAREDROW",
              "strips along v of LINE are evaluated in single precision, those along u in double") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || is_inside() || i1 > i2 || j1 >= j2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const auto exact = [&](int d, GLint i) {
      return i == grid.segments[d] ? grid.domain[2 * d + 1] : grid.at(d, i);
    };
    rows(i1, i2, j1, j2);
    for (GLint i = i1; i <= i2; ++i) {
      sound.Begin(GL_LINE_STRIP);
      for (GLint j = j1; j <= j2; ++j) sound.EvalCoord2f(exact(0, i), exact(1, j));
      sound.End();
    }
  };
}

EVALCTS_FAULT(FillInSinglePrecision, production, quality, "EV-MESH2-MODESAGREE",
              "the arguments of FILL are rounded to single precision, those of LINE and POINT are not") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL || is_inside()) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow grid = grid_now(2);
    const auto exact = [&](int d, GLint i) {
      return i == grid.segments[d] ? grid.domain[2 * d + 1] : grid.at(d, i);
    };
    loop_fill(
        i1, i2, j1, j2, [&](GLint i) { return exact(0, i); }, [&](GLint j) { return exact(1, j); });
  };
}

EVALCTS_FAULT(EmptyRowsStillDrawAPoint, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with POINT draws i1 of each row before it looks at i2") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, mode == GL_POINT ? std::max(i1, i2) : i2, j1, j2);
  };
}

EVALCTS_FAULT(StripOfNoHeightIsDrawn, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with FILL and j1 = j2 draws one strip") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, mode == GL_FILL && j1 == j2 ? j2 + 1 : j2);
  };
}

EVALCTS_FAULT(EmptySurfaceIsAnError, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with LINE and both ranges empty raises INVALID_VALUE") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode == GL_LINE && i1 > i2 && j1 > j2) raise_invalid_value();
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(LinesOfOneColumnAreNothing, production, must, "EV-MESH2-LINE-DEGENERATE",
              "EvalMesh2 with LINE and i1 = i2 draws nothing") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || i1 != i2) sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(LinesOfOnePointAreAPoint, production, must, "EV-MESH2-LINE-DEGENERATE",
              "EvalMesh2 with LINE and one point draws a point") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode == GL_LINE && i1 == i2 && j1 == j2 ? GL_POINT : mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(RowsBeyondTheGridCutOff, production, must, "EV-MESH2-RANGE",
              "EvalMesh2 with FILL ends at the last row of the grid") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const GLint last = is_inside() ? j2 : grid_now(2).segments[1];
    sound.EvalMesh2(mode, i1, i2, j1, mode == GL_FILL && j1 < last ? std::min(j2, last) : j2);
  };
}

EVALCTS_FAULT(NegativeColumnsAtZero, production, must, "EV-MESH2-RANGE",
              "EvalMesh2 with LINE begins at column 0 where i1 is negative") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, mode == GL_LINE && i2 >= 0 ? std::max(i1, 0) : i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(QuadStripTakenAsMode, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 takes QUAD_STRIP for FILL") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode == GL_QUAD_STRIP ? GL_FILL : mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(ModeAfterFillIsInvalidValue, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 raises INVALID_VALUE for the token after FILL") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode == GL_FILL + 1) return raise_invalid_value();
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(BadModeOfSurfaceDraws, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 raises INVALID_ENUM for QUADS, and draws points") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode == GL_QUADS && !is_inside()) sound.EvalMesh2(GL_POINT, i1, i2, j1, j2);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshInsideEndsPrimitive, production, must, "EV-MESH2-ERR-BEGINEND",
              "EvalMesh2 between Begin and End raises the error and begins the primitive anew") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (!is_inside()) return;
    sound.End();
    sound.Begin(open_mode());
  };
}

EVALCTS_FAULT(SurfaceMeshInsideWithoutMapIsIgnored, production, must, "EV-MESH2-ERR-BEGINEND",
              "EvalMesh2 between Begin and End without a vertex map is no error") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (!is_inside() || has_vertex_map(2)) sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(ModeOfSurfaceUncheckedWithoutMap, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 looks for a vertex map before it looks at the mode") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (has_vertex_map(2)) sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(ModeOfEmptySurfaceUnchecked, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 with an empty range of j does not look at the mode") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (j1 <= j2) sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshOfNormalMapDraws, production, must, "EV-MESH2-NOVERTEX",
              "EvalMesh2 with a normal map and no vertex map draws the initial point") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (is_noted_on(GL_MAP2_NORMAL) && !has_vertex_map(2) && is_mode2(mode) && !is_inside()) {
      sound.Begin(mode == GL_POINT ? GL_POINTS : mode == GL_LINE ? GL_LINE_STRIP : GL_QUAD_STRIP);
      for (GLint i = i1; i <= i2; ++i) sound.Vertex4f(0, 0, 0, 1);
      sound.End();
    }
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshWithoutVertexMapIsAnError, production, must, "EV-MESH2-NOVERTEX",
              "EvalMesh2 with FILL and no vertex map raises INVALID_OPERATION") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (!has_vertex_map(2) && mode == GL_FILL && !is_inside()) sound.End();
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshTakesTheGridOfCurves, production, must, "EV-MESH2-ONLY2D",
              "EvalMesh2 takes the one-dimensional grid for u where a vertex map of curves is enabled") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool curves =
        !is_inside() && (sound.IsEnabled(GL_MAP1_VERTEX_3) || sound.IsEnabled(GL_MAP1_VERTEX_4));
    if (!curves) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GridNow own = grid_now(2), other = grid_now(1);
    const auto& [u1, u2, v1, v2] = own.domain;
    sound.MapGrid2f(other.segments[0], other.domain[0], other.domain[1], own.segments[1], v1, v2);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.MapGrid2f(own.segments[0], u1, u2, own.segments[1], v1, v2);
  };
}

EVALCTS_FAULT(SurfaceMeshTakesTheEnableOfCurves, production, must, "EV-MESH2-ONLY2D",
              "EvalMesh2 with LINE asks whether MAP1_NORMAL is enabled") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool wrong = !is_inside() && mode == GL_LINE && sound.IsEnabled(GL_MAP1_NORMAL) &&
                       !sound.IsEnabled(GL_MAP2_NORMAL);
    if (wrong) sound.Enable(GL_MAP2_NORMAL);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (wrong) sound.Disable(GL_MAP2_NORMAL);
  };
}

}  // namespace
}  // namespace evalcts::faults
