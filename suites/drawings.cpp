// Makes the curves, patches and meshes of the pipeline tests, and the explicit primitives that replace them.
#include "drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evalcts {
namespace {

double left() { return at_pixel(kLeft + kOff); }
double right() { return at_pixel(kLeft + kOff + kWidth * kColumns); }
double bottom() { return at_pixel(kBottom + kOff); }
double top() { return at_pixel(kBottom + kOff + kHeight * kRows); }

std::vector<double> concatenated(const std::vector<std::array<double, 4>>& values) {
  std::vector<double> all;
  for (const auto& value : values) all.insert(all.end(), value.begin(), value.end());
  return all;
}

// The distinct vertices of the control and, for each of them that was seen, the seen vertex at the same
// place.
struct MatchedVertices {
  std::vector<std::array<double, 12>> of_control, seen;
  std::size_t elsewhere = 0;  // seen vertices at places where the control has none
};

bool same_place(const std::array<double, 12>& a, const std::array<double, 12>& b) {
  constexpr double kPixel = 1;
  return std::hypot(a[0] - b[0], a[1] - b[1]) < kPixel;
}

std::size_t nearest(const std::vector<std::array<double, 12>>& vertices,
                    const std::array<double, 12>& vertex) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (same_place(vertices[i], vertex)) return i;
  return vertices.size();
}

MatchedVertices matched(const Part& seen, const Part& control) {
  MatchedVertices vertices;
  for (const FeedbackPrimitive& primitive : primitives_of(control))
    for (const auto& vertex : primitive.vertices)
      if (nearest(vertices.of_control, vertex) == vertices.of_control.size())
        vertices.of_control.push_back(vertex);
  std::vector<std::array<double, 12>> found(vertices.of_control.size());
  std::vector<bool> is_there(found.size());
  for (const FeedbackPrimitive& primitive : primitives_of(seen))
    for (const auto& vertex : primitive.vertices) {
      const std::size_t place = nearest(vertices.of_control, vertex);
      if (place == found.size()) {
        ++vertices.elsewhere;
        continue;
      }
      // If several vertices were seen at one place, the worst one is kept.
      const auto wrong = [&](const std::array<double, 12>& candidate) {
        double most = 0;
        for (std::size_t k = 0; k < 12; ++k)
          most = std::max(most, std::abs(candidate[k] - vertices.of_control[place][k]));
        return most;
      };
      if (!is_there[place] || wrong(vertex) > wrong(found[place])) found[place] = vertex;
      is_there[place] = true;
    }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (is_there[i]) vertices.seen.push_back(found[i]);
  return vertices;
}

std::vector<double> flat(const std::vector<std::array<double, 12>>& vertices) {
  std::vector<double> values;
  for (const auto& vertex : vertices) values.insert(values.end(), vertex.begin(), vertex.end());
  return values;
}

Part with_plain_lines(Part part) {
  std::ranges::replace(part.values, double{GL_LINE_RESET_TOKEN}, double{GL_LINE_TOKEN});
  return part;
}

// Returns the seen points and lines in the order of the control and lines in its direction, or unchanged if
// they are not at the same places. Other tests judge the order of a mesh (EV-MESH2-POINT, EV-MESH2-LINE).
Part in_order_of(const Part& control, const Part& seen) {
  std::vector<FeedbackPrimitive> left = primitives_of(seen);
  Part ordered{seen.name, seen.shown, {}};
  for (const FeedbackPrimitive& wanted : primitives_of(control)) {
    const auto same_places = [&](const FeedbackPrimitive& candidate) {
      return candidate.token == wanted.token &&
             std::ranges::equal(candidate.vertices, wanted.vertices, same_place);
    };
    auto found = std::ranges::find_if(left, same_places);
    for (auto other = left.begin(); found == left.end() && other != left.end(); ++other) {
      std::ranges::reverse(other->vertices);
      if (same_places(*other)) {
        found = other;
      } else {
        std::ranges::reverse(other->vertices);
      }
    }
    if (found == left.end()) return seen;
    ordered.values.push_back(found->token);
    for (const auto& vertex : found->vertices)
      ordered.values.insert(ordered.values.end(), vertex.begin(), vertex.end());
    left.erase(found);
  }
  return left.empty() ? ordered : seen;
}

}  // namespace

std::array<double, 4> curve_color_at(int i) {
  return {0.1 + 0.8 * i / kColumns, 0.9 - 0.7 * i / kColumns, 0.5, 1};
}

std::array<double, 4> patch_color_at(int i, int j) {
  return {0.1 + 0.9 * i / kColumns, 0.2 + 0.8 * j / kRows, 0.5, 1};
}

void define_curve(gl::Case& c) {
  const double y = at_pixel(kCurveRow + kOff), middle = (left() + right()) / 2;
  define(c, make_map1(GL_MAP1_VERTEX_3, {left(), y, -0.4, middle, y, 0.5, right(), y, 0.2}));
  define(c, make_map1(GL_MAP1_COLOR_4, concatenated({curve_color_at(0), curve_color_at(kColumns)})));
  define(c, make_map1(GL_MAP1_NORMAL, {0.6, 0, 0.8, -0.28, 0.36, 0.8}));
  define(c, make_map1(GL_MAP1_TEXTURE_COORD_4, {0, 1, 0.5, 1, 1, 0.25, -0.5, 2}));
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    c.Enable(target);
  map_grid(c, {kColumns, 0, 1});
}

void define_patch(gl::Case& c) {
  const double heights[3][3] = {{-0.4, 0.1, 0.3}, {0.5, -0.2, 0.4}, {0.0, 0.45, -0.5}};
  std::vector<double> points;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (const double value :
           {left() + (right() - left()) * i / 2, bottom() + (top() - bottom()) * j / 2, heights[i][j]})
        points.push_back(value);
  define(c, make_map2(GL_MAP2_VERTEX_3, 3, 3, points));
  define(c, make_map2(GL_MAP2_COLOR_4, 2, 2,
                      concatenated({patch_color_at(0, 0), patch_color_at(0, kRows),
                                    patch_color_at(kColumns, 0), patch_color_at(kColumns, kRows)})));
  define(c, make_map2(GL_MAP2_NORMAL, 2, 2, {0.6, 0, 0.8, 0, 0.6, 0.8, -0.6, 0, 0.8, 0, -0.28, 0.96}));
  define(c, make_map2(GL_MAP2_TEXTURE_COORD_4, 2, 2,
                      {0, 1, 0.5, 1, 1, 0.25, -0.5, 2, 0.5, 0, 1, 1.5, -1, 0.5, 0.25, 1}));
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4, GL_MAP2_NORMAL, GL_MAP2_TEXTURE_COORD_4})
    c.Enable(target);
  map_grid(c, {kColumns, 0, 1}, {kRows, 0, 1});
}

Drawing drawing(Test& t, std::string name, bool two, GLenum primitive, gl::Case evaluated) {
  Prediction predicted = predict(evaluated, t.max_order());
  gl::Case vertices = without_edge_flags(as_explicit_commands(predicted));
  return {std::move(name), two, primitive, std::move(evaluated), std::move(vertices), std::move(predicted)};
}

std::vector<Drawing> meshes(Test& t, const gl::Case& before) {
  std::vector<Drawing> all;
  for (const bool two : {false, true})
    for (const MeshMode& mode : kMeshModes) {
      if (!two && mode.mode == GL_FILL) continue;
      gl::Case c;
      two ? define_patch(c) : define_curve(c);
      c.append(before);
      eval_mesh(c, two, mode.mode, 0, kColumns, 0, kRows);
      all.push_back(drawing(t, fmt::format("EvalMesh{} of {}", two ? 2 : 1, mode.name), two, mode.primitive,
                            std::move(c)));
    }
  return all;
}

std::vector<Drawing> meshes(Test& t, GLenum primitive) {
  std::vector<Drawing> all = meshes(t);
  std::erase_if(all, [&](const Drawing& drawing) { return drawing.primitive != primitive; });
  return all;
}

std::vector<Drawing> meshes_of(Test& t, const MeshKind& kind) {
  std::vector<Drawing> all = meshes(t);
  std::erase_if(all,
                [&](const Drawing& drawing) { return (drawing.primitive == GL_QUAD_STRIP) != kind.filled; });
  return all;
}

std::vector<Drawing> primitives(Test& t) {
  std::vector<Drawing> all;
  const auto add = [&](const char* name, bool two, GLenum primitive, const auto& evaluate_points) {
    gl::Case c;
    two ? define_patch(c) : define_curve(c);
    c.Begin(primitive);
    evaluate_points(c);
    c.End();
    all.push_back(drawing(t, name, two, primitive, std::move(c)));
  };
  add("a line strip of EvalCoord1", false, GL_LINE_STRIP, [](gl::Case& c) {
    for (const float u : {0.0f, 0.375f, 1.0f}) c.EvalCoord1f(u);
  });
  add("points of EvalPoint1", false, GL_POINTS, [](gl::Case& c) {
    for (int i = 0; i <= kColumns; ++i) c.EvalPoint1(i);
  });
  add("a quad strip of EvalCoord2", true, GL_QUAD_STRIP, [](gl::Case& c) {
    for (const float u : {0.0f, 0.5f, 1.0f})
      for (const float v : {0.25f, 1.0f}) c.EvalCoord2f(u, v);
  });
  add("points of EvalPoint2", true, GL_POINTS, [](gl::Case& c) {
    for (int i = 0; i <= kColumns; ++i) c.EvalPoint2(i, i % (kRows + 1));
  });
  return all;
}

std::vector<Drawing> all_drawings(Test& t) {
  std::vector<Drawing> all = meshes(t);
  for (Drawing& drawing : primitives(t)) all.push_back(std::move(drawing));
  return all;
}

std::vector<Scene> scenes_of(const std::vector<Drawing>& drawings, bool evaluated,
                             const std::string& state_name, const gl::Case& state) {
  std::vector<Scene> scenes;
  for (const Drawing& drawing : drawings)
    scenes.emplace_back(state_name.empty() ? drawing.name : drawing.name + ", " + state_name, state,
                        evaluated ? drawing.evaluated : drawing.vertices);
  return scenes;
}

gl::Case explicit_commands(Test& t, const gl::Case& evaluated) {
  return as_explicit_commands(predict(evaluated, t.max_order()));
}

gl::Case without_edge_flags(const gl::Case& commands) {
  gl::Case c;
  for (const gl::Command& command : commands.commands())
    if (command.entry != gl::EntryPoint::EdgeFlag) c.add(command);
  return c;
}

void expect_mesh_like_explicit(CheckedTrace& checked, const Part& seen, const Part& control) {
  const Part plain = with_plain_lines(control);
  expect_like_explicit(checked, in_order_of(plain, with_plain_lines(seen)), plain);
}

void expect_meshes_like_explicit(Picture& picture, const Picture& control) {
  for (std::size_t i = 0; i < picture.parts.size(); ++i)
    expect_mesh_like_explicit(picture.checked, picture.parts[i], control.parts.at(i));
}

void expect_drawn_like_explicit(CheckedTrace& checked, const Drawing& drawing, const Part& seen,
                                const Part& control) {
  if (drawing.primitive != GL_QUAD_STRIP) {
    if (drawing.predicted.has_meshes()) {
      expect_mesh_like_explicit(checked, seen, control);
    } else {
      expect_like_explicit(checked, with_plain_lines(seen), with_plain_lines(control));
    }
    return;
  }
  const MatchedVertices vertices = matched(seen, control);
  checked.expect(vertices.elsewhere == 0, seen.shown,
                 fmt::format("{} vertices are where no explicit one is ({})", vertices.elsewhere, seen.name),
                 "no other vertices", fmt::format("{} other vertices", vertices.elsewhere));
  expect_like_explicit(checked, {seen.name, seen.shown, flat(vertices.seen)},
                       {control.name, control.shown, flat(vertices.of_control)});
}

void expect_drawn_like_explicit(Picture& picture, const std::vector<Drawing>& drawings,
                                const Picture& control) {
  for (std::size_t i = 0; i < picture.parts.size(); ++i)
    expect_drawn_like_explicit(picture.checked, drawings[i % drawings.size()], picture.parts[i],
                               control.parts.at(i));
}

bool lit(const Part& part) {
  return std::ranges::any_of(part.values, [](double value) { return value > 0.05; });
}

std::size_t count_lit(const CheckedTrace& checked, gl::Ref read) {
  const std::vector<GLfloat> values = checked.trace().values<GLfloat>(read);
  return static_cast<std::size_t>(std::ranges::count_if(values, [](float value) { return value > 0.05f; }));
}

}  // namespace evalcts
