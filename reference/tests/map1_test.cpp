// Tests the errors of Map1, and what is none. The golden vectors (vectors/errors.json, vectors/state.json)
// hold its effects.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "context.h"

namespace evalcts::reference {
namespace {

template <typename T>
void define(Specification& gl, GLenum target, T u1, T u2, GLint stride, GLint order, const T* points) {
  if constexpr (std::is_same_v<T, GLfloat>) {
    gl.Map1f(target, u1, u2, stride, order, points);
  } else {
    gl.Map1d(target, u1, u2, stride, order, points);
  }
}

template <typename T>
class Map1Of : public testing::Test {};
using Types = testing::Types<GLfloat, GLdouble>;
TYPED_TEST_SUITE(Map1Of, Types);

// A call that violates one condition.
struct Mistake {
  const char* name;
  GLenum target;
  GLdouble u1, u2;
  GLint stride, order;
  GLenum error;
};

std::vector<Mistake> mistakes() {
  std::vector<Mistake> all;
  for (const GLenum target : kMap2Targets) {
    all.push_back({"MAP2 target", target, 0, 1, 4, 2, GL_INVALID_ENUM});
  }
  for (const GLenum target :
       {0u, 0x0D8Fu, 0x0D99u, static_cast<GLenum>(GL_TEXTURE_2D), 0x8660u, 0xFFFFFFFFu}) {
    all.push_back({"target", target, 0, 1, 4, 2, GL_INVALID_ENUM});
  }
  for (int i = 0; i < kMapKinds; ++i) {
    const GLenum target = kMap1Targets[i];
    const int k = kValuesPerPoint[i];
    for (const GLint order :
         {0, -1, 65, std::numeric_limits<GLint>::min(), std::numeric_limits<GLint>::max()}) {
      all.push_back({"order", target, 0, 1, k, order, GL_INVALID_VALUE});
    }
    for (const GLint stride : {k - 1, 0, -1, std::numeric_limits<GLint>::min()}) {
      all.push_back({"stride", target, 0, 1, stride, 2, GL_INVALID_VALUE});
      all.push_back({"stride of order 1", target, 0, 1, stride, 1, GL_INVALID_VALUE});
    }
    for (const GLdouble u : {0.0, 1.0, -2.5}) {
      all.push_back({"domain", target, u, u, k, 2, GL_INVALID_VALUE});
    }
    all.push_back({"zeros", target, 0.0, -0.0, k, 2, GL_INVALID_VALUE});  // U-ZERO-SIGN
  }
  return all;
}

TYPED_TEST(Map1Of, RefusesMistakesWithoutEffect) {  // EV-MAP1-ERR-*
  Specification gl;
  for (const GLenum target : kMap1Targets) define_line(gl, target, 3);
  const auto before = queryable_state(gl);
  const std::vector<TypeParam> points(70 * 4, 5);
  for (const Mistake& m : mistakes()) {
    define<TypeParam>(gl, m.target, static_cast<TypeParam>(m.u1), static_cast<TypeParam>(m.u2), m.stride,
                      m.order, points.data());
    EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{m.error})
        << m.name << " of " << std::hex << m.target;
    expect_error(gl, m.error);
  }
  EXPECT_EQ(queryable_state(gl), before);
}

TEST(Map1, MayReportAnyOfSeveralErrors) {  // EV-MAP-ERR-ANY
  Specification gl;
  const GLfloat point = 1;
  gl.ActiveTexture(GL_TEXTURE1);
  gl.Map1f(GL_MAP2_INDEX, 1, 1, 0, 0, &point);
  EXPECT_EQ(gl.permitted_errors(),
            (std::vector<GLenum>{GL_INVALID_ENUM, GL_INVALID_VALUE, GL_INVALID_OPERATION}));
  expect_error(gl, GL_INVALID_ENUM);  // one flag only
}

TEST(Map1, HasTheMaximumOrderOfItsContext) {  // EV-MAP1-ERR-ORDER-HIGH
  Specification gl(Specification::Options{8});
  const GLfloat points[9] = {};
  gl.Map1f(GL_MAP1_INDEX, 0, 1, 1, 8, points);
  expect_error(gl, GL_NO_ERROR);
  gl.Map1f(GL_MAP1_INDEX, 0, 1, 1, 9, points);
  expect_error(gl, GL_INVALID_VALUE);
}

TEST(Map1, AcceptsWhatIsNoError) {  // EV-MAP-NOERR-OTHER, U-NAN-*, U-STRIDE-HUGE, U-NULL, U-DOUBLE-CLOSE
  Specification gl;
  const GLfloat points[] = {-0.0f, 1e-45f, -0.0f, 1e-45f};
  gl.Map1f(GL_MAP1_INDEX, 5, -2, 2, 2, points);
  expect_error(gl, GL_NO_ERROR);
  gl.Map1f(GL_MAP1_INDEX, -1e30f, -1e20f, 1, 4, points);
  expect_error(gl, GL_NO_ERROR);
  gl.Map1f(GL_MAP1_INDEX, 0, 1, std::numeric_limits<GLint>::max(), 1, points);
  expect_error(gl, GL_NO_ERROR);
  const GLdouble one = 1;
  gl.Map1d(GL_MAP1_INDEX, 0, 1e-60, 1, 1, &one);
  expect_error(gl, GL_NO_ERROR);
  const auto before = queryable_state(gl);
  gl.Map1f(GL_MAP1_INDEX, 0, 1, 1, 2, nullptr);
  gl.Map1d(GL_MAP1_INDEX, 0, 1, 1, 2, nullptr);
  expect_error(gl, GL_NO_ERROR);
  EXPECT_EQ(queryable_state(gl), before);
  const float nan = NAN;
  gl.Map1f(GL_MAP1_INDEX, nan, nan, 1, 1, &nan);
  expect_error(gl, GL_NO_ERROR);
}

}  // namespace
}  // namespace evalcts::reference
