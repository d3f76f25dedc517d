// Tests that patches that share the control points of an edge have the same bits along it, for all edges and
// directions.
#include "batches.h"

namespace glev_tests {
namespace {

constexpr int kComponents = 3;

// The position of an edge in its patch.
struct SharedEdge {
  bool is_along_u;  // along u at v = 0 or 1, otherwise along v at u = 0 or 1
  bool is_last;     // at u or v = 1
  bool is_reversed;
};

std::vector<SharedEdge> all_edges() {
  std::vector<SharedEdge> edges;
  for (bool along : {false, true}) {
    for (bool last : {false, true}) {
      for (bool reversed : {false, true}) edges.push_back({along, last, reversed});
    }
  }
  return edges;
}

class Watertight : public ContextTest {
 protected:
  // Defines a random patch with this edge.
  void define_patch(const SharedEdge& edge, const std::vector<float>& shared, int other_order) {
    const int order = static_cast<int>(shared.size()) / kComponents;
    const int n = edge.is_along_u ? order : other_order, m = edge.is_along_u ? other_order : order;
    std::vector<float> points = chance_.next_points(static_cast<std::size_t>(n) * m * kComponents);
    for (int k = 0; k < order; ++k) {
      const int along = edge.is_reversed ? order - 1 - k : k;
      const int i = edge.is_along_u ? along : edge.is_last ? n - 1 : 0;
      const int j = !edge.is_along_u ? along : edge.is_last ? m - 1 : 0;
      std::copy_n(shared.begin() + k * kComponents, kComponents, points.begin() + (i * m + j) * kComponents);
    }
    glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, m * kComponents, n, 0, 1, kComponents, m, points.data());
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
  }

  // Evaluates points along the edge, in the direction of the shared points, at `parameters` by a batch.
  Floats evaluate_batch(const SharedEdge& edge, const std::vector<float>& parameters) {
    const Plan plan(gl, 2);
    std::vector<float> along = parameters;
    if (edge.is_reversed) {
      for (float& t : along) t = 1 - t;  // exact
    }
    const std::vector<float> across(along.size(), edge.is_last ? 1.0F : 0.0F);
    return edge.is_along_u ? evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, along, across)
                           : evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, across, along);
  }

  // Evaluates the edge at the points of a grid, as part of the mesh of the whole patch or as a mesh of the
  // edge alone.
  Floats evaluate_mesh(const SharedEdge& edge, int segments, int other_segments, bool whole,
                       glev_precision precision = GLEV_CORRECTLY_ROUNDED) {
    glevMapGrid2f(gl, edge.is_along_u ? segments : other_segments, 0, 1,
                  edge.is_along_u ? other_segments : segments, 0, 1);
    const Plan plan(gl, 2);
    const int across = edge.is_last ? other_segments : 0;
    const int first = whole ? 0 : across, last = whole ? other_segments : across;
    const Range range = edge.is_along_u ? Range{0, segments, first, last} : Range{first, last, 0, segments};
    const Floats points = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, range, precision);
    Floats along;
    for (int k = 0; k <= segments; ++k) {
      const int at = edge.is_reversed ? segments - k : k, row = whole ? across : 0;
      const int i = edge.is_along_u ? at : row, j = edge.is_along_u ? row : at;
      const auto begin = points.begin() + (static_cast<int>(range.columns()) * j + i) * kComponents;
      along.insert(along.end(), begin, begin + kComponents);
    }
    return along;
  }

  std::vector<float> random_shared_points(int order) {
    std::vector<float> shared = chance_.next_points(static_cast<std::size_t>(order) * kComponents);
    // Control points have various magnitudes; some are ties or lines.
    for (float& point : shared) point = std::ldexp(point, chance_.one_of({0, 0, 0, -20, 30}));
    if (chance_.whole(0, 3) == 0) {
      for (std::size_t k = 0; k < shared.size(); ++k) {
        const std::size_t point = k / kComponents;
        shared[k] = static_cast<float>(point);
      }
    }
    return shared;
  }

  Chance chance_;
};

TEST_F(Watertight, AlongAllEdgesInBatches) {
  for (int order = 2; order <= 12; ++order) {
    const std::vector<float> shared = random_shared_points(order);
    std::vector<float> parameters = {0, 1, 0.5F, 0.25F, 0x1p-24F, 1 - 0x1p-24F};
    for (int k = 0; k < 40; ++k) parameters.push_back(chance_.next_float());
    Floats expected;
    for (const SharedEdge& edge : all_edges()) {
      define_patch(edge, shared, chance_.whole(1, 12));
      const Floats got = evaluate_batch(edge, parameters);
      if (expected.empty()) expected = got;
      ASSERT_EQ(bits_of(got), bits_of(expected)) << "order " << order;
    }
  }
}

TEST_F(Watertight, AlongAllEdgesInMeshes) {
  for (int order = 2; order <= 12; ++order) {
    const std::vector<float> shared = random_shared_points(order);
    for (int segments : {1, 2, 3, 7, 16, 33, 75, 300}) {
      Floats expected;
      for (const SharedEdge& edge : all_edges()) {
        define_patch(edge, shared, chance_.whole(1, 12));
        for (bool whole : {true, false}) {
          for (const glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
            const Floats got = evaluate_mesh(edge, segments, chance_.whole(1, 9), whole, precision);
            if (expected.empty()) expected = got;
            ASSERT_EQ(bits_of(got), bits_of(expected))
                << "order " << order << ", " << segments << " segments, precision " << precision;
          }
        }
      }
    }
  }
}

// Patches with different orders and numbers of segments meet at their common arguments.
TEST_F(Watertight, BetweenFastMeshesOfOtherOrdersAndSegments) {
  for (int k = 0; k < 100; ++k) {
    const int order = chance_.whole(2, 6);
    std::vector<float> shared(static_cast<std::size_t>(order) * kComponents);
    // Multiples of the order with few bits, so that the elevated points are floats.
    for (float& point : shared) point = static_cast<float>(order * chance_.whole(-30000, 30000));
    std::vector<float> elevated(shared.size() + kComponents);
    for (int i = 0; i <= order; ++i) {
      for (int c = 0; c < kComponents; ++c) {
        const auto at = [&](int j) { return j < 0 || j >= order ? 0 : shared[j * kComponents + c]; };
        elevated[i * kComponents + c] =
            (static_cast<float>(i) * at(i - 1) + static_cast<float>(order - i) * at(i)) /
            static_cast<float>(order);
      }
    }
    const int segments = chance_.whole(1, 40), factor = chance_.whole(2, 5);
    const SharedEdge edge = chance_.one_of(all_edges()), other = chance_.one_of(all_edges());
    define_patch(edge, shared, chance_.whole(1, 6));
    // Meshes of low degree with fewer segments would be correctly rounded.
    const int others = (1 << 14) / segments + 1;
    const Floats coarse = evaluate_mesh(edge, segments, others, true, GLEV_FAST);
    define_patch(other, elevated, chance_.whole(1, 6));
    const Floats fine = evaluate_mesh(other, segments * factor, others, true, GLEV_FAST);
    Floats found;
    for (int i = 0; i <= segments; ++i)
      found.insert(found.end(), fine.begin() + static_cast<std::ptrdiff_t>(i) * factor * kComponents,
                   fine.begin() + (static_cast<std::ptrdiff_t>(i) * factor + 1) * kComponents);
    ASSERT_EQ(bits_of(coarse), bits_of(found)) << "order " << order << ", " << segments << " segments";
  }
}

// If the arguments of a grid are floats, batches have its bits, too.
TEST_F(Watertight, BetweenBatchesAndMeshes) {
  for (int order = 2; order <= 12; ++order) {
    const std::vector<float> shared = random_shared_points(order);
    std::vector<float> parameters;
    for (int k = 0; k <= 32; ++k) parameters.push_back(static_cast<float>(k) / 32);
    for (const SharedEdge& edge : all_edges()) {
      define_patch(edge, shared, 3);
      ASSERT_EQ(bits_of(evaluate_mesh(edge, 32, 5, true)), bits_of(evaluate_batch(edge, parameters)));
    }
  }
}

// An edge is the curve of its control points.
TEST_F(Watertight, WithCurvesOfTheSharedPoints) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (int order = 2; order <= 12; ++order) {
    const std::vector<float> shared = random_shared_points(order);
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, kComponents, order, shared.data());
    for (int segments : {16, 21}) {
      glevMapGrid1f(gl, segments, 0, 1);
      const Plan curve(gl, 1);
      const Floats expected = evaluate_grid(curve, GLEV_ATTRIBUTE_VERTEX, {0, segments});
      for (const SharedEdge& edge : all_edges()) {
        define_patch(edge, shared, chance_.whole(1, 12));
        ASSERT_EQ(bits_of(evaluate_mesh(edge, segments, 4, true)), bits_of(expected));
      }
    }
  }
}

}  // namespace
}  // namespace glev_tests
