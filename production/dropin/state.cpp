// The state of the evaluators: enables, maps, grids, and their part of the attribute stack.
#include <type_traits>

#include "context.h"
#include "enables.h"

namespace glev::dropin {

void Context::update_enabled() {
  enabled = 0;
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(evaluators, cap_of(bit))) enabled |= 1u << bit;
}

bool Context::has_vertex_map() const {
  return (enabled & (both_enable_bits(kVertex3Map) | both_enable_bits(kVertex4Map))) != 0;
}

void Context::set_enabled(GLenum cap, bool on) {
  if (!is_outside()) return;
  if (on)
    glevEnable(evaluators, cap);
  else
    glevDisable(evaluators, cap);
  report();
  update_enabled();
}

// Passes on the active texture unit, because Map requires unit 0.
void Context::set_active_texture() {
  const bool is_first = !multitexture || get_integer(GL_ACTIVE_TEXTURE, GL_TEXTURE0) == GL_TEXTURE0;
  glevActiveTexture(evaluators, is_first ? GL_TEXTURE0 : GL_TEXTURE1);
}

template <class Real>
void Context::map(int dimension, GLenum target, const MapDirections<Real>& directions, const Real* points) {
  if (!is_outside()) return;
  set_active_texture();
  const auto define = [&](auto define_curve, auto define_surface) {
    const auto& [u, v] = directions;
    if (dimension == 1)
      define_curve(evaluators, target, u.first, u.last, u.stride, u.order, points);
    else
      define_surface(evaluators, target, u.first, u.last, u.stride, u.order, v.first, v.last, v.stride,
                     v.order, points);
  };
  if constexpr (std::is_same_v<Real, GLfloat>)
    define(glevMap1f, glevMap2f);
  else
    define(glevMap1d, glevMap2d);
  report();
}
template void Context::map(int, GLenum, const MapDirections<GLfloat>&, const GLfloat*);
template void Context::map(int, GLenum, const MapDirections<GLdouble>&, const GLdouble*);

void Context::map_grid1(GLint n, double u1, double u2) {
  if (!is_outside()) return;
  glevMapGrid1d(evaluators, n, u1, u2);
  report();
}
void Context::map_grid2(GLint un, double u1, double u2, GLint vn, double v1, double v2) {
  if (!is_outside()) return;
  glevMapGrid2d(evaluators, un, u1, u2, vn, v1, v2);
  report();
}

// The depth of the stack in the GL below shows if the command was successful.
void Context::push_attrib(GLbitfield mask) {
  const GLint before = get_integer(GL_ATTRIB_STACK_DEPTH, -1);
  gl_below().PushAttrib(mask);
  if (before < 0 || before >= 64 || get_integer(GL_ATTRIB_STACK_DEPTH, -1) != before + 1) return;
  pushed[before] = (mask & (GL_EVAL_BIT | GL_ENABLE_BIT)) != 0;
  if (!pushed[before]) return;
  glevPushAttrib(evaluators, mask & (GL_EVAL_BIT | GL_ENABLE_BIT));
  pushed[before] = glevGetError(evaluators) == GLEV_NO_ERROR;
}

void Context::pop_attrib() {
  const GLint before = get_integer(GL_ATTRIB_STACK_DEPTH, -1);
  if (evaluators_used && before > 0) {
    GLfloat color[4];
    gl_below().GetFloatv(GL_CURRENT_COLOR, color);  // flushes values that Mesa would set after PopAttrib
  }
  gl_below().PopAttrib();
  list_base_known = false;
  if (before < 1 || before > 64 || get_integer(GL_ATTRIB_STACK_DEPTH, -1) != before - 1) return;
  if (!pushed[before - 1]) return;
  pushed[before - 1] = false;
  glevPopAttrib(evaluators);
  update_enabled();
}

void Context::copy_eval_attributes(const Context& from, bool grids) {
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(from.evaluators, cap_of(bit)))
      glevEnable(evaluators, cap_of(bit));
    else
      glevDisable(evaluators, cap_of(bit));
  update_enabled();
  if (!grids) return;
  GLint n[2] = {};
  GLdouble ends[4] = {};
  glevGetIntegerv(from.evaluators, GL_MAP1_GRID_SEGMENTS, n);
  glevGetDoublev(from.evaluators, GL_MAP1_GRID_DOMAIN, ends);
  glevMapGrid1d(evaluators, n[0], ends[0], ends[1]);
  glevGetIntegerv(from.evaluators, GL_MAP2_GRID_SEGMENTS, n);
  glevGetDoublev(from.evaluators, GL_MAP2_GRID_DOMAIN, ends);
  glevMapGrid2d(evaluators, n[0], ends[0], ends[1], n[1], ends[2], ends[3]);
}

}  // namespace glev::dropin
