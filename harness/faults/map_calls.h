// What faults of maps have in common: which calls are legal, the control points packed, and errors on
// purpose.
#pragma once

#include <algorithm>
#include <vector>

#include <evalcts/gl/tokens.h>
#include "forms.h"

namespace evalcts::faults {

inline constexpr GLint kMaxOrder = 64;  // of production

inline bool is_map1(GLenum token) { return token >= GL_MAP1_COLOR_4 && token <= GL_MAP1_VERTEX_4; }
inline bool is_map2(GLenum token) { return token >= GL_MAP2_COLOR_4 && token <= GL_MAP2_VERTEX_4; }
inline bool is_map(GLenum token) { return is_map1(token) || is_map2(token); }
inline bool is_texture_map1(GLenum token) {
  return token >= GL_MAP1_TEXTURE_COORD_1 && token <= GL_MAP1_TEXTURE_COORD_4;
}
inline bool is_texture_map2(GLenum token) {
  return token >= GL_MAP2_TEXTURE_COORD_1 && token <= GL_MAP2_TEXTURE_COORD_4;
}

inline bool legal_order(GLint order) { return order >= 1 && order <= kMaxOrder; }

// Whether the arguments are right, and so the points may be read.
template <class Real>
bool legal(const Map1Call<Real>& c) {
  return is_map1(c.target) && legal_order(c.order) && c.stride >= gl::components_of(c.target) && c.u1 != c.u2;
}
template <class Real>
bool legal(const Map2Call<Real>& c) {
  const GLint k = gl::components_of(c.target);
  return is_map2(c.target) && legal_order(c.uorder) && legal_order(c.vorder) && c.ustride >= k &&
         c.vstride >= k && c.u1 != c.u2 && c.v1 != c.v2;
}

// The control points of a legal call without padding, v fastest.
template <class Real>
std::vector<Real> packed(const Map1Call<Real>& c) {
  std::vector<Real> points;
  for (std::ptrdiff_t i = 0; i < c.order; ++i)
    points.insert(points.end(), c.points + i * c.stride,
                  c.points + i * c.stride + gl::components_of(c.target));
  return points;
}
template <class Real>
std::vector<Real> packed(const Map2Call<Real>& c) {
  std::vector<Real> points;
  for (std::ptrdiff_t i = 0; i < c.uorder; ++i)
    for (std::ptrdiff_t j = 0; j < c.vorder; ++j) {
      const Real* point = c.points + i * c.ustride + j * c.vstride;
      points.insert(points.end(), point, point + gl::components_of(c.target));
    }
  return points;
}

// The call with other points, packed; they have to live until the call is over.
template <class Real>
Map1Call<Real> with_points(Map1Call<Real> c, const std::vector<Real>& points) {
  c.stride = gl::components_of(c.target);
  c.points = points.data();
  return c;
}
template <class Real>
Map2Call<Real> with_points(Map2Call<Real> c, const std::vector<Real>& points) {
  c.vstride = gl::components_of(c.target);
  c.ustride = c.vorder * c.vstride;
  c.points = points.data();
  return c;
}

// The map that is there, in doubles; `target` has to be right, and no primitive open.
inline std::vector<GLdouble> coefficients(GLenum target) {
  GLint order[] = {1, 1};
  sound.GetMapiv(target, GL_ORDER, order);
  std::vector<GLdouble> all(static_cast<std::size_t>(order[0] * order[1] * gl::components_of(target)));
  sound.GetMapdv(target, GL_COEFF, all.data());
  return all;
}

// One error of that kind, wherever it may be called.
inline void leave_error(GLenum error) {
  GLint unused = 0;
  if (error == GL_INVALID_ENUM) sound.Enable(0);
  if (error == GL_INVALID_VALUE) sound.MapGrid1f(0, 0, 1);
  if (error == GL_INVALID_OPERATION) sound.GetnMapiv(GL_MAP1_INDEX, GL_ORDER, 0, &unused);
}

// Takes the error that waits and raises another one.
inline void instead_raise(GLenum error) {
  if (sound.GetError() != GL_NO_ERROR) leave_error(error);
}

// Afterwards memory.flag says whether a primitive is open. Only for faults that leave Begin and End alone.
inline void follow_primitives(Injection& in) {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = true;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
}

// Another number for each token, wherever maps are named.
template <class Rename>
void rename_targets(Injection& in, Rename) {
  map1(in, [](auto call, auto go) {
    call.target = Rename{}(call.target);
    go(call);
  });
  map2(in, [](auto call, auto go) {
    call.target = Rename{}(call.target);
    go(call);
  });
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) { go(Rename{}(target), query, v); });
  get(in, [](GLenum pname, auto* v, auto go) { go(Rename{}(pname), v); });
  in.gl.Enable = [](GLenum cap) { sound.Enable(Rename{}(cap)); };
  in.gl.Disable = [](GLenum cap) { sound.Disable(Rename{}(cap)); };
  in.gl.IsEnabled = [](GLenum cap) { return sound.IsEnabled(Rename{}(cap)); };
}

inline GLenum swapped(GLenum token, GLenum one, GLenum other) {
  return token == one ? other : token == other ? one : token;
}

}  // namespace evalcts::faults
