// Tests evaluation in one dimension and current values: forms, null pointers, non-finite numbers, and the
// parts of a vertex that golden vectors do not show. The golden vectors (vectors/state.json) hold the rest.
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

TEST(EvalCoord1, DoesNothingOutsideBeginEnd) {  // U-OUTSIDE-VERTEX
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.EvalCoord1f(0.5f);
  gl.Vertex2f(1, 2);
  EXPECT_TRUE(gl.take_primitives().empty());
  expect_error(gl, GL_NO_ERROR);
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

// The four forms of a command of n numbers; `unit` is empty or the first argument with a comma.
#define FLOATS_1 1.5f
#define FLOATS_2 1.5f, 2.5f
#define FLOATS_3 1.5f, 2.5f, 3.5f
#define FLOATS_4 1.5f, 2.5f, 3.5f, 4.5f
#define CALL(...) [](Specification& c) { c.__VA_ARGS__; }
#define FORMS(name, n, unit)                                                       \
  {                                                                                \
    CALL(name##n##f(unit FLOATS_##n)), CALL(name##n##d(unit FLOATS_##n)),          \
        CALL(name##n##fv(unit kFourFloats)), CALL(name##n##dv(unit kFourDoubles)), \
        CALL(name##n##fv(unit nullptr)), CALL(name##n##dv(unit nullptr))           \
  }
#define UNIT_7 GL_TEXTURE7,
const GLfloat kFourFloats[] = {FLOATS_4};
const GLdouble kFourDoubles[] = {FLOATS_4};

TEST(CurrentValues, TakeAllForms) {  // a null pointer has no effect (U-NULL)
  struct Forms {
    std::array<std::function<void(Specification&)>, 6> commands;  // the last two with null pointers
    GLenum pname;                                                 // 0: a vertex
    std::vector<GLdouble> expected;
    GLenum unit = GL_TEXTURE0;
  };
  const std::vector<GLdouble> one{1.5, 0, 0, 1}, two{1.5, 2.5, 0, 1}, three{1.5, 2.5, 3.5, 1},
      four{1.5, 2.5, 3.5, 4.5};
  const Forms all[] = {{FORMS(Vertex, 2, ), 0, two},
                       {FORMS(Vertex, 3, ), 0, three},
                       {FORMS(Vertex, 4, ), 0, four},
                       {FORMS(Color, 3, ), GL_CURRENT_COLOR, three},
                       {FORMS(Color, 4, ), GL_CURRENT_COLOR, four},
                       {FORMS(Normal, 3, ), GL_CURRENT_NORMAL, {1.5, 2.5, 3.5}},
                       {FORMS(TexCoord, 1, ), GL_CURRENT_TEXTURE_COORDS, one},
                       {FORMS(TexCoord, 2, ), GL_CURRENT_TEXTURE_COORDS, two},
                       {FORMS(TexCoord, 3, ), GL_CURRENT_TEXTURE_COORDS, three},
                       {FORMS(TexCoord, 4, ), GL_CURRENT_TEXTURE_COORDS, four},
                       {FORMS(MultiTexCoord, 1, UNIT_7), GL_CURRENT_TEXTURE_COORDS, one, GL_TEXTURE7},
                       {FORMS(MultiTexCoord, 2, UNIT_7), GL_CURRENT_TEXTURE_COORDS, two, GL_TEXTURE7},
                       {FORMS(MultiTexCoord, 3, UNIT_7), GL_CURRENT_TEXTURE_COORDS, three, GL_TEXTURE7},
                       {FORMS(MultiTexCoord, 4, UNIT_7), GL_CURRENT_TEXTURE_COORDS, four, GL_TEXTURE7}};
  for (const Forms& forms : all) {
    for (std::size_t form = 0; form < 6; ++form) {
      SCOPED_TRACE(testing::Message() << &forms - all << " form " << form);
      Specification gl;
      gl.ActiveTexture(forms.unit == GL_TEXTURE0 ? GL_TEXTURE1 : GL_TEXTURE0);  // does not matter
      const auto before = queryable_state(gl);
      const auto vertices = draw(gl, [&] { forms.commands[form](gl); });
      if (form >= 4) {
        EXPECT_TRUE(vertices.empty());
        EXPECT_EQ(queryable_state(gl), before);
      } else if (forms.pname == 0) {
        ASSERT_EQ(vertices.size(), 1u);
        const Values4 position = rounded(vertices[0].position);
        EXPECT_EQ(std::vector<GLdouble>(position.begin(), position.end()), forms.expected);
      } else {
        gl.ActiveTexture(forms.unit);
        EXPECT_EQ(get(gl, forms.pname), forms.expected);
      }
      expect_error(gl, GL_NO_ERROR);
    }
  }
}

TEST(CurrentValues, OfIndicesAndEdgeFlags) {
  Specification gl;
  const GLboolean off = GL_FALSE;
  const std::function<void()> commands[] = {[&] { gl.Indexf(1.5f); }, [&] { gl.Indexd(1.5); },
                                            [&] { gl.Indexfv(kFourFloats); },
                                            [&] { gl.Indexdv(kFourDoubles); }};
  for (const auto& command : commands) {
    gl.Indexf(9);
    command();
    EXPECT_EQ(get(gl, GL_CURRENT_INDEX), std::vector<GLdouble>{1.5});
  }
  gl.EdgeFlagv(&off);
  EXPECT_EQ(get(gl, GL_EDGE_FLAG), std::vector<GLdouble>{0});
  gl.EdgeFlag(77);
  gl.Indexfv(nullptr), gl.Indexdv(nullptr), gl.EdgeFlagv(nullptr);
  EXPECT_EQ(get(gl, GL_CURRENT_INDEX), std::vector<GLdouble>{1.5});
  EXPECT_EQ(get(gl, GL_EDGE_FLAG), std::vector<GLdouble>{1});
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

}  // namespace
}  // namespace evalcts::reference
