// Section 22 of the requirements, transform feedback: evaluated primitives are recorded, also if
// rasterization is disabled.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <evalcts/testkit/registration.h>

#include "drawings.h"
#include "programs.h"

namespace evalcts::suite_recorded_primitives {
namespace {

constexpr std::size_t kFloats = 12;  // floats of a vertex: position, colour, texture coordinates
constexpr std::size_t kRoom = 128;   // capacity of the buffer in vertices
constexpr double kNear = 1e-4;

using RecordedVertex = std::array<double, kFloats>;

// The recording of a drawing as separate points, lines or triangles.
struct Recording {
  std::string name;
  gl::Ref written, data, error, read;
  std::size_t size;  // vertices of a primitive
  std::vector<RecordedVertex> vertices = {};
};

struct Recordings {
  CheckedTrace checked;
  std::vector<Recording> all;
};

std::size_t size_of(GLenum primitive) {
  return primitive == GL_POINTS ? 1 : primitive == GL_LINE_STRIP ? 2 : 3;
}
GLenum mode_of(GLenum primitive) {
  return primitive == GL_POINTS ? GL_POINTS : primitive == GL_LINE_STRIP ? GL_LINES : GL_TRIANGLES;
}

Recordings record(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes,
                  const std::vector<Drawing>& drawings) {
  gl::Case c(identity);
  c.Viewport(0, 0, kSide, kSide);
  c.ClearColor(0, 0, 0, 0);
  const Program program = link_program(
      c,
      {{GL_VERTEX_SHADER,
        "varying vec4 position;\nvarying vec4 color;\nvarying vec4 coordinates;\nvoid main() {\n  position = "
        "gl_Vertex;\n  color = gl_Color;\n  coordinates = gl_MultiTexCoord0;\n  gl_FrontColor = "
        "gl_Color;\n  gl_Position = gl_Vertex;\n}\n"}},
      {"position", "color", "coordinates"});
  c.UseProgram(program.name);
  bind_recording_buffer(c, kRoom * kFloats);
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const GLenum primitive = drawings[i % drawings.size()].primitive;
    c.Clear(GL_COLOR_BUFFER_BIT);
    const gl::ResultOf query = make_query(c);
    c.BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query);
    c.BeginTransformFeedback(mode_of(primitive));
    c.append(scenes[i].commands);
    c.EndTransformFeedback();
    c.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    Recording recording = {
        scenes[i].name,
        c.GetQueryObjectuiv(query, GL_QUERY_RESULT, gl::out<GLuint>(1)),
        c.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, kRoom * kFloats * sizeof(GLfloat),
                           gl::out<GLfloat>(kRoom * kFloats)),
        c.GetError(),
        c.ReadPixels(0, 0, kSide, kSide, GL_RED, GL_FLOAT, gl::out<GLfloat>(kSide * kSide)),
        size_of(primitive)};
    recordings.push_back(std::move(recording));
  }
  Recordings all = {t.play(c), std::move(recordings)};
  require_linked(all.checked, program);
  for (Recording& recording : all.all) {
    const std::size_t written = all.checked.trace().values<GLuint>(recording.written)[0] * recording.size;
    const std::vector<GLfloat> values = all.checked.trace().values<GLfloat>(recording.data);
    for (std::size_t i = 0; i < std::min(written, kRoom); ++i)
      std::copy_n(&values[i * kFloats], kFloats, recording.vertices.emplace_back().begin());
  }
  return all;
}

RecordedVertex vertex_of(const reference::Vertex& vertex) {
  RecordedVertex values;
  for (std::size_t k = 0; k < 4; ++k) {
    values[k] = reference::rounded(vertex.position[k]);
    values[4 + k] = reference::rounded(vertex.color[k]);
    values[8 + k] = reference::rounded(vertex.texture_coordinate[0][k]);
  }
  return values;
}

bool alike(const RecordedVertex& a, const RecordedVertex& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= kNear; });
}

// The vertices of a point, a segment, or the corners of a quad in the order of the mesh.
using Corners = std::vector<RecordedVertex>;
std::vector<Corners> primitives_in_order(const Drawing& drawing) {
  std::vector<Corners> all;
  for (const reference::Primitive& primitive : drawing.predicted.primitives) {
    const auto& v = primitive.vertices;
    const auto corner = [&](std::size_t i) { return vertex_of(v[i]); };
    if (drawing.primitive == GL_POINTS) {
      for (std::size_t i = 0; i < v.size(); ++i) all.push_back({corner(i)});
    } else if (drawing.primitive == GL_LINE_STRIP) {
      for (std::size_t i = 0; i + 1 < v.size(); ++i) all.push_back({corner(i), corner(i + 1)});
    } else {
      for (std::size_t i = 0; i + 3 < v.size(); i += 2)
        all.push_back({corner(i), corner(i + 1), corner(i + 3), corner(i + 2)});
    }
  }
  return all;
}

// Returns true if two triangles (six vertices) split the quad along one of its diagonals with its
// orientation.
bool are_quad(std::span<const RecordedVertex> triangles, const Corners& quad) {
  std::array<std::size_t, 2> left_out{};
  for (std::size_t triangle = 0; triangle < 2; ++triangle) {
    std::array<std::size_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = std::ranges::find_if(
          quad, [&](const RecordedVertex& corner) { return alike(corner, triangles[3 * triangle + k]); });
      if (found == quad.end()) return false;
      corners[k] = static_cast<std::size_t>(found - quad.begin());
    }
    // The three steps go round the quad once: two steps to the next corner and one to the opposite corner.
    std::size_t way = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t step = (corners[(k + 1) % 3] + 4 - corners[k]) % 4;
      if (step == 0 || step == 3) return false;
      way += step;
    }
    if (way != 4) return false;
    left_out[triangle] = 6 - corners[0] - corners[1] - corners[2];
  }
  return left_out[0] == (left_out[1] + 2) % 4;
}

// Returns the index of the first wrong primitive, or the number of primitives that were recorded or expected,
// whichever is less, if all of these are right. The primitives of EvalMesh2 may come in any order and its
// lines in either direction, which other tests judge.
std::size_t first_wrong(const Recording& recording, const Drawing& drawing) {
  std::vector<Corners> left = primitives_in_order(drawing);
  const bool any_order = drawing.two && drawing.predicted.has_meshes();
  const bool quads = drawing.primitive == GL_QUAD_STRIP;
  const std::size_t each = quads ? 6 : recording.size;
  const auto& v = recording.vertices;
  std::size_t i = 0;
  for (; !left.empty() && (i + 1) * each <= v.size(); ++i) {
    const std::span<const RecordedVertex> seen(&v[i * each], each);
    const auto last = any_order ? left.end() : left.begin() + 1;
    const auto found = std::find_if(left.begin(), last, [&](const Corners& expected) {
      if (quads) return are_quad(seen, expected);
      return std::ranges::equal(seen, expected, alike) ||
             (any_order && std::equal(seen.begin(), seen.end(), expected.rbegin(), expected.rend(), alike));
    });
    if (found == last) return i;
    left.erase(found);
  }
  return i;
}

bool is_right(const Recording& recording, const Drawing& drawing) {
  const std::size_t count = primitives_in_order(drawing).size();
  const std::size_t each = drawing.primitive == GL_QUAD_STRIP ? 6 : recording.size;
  return first_wrong(recording, drawing) == count && recording.vertices.size() == count * each;
}

void expect_recorded(Recordings& recordings, const std::vector<Drawing>& drawings) {
  for (std::size_t i = 0; i < recordings.all.size(); ++i) {
    const Recording& seen = recordings.all[i];
    const Drawing& drawing = drawings[i % drawings.size()];
    const std::size_t expected = primitives_in_order(drawing).size(), where = first_wrong(seen, drawing);
    recordings.checked.expect(
        is_right(seen, drawing), where < expected ? seen.data : seen.written,
        where < expected ? fmt::format("{}: primitive {} of {} is not recorded as the mesh has it", seen.name,
                                       where, expected)
                         : fmt::format("{}: {} vertices are recorded of {} primitives", seen.name,
                                       seen.vertices.size(), expected),
        fmt::format("{} primitives in mesh order", expected),
        fmt::format("{} vertices, wrong from primitive {} on", seen.vertices.size(), where));
  }
}

void require_recorded(const Recordings& control, const std::vector<Drawing>& drawings) {
  for (std::size_t i = 0; i < control.all.size(); ++i)
    if (!is_right(control.all[i], drawings[i % drawings.size()]) ||
        control.checked.trace().error(control.all[i].error) != GL_NO_ERROR)
      throw NotObservable("pipeline: explicit vertices are not recorded as they come");
}

EVALCTS_TEST(Pipeline, TransformFeedback, kMust, "EV-PIPE-XFB")
(Test& t) {
  t.require(3, 0);
  const std::vector<Drawing> drawings = all_drawings(t);
  require_recorded(record(t, gl::control("explicit vertices"), scenes_of(drawings, false), drawings),
                   drawings);
  Recordings recordings = record(t, "evaluated", scenes_of(drawings, true), drawings);
  for (const Recording& recording : recordings.all) recordings.checked.expect_no_error(recording.error);
  expect_recorded(recordings, drawings);
};

// With RASTERIZER_DISCARD nothing is drawn, and all primitives are recorded.
EVALCTS_TEST(Pipeline, RasterizerDiscard, kMust, "EV-PIPE-DISCARD")
(Test& t) {
  t.require(3, 0);
  const std::vector<Drawing> drawings = all_drawings(t);
  const auto scenes = [&](bool evaluated) {
    gl::Case discarding, drawing;
    discarding.Enable(GL_RASTERIZER_DISCARD);
    drawing.Disable(GL_RASTERIZER_DISCARD);
    std::vector<Scene> all = scenes_of(drawings, evaluated, "discarded", discarding);
    for (Scene& scene : scenes_of(drawings, evaluated, "drawn", drawing)) all.push_back(std::move(scene));
    return all;
  };
  const auto is_discarded = [&](std::size_t i) { return i < drawings.size(); };
  const Recordings control = record(t, gl::control("explicit vertices"), scenes(false), drawings);
  require_recorded(control, drawings);
  for (std::size_t i = 0; i < control.all.size(); ++i)
    if ((count_lit(control.checked, control.all[i].read) == 0) != is_discarded(i))
      throw NotObservable("pipeline: explicit vertices are not discarded, or never drawn");
  Recordings recordings = record(t, "evaluated", scenes(true), drawings);
  for (std::size_t i = 0; i < recordings.all.size(); ++i) {
    const Recording& recording = recordings.all[i];
    const std::size_t lit = count_lit(recordings.checked, recording.read);
    recordings.checked.expect_no_error(recording.error);
    recordings.checked.expect((lit == 0) == is_discarded(i), recording.read,
                              fmt::format("{}: {} pixels are drawn", recording.name, lit),
                              is_discarded(i) ? "no pixel" : "some", std::to_string(lit));
  }
  expect_recorded(recordings, drawings);
};

// RASTERIZER_DISCARD does not change the errors of EvalMesh.
EVALCTS_TEST(Pipeline, ErrorsWithRasterizerDiscard, kMust, "EV-PIPE-DISCARD")
(Test& t) {
  t.require(3, 0);
  gl::Case c("errors with RASTERIZER_DISCARD");
  define_curve(c);
  define_patch(c);
  c.Enable(GL_RASTERIZER_DISCARD);
  c.EvalMesh1(GL_FILL, 0, kColumns);
  c.GetError();
  c.EvalMesh2(GL_LINE_STRIP, 0, kColumns, 0, kRows);
  c.GetError();
  c.Begin(GL_POINTS);
  c.EvalMesh1(GL_POINT, 0, kColumns);
  c.End();
  c.GetError();
  c.Begin(GL_POINTS);
  c.EvalMesh2(GL_FILL, 0, kColumns, 0, kRows);
  c.End();
  c.GetError();
  c.EvalMesh1(GL_LINE, 0, kColumns);
  c.EvalMesh2(GL_FILL, 0, kColumns, 0, kRows);
  c.GetError();
  t.judge_answers(c);
};

}  // namespace
}  // namespace evalcts::suite_recorded_primitives
