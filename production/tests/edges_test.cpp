// Tests patches whose edges have numbers of segments of their own: their points, and the triangles between
// the edges and the inner grid.
#include <map>

#include "guarded.h"
#include "nets.h"

namespace glev_tests {
namespace {

using Edges = std::array<int, 4>;  // segments of v = v1, u = u2, v = v2, u = u1

struct Tessellation {
  int u_segments, v_segments;
  Edges edges;

  std::size_t inner() const { return static_cast<std::size_t>((u_segments - 1) * (v_segments - 1)); }
  std::size_t boundary() const { return static_cast<std::size_t>(edges[0] + edges[1] + edges[2] + edges[3]); }
  std::size_t points() const { return inner() + boundary(); }
  glev_patch_grid make_grid() const { return glevaluator::make_edge_grid(u_segments, v_segments, edges); }
  // Returns the position of a point in the domain, from 0 to 1.
  std::array<double, 2> position(std::size_t number) const {
    const auto columns = static_cast<std::size_t>(u_segments) - 1;
    if (number < inner()) {
      const std::size_t i = number % columns + 1, j = number / columns + 1;
      return {static_cast<double>(i) / u_segments, static_cast<double>(j) / v_segments};
    }
    auto rest = static_cast<int>(number - inner());
    std::size_t edge = 0;
    while (rest >= edges[edge]) rest -= edges[edge++];
    const double t = static_cast<double>(rest) / edges[edge];
    const std::array<std::array<double, 2>, 4> all = {{{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}}};
    return all[edge];
  }
};

class PatchEdges : public ::testing::Test {
 protected:
  Tessellation choose() {
    const auto segments = [&] { return chance_.one_of({1, 1, 2, 3, 4, 5, 7, 8, 30}); };
    return {chance_.whole(2, 8), chance_.whole(2, 8), {segments(), segments(), segments(), segments()}};
  }

  // Returns patches of float control points in three components.
  Net random_net(std::array<int, 2> order, std::size_t count) {
    Net net;
    net.order = order;
    net.count = count;
    if (chance_.whole(0, 1) == 0) net.domain = {0.25, 2, 1, 0};
    const Floats points = chance_.next_points(count * net.values_of_patch());
    net.values.assign(points.begin(), points.end());
    return net;
  }

  // Evaluates one attribute into exactly as many bytes as it needs, next to a guard page. Patches are
  // `gap` bytes apart.
  std::vector<float> evaluate(const Net& net, const glev_patch_grid& grid, glev_attribute attribute,
                              std::size_t points, std::size_t gap = 0) {
    const auto side = chance_.one_of({Guarded::Side::kBegin, Guarded::Side::kEnd});
    const std::size_t patch = points * 12 + gap;
    Guarded memory(net.count * patch - gap, side);
    glev_output output = {sizeof output, memory.data(), memory.size(), 12, 3, 0, 0, gap == 0 ? 0 : patch};
    const glev_attribute_output outputs = {attribute, &output};
    std::vector<unsigned char> control(net.bytes());
    net.write(control.data());
    const glev_patches patches = net.describe(control.data());
    Guarded scratch(glevGetPatchScratchSize(&patches, &grid), side);
    EXPECT_EQ(glevEvaluatePatches(&patches, &grid, &outputs, 1, scratch.data(), scratch.size()),
              GLEV_SUCCESS);
    std::vector<float> values(net.count * points * 3);
    for (std::size_t p = 0; p < net.count; ++p) {
      std::memcpy(&values[p * points * 3], memory.data() + p * patch, points * 12);
      for (std::size_t b = 0; b < gap && p + 1 < net.count; ++b)
        EXPECT_EQ(memory.data()[p * patch + points * 12 + b], Guarded::kPoisonByte);
    }
    return values;
  }

  // Returns the points of edge number `edge` of a patch, its last point included.
  static std::vector<std::uint64_t> edge_of(const std::vector<float>& values, std::size_t patch,
                                            const Tessellation& own, std::size_t edge) {
    std::size_t first = 0;
    for (std::size_t k = 0; k < edge; ++k) first += static_cast<std::size_t>(own.edges[k]);
    Floats points;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(own.edges[edge]); ++k) {
      const std::size_t at = patch * own.points() + own.inner() + (first + k) % own.boundary();
      points.insert(points.end(), &values[3 * at], &values[3 * at] + 3);
    }
    return bits_of(points);
  }

  static std::vector<std::uint32_t> indices_of(const Tessellation& own, glev_enum winding,
                                               std::size_t patches = 1) {
    glev_indices indices = glevaluator::make_indices(own.make_grid(), patches);
    indices.winding = winding;
    Guarded memory(glevGetIndexCount(&indices) * 4, Guarded::Side::kEnd);
    indices.data = memory.data();
    indices.data_size = memory.size();
    EXPECT_EQ(glevGetIndices(&indices), GLEV_SUCCESS);
    std::vector<std::uint32_t> numbers(memory.size() / 4);
    std::memcpy(numbers.data(), memory.data(), memory.size());
    return numbers;
  }

  Chance chance_;
};

TEST_F(PatchEdges, HaveThePointsOfUniformGrids) {
  for (int k = 0; k < 150; ++k) {
    const Tessellation own = choose();
    const Net net =
        random_net({chance_.whole(1, 5), chance_.whole(1, 5)}, static_cast<std::size_t>(chance_.whole(1, 4)));
    const auto attribute = chance_.one_of(
        {GLEV_ATTRIBUTE_VERTEX, GLEV_ATTRIBUTE_NORMAL, GLEV_ATTRIBUTE_TANGENT_V, GLEV_ATTRIBUTE_SECOND_UU});
    const auto values = evaluate(net, own.make_grid(), attribute, own.points(),
                                 chance_.one_of({std::size_t{0}, std::size_t{9}}));
    // The uniform grids that have the inner points and the points of each edge.
    for (std::size_t part = 0; part < 5; ++part) {
      glev_patch_grid grid = glevaluator::make_uniform_grid(1, 1);
      if (part == 0) grid = glevaluator::make_uniform_grid(own.u_segments, own.v_segments);
      if (part != 0) (part % 2 == 1 ? grid.u_segments : grid.v_segments) = own.edges[part - 1];
      const auto columns = static_cast<std::size_t>(grid.u_segments) + 1,
                 all = columns * (static_cast<std::size_t>(grid.v_segments) + 1);
      const auto expected = evaluate(net, grid, attribute, all);
      for (std::size_t at = 0; at < own.points(); ++at) {
        const auto [u, v] = own.position(at);
        const bool is_inner = at < own.inner(), is_on[] = {is_inner, v == 0, u == 1, v == 1, u == 0};
        if (is_inner != (part == 0) || !is_on[part]) continue;
        const auto i = static_cast<std::size_t>(std::lround(u * grid.u_segments)),
                   j = static_cast<std::size_t>(std::lround(v * grid.v_segments));
        for (std::size_t p = 0; p < net.count; ++p) {
          const float *const a = &values[3 * (p * own.points() + at)],
                             *const b = &expected[3 * (p * all + j * columns + i)];
          ASSERT_EQ(bits_of(Floats(a, a + 3)), bits_of(Floats(b, b + 3)))
              << "attribute " << attribute << ", part " << part << ", point " << at << " of patch " << p;
        }
      }
    }
  }
}

// Two patches share the control points of an edge, in every position and direction.
TEST_F(PatchEdges, OfNeighboursMeetWithoutCracks) {
  for (int order : {2, 3, 4, 6}) {
    for (std::size_t edge : {0, 1, 2, 3}) {
      for (std::size_t other_edge : {0, 1, 2, 3}) {
        for (bool is_reversed : {false, true}) {
          Floats shared = chance_.next_points(static_cast<std::size_t>(order) * 3);
          for (float& x : shared) x = std::ldexp(x, chance_.one_of({0, 0, -20, 30}));
          const int segments = chance_.one_of({1, 2, 3, 5, 8, 10, 17});
          std::array<std::vector<std::uint64_t>, 2> meeting;
          for (const bool is_second : {false, true}) {
            const std::size_t position = is_second ? other_edge : edge;
            const bool is_along_u = position % 2 == 0, is_last = position == 1 || position == 2;
            const int across = chance_.whole(2, 5);
            Net net = random_net({is_along_u ? order : across, is_along_u ? across : order}, 1);
            for (int k = 0; k < order; ++k) {
              // The edges v = v2 and u = u1 run from the last control point to the first.
              const bool is_back = (position >= 2) != (is_second && is_reversed);
              const int along = is_back ? order - 1 - k : k, end = is_last ? across - 1 : 0;
              const int i = is_along_u ? along : end, j = is_along_u ? end : along;
              std::copy_n(shared.begin() + 3 * k, 3, net.values.begin() + 3 * (i * net.order[1] + j));
            }
            Tessellation own = choose();
            own.edges[position] = segments;
            glev_patch_grid grid = own.make_grid();
            grid.precision = chance_.one_of({GLEV_CORRECTLY_ROUNDED, GLEV_FAST});
            const auto values = evaluate(net, grid, GLEV_ATTRIBUTE_VERTEX, own.points());
            meeting[is_second] = edge_of(values, 0, own, position);
            if (is_second && is_reversed) {
              std::vector<std::uint64_t> back;
              for (std::size_t k = meeting[1].size(); k != 0; k -= 3)
                back.insert(back.end(), &meeting[1][k - 3], &meeting[1][k - 3] + 3);
              meeting[1] = back;
            }
          }
          ASSERT_EQ(meeting[0], meeting[1])
              << "order " << order << ", edges " << edge << " and " << other_edge << ", reversed "
              << is_reversed << ", " << segments << " segments";
        }
      }
    }
  }
}

// In the domain, the triangles have one orientation and cover it once: each edge between two triangles has
// both directions, and the others are the boundary.
TEST_F(PatchEdges, TrianglesCoverThePatchOnce) {
  for (int k = 0; k < 300; ++k) {
    const Tessellation own = choose();
    const bool is_ccw = k % 2 == 1;
    const auto numbers = indices_of(own, is_ccw ? GLEV_CCW : GLEV_CW);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
    double area = 0;
    for (std::size_t t = 0; t < numbers.size(); t += 3) {
      std::array<std::array<double, 2>, 3> at;
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_LT(numbers[t + c], own.points());
        at[c] = own.position(numbers[t + c]);
        ++directed[{numbers[t + c], numbers[t + (c + 1) % 3]}];
      }
      const double twice =
          (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
      ASSERT_GT(is_ccw ? twice : -twice, 1e-9);
      area += std::fabs(twice) / 2;
    }
    EXPECT_NEAR(area, 1, 1e-9);
    std::size_t on_boundary = 0;
    for (const auto& [edge, count] : directed) {
      ASSERT_EQ(count, 1);
      if (directed.count({edge.second, edge.first}) == 1) continue;
      ++on_boundary;
      const auto [from, to] = is_ccw ? edge : std::pair{edge.second, edge.first};
      ASSERT_GE(from, own.inner());
      ASSERT_EQ(to, own.inner() + (from - own.inner() + 1) % own.boundary());
    }
    ASSERT_EQ(on_boundary, own.boundary());
  }
}

TEST_F(PatchEdges, IndicesOfPatchesFollowOneAnother) {
  const Tessellation own = {4, 3, {1, 2, 5, 3}};
  const auto one = indices_of(own, 0), all = indices_of(own, 0, 3);
  ASSERT_EQ(all.size(), 3 * one.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    EXPECT_EQ(all[k], one[k % one.size()] + k / one.size() * own.points());
}

}  // namespace
}  // namespace glev_tests
