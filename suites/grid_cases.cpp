// Makes the grids and the probe maps whose values show at which argument a grid point is evaluated.
#include "grid_cases.h"

#include <fmt/format.h>

#include <evalcts/gl/hexadecimal.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace evalcts {

gl::Ref map_grid(gl::Case& c, const Grid& u) { return c.MapGrid1f(u.segments, u.first, u.last); }

gl::Ref map_grid(gl::Case& c, const Grid& u, const Grid& v) {
  return c.MapGrid2f(u.segments, u.first, u.last, v.segments, v.first, v.last);
}

gl::Ref map_grid(gl::Case& c, bool two, const Grid& u, const Grid& v) {
  return two ? map_grid(c, u, v) : map_grid(c, u);
}

std::vector<Grid> awkward_grids() {
  return {{1, 0, 1},     {4, -0.5f, 2.5f},  {3, 0.1f, 0.7f},
          {7, 2, -1},    {10, 1e-3f, 2.1f}, {49, 0.3f, 1.0f / 3},
          {93, 1, 1.7f}, {1000, -0.3f, 1},  {65536, 0.1f, 0.2f}};
}

void enable_maps(Test& t, gl::Case& c, bool two) {
  for (const GLenum target : {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4}) {
    const int order = target == GL_MAP1_NORMAL ? 2 : 4;
    define_and_enable(c, over(random_map(t, target_in(two, target), {order, 6 - order}), {-1, 3}, {2, 1}));
  }
}

void map_grid(gl::Case& c, const Along& along, const Grid& grid) {
  const Grid across = {2, 0, 1};
  map_grid(c, along.two, along.v ? across : grid, along.v ? grid : across);
}

std::vector<Grid> probed_grids(Test& t) {
  std::vector<Grid> grids;
  const auto add = [&](const Grid& grid) {
    const float end = std::max(std::abs(grid.first), std::abs(grid.last));
    if (std::abs(grid.last - grid.first) / static_cast<float>(grid.segments) > 4e-5f * std::max(end, 1.0f))
      grids.push_back(grid);
  };
  // Rising and falling grids for which N steps from either end miss the other one, with and without a fused
  // multiply-add.
  for (const Grid& grid :
       {Grid{43, 0x1.99999ap-4f, 0x1.ccccccp-1f}, Grid{3, -0x1.96d10ap+0f, 0x1.60d5a8p-1f},
        Grid{2, 0x1.956204p-6f, -0x1.38192ep-4f}, Grid{53, -0x1.915a96p+1f, 0x1.1fbb18p-1f},
        Grid{18, -0x1.ab04e4p+0f, -0x1.89ef66p-6f}, Grid{39, 0x1.e445ap+1f, -0x1.62c9ap+1f},
        Grid{1, 0x1.58e3dep-4f, -0x1.6da474p-4f}, Grid{1, -0x1.83183ep-4f, 0x1.e0cd8ap-1f}})
    add(grid);
  for (const Grid& grid : awkward_grids()) add(grid);
  for (int segments = 1; segments <= t.by_depth(60, 300, 1000); ++segments) add({segments, 0.1f, 0.7f});
  for (int i = 0; i < t.by_depth(60, 300, 3000); ++i) {
    const std::vector<double> ends = random_values(t.random(), 2);
    add({1 + static_cast<int>(t.random()() % 100), static_cast<float>(3 * ends[0]),
         static_cast<float>(7 * ends[1])});
  }
  // Grids of one segment for which first + (last - first) is not last in single precision.
  for (const auto& [first, last] : {std::pair{33.3f, 0.1f}, {977.7f, -0.3f}, {-811.3f, 2.1f}, {52.7f, 1e-3f}})
    add({1, first, last});
  return grids;
}

namespace {

void define_probe(gl::Case& c, const Along& along, float value) {
  const float width = std::max(1e-5f * std::abs(value), 1e-5f);
  const Interval ends = {value, value + width};
  const std::vector<double> points = {0, 0.25, 0.5, 1, 0.25, 0.5};
  if (along.v) {
    define(c, over(make_map2(GL_MAP2_VERTEX_3, 1, 2, 6, 3, points), {0, 1}, ends));
  } else {
    define(c, over(make_map2(target_in(along.two, GL_MAP1_VERTEX_3), 2, 1, 3, 6, points), ends));
  }
}

// Draws one primitive of the kind, all of whose vertices are evaluated at the value.
void draw_at(gl::Case& c, const Along& along, PrimitiveKind kind, float value) {
  c.Begin(kind == kPoints ? GL_POINTS : kind == kLines ? GL_LINES : GL_QUADS);
  for (int i = 0; i < (kind == kPoints ? 1 : kind == kLines ? 2 : 4); ++i)
    eval_coord(c, along.two, along.v ? 0.5 : value, along.v ? value : 0.5);
  c.End();
}

// The x coordinates that were captured for one grid. The current texture coordinate of a vertex numbers its
// grid and its role.
struct Probed {
  static constexpr int kTags = 4;
  // Largest accepted error at the end, at which the exact value is 0. The accuracy rule accepts
  // 2^-126 * (1 + 2/|u2 - u1|) and a few units of underflow there, which is less.
  static constexpr double kUnderflow = 0x1p-100;
  std::optional<float> at_end, at_next, at_previous;
  std::vector<float> near_end;  // values of the drawing under test

  // Returns true if EvalCoord gives different values at the end and at one of the adjacent floats at least.
  bool tells() const {
    return at_end && at_next && at_previous && (*at_next != *at_end || *at_previous != *at_end);
  }
  // The midpoint of the values at the end and at an adjacent float, or `beyond` if they are equal.
  double limit(float at_neighbour, double beyond) const {
    const double end = *at_end;
    return at_neighbour == *at_end ? beyond : (end + static_cast<double>(at_neighbour)) / 2;
  }
  // The open interval of accepted values. The exact value at the end is the control point, 0. If EvalCoord
  // gives 0 there, only errors of the size of an underflow are accepted, so that ends that are inexact in
  // double precision are detected. Otherwise, values are accepted that are nearer to the value at the end
  // than to those at the adjacent floats.
  std::pair<double, double> accepted() const {
    if (*at_end == 0) return {-kUnderflow, kUnderflow};
    return {limit(*at_previous, -1), limit(*at_next, 1)};
  }
};

}  // namespace

void expect_exact_end(Test& t, const Along& along, bool last, PrimitiveKind kind,
                      const std::function<void(gl::Case&, const Grid&)>& draw, std::size_t most_vertices) {
  const std::vector<Grid> grids = probed_grids(t);
  gl::Case c(fmt::format("{} grids", grids.size()));
  c.Enable(target_in(along.two, GL_MAP1_VERTEX_3));
  float tag = 0;
  for (const Grid& grid : grids) {
    const float end = last ? grid.last : grid.first;
    define_probe(c, along, end);
    map_grid(c, along, grid);
    c.TexCoord1f(tag++);
    draw(c, grid);
    c.TexCoord1f(tag++);
    draw_at(c, along, kind, end);
    c.TexCoord1f(tag++);
    draw_at(c, along, kind, std::nextafter(end, end + 1));
    c.TexCoord1f(tag++);
    draw_at(c, along, kind, std::nextafter(end, end - 1));
  }

  const auto judge = [&](const Observation& seen) {
    std::vector<Probed> probed(grids.size());
    for (const ObservedPrimitive& primitive : seen.primitives)
      for (const ObservedVertex& vertex : primitive.vertices) {
        const auto number = static_cast<std::size_t>(std::max(vertex.texture_coordinate[0][0], 0.0f));
        if (number >= Probed::kTags * probed.size()) continue;
        Probed& of = probed[number / Probed::kTags];
        const float x = vertex.position[0];
        if (number % Probed::kTags == 1) {
          of.at_end = x;
        } else if (number % Probed::kTags == 2) {
          of.at_next = x;
        } else if (number % Probed::kTags == 3) {
          of.at_previous = x;
        } else if (std::abs(x) < 0.5f) {
          of.near_end.push_back(x);
        }
      }

    std::vector<Mismatch> mismatches;
    std::size_t told = 0;
    for (std::size_t i = 0; i < grids.size(); ++i) {
      if (!probed[i].tells()) continue;
      ++told;
      const auto [lowest, highest] = probed[i].accepted();
      const Grid& grid = grids[i];
      // Each wrong vertex is a mismatch: the end may be a vertex of several primitives.
      const auto add = [&, lowest = lowest, highest = highest](double got, const std::string& captured) {
        Mismatch mismatch;
        mismatch.what =
            fmt::format("{} point of the grid of {} segments from {} to {}", last ? "last" : "first",
                        grid.segments, hexadecimal(grid.first), hexadecimal(grid.last));
        mismatch.expected =
            *probed[i].at_end == 0
                ? std::string("x = 0, the control point there")
                : fmt::format("x = {}, or nearer to it than to the values at the neighbouring numbers",
                              hexadecimal(*probed[i].at_end));
        mismatch.captured = captured;
        mismatch.observed = "position";
        mismatch.message = fmt::format(
            "the {} is not where EvalCoord at {} = {} is: {}, expected {}", mismatch.what,
            along.v ? "v" : "u", hexadecimal(last ? grid.last : grid.first), captured, mismatch.expected);
        mismatch.lowest = lowest;
        mismatch.highest = highest;
        mismatch.got = got;
        mismatches.push_back(std::move(mismatch));
      };
      if (probed[i].near_end.empty()) add(1, "no vertex near it");
      for (const float x : probed[i].near_end) {
        const auto got = static_cast<double>(x);
        if (got != static_cast<double>(*probed[i].at_end) && (got <= lowest || got >= highest))
          add(got, "x = " + hexadecimal(x));
      }
    }
    if (told == 0) throw NotObservable("EvalCoord does not tell neighbouring arguments apart");
    return mismatches;
  };
  t.expect_observation(c, kPosition | kTextureCoordinate0, most_vertices + 12 * grids.size(), kind, judge);
}

}  // namespace evalcts
