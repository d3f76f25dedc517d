// Tests the specification against sections 3 and 5 of the requirements: Map1 and its errors.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "context.h"

namespace evalcts::reference {
namespace {

TEST(Map1, AcceptsEveryOrderOfEveryTarget) {  // EV-MAP1-ORDER-ALL, EV-MAP1-STRIDE-MIN
  Specification gl;
  const std::vector<GLfloat> points(64 * 4, 1);
  for (int i = 0; i < kMapKinds; ++i) {
    for (GLint order = 1; order <= 64; ++order) {
      gl.Map1f(kMap1Targets[i], 0, 1, kValuesPerPoint[i], order, points.data());
      expect_error(gl, GL_NO_ERROR);
      ASSERT_EQ(get_map(gl, kMap1Targets[i], GL_ORDER), std::vector<GLdouble>{double(order)});
      ASSERT_EQ(get_map(gl, kMap1Targets[i], GL_COEFF).size(),
                static_cast<std::size_t>(order * kValuesPerPoint[i]));
    }
  }
}

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

TYPED_TEST(Map1Of, CountsTheStrideInValuesAndSkipsThePadding) {  // EV-MAP1-STRIDE, EV-MAP1-PADDING
  for (int i = 0; i < kMapKinds; ++i) {
    const int k = kValuesPerPoint[i];
    for (const int stride : {k, k + 1, 2 * k, 17}) {
      Specification gl;
      // The memory is exactly the range that may be read: the last point has no padding.
      auto points = std::make_unique<TypeParam[]>(2 * stride + k);
      std::fill_n(points.get(), 2 * stride + k, static_cast<TypeParam>(NAN));
      std::vector<GLdouble> expected;
      for (int p = 0; p < 3; ++p) {
        for (int c = 0; c < k; ++c) {
          points[p * stride + c] = static_cast<TypeParam>(10 * p + c + 1);
          expected.push_back(10 * p + c + 1);
        }
      }
      define<TypeParam>(gl, kMap1Targets[i], 0, 1, stride, 3, points.get());
      EXPECT_EQ(get_map(gl, kMap1Targets[i], GL_COEFF), expected);  // EV-MAP1-COMPORDER
      expect_error(gl, GL_NO_ERROR);
    }
  }
}

TYPED_TEST(Map1Of, CopiesThePoints) {  // EV-MAP1-COPY
  Specification gl;
  TypeParam points[] = {1, 2};
  define<TypeParam>(gl, GL_MAP1_INDEX, 0, 1, 1, 2, points);
  points[0] = 99;
  EXPECT_EQ(get_map(gl, GL_MAP1_INDEX, GL_COEFF), (std::vector<GLdouble>{1, 2}));
}

TEST(Map1, ReplacesOneMapAndNothingElse) {  // EV-MAP1-REPLACE, -INDEP, -VS-MAP2, -NOENABLE
  for (int i = 0; i < kMapKinds; ++i) {
    for (const bool enabled : {false, true}) {
      Specification gl;
      for (int j = 0; j < kMapKinds; ++j) define_line(gl, kMap1Targets[j], 1 + 20 * j);
      if (enabled) gl.Enable(kMap1Targets[i]);
      auto before = queryable_state(gl);
      const std::vector<GLfloat> points(30, 5);
      gl.Map1f(kMap1Targets[i], 3, 7, 4, 5, points.data());
      auto after = queryable_state(gl);
      // The state of each map has four answers: points, order, domain, enable.
      EXPECT_EQ(after[4 * i], std::vector<GLdouble>(5 * kValuesPerPoint[i], 5));
      EXPECT_EQ(after[4 * i + 1], std::vector<GLdouble>{5});
      EXPECT_EQ(after[4 * i + 2], (std::vector<GLdouble>{3, 7}));
      EXPECT_EQ(after[4 * i + 3], std::vector<GLdouble>{double(enabled)});
      for (int answer = 0; answer < 3; ++answer) before[4 * i + answer] = after[4 * i + answer];
      EXPECT_EQ(after, before);
    }
  }
}

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

TYPED_TEST(Map1Of, NeedsTextureUnitZero) {  // EV-MAP1-ERR-ACTIVETEX
  Specification gl;
  const TypeParam points[4] = {5, 5, 5, 5};
  for (const GLenum target : kMap1Targets) {
    gl.ActiveTexture(GL_TEXTURE1);
    define<TypeParam>(gl, target, 0, 2, 4, 1, points);
    expect_error(gl, GL_INVALID_OPERATION);
    EXPECT_EQ(get_map(gl, target, GL_DOMAIN), (std::vector<GLdouble>{0, 1}));
    gl.ActiveTexture(GL_TEXTURE0);
    define<TypeParam>(gl, target, 0, 2, 4, 1, points);
    expect_error(gl, GL_NO_ERROR);
    EXPECT_EQ(get_map(gl, target, GL_DOMAIN), (std::vector<GLdouble>{0, 2}));
  }
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
