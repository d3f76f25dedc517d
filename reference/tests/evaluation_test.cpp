// Tests the specification against sections 7, 8, 9 and 11 of the requirements in one dimension, and tests
// Begin, End and current values.
#include <gtest/gtest.h>

#include <limits>

#include "context.h"

namespace evalcts::reference {
namespace {

// Returns the vertices of commands between Begin and End.
template <typename Commands>
std::vector<Vertex> draw(Specification& gl, Commands&& commands) {
  gl.Begin(GL_LINE_STRIP);
  commands();
  gl.End();
  std::vector<Vertex> vertices;
  for (const Primitive& primitive : gl.take_primitives()) {
    vertices.insert(vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
  }
  return vertices;
}

Vertex evaluate_at(Specification& gl, float u) {
  const auto vertices = draw(gl, [&] { gl.EvalCoord1f(u); });
  EXPECT_EQ(vertices.size(), 1u);
  return vertices.at(0);
}

TEST(EvalCoord1, TakesAllFormsOfItsArgument) {  // EV-API-V, EV-COORD-FD
  Specification gl;
  define_line(gl, GL_MAP1_VERTEX_3, 1);
  gl.Enable(GL_MAP1_VERTEX_3);
  const GLfloat f = 0.5f;
  const GLdouble d = 0.5;
  const auto vertices = draw(gl, [&] {
    gl.EvalCoord1f(0.5f);
    gl.EvalCoord1d(0.5);
    gl.EvalCoord1fv(&f);
    gl.EvalCoord1dv(&d);
    gl.EvalCoord1fv(nullptr);
    gl.EvalCoord1dv(nullptr);
    gl.EvalCoord1d(1.0 / 3);
  });
  ASSERT_EQ(vertices.size(), 5u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(rounded(vertices[i].position), (Values4{6, 7, 8, 1}));
  EXPECT_EQ(exact(vertices[4].position[0]), 1 + 10 * Rational(1.0 / 3));  // not rounded to single
  expect_error(gl, GL_NO_ERROR);
}

TEST(EvalCoord1, EvaluatesTheBezierCurve) {  // EV-MAP1-BEZIER, -DOMAIN, -REVERSED, -EXTRAPOLATE, -ORDER-ONE
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  const GLfloat cubic[] = {1, 0, 0, -2, 0, 0, 4, 0, 0, 8, 0, 0};
  gl.Map1f(GL_MAP1_VERTEX_3, 2, 6, 3, 4, cubic);
  // t = 1/4: (27 * 1 + 27 * -2 + 9 * 4 + 8) / 64
  EXPECT_EQ(exact(evaluate_at(gl, 3).position[0]), Rational(17) / 64);
  // t = -1: 8 * 1 - 12 * -2 + 6 * 4 - 8
  EXPECT_EQ(exact(evaluate_at(gl, -2).position[0]), Rational(48));
  EXPECT_EQ(exact(evaluate_at(gl, 2).position[0]), Rational(1));  // EV-MAP1-ZEROPOW
  EXPECT_EQ(exact(evaluate_at(gl, 6).position[0]), Rational(8));
  gl.Map1f(GL_MAP1_VERTEX_3, 6, 2, 3, 4, cubic);
  EXPECT_EQ(exact(evaluate_at(gl, 5).position[0]), Rational(17) / 64);
  EXPECT_EQ(exact(evaluate_at(gl, 6).position[0]), Rational(1));
  gl.Map1f(GL_MAP1_VERTEX_3, 6, 2, 3, 1, cubic);
  for (const float u : {-3.0f, 0.0f, 1e30f}) EXPECT_EQ(exact(evaluate_at(gl, u).position[0]), Rational(1));
}

TEST(EvalCoord1, UsesTheInitialMaps) {  // EV-INIT-EVALUABLE
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  for (const float u : {-3.0f, 0.0f, 0.5f, 7.0f})
    EXPECT_EQ(rounded(evaluate_at(gl, u).position), (Values4{0, 0, 0, 1}));
}

TEST(EvalCoord1,
     NeedsAVertexMapOfItsDimension) {  // EV-COORD-NOVERTEX, -NOVERTEX-OTHERDIM, U-OUTSIDE-NOVERTEX
  Specification gl;
  for (const GLenum target : map_targets()) {
    if (target != GL_MAP1_VERTEX_3 && target != GL_MAP1_VERTEX_4) gl.Enable(target);
  }
  const auto before = queryable_state(gl);
  EXPECT_TRUE(draw(gl, [&] { gl.EvalCoord1f(0.5f); }).empty());
  gl.EvalCoord1f(0.5f);
  EXPECT_EQ(queryable_state(gl), before);
  expect_error(gl, GL_NO_ERROR);
}

TEST(EvalCoord1, DoesNothingOutsideBeginEnd) {  // U-OUTSIDE-VERTEX
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.EvalCoord1f(0.5f);
  gl.Vertex2f(1, 2);
  EXPECT_TRUE(gl.take_primitives().empty());
  expect_error(gl, GL_NO_ERROR);
}

TEST(EvalCoord1, LooksOnlyAtMapsOfItsDimension) {  // EV-COORD-DIM1, EV-EN-DIM, EV-AUTON-1D
  Specification gl;
  define_line(gl, GL_MAP1_VERTEX_3, 1);
  gl.Enable(GL_MAP1_VERTEX_3);
  for (const GLenum target : kMap2Targets) gl.Enable(target);
  gl.Enable(GL_AUTO_NORMAL);
  gl.Color4f(0.1f, 0.2f, 0.3f, 0.4f);
  gl.Normal3f(5, 6, 7);
  gl.TexCoord4f(1, 2, 3, 4);
  gl.Indexf(9);
  const Vertex vertex = evaluate_at(gl, 1);
  EXPECT_EQ(rounded(vertex.position), (Values4{11, 12, 13, 1}));
  EXPECT_EQ(rounded(vertex.color), (Values4{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(rounded(vertex.normal), (Values3{5, 6, 7}));
  EXPECT_EQ(rounded(vertex.texture_coordinate[0]), (Values4{1, 2, 3, 4}));
  EXPECT_EQ(rounded(vertex.index), 9);
}

// Each kind of map acts like its command (EV-COORD-ASIF, EV-ATTR-*, EV-COORD-VERTEXLAST).
TEST(EvalCoord1, ActsLikeTheCommandOfEachMap) {
  Specification gl;
  float first = 100;
  for (const GLenum target : kMap1Targets) define_line(gl, target, first += 100);
  gl.Enable(GL_MAP1_VERTEX_4);
  gl.Enable(GL_MAP1_COLOR_4);
  gl.Enable(GL_MAP1_INDEX);
  gl.Enable(GL_MAP1_NORMAL);
  gl.Enable(GL_MAP1_TEXTURE_COORD_3);
  gl.TexCoord4f(5, 6, 7, 8);
  const Vertex vertex = evaluate_at(gl, 0.5f);
  EXPECT_EQ(rounded(vertex.color), (Values4{205, 206, 207, 208}));  // not clamped (EV-ATTR-COLOR-CLAMP)
  EXPECT_EQ(rounded(vertex.index), 305);
  EXPECT_EQ(rounded(vertex.normal), (Values3{405, 406, 407}));  // not normalised
  EXPECT_EQ(rounded(vertex.texture_coordinate[0]), (Values4{705, 706, 707, 1}));
  EXPECT_EQ(rounded(vertex.position), (Values4{1005, 1006, 1007, 1008}));  // not divided by w
}

TEST(EvalCoord1, FillsMissingTextureCoordinates) {  // EV-ATTR-TEX1 ... TEX4, EV-CUR-MAXCOMP
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.TexCoord4f(5, 6, 7, 8);
  const Values4 expected[] = {{21, 0, 0, 1}, {22, 23, 0, 1}, {23, 24, 25, 1}, {24, 25, 26, 27}};
  for (const int n : {1, 4, 2, 3, 1}) {
    const GLenum target = GL_MAP1_TEXTURE_COORD_1 + n - 1;
    define_line(gl, target, 10 + n);
    gl.Enable(target);
    EXPECT_EQ(rounded(evaluate_at(gl, 1).texture_coordinate[0]), expected[n - 1]);
    gl.Disable(target);
  }
  EXPECT_EQ(get(gl, GL_CURRENT_TEXTURE_COORDS), (std::vector<GLdouble>{5, 6, 7, 8}));  // EV-CUR-TEX
}

TEST(EvalCoord1, FeedsTextureUnitZeroOnly) {  // EV-ATTR-UNIT0, EV-ATTR-OTHERUNITS
  Specification gl;
  define_line(gl, GL_MAP1_TEXTURE_COORD_2, 1);
  gl.Enable(GL_MAP1_TEXTURE_COORD_2);
  gl.Enable(GL_MAP1_VERTEX_3);
  for (GLenum unit = 0; unit < 8; ++unit) {
    gl.MultiTexCoord4f(GL_TEXTURE0 + unit, unit * 10.0f, 1, 2, 3);
  }
  gl.ActiveTexture(GL_TEXTURE3);
  const Vertex vertex = evaluate_at(gl, 0);
  EXPECT_EQ(rounded(vertex.texture_coordinate[0]), (Values4{1, 2, 0, 1}));
  for (int unit = 1; unit < 8; ++unit) {
    EXPECT_EQ(rounded(vertex.texture_coordinate[unit]), (Values4{unit * 10.0f, 1, 2, 3}));
  }
}

TEST(Precedence, OfVertexMaps) {  // EV-PREC-VERTEX, -ORDERFREE, -FALLBACK, -NOVALIDITY
  for (const bool four_first : {false, true}) {
    Specification gl;
    gl.Enable(four_first ? GL_MAP1_VERTEX_4 : GL_MAP1_VERTEX_3);
    gl.Enable(four_first ? GL_MAP1_VERTEX_3 : GL_MAP1_VERTEX_4);
    define_line(gl, GL_MAP1_VERTEX_3, 1);
    EXPECT_EQ(rounded(evaluate_at(gl, 0.5f).position), (Values4{0, 0, 0, 1}));
    define_line(gl, GL_MAP1_VERTEX_4, 20);
    EXPECT_EQ(rounded(evaluate_at(gl, 0).position), (Values4{20, 21, 22, 23}));
    gl.Disable(GL_MAP1_VERTEX_4);
    EXPECT_EQ(rounded(evaluate_at(gl, 0).position), (Values4{1, 2, 3, 1}));
  }
}

TEST(Precedence, OfTextureMaps) {  // EV-PREC-TEX, EV-PREC-LOSER-IGNORED
  for (int subset = 1; subset < 16; ++subset) {
    Specification gl;
    gl.Enable(GL_MAP1_VERTEX_3);
    int winner = 0;
    for (int n = 1; n <= 4; ++n) {
      const GLenum target = GL_MAP1_TEXTURE_COORD_1 + n - 1;
      define_line(gl, target, 100 * n);
      if (subset >> (n - 1) & 1) {
        gl.Enable(target);
        winner = n;
      }
    }
    Values4 expected{0, 0, 0, 1};
    for (int c = 0; c < winner; ++c) expected[c] = 100 * winner + c;
    EXPECT_EQ(rounded(evaluate_at(gl, 0).texture_coordinate[0]), expected) << subset;
  }
}

TEST(Evaluation, LeavesTheStateAlone) {  // EV-CUR-*
  Specification gl;
  for (const GLenum target : kMap1Targets) {
    define_line(gl, target, 7);
    gl.Enable(target);
  }
  gl.Color4f(0.1f, 0.2f, 0.3f, 0.4f);
  gl.Normal3f(1, 2, 3);
  gl.TexCoord4f(5, 6, 7, 8);
  gl.Indexf(4);
  gl.EdgeFlag(GL_FALSE);
  const auto before = queryable_state(gl);
  const auto vertices = draw(gl, [&] {
    gl.EvalCoord1f(0.25f);
    gl.Vertex3f(1, 2, 3);  // EV-CUR-NEXTVERTEX, EV-COORD-MIX
    gl.EvalCoord1f(0.75f);
  });
  EXPECT_EQ(queryable_state(gl), before);
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_EQ(rounded(vertices[1].position), (Values4{1, 2, 3, 1}));
  EXPECT_EQ(rounded(vertices[1].color), (Values4{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(rounded(vertices[1].normal), (Values3{1, 2, 3}));
  EXPECT_EQ(rounded(vertices[1].texture_coordinate[0]), (Values4{5, 6, 7, 8}));
  EXPECT_EQ(rounded(vertices[1].index), 4);
  EXPECT_EQ(rounded(vertices[0].color), (Values4{9.5f, 10.5f, 11.5f, 12.5f}));
  EXPECT_EQ(rounded(vertices[2].color), (Values4{14.5f, 15.5f, 16.5f, 17.5f}));
  for (const Vertex& vertex : vertices) EXPECT_FALSE(vertex.edge_flag);  // EV-ATTR-NOMAPS
}

TEST(Evaluation, SeesCurrentValuesOfItsMoment) {  // EV-COORD-CURRENT, EV-COORD-MATERIAL
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  const auto vertices = draw(gl, [&] {
    gl.Color3f(1, 0, 0);
    gl.EvalCoord1f(0);
    gl.Color3f(0, 1, 0);
    gl.EdgeFlag(GL_FALSE);
    gl.EvalCoord1f(0);
  });
  ASSERT_EQ(vertices.size(), 2u);
  EXPECT_EQ(rounded(vertices[0].color), (Values4{1, 0, 0, 1}));
  EXPECT_TRUE(vertices[0].edge_flag);
  EXPECT_EQ(rounded(vertices[1].color), (Values4{0, 1, 0, 1}));
  EXPECT_FALSE(vertices[1].edge_flag);
}

TEST(Evaluation, KeepsTheMapOfItsMoment) {  // EV-MAP1-LIVE
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  define_line(gl, GL_MAP1_VERTEX_3, 1);
  gl.Begin(GL_POINTS);
  gl.EvalCoord1f(0);
  gl.End();
  define_line(gl, GL_MAP1_VERTEX_3, 50);
  gl.Begin(GL_LINES);
  gl.EvalCoord1f(0);
  gl.End();
  const auto primitives = gl.take_primitives();
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_EQ(primitives[0].mode, static_cast<GLenum>(GL_POINTS));
  EXPECT_EQ(primitives[1].mode, static_cast<GLenum>(GL_LINES));
  EXPECT_EQ(rounded(primitives[0].vertices[0].position[0]), 1);
  EXPECT_EQ(rounded(primitives[1].vertices[0].position[0]), 50);
}

TEST(Evaluation, SurvivesNumbersThatAreNone) {  // EV-NUM-SPECIAL-SAFE, U-NAN-*
  Specification gl;
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const GLfloat points[] = {1, nan, 3, 4, 5, infinity};
  gl.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, points);
  gl.Enable(GL_MAP1_VERTEX_3);
  const auto vertices = draw(gl, [&] {
    gl.EvalCoord1f(nan);
    gl.EvalCoord1f(infinity);
    gl.EvalCoord1f(0.5f);
    gl.Vertex4f(nan, infinity, 1, 2);
  });
  ASSERT_EQ(vertices.size(), 4u);
  for (const Component& component : vertices[0].position) {
    EXPECT_EQ(is_finite(component), &component == &vertices[0].position[3]);  // w is 1
  }
  EXPECT_TRUE(std::isnan(rounded(vertices[1].position[0])));
  EXPECT_EQ(rounded(vertices[2].position[0]), 2.5f);  // not affected by the other components
  EXPECT_TRUE(is_finite(vertices[2].position[0]));
  EXPECT_TRUE(std::isnan(rounded(vertices[2].position[1])));
  EXPECT_TRUE(std::isnan(rounded(vertices[2].position[2])));
  EXPECT_FALSE(is_finite(vertices[3].position[0]));
  EXPECT_EQ(rounded(vertices[3].position[1]), infinity);
  gl.Map1f(GL_MAP1_VERTEX_3, nan, infinity, 3, 1, points);
  EXPECT_FALSE(is_finite(evaluate_at(gl, 0.5f).position[0]));
  expect_error(gl, GL_NO_ERROR);
}

TEST(BeginEnd, DeliversEveryPrimitive) {  // EV-COORD-PRIMS
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
    gl.Begin(mode);
    for (GLenum i = 0; i < mode; ++i) gl.EvalCoord1f(0);
    EXPECT_TRUE(gl.take_primitives().empty());  // still open
    gl.End();
    const auto primitives = gl.take_primitives();
    ASSERT_EQ(primitives.size(), 1u);
    EXPECT_EQ(primitives[0].mode, mode);
    EXPECT_EQ(primitives[0].vertices.size(), mode);
    EXPECT_TRUE(gl.take_primitives().empty());
  }
  expect_error(gl, GL_NO_ERROR);
}

TEST(CurrentValues, TakeAllForms) {
  Specification gl;
  const GLfloat f[] = {1.5f, 2.5f, 3.5f, 4.5f};
  const GLdouble d[] = {1.5, 2.5, 3.5, 4.5};
  const auto positions = draw(gl, [&] {
    gl.Vertex2f(1.5f, 2.5f), gl.Vertex2d(1.5, 2.5), gl.Vertex2fv(f), gl.Vertex2dv(d);
    gl.Vertex3f(1.5f, 2.5f, 3.5f), gl.Vertex3d(1.5, 2.5, 3.5), gl.Vertex3fv(f), gl.Vertex3dv(d);
    gl.Vertex4f(1.5f, 2.5f, 3.5f, 4.5f), gl.Vertex4d(1.5, 2.5, 3.5, 4.5), gl.Vertex4fv(f), gl.Vertex4dv(d);
  });
  ASSERT_EQ(positions.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    const Values4 expected[] = {{1.5f, 2.5f, 0, 1}, {1.5f, 2.5f, 3.5f, 1}, {1.5f, 2.5f, 3.5f, 4.5f}};
    EXPECT_EQ(rounded(positions[i].position), expected[i / 4]) << i;
  }

  const auto check = [&](const std::function<void()>& command, GLenum pname,
                         const std::vector<GLdouble>& expected) {
    gl.Color4f(9, 9, 9, 9), gl.Normal3f(9, 9, 9), gl.TexCoord4f(9, 9, 9, 9), gl.Indexf(9),
        gl.EdgeFlag(GL_TRUE);
    command();
    EXPECT_EQ(get(gl, pname), expected);
  };
  const std::vector<GLdouble> three{1.5, 2.5, 3.5}, opaque{1.5, 2.5, 3.5, 1}, four{1.5, 2.5, 3.5, 4.5};
  check([&] { gl.Color3f(1.5f, 2.5f, 3.5f); }, GL_CURRENT_COLOR, opaque);
  check([&] { gl.Color3d(1.5, 2.5, 3.5); }, GL_CURRENT_COLOR, opaque);
  check([&] { gl.Color3fv(f); }, GL_CURRENT_COLOR, opaque);
  check([&] { gl.Color3dv(d); }, GL_CURRENT_COLOR, opaque);
  check([&] { gl.Color4f(1.5f, 2.5f, 3.5f, 4.5f); }, GL_CURRENT_COLOR, four);
  check([&] { gl.Color4d(1.5, 2.5, 3.5, 4.5); }, GL_CURRENT_COLOR, four);
  check([&] { gl.Color4fv(f); }, GL_CURRENT_COLOR, four);
  check([&] { gl.Color4dv(d); }, GL_CURRENT_COLOR, four);
  check([&] { gl.Normal3f(1.5f, 2.5f, 3.5f); }, GL_CURRENT_NORMAL, three);
  check([&] { gl.Normal3d(1.5, 2.5, 3.5); }, GL_CURRENT_NORMAL, three);
  check([&] { gl.Normal3fv(f); }, GL_CURRENT_NORMAL, three);
  check([&] { gl.Normal3dv(d); }, GL_CURRENT_NORMAL, three);
  check([&] { gl.Indexf(1.5f); }, GL_CURRENT_INDEX, {1.5});
  check([&] { gl.Indexd(1.5); }, GL_CURRENT_INDEX, {1.5});
  check([&] { gl.Indexfv(f); }, GL_CURRENT_INDEX, {1.5});
  check([&] { gl.Indexdv(d); }, GL_CURRENT_INDEX, {1.5});
  const GLboolean off = GL_FALSE;
  check([&] { gl.EdgeFlag(GL_FALSE); }, GL_EDGE_FLAG, {0});
  check([&] { gl.EdgeFlagv(&off); }, GL_EDGE_FLAG, {0});
  check([&] { gl.EdgeFlag(77); }, GL_EDGE_FLAG, {1});

  const std::vector<GLdouble> one{1.5, 0, 0, 1}, two{1.5, 2.5, 0, 1};
  check([&] { gl.TexCoord1f(1.5f); }, GL_CURRENT_TEXTURE_COORDS, one);
  check([&] { gl.TexCoord1d(1.5); }, GL_CURRENT_TEXTURE_COORDS, one);
  check([&] { gl.TexCoord1fv(f); }, GL_CURRENT_TEXTURE_COORDS, one);
  check([&] { gl.TexCoord1dv(d); }, GL_CURRENT_TEXTURE_COORDS, one);
  check([&] { gl.TexCoord2f(1.5f, 2.5f); }, GL_CURRENT_TEXTURE_COORDS, two);
  check([&] { gl.TexCoord2d(1.5, 2.5); }, GL_CURRENT_TEXTURE_COORDS, two);
  check([&] { gl.TexCoord2fv(f); }, GL_CURRENT_TEXTURE_COORDS, two);
  check([&] { gl.TexCoord2dv(d); }, GL_CURRENT_TEXTURE_COORDS, two);
  check([&] { gl.TexCoord3f(1.5f, 2.5f, 3.5f); }, GL_CURRENT_TEXTURE_COORDS, opaque);
  check([&] { gl.TexCoord3d(1.5, 2.5, 3.5); }, GL_CURRENT_TEXTURE_COORDS, opaque);
  check([&] { gl.TexCoord3fv(f); }, GL_CURRENT_TEXTURE_COORDS, opaque);
  check([&] { gl.TexCoord3dv(d); }, GL_CURRENT_TEXTURE_COORDS, opaque);
  check([&] { gl.TexCoord4f(1.5f, 2.5f, 3.5f, 4.5f); }, GL_CURRENT_TEXTURE_COORDS, four);
  check([&] { gl.TexCoord4d(1.5, 2.5, 3.5, 4.5); }, GL_CURRENT_TEXTURE_COORDS, four);
  check([&] { gl.TexCoord4fv(f); }, GL_CURRENT_TEXTURE_COORDS, four);
  check([&] { gl.TexCoord4dv(d); }, GL_CURRENT_TEXTURE_COORDS, four);

  // MultiTexCoord sets the unit of its argument; the query returns the active unit.
  gl.ActiveTexture(GL_TEXTURE7);
  const GLenum unit = GL_TEXTURE7;
  const auto check_unit = [&](const std::function<void()>& command, const std::vector<GLdouble>& expected) {
    gl.MultiTexCoord4f(unit, 9, 9, 9, 9);
    command();
    EXPECT_EQ(get(gl, GL_CURRENT_TEXTURE_COORDS), expected);
  };
  check_unit([&] { gl.MultiTexCoord1f(unit, 1.5f); }, one);
  check_unit([&] { gl.MultiTexCoord1d(unit, 1.5); }, one);
  check_unit([&] { gl.MultiTexCoord1fv(unit, f); }, one);
  check_unit([&] { gl.MultiTexCoord1dv(unit, d); }, one);
  check_unit([&] { gl.MultiTexCoord2f(unit, 1.5f, 2.5f); }, two);
  check_unit([&] { gl.MultiTexCoord2d(unit, 1.5, 2.5); }, two);
  check_unit([&] { gl.MultiTexCoord2fv(unit, f); }, two);
  check_unit([&] { gl.MultiTexCoord2dv(unit, d); }, two);
  check_unit([&] { gl.MultiTexCoord3f(unit, 1.5f, 2.5f, 3.5f); }, opaque);
  check_unit([&] { gl.MultiTexCoord3d(unit, 1.5, 2.5, 3.5); }, opaque);
  check_unit([&] { gl.MultiTexCoord3fv(unit, f); }, opaque);
  check_unit([&] { gl.MultiTexCoord3dv(unit, d); }, opaque);
  check_unit([&] { gl.MultiTexCoord4f(unit, 1.5f, 2.5f, 3.5f, 4.5f); }, four);
  check_unit([&] { gl.MultiTexCoord4d(unit, 1.5, 2.5, 3.5, 4.5); }, four);
  check_unit([&] { gl.MultiTexCoord4fv(unit, f); }, four);
  check_unit([&] { gl.MultiTexCoord4dv(unit, d); }, four);
  gl.TexCoord1f(77);  // sets unit 0, whichever unit is active
  EXPECT_EQ(get(gl, GL_CURRENT_TEXTURE_COORDS), four);
  expect_error(gl, GL_NO_ERROR);
}

TEST(CurrentValues, AreKeptInSinglePrecision) {
  Specification gl;
  gl.Color4d(1.0 / 3, 1e300, 1e-300, -0.0);
  EXPECT_EQ(get(gl, GL_CURRENT_COLOR),
            (std::vector<GLdouble>{1.0f / 3, std::numeric_limits<double>::infinity(), 0, 0}));
  const auto vertices = draw(gl, [&] { gl.Vertex2d(0.1, -1e300); });
  EXPECT_EQ(rounded(vertices.at(0).position), (Values4{0.1f, -std::numeric_limits<float>::infinity(), 0, 1}));
}

TEST(CurrentValues, RefuseUnknownTextureUnits) {
  Specification gl;
  const auto before = queryable_state(gl);
  for (const GLenum texture : {GL_TEXTURE0 - 1u, GL_TEXTURE0 + 8u, 0u, 0xFFFFFFFFu}) {
    gl.ActiveTexture(texture);
    expect_error(gl, GL_INVALID_ENUM);
    gl.MultiTexCoord2f(texture, 1, 2);
    expect_error(gl, GL_INVALID_ENUM);
  }
  EXPECT_EQ(queryable_state(gl), before);
}

TEST(CurrentValues, WithNullPointersStayAsTheyAre) {  // U-NULL
  Specification gl;
  const auto before = queryable_state(gl);
  const auto vertices = draw(gl, [&] {
    gl.Vertex2fv(nullptr), gl.Vertex3fv(nullptr), gl.Vertex4fv(nullptr);
    gl.Vertex2dv(nullptr), gl.Vertex3dv(nullptr), gl.Vertex4dv(nullptr);
    gl.Color3fv(nullptr), gl.Color4fv(nullptr), gl.Color3dv(nullptr), gl.Color4dv(nullptr);
    gl.Normal3fv(nullptr), gl.Normal3dv(nullptr), gl.Indexfv(nullptr), gl.Indexdv(nullptr),
        gl.EdgeFlagv(nullptr);
    gl.TexCoord1fv(nullptr), gl.TexCoord2fv(nullptr), gl.TexCoord3fv(nullptr), gl.TexCoord4fv(nullptr);
    gl.TexCoord1dv(nullptr), gl.TexCoord2dv(nullptr), gl.TexCoord3dv(nullptr), gl.TexCoord4dv(nullptr);
    gl.MultiTexCoord1fv(GL_TEXTURE0, nullptr), gl.MultiTexCoord4dv(GL_TEXTURE0, nullptr);
    gl.MultiTexCoord2fv(GL_TEXTURE0, nullptr), gl.MultiTexCoord3dv(GL_TEXTURE0, nullptr);
    gl.MultiTexCoord3fv(GL_TEXTURE0, nullptr), gl.MultiTexCoord2dv(GL_TEXTURE0, nullptr);
    gl.MultiTexCoord4fv(GL_TEXTURE0, nullptr), gl.MultiTexCoord1dv(GL_TEXTURE0, nullptr);
  });
  EXPECT_TRUE(vertices.empty());
  EXPECT_EQ(queryable_state(gl), before);
}

}  // namespace
}  // namespace evalcts::reference
