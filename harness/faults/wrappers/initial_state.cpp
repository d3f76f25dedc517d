// Section 2: what a fresh context holds. A wrapper is put around a context that was just created.
#include "map_calls.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(IndexMapInitiallyOn, production, must, "EV-INIT-MAPS-OFF", "MAP1_INDEX is enabled at first") {
  static_cast<void>(in);
  sound.Enable(GL_MAP1_INDEX);
}

EVALCTS_FAULT(LastMap2FlagUninitialized, production, must, "EV-INIT-MAPS-OFF",
              "MAP2_VERTEX_4, the last of the flags, is enabled at first") {
  static_cast<void>(in);
  sound.Enable(GL_MAP2_VERTEX_4);
}

EVALCTS_FAULT(UntouchedFlagIsTrueInGetBoolean, production, must, "EV-INIT-MAPS-OFF",
              "GetBooleanv of a map that no Enable or Disable has named gives TRUE") {
  in.gl.Enable = [](GLenum cap) {
    memory.counts[cap] = 1;
    sound.Enable(cap);
  };
  in.gl.Disable = [](GLenum cap) {
    memory.counts[cap] = 1;
    sound.Disable(cap);
  };
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (is_map2(pname) && !memory.counts[pname]) *v = GL_TRUE;
  };
}

EVALCTS_FAULT(AutoNormalInitiallyOn, production, must, "EV-INIT-AUTON-OFF",
              "AUTO_NORMAL is enabled at first, as the glMap2 page has it") {
  static_cast<void>(in);
  sound.Enable(GL_AUTO_NORMAL);
}

EVALCTS_FAULT(InitialTextureMapIsLinear, production, must, "EV-INIT-ORDER1",
              "MAP1_TEXTURE_COORD_2 begins with order 2, both points (0, 0)") {
  static_cast<void>(in);
  const GLfloat points[] = {0, 0, 0, 0};
  sound.Map1f(GL_MAP1_TEXTURE_COORD_2, 0, 1, 2, 2, points);
}

EVALCTS_FAULT(InitialOrderIsDegree, production, must, "EV-INIT-ORDER1",
              "GetMapdv answers order 0 of a one-dimensional map that was never defined") {
  map1(in, [](auto call, auto go) {
    memory.counts[call.target] = 1;
    go(call);
  });
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query == GL_ORDER && is_map1(target) && !memory.counts[target]) *v = 0;
  };
}

EVALCTS_FAULT(InitialVOrderForgotten, production, must, "EV-INIT-ORDER2",
              "ORDER of MAP2_INDEX is (1, 2) at first") {
  static_cast<void>(in);
  const GLfloat points[] = {1, 1};
  sound.Map2f(GL_MAP2_INDEX, 0, 1, 1, 1, 0, 1, 1, 2, points);
}

EVALCTS_FAULT(InitialOrderOfOneValue, production, must, "EV-INIT-ORDER2",
              "GetMapfv writes uorder only while a two-dimensional map has its initial order") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    if (query != GL_ORDER || !is_map2(target)) return sound.GetMapfv(target, query, v);
    GLfloat order[] = {0, 0};
    sound.GetMapfv(target, query, order);
    v[0] = order[0];
    if (order[0] != 1 || order[1] != 1) v[1] = order[1];
  };
}

EVALCTS_FAULT(InitialVertexHasNoW, production, must, "EV-INIT-COEFF-VERTEX",
              "the initial point of MAP2_VERTEX_4 is (0,0,0,0)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 0, 0, 0};
  sound.Map2f(GL_MAP2_VERTEX_4, 0, 1, 4, 1, 0, 1, 4, 1, point);
}

EVALCTS_FAULT(InitialVertex3CopiedFromW, production, must, "EV-INIT-COEFF-VERTEX",
              "the initial point of MAP1_VERTEX_3 is (0,0,1)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 0, 1};
  sound.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 1, point);
}

EVALCTS_FAULT(InitialNormalAlongX, production, must, "EV-INIT-COEFF-NORMAL",
              "the initial point of MAP2_NORMAL is (1,0,0)") {
  static_cast<void>(in);
  const GLfloat point[] = {1, 0, 0};
  sound.Map2f(GL_MAP2_NORMAL, 0, 1, 3, 1, 0, 1, 3, 1, point);
}

EVALCTS_FAULT(InitialNormalIsZero, production, must, "EV-INIT-COEFF-NORMAL",
              "the initial point of MAP1_NORMAL is (0,0,0)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 0, 0};
  sound.Map1f(GL_MAP1_NORMAL, 0, 1, 3, 1, point);
}

EVALCTS_FAULT(InitialColorIsBlack, production, must, "EV-INIT-COEFF-COLOR",
              "the initial point of MAP2_COLOR_4 is (0,0,0,1)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 0, 0, 1};
  sound.Map2f(GL_MAP2_COLOR_4, 0, 1, 4, 1, 0, 1, 4, 1, point);
}

EVALCTS_FAULT(InitialColorHasNoAlpha, production, must, "EV-INIT-COEFF-COLOR",
              "the initial point of MAP1_COLOR_4 is (1,1,1,0)") {
  static_cast<void>(in);
  const GLfloat point[] = {1, 1, 1, 0};
  sound.Map1f(GL_MAP1_COLOR_4, 0, 1, 4, 1, point);
}

EVALCTS_FAULT(InitialIndexIsZero, production, must, "EV-INIT-COEFF-INDEX",
              "the initial point of MAP2_INDEX is 0") {
  static_cast<void>(in);
  const GLfloat point[] = {0};
  sound.Map2f(GL_MAP2_INDEX, 0, 1, 1, 1, 0, 1, 1, 1, point);
}

EVALCTS_FAULT(InitialTextureHasNoQ, production, must, "EV-INIT-COEFF-TEX",
              "the initial point of MAP1_TEXTURE_COORD_4 is (0,0,0,0)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 0, 0, 0};
  sound.Map1f(GL_MAP1_TEXTURE_COORD_4, 0, 1, 4, 1, point);
}

EVALCTS_FAULT(InitialTextureTakesLastValues, production, must, "EV-INIT-COEFF-TEX",
              "the initial point of MAP2_TEXTURE_COORD_2 has the last two values of (0,0,0,1)") {
  static_cast<void>(in);
  const GLfloat point[] = {0, 1};
  sound.Map2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 2, 1, 0, 1, 2, 1, point);
}

EVALCTS_FAULT(InitialVDomainMissing, production, quality, "EV-INIT-DOMAIN",
              "the initial domain of MAP2_NORMAL is (0,1) in u and (0,0) in v") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    memory.flag = true;
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    go(target, query, v);
    if (!memory.flag && target == GL_MAP2_NORMAL && query == GL_DOMAIN) v[3] = 0;
  });
}

EVALCTS_FAULT(InitialDomainSymmetric, production, quality, "EV-INIT-DOMAIN",
              "the initial domain of MAP1_INDEX is (-1,1)") {
  static_cast<void>(in);
  const GLfloat point[] = {1};
  sound.Map1f(GL_MAP1_INDEX, -1, 1, 1, 1, point);
}

EVALCTS_FAULT(InitialGridOfNoSegments, production, must, "EV-INIT-GRID1",
              "MAP1_GRID_SEGMENTS is 0 until MapGrid1 is called") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.flag = true;
    go(n, u1, u2);
  });
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    sound.GetIntegerv(pname, v);
    if (pname == GL_MAP1_GRID_SEGMENTS && !memory.flag) *v = 0;
  };
}

EVALCTS_FAULT(InitialGridEndsAtSegments, production, must, "EV-INIT-GRID1",
              "MAP1_GRID_DOMAIN is (0,0) at first") {
  static_cast<void>(in);
  sound.MapGrid1f(1, 0, 0);
}

EVALCTS_FAULT(InitialGridVReversed, production, must, "EV-INIT-GRID2",
              "MAP2_GRID_DOMAIN is (0,1,1,0) at first") {
  static_cast<void>(in);
  sound.MapGrid2f(1, 0, 1, 1, 1, 0);
}

EVALCTS_FAULT(InitialGridOfTwoByTwo, production, must, "EV-INIT-GRID2",
              "MAP2_GRID_SEGMENTS is (1,2) at first") {
  static_cast<void>(in);
  sound.MapGrid2f(1, 0, 1, 2, 0, 1);
}

EVALCTS_FAULT(UndefinedVertexMapDrawsNothing, production, must, "EV-INIT-EVALUABLE",
              "EvalCoord1 before any vertex map was defined draws nothing") {
  map1(in, [](auto call, auto go) {
    if (call.target >= GL_MAP1_VERTEX_3) memory.flag = true;
    go(call);
  });
  eval_coord1(in, [](auto u, auto go) {
    if (memory.flag) go(u);
  });
}

EVALCTS_FAULT(MaxOrderOfTwoDimensionsSmaller, production, must, "EV-INIT-MAXORDER/2-D",
              "Map2 takes no vorder of MAX_EVAL_ORDER") {
  map2(in, [](auto call, auto go) {
    if (call.vorder == kMaxOrder) call.vorder = 0;
    go(call);
  });
}

EVALCTS_FAULT(MaxOrderIsDegree, production, must, "EV-INIT-MAXORDER/1-D",
              "MAX_EVAL_ORDER is 65 in the queries, one more than what Map1 takes") {
  get(in, [](GLenum pname, auto* v, auto go) {
    go(pname, v);
    if (pname == GL_MAX_EVAL_ORDER && sizeof *v > 1) *v += 1;
  });
}

EVALCTS_FAULT(MaxOrderOfSeven, production, must, "EV-INIT-MAXORDER/1-D",
              "the largest order is 7, the largest degree of the minimum") {
  map1(in, [](auto call, auto go) {
    if (call.order > 7) call.order = 0;
    go(call);
  });
  get(in, [](GLenum pname, auto* v, auto go) {
    go(pname, v);
    if (pname == GL_MAX_EVAL_ORDER && sizeof *v > 1) *v = 7;
  });
}

EVALCTS_FAULT(UntouchedAutoNormalIsTrueInGet, production, must, "EV-INIT-AUTON-OFF",
              "GetBooleanv of AUTO_NORMAL gives TRUE until Enable or Disable names it") {
  in.gl.Enable = [](GLenum cap) {
    memory.flag |= cap == GL_AUTO_NORMAL;
    sound.Enable(cap);
  };
  in.gl.Disable = [](GLenum cap) {
    memory.flag |= cap == GL_AUTO_NORMAL;
    sound.Disable(cap);
  };
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (pname == GL_AUTO_NORMAL && !memory.flag) *v = GL_TRUE;
  };
}

EVALCTS_FAULT(InitialIndexZeroInIntegers, production, must, "EV-INIT-COEFF-INDEX",
              "GetMapiv answers 0 for the initial point of MAP1_INDEX") {
  map1(in, [](auto call, auto go) {
    memory.flag |= call.target == GL_MAP1_INDEX;
    go(call);
  });
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (target == GL_MAP1_INDEX && query == GL_COEFF && !memory.flag) *v = 0;
  };
}

EVALCTS_FAULT(InitialQZeroInIntegers, production, must, "EV-INIT-COEFF-TEX",
              "GetMapiv answers a q of 0 for the initial point of MAP2_TEXTURE_COORD_4") {
  map2(in, [](auto call, auto go) {
    memory.flag |= call.target == GL_MAP2_TEXTURE_COORD_4;
    go(call);
  });
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (target == GL_MAP2_TEXTURE_COORD_4 && query == GL_COEFF && !memory.flag) v[3] = 0;
  };
}

EVALCTS_FAULT(InitialGridsZeroInDoubles, production, must, "EV-INIT-GRID1 EV-INIT-GRID2",
              "GetDoublev answers zeros for the ends of grids that were never set") {
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    memory.counts[GL_MAP1_GRID_DOMAIN] = 1;
    go(n, u1, u2);
  });
  map_grid2(in, [](auto call, auto go) {
    memory.counts[GL_MAP2_GRID_DOMAIN] = 1;
    go(call);
  });
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    sound.GetDoublev(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN && pname != GL_MAP2_GRID_DOMAIN) return;
    if (!memory.counts[pname]) std::fill_n(v, pname == GL_MAP1_GRID_DOMAIN ? 2 : 4, 0.0);
  };
}

EVALCTS_FAULT(UndefinedVertexNetDrawsNothing, production, must, "EV-INIT-EVALUABLE",
              "EvalCoord2 before any vertex map was defined draws nothing") {
  map2(in, [](auto call, auto go) {
    if (call.target >= GL_MAP2_VERTEX_3) memory.flag = true;
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (memory.flag) go(u, v);
  });
}

}  // namespace
}  // namespace evalcts::faults
