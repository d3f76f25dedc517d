// Section 24.2: maps of vertex attributes, in a stand-in for an implementation that has them. (It has its own
// wrong ways, too: harness/tests/drills/nv_vertex_program.cpp.)
#include <algorithm>

#include "around.h"

#define NV_FAULT(name, requirements, what) EVALCTS_FAULT_IN(kNvVertexProgram, name, must, requirements, what)

namespace evalcts::faults::nv_vertex_program {
namespace {

constexpr GLenum kMap1 = 0x8660, kMap2 = 0x8670;  // of attribute 0
constexpr GLenum kNormal = 2, kColor = 3, kLast = 15;

bool in_program_mode() { return is_on(GL_VERTEX_PROGRAM_NV); }
bool is_attribute_map(GLenum target) { return target >= kMap1 && target <= kMap2 + kLast; }

// --- Tokens, components, initial state ---------------------------------------------------------------------

NV_FAULT(FifteenAttributeMaps, "EV-EXT-NVVP-TOKENS", "Map2f does not know the map of attribute 15") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target == kMap2 + kLast ? 0 : target, u1, u2, ustride, uorder, v1, v2, vstride, vorder,
                points);
  };
}

NV_FAULT(AttributeMapsNotInGet, "EV-EXT-NVVP-TOKENS", "GetIntegerv tells FALSE of any map of an attribute") {
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    sound.GetIntegerv(pname, v);
    if (is_attribute_map(pname)) *v = GL_FALSE;
  };
}

NV_FAULT(AttributeMapsDoNotSwitchOff, "EV-EXT-NVVP-TOKENS",
         "Disable does nothing to the map of attribute 7") {
  in.gl.Disable = [](GLenum cap) {
    if (cap != kMap1 + 7) sound.Disable(cap);
  };
}

NV_FAULT(NormalAttributeHasThreeComponents, "EV-EXT-NVVP-K",
         "k is 3 for the map of attribute 2, as for normals") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (target != kMap1 + kNormal || stride != 3 || order < 1)
      return sound.Map1f(target, u1, u2, stride, order, points);
    std::vector<GLfloat> padded;
    for (int i = 0; i < order; ++i) {
      padded.insert(padded.end(), points + 3 * i, points + 3 * i + 3);
      padded.push_back(1);
    }
    sound.Map1f(target, u1, u2, 4, order, padded.data());
  };
}

NV_FAULT(SmallVStrideOfAttributeMap, "EV-EXT-NVVP-K", "vstride is not checked for maps of attributes") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    if (is_attribute_map(target)) vstride = std::max(vstride, 4);
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  };
}

NV_FAULT(FirstAttributeMapInitiallyOn, "EV-EXT-NVVP-INIT",
         "the map of attribute 0 is on from the start, as in NV_evaluators") {
  static_cast<void>(in);
  sound.Enable(kMap1);
}

NV_FAULT(AttributeMapsInitiallyZero, "EV-EXT-NVVP-INIT",
         "the initial control point of surfaces of attributes is (0, 0, 0, 0)") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    GLint order[2] = {2, 2};
    if (query == GL_COEFF && target >= kMap2 && is_attribute_map(target))
      sound.GetMapiv(target, GL_ORDER, order);
    sound.GetMapfv(target, query, v);
    if (order[0] * order[1] == 1) v[3] = 0;
  };
}

// --- Program mode ------------------------------------------------------------------------------------------

// The conventional map `target` stands in for that of an attribute, of order 2 and over (0, 1).
void stand_in(GLenum target, GLenum attribute_map) {
  GLint order[2] = {1, 1};
  GLfloat points[64];
  sound.GetMapiv(attribute_map, GL_ORDER, order);
  sound.GetMapfv(attribute_map, GL_COEFF, points);
  if (attribute_map >= kMap2)
    sound.Map2f(target, 0, 1, 4 * order[1], order[0], 0, 1, 4, order[1], points);
  else
    sound.Map1f(target, 0, 1, 4, order[0], points);
  sound.Enable(target);
}

NV_FAULT(ColorAttributeWithoutProgram, "EV-EXT-NVVP-MODE",
         "the map of attribute 3 gives the colour without program mode") {
  in.gl.Begin = [](GLenum mode) {
    if (!in_program_mode() && is_on(kMap1 + kColor)) stand_in(GL_MAP1_COLOR_4, kMap1 + kColor);
    if (!in_program_mode() && is_on(kMap2 + kColor)) stand_in(GL_MAP2_COLOR_4, kMap2 + kColor);
    sound.Begin(mode);
  };
}

NV_FAULT(VertexAttributeWithoutProgram, "EV-EXT-NVVP-MODE",
         "the map of attribute 0 gives vertices without program mode where no other does") {
  in.gl.Begin = [](GLenum mode) {
    if (!in_program_mode() && !evaluates() && is_on(kMap1)) stand_in(GL_MAP1_VERTEX_4, kMap1);
    if (!in_program_mode() && !evaluates() && is_on(kMap2)) stand_in(GL_MAP2_VERTEX_4, kMap2);
    sound.Begin(mode);
  };
}

// `off` is off in evaluated primitives in program mode where `when()`.
template <class When>
void off_in_program_mode(Injection& in, GLenum off, When) {
  static GLenum cap;
  cap = off;
  in.gl.Begin = [](GLenum mode) {
    memory.flag = in_program_mode() && is_on(cap) && When{}();
    if (memory.flag) sound.Disable(cap);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(cap);
    memory.flag = false;
  };
}

NV_FAULT(ConventionalColorWins, "EV-EXT-NVVP-PRIORITY", "COLOR_4 beats the map of attribute 3 in curves") {
  off_in_program_mode(in, kMap1 + kColor, [] { return is_on(GL_MAP1_COLOR_4); });
}

NV_FAULT(DisabledAttributeMapShadows, "EV-EXT-NVVP-PRIORITY",
         "in program mode surfaces have no conventional colours, whether attribute 3 has a map or not") {
  off_in_program_mode(in, GL_MAP2_COLOR_4, [] { return !is_on(kMap2 + kColor); });
}

NV_FAULT(VertexAttributeDrawsNothing, "EV-EXT-NVVP-VERTEX",
         "the map of attribute 0 is no vertex map of curves") {
  off_in_program_mode(in, kMap1, [] { return true; });
}

NV_FAULT(VertexAttributeWithoutOtherMaps, "EV-EXT-NVVP-VERTEX",
         "with the map of attribute 0 alone for a vertex map conventional maps do nothing") {
  off_in_program_mode(in, GL_MAP2_COLOR_4, [] { return is_on(kMap2) && !evaluates(); });
}

NV_FAULT(AutoNormalOffInProgramMode, "EV-EXT-NVVP-AUTON", "AUTO_NORMAL does nothing in program mode") {
  off_in_program_mode(in, GL_AUTO_NORMAL, [] { return true; });
}

NV_FAULT(AutoNormalOfUnitLength, "EV-EXT-NVVP-AUTON", "in program mode AUTO_NORMAL gives unit normals") {
  off_in_program_mode(in, GL_AUTO_NORMAL, [] {
    sound.Normal3f(0, 0, 1);  // of any patch in the plane of x and y
    return true;
  });
}

NV_FAULT(VertexAttributeNotRational, "EV-EXT-NVVP-AUTON", "w of the map of attribute 0 is taken for 1") {
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    if (target != kMap2 || ustride < 4 || vstride < 4)
      return sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    std::vector<GLfloat> net;
    for (int i = 0; i < uorder; ++i)
      for (int j = 0; j < vorder; ++j) {
        const GLfloat* const point = points + i * ustride + j * vstride;
        net.insert(net.end(), {point[0], point[1], point[2], 1});
      }
    sound.Map2f(target, u1, u2, 4 * vorder, uorder, v1, v2, 4, vorder, net.data());
  };
}

// --- Current values and the attribute stack ----------------------------------------------------------------

NV_FAULT(EvaluatedNormalStays, "EV-EXT-NVVP-CURRENT", "the current normal is that of the last evaluation") {
  in.gl.End = [] {
    sound.End();
    if (is_on(kMap1 + kNormal) || is_on(kMap2 + kNormal)) sound.Normal3f(0, 0, 1);
  };
}

NV_FAULT(EvaluatedAlphaStays, "EV-EXT-NVVP-CURRENT",
         "the current alpha is that of the map of attribute 3 of surfaces") {
  in.gl.End = [] {
    sound.End();
    if (!is_on(kMap2 + kColor)) return;
    GLfloat points[64], color[4];
    sound.GetMapfv(kMap2 + kColor, GL_COEFF, points);
    sound.GetFloatv(GL_CURRENT_COLOR, color);
    sound.Color4f(color[0], color[1], color[2], points[3]);
  };
}

NV_FAULT(AttributeMapsNotInEnableBit, "EV-EXT-NVVP-STACK", "ENABLE_BIT does not restore maps of attributes") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    sound.PushAttrib(mask);
    memory.flag = mask == GL_ENABLE_BIT;
  };
  in.gl.PopAttrib = [] {
    std::vector<bool> on;
    for (GLenum cap = kMap1; cap <= kMap2 + kLast; ++cap) on.push_back(is_on(cap));
    sound.PopAttrib();
    for (std::size_t i = 0; memory.flag && i < on.size(); ++i) set(kMap1 + static_cast<GLenum>(i), on[i]);
  };
}

NV_FAULT(LastAttributeMapNotInEvalBit, "EV-EXT-NVVP-STACK",
         "EVAL_BIT does not restore the enable of the curve of attribute 15") {
  in.gl.PushAttrib = [](GLbitfield mask) {
    sound.PushAttrib(mask);
    memory.flag = mask == GL_EVAL_BIT;
  };
  in.gl.PopAttrib = [] {
    const bool on = is_on(kMap1 + kLast);
    sound.PopAttrib();
    if (memory.flag) set(kMap1 + kLast, on);
  };
}

}  // namespace
}  // namespace evalcts::faults::nv_vertex_program
