// Tests the error bounds of automatic normals, with 600 binary digits as the oracle; every route
// and instruction set gives the same bits.
#include <algorithm>
#include <cmath>
#include <random>

#include "batches.h"
#include "exact.h"
#include "rounding_modes.h"

namespace glev_tests {
namespace normal_bounds {
namespace {

// The bound of |got - n| in each component if |m| is at least kLeast times its majorant.
constexpr double kBound = 0x1p-25 + 0x1p-30, kLeast = 0x1p-50;

struct Grid {
  std::array<double, 4> ends = {0, 1, 0, 1};
  std::array<int, 2> segments = {16, 16};
};

struct Patch {
  std::array<double, 4> domain = {0, 1, 0, 1};
  std::array<int, 2> order;
  int components = 3;
  std::vector<double> points;
  Grid grid;
};

struct Oracle {
  WideVector normal{};
  Wide ratio = 0;  // |m| / majorant; 0: there is no normal
};

// Returns the largest magnitude of component k of control points, or of their differences in a direction.
double largest_of(const Patch& patch, int k, int direction) {
  double largest = 0;
  for (int i = 0; i < patch.order[0]; ++i) {
    for (int j = 0; j < patch.order[1]; ++j) {
      const auto at = [&](int a, int b) {
        return patch.points[(a * patch.order[1] + b) * patch.components + k];
      };
      if (direction < 0) largest = std::max(largest, std::fabs(at(i, j)));
      if (direction == 0 && i > 0) largest = std::max(largest, std::fabs(at(i, j) - at(i - 1, j)));
      if (direction == 1 && j > 0) largest = std::max(largest, std::fabs(at(i, j) - at(i, j - 1)));
    }
  }
  return largest;
}

// Returns the exact normal at grid point (i, j).
Oracle exact_normal(const Patch& patch, int i, int j) {
  std::array<std::vector<Wide>, 2> values, slopes;
  for (int d : {0, 1}) {
    const Wide a = patch.grid.ends[2 * d], b = patch.grid.ends[2 * d + 1], u1 = patch.domain[2 * d],
               u2 = patch.domain[2 * d + 1];
    const Wide t = (a + (d == 0 ? i : j) * (b - a) / patch.grid.segments[d] - u1) / (u2 - u1);
    values[d] = bernstein<Wide>(patch.order[d], t, 1 - t);
    slopes[d] = bernstein<Wide>(patch.order[d], t, 1 - t, 1);
  }
  std::array<Wide, 4> p = {0, 0, 0, 1}, p_u{}, p_v{};
  std::array<double, 4> largest = {0, 0, 0, 1}, largest_u{}, largest_v{};
  for (int k = 0; k < patch.components; ++k) {
    p[k] = tensor(values[0], values[1], patch.points, patch.components, k).value;
    p_u[k] = tensor(slopes[0], values[1], patch.points, patch.components, k).value;
    p_v[k] = tensor(values[0], slopes[1], patch.points, patch.components, k).value;
    largest[k] = largest_of(patch, k, -1);
    largest_u[k] = (patch.order[0] - 1) * largest_of(patch, k, 0);
    largest_v[k] = (patch.order[1] - 1) * largest_of(patch, k, 1);
  }
  WideVector a, b, most_a, most_b, majorant;
  for (int k = 0; k < 3; ++k) {
    a[k] = p[3] * p_u[k] - p_u[3] * p[k];
    b[k] = p[3] * p_v[k] - p_v[3] * p[k];
    most_a[k] = Wide(largest[3]) * largest_u[k] + Wide(largest_u[3]) * largest[k];
    most_b[k] = Wide(largest[3]) * largest_v[k] + Wide(largest_v[3]) * largest[k];
  }
  const WideVector m = cross_product(a, b);
  for (int k = 0; k < 3; ++k) {
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    majorant[k] = most_a[x] * most_b[y] + most_a[y] * most_b[x];
  }
  Oracle oracle;
  const Wide length = length_of(m), most = length_of(majorant);
  // A ratio within the error of 600 digits counts as zero.
  oracle.ratio = most == 0 || length < most * 0x1p-400 ? Wide(0) : Wide(length / most);
  for (int k = 0; k < 3 && oracle.ratio != 0; ++k) oracle.normal[k] = m[k] / length;
  return oracle;
}

using Normal = std::array<float, 3>;

bool same_bits(const Normal& a, const Normal& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

class NormalBounds : public ::testing::Test {
 protected:
  static void define(glev_context* gl, const Patch& patch) {
    const glev_enum name = patch.components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
    glevMap2d(gl, name, patch.domain[0], patch.domain[1], patch.order[1] * patch.components, patch.order[0],
              patch.domain[2], patch.domain[3], patch.components, patch.order[1], patch.points.data());
    glevEnable(gl, name);
    glevEnable(gl, GLEV_AUTO_NORMAL);
    const auto& [ends, segments] = patch.grid;
    glevMapGrid2d(gl, segments[0], ends[0], ends[1], segments[1], ends[2], ends[3]);
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_NO_ERROR));
  }

  static std::vector<glev_vertex> evaluate_by_calls(glev_context* gl, const Range& range,
                                                    int mode = FE_TONEAREST) {
    Recording recording;
    const glev_sink sink = recording.make_sink();
    glevSetSink(gl, &sink);
    call_in_mode(mode, [&] { glevEvalMesh2(gl, GLEV_POINT, range.i1, range.i2, range.j1, range.j2); });
    glevSetSink(gl, nullptr);
    return recording.vertices;
  }

  // Compares vertices and normals as records of six floats, `stride` floats apart, with single calls.
  static void check_records(glev_context* gl, const Range& range, std::size_t stride) {
    const Plan plan(gl, 2);
    std::vector<float> got(range.count() * stride, 77), expected = got;
    glev_output vertex = output_to(got, 3, stride), normal = vertex;
    normal.data = got.data() + 3;
    normal.data_size -= 3 * sizeof(float);
    glev_mesh mesh = mesh_of(range);
    const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &vertex}, {GLEV_ATTRIBUTE_NORMAL, &normal}});
    evaluate_mesh(plan, mesh);
    auto record = expected.begin();
    for (const glev_vertex& call : evaluate_by_calls(gl, range)) {
      std::copy_n(call.position, 3, record);
      std::copy_n(call.normal, 3, record + 3);
      record += static_cast<std::ptrdiff_t>(stride);
    }
    EXPECT_TRUE(bits_of(got) == bits_of(expected)) << "stride " << stride;
  }

  // Returns the normals of single calls, after a check that meshes have them on every instruction set, packed
  // or not, in every rounding mode.
  static std::vector<Normal> evaluate_everywhere(const Patch& patch, const Range& range) {
    std::vector<Normal> expected;
    on_every_instruction_set([&](glev_context* gl) {
      define(gl, patch);
      for (const int mode : kModes) {
        const std::vector<glev_vertex> calls = evaluate_by_calls(gl, range, mode);
        const bool is_first = expected.empty();
        for (const glev_vertex& call : calls) {
          if (is_first) expected.push_back(std::to_array(call.normal));
        }
        const Plan plan(gl, 2);
        const std::size_t values = mode == FE_UPWARD ? 3 : 6;
        Floats mesh;
        call_in_mode(mode, [&] {
          mesh = evaluate_grid(plan, GLEV_ATTRIBUTE_NORMAL, range, GLEV_CORRECTLY_ROUNDED, values, 77.0F);
        });
        int different = 0;
        for (std::size_t i = 0; i < range.count(); ++i) {
          const Normal got = {mesh[i * values], mesh[i * values + 1], mesh[i * values + 2]};
          different +=
              !same_bits(got, expected[i]) || !same_bits(std::to_array(calls[i].normal), expected[i]);
          different += values == 6 && mesh[i * values + 3] != 77;  // written between elements
        }
        EXPECT_EQ(different, 0) << "mode " << mode << ", orders " << patch.order[0] << " x " << patch.order[1]
                                << ", components " << patch.components;
      }
      for (const std::size_t stride : {6, 7}) {
        if (patch.components == 3) check_records(gl, range, stride);
      }
    });
    return expected;
  }

  // Compares every `step`-th normal with the oracle. Returns the smallest ratio.
  static double check(const Patch& patch, const Range& range, std::size_t step = 1) {
    const std::vector<Normal> got = evaluate_everywhere(patch, range);
    double least = 1;
    for (std::size_t at = 0; at < got.size(); at += step) {
      const int i = range.i1 + static_cast<int>(at % range.columns()),
                j = range.j1 + static_cast<int>(at / range.columns());
      const Oracle oracle = exact_normal(patch, i, j);
      if (oracle.ratio == 0) {
        EXPECT_TRUE(same_bits(got[at], {0, 0, 0})) << "at " << i << ", " << j;
        continue;
      }
      least = std::min(least, static_cast<double>(oracle.ratio));
      if (oracle.ratio < kLeast) continue;
      for (int k = 0; k < 3; ++k) {
        const Wide error = abs(Wide(got[at][k]) - oracle.normal[k]);
        EXPECT_LE(static_cast<double>(error), kBound)
            << "component " << k << " at " << i << ", " << j << ": " << got[at][k] << ", ratio "
            << static_cast<double>(oracle.ratio) << ", orders " << patch.order[0] << " x " << patch.order[1]
            << ", seed " << kSeed;
        // The component is zero within the accuracy of the oracle.
        if (abs(oracle.normal[k]) < 0x1p-300) {
          EXPECT_EQ(float_bits(got[at][k]), 0u);
        }
      }
    }
    return least;
  }

  double random_between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Patch random_patch(std::array<int, 2> order, int components, bool floats = true) {
    Patch patch;
    patch.order = order;
    patch.components = components;
    for (int i = 0; i < order[0] * order[1]; ++i) {
      for (int k = 0; k < components; ++k) {
        const double x = k == 3 ? random_between(0.5, 2) : random_between(-1, 1);
        patch.points.push_back(floats ? static_cast<double>(static_cast<float>(x)) : x);
      }
    }
    return patch;
  }

  std::mt19937 random_{kSeed};
};

TEST_F(NormalBounds, OfRandomPatches) {
  for (const int components : {3, 4}) {
    for (const std::array<int, 2> order :
         {std::array{2, 2}, {2, 5}, {3, 3}, {4, 4}, {5, 3}, {8, 8}, {3, 12}, {16, 2}}) {
      Patch patch = random_patch(order, components);
      patch.grid.segments = {36, 7};
      check(patch, {0, 36, 0, 7}, 3);
      patch.domain = {1, 0, 5, -2};
      patch.grid = {{1, 0, 5, -2}, {4, 7}};
      check(patch, {0, 4, 0, 7}, 3);
      patch.domain = {0.1, -2, 3, 3.7};
      patch.grid = {{0.1, -2, 3.7, 3}, {21, 5}};
      check(patch, {0, 21, 0, 5}, 3);
    }
    Patch patch = random_patch({30, 30}, components);
    patch.grid.segments = {36, 7};
    check(patch, {0, 36, 0, 7}, 20);
  }
}

// All points of a grid with equal ends are these ends.
TEST_F(NormalBounds, OfEvalCoord) {
  for (const int components : {3, 4}) {
    for (const std::array<double, 4>& domain :
         {std::array{0.0, 1.0, 0.0, 1.0}, {2.0, 5.0, -3.0, -1.0}, {1.0, 0.0, 0.1, 0.7}}) {
      Patch patch = random_patch({4, 5}, components);
      patch.domain = domain;
      for (const double t : {0.0, 1.0, 0.5, -0.05, 1.02, random_between(0, 1), random_between(0, 1)}) {
        const double u = t == 1 ? domain[1] : domain[0] + t * (domain[1] - domain[0]),
                     v = random_between(domain[2], domain[3]);
        patch.grid.ends = {u, u, v, v};
        check(patch, {0, 0, 0, 0});
        on_every_instruction_set([&](glev_context* gl) {
          define(gl, patch);
          const Normal expected = std::to_array(evaluate_by_calls(gl, {0, 0, 0, 0}).at(0).normal);
          Recording recording;
          const glev_sink sink = recording.make_sink();
          glevSetSink(gl, &sink);
          glevBegin(gl, GLEV_POINTS);
          glevEvalCoord2d(gl, u, v);
          glevEnd(gl);
          EXPECT_EQ(std::to_array(recording.vertices.at(0).normal), expected) << u << ", " << v;
        });
      }
    }
  }
}

TEST_F(NormalBounds, OnGridsThatAreNotTheDomain) {
  for (const int components : {3, 4}) {
    Patch patch = random_patch({4, 5}, components);
    // Arguments far outside, across the ends, and with few digits left after cancellation.
    patch.grid = {{0.2, 0.9, -0.1, 0.6}, {10, 7}};
    check(patch, {-9, 25, -3, 4}, 5);
    patch.grid = {{-3, 7, -1e4, 1e4}, {10, 20000}};
    check(patch, {-2, 8, 9998, 10003});
    patch.domain = {0.1, 0.7, 0.3, 0.4};
    patch.grid = {{-0.5, 0.7 + 0x1p-50, 0.1, 0.5 + 0x1p-52}, {2, 2}};
    check(patch, {0, 2, 0, 2});
    patch.grid = {{0.1 - 1, 0.1 + 1 + 0x1p-45, 0.3 - 8, 0.3 + 8 + 0x1p-40}, {2, 2}};
    check(patch, {0, 2, 0, 2});
  }
}

// Both tangents nearly parallel to one line, which the exact points say.
TEST_F(NormalBounds, OfNearlyDegeneratePatches) {
  for (const int components : {3, 4}) {
    for (const std::array<int, 2> order : {std::array{4, 4}, {8, 8}}) {
      for (int digits = 5; digits <= 45; digits += digits < 20 ? 3 : 8) {
        Patch patch = random_patch(order, components, false);
        for (int i = 0; i < order[0] * order[1]; ++i) {
          const int column = i / order[1], row = i % order[1];
          const double along =
              column / static_cast<double>(order[0] - 1) + row / static_cast<double>(order[1] - 1);
          double* const point = &patch.points[i * components];
          for (int k = 0; k < components; ++k) point[k] = std::ldexp(point[k], -digits);
          point[0] += along, point[1] += 0.7 * along, point[2] -= 0.3 * along;
          if (components == 4) point[3] += 1;
        }
        patch.grid.segments = {18, 3};
        const double least = check(patch, {0, 18, 0, 3}, 5);
        EXPECT_LT(least, std::ldexp(1, 2 - digits));
      }
    }
  }
}

TEST_F(NormalBounds, FlatPatchesHaveExactZeros) {
  for (const int components : {3, 4}) {
    for (const std::array<int, 2> order : {std::array{4, 4}, {8, 8}, {3, 12}}) {
      for (const bool turned : {false, true}) {
        Patch patch = random_patch(order, components);
        for (int i = 0; i < order[0] * order[1]; ++i) {
          double* const point = &patch.points[i * components];
          const double w = components == 4 ? static_cast<float>(point[3]) : 1;
          // A regular patch: a sheet with small perturbations.
          const int column = i / order[1], row = i % order[1];
          point[0] = w * static_cast<float>(column + 0.2 * point[0]);
          point[1] = w * static_cast<float>(row + 0.2 * point[1]);
          if (turned) std::swap(point[0], point[1]);
          point[2] = w * static_cast<float>(0.3);
        }
        patch.grid.segments = {36, 7};
        for (const Normal& normal : evaluate_everywhere(patch, {0, 36, 0, 7}))
          EXPECT_TRUE(same_bits(normal, {0, 0, turned ? -1.0f : 1.0f})) << normal[0] << " " << normal[2];
        // z = 3 x with rounding errors, which are larger far outside.
        Patch tilted = patch;
        for (int i = 0; i < order[0] * order[1]; ++i)
          tilted.points[i * components + 2] = 3 * tilted.points[i * components];
        for (const Range range : {Range{0, 36, 0, 7}, {3, 7, 100, 110}, {400, 410, 3, 5}}) {
          for (const Normal& normal : evaluate_everywhere(tilted, range))
            EXPECT_EQ(float_bits(normal[1]), 0u) << normal[1];
        }
        if (components == 4) continue;
        // z = x: the plane contains an axis.
        for (int i = 0; i < order[0] * order[1]; ++i) patch.points[3 * i + 2] = patch.points[3 * i];
        for (const Normal& normal : evaluate_everywhere(patch, {0, 36, 0, 7})) {
          EXPECT_EQ(float_bits(normal[1]), 0u);
          EXPECT_EQ(normal[2], turned ? -0x1.6a09e6p-1f : 0x1.6a09e6p-1f);
          EXPECT_EQ(normal[0], -normal[2]);
        }
      }
    }
  }
}

// An octant of a sphere: rational, of order 3 x 3, with an edge that is one point, the pole.
TEST_F(NormalBounds, OfAPatchWithACollapsedEdge) {
  const double r = std::sqrt(0.5);
  const double arc[3][3] = {{1, 0, 1}, {r, r, r}, {0, 1, 1}};
  Patch patch;
  patch.order = {3, 3};
  patch.components = 4;
  for (const auto& [cos_u, sin_u, w_u] : arc) {
    for (const auto& [cos_v, sin_v, w_v] : arc)
      patch.points.insert(patch.points.end(), {cos_u * cos_v, sin_u * cos_v, w_u * sin_v, w_u * w_v});
  }
  patch.grid.segments = {40, 40};
  check(patch, {0, 40, 0, 40}, 7);
  for (const Normal& normal : evaluate_everywhere(patch, {0, 40, 40, 40}))
    EXPECT_TRUE(same_bits(normal, {0, 0, 0}));
  // Arguments close to the pole.
  patch.grid = {{0, 1, 1 - 0x1p-30, 1}, {9, 1}};
  check(patch, {0, 9, 0, 0});
  patch.grid = {{0, 1, 1 - 0x1p-50, 1}, {9, 1}};
  check(patch, {0, 9, 0, 0});
  // A polynomial patch with an edge that is one point, in both directions.
  Patch triangle = random_patch({4, 4}, 3);
  for (int j = 0; j < 4; ++j) std::copy_n(triangle.points.begin(), 3, triangle.points.begin() + 3 * j);
  check(triangle, {0, 16, 0, 16}, 5);
  for (const Normal& normal : evaluate_everywhere(triangle, {0, 0, 0, 16}))
    EXPECT_TRUE(same_bits(normal, {0, 0, 0}));
}

TEST_F(NormalBounds, DoNotDependOnSize) {
  for (const int components : {3, 4}) {
    Patch patch = random_patch({4, 4}, components);
    const Range range = {0, 16, 0, 16};
    const std::vector<Normal> expected = evaluate_everywhere(patch, range);
    for (const int exponent : {-140, -100, 60, 120, 250}) {
      Patch scaled = patch;
      for (std::size_t i = 0; i < scaled.points.size(); ++i) {
        if (i % components != 3) scaled.points[i] = std::ldexp(scaled.points[i], exponent);
      }
      EXPECT_EQ(evaluate_everywhere(scaled, range), expected) << exponent;
    }
  }
}

}  // namespace
}  // namespace normal_bounds
}  // namespace glev_tests
