// Tests CallLists: types of names, their order, and the list base (GL 2.1 section 5.4).
#include <gtest/gtest.h>
#include <reference/specification.h>

#include <cmath>
#include <limits>

#include "lists.h"

namespace evalcts::reference {
namespace {

// Calls one list by an offset in memory of the given type. Returns the colour index that the list sets, or
// -1.
template <typename T>
GLdouble called(Specification& gl, GLenum type, std::initializer_list<T> bytes_or_value) {
  const auto memory = heap<T>(bytes_or_value);
  gl.Indexf(-1);
  gl.CallLists(1, type, memory.get());
  return current_index(gl);
}

TEST(DisplayLists, AreCalledByOffsetsOfEveryType) {
  Specification gl;
  for (const GLuint name : {5u, 8u, 10u, 11u, 210u, 300u, 70000u, 0x12345678u, 0xFFFFFFFFu}) {
    compile(gl, name, [&](Specification& c) { c.TexCoord1d(name), c.Indexf(static_cast<GLfloat>(name)); });
  }
  gl.ListBase(10);
  EXPECT_EQ(called<GLbyte>(gl, GL_BYTE, {-5}), 5);
  EXPECT_EQ(called<GLubyte>(gl, GL_UNSIGNED_BYTE, {200}), 210);
  EXPECT_EQ(called<GLshort>(gl, GL_SHORT, {-2}), 8);
  EXPECT_EQ(called<GLshort>(gl, GL_SHORT, {290}), 300);
  EXPECT_EQ(called<GLushort>(gl, GL_UNSIGNED_SHORT, {290}), 300);
  EXPECT_EQ(called<GLint>(gl, GL_INT, {-5}), 5);
  EXPECT_EQ(called<GLint>(gl, GL_INT, {69990}), 70000);
  EXPECT_EQ(called<GLuint>(gl, GL_UNSIGNED_INT, {69990}), 70000);
  EXPECT_EQ(called<GLuint>(gl, GL_UNSIGNED_INT, {0xFFFFFFFEu}), 8);
  EXPECT_EQ(called<GLfloat>(gl, GL_FLOAT, {290.9f}), 300);
  EXPECT_EQ(called<GLfloat>(gl, GL_FLOAT, {-2.9f}), 8);
  for (const GLfloat far : {std::numeric_limits<GLfloat>::quiet_NaN(), HUGE_VALF, -HUGE_VALF, 1e30f}) {
    called<GLfloat>(gl, GL_FLOAT, {far});  // any result is accepted
  }
  EXPECT_EQ(called<GLubyte>(gl, GL_2_BYTES, {1, 34}), 300);
  EXPECT_EQ(called<GLubyte>(gl, GL_3_BYTES, {1, 0x11, 0x66}), 70000);
  EXPECT_EQ(called<GLubyte>(gl, GL_4_BYTES, {0x12, 0x34, 0x56, 0x6E}), GLfloat(0x12345678));
  EXPECT_EQ(called<GLubyte>(gl, GL_4_BYTES, {0xFF, 0xFF, 0xFF, 0xF5}), GLfloat(0xFFFFFFFF));
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, AreCalledInOrder) {
  Specification gl;
  for (GLuint name = 1; name <= 3; ++name) {
    compile(gl, name, [&](Specification& c) { c.Vertex2f(static_cast<GLfloat>(name), 0); });
  }
  const auto pairs = heap<GLubyte>({0, 3, 0, 1, 0, 2, 0, 1});
  const auto triples = heap<GLubyte>({0, 0, 2, 0, 0, 3});
  const auto shorts = heap<GLshort>({1, 3});
  gl.Begin(GL_POINTS);
  gl.CallLists(4, GL_2_BYTES, pairs.get());
  gl.CallLists(2, GL_3_BYTES, triples.get());
  gl.CallLists(2, GL_SHORT, shorts.get());
  gl.CallLists(0, GL_SHORT, shorts.get());
  gl.End();
  EXPECT_EQ(drawn_x(gl), (std::vector<float>{3, 1, 2, 1, 2, 3, 1, 3}));
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, CountFromTheBaseInForceWhenCalled) {
  Specification gl;
  compile(gl, 2, [](Specification& c) { c.Indexf(2); });
  compile(gl, 12, [](Specification& c) { c.Indexf(12); });
  compile(gl, 1, [](Specification& c) { c.ListBase(10); });
  EXPECT_EQ(get(gl, GL_LIST_BASE), std::vector<GLdouble>{0});
  const GLubyte two = 2;
  compile(gl, 3, [&](Specification& c) { c.CallLists(1, GL_UNSIGNED_BYTE, &two); });
  gl.CallList(3);
  EXPECT_EQ(current_index(gl), 2);
  const GLubyte both[] = {1, 2};  // the base stays the same during a command
  gl.CallLists(2, GL_UNSIGNED_BYTE, both);
  EXPECT_EQ(current_index(gl), 2);
  EXPECT_EQ(get(gl, GL_LIST_BASE), std::vector<GLdouble>{10});
  gl.CallList(3);
  EXPECT_EQ(current_index(gl), 12);
  gl.CallList(2);  // CallList has no base
  EXPECT_EQ(current_index(gl), 2);
  expect_error(gl, GL_NO_ERROR);
}

}  // namespace
}  // namespace evalcts::reference
