// Sections 15 and 16 of the requirements: the line strips of meshes of LINE are stippled like those of
// explicit vertices.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "drawings.h"

namespace evalcts::suite_mesh_stippling {

namespace {

// Lines run through the centres of pixels. No vertex is near the border of a pixel, and no segment is about a
// whole number of pixels long. The length of a strip is not a multiple of the pattern's, so that a restart of
// the pattern is visible.
constexpr int kSegments = 5;
constexpr double kFirst = 4.5, kStepU = 11.2, kStepV = 10.4;

struct Stipple {
  const char* name;
  int factor;
  GLushort pattern;
};
constexpr Stipple kStipples[] = {{"FACTOR_1", 1, 0x00FF}, {"FACTOR_2", 2, 0x0C37}};

gl::Case state_of(const Stipple& stipple) {
  gl::Case state;
  state.LineStipple(stipple.factor, stipple.pattern);
  state.Enable(GL_LINE_STIPPLE);
  return state;
}

// Two one-dimensional meshes, the second one at another height.
gl::Case stippled_mesh1() {
  gl::Case c;
  map_grid(c, {kSegments, 0, 1});
  c.Enable(GL_MAP1_VERTEX_3);
  for (const double y : {16.5, 40.5}) {
    define(c, make_map1(GL_MAP1_VERTEX_3, {at_pixel(kFirst), at_pixel(y), 0,
                                           at_pixel(kFirst + kSegments * kStepU), at_pixel(y), 0}));
    c.EvalMesh1(GL_LINE, 0, kSegments);
  }
  return c;
}

gl::Case stippled_mesh2() {
  gl::Case c;
  map_grid(c, {kSegments, 0, 1}, {kSegments, 0, 1});
  const double low = at_pixel(kFirst), right = at_pixel(kFirst + kSegments * kStepU),
               top = at_pixel(kFirst + kSegments * kStepV);
  define_and_enable(
      c, make_map2(GL_MAP2_VERTEX_3, 2, 2, {low, low, 0, low, top, 0, right, low, 0, right, top, 0}));
  c.EvalMesh2(GL_LINE, 0, kSegments, 0, kSegments);
  return c;
}

// Returns the strips as separate segments, so that the pattern restarts at each segment.
gl::Case apart(const gl::Case& strips) {
  gl::Case c;
  std::vector<gl::Command> vertices;
  for (const gl::Command& command : strips.commands()) {
    switch (command.entry) {
      case gl::EntryPoint::Begin:
        c.Begin(GL_LINES);
        vertices.clear();
        break;
      case gl::EntryPoint::Vertex4f:
        if (!vertices.empty()) {
          c.add(vertices.back());
          c.add(command);
        }
        vertices.push_back(command);
        break;
      case gl::EntryPoint::End:
        c.End();
        break;
      default:
        break;
    }
  }
  return c;
}

// Returns a value for each segment: true if the stipple restarts there.
std::vector<bool> starts_of(const Part& part) {
  std::vector<bool> starts;
  for (const FeedbackPrimitive& primitive : primitives_of(part))
    starts.push_back(primitive.token == GL_LINE_RESET_TOKEN);
  return starts;
}

void expect_stipple(Test& t, const Stipple& stipple, const gl::Case& evaluated,
                    const std::vector<Area>& areas) {
  const gl::Case state = state_of(stipple);
  const gl::Case strips = without_edge_flags(explicit_commands(t, evaluated));
  const Picture control =
      pixels(t, gl::control("explicit line strips"),
             {{"", {}, strips}, {"", state, apart(strips)}, {"", state, strips}}, areas, GL_RED);
  const std::size_t count = areas.size();
  const auto values = [&](std::size_t scene) {
    std::vector<double> all;
    for (const Part& part : std::span(control.parts).subspan(scene * count, count))
      all.insert(all.end(), part.values.begin(), part.values.end());
    return all;
  };
  for (const std::size_t other : {0u, 1u}) require_an_effect(values(2), values(other));
  // The pixels shortly after the first vertex, which are on no other line, have to be the same in all strips,
  // because the pattern restarts at each strip.
  const std::vector<Part> expected(control.parts.end() - static_cast<std::ptrdiff_t>(count),
                                   control.parts.end());
  for (const Part& part : expected)
    if (!std::equal(part.values.begin() + 5, part.values.begin() + 14, expected[0].values.begin() + 5))
      throw NotObservable("pipeline: the stipple does not restart at each explicit line strip");
  Picture picture = pixels(t, "evaluated", state, evaluated, areas, GL_RED);
  show_pixels(picture, expected);
  for (std::size_t i = 0; i < count; ++i)
    expect_like_explicit(picture.checked, picture.parts[i], expected[i]);
}

// Expects LINE_RESET_TOKEN at the first segments of strips only. A missing one is not a failure
// (U-FEEDBACK-RESET).
void expect_starts(Test& t, const gl::Case& evaluated) {
  const gl::Case state = state_of(kStipples[0]);
  const Picture control = feedback(t, gl::control("explicit line strips"), state,
                                   without_edge_flags(explicit_commands(t, evaluated)));
  const std::vector<bool> expected = starts_of(control.parts[0]);
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (expected[i] != (i % kSegments == 0))
      throw NotObservable("pipeline: explicit line strips have no LINE_RESET_TOKEN at their beginnings only");
  Picture picture = feedback(t, "evaluated", state, evaluated);
  const std::vector<bool> seen = starts_of(picture.parts[0]);
  picture.checked.expect(seen.size() == expected.size(), picture.parts[0].shown,
                         fmt::format("{} segments are drawn, expected {}", seen.size(), expected.size()),
                         fmt::format("{} segments", expected.size()),
                         fmt::format("{} segments", seen.size()));
  for (std::size_t i = 0; i < std::min(seen.size(), expected.size()); ++i)
    picture.checked.expect(!seen[i] || expected[i], picture.parts[0].shown,
                           fmt::format("LINE_RESET_TOKEN at segment {} of a strip", i % kSegments + 1),
                           "LINE_TOKEN", "LINE_RESET_TOKEN");
}

EVALCTS_TEST_PAIR(Mesh1.Stipple, Mesh2.Stipple, kMust, decide("EV-MESH1-STIPPLE", "EV-MESH2-STIPPLE"),
                  combine(kStipples))
(Test& t, bool two, const Stipple& stipple) {
  std::vector<Area> areas;
  if (!two) areas = {{0, 16, kSide, 1}, {0, 40, kSide, 1}};
  for (int i = 0; two && i <= kSegments; ++i) {
    areas.push_back({0, static_cast<int>(kFirst + i * kStepV), kSide, 1});
    areas.push_back({static_cast<int>(kFirst + i * kStepU), 0, 1, kSide});
  }
  expect_stipple(t, stipple, two ? stippled_mesh2() : stippled_mesh1(), areas);
};

EVALCTS_TEST_PAIR(Mesh1.StippleInFeedback, Mesh2.StippleInFeedback, kMust,
                  decide("EV-MESH1-STIPPLE", "EV-MESH2-STIPPLE"))
(Test& t, bool two) { expect_starts(t, two ? stippled_mesh2() : stippled_mesh1()); };

}  // namespace
}  // namespace evalcts::suite_mesh_stippling
