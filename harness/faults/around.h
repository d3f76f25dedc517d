// For wrappers that do something before and after sound commands: what the state is, errors to raise, and
// the meshes in one form.
#pragma once

#include "fault.h"

namespace evalcts::faults {

// --- State. Nothing of this between Begin and End. ---------------------------------------------------------

inline bool is_on(GLenum cap) { return sound.IsEnabled(cap) == GL_TRUE; }

inline void set(GLenum cap, bool on) { on ? sound.Enable(cap) : sound.Disable(cap); }

inline GLint integer(GLenum pname) {
  GLint values[16] = {};
  sound.GetIntegerv(pname, values);
  return values[0];
}

// There is something to evaluate, in either dimension.
inline bool evaluates() {
  return is_on(GL_MAP1_VERTEX_3) || is_on(GL_MAP1_VERTEX_4) || is_on(GL_MAP2_VERTEX_3) ||
         is_on(GL_MAP2_VERTEX_4);
}

// The capability is off while `go` runs.
template <class Go>
void without(GLenum cap, Go go) {
  const bool was_on = is_on(cap);
  if (was_on) sound.Disable(cap);
  go();
  if (was_on) sound.Enable(cap);
}

// --- Errors ------------------------------------------------------------------------------------------------

// At once, even while a list is compiled; GetMap and GenLists are never in a list.
inline void raise(GLenum error) {
  GLint unused[4];
  if (error == GL_INVALID_ENUM) sound.GetMapiv(0, GL_ORDER, unused);
  if (error == GL_INVALID_VALUE) sound.GenLists(-1);
  if (error == GL_INVALID_OPERATION) sound.EndList();  // only where no list is open
}

// --- Meshes ------------------------------------------------------------------------------------------------

struct Mesh1Call {
  GLenum mode;
  GLint i1, i2;
};
struct Mesh2Call {
  GLenum mode;
  GLint i1, i2, j1, j2;
};

inline void go1(const Mesh1Call& c) { sound.EvalMesh1(c.mode, c.i1, c.i2); }
inline void go2(const Mesh2Call& c) { sound.EvalMesh2(c.mode, c.i1, c.i2, c.j1, c.j2); }

// The points of a mesh, u slower than v.
inline void points_column_by_column(const Mesh2Call& c) {
  for (GLint i = c.i1; i <= c.i2; ++i)
    for (GLint j = c.j1; j <= c.j2; ++j) sound.EvalMesh2(GL_POINT, i, i, j, j);
}

// body(call): a lambda without a capture.
template <class Body>
void mesh1(Injection& in, Body) {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) { Body{}(Mesh1Call{mode, i1, i2}); };
}
template <class Body>
void mesh2(Injection& in, Body) {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    Body{}(Mesh2Call{mode, i1, i2, j1, j2});
  };
}
// body(mode, go): both.
template <class Body>
void meshes(Injection& in, Body) {
  mesh1(in, [](auto call) { Body{}(call.mode, [call] { go1(call); }); });
  mesh2(in, [](auto call) { Body{}(call.mode, [call] { go2(call); }); });
}

}  // namespace evalcts::faults
