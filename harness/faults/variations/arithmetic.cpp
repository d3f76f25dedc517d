// A variation of the arithmetic: results have errors like those of another order of evaluation.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <type_traits>
#include <vector>

#include <evalcts/gl/tokens.h>
#include "variation.h"

namespace evalcts::variations {
namespace {

// Changes the last five bits of the significand, which is an error of up to 2 parts in 10^6, unless they are
// 0 or equal to the pattern. Applied twice, returns the original value.
float changed(float x) {
  constexpr std::uint32_t kMask = 0x1f, kPattern = 0x15;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t last = bits & kMask;
  if (!std::isnormal(x) || last == 0 || last == kPattern) return x;
  return std::bit_cast<float>(bits ^ kPattern);
}

// A map that was defined with changed control points, with the original points.
struct Changed {
  GLfloat u1, u2, v1, v2;
  GLint ustride, vstride, uorder, vorder;
  std::vector<GLfloat> points;  // packed, v fastest
};
std::map<GLenum, Changed> changed_maps;

constexpr GLint kMaxOrder = 64;  // MAX_EVAL_ORDER of production

bool is_two_dimensional(GLenum target) { return target >= GL_MAP2_COLOR_4 && target <= GL_MAP2_VERTEX_4; }
bool is_target(GLenum target, bool two) {
  return (target >= GL_MAP1_COLOR_4 && target <= GL_MAP1_VERTEX_4 && !two) ||
         (two && is_two_dimensional(target));
}

// Returns the place of each packed value in the array of the definition.
std::vector<std::ptrdiff_t> places(GLenum target, const Changed& map) {
  std::vector<std::ptrdiff_t> places;
  for (std::ptrdiff_t i = 0; i < map.uorder; ++i)
    for (std::ptrdiff_t j = 0; j < map.vorder; ++j)
      for (int c = 0; c < gl::components_of(target); ++c)
        places.push_back(i * map.ustride + j * map.vstride + c);
  return places;
}

void issue(GLenum target, const Changed& map, const std::vector<GLfloat>& points) {
  const std::vector<std::ptrdiff_t> to = places(target, map);
  std::vector<GLfloat> array(static_cast<std::size_t>(std::ranges::max(to)) + 1);
  for (std::size_t i = 0; i < to.size(); ++i) array[static_cast<std::size_t>(to[i])] = points[i];
  if (is_two_dimensional(target))
    unvaried.Map2f(target, map.u1, map.u2, map.ustride, map.uorder, map.v1, map.v2, map.vstride, map.vorder,
                   array.data());
  else
    unvaried.Map1f(target, map.u1, map.u2, map.ustride, map.uorder, array.data());
}

// True if the definition of a map takes effect at once. Other definitions are rejected or compiled
// into a list.
bool is_defined(GLenum target, bool two, bool valid) {
  if (!is_target(target, two) || !valid || remembered.inside || remembered.compiling) return false;
  GLint unit = GL_TEXTURE0;
  if (unvaried.ActiveTexture) unvaried.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
  return unit == GL_TEXTURE0;
}

// True if the arguments of one direction are legal.
bool are_valid(double u1, double u2, GLint stride, GLint order, GLenum target) {
  return u1 != u2 && stride >= gl::components_of(target) && order >= 1 && order <= kMaxOrder;
}

// `given`: the array with the original points.
void define(GLenum target, Changed map, const GLfloat* given) {
  for (const std::ptrdiff_t place : places(target, map)) map.points.push_back(given[place]);
  std::vector<GLfloat> points(map.points.size());
  std::ranges::transform(map.points, points.begin(), changed);
  issue(target, map, points);
  changed_maps[target] = map;
}

// Restores the original control points, before commands of lists or of other contexts can use the maps.
void take_back() {
  if (remembered.inside || remembered.compiling || changed_maps.empty()) return;
  GLint unit = GL_TEXTURE0;  // maps can be defined only while this unit is active
  if (unvaried.ActiveTexture) {
    unvaried.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    unvaried.ActiveTexture(GL_TEXTURE0);
  }
  for (const auto& [target, map] : changed_maps) issue(target, map, map.points);
  changed_maps.clear();
  if (unvaried.ActiveTexture) unvaried.ActiveTexture(static_cast<GLenum>(unit));
}

// Takes the change out of the answer to a query of control points.
template <class T>
void answer_as_given(GLenum target, GLenum query, T* values) {
  const auto found = changed_maps.find(target);
  if (query != GL_COEFF || remembered.inside || found == changed_maps.end()) return;
  std::vector<GLfloat> answer(found->second.points.size());
  unvaried.GetMapfv(target, query, answer.data());
  std::ranges::transform(answer, values, [](float answered) {
    const float x = changed(answered);
    if constexpr (std::is_same_v<T, GLint>)
      return static_cast<GLint>(std::clamp(std::floor(static_cast<double>(x) + 0.5), -0x1p31, 0x1p31 - 1));
    else
      return static_cast<T>(x);
  });
}

EVALCTS_VARIATION(OtherArithmetic, "production",
                  "results are those of control points that are off by up to 2 parts in 10^6", "") {
  changed_maps.clear();
  v.gl.Map1f = [](GLenum t, GLfloat u1, GLfloat u2, GLint s, GLint o, const GLfloat* p) {
    if (!is_defined(t, false, are_valid(u1, u2, s, o, t))) return unvaried.Map1f(t, u1, u2, s, o, p);
    define(t, {u1, u2, 0, 1, s, 0, o, 1, {}}, p);
  };
  v.gl.Map2f = [](GLenum t, GLfloat u1, GLfloat u2, GLint us, GLint uo, GLfloat v1, GLfloat v2, GLint vs,
                  GLint vo, const GLfloat* p) {
    if (!is_defined(t, true, are_valid(u1, u2, us, uo, t) && are_valid(v1, v2, vs, vo, t)))
      return unvaried.Map2f(t, u1, u2, us, uo, v1, v2, vs, vo, p);
    define(t, {u1, u2, v1, v2, us, vs, uo, vo, {}}, p);
  };
  v.gl.Map1d = [](GLenum t, GLdouble u1, GLdouble u2, GLint s, GLint o, const GLdouble* p) {
    if (is_defined(t, false, are_valid(u1, u2, s, o, t))) changed_maps.erase(t);
    unvaried.Map1d(t, u1, u2, s, o, p);
  };
  v.gl.Map2d = [](GLenum t, GLdouble u1, GLdouble u2, GLint us, GLint uo, GLdouble v1, GLdouble v2, GLint vs,
                  GLint vo, const GLdouble* p) {
    if (is_defined(t, true, are_valid(u1, u2, us, uo, t) && are_valid(v1, v2, vs, vo, t)))
      changed_maps.erase(t);
    unvaried.Map2d(t, u1, u2, us, uo, v1, v2, vs, vo, p);
  };
  v.gl.NewList = [](GLuint list, GLenum mode) {
    take_back();
    unvaried.NewList(list, mode);
  };
  v.gl.CallList = [](GLuint list) {
    take_back();
    unvaried.CallList(list);
  };
  v.gl.CallLists = [](GLsizei n, GLenum type, const GLvoid* lists) {
    take_back();
    unvaried.CallLists(n, type, lists);
  };
  v.gl.OtherContextEVALCTS = [](GLuint number) {
    take_back();
    unvaried.OtherContextEVALCTS(number);
  };
  v.gl.GetMapfv = [](GLenum t, GLenum query, GLfloat* values) {
    unvaried.GetMapfv(t, query, values);
    answer_as_given(t, query, values);
  };
  v.gl.GetMapdv = [](GLenum t, GLenum query, GLdouble* values) {
    unvaried.GetMapdv(t, query, values);
    answer_as_given(t, query, values);
  };
  v.gl.GetMapiv = [](GLenum t, GLenum query, GLint* values) {
    unvaried.GetMapiv(t, query, values);
    answer_as_given(t, query, values);
  };
  v.gl.GetnMapfv = nullptr;
  v.gl.GetnMapdv = nullptr;
  v.gl.GetnMapiv = nullptr;
}

}  // namespace
}  // namespace evalcts::variations
