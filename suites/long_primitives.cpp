// Connected primitives and meshes with more vertices than a driver's vertex buffer holds, with maps of all
// attributes. A driver that flushes a full buffer in the middle of a primitive has to repeat vertices with
// all of their attributes, and to keep the current values.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "grid_cases.h"
#include "maps.h"

namespace evalcts::suite_long_primitives {
namespace {

// A connected primitive, and its number of vertices at full depth.
struct Connected {
  const char* name;
  GLenum mode;
  int full;

  // Quick depth exceeds a buffer of 64 KiB, thorough depth exceeds 16-bit indices.
  int vertices(const Test& t) const { return t.by_depth(2500, full, 66000); }
};
constexpr Connected kConnected[] = {
    {"LINE_LOOP", GL_LINE_LOOP, 10000},           {"LINE_STRIP", GL_LINE_STRIP, 40000},
    {"TRIANGLE_STRIP", GL_TRIANGLE_STRIP, 40000}, {"TRIANGLE_FAN", GL_TRIANGLE_FAN, 10000},
    {"QUAD_STRIP", GL_QUAD_STRIP, 10000},         {"POLYGON", GL_POLYGON, 10000}};

// Returns the argument of vertex i. Arguments are points of a grid with less than 2^16 segments, and have few
// significant bits, which keeps exact arithmetic fast.
float argument_of(int i) { return static_cast<float>(i % 40000) * 0x1p-16f; }

// Deliveries without arrays of arguments, because each array has memory pages of its own, and there would be
// more than a process may map.
std::vector<gl::Delivery> primitive_deliveries() {
  return sparing(gl::without(gl::kMeshes | gl::kArrays, gl::curve_deliveries()));
}

EVALCTS_TEST(LongPrimitives, AttributesOfMaps, kMust, "EV-COORD-PRIMS/1-D", "EV-COORD-ASIF/1-D",
             combine(kConnected).by(primitive_deliveries()))
(Test& t, const Connected& primitive) {
  gl::Case c =
      with_current_values(fmt::format("{} vertices, all attributes from maps", primitive.vertices(t)));
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    define_and_enable(c, random_map(t, target, 2));
  c.Begin(primitive.mode);
  for (int i = 0; i < primitive.vertices(t); ++i) c.EvalCoord1f(argument_of(i));
  c.End();
  t.judge_vertices(c, kUnit0);
};

// Buffers may become full after explicit or evaluated vertices, and before or after changes of the current
// values.
EVALCTS_TEST(LongPrimitives, MixedWithVertex, kMust, "EV-COORD-MIX/1-D", "EV-COORD-CURRENT/1-D",
             "EV-CUR-NEXTVERTEX/1-D", combine(kConnected).by(primitive_deliveries()))
(Test& t, const Connected& primitive) {
  t.prefer_fresh_contexts();  // vertex buffers are filled differently in a used context
  const int vertices =
      t.by_depth(10000, primitive.full, 66000);  // fills the 512 KiB of Mesa at quick depth, too
  gl::Case c(fmt::format("{} vertices, every third explicit, colours and normals from maps", vertices));
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL})
    define_and_enable(c, random_map(t, target, 2));
  c.Begin(primitive.mode);
  set_current_values(c);  // after Begin, so that the layout of vertices stays the same
  for (int i = 0; i < vertices; ++i) {
    const float x = argument_of(i);
    if (i % 7 == 3) c.TexCoord4f(x, 1 - x, 2, 0.5f);
    if (i % 97 == 50) c.Color4f(1 - x, x, 0.5f, 0.25f);
    if (i % 101 == 60) c.Normal3f(x, -x, 1);
    i % 3 == 1 ? c.Vertex3f(x, 1 - x, 0.5f) : c.EvalCoord1f(x);
  }
  c.End();
  t.judge_vertices(c, kUnit0);
};

// A mesh over the whole grid, at quick depth over a shorter one. If v has 0 segments, the mesh has one row of
// a grid with one segment in v.
struct LongMesh {
  const char* name;
  bool two;
  GLenum mode;
  Grid u, v, quick_u, quick_v;
};
constexpr Grid kOne = {1, 0, 1}, kRow = {0, 0, 1}, kTenThousand = {10000, 0, 10000 * 0x1p-14f},
               kShort = {1000, 0, 1000 * 0x1p-10f}, kLong = {40000, 0, 40000 * 0x1p-16f},
               kHalf = {20000, 0, 20000 * 0x1p-15f}, kMany = {3000, 0, 3000 * 0x1p-12f}, kSide = {64, 0, 1},
               kShortSide = {32, 0, 1};
constexpr LongMesh kMeshes1[] = {{"POINT", false, GL_POINT, kLong, kOne, kShort, kOne},
                                 {"LINE", false, GL_LINE, kLong, kOne, kShort, kOne}};
constexpr LongMesh kMeshes2[] = {{"POINT", true, GL_POINT, kSide, kSide, kShortSide, kShortSide},
                                 {"LINE", true, GL_LINE, kTenThousand, kRow, kShort, kRow},
                                 {"LINE_ALONG_V", true, GL_LINE, kOne, kMany, kOne, kShort},
                                 {"LINE_SQUARE", true, GL_LINE, kSide, kSide, kShortSide, kShortSide},
                                 {"FILL", true, GL_FILL, kHalf, kOne, kShort, kOne},
                                 {"FILL_ALONG_V", true, GL_FILL, kOne, kMany, kOne, kShort},
                                 {"FILL_SQUARE", true, GL_FILL, kSide, kSide, kShortSide, kShortSide}};

void expect_mesh(Test& t, const LongMesh& mesh) {
  const bool is_quick = t.depth() == Depth::kQuick;
  const Grid &u = is_quick ? mesh.quick_u : mesh.u, &v = is_quick ? mesh.quick_v : mesh.v;
  gl::Case c =
      with_current_values(fmt::format("{} by {} steps, all attributes from maps", u.segments, v.segments));
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_2})
    define_and_enable(c, random_map(t, target_in(mesh.two, target), {2, 2}));
  map_grid(c, mesh.two, u, v.segments == 0 ? kOne : v);
  eval_mesh(c, mesh.two, mesh.mode, 0, u.segments, 0, v.segments);
  t.judge_vertices(c, kUnit0);
}

EVALCTS_TEST(LongPrimitives, Mesh1, kMust, "EV-MESH1-POINT", "EV-MESH1-LINE",
             combine(kMeshes1).by(sparing(gl::list_deliveries())))
(Test& t, const LongMesh& mesh) { expect_mesh(t, mesh); };

EVALCTS_TEST(LongPrimitives, Mesh2, kMust, "EV-MESH2-POINT", "EV-MESH2-LINE", "EV-MESH2-FILL",
             combine(kMeshes2).by(sparing(gl::list_deliveries())))
(Test& t, const LongMesh& mesh) { expect_mesh(t, mesh); };

}  // namespace
}  // namespace evalcts::suite_long_primitives
