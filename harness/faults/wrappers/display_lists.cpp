// Section 20: evaluator commands in display lists. What happens when a list is called is in
// production/src/faults.def.
#include <algorithm>
#include <cmath>

#include <evalcts/gl/tokens.h>
#include "around.h"
#include "evaluating.h"
#include "forms.h"
#include "rules.h"

namespace evalcts::faults::display_lists {
namespace {

// memory.count is the mode of the list that is open, 0 where there is none.
void watch_lists(Injection& in) {
  in.gl.NewList = [](GLuint list, GLenum mode) {
    sound.NewList(list, mode);
    memory.count = static_cast<long>(mode);
  };
  in.gl.EndList = [] {
    sound.EndList();
    memory.count = 0;
  };
}

bool compiles() { return memory.count != 0; }
bool compiles_only() { return memory.count == GL_COMPILE; }

// --- Compiled, not executed --------------------------------------------------------------------------------

EVALCTS_FAULT(MeshDrawnAtEndList, production, must, "EV-DL-COMPILED EV-DL-COMPEXEC",
              "EndList draws the last EvalMesh1 of the list") {
  watch_lists(in);
  mesh1(in, [](auto call) {
    if (compiles()) memory.numbers = {static_cast<double>(call.i1), static_cast<double>(call.i2)};
    go1(call);
  });
  in.gl.EndList = [] {
    sound.EndList();
    memory.count = 0;
    if (memory.numbers.empty()) return;
    sound.EvalMesh1(GL_POINT, static_cast<GLint>(memory.numbers[0]), static_cast<GLint>(memory.numbers[1]));
    memory.numbers.clear();
  };
}

EVALCTS_FAULT(GridSetAtEndList, production, must, "EV-DL-COMPILED",
              "EndList executes the last MapGrid1d of the list") {
  watch_lists(in);
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    if (compiles_only()) memory.numbers = {static_cast<double>(n), u1, u2};
    sound.MapGrid1d(n, u1, u2);
  };
  in.gl.EndList = [] {
    sound.EndList();
    memory.count = 0;
    if (memory.numbers.empty()) return;
    sound.MapGrid1d(static_cast<GLint>(memory.numbers[0]), memory.numbers[1], memory.numbers[2]);
    memory.numbers.clear();
  };
}

// --- Called ------------------------------------------------------------------------------------------------

EVALCTS_RULES(AutoNormalNotCompiled, production, must, "EV-DL-EXECUTE",
              "Enable and Disable of AUTO_NORMAL are left out of lists",
              skip(kSwitches, kListMode == GL_COMPILE && kName == GL_AUTO_NORMAL));
EVALCTS_RULES(CompiledGridSwapsDirections, production, must, "EV-DL-EXECUTE",
              "a compiled MapGrid2d has the segments of u and v the other way round",
              before(MapGrid2d, kListMode, swap(kSegments, kVSegments)));

EVALCTS_FAULT(CompiledIndicesAreShorts, production, must, "EV-DL-EXECUTE",
              "the index of a compiled EvalPoint1 is kept in sixteen bits") {
  watch_lists(in);
  in.gl.EvalPoint1 = [](GLint i) { sound.EvalPoint1(compiles() ? static_cast<GLshort>(i) : i); };
}

EVALCTS_RULES(CompiledNegativeIndexIsZero, production, must, "EV-DL-EXECUTE",
              "a compiled EvalMesh1 begins at index 0 or above",
              before(EvalMesh1, kListMode, set(kI1, max(kI1, 0))));
EVALCTS_RULES(CompiledMesh2RangeIsShort, production, must, "EV-DL-EXECUTE",
              "the range of j of a compiled EvalMesh2 is kept in sixteen bits without a sign",
              before(EvalMesh2, kListMode, sequence({set(kJ1, kJ1 & 0xFFFF), set(kJ2, kJ2 & 0xFFFF)})));
EVALCTS_RULES(CompiledSegmentsAreShorts, production, must, "EV-DL-EXECUTE",
              "the segments of a compiled MapGrid1f are kept in sixteen bits",
              before(MapGrid1f, kListMode&& kSegments > 0, set(kSegments, kSegments & 0xFFFF)));
EVALCTS_RULES(CompiledOrderInFourBits, production, must, "EV-DL-EXECUTE EV-DL-STRIDE-KEPT",
              "orders from 16 on are compiled as 15",
              before(kMap1, kListMode&& kOrder > 15 && kOrder <= state(GL_MAX_EVAL_ORDER), set(kOrder, 15)));

EVALCTS_FAULT(CallRestoresGrid, production, must, "EV-DL-EXECUTE",
              "CallList leaves the grid of one dimension as it was") {
  watch_lists(in);
  in.gl.Begin = [](GLenum mode) {
    sound.Begin(mode);
    memory.flag = true;
  };
  in.gl.End = [] {
    sound.End();
    memory.flag = false;
  };
  in.gl.CallList = [](GLuint list) {
    if (memory.flag || compiles()) return sound.CallList(list);
    GLdouble domain[2] = {0, 1};
    const GLint segments = integer(GL_MAP1_GRID_SEGMENTS);
    sound.GetDoublev(GL_MAP1_GRID_DOMAIN, domain);
    sound.CallList(list);
    sound.MapGrid1d(segments, domain[0], domain[1]);
  };
}

EVALCTS_FAULT(CompiledLargeNetCut, production, must, "EV-DL-EXECUTE",
              "of a compiled net of more than 256 points the last row repeats the one before") {
  watch_lists(in);
  map2(in, [](auto call, auto go) {
    const int k = gl::components_of(call.target);
    using Value = typename decltype(call)::Value;
    if (!compiles() || k == 0 || call.uorder * call.vorder <= 256 ||
        call.ustride < call.vorder * call.vstride)
      return go(call);
    std::vector<Value> points(
        call.points, call.points + (call.uorder - 1) * call.ustride + (call.vorder - 1) * call.vstride + k);
    for (int j = 0; j < call.vorder; ++j)
      std::copy_n(points.begin() + (call.uorder - 2) * call.ustride + j * call.vstride, k,
                  points.begin() + (call.uorder - 1) * call.ustride + j * call.vstride);
    call.points = points.data();
    go(call);
  });
}

// --- Compiled and executed ---------------------------------------------------------------------------------

EVALCTS_RULES(EvalPointCompiledTwice, production, must, "EV-DL-COMPEXEC",
              "EvalPoint2 in a list that is compiled and executed is there twice",
              after(EvalPoint2, kListMode == GL_COMPILE_AND_EXECUTE, kGo));

EVALCTS_FAULT(
    ExecutedErrorNotCompiled, production, must, "EV-DL-COMPEXEC",
    "a Map1 whose domain is empty raises its error while it is compiled and executed, and never again") {
  watch_lists(in);
  map1(in, [](auto call, auto go) {
    if (memory.count == GL_COMPILE_AND_EXECUTE && call.u1 == call.u2)
      raise(GL_INVALID_VALUE);
    else
      go(call);
  });
}

// --- Control points ----------------------------------------------------------------------------------------

EVALCTS_FAULT(CompiledMap2fReadAtEndList, production, must, "EV-DL-POINTS-COPIED",
              "the points of a compiled Map2f are read by EndList") {
  struct Held {
    GLenum target;
    GLfloat u1, u2;
    GLint ustride, uorder;
    GLfloat v1, v2;
    GLint vstride, vorder;
    const GLfloat* points;
  };
  static std::vector<Held> held;
  held.clear();
  watch_lists(in);
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    if (compiles())
      held.push_back({target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points});
    else
      sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
  in.gl.EndList = [] {
    for (const Held& h : held)
      sound.Map2f(h.target, h.u1, h.u2, h.ustride, h.uorder, h.v1, h.v2, h.vstride, h.vorder, h.points);
    held.clear();
    sound.EndList();
    memory.count = 0;
  };
}

EVALCTS_FAULT(CompiledPointsFoundByAddress, production, must, "EV-DL-POINTS-COPIED",
              "a list takes points from an address that an earlier list had as they were then") {
  watch_lists(in);
  map1(in, [](auto call, auto go) {
    const int k = gl::components_of(call.target);
    using Value = typename decltype(call)::Value;
    if (!compiles() || k == 0 || call.order < 1 || call.stride < k) return go(call);
    const auto count = static_cast<std::size_t>((call.order - 1) * call.stride + k);
    static const void* address = nullptr;
    if (address != call.points || memory.numbers.size() != count) {
      memory.numbers.assign(call.points, call.points + count);
      address = call.points;
    }
    const std::vector<Value> points(memory.numbers.begin(), memory.numbers.end());
    call.points = points.data();
    go(call);
  });
}

EVALCTS_RULES(CompiledStrideInAByte, production, must, "EV-DL-STRIDE-KEPT",
              "the stride of a compiled Map1 is kept in a byte",
              before(kMap1, kListMode&& kStride > 255, set(kStride, 255)));
EVALCTS_RULES(CompiledMap1dPacked, production, must, "EV-DL-STRIDE-KEPT",
              "a compiled Map1d of colours takes its points for packed",
              before(Map1d, kListMode&& kTarget == GL_MAP1_COLOR_4 && kStride > 4, set(kStride, 4)));
EVALCTS_RULES(CompiledRowsWithoutPadding, production, must, "EV-DL-STRIDE-KEPT",
              "a compiled Map2f whose rows are longer than the net takes them for packed",
              before(Map2f, kListMode&& kStride > kVOrder * kVStride, set(kStride, kVOrder* kVStride)));
EVALCTS_RULES(CompiledVMajorTransposed, production, must, "EV-DL-STRIDE-KEPT",
              "a compiled Map2d in which u runs faster is taken for one in which v does",
              before(Map2d, kListMode&& kStride < kVStride && kVStride == kStride * kOrder,
                     sequence({set(kVStride, kStride), set(kStride, kVOrder* kVStride)})));

// --- Doubles -----------------------------------------------------------------------------------------------

EVALCTS_RULES(CompiledEvalCoord2dvTakesUTwice, production, must, "EV-DL-DOUBLE",
              "a compiled EvalCoord2dv has u for v, too", before(EvalCoord2dv, kListMode, set(kV, kU)));
EVALCTS_RULES(CompiledMap2dSwapsDomains, production, must, "EV-DL-DOUBLE",
              "a compiled Map2d has the domains of u and v the other way round",
              before(Map2d, kListMode, sequence({swap(kU1, kV1), swap(kU2, kV2)})));

EVALCTS_FAULT(CompiledArgumentInHalf, production, must, "EV-DL-DOUBLE",
              "a compiled EvalCoord1d keeps eleven bits of its argument") {
  watch_lists(in);
  in.gl.EvalCoord1d = [](GLdouble u) {
    int exponent = 0;
    const double mantissa = std::frexp(u, &exponent);
    sound.EvalCoord1d(compiles() ? std::ldexp(std::nearbyint(mantissa * 2048) / 2048, exponent) : u);
  };
}

// --- Errors ------------------------------------------------------------------------------------------------

EVALCTS_FAULT(CompiledOrderCheckedAtOnce, production, must, "EV-DL-ERR-LATE",
              "an order that is too low is an error of the compilation") {
  watch_lists(in);
  map1(in, [](auto call, auto go) {
    if (!compiles_only() || call.order >= 1) return go(call);
    raise(GL_INVALID_VALUE);
  });
}

EVALCTS_FAULT(CompiledMeshCheckedAtOnce, production, must, "EV-DL-ERR-LATE",
              "a mode that EvalMesh2 does not know is an error of the compilation as well") {
  watch_lists(in);
  mesh2(in, [](auto call) {
    if (compiles_only() && call.mode != GL_POINT && call.mode != GL_LINE && call.mode != GL_FILL)
      raise(GL_INVALID_ENUM);
    go2(call);
  });
}

EVALCTS_FAULT(CompiledErrorAtEndList, production, must, "EV-DL-ERR-LATE",
              "EndList raises the error of a compiled MapGrid") {
  watch_lists(in);
  map_grid1(in, [](auto n, auto u1, auto u2, auto go) {
    if (compiles_only() && n <= 0) memory.flag = true;
    go(n, u1, u2);
  });
  in.gl.EndList = [] {
    sound.EndList();
    memory.count = 0;
    if (memory.flag) raise(GL_INVALID_VALUE);
    memory.flag = false;
  };
}

EVALCTS_RULES(CompiledBadTargetDropped, production, must, "EV-DL-ERR-ALL",
              "a Map2 with a target that is none is left out of lists",
              skip(kMap2, kListMode == GL_COMPILE && (kComponents == 0 || kTarget < GL_MAP2_COLOR_4)));
EVALCTS_RULES(CompiledSmallVStrideDropped, production, must, "EV-DL-ERR-ALL",
              "in lists a vstride below k is taken for k",
              before(kMap2, kListMode&& kVStride > 0, set(kVStride, max(kVStride, kComponents))));
EVALCTS_RULES(CompiledEqualEndsMoved, production, must, "EV-DL-ERR-ALL",
              "in lists v1 equal to v2 is no error",
              before(kMap2, kListMode&& kV1 == kV2, set(kV2, kV2 + 1)));
EVALCTS_RULES(CompiledGridErrorIsInvalidEnum, production, must, "EV-DL-ERR-ALL",
              "MapGrid2 without segments in a list raises INVALID_ENUM",
              instead(kMapGrid2, kListMode && (kSegments <= 0 || kVSegments <= 0),
                      call(EvalMesh1, {GL_FILL, 0, 0})));
EVALCTS_RULES(CompiledFillTakenForLine, production, must, "EV-DL-ERR-ALL",
              "EvalMesh1 with FILL in a list draws lines",
              before(EvalMesh1, kListMode&& kMode == GL_FILL, set(kMode, GL_LINE)));
EVALCTS_RULES(CompiledStrideZeroMeansPacked, production, must, "EV-DL-ERR-ALL",
              "stride 0 of a compiled Map1f means packed points",
              before(Map1f, kListMode&& kStride == 0, set(kStride, kComponents)));
EVALCTS_RULES(CompiledHighOrderClamped, production, must, "EV-DL-ERR-ALL",
              "an order of a compiled Map1d above MAX_EVAL_ORDER is clamped",
              before(Map1d, kListMode, set(kOrder, min(kOrder, state(GL_MAX_EVAL_ORDER)))));
EVALCTS_RULES(CompiledHighUOrderDropped, production, must, "EV-DL-ERR-ALL",
              "a Map2f of a uorder above MAX_EVAL_ORDER is left out of lists",
              skip(Map2f, kListMode == GL_COMPILE && kOrder > state(GL_MAX_EVAL_ORDER)));
EVALCTS_RULES(CompiledEmptyGridDropped, production, must, "EV-DL-ERR-ALL",
              "a MapGrid1d of no segments is left out of lists",
              skip(MapGrid1d, kListMode == GL_COMPILE && kSegments == 0));
EVALCTS_RULES(CompiledMesh2ModeIsInvalidValue, production, must, "EV-DL-ERR-ALL",
              "EvalMesh2 with a mode of Begin in a list raises INVALID_VALUE",
              instead(EvalMesh2, kListMode && (kMode == GL_TRIANGLES || kMode == GL_QUAD_STRIP),
                      error(GL_INVALID_VALUE)));
EVALCTS_RULES(CompiledHighVOrderDropped, production, must, "EV-DL-ERR-ALL",
              "a Map2d of a vorder above MAX_EVAL_ORDER is left out of lists",
              skip(Map2d, kListMode == GL_COMPILE && kVOrder > state(GL_MAX_EVAL_ORDER)));
EVALCTS_RULES(CompiledNegativeUOrderDropped, production, must, "EV-DL-ERR-ALL",
              "a Map2f of a negative uorder is left out of lists",
              skip(Map2f, kListMode == GL_COMPILE && kOrder < 0));
EVALCTS_RULES(CompiledEmptyGrid2fInVDropped, production, must, "EV-DL-ERR-ALL",
              "a MapGrid2f of no segments in v is left out of lists",
              skip(MapGrid2f, kListMode == GL_COMPILE && kVSegments <= 0));
EVALCTS_RULES(CompiledEmptyGrid2dInUDropped, production, must, "EV-DL-ERR-ALL",
              "a MapGrid2d of no segments in u is left out of lists",
              skip(MapGrid2d, kListMode == GL_COMPILE && kSegments <= 0));
EVALCTS_RULES(CompiledStrideOfOnePointNotChecked, production, must, "EV-DL-ERR-ALL",
              "the stride of a compiled Map1 of order 1 is not checked",
              before(kMap1, kListMode&& kOrder == 1, set(kStride, max(kStride, kComponents))));
EVALCTS_RULES(CompiledNegativeOrderIsInvalidEnum, production, must, "EV-DL-ERR-ALL",
              "a negative vorder in a list raises INVALID_ENUM",
              before(kMap2, kListMode&& kVOrder < 0, set(kTarget, 0)));

// --- State of the compilation instead of the call ----------------------------------------------------------

EVALCTS_FAULT(CompiledMeshCarriesMap, production, must, "EV-DL-EXECSTATE-MAP",
              "a compiled EvalMesh1 brings the vertex map of the compilation along") {
  watch_lists(in);
  mesh1(in, [](auto call) {
    if (compiles_only() && is_on(GL_MAP1_VERTEX_3)) {
      GLint order = 0;
      GLdouble domain[2], points[256];
      sound.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, &order);
      sound.GetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, domain);
      sound.GetMapdv(GL_MAP1_VERTEX_3, GL_COEFF, points);
      sound.Map1d(GL_MAP1_VERTEX_3, domain[0], domain[1], 3, order, points);
    }
    go1(call);
  });
}

EVALCTS_RULES(CompiledMeshCarriesEnable, production, must, "EV-DL-EXECSTATE-MAP",
              "a compiled EvalMesh2 has colours if the colour map was on while it was compiled",
              before(EvalMesh2, kListMode == GL_COMPILE,
                     choose(enabled(GL_MAP2_COLOR_4), call(Enable, {GL_MAP2_COLOR_4}),
                            call(Disable, {GL_MAP2_COLOR_4}))));

EVALCTS_FAULT(EvaluationWithoutMapsNotCompiled, production, must, "EV-DL-EXECSTATE-MAP",
              "EvalCoord2 is left out of a list that is compiled while no vertex map is on") {
  watch_lists(in);
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (!compiles_only() || evaluates()) go(u, v);
  });
}

EVALCTS_FAULT(CompiledMeshCarriesGrid, production, must, "EV-DL-EXECSTATE-GRID",
              "a compiled EvalMesh2 brings the grid of the compilation along") {
  watch_lists(in);
  mesh2(in, [](auto call) {
    if (compiles_only()) {
      GLint n[2];
      GLdouble d[4];
      sound.GetIntegerv(GL_MAP2_GRID_SEGMENTS, n);
      sound.GetDoublev(GL_MAP2_GRID_DOMAIN, d);
      sound.MapGrid2d(n[0], d[0], d[1], n[1], d[2], d[3]);
    }
    go2(call);
  });
}

EVALCTS_FAULT(CompiledEvalPointIsEvalCoord, production, must, "EV-DL-EXECSTATE-GRID",
              "EvalPoint1 is compiled as EvalCoord1 of the grid of the compilation") {
  watch_lists(in);
  in.gl.EvalPoint1 = [](GLint i) {
    if (!compiles_only()) return sound.EvalPoint1(i);
    GLdouble domain[2];
    const GLint n = integer(GL_MAP1_GRID_SEGMENTS);
    sound.GetDoublev(GL_MAP1_GRID_DOMAIN, domain);
    sound.EvalCoord1d(i == n ? domain[1] : domain[0] + i * (domain[1] - domain[0]) / n);
  };
}

EVALCTS_FAULT(CompiledEvalPoint2IsEvalCoord, production, must, "EV-DL-EXECSTATE-GRID",
              "EvalPoint2 is compiled as EvalCoord2 of the grid of the compilation") {
  watch_lists(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (!compiles_only()) return sound.EvalPoint2(i, j);
    GLint n[2];
    GLdouble d[4];
    sound.GetIntegerv(GL_MAP2_GRID_SEGMENTS, n);
    sound.GetDoublev(GL_MAP2_GRID_DOMAIN, d);
    sound.EvalCoord2d(d[0] + i * (d[1] - d[0]) / n[0], d[2] + j * (d[3] - d[2]) / n[1]);
  };
}

EVALCTS_RULES(ActiveTextureOfTheCompilation, production, must, "EV-DL-ACTIVETEX",
              "ACTIVE_TEXTURE is judged while Map1 is compiled",
              instead(kMap1, kListMode == GL_COMPILE && state(GL_ACTIVE_TEXTURE) != GL_TEXTURE0,
                      call(NewList, {1, GL_COMPILE})));

// --- Queries while a list is open --------------------------------------------------------------------------

EVALCTS_FAULT(IsEnabledSeesCompiled, production, must, "EV-DL-GETMAP",
              "IsEnabled answers for what the open list enables") {
  watch_lists(in);
  in.gl.Enable = [](GLenum cap) {
    if (compiles_only()) memory.counts[cap] = 1;
    sound.Enable(cap);
  };
  in.gl.EndList = [] {
    sound.EndList();
    memory = {};
  };
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    return compiles_only() && memory.counts[cap] ? GL_TRUE : sound.IsEnabled(cap);
  };
}

EVALCTS_FAULT(GetMapSeesCompiledOrder, production, must, "EV-DL-GETMAP",
              "GetMapiv tells the order of the Map1 that the open list has") {
  watch_lists(in);
  map1(in, [](auto call, auto go) {
    if (compiles_only() && call.order > 0) memory.counts[call.target] = call.order;
    go(call);
  });
  in.gl.EndList = [] {
    sound.EndList();
    memory = {};
  };
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (query == GL_ORDER && compiles_only() && memory.counts.contains(target))
      *v = static_cast<GLint>(memory.counts[target]);
  };
}

EVALCTS_RULES(GetnMapWritesNothingInLists, production, must, "EV-DL-GETMAP",
              "GetnMapfv does nothing while a list is open", skip(GetnMapfv, kListMode));

EVALCTS_FAULT(GetDoublevSeesCompiledGrid, production, must, "EV-DL-GETMAP",
              "GetDoublev tells the ends of the grid that the open list has") {
  watch_lists(in);
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (compiles_only()) memory.numbers = {u1, u2};
    sound.MapGrid1f(n, u1, u2);
  };
  in.gl.EndList = [] {
    sound.EndList();
    memory = {};
  };
  get(in, [](GLenum pname, auto v, auto go) {
    go(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN || memory.numbers.empty()) return;
    for (std::size_t i = 0; i < 2; ++i) v[i] = static_cast<std::decay_t<decltype(*v)>>(memory.numbers[i]);
  });
}

EVALCTS_RULES(GetBooleanvIgnoredInLists, production, must, "EV-DL-GETMAP",
              "GetBooleanv of a map does nothing while a list is open",
              skip(GetBooleanv, kListMode&& is_map(kName)));
EVALCTS_RULES(GetnMapdvIgnoredInLists, production, must, "EV-DL-GETMAP",
              "GetnMapdv does nothing while a list is open", skip(GetnMapdv, kListMode));
EVALCTS_RULES(GetMapIgnoredWhileExecuted, production, must, "EV-DL-GETMAP",
              "GetMapfv does nothing while a list is compiled and executed",
              skip(GetMapfv, kListMode == GL_COMPILE_AND_EXECUTE));

EVALCTS_FAULT(GetMapOfCompiledDomain, production, must, "EV-DL-GETMAP",
              "GetMapdv tells the domain of the Map2 that the open list has") {
  watch_lists(in);
  map2(in, [](auto call, auto go) {
    if (compiles_only()) memory.numbers = {call.u1, call.u2, call.v1, call.v2};
    go(call);
  });
  in.gl.EndList = [] {
    sound.EndList();
    memory = {};
  };
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query == GL_DOMAIN && target >= GL_MAP2_COLOR_4 && !memory.numbers.empty())
      std::copy(memory.numbers.begin(), memory.numbers.end(), v);
  };
}

EVALCTS_RULES(MaxOrderUnknownInLists, production, must, "EV-DL-GETMAP",
              "MAX_EVAL_ORDER is 0 while a list is open",
              after(GetIntegerv, kListMode&& kName == GL_MAX_EVAL_ORDER, put(0, 0)));

// --- Begin and End -----------------------------------------------------------------------------------------

EVALCTS_RULES(CallListIgnoredInPrimitives, production, must, "EV-DL-INBEGIN",
              "CallList between Begin and End does nothing", skip(CallList, kInside));

EVALCTS_FAULT(ImmediatePointsNeedImmediateBegin, production, must, "EV-DL-SPLIT",
              "EvalCoord1f does nothing in a primitive that a list has begun") {
  watch_lists(in);
  in.gl.Begin = [](GLenum mode) {
    sound.Begin(mode);
    if (!compiles_only()) memory.flag = true;
  };
  in.gl.End = [] {
    sound.End();
    if (!compiles_only()) memory.flag = false;
  };
  in.gl.EvalCoord1f = [](GLfloat u) {
    if (compiles_only() || memory.flag) sound.EvalCoord1f(u);
  };
}

// --- Called again ------------------------------------------------------------------------------------------

EVALCTS_FAULT(SecondCallRoundsOtherwise, production, must, "EV-DL-REPEAT",
              "from the second call of a list on the last bit of x of the last evaluated vertex is another") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  all_meshes(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.CallList = [](GLuint list) {
    sound.CallList(list);
    ++memory.count;
  };
  in.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    if (memory.count < 2 || !memory.flag || primitives.empty() || primitives.back().vertices.empty()) return;
    auto& x = primitives.back().vertices.back().position[0];
    x = std::nextafter(x, 1e30f);
  };
}

EVALCTS_FAULT(SecondCallForgetsErrors, production, must, "EV-DL-REPEAT",
              "a list raises its errors at its first call only") {
  in.gl.NewList = [](GLuint list, GLenum mode) {
    sound.NewList(list, mode);
    memory.counts[list] = 0;
  };
  in.gl.CallList = [](GLuint list) {
    sound.CallList(list);
    if (memory.counts[list]++ > 0) sound.GetError();
  };
}

EVALCTS_FAULT(SecondCallIgnored, production, must, "EV-DL-REPEAT",
              "a list that is called twice in a row is executed once where something was evaluated") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  all_meshes(in, [](auto go) {
    memory.flag = true;
    go();
  });
  in.gl.NewList = [](GLuint list, GLenum mode) {
    sound.NewList(list, mode);
    memory.count = 0;
  };
  in.gl.CallList = [](GLuint list) {
    if (memory.count != list || !memory.flag) sound.CallList(list);
    memory.count = list;
  };
}

// --- Lists that call lists ---------------------------------------------------------------------------------

EVALCTS_FAULT(InnerListLookedUpByTheCompilation, production, must, "EV-DL-NESTED",
              "a call of a list that is not defined yet is left out of the outer list") {
  watch_lists(in);
  in.gl.CallList = [](GLuint list) {
    if (!compiles_only() || sound.IsList(list)) sound.CallList(list);
  };
}

EVALCTS_FAULT(InnerListKeepsGridToItself, production, must, "EV-DL-NESTED",
              "the grid and the enables that an inner list sets end with it") {
  watch_lists(in);
  in.gl.CallList = [](GLuint list) {
    if (!compiles_only()) return sound.CallList(list);
    sound.PushAttrib(GL_EVAL_BIT);
    sound.CallList(list);
    sound.PopAttrib();
  };
}

}  // namespace
}  // namespace evalcts::faults::display_lists
