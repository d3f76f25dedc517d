// Tests the specification against sections 4, 5, 10 and 13 to 16 of the requirements: two-dimensional maps,
// grids, points, meshes, and the sources of automatic normals.
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

TEST(Map2, EqualStridesShareMemory) {  // EV-MAP2-STRIDE-FREE
  Specification gl;
  const GLfloat points[] = {1, 2, 3};
  gl.Map2f(GL_MAP2_INDEX, 0, 1, 1, 2, 0, 1, 1, 2, points);
  expect_error(gl, GL_NO_ERROR);
  EXPECT_EQ(get_map(gl, GL_MAP2_INDEX, GL_COEFF), (std::vector<GLdouble>{1, 2, 2, 3}));
}

TEST(Map2, RefusesWhatIsWrongInEitherDirection) {  // EV-MAP2-ERR-*
  struct Bad {
    GLenum target;
    float u1, u2;
    int ustride, uorder;
    float v1, v2;
    int vstride, vorder;
    GLenum error;
  };
  const std::vector<GLfloat> points(70 * 70 * 4);
  const Bad all[] = {{GL_MAP1_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, GL_INVALID_ENUM},
                     {GL_MAP2_VERTEX_4 + 1, 0, 1, 3, 2, 0, 1, 6, 2, GL_INVALID_ENUM},
                     {GL_MAP2_VERTEX_3, 0, 1, 3, 0, 0, 1, 6, 2, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 3, 65, 0, 1, 6, 2, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 0, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 65, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 2, 2, 0, 1, 6, 2, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 2, 2, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 1, 1, 3, 2, 0, 1, 6, 2, GL_INVALID_VALUE},
                     {GL_MAP2_VERTEX_3, 0, 1, 3, 2, 2, 2, 6, 2, GL_INVALID_VALUE}};
  Specification gl;
  define_net(gl);
  const auto state = queryable_state(gl);
  for (const Bad& b : all) {
    gl.Map2f(b.target, b.u1, b.u2, b.ustride, b.uorder, b.v1, b.v2, b.vstride, b.vorder, points.data());
    EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{b.error});
    expect_error(gl, b.error);
  }
  gl.ActiveTexture(GL_TEXTURE1);
  gl.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, points.data());
  expect_error(gl, GL_INVALID_OPERATION);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.Begin(GL_POINTS);
  gl.Map2d(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr);
  gl.End();
  expect_error(gl, GL_INVALID_OPERATION);
  EXPECT_EQ(queryable_state(gl), state);  // EV-MAP2-ERR-NOEFFECT
}

TEST(EvalCoord2, EvaluatesTheTensorProduct) {  // EV-MAP2-BEZIER, -DOMAIN, -REVERSED, -EXTRAPOLATE, -ASYM
  Specification gl;
  gl.Enable(GL_MAP2_VERTEX_3);
  // x = B2 over (1, 0, 4) in u times (1 - t) + (0, 8, 0) times t in v.
  const GLfloat points[] = {1, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 4, 0, 0, 0, 0, 0};
  const auto x = [&](double u, double v) {
    gl.Begin(GL_POINTS);
    gl.EvalCoord2d(u, v);
    gl.End();
    return exact(gl.take_primitives().at(0).vertices.at(0).position[0]);
  };
  gl.Map2f(GL_MAP2_VERTEX_3, 2, 4, 6, 3, 1, -1, 3, 2, points);
  // t = 1/4 in u: (9 + 4)/16 and 3/8 * 8; in v from 1 down to -1.
  EXPECT_EQ(x(2.5, 1), Rational(13) / 16);
  EXPECT_EQ(x(2.5, -1), Rational(3));
  EXPECT_EQ(x(2.5, 0.5), Rational(13) / 16 * 3 / 4 + Rational(3) / 4);
  EXPECT_EQ(x(2, 3), Rational(2));  // t = -1 in v
  EXPECT_EQ(x(4, 1), Rational(4));
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

TEST(EvalCoord2, UsesMapsOfTwoDimensionsOnly) {  // EV-EN-DIM, EV-COORD-DIM2, EV-PREC-*
  Specification gl;
  define_line(gl, GL_MAP1_VERTEX_4, 100);
  define_line(gl, GL_MAP1_COLOR_4, 100);
  for (const GLenum target : {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4}) gl.Enable(target);
  gl.Begin(GL_POINTS);
  gl.EvalCoord2f(0, 0);
  gl.End();
  EXPECT_EQ(drawn(gl), "0:");
  define_net(gl);
  gl.Color4f(0.1f, 0.2f, 0.3f, 0.4f);
  gl.Begin(GL_POINTS);
  gl.EvalCoord2f(2, 1);
  gl.End();
  const Vertex vertex = gl.take_primitives().at(0).vertices.at(0);
  EXPECT_EQ(rounded(vertex.position), (Values4{21, 5, 6, 1}));
  EXPECT_EQ(rounded(vertex.color), (Values4{0.1f, 0.2f, 0.3f, 0.4f}));
}

TEST(MapGrid, SetsItsGridOnly) {  // EV-GRID-SET1, -SET2, -INDEP, -FD
  Specification gl;
  gl.MapGrid1f(7, 0.5f, -2);
  EXPECT_EQ(get(gl, GL_MAP1_GRID_SEGMENTS), std::vector<GLdouble>{7});
  EXPECT_EQ(get(gl, GL_MAP1_GRID_DOMAIN), (std::vector<GLdouble>{0.5, -2}));
  EXPECT_EQ(get(gl, GL_MAP2_GRID_SEGMENTS), (std::vector<GLdouble>{1, 1}));
  gl.MapGrid2d(3, 1, 2, 4, 5, 6);
  EXPECT_EQ(get(gl, GL_MAP2_GRID_SEGMENTS), (std::vector<GLdouble>{3, 4}));
  EXPECT_EQ(get(gl, GL_MAP2_GRID_DOMAIN), (std::vector<GLdouble>{1, 2, 5, 6}));
  gl.MapGrid1d(2, 3, 3);  // EV-GRID-EQUAL
  gl.MapGrid2f(5, 0, 0, 6, 1, 1);
  gl.ActiveTexture(GL_TEXTURE3);
  gl.MapGrid2f(8, 0, 1, 9, 2, 3);  // EV-GRID-NOUNIT
  expect_error(gl, GL_NO_ERROR);
  EXPECT_EQ(get(gl, GL_MAP1_GRID_DOMAIN), (std::vector<GLdouble>{3, 3}));
  EXPECT_EQ(get(gl, GL_MAP2_GRID_SEGMENTS), (std::vector<GLdouble>{8, 9}));
}

TEST(MapGrid, RefusesCountsThatAreNotPositive) {  // EV-GRID-ERR-*
  Specification gl;
  gl.MapGrid1f(7, 0.5f, -2);
  gl.MapGrid2f(3, 1, 2, 4, 5, 6);
  const auto state = queryable_state(gl);
  for (const GLint n : {0, -1, std::numeric_limits<GLint>::min()}) {
    gl.MapGrid1f(n, 8, 9);
    expect_error(gl, GL_INVALID_VALUE);
    gl.MapGrid2f(n, 8, 9, 2, 8, 9);
    expect_error(gl, GL_INVALID_VALUE);
    gl.MapGrid2d(2, 8, 9, n, 8, 9);
    expect_error(gl, GL_INVALID_VALUE);
  }
  gl.Begin(GL_POINTS);
  gl.MapGrid1f(2, 8, 9);
  gl.MapGrid2f(2, 8, 9, 2, 8, 9);
  gl.End();
  expect_error(gl, GL_INVALID_OPERATION);
  EXPECT_EQ(queryable_state(gl), state);
}

TEST(EvalPoint, IsTheRealNumberOfTheGrid) {  // EV-POINT1-EQUIV, EV-POINT2-EQUIV, EV-POINT-EXACT-*, -RANGE
  Specification gl;
  const GLfloat line[] = {0, 0, 0, 1, 0, 0};
  gl.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, line);
  gl.Enable(GL_MAP1_VERTEX_3);
  define_net(gl);
  gl.MapGrid1f(3, 0.1f, 0.7f);
  gl.MapGrid2d(3, 0, 2, 7, 1, 0);
  gl.Begin(GL_POINTS);
  for (const GLint i : {0, 1, 3, -2, 5}) gl.EvalPoint1(i);
  gl.EvalPoint2(1, 2);
  gl.EvalPoint2(3, 7);
  gl.EvalPoint2(-1, 8);
  gl.End();
  const Rational first = 0.1f, last = 0.7f, step = (last - first) / 3;
  const auto vertices = gl.take_primitives().at(0).vertices;
  ASSERT_EQ(vertices.size(), 8u);
  const Rational expected[] = {first, first + step, last, first - 2 * step, first + 5 * step,
                               // 10 u + v
                               Rational(20) / 3 + Rational(5) / 7, 20, Rational(-20) / 3 - Rational(1) / 7};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(exact(vertices[i].position[0]), expected[i]) << i;
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

TEST(EvalMesh2, RefusesOtherModesAndStandsOutsideBegin) {  // EV-MESH2-ERR-*, EV-MESH1-ERR-BEGINEND
  Specification gl;
  for (const GLenum mode : {GL_QUADS, GL_QUAD_STRIP, GL_LINES, 0}) {
    gl.EvalMesh2(mode, 1, 0, 1, 0);
    expect_error(gl, GL_INVALID_ENUM);
  }
  define_net(gl);
  gl.Begin(GL_LINES);
  gl.EvalMesh1(GL_POINT, 0, 1);
  gl.EvalMesh2(GL_FILL, 0, 1, 0, 1);
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_INVALID_OPERATION});
  gl.EvalCoord2f(0, 0);
  gl.End();
  expect_error(gl, GL_INVALID_OPERATION);
  EXPECT_EQ(drawn(gl), "1:0");
}

TEST(AutoNormal, IsOfTheSurfaceThatIsDrawn) {  // EV-AUTON-USED, -OVERRIDE, -VERTEX4WINS, -OFF-*, -1D
  Specification gl;
  gl.Normal3f(5, 6, 7);
  const auto normal = [&](bool two) {
    gl.Begin(GL_POINTS);
    two ? gl.EvalCoord2f(0.5f, 0.5f) : gl.EvalCoord1f(0.5f);
    gl.End();
    return rounded(gl.take_primitives().at(0).vertices.at(0).normal);
  };
  // u along x, v along y; and u along y, v along z.
  const GLfloat xy[] = {0, 0, 0, 0, 9, 0, 9, 0, 0, 9, 9, 0};
  const GLfloat yz[] = {0, 0, 0, 1, 0, 0, 9, 1, 0, 9, 0, 1, 0, 9, 9, 1};
  const GLfloat up[] = {0, 0, 3};
  gl.Map2f(GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 3, 2, xy);
  gl.Map2f(GL_MAP2_VERTEX_4, 0, 1, 8, 2, 0, 1, 4, 2, yz);
  gl.Map2f(GL_MAP2_NORMAL, 0, 1, 3, 1, 0, 1, 3, 1, up);
  define_line(gl, GL_MAP1_VERTEX_3, 1);
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.Enable(GL_MAP2_VERTEX_3);
  EXPECT_EQ(normal(true), (Values3{5, 6, 7}));
  gl.Enable(GL_MAP2_NORMAL);
  EXPECT_EQ(normal(true), (Values3{0, 0, 3}));
  gl.Enable(GL_AUTO_NORMAL);
  EXPECT_EQ(normal(true), (Values3{0, 0, 1}));
  gl.Enable(GL_MAP2_VERTEX_4);
  EXPECT_EQ(normal(true), (Values3{1, 0, 0}));
  EXPECT_EQ(normal(false), (Values3{5, 6, 7}));
  EXPECT_EQ(get(gl, GL_CURRENT_NORMAL), (std::vector<GLdouble>{5, 6, 7}));  // EV-AUTON-CURRENT
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
