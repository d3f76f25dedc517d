// Tests two-dimensional maps and meshes: strides, forms, empty primitives, and normals that do not exist. The
// golden vectors (vectors/errors.json, vectors/state.json) hold the rest.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "context.h"

namespace evalcts::reference {
namespace {

// Defines a map of order 3 x 2 over [0,2] x [0,1] with x = 10 u + v.
void define_net(Specification& gl, GLenum target = GL_MAP2_VERTEX_3) {
  const GLfloat points[] = {0, 5, 6, 1, 5, 6, 10, 5, 6, 11, 5, 6, 20, 5, 6, 21, 5, 6};
  gl.Map2f(target, 0, 2, 6, 3, 0, 1, 3, 2, points);
  gl.Enable(target);
}

// Returns the primitives as text: the mode, and x of each vertex.
std::string drawn(Specification& gl) {
  std::string text;
  for (const Primitive& primitive : gl.take_primitives()) {
    text += (text.empty() ? "" : " ") + std::to_string(primitive.mode) + ":";
    for (const Vertex& vertex : primitive.vertices)
      text += (text.back() == ':' ? "" : ",") + std::to_string(static_cast<int>(rounded(vertex.position[0])));
  }
  return text;
}

TEST(Map2, AddressesPointsByBothStrides) {  // EV-MAP2-ADDRESS, -PADDING, -STRIDE-UNITS, C-COEFF-ORDER
  Specification gl;
  const double poison = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GLdouble> expected = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  // 2 by 3 points of two
  for (const auto& [ustride, vstride] : {std::pair{6, 2}, {2, 4}, {3, 7}, {11, 3}}) {
    std::vector<GLdouble> points(static_cast<std::size_t>(ustride + 2 * vstride + 2), poison);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 3; ++j)
        for (int c = 0; c < 2; ++c)
          points[static_cast<std::size_t>(i * ustride + j * vstride + c)] = expected[(i * 3 + j) * 2 + c];
    gl.Map2d(GL_MAP2_TEXTURE_COORD_2, 0, 1, ustride, 2, 2, 5, vstride, 3, points.data());
    EXPECT_EQ(get_map(gl, GL_MAP2_TEXTURE_COORD_2, GL_COEFF), expected) << ustride;
    const std::vector<GLfloat> singles(points.begin(), points.end());
    gl.Map2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, ustride, 2, 2, 5, vstride, 3, singles.data());
    EXPECT_EQ(get_map(gl, GL_MAP2_TEXTURE_COORD_2, GL_COEFF), expected) << ustride;
  }
  EXPECT_EQ(get_map(gl, GL_MAP2_TEXTURE_COORD_2, GL_ORDER), (std::vector<GLdouble>{2, 3}));
  EXPECT_EQ(get_map(gl, GL_MAP2_TEXTURE_COORD_2, GL_DOMAIN), (std::vector<GLdouble>{0, 1, 2, 5}));
}

TEST(EvalCoord2, TakesAllFormsOfItsArguments) {  // EV-API-V
  Specification gl;
  define_net(gl);
  const GLfloat f[] = {1, 0.5f};
  const GLdouble d[] = {1, 0.5};
  gl.Begin(GL_POINTS);
  gl.EvalCoord2f(1, 0.5f);
  gl.EvalCoord2d(1, 0.5);
  gl.EvalCoord2fv(f);
  gl.EvalCoord2dv(d);
  gl.EvalCoord2fv(nullptr);
  gl.EvalCoord2dv(nullptr);
  gl.End();
  const auto vertices = gl.take_primitives().at(0).vertices;
  ASSERT_EQ(vertices.size(), 4u);
  for (const Vertex& vertex : vertices) EXPECT_EQ(rounded(vertex.position), (Values4{10.5f, 5, 6, 1}));
}

TEST(EvalMesh1, DrawsPointsAndOneStrip) {  // EV-MESH1-*
  Specification gl;
  const GLfloat line[] = {0, 0, 0, 4, 0, 0};
  gl.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, line);
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.MapGrid1f(4, 0, 1);
  gl.EvalMesh1(GL_POINT, 0, 4);
  EXPECT_EQ(drawn(gl), "0:0,1,2,3,4");
  gl.EvalMesh1(GL_LINE, -1, 5);
  EXPECT_EQ(drawn(gl), "3:-1,0,1,2,3,4,5");
  gl.EvalMesh1(GL_LINE, 2, 1);  // EV-MESH1-EMPTY
  EXPECT_EQ(drawn(gl), "3:");
  expect_error(gl, GL_NO_ERROR);
  gl.Disable(GL_MAP1_VERTEX_3);
  gl.EvalMesh1(GL_POINT, 0, 4);  // EV-MESH1-NOVERTEX
  EXPECT_EQ(drawn(gl), "0:");
  for (const GLenum mode : {GL_FILL, GL_POINTS, GL_LINE_STRIP, 0}) {  // EV-MESH1-ERR-MODE, -ERR-FIRST
    gl.EvalMesh1(mode, 0, 4);
    expect_error(gl, GL_INVALID_ENUM);
  }
  EXPECT_EQ(drawn(gl), "");
}

TEST(EvalMesh2, DrawsPointsStripsAndQuadStrips) {  // EV-MESH2-POINT, -LINE, -FILL
  Specification gl;
  define_net(gl);
  gl.MapGrid2f(2, 0, 2, 1, 0, 1);
  gl.EvalMesh2(GL_POINT, 0, 2, 0, 1);
  EXPECT_EQ(drawn(gl), "0:0,10,20,1,11,21");
  gl.EvalMesh2(GL_LINE, 0, 2, 0, 1);
  EXPECT_EQ(drawn(gl), "3:0,10,20 3:1,11,21 3:0,1 3:10,11 3:20,21");
  gl.EvalMesh2(GL_FILL, 0, 2, -1, 1);
  EXPECT_EQ(drawn(gl), "8:-1,0,9,10,19,20 8:0,1,10,11,20,21");
  // EV-MESH2-EMPTY, -LINE-DEGENERATE
  gl.EvalMesh2(GL_POINT, 0, 2, 1, 0);
  EXPECT_EQ(drawn(gl), "0:");
  gl.EvalMesh2(GL_LINE, 1, 1, 0, 1);
  EXPECT_EQ(drawn(gl), "3:10 3:11 3:10,11");
  gl.EvalMesh2(GL_LINE, 1, 0, 1, 0);
  EXPECT_EQ(drawn(gl), "");
  gl.EvalMesh2(GL_FILL, 0, 2, 1, 1);
  EXPECT_EQ(drawn(gl), "");
  expect_error(gl, GL_NO_ERROR);
}

TEST(AutoNormal, IsNotANumberWhereThereIsNone) {  // U-AUTON-ZERO, U-AUTON-W0
  Specification gl;
  gl.Enable(GL_AUTO_NORMAL);
  gl.Enable(GL_MAP2_VERTEX_4);
  const GLfloat points[2][16] = {{1, 2, 3, 1, 1, 2, 3, 1, 1, 2, 3, 1, 1, 2, 3, 1},
                                 {0, 0, 0, 0, 0, 9, 0, 0, 9, 0, 0, 0, 9, 9, 0, 0}};
  for (const auto& net : points) {
    gl.Map2f(GL_MAP2_VERTEX_4, 0, 1, 8, 2, 0, 1, 4, 2, net);
    gl.Begin(GL_POINTS);
    gl.EvalCoord2f(0.5f, 0.5f);
    gl.End();
    const auto normal = rounded(gl.take_primitives().at(0).vertices.at(0).normal);
    for (const float component : normal) EXPECT_TRUE(std::isnan(component));
  }
}

}  // namespace
}  // namespace evalcts::reference
