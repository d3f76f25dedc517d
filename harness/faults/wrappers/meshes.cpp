// Sections 15 and 16: what meshes draw, and their errors.
#include <algorithm>

#include "evaluating.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

bool is_mode1(GLenum mode) { return mode == GL_POINT || mode == GL_LINE; }
bool is_mode2(GLenum mode) { return is_mode1(mode) || mode == GL_FILL; }

Value is_mode(int dimension) {
  return kMode == GL_POINT || kMode == GL_LINE || (dimension == 2 && kMode == GL_FILL);
}
Value is_compiling_only() { return state(GL_LIST_MODE) == GL_COMPILE; }

// The range has few steps if they are counted modulo 2^32.
Value is_overflown(Value first, Value last) { return last - first + 0x1p32 < 1000; }

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

EVALCTS_RULES(PointsLostAfter255, production, must, "EV-MESH1-POINT",
              "EvalMesh1 with POINT counts its points in a byte",
              before(EvalMesh1, kMode == GL_POINT && kI2 - kI1 > 255, set(kI2, kI1 + (kI2 - kI1) % 256)));
EVALCTS_RULES(PartOfMeshFromTheBeginning, production, must, "EV-MESH1-COORDS EV-MESH1-SUBRANGE",
              "EvalMesh1 begins at the first end of the grid, whatever i1",
              before(EvalMesh1, kI1 > 0 && kI2 >= kI1, sequence({set(kI2, kI2 - kI1), set(kI1, 0)})));

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

EVALCTS_RULES(NegativeIndicesCutOff, production, must, "EV-MESH1-NEGATIVE",
              "EvalMesh1 begins at 0 where i1 is negative and i2 is not",
              before(EvalMesh1, kI2 >= 0, set(kI1, max(kI1, 0))));

EVALCTS_FAULT(IndicesBeyondTheGridCutOff, production, must, "EV-MESH1-NEGATIVE",
              "EvalMesh1 with LINE ends at the last index of the grid") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    const GLint last = is_inside() ? i2 : grid_now(1).segments[0];
    sound.EvalMesh1(mode, i1, mode == GL_LINE && i1 <= last ? std::min(i2, last) : i2);
  };
}

EVALCTS_RULES(CurveLoopTestsAtItsEnd, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with POINT draws i1 before it looks at i2",
              before(EvalMesh1, kMode == GL_POINT, set(kI2, max(kI1, kI2))));
EVALCTS_RULES(EmptyCurveIsAnError, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with i1 above i2 by more than 1 raises INVALID_VALUE",
              before(EvalMesh1, kI1 > kI2 + 1 && is_mode(1), error(GL_INVALID_VALUE)));
EVALCTS_RULES(EmptyCurveBackwards, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 with LINE and i1 above i2 draws from i2 to i1",
              instead(EvalMesh1, kMode == GL_LINE && kI1 > kI2, call(EvalMesh1, {kMode, kI2, kI1})));
EVALCTS_RULES(LineOfOneVertexIsAPoint, production, must, "EV-MESH1-SINGLE",
              "EvalMesh1 with LINE and i1 = i2 draws a point",
              before(EvalMesh1, kMode == GL_LINE && kI1 == kI2, set(kMode, GL_POINT)));
EVALCTS_RULES(SinglePointIsNothing, production, must, "EV-MESH1-SINGLE",
              "EvalMesh1 with POINT and i1 = i2 draws nothing",
              before(EvalMesh1, kMode == GL_POINT && kI1 == kI2, set(kI2, kI1 - 1)));
EVALCTS_RULES(FillTakenForCurves, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 takes FILL and draws nothing", skip(EvalMesh1, kMode == GL_FILL));
EVALCTS_RULES(BadModeOfCurveIsInvalidValue, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 raises INVALID_VALUE for the modes of Begin",
              instead(EvalMesh1, kMode <= GL_POLYGON, error(GL_INVALID_VALUE)));
EVALCTS_RULES(BadModeOfCurveDrawsPoints, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 raises INVALID_ENUM for LINE_STRIP, and draws it",
              before(EvalMesh1, kMode == GL_LINE_STRIP && !kInside, call(EvalMesh1, {GL_POINT, kI1, kI2})));
EVALCTS_RULES(CurveMeshInsideIsIgnored, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 between Begin and End does nothing, without the error, where its range is empty",
              skip(EvalMesh1, kInside&& kI1 > kI2));
EVALCTS_RULES(CurveMeshInsideDraws, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 between Begin and End raises the error and adds its first vertex",
              before(EvalMesh1, kInside&& kMode == GL_LINE, call(EvalPoint1, {kI1})));
EVALCTS_RULES(ModeOfCurveUncheckedWithoutMap, production, must, "EV-MESH1-ERR-FIRST",
              "EvalMesh1 looks for a vertex map before it looks at the mode",
              skip(EvalMesh1, !maps_vertices(1)));
EVALCTS_RULES(ModeOfEmptyCurveUnchecked, production, must, "EV-MESH1-ERR-FIRST",
              "EvalMesh1 with an empty range does not look at the mode", skip(EvalMesh1, kI1 > kI2));

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

EVALCTS_RULES(CurveMeshWithoutVertexMapIsAnError, production, must, "EV-MESH1-NOVERTEX",
              "EvalMesh1 without a vertex map raises INVALID_OPERATION",
              before(EvalMesh1, !maps_vertices(1) && is_mode(1) && !kInside, call(End)));

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

EVALCTS_RULES(CurveMeshTakesTheColorMapOfSurfaces, production, must, "EV-MESH1-ONLY1D",
              "EvalMesh1 with a colour map of surfaces enabled colours by that of curves",
              around(EvalMesh1, !kInside && enabled(GL_MAP2_COLOR_4) && !enabled(GL_MAP1_COLOR_4),
                     call(Enable, {GL_MAP1_COLOR_4}), call(Disable, {GL_MAP1_COLOR_4})));

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

EVALCTS_RULES(CountOfCurvePointsOverflows, production, must, "EV-MESH1-EMPTY",
              "EvalMesh1 counts its vertices with an int, which overflows where i1 is far above i2",
              before(EvalMesh1, kI1 > kI2 && is_overflown(kI1, kI2),
                     sequence({set(kI2, kI2 - kI1 + 0x1p32), set(kI1, 0)})));
EVALCTS_RULES(CurveMeshInsideIsInvalidEnum, production, must, "EV-MESH1-ERR-BEGINEND",
              "EvalMesh1 with LINE between Begin and End raises INVALID_ENUM",
              instead(EvalMesh1, kInside&& kMode == GL_LINE, error(GL_INVALID_ENUM)));
EVALCTS_RULES(CurveMeshAfterDisableOfItsMap, production, must, "EV-MESH1-NOVERTEX",
              "EvalMesh1 still draws the vertex map that was disabled last",
              after(kSwitches, kName == GL_MAP1_VERTEX_3 || kName == GL_MAP1_VERTEX_4,
                    set(kNumber, choose(noted_on(kName), 0, kName))),
              around(EvalMesh1, kNumber && !kInside && !maps_vertices(1), call(Enable, {kNumber}),
                     call(Disable, {kNumber})));
EVALCTS_RULES(CurveMeshOfListNeedsItsMapAtOnce, production, must, "EV-MESH1-POINT",
              "EvalMesh1 goes into a list only where a vertex map is enabled while it is compiled",
              skip(EvalMesh1, is_mode(1) && !kInside && is_compiling_only() && !enabled(GL_MAP1_VERTEX_3) &&
                                  !enabled(GL_MAP1_VERTEX_4)));
EVALCTS_RULES(BadModeOfListLost, production, must, "EV-MESH1-ERR-MODE",
              "EvalMesh1 with a wrong mode is not compiled: its error is lost",
              skip(EvalMesh1, !is_mode(1) && !kInside && is_compiling_only()));

// --- EvalMesh2

EVALCTS_RULES(MeshOfListIn8Bits, production, must, "EV-MESH2-COORDS",
              "lists keep 8 bits of the indices of rows of EvalMesh2",
              before(EvalMesh2, !kInside && is_compiling_only(), lambda([](Call& c) {
                       for (const char row : {'j', 'l'})
                         c.argument(row) = static_cast<GLbyte>(static_cast<GLint>(c.argument(row)));
                       return 0.0;
                     })));

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

EVALCTS_RULES(SurfaceMeshWithoutVertexMapSetsNormal, production, must, "EV-COORD-NOVERTEX",
              "EvalMesh2 with a normal map and no vertex map sets the current normal",
              after(EvalMesh2, noted_on(GL_MAP2_NORMAL) && !maps_vertices(2) && !kInside,
                    call(Normal3f, {0, 0, 1})));

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

EVALCTS_RULES(RowsCountedInAByte, production, must, "EV-MESH2-COORDS",
              "EvalMesh2 with POINT keeps the index of a row in 8 bits",
              before(EvalMesh2,
                     kMode == GL_POINT && kJ1 > 127 && kJ2 >= kJ1 && kJ2 - kJ2 % 256 == kJ1 - kJ1 % 256,
                     sequence({set(kJ1, kJ1 % 256), set(kJ2, kJ2 % 256)})));
EVALCTS_RULES(ModeOfEmptyColumnsUnchecked, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 with an empty range of i alone does not look at the mode",
              skip(EvalMesh2, kI1 > kI2 && kJ1 <= kJ2));
EVALCTS_RULES(CountOfRowsOverflows, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 counts its rows with an int, which overflows where j1 is far above j2",
              before(EvalMesh2, kJ1 > kJ2 && is_overflown(kJ1, kJ2),
                     sequence({set(kJ2, kJ2 - kJ1 + 0x1p32), set(kJ1, 0)})));
EVALCTS_RULES(SurfaceMeshAfterDisableOfItsMap, production, must, "EV-MESH2-NOVERTEX",
              "EvalMesh2 with FILL still draws the vertex map that was disabled last",
              after(kSwitches, kName == GL_MAP2_VERTEX_3 || kName == GL_MAP2_VERTEX_4,
                    set(kNumber, choose(noted_on(kName), 0, kName))),
              around(EvalMesh2, kNumber&& kMode == GL_FILL && !kInside && !maps_vertices(2),
                     call(Enable, {kNumber}), call(Disable, {kNumber})));

EVALCTS_FAULT(SurfacePointsByColumns, production, must, "EV-MESH2-POINT",
              "EvalMesh2 with POINT has j in its inner loop") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_POINT || i1 > i2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(mode, i, i, j1, j2);
  };
}

EVALCTS_RULES(LastRowOfPointsForgotten, production, must, "EV-MESH2-POINT",
              "EvalMesh2 with POINT draws no row j2, but where it is the only one",
              before(EvalMesh2, kMode == GL_POINT && kJ2 > kJ1, set(kJ2, kJ2 - 1)));

// Rows and columns of LINE, each by itself.
void rows(GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint j = j1; j <= j2; ++j) sound.EvalMesh2(GL_LINE, i1, i2, j, j);
}
void columns(GLint i1, GLint i2, GLint j1, GLint j2) {
  for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(GL_LINE, i, i, j1, j2);
}

Value is_net_of_lines() { return kMode == GL_LINE && !kInside && kI1 < kI2 && kJ1 < kJ2; }
double rows(Call& c) {
  const auto at = [&](char letter) { return static_cast<GLint>(c.argument(letter)); };
  rows(at('i'), at('k'), at('j'), at('l'));
  return 0;
}
double columns(Call& c) {
  const auto at = [&](char letter) { return static_cast<GLint>(c.argument(letter)); };
  columns(at('i'), at('k'), at('j'), at('l'));
  return 0;
}

EVALCTS_RULES(ColumnsBeforeRows, production, must, "EV-MESH2-LINE",
              "EvalMesh2 with LINE draws the strips along v first",
              instead(EvalMesh2, is_net_of_lines(), sequence({lambda(columns), lambda(rows)})));
EVALCTS_RULES(LastColumnForgotten, production, must, "EV-MESH2-LINE EV-MESH2-LINE-OVERLAP",
              "EvalMesh2 with LINE draws no strip along v at i2",
              instead(EvalMesh2, is_net_of_lines(),
                      sequence({lambda(rows), set(kI2, kI2 - 1), lambda(columns)})));

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

EVALCTS_RULES(ColumnsOverTheRangeOfU, production, must, "EV-MESH2-LINE",
              "the second loop of LINE goes over j as the misprinted page has it",
              instead(EvalMesh2, is_net_of_lines(),
                      sequence({lambda(rows), set(kI2, min(kI2, kI1 + kJ2 - kJ1)), lambda(columns)})));
EVALCTS_RULES(InnerColumnsMerged, production, must, "EV-MESH2-LINE-OVERLAP",
              "EvalMesh2 with LINE draws strips along v at the borders only",
              instead(EvalMesh2, is_net_of_lines(),
                      sequence({lambda(rows), call(EvalMesh2, {GL_LINE, kI1, kI1, kJ1, kJ2}),
                                call(EvalMesh2, {GL_LINE, kI2, kI2, kJ1, kJ2})})));

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

EVALCTS_RULES(LastQuadOfOddStripsLost, production, must, "EV-MESH2-FILL",
              "EvalMesh2 with FILL loses the last quad where a strip has more than two and an odd number",
              before(EvalMesh2, kMode == GL_FILL && kI2 - kI1 > 2 && (kI2 - kI1) % 2 == 1,
                     set(kI2, kI2 - 1)));

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

EVALCTS_RULES(PartOfSurfaceFromTheFirstRow, production, must, "EV-MESH2-COORDS",
              "EvalMesh2 with FILL begins at the first row of the grid, whatever j1, if i1 is not 0",
              before(EvalMesh2, kMode == GL_FILL && kI1 > 0 && kJ1 > 0 && kJ2 >= kJ1,
                     sequence({set(kJ2, kJ2 - kJ1), set(kJ1, 0)})));

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

EVALCTS_RULES(EmptyRowsStillDrawAPoint, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with POINT draws i1 of each row before it looks at i2",
              before(EvalMesh2, kMode == GL_POINT, set(kI2, max(kI1, kI2))));
EVALCTS_RULES(StripOfNoHeightIsDrawn, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with FILL and j1 = j2 draws one strip",
              before(EvalMesh2, kMode == GL_FILL && kJ1 == kJ2, set(kJ2, kJ2 + 1)));
EVALCTS_RULES(EmptySurfaceIsAnError, production, must, "EV-MESH2-EMPTY",
              "EvalMesh2 with LINE and both ranges empty raises INVALID_VALUE",
              before(EvalMesh2, kMode == GL_LINE && kI1 > kI2 && kJ1 > kJ2, error(GL_INVALID_VALUE)));
EVALCTS_RULES(LinesOfOneColumnAreNothing, production, must, "EV-MESH2-LINE-DEGENERATE",
              "EvalMesh2 with LINE and i1 = i2 draws nothing",
              skip(EvalMesh2, kMode == GL_LINE && kI1 == kI2));
EVALCTS_RULES(LinesOfOnePointAreAPoint, production, must, "EV-MESH2-LINE-DEGENERATE",
              "EvalMesh2 with LINE and one point draws a point",
              before(EvalMesh2, kMode == GL_LINE && kI1 == kI2 && kJ1 == kJ2, set(kMode, GL_POINT)));

EVALCTS_FAULT(RowsBeyondTheGridCutOff, production, must, "EV-MESH2-RANGE",
              "EvalMesh2 with FILL ends at the last row of the grid") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const GLint last = is_inside() ? j2 : grid_now(2).segments[1];
    sound.EvalMesh2(mode, i1, i2, j1, mode == GL_FILL && j1 < last ? std::min(j2, last) : j2);
  };
}

EVALCTS_RULES(NegativeColumnsAtZero, production, must, "EV-MESH2-RANGE",
              "EvalMesh2 with LINE begins at column 0 where i1 is negative",
              before(EvalMesh2, kMode == GL_LINE && kI2 >= 0, set(kI1, max(kI1, 0))));
EVALCTS_RULES(QuadStripTakenAsMode, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 takes QUAD_STRIP for FILL",
              before(EvalMesh2, kMode == GL_QUAD_STRIP, set(kMode, GL_FILL)));
EVALCTS_RULES(ModeAfterFillIsInvalidValue, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 raises INVALID_VALUE for the token after FILL",
              instead(EvalMesh2, kMode == GL_FILL + 1, error(GL_INVALID_VALUE)));
EVALCTS_RULES(BadModeOfSurfaceDraws, production, must, "EV-MESH2-ERR-MODE",
              "EvalMesh2 raises INVALID_ENUM for QUADS, and draws points",
              before(EvalMesh2, kMode == GL_QUADS && !kInside,
                     call(EvalMesh2, {GL_POINT, kI1, kI2, kJ1, kJ2})));
EVALCTS_RULES(SurfaceMeshInsideEndsPrimitive, production, must, "EV-MESH2-ERR-BEGINEND",
              "EvalMesh2 between Begin and End raises the error and begins the primitive anew",
              after(EvalMesh2, kInside, sequence({call(End), call(Begin, {kOpenMode})})));
EVALCTS_RULES(SurfaceMeshInsideWithoutMapIsIgnored, production, must, "EV-MESH2-ERR-BEGINEND",
              "EvalMesh2 between Begin and End without a vertex map is no error",
              skip(EvalMesh2, kInside && !maps_vertices(2)));
EVALCTS_RULES(ModeOfSurfaceUncheckedWithoutMap, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 looks for a vertex map before it looks at the mode",
              skip(EvalMesh2, !maps_vertices(2)));
EVALCTS_RULES(ModeOfEmptySurfaceUnchecked, production, must, "EV-MESH2-ERR-FIRST",
              "EvalMesh2 with an empty range of j does not look at the mode", skip(EvalMesh2, kJ1 > kJ2));

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

EVALCTS_RULES(SurfaceMeshWithoutVertexMapIsAnError, production, must, "EV-MESH2-NOVERTEX",
              "EvalMesh2 with FILL and no vertex map raises INVALID_OPERATION",
              before(EvalMesh2, !maps_vertices(2) && kMode == GL_FILL && !kInside, call(End)));

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

EVALCTS_RULES(SurfaceMeshTakesTheEnableOfCurves, production, must, "EV-MESH2-ONLY2D",
              "EvalMesh2 with LINE asks whether MAP1_NORMAL is enabled",
              around(EvalMesh2,
                     !kInside && kMode == GL_LINE && enabled(GL_MAP1_NORMAL) && !enabled(GL_MAP2_NORMAL),
                     call(Enable, {GL_MAP2_NORMAL}), call(Disable, {GL_MAP2_NORMAL})));

}  // namespace
}  // namespace evalcts::faults
