// Tests state, queries and errors: conversions, permitted answers, null pointers, and state that golden
// vectors do not show. The golden vectors (vectors/get_map.json, vectors/state.json) hold the rest.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "context.h"

namespace evalcts::reference {
namespace {

TEST(InitialState, OfCurrentValuesAndLimits) {  // golden vectors show maps, grids and enables
  Specification gl;
  EXPECT_EQ(get(gl, GL_CURRENT_COLOR), (std::vector<GLdouble>{1, 1, 1, 1}));
  EXPECT_EQ(get(gl, GL_CURRENT_NORMAL), (std::vector<GLdouble>{0, 0, 1}));
  EXPECT_EQ(get(gl, GL_CURRENT_INDEX), std::vector<GLdouble>{1});
  EXPECT_EQ(get(gl, GL_EDGE_FLAG), std::vector<GLdouble>{1});
  EXPECT_EQ(get(gl, GL_ACTIVE_TEXTURE), std::vector<GLdouble>{GL_TEXTURE0});
  EXPECT_EQ(get(gl, GL_RGBA_MODE), std::vector<GLdouble>{1});
  EXPECT_EQ(get(gl, GL_INDEX_MODE), std::vector<GLdouble>{0});
  EXPECT_EQ(get(gl, GL_MAX_TEXTURE_UNITS), std::vector<GLdouble>{8});
  EXPECT_EQ(get(gl, GL_MAX_TEXTURE_COORDS), std::vector<GLdouble>{8});
  EXPECT_EQ(get(gl, GL_LIST_BASE), std::vector<GLdouble>{0});
  EXPECT_EQ(get(gl, GL_MAX_LIST_NESTING), std::vector<GLdouble>{64});
  EXPECT_EQ(get(gl, GL_MAX_ATTRIB_STACK_DEPTH), std::vector<GLdouble>{16});
  for (GLenum unit = 0; unit < 8; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    EXPECT_EQ(get(gl, GL_CURRENT_TEXTURE_COORDS), (std::vector<GLdouble>{0, 0, 0, 1}));
  }
  expect_error(gl, GL_NO_ERROR);
  EXPECT_TRUE(gl.take_primitives().empty());
}

TEST(InitialState, HasTheMaximumOrderAskedFor) {  // EV-INIT-MAXORDER
  const auto maximum = [](int asked) {
    Specification gl(Specification::Options{asked});
    return get(gl, GL_MAX_EVAL_ORDER);
  };
  EXPECT_EQ(maximum(30), std::vector<GLdouble>{30});
  EXPECT_EQ(maximum(-5), std::vector<GLdouble>{8});
  EXPECT_EQ(maximum(1000), std::vector<GLdouble>{64});
}

TEST(Enables, RefuseOtherNames) {
  Specification gl;
  for (const GLenum cap :
       {0x0D8Fu, 0x0D99u, 0x0DB9u, 0u, 0xFFFFFFFFu, static_cast<GLenum>(GL_MAX_EVAL_ORDER)}) {
    gl.Enable(cap);
    expect_error(gl, GL_INVALID_ENUM);
    gl.Disable(cap);
    expect_error(gl, GL_INVALID_ENUM);
    EXPECT_EQ(gl.IsEnabled(cap), GL_FALSE);
    expect_error(gl, GL_INVALID_ENUM);
  }
}

TEST(BeginEnd, ForbidsEverythingButItsOwnCommands) {  // EV-BE-ALLOWED, EV-EN-BEGINEND, EV-*-ERR-BEGINEND
  Specification gl;
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.NewList(7, GL_COMPILE);
  gl.EndList();
  gl.PushAttrib(0);
  const auto before = queryable_state(gl);
  GLfloat f[16] = {7, 7, 7, 7, 7, 7, 7, 7};
  GLdouble d[16] = {7, 7, 7, 7, 7, 7, 7, 7};
  GLint i[16] = {7};
  GLboolean b[16] = {7};
  const std::vector<std::function<void()>> forbidden{
      [&] { gl.Map1f(GL_MAP1_VERTEX_4, 0, 2, 4, 1, f); },
      [&] { gl.Map1d(GL_MAP1_VERTEX_4, 0, 2, 4, 1, d); },
      [&] { gl.GetMapfv(GL_MAP1_VERTEX_3, GL_ORDER, f); },
      [&] { gl.GetMapdv(GL_MAP1_VERTEX_3, GL_ORDER, d); },
      [&] { gl.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, i); },
      [&] { gl.Enable(GL_MAP1_VERTEX_4); },
      [&] { gl.Disable(GL_MAP1_VERTEX_3); },
      [&] { EXPECT_EQ(gl.IsEnabled(GL_MAP1_VERTEX_3), GL_FALSE); },
      [&] { gl.GetBooleanv(GL_MAP1_VERTEX_3, b); },
      [&] { gl.GetIntegerv(GL_MAX_EVAL_ORDER, i); },
      [&] { gl.GetFloatv(GL_MAP1_GRID_DOMAIN, f); },
      [&] { gl.GetDoublev(GL_MAP1_GRID_DOMAIN, d); },
      [&] { EXPECT_EQ(gl.GetString(GL_VERSION), nullptr); },
      [&] { EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR)); },
      [&] { gl.Begin(GL_LINES); },
      [&] { gl.ActiveTexture(GL_TEXTURE1); },
      [&] { gl.MapGrid1f(2, 8, 9); },
      [&] { gl.MapGrid2f(2, 8, 9, 2, 8, 9); },
      [&] { gl.EvalMesh1(GL_POINT, 0, 1); },
      [&] { gl.EvalMesh2(GL_FILL, 0, 1, 0, 1); },
      [&] { gl.PushAttrib(GL_CURRENT_BIT); },
      [&] { gl.PopAttrib(); },
      [&] { gl.NewList(1, GL_COMPILE); },
      [&] { gl.EndList(); },
      [&] { gl.ListBase(5); },
      [&] { EXPECT_EQ(gl.GenLists(1), 0u); },
      [&] { EXPECT_EQ(gl.IsList(7), GL_FALSE); },
      [&] { gl.DeleteLists(7, 1); },
      [&] { gl.Flush(); },
      [&] { gl.Finish(); }};
  for (std::size_t n = 0; n < forbidden.size(); ++n) {
    SCOPED_TRACE(n);
    gl.Begin(GL_POINTS);
    gl.EvalCoord1f(0);
    forbidden[n]();
    EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_INVALID_OPERATION});
    gl.Vertex3f(1, 2, 3);
    gl.End();
    expect_error(gl, GL_INVALID_OPERATION);
    const auto primitives = gl.take_primitives();  // undisturbed (EV-BE-IGNORED)
    ASSERT_EQ(primitives.size(), 1u);
    EXPECT_EQ(primitives[0].mode, static_cast<GLenum>(GL_POINTS));
    EXPECT_EQ(primitives[0].vertices.size(), 2u);
    EXPECT_EQ(queryable_state(gl), before);
    EXPECT_EQ(get(gl, GL_LIST_BASE), std::vector<GLdouble>{0});
    EXPECT_EQ(get(gl, GL_ATTRIB_STACK_DEPTH), std::vector<GLdouble>{1});
    EXPECT_EQ(gl.IsList(7), GL_TRUE);
    EXPECT_EQ(gl.IsList(1), GL_FALSE);
    EXPECT_EQ(f[0], 7);
    EXPECT_EQ(d[0], 7);
    EXPECT_EQ(i[0], 7);
    EXPECT_EQ(b[0], 7);
  }
}

TEST(Errors, KeepTheFirstUntilItIsRead) {
  Specification gl;
  gl.End();          // INVALID_OPERATION
  gl.Enable(0);      // INVALID_ENUM
  gl.Begin(0xFFFF);  // INVALID_ENUM
  expect_error(gl, GL_INVALID_OPERATION);
  gl.Begin(GL_POLYGON + 1);
  expect_error(gl, GL_INVALID_ENUM);
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{});  // GetError itself raised none
}

TEST(Queries, OfMapsConvert) {  // EV-GETMAP-ROUND, -SATURATE, -FLOAT, -DOUBLE, C-GETMAPIV-NORM, EV-API-FD
  Specification gl;
  const GLdouble points[] = {1.4, -1.6, 1e20, -1e300};
  gl.Map1d(GL_MAP1_COLOR_4, 1.0 / 3, 2.51, 4, 1, points);
  GLint i[4];
  gl.GetMapiv(GL_MAP1_COLOR_4, GL_COEFF, i);
  EXPECT_EQ(i[0], 1);
  EXPECT_EQ(i[1], -2);
  EXPECT_EQ(i[2], 2147483647);
  EXPECT_EQ(i[3], -2147483647 - 1);
  gl.GetMapiv(GL_MAP1_COLOR_4, GL_DOMAIN, i);
  EXPECT_EQ(i[0], 0);
  EXPECT_EQ(i[1], 3);
  GLfloat f[4];
  gl.GetMapfv(GL_MAP1_COLOR_4, GL_COEFF, f);
  EXPECT_EQ(f[0], 1.4f);
  EXPECT_EQ(f[2], 1e20f);
  EXPECT_EQ(f[3], -std::numeric_limits<float>::max());  // the nearest representable
  EXPECT_EQ(get_map(gl, GL_MAP1_COLOR_4, GL_COEFF), (std::vector<GLdouble>{1.4, -1.6, 1e20, -1e300}));
  EXPECT_EQ(get_map(gl, GL_MAP1_COLOR_4, GL_DOMAIN), (std::vector<GLdouble>{1.0 / 3, 2.51}));
}

// --- What the documents permit

std::vector<double> permitted(const Specification& gl, std::size_t value) {
  return gl.permitted_answer().at(value).answers;
}

TEST(PermittedAnswers, OfMapsRoundHalvesUpOrDown) {  // EV-GETMAP-ROUND
  Specification gl;
  const GLfloat points[] = {0.5f, 1.5f, -2.5f, 3.25f};
  gl.Map1f(GL_MAP1_TEXTURE_COORD_4, 0, 1, 4, 1, points);
  GLint i[4];
  gl.GetMapiv(GL_MAP1_TEXTURE_COORD_4, GL_COEFF, i);
  ASSERT_EQ(gl.permitted_answer().size(), 4u);
  EXPECT_EQ(permitted(gl, 0), (std::vector<double>{0, 1}));
  EXPECT_EQ(permitted(gl, 1), (std::vector<double>{2, 1}));
  EXPECT_EQ(permitted(gl, 2), (std::vector<double>{-2, -3}));
  EXPECT_EQ(permitted(gl, 3), std::vector<double>{3});
  EXPECT_EQ(gl.permitted_answer()[3].state, 3.25);
  EXPECT_EQ(i[1], 2) << "the first permitted answer";
  // The numbers next to 1/2 are no halves, although x + 1/2 is rounded to 1 in double precision.
  const GLdouble near_halves[] = {0.5 - 0x1p-54, -0.5 + 0x1p-54, 0.5 + 0x1p-53, 0x1p31};
  gl.Map1d(GL_MAP1_TEXTURE_COORD_4, 0, 1, 4, 1, near_halves);
  gl.GetMapiv(GL_MAP1_TEXTURE_COORD_4, GL_COEFF, i);
  EXPECT_EQ(permitted(gl, 0), std::vector<double>{0});
  EXPECT_EQ(permitted(gl, 1), std::vector<double>{0});
  EXPECT_EQ(permitted(gl, 2), std::vector<double>{1});
  EXPECT_EQ(permitted(gl, 3), std::vector<double>{2147483647});
}

TEST(PermittedAnswers, OfColorsAndNormalsAreRoundedOrNormalized) {  // C-GETMAPIV-NORM
  Specification gl;
  const GLfloat points[] = {0.5f, 1, -2};
  gl.Map1f(GL_MAP1_NORMAL, 0, 1, 3, 1, points);
  GLint i[3];
  gl.GetMapiv(GL_MAP1_NORMAL, GL_COEFF, i);
  EXPECT_EQ(permitted(gl, 0), (std::vector<double>{0, 1, 1073741823, 1073741824})) << "by both rules";
  EXPECT_EQ(permitted(gl, 1), (std::vector<double>{1, 2147483647}));
  EXPECT_FALSE(gl.permitted_answer()[1].is_advisory);
  EXPECT_TRUE(gl.permitted_answer()[2].is_advisory) << "must not be judged";
  gl.GetMapiv(GL_MAP1_NORMAL, GL_DOMAIN, i);
  EXPECT_EQ(permitted(gl, 1), std::vector<double>{1});
  EXPECT_FALSE(gl.permitted_answer()[1].is_advisory);
  gl.GetIntegerv(GL_CURRENT_NORMAL, i);  // (0, 0, 1), always normalized
  EXPECT_EQ(permitted(gl, 2), std::vector<double>{2147483647});
}

TEST(PermittedAnswers, OfInitialDomainsAreAdvice) {  // EV-INIT-DOMAIN
  Specification gl;
  GLfloat f[4];
  gl.GetMapfv(GL_MAP1_INDEX, GL_DOMAIN, f);
  EXPECT_TRUE(gl.permitted_answer().at(0).is_advisory);
  gl.GetMapfv(GL_MAP1_INDEX, GL_COEFF, f);
  EXPECT_FALSE(gl.permitted_answer().at(0).is_advisory);
  gl.Map1f(GL_MAP1_INDEX, 0, 1, 1, 1, f);
  gl.GetMapfv(GL_MAP1_INDEX, GL_DOMAIN, f);
  EXPECT_FALSE(gl.permitted_answer().at(0).is_advisory);
}

TEST(PermittedAnswers, OfLimitsAreLeastValues) {  // EV-GET-MAXORDER
  Specification gl({.max_eval_order = 8, .texture_units = 2});
  GLint limit = 0;
  for (const GLenum name : {GL_MAX_EVAL_ORDER, GL_MAX_TEXTURE_UNITS, GL_MAX_LIST_NESTING}) {
    gl.GetIntegerv(name, &limit);
    EXPECT_TRUE(gl.permitted_answer().at(0).is_least) << name;
  }
  GLboolean flag = GL_FALSE;
  gl.GetBooleanv(GL_MAX_EVAL_ORDER, &flag);
  EXPECT_FALSE(gl.permitted_answer().at(0).is_least);
  gl.ActiveTexture(GL_TEXTURE1);
  expect_error(gl, GL_NO_ERROR);
  gl.ActiveTexture(GL_TEXTURE2);
  expect_error(gl, GL_INVALID_ENUM);
  Specification with_images({.texture_units = 1, .active_units = 4});
  with_images.ActiveTexture(GL_TEXTURE3);
  expect_error(with_images, GL_NO_ERROR);
  with_images.ActiveTexture(GL_TEXTURE4);
  expect_error(with_images, GL_INVALID_ENUM);
  with_images.MultiTexCoord1f(GL_TEXTURE1, 0);
  expect_error(with_images, GL_INVALID_ENUM);
}

TEST(PermittedAnswers, BelongToTheLastCommand) {
  Specification gl;
  GLint order = 0;
  gl.GetMapiv(GL_MAP1_INDEX, GL_ORDER, &order);
  EXPECT_EQ(gl.permitted_answer().size(), 1u);
  gl.GetMapiv(0, GL_ORDER, &order);  // rejected
  EXPECT_TRUE(gl.permitted_answer().empty());
  EXPECT_TRUE(gl.has_state(GL_AUTO_NORMAL));
  EXPECT_FALSE(gl.has_state(GL_LIGHTING));
}

TEST(Queries, OfSingleValuesConvert) {
  Specification gl;
  gl.Color4f(1, -1, 0, 0.5f);
  gl.Normal3f(0, 2, -2);
  gl.TexCoord4f(1.4f, -1.6f, 1e20f, 0);
  gl.Indexf(2.51f);
  GLint i[4];
  // Colours and normals are mapped linearly to the whole range (GL 2.1 table 2.9).
  gl.GetIntegerv(GL_CURRENT_COLOR, i);
  EXPECT_EQ(i[0], 2147483647);
  EXPECT_EQ(i[1], -2147483647 - 1);
  EXPECT_EQ(i[2], 0);
  EXPECT_EQ(i[3], 1073741823);  // 1073741823.25
  gl.GetIntegerv(GL_CURRENT_NORMAL, i);
  EXPECT_EQ(i[1], 2147483647);
  EXPECT_EQ(i[2], -2147483647 - 1);
  gl.GetIntegerv(GL_CURRENT_TEXTURE_COORDS, i);
  EXPECT_EQ(i[0], 1);
  EXPECT_EQ(i[1], -2);
  EXPECT_EQ(i[2], 2147483647);
  EXPECT_EQ(i[3], 0);
  gl.GetIntegerv(GL_CURRENT_INDEX, i);
  EXPECT_EQ(i[0], 3);
  GLboolean b[4];
  gl.GetBooleanv(GL_CURRENT_COLOR, b);
  EXPECT_EQ(b[0], GL_TRUE);
  EXPECT_EQ(b[2], GL_FALSE);
  EXPECT_EQ(b[3], GL_TRUE);
  gl.GetBooleanv(GL_MAX_EVAL_ORDER, b);
  EXPECT_EQ(b[0], GL_TRUE);
  GLfloat f[4];
  gl.GetFloatv(GL_MAP2_GRID_SEGMENTS, f);
  EXPECT_EQ(f[1], 1);
  // NaN and infinity are accepted.
  gl.Color4d(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300, 0);
  gl.GetIntegerv(GL_CURRENT_COLOR, i);
  EXPECT_EQ(i[0], 0);
  EXPECT_EQ(i[1], 2147483647);
  EXPECT_EQ(i[2], -2147483647 - 1);
  expect_error(gl, GL_NO_ERROR);
}

TEST(Queries, OfUnknownNamesAreErrors) {
  Specification gl;
  GLint i = 7;
  for (const GLenum pname : {0u, 0x0D8Fu, 0x0D99u, static_cast<GLenum>(GL_COEFF), 0xFFFFFFFFu}) {
    gl.GetIntegerv(pname, &i);
    expect_error(gl, GL_INVALID_ENUM);
  }
  EXPECT_EQ(i, 7);
  EXPECT_EQ(gl.GetString(0), nullptr);
  expect_error(gl, GL_INVALID_ENUM);
  for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_EXTENSIONS}) {
    EXPECT_NE(gl.GetString(name), nullptr);
  }
  EXPECT_EQ(std::strncmp(reinterpret_cast<const char*>(gl.GetString(GL_VERSION)), "2.1 ", 4), 0);
  expect_error(gl, GL_NO_ERROR);
}

TEST(Queries, WithNullPointersDoNothing) {  // U-NULL
  Specification gl;
  gl.GetIntegerv(GL_MAX_EVAL_ORDER, nullptr);
  gl.GetMapdv(GL_MAP1_INDEX, GL_COEFF, nullptr);
  expect_error(gl, GL_NO_ERROR);
}

TEST(Contexts, AreSeparateAndCopiesToo) {  // EV-CTX-PRIVATE
  Specification a;
  define_line(a, GL_MAP1_INDEX, 5);
  a.Enable(GL_MAP1_INDEX);
  Specification fresh, copy = a;
  EXPECT_EQ(get_map(fresh, GL_MAP1_INDEX, GL_ORDER), std::vector<GLdouble>{1});
  EXPECT_EQ(fresh.IsEnabled(GL_MAP1_INDEX), GL_FALSE);
  define_line(a, GL_MAP1_INDEX, 50);
  EXPECT_EQ(get_map(copy, GL_MAP1_INDEX, GL_COEFF), (std::vector<GLdouble>{5, 15}));
  EXPECT_EQ(copy.IsEnabled(GL_MAP1_INDEX), GL_TRUE);
}

}  // namespace
}  // namespace evalcts::reference
