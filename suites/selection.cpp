// Section 22 of the requirements, selection mode: the hits of evaluated primitives and their depths.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <evalcts/testkit/registration.h>

#include "drawings.h"

namespace evalcts::suite_selection {
namespace {

constexpr std::size_t kRoom = 512;

// Largest difference of depths, which are in [0,1]: much more than the accuracy rule allows to positions.
constexpr double kDepthTolerance = 1e-3;

struct Hit {
  std::vector<GLuint> names;
  double nearest, farthest;  // 0 to 1
};

// The hits in the selection buffer, and the command that returned their number.
struct Selection {
  CheckedTrace checked;
  gl::Ref count;
  std::vector<Hit> hits;

  const Hit* hit_of(GLuint name) const {
    const auto found =
        std::ranges::find_if(hits, [&](const Hit& hit) { return hit.names == std::vector<GLuint>{name}; });
    return found == hits.end() ? nullptr : &*found;
  }
  std::vector<GLuint> names() const {
    std::vector<GLuint> all;
    for (const Hit& hit : hits) all.insert(all.end(), hit.names.begin(), hit.names.end());
    return all;
  }
};

// Draws the scenes in selection mode; scene i has the name i + 1. Throws NotObservable if the buffer
// overflows.
Selection select(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes) {
  gl::Case c(identity);
  const gl::Ref buffer = c.SelectBuffer(kRoom, gl::out<GLuint>(kRoom));
  c.RenderMode(GL_SELECT);
  c.InitNames();
  c.PushName(0);
  GLuint name = 0;
  for (const Scene& scene : scenes) {
    c.LoadName(++name);
    c.append(scene.commands);
  }
  const gl::Ref count = c.RenderMode(GL_RENDER);
  Selection selection = {t.play(c), count, {}};
  const std::int64_t hits = selection.checked.trace().result(count);
  if (hits < 0) throw NotObservable("pipeline: the selection buffer overflows");
  const std::vector<GLuint> values = selection.checked.trace().values<GLuint>(buffer);
  std::size_t next = 0;
  for (std::int64_t i = 0; i < hits; ++i) {
    if (next + 3 > kRoom || next + 3 + values[next] > kRoom)
      throw NotObservable("pipeline: the selection buffer ends within a record");
    constexpr double kMost = 4294967295.0;
    Hit hit = {{}, values[next + 1] / kMost, values[next + 2] / kMost};
    hit.names.assign(&values[next + 3], &values[next + 3] + values[next]);
    next += 3 + values[next];
    selection.hits.push_back(std::move(hit));
  }
  return selection;
}

std::string in_words(const Hit* hit) {
  return hit ? fmt::format("depth {:.6f} to {:.6f}", hit->nearest, hit->farthest) : "no hit";
}

bool alike(const Hit* a, const Hit* b) {
  if (!a || !b) return !a && !b;
  return std::abs(a->nearest - b->nearest) <= kDepthTolerance &&
         std::abs(a->farthest - b->farthest) <= kDepthTolerance;
}

void expect_hits_like_explicit(Selection& selection, const Selection& control,
                               const std::vector<Scene>& scenes) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto name = static_cast<GLuint>(i + 1);
    const Hit* seen = selection.hit_of(name);
    const Hit* expected = control.hit_of(name);
    selection.checked.expect(
        alike(seen, expected), selection.count,
        fmt::format("{}: {}, explicit vertices: {}", scenes[i].name, in_words(seen), in_words(expected)),
        in_words(expected), in_words(seen));
  }
}

gl::Case moved(float x, float z, float z_scale) {
  gl::Case state;
  state.LoadMatrixf(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, z_scale, 0, x, 0, z, 1});
  return state;
}

// Each mesh and each primitive hits at two depths, and does not hit outside the clip volume.
EVALCTS_TEST(Selection, Hits, kMust, "EV-SEL-HIT")
(Test& t) {
  const std::vector<Drawing> drawings = all_drawings(t);
  struct Place {
    const char* name;
    float x, z;
  };
  constexpr float kDepth = 0.25f;
  constexpr Place kPlaces[] = {{"near", 0, -0.5f}, {"far", 0, 0.5f}, {"outside", 3, 0}};
  std::vector<Scene> evaluated, vertices;
  for (const Place& place : kPlaces) {
    const gl::Case state = moved(place.x, place.z, kDepth);
    for (Scene& scene : scenes_of(drawings, true, place.name, state)) evaluated.push_back(std::move(scene));
    for (Scene& scene : scenes_of(drawings, false, place.name, state)) vertices.push_back(std::move(scene));
  }
  const Selection control = select(t, gl::control("explicit vertices"), vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Place& place = kPlaces[i / drawings.size()];
    double low = 1, high = 0;
    for (const reference::Primitive& primitive : drawings[i % drawings.size()].predicted.primitives)
      for (const reference::Vertex& vertex : primitive.vertices) {
        const double depth = 0.5 + 0.5 * (place.z + kDepth * reference::rounded(vertex.position[2]));
        low = std::min(low, depth);
        high = std::max(high, depth);
      }
    const Hit right = {{}, low, high};
    if (!alike(control.hit_of(static_cast<GLuint>(i + 1)), place.x > 0 ? nullptr : &right))
      throw NotObservable("pipeline: explicit vertices hit otherwise or at other depths");
  }
  Selection selection = select(t, "evaluated", evaluated);
  expect_hits_like_explicit(selection, control, evaluated);
};

EVALCTS_TEST(Selection, CulledMesh, kMust, "EV-SEL-CULLED")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_QUAD_STRIP);
  std::vector<Scene> evaluated, vertices;
  std::vector<bool> culled;
  for (const GLenum front : {GL_CCW, GL_CW})
    for (const GLenum face : {GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}) {
      gl::Case state;
      state.Enable(GL_CULL_FACE);
      state.FrontFace(front);
      state.CullFace(face);
      const std::string name = fmt::format("front faces {}, culled {}", front == GL_CCW ? "CCW" : "CW",
                                           face == GL_FRONT  ? "FRONT"
                                           : face == GL_BACK ? "BACK"
                                                             : "FRONT_AND_BACK");
      evaluated.push_back(scenes_of(drawings, true, name, state)[0]);
      vertices.push_back(scenes_of(drawings, false, name, state)[0]);
      // The quads are clockwise.
      culled.push_back(face == GL_FRONT_AND_BACK || (front == GL_CW) == (face == GL_FRONT));
    }
  const Selection control = select(t, gl::control("explicit quad strips"), vertices);
  for (std::size_t i = 0; i < culled.size(); ++i)
    if ((control.hit_of(static_cast<GLuint>(i + 1)) == nullptr) != culled[i])
      throw NotObservable("pipeline: explicit quad strips are culled otherwise");
  Selection selection = select(t, "evaluated", evaluated);
  expect_hits_like_explicit(selection, control, evaluated);
};

// Meshes that draw nothing do not hit. The last mesh hits, as a control.
EVALCTS_TEST(Selection, EmptyMesh, kMust, "EV-SEL-EMPTY")
(Test& t) {
  std::vector<Scene> scenes;
  for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
    const char* mode_name = mode == GL_POINT ? "POINT" : mode == GL_LINE ? "LINE" : "FILL";
    const auto add = [&](const char* name, const auto& draw) {
      gl::Case c;
      define_curve(c);
      define_patch(c);
      draw(c);
      scenes.emplace_back(fmt::format("{}, {}", mode_name, name), std::move(c));
    };
    if (mode != GL_FILL) {
      add("EvalMesh1 without a vertex map", [&](gl::Case& c) {
        c.Disable(GL_MAP1_VERTEX_3);
        c.EvalMesh1(mode, 0, kColumns);
      });
      add("EvalMesh1 of an empty range", [&](gl::Case& c) { c.EvalMesh1(mode, 3, 2); });
    }
    add("EvalMesh2 without a vertex map", [&](gl::Case& c) {
      c.Disable(GL_MAP2_VERTEX_3);
      c.EvalMesh2(mode, 0, kColumns, 0, kRows);
    });
    add("EvalMesh2 of an empty range of i", [&](gl::Case& c) { c.EvalMesh2(mode, 3, 2, 0, kRows); });
    add("EvalMesh2 of an empty range of j", [&](gl::Case& c) { c.EvalMesh2(mode, 0, kColumns, 1, 0); });
    add("EvalMesh2 of two empty ranges", [&](gl::Case& c) { c.EvalMesh2(mode, 1, 0, 1, 0); });
  }
  const auto empty = static_cast<GLuint>(scenes.size());
  const Drawing drawn = meshes(t, GL_LINE_STRIP)[0];
  const Selection control = select(t, gl::control("explicit vertices"),
                                   {Scene("nothing", gl::Case()), Scene("a line", drawn.vertices)});
  if (control.names() != std::vector<GLuint>{2})
    throw NotObservable("pipeline: explicit vertices do not hit, or nothing does");
  scenes.emplace_back(drawn.name, drawn.evaluated);
  Selection selection = select(t, "evaluated", scenes);
  for (GLuint name = 1; name <= empty; ++name)
    selection.checked.expect(!selection.hit_of(name), selection.count,
                             fmt::format("{}: hits, though it draws nothing", scenes[name - 1].name),
                             "no hit", in_words(selection.hit_of(name)));
  const std::vector<GLuint> expected = {empty + 1};
  if (selection.hits.size() < 2)
    selection.checked.expect(
        selection.names() == expected, selection.count,
        fmt::format("the mesh after them does not hit: the names are {}", selection.names()),
        fmt::format("{}", expected), fmt::format("{}", selection.names()));
};

}  // namespace
}  // namespace evalcts::suite_selection
