// The evaluators' state: enables, maps, grids, and their part of the attribute stack.
#include "context.h"
#include "enables.h"

namespace glev::dropin {

void Context::UpdateEnabled() {
  enabled = 0;
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(evaluators, CapOf(bit))) enabled |= 1u << bit;
}

bool Context::HasVertexMap() const {
  return (enabled & (BothBits(kVertex3Map) | BothBits(kVertex4Map))) != 0;
}

void Context::SetEnabled(GLenum cap, bool on) {
  if (!IsOutside()) return;
  if (on)
    glevEnable(evaluators, cap);
  else
    glevDisable(evaluators, cap);
  Report();
  UpdateEnabled();
}

// Map wants unit 0 to be the active one.
void Context::SetActiveTexture() {
  const bool is_first = !multitexture || Integer(GL_ACTIVE_TEXTURE, GL_TEXTURE0) == GL_TEXTURE0;
  glevActiveTexture(evaluators, is_first ? GL_TEXTURE0 : GL_TEXTURE1);
}

template <>
void Context::Map1(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap1f(evaluators, target, u1, u2, stride, order, points);
  Report();
}
template <>
void Context::Map1(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap1d(evaluators, target, u1, u2, stride, order, points);
  Report();
}
template <>
void Context::Map2(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap2f(evaluators, target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  Report();
}
template <>
void Context::Map2(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap2d(evaluators, target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  Report();
}

void Context::MapGrid1(GLint n, double u1, double u2) {
  if (!IsOutside()) return;
  glevMapGrid1d(evaluators, n, u1, u2);
  Report();
}
void Context::MapGrid2(GLint un, double u1, double u2, GLint vn, double v1, double v2) {
  if (!IsOutside()) return;
  glevMapGrid2d(evaluators, un, u1, u2, vn, v1, v2);
  Report();
}

// Whether there was room, or anything to pop, the GL below knows.
void Context::PushAttrib(GLbitfield mask) {
  const GLint before = Integer(GL_ATTRIB_STACK_DEPTH, -1);
  Gl().PushAttrib(mask);
  if (before < 0 || before >= 64 || Integer(GL_ATTRIB_STACK_DEPTH, -1) != before + 1) return;
  pushed[before] = (mask & (GL_EVAL_BIT | GL_ENABLE_BIT)) != 0;
  if (!pushed[before]) return;
  glevPushAttrib(evaluators, mask & (GL_EVAL_BIT | GL_ENABLE_BIT));
  pushed[before] = glevGetError(evaluators) == GLEV_NO_ERROR;
}

void Context::PopAttrib() {
  const GLint before = Integer(GL_ATTRIB_STACK_DEPTH, -1);
  if (evaluators_used && before > 0) {
    GLfloat color[4];
    Gl().GetFloatv(GL_CURRENT_COLOR, color);  // Mesa: what is still pending would come after PopAttrib
  }
  Gl().PopAttrib();
  list_base_known = false;
  if (before < 1 || before > 64 || Integer(GL_ATTRIB_STACK_DEPTH, -1) != before - 1) return;
  if (!pushed[before - 1]) return;
  pushed[before - 1] = false;
  glevPopAttrib(evaluators);
  UpdateEnabled();
}

void Context::CopyEvalAttributes(const Context& from, bool grids) {
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(from.evaluators, CapOf(bit)))
      glevEnable(evaluators, CapOf(bit));
    else
      glevDisable(evaluators, CapOf(bit));
  UpdateEnabled();
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
