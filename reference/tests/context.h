// Helpers that inspect a context of the executable specification.
#pragma once

#include <gtest/gtest.h>
#include <reference/specification.h>

#include <array>
#include <functional>
#include <vector>

namespace evalcts::reference {

constexpr GLenum kMap1Targets[] = {GL_MAP1_COLOR_4,         GL_MAP1_INDEX,           GL_MAP1_NORMAL,
                                   GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
                                   GL_MAP1_TEXTURE_COORD_4, GL_MAP1_VERTEX_3,        GL_MAP1_VERTEX_4};
constexpr GLenum kMap2Targets[] = {GL_MAP2_COLOR_4,         GL_MAP2_INDEX,           GL_MAP2_NORMAL,
                                   GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2, GL_MAP2_TEXTURE_COORD_3,
                                   GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_3,        GL_MAP2_VERTEX_4};
constexpr int kValuesPerPoint[] = {4, 1, 3, 1, 2, 3, 4, 3, 4};  // components of the targets above

// Returns all 18 map targets.
inline std::vector<GLenum> map_targets() {
  std::vector<GLenum> targets(std::begin(kMap1Targets), std::end(kMap1Targets));
  targets.insert(targets.end(), std::begin(kMap2Targets), std::end(kMap2Targets));
  return targets;
}

constexpr GLdouble kPoison = -12345.678;
// Returns the values that a query has written, without the trailing elements that still contain the poison
// value.
inline std::vector<GLdouble> written(std::vector<GLdouble> answer) {
  while (!answer.empty() && answer.back() == kPoison) answer.pop_back();
  return answer;
}

inline std::vector<GLdouble> get_map(Specification& gl, GLenum target, GLenum query) {
  std::vector<GLdouble> answer(600, kPoison);
  gl.GetMapdv(target, query, answer.data());
  return written(answer);
}

inline std::vector<GLdouble> get(Specification& gl, GLenum pname) {
  std::vector<GLdouble> answer(20, kPoison);
  gl.GetDoublev(pname, answer.data());
  return written(answer);
}

// Returns all state of the evaluators and all current values that can be queried.
inline std::vector<std::vector<GLdouble>> queryable_state(Specification& gl) {
  std::vector<std::vector<GLdouble>> state;
  for (const GLenum target : map_targets()) {
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) state.push_back(get_map(gl, target, query));
    state.push_back(get(gl, target));
  }
  for (const GLenum pname : {GL_AUTO_NORMAL, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN,
                             GL_MAP2_GRID_SEGMENTS, GL_CURRENT_COLOR, GL_CURRENT_INDEX, GL_CURRENT_NORMAL,
                             GL_CURRENT_TEXTURE_COORDS, GL_EDGE_FLAG, GL_ACTIVE_TEXTURE}) {
    state.push_back(get(gl, pname));
  }
  return state;
}

// Expects that GetError returns `error` and then NO_ERROR.
inline void expect_error(Specification& gl, GLenum error) {
  EXPECT_EQ(gl.GetError(), error);
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// Defines a map of order 2 over [0,1] whose component c has the value first + c + 10 * u.
inline void define_line(Specification& gl, GLenum target, float first) {
  const int k = values_per_point(target);
  std::vector<GLfloat> points;
  for (int i = 0; i < 2; ++i) {
    for (int c = 0; c < k; ++c) points.push_back(first + c + 10 * i);
  }
  gl.Map1f(target, 0, 1, k, 2, points.data());
}

template <std::size_t kSize>
std::array<float, kSize> rounded(const std::array<Component, kSize>& components) {
  std::array<float, kSize> values;
  for (std::size_t i = 0; i < kSize; ++i) values[i] = rounded(components[i]);
  return values;
}

using Values4 = std::array<float, 4>;
using Values3 = std::array<float, 3>;

}  // namespace evalcts::reference
