// Tests the error bounds of automatic normals, with 600 binary digits as the oracle; every route
// and instruction set gives the same bits.
#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "exact.h"
#include "fixture.h"

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
  std::array<Wide, 4> p, p_u, p_v;  // p_u, p_v: derivatives by the arguments
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
  Oracle oracle;
  oracle.p = {0, 0, 0, 1};
  oracle.p_u = oracle.p_v = {0, 0, 0, 0};
  std::array<double, 4> largest = {0, 0, 0, 1}, largest_u{}, largest_v{};
  for (int k = 0; k < patch.components; ++k) {
    oracle.p[k] = tensor(values[0], values[1], patch.points, patch.components, k).value;
    oracle.p_u[k] = tensor(slopes[0], values[1], patch.points, patch.components, k).value;
    oracle.p_v[k] = tensor(values[0], slopes[1], patch.points, patch.components, k).value;
    largest[k] = largest_of(patch, k, -1);
    largest_u[k] = (patch.order[0] - 1) * largest_of(patch, k, 0);
    largest_v[k] = (patch.order[1] - 1) * largest_of(patch, k, 1);
  }
  WideVector a, b, most_a, most_b, majorant;
  for (int k = 0; k < 3; ++k) {
    a[k] = oracle.p[3] * oracle.p_u[k] - oracle.p_u[3] * oracle.p[k];
    b[k] = oracle.p[3] * oracle.p_v[k] - oracle.p_v[3] * oracle.p[k];
    most_a[k] = Wide(largest[3]) * largest_u[k] + Wide(largest_u[3]) * largest[k];
    most_b[k] = Wide(largest[3]) * largest_v[k] + Wide(largest_v[3]) * largest[k];
  }
  const WideVector m = cross_product(a, b);
  for (int k = 0; k < 3; ++k) {
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    majorant[k] = most_a[x] * most_b[y] + most_a[y] * most_b[x];
  }
  const Wide length = length_of(m), most = length_of(majorant);
  // A ratio within the error of 600 digits counts as zero.
  oracle.ratio = most == 0 || length < most * 0x1p-400 ? Wide(0) : Wide(length / most);
  for (int k = 0; k < 3; ++k) {
    if (oracle.ratio != 0) oracle.normal[k] = m[k] / length;
    oracle.p_u[k] /= Wide(patch.domain[1]) - Wide(patch.domain[0]);
    oracle.p_v[k] /= Wide(patch.domain[3]) - Wide(patch.domain[2]);
  }
  return oracle;
}

constexpr int kModes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, -1};

// Makes a call in a rounding mode that a caller may have set.
template <class Call>
void call_in_mode(int mode, const Call& call) {
#if defined(__SSE2__)
  const unsigned control = _mm_getcsr();
  if (mode < 0) _mm_setcsr(control | 0x8040);  // denormals-are-zero and flush-to-zero
#endif
  if (mode >= 0) std::fesetround(mode);
  call();
  std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
  _mm_setcsr(control);
#endif
}

using Normal = std::array<float, 3>;

bool same_bits(const Normal& a, const Normal& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

class NormalBounds : public ::testing::Test {
 protected:
  static std::vector<std::string> targets() {
    std::vector<std::string> names;
    for (std::size_t i = 0; glevGetTargetName(i) != nullptr; ++i) names.emplace_back(glevGetTargetName(i));
    return names;
  }

  // Makes a context with the patch and its grid.
  static glev_context* make_context(const Patch& patch, const std::string& target) {
    glev_context_info info = {sizeof info, nullptr, target.c_str()};
    glev_context* gl = nullptr;
    EXPECT_EQ(glevCreateContext(&info, &gl), GLEV_SUCCESS);
    const glev_enum name = patch.components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
    glevMap2d(gl, name, patch.domain[0], patch.domain[1], patch.order[1] * patch.components, patch.order[0],
              patch.domain[2], patch.domain[3], patch.components, patch.order[1], patch.points.data());
    glevEnable(gl, name);
    glevEnable(gl, GLEV_AUTO_NORMAL);
    const auto& [ends, segments] = patch.grid;
    glevMapGrid2d(gl, segments[0], ends[0], ends[1], segments[1], ends[2], ends[3]);
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_NO_ERROR));
    return gl;
  }

  struct Range {
    int i1, i2, j1, j2;
    std::size_t columns() const { return i2 - i1 + 1; }
    std::size_t count() const { return columns() * (j2 - j1 + 1); }
  };

  // Evaluates an attribute of the mesh, with elements `values` values apart.
  template <class Real>
  static std::vector<Real> evaluate_mesh(glev_context* gl, const Range& range, glev_attribute attribute,
                                         std::size_t components, std::size_t values,
                                         int mode = FE_TONEAREST) {
    const glev_plan_info info = {sizeof info, 2};
    glev_plan* plan = nullptr;
    EXPECT_EQ(glevCreatePlan(gl, &info, &plan), GLEV_SUCCESS);
    std::vector<Real> result(range.count() * values, Real(77));
    glev_output to = {sizeof to,
                      result.data(),
                      result.size() * sizeof(Real),
                      values * sizeof(Real),
                      components,
                      sizeof(Real) == 8 ? GLEV_DOUBLE : GLEV_FLOAT,
                      0,
                      0};
    glev_mesh mesh = {};
    mesh.size = sizeof mesh;
    mesh.i1 = range.i1, mesh.i2 = range.i2, mesh.j1 = range.j1, mesh.j2 = range.j2;
    const Outputs outputs(mesh, {{attribute, &to}});
    std::vector<unsigned char> scratch(glevGetMeshScratchSize(plan, &mesh));
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size();
    call_in_mode(mode, [&] { EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS); });
    glevReleasePlan(plan);
    return result;
  }

  // Compares vertices and normals as records of six floats, `stride` floats apart, with single calls.
  static void check_records(glev_context* gl, const Range& range, std::size_t stride) {
    const glev_plan_info info = {sizeof info, 2};
    glev_plan* plan = nullptr;
    ASSERT_EQ(glevCreatePlan(gl, &info, &plan), GLEV_SUCCESS);
    std::vector<float> got(range.count() * stride, 77);
    const std::size_t bytes = got.size() * sizeof(float);
    const glev_output vertex = {sizeof vertex, got.data(), bytes, stride * sizeof(float), 3,
                                GLEV_FLOAT,    0,          0},
                      normal = {sizeof normal,
                                got.data() + 3,
                                bytes - 3 * sizeof(float),
                                stride * sizeof(float),
                                3,
                                GLEV_FLOAT,
                                0,
                                0};
    glev_mesh mesh = {};
    mesh.size = sizeof mesh;
    mesh.i1 = range.i1, mesh.i2 = range.i2, mesh.j1 = range.j1, mesh.j2 = range.j2;
    const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &vertex}, {GLEV_ATTRIBUTE_NORMAL, &normal}});
    std::vector<unsigned char> scratch(glevGetMeshScratchSize(plan, &mesh));
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size();
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), GLEV_SUCCESS);
    glevReleasePlan(plan);
    Recording recording;
    const glev_sink sink = recording.make_sink();
    glevSetSink(gl, &sink);
    glevEvalMesh2(gl, GLEV_POINT, range.i1, range.i2, range.j1, range.j2);
    glevSetSink(gl, nullptr);
    int different = 0;
    for (std::size_t i = 0; i < range.count(); ++i) {
      const glev_vertex& expected = recording.vertices[i];
      const float* const record = &got[i * stride];
      different += std::memcmp(record, expected.position, 12) != 0;
      different += std::memcmp(record + 3, expected.normal, 12) != 0;
      for (std::size_t k = 6; k < stride; ++k) different += record[k] != 77;
    }
    EXPECT_EQ(different, 0) << "stride " << stride;
  }

  static std::vector<Normal> evaluate_by_calls(glev_context* gl, const Range& range,
                                               int mode = FE_TONEAREST) {
    Recording recording;
    const glev_sink sink = recording.make_sink();
    glevSetSink(gl, &sink);
    call_in_mode(mode, [&] { glevEvalMesh2(gl, GLEV_POINT, range.i1, range.i2, range.j1, range.j2); });
    std::vector<Normal> normals;
    for (const glev_vertex& vertex : recording.vertices)
      normals.push_back({vertex.normal[0], vertex.normal[1], vertex.normal[2]});
    glevSetSink(gl, nullptr);
    return normals;
  }

  // Returns the normals of single calls, after a check that meshes have them on every instruction set, packed
  // or not, in every rounding mode.
  static std::vector<Normal> evaluate_everywhere(const Patch& patch, const Range& range) {
    std::vector<Normal> expected;
    for (const std::string& target : targets()) {
      glev_context* const gl = make_context(patch, target);
      if (expected.empty()) expected = evaluate_by_calls(gl, range);
      for (const int mode : kModes) {
        const std::vector<Normal> calls = evaluate_by_calls(gl, range, mode);
        const std::size_t values = mode == FE_UPWARD ? 3 : 6;
        const std::vector<float> mesh =
            evaluate_mesh<float>(gl, range, GLEV_ATTRIBUTE_NORMAL, 3, values, mode);
        int different = 0;
        for (std::size_t i = 0; i < range.count(); ++i) {
          const Normal got = {mesh[i * values], mesh[i * values + 1], mesh[i * values + 2]};
          if (!same_bits(got, expected[i]) || !same_bits(calls[i], expected[i])) ++different;
          if (values == 6 && mesh[i * values + 3] != 77) ++different;  // written between elements
        }
        EXPECT_EQ(different, 0) << target << ", mode " << mode << ", orders " << patch.order[0] << " x "
                                << patch.order[1] << ", components " << patch.components;
      }
      if (patch.components == 3) {
        check_records(gl, range, 6);
        check_records(gl, range, 7);
      }
      glevDestroyContext(gl);
    }
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
          EXPECT_EQ(std::bit_cast<std::uint32_t>(got[at][k]), 0u);
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
    for (const std::array<int, 2> order : {std::array{2, 2}, {2, 5}, {3, 3}, {4, 4}, {5, 3}, {8, 8}}) {
      Patch patch = random_patch(order, components);
      patch.grid.segments = {36, 7};
      check(patch, {0, 36, 0, 7}, 3);
      patch.domain = {0.1, -2, 3, 3.7};
      patch.grid = {{0.1, -2, 3.7, 3}, {21, 5}};
      check(patch, {0, 21, 0, 5}, 3);
    }
    Patch patch = random_patch({30, 30}, components);
    patch.grid.segments = {36, 7};
    check(patch, {0, 36, 0, 7}, 20);
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
            EXPECT_EQ(std::bit_cast<std::uint32_t>(normal[1]), 0u) << normal[1];
        }
        if (components == 4) continue;
        // z = x: the plane contains an axis.
        for (int i = 0; i < order[0] * order[1]; ++i) patch.points[3 * i + 2] = patch.points[3 * i];
        for (const Normal& normal : evaluate_everywhere(patch, {0, 36, 0, 7})) {
          EXPECT_EQ(std::bit_cast<std::uint32_t>(normal[1]), 0u);
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
