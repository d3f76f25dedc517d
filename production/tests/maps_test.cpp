// Tests Map1, Map2, GetMap, GetnMap and the queries of grids: exact values, conversions, null pointers, and
// rules that the GL leaves open. The conformance suite tests the rules of the GL (suites/map_*.cpp,
// suites/get*_map.cpp, suites/grids.cpp).
#include <climits>
#include <cstring>
#include <limits>

#include "fixture.h"

namespace glev_tests {
namespace {

class Maps : public ContextTest {
 protected:
  static constexpr glev_enum kTargets[] = {GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP2_TEXTURE_COORD_1};

  // Defines a curve and a net of 2 x 3 points with the same values.
  void define(const float (&points)[6], float u1, float u2) {
    expect_accepted([&] { glevMap1f(gl, kTargets[0], u1, u2, 1, 6, points); });
    expect_accepted([&] { glevMap2f(gl, kTargets[1], u1, u2, 3, 2, u1, u2, 1, 3, points); });
  }
  void define(const double (&points)[6], double u1, double u2) {
    expect_accepted([&] { glevMap1d(gl, kTargets[0], u1, u2, 1, 6, points); });
    expect_accepted([&] { glevMap2d(gl, kTargets[1], u1, u2, 3, 2, u1, u2, 1, 3, points); });
  }
};

// ---- Values

TEST_F(Maps, FloatsComeBackBitForBit) {
  const float points[] = {0.1f,       -0.0f, 0x1p-149f, -0x1.fffffcp-127f, std::numeric_limits<float>::max(),
                          1.0f / 3.0f};
  const float domain[] = {0.1f, 1.0f / 3.0f};
  define(points, domain[0], domain[1]);
  for (const glev_enum target : kTargets) {
    float got[6];
    glevGetMapfv(gl, target, GLEV_COEFF, got);
    EXPECT_EQ(std::memcmp(got, points, sizeof points), 0);
    glevGetMapfv(gl, target, GLEV_DOMAIN, got);
    EXPECT_EQ(std::memcmp(got, domain, sizeof domain), 0);
  }
}

TEST_F(Maps, DoublesComeBackBitForBit) {
  const double points[] = {0.1, -0.0, 0x1p-1074, -0x1.fffffffffffffp1023, 1.0 / 3.0, 1e300};
  const double domain[] = {0.1, 0.1 + 0x1p-56};
  define(points, domain[0], domain[1]);
  for (const glev_enum target : kTargets) {
    double got[6];
    glevGetMapdv(gl, target, GLEV_COEFF, got);
    EXPECT_EQ(std::memcmp(got, points, sizeof points), 0);
    glevGetMapdv(gl, target, GLEV_DOMAIN, got);
    EXPECT_EQ(std::memcmp(got, domain, sizeof domain), 0);
  }
}

TEST_F(Maps, DoublesBecomeTheNearestFloats) {
  const double points[] = {1.0 / 3.0, 1e300, -1e300, kInfinity, -kInfinity, 1};
  define(points, 0, 1);
  constexpr float kLargest = std::numeric_limits<float>::max(), kInf = std::numeric_limits<float>::infinity();
  for (const glev_enum target : kTargets) {
    float got[6];
    glevGetMapfv(gl, target, GLEV_COEFF, got);
    EXPECT_EQ(values_of(got), (Floats{1.0f / 3.0f, kLargest, -kLargest, kInf, -kInf, 1}));
  }
}

// Unlike GetIntegerv, GetMapiv does not scale colours.
TEST_F(Maps, IntegersAreRoundedHalvesAwayFromZeroAndSaturated) {
  const double points[] = {
      1.4,          -1.6,         2.51,          0.49999999999999994, -0.49999999999999994, 0.5,
      -0.5,         1e20,         -1e20,         kInfinity,           -kInfinity,           kNaN,
      2147483646.4, 2147483646.6, -2147483647.6, 2147483647.4};
  const std::vector<int> expected = {1,       -2,      3,       0, 0,          1,          -1,      INT_MAX,
                                     INT_MIN, INT_MAX, INT_MIN, 0, 2147483646, 2147483647, INT_MIN, INT_MAX};
  glevMap1d(gl, GLEV_MAP1_COLOR_4, -1.5, 1e20, 4, 4, points);
  glevMap2d(gl, GLEV_MAP2_COLOR_4, -1.5, 1e20, 8, 2, -1.5, 1e20, 4, 2, points);
  for (const glev_enum target : {GLEV_MAP1_COLOR_4, GLEV_MAP2_COLOR_4}) {
    std::vector<int> got(16);
    glevGetMapiv(gl, target, GLEV_COEFF, got.data());
    EXPECT_EQ(got, expected);
    glevGetMapiv(gl, target, GLEV_DOMAIN, got.data());
    EXPECT_EQ(got[0], -2);
    EXPECT_EQ(got[1], INT_MAX);
  }
}

TEST_F(Maps, GridsKeepDoubles) {
  glevMapGrid1d(gl, 9, 0.1, 1.0 / 3.0);
  glevMapGrid2d(gl, 3, 1.6, -2.5, 4, 1e20, 0.1);
  double doubles[4];
  glevGetDoublev(gl, GLEV_MAP1_GRID_DOMAIN, doubles);
  EXPECT_TRUE(doubles[0] == 0.1 && doubles[1] == 1.0 / 3.0);
  glevGetDoublev(gl, GLEV_MAP2_GRID_DOMAIN, doubles);
  EXPECT_EQ(std::vector<double>(doubles, doubles + 4), (std::vector<double>{1.6, -2.5, 1e20, 0.1}));
  float floats[4];
  glevGetFloatv(gl, GLEV_MAP2_GRID_DOMAIN, floats);
  EXPECT_EQ(values_of(floats), (Floats{1.6f, -2.5f, 1e20f, 0.1f}));
  int integers[4];
  glevGetIntegerv(gl, GLEV_MAP2_GRID_DOMAIN, integers);
  EXPECT_EQ(std::vector<int>(integers, integers + 4), (std::vector<int>{2, -3, INT_MAX, 0}));
}

// ---- Arguments

TEST_F(Maps, AStrideOfOrderOneIsNotUsed) {
  const float points[] = {1, 2, 3, 4, 5, 6};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, INT_MAX, 1, points);
  float got[6];
  glevGetMapfv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, got);
  EXPECT_EQ(std::memcmp(got, points, 3 * sizeof(float)), 0);
  for (const bool of_v : {false, true}) {
    of_v ? glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, INT_MAX, 1, points)
         : glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, INT_MAX, 1, 0, 1, 3, 2, points);
    glevGetMapfv(gl, GLEV_MAP2_VERTEX_3, GLEV_COEFF, got);
    EXPECT_EQ(std::memcmp(got, points, sizeof points), 0);
  }
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Maps, EqualInfinitiesAreNoDomain) {
  const double points[] = {1, 2};
  for (const auto& [u1, u2, error] : {std::tuple{kInfinity, kInfinity, GLEV_INVALID_VALUE},
                                      {kInfinity, -kInfinity, GLEV_NO_ERROR},
                                      {kNaN, kNaN, GLEV_NO_ERROR}}) {
    glevMap1d(gl, kTargets[0], u1, u2, 1, 2, points);
    expect_error(error);
    glevMap2d(gl, kTargets[1], 0, 1, 1, 2, u1, u2, 1, 1, points);
    expect_error(error);
  }
}

TEST_F(Maps, NullPointersAreRefused) {
  const std::function<void()> calls[] = {
      [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, nullptr); },
      [&] { glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, nullptr); },
      [&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr); },
      [&] { glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr); },
      [&] { glevGetMapdv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); },
      [&] { glevGetMapfv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); },
      [&] { glevGetMapiv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); },
      [&] { glevGetnMapdv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, 8, nullptr); },
      [&] { glevGetnMapfv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, 8, nullptr); },
      [&] { glevGetnMapiv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, 8, nullptr); }};
  for (const auto& call : calls) expect_rejected(GLEV_INVALID_VALUE, call);
}

// The GL leaves it open which of several errors is recorded.
TEST_F(Maps, ErrorsOfArgumentsComeBeforeErrorsOfState) {
  const float points[64] = {};
  double got = -7;
  const std::pair<glev_enum, std::function<void()>> calls[] = {
      {GLEV_INVALID_ENUM, [&] { glevMap1f(gl, 0, 0, 1, 3, 0, points); }},
      {GLEV_INVALID_VALUE, [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 0, points); }},
      {GLEV_INVALID_ENUM, [&] { glevMap2f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 0, points); }},
      {GLEV_INVALID_VALUE, [&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 0, points); }}};
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  for (const auto& [error, call] : calls) expect_rejected(error, call);
  glevActiveTexture(gl, GLEV_TEXTURE0);
  for (const auto& [error, call] : calls) expect_rejected_in_primitive(error, call);
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevMapGrid1f(gl, 0, 2, 3); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevMapGrid2f(gl, 1, 2, 3, 0, 2, 3); });
  expect_rejected_in_primitive(GLEV_INVALID_ENUM, [&] { glevEvalMesh1(gl, GLEV_FILL, 0, 1); });
  expect_rejected_in_primitive(GLEV_INVALID_ENUM, [&] { glevEvalMesh2(gl, 0, 0, 1, 0, 1); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetnMapdv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, -1, &got); });
  EXPECT_EQ(got, -7);
}

}  // namespace
}  // namespace glev_tests
