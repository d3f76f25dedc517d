// Wrappers for all forms of a command at once (f, d, v, ...). `body` is a lambda without a capture; it is
// called with the arguments of the call and with `go`, the sound command:
//
//   map1(in, [](auto call, auto go) {
//     if (call.target == GL_MAP1_INDEX) call.order = 1;
//     go(call);
//   });
#pragma once

#include "fault.h"

namespace evalcts::faults {

template <class Real>
struct Map1Call {
  using Value = Real;
  GLenum target;
  Real u1, u2;
  GLint stride, order;
  const Real* points;
};

template <class Real>
struct Map2Call {
  using Value = Real;
  GLenum target;
  Real u1, u2;
  GLint ustride, uorder;
  Real v1, v2;
  GLint vstride, vorder;
  const Real* points;
};

template <class Body>
void map1(Injection& in, Body) {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    Body{}(Map1Call<GLfloat>{target, u1, u2, stride, order, points}, [](const Map1Call<GLfloat>& c) {
      sound.Map1f(c.target, c.u1, c.u2, c.stride, c.order, c.points);
    });
  };
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    Body{}(Map1Call<GLdouble>{target, u1, u2, stride, order, points}, [](const Map1Call<GLdouble>& c) {
      sound.Map1d(c.target, c.u1, c.u2, c.stride, c.order, c.points);
    });
  };
}

template <class Body>
void map2(Injection& in, Body) {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    Body{}(Map2Call<GLfloat>{target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points},
           [](const Map2Call<GLfloat>& c) {
             sound.Map2f(c.target, c.u1, c.u2, c.ustride, c.uorder, c.v1, c.v2, c.vstride, c.vorder,
                         c.points);
           });
  };
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    Body{}(Map2Call<GLdouble>{target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points},
           [](const Map2Call<GLdouble>& c) {
             sound.Map2d(c.target, c.u1, c.u2, c.ustride, c.uorder, c.v1, c.v2, c.vstride, c.vorder,
                         c.points);
           });
  };
}

// body(u, go): u is a reference to float or double.
template <class Body>
void eval_coord1(Injection& in, Body) {
  in.gl.EvalCoord1f = [](GLfloat u) { Body{}(u, [](GLfloat x) { sound.EvalCoord1f(x); }); };
  in.gl.EvalCoord1d = [](GLdouble u) { Body{}(u, [](GLdouble x) { sound.EvalCoord1d(x); }); };
  in.gl.EvalCoord1fv = [](const GLfloat* u) {
    GLfloat copy = *u;
    Body{}(copy, [](GLfloat x) { sound.EvalCoord1fv(&x); });
  };
  in.gl.EvalCoord1dv = [](const GLdouble* u) {
    GLdouble copy = *u;
    Body{}(copy, [](GLdouble x) { sound.EvalCoord1dv(&x); });
  };
}

// body(u, v, go)
template <class Body>
void eval_coord2(Injection& in, Body) {
  in.gl.EvalCoord2f = [](GLfloat u, GLfloat v) {
    Body{}(u, v, [](GLfloat x, GLfloat y) { sound.EvalCoord2f(x, y); });
  };
  in.gl.EvalCoord2d = [](GLdouble u, GLdouble v) {
    Body{}(u, v, [](GLdouble x, GLdouble y) { sound.EvalCoord2d(x, y); });
  };
  in.gl.EvalCoord2fv = [](const GLfloat* uv) {
    GLfloat u = uv[0], v = uv[1];
    Body{}(u, v, [](GLfloat x, GLfloat y) {
      const GLfloat pair[] = {x, y};
      sound.EvalCoord2fv(pair);
    });
  };
  in.gl.EvalCoord2dv = [](const GLdouble* uv) {
    GLdouble u = uv[0], v = uv[1];
    Body{}(u, v, [](GLdouble x, GLdouble y) {
      const GLdouble pair[] = {x, y};
      sound.EvalCoord2dv(pair);
    });
  };
}

// body(segments, u1, u2, go)
template <class Body>
void map_grid1(Injection& in, Body) {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    Body{}(n, u1, u2, [](GLint m, GLfloat a, GLfloat b) { sound.MapGrid1f(m, a, b); });
  };
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    Body{}(n, u1, u2, [](GLint m, GLdouble a, GLdouble b) { sound.MapGrid1d(m, a, b); });
  };
}

template <class Real>
struct MapGrid2Call {
  using Value = Real;
  GLint un;
  Real u1, u2;
  GLint vn;
  Real v1, v2;
};

template <class Body>
void map_grid2(Injection& in, Body) {
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    Body{}(MapGrid2Call<GLfloat>{un, u1, u2, vn, v1, v2},
           [](const MapGrid2Call<GLfloat>& c) { sound.MapGrid2f(c.un, c.u1, c.u2, c.vn, c.v1, c.v2); });
  };
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    Body{}(MapGrid2Call<GLdouble>{un, u1, u2, vn, v1, v2},
           [](const MapGrid2Call<GLdouble>& c) { sound.MapGrid2d(c.un, c.u1, c.u2, c.vn, c.v1, c.v2); });
  };
}

// body(target, query, values, go): GetMap{f,d,i}v; values is a pointer.
template <class Body>
void get_map(Injection& in, Body) {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    Body{}(target, query, v, [](GLenum t, GLenum q, GLfloat* to) { sound.GetMapfv(t, q, to); });
  };
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    Body{}(target, query, v, [](GLenum t, GLenum q, GLdouble* to) { sound.GetMapdv(t, q, to); });
  };
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    Body{}(target, query, v, [](GLenum t, GLenum q, GLint* to) { sound.GetMapiv(t, q, to); });
  };
}

// body(target, query, size in bytes, values, go): GetnMap{f,d,i}v
template <class Body>
void getn_map(Injection& in, Body) {
  in.gl.GetnMapfv = [](GLenum target, GLenum query, GLsizei size, GLfloat* v) {
    Body{}(target, query, size, v,
           [](GLenum t, GLenum q, GLsizei n, GLfloat* to) { sound.GetnMapfv(t, q, n, to); });
  };
  in.gl.GetnMapdv = [](GLenum target, GLenum query, GLsizei size, GLdouble* v) {
    Body{}(target, query, size, v,
           [](GLenum t, GLenum q, GLsizei n, GLdouble* to) { sound.GetnMapdv(t, q, n, to); });
  };
  in.gl.GetnMapiv = [](GLenum target, GLenum query, GLsizei size, GLint* v) {
    Body{}(target, query, size, v,
           [](GLenum t, GLenum q, GLsizei n, GLint* to) { sound.GetnMapiv(t, q, n, to); });
  };
}

// body(pname, values, go): Get{Boolean,Integer,Float,Double}v
template <class Body>
void get(Injection& in, Body) {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    Body{}(pname, v, [](GLenum p, GLboolean* to) { sound.GetBooleanv(p, to); });
  };
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    Body{}(pname, v, [](GLenum p, GLint* to) { sound.GetIntegerv(p, to); });
  };
  in.gl.GetFloatv = [](GLenum pname, GLfloat* v) {
    Body{}(pname, v, [](GLenum p, GLfloat* to) { sound.GetFloatv(p, to); });
  };
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    Body{}(pname, v, [](GLenum p, GLdouble* to) { sound.GetDoublev(p, to); });
  };
}

}  // namespace evalcts::faults
