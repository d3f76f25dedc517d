// Tests Map2 and GetMap: accepted and rejected arguments, and stored values.
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "fixture.h"

namespace glev_tests {
namespace {

struct Direction {
  double first, last;
  int stride, order;
};

std::ostream& operator<<(std::ostream& out, const Direction& d) {
  return out << "[" << d.first << "," << d.last << "] stride " << d.stride << " order " << d.order;
}

class Map2 : public ContextTest {
 protected:
  Map2() {
    std::iota(floats.begin(), floats.end(), 1.0f);
    std::iota(doubles.begin(), doubles.end(), 1.0);
  }

  void define_f(glev_enum target, const Direction& u, const Direction& v) {
    glevMap2f(gl, target, static_cast<float>(u.first), static_cast<float>(u.last), u.stride, u.order,
              static_cast<float>(v.first), static_cast<float>(v.last), v.stride, v.order, floats.data());
  }
  void define_d(glev_enum target, const Direction& u, const Direction& v) {
    glevMap2d(gl, target, u.first, u.last, u.stride, u.order, v.first, v.last, v.stride, v.order,
              doubles.data());
  }
  void expect_rejected_forms(glev_enum error, glev_enum target, const Direction& u, const Direction& v) {
    SCOPED_TRACE(testing::Message() << std::hex << target << std::dec << " u " << u << " v " << v);
    expect_rejected(error, [&] { define_f(target, u, v); });
    expect_rejected(error, [&] { define_d(target, u, v); });
  }
  // Expects that an invalid direction is rejected as u and as v, together with a valid one that would change
  // state.
  void expect_rejected_direction(glev_enum error, glev_enum target, const Direction& bad) {
    const Direction good = {-2, 9, 4, 3};
    expect_rejected_forms(error, target, bad, good);
    expect_rejected_forms(error, target, good, bad);
  }

  template <class Count>
  std::vector<double> get_map(glev_enum target, glev_enum query, Count count) {
    std::vector<double> values(static_cast<std::size_t>(count) + 1, -12345);
    glevGetMapdv(gl, target, query, values.data());
    EXPECT_EQ(values.back(), -12345) << "written past the end";
    values.pop_back();
    return values;
  }

  std::array<float, 64 * 64 * 8> floats;
  std::array<double, 64 * 64 * 8> doubles;
};

// ---- Errors

TEST_F(Map2, TargetMustBeOneOfTheNine) {
  const glev_enum bad[] = {0, 0x0D8F, 0x0D99, 0x0DAF, 0x0DB9, 0x0DE1, GLEV_AUTO_NORMAL, 0xFFFFFFFF};
  for (glev_enum target : bad) expect_rejected_forms(GLEV_INVALID_ENUM, target, {0, 1, 4, 2}, {0, 1, 8, 2});
  for (const TargetRow& row : target_rows()) {
    expect_rejected_forms(GLEV_INVALID_ENUM, GLEV_MAP1_COLOR_4 + row.offset, {0, 1, 4, 2}, {0, 1, 8, 2});
  }
}

TEST_F(Map2, EachOrderMustBeFromOneToTheLargest) {
  for (const TargetRow& row : target_rows()) {
    for (int order : {0, -1, INT_MIN, kMax + 1, INT_MAX}) {
      expect_rejected_direction(GLEV_INVALID_VALUE, GLEV_MAP2_COLOR_4 + row.offset, {0, 1, 4, order});
    }
  }
}

TEST_F(Map2, EachStrideMustHoldAControlPointEvenForOrderOne) {
  for (const TargetRow& row : target_rows()) {
    for (int stride : {row.components - 1, 0, -1, INT_MIN}) {
      for (int order : {1, 2}) {
        expect_rejected_direction(GLEV_INVALID_VALUE, GLEV_MAP2_COLOR_4 + row.offset, {0, 1, stride, order});
      }
    }
  }
}

TEST_F(Map2, NeitherDomainMayBeEmpty) {
  for (double u : {0.0, 1.0, -2.5, 1e30, kInfinity}) {
    expect_rejected_direction(GLEV_INVALID_VALUE, GLEV_MAP2_VERTEX_3, {u, u, 3, 2});
  }
  expect_rejected_direction(GLEV_INVALID_VALUE, GLEV_MAP2_VERTEX_3, {0.0, -0.0, 3, 2});
}

TEST_F(Map2, NullPointsAreRefused) {
  expect_rejected(GLEV_INVALID_VALUE,
                  [&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE,
                  [&] { glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr); });
}

TEST_F(Map2, NotBetweenBeginAndEnd) {
  const Direction u = {0, 2, 3, 2}, v = {0, 3, 6, 3};
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { define_f(GLEV_MAP2_VERTEX_3, u, v); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { define_d(GLEV_MAP2_VERTEX_3, u, v); });
}

TEST_F(Map2, NotWithAnotherActiveTexture) {
  for (glev_enum unit : {1, GLEV_TEXTURE_UNITS - 1}) {
    glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
    for (const TargetRow& row : target_rows()) {
      expect_rejected_forms(GLEV_INVALID_OPERATION, GLEV_MAP2_COLOR_4 + row.offset, {0, 2, 4, 2},
                            {0, 2, 8, 2});
    }
  }
  glevActiveTexture(gl, GLEV_TEXTURE0);
  expect_accepted([&] { define_f(GLEV_MAP2_VERTEX_3, {0, 2, 3, 2}, {0, 2, 6, 2}); });
}

TEST_F(Map2, ErrorsOfArgumentsComeBeforeErrorsOfState) {
  const Direction good = {0, 2, 3, 2}, bad = {0, 2, 3, 0};
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  expect_rejected_forms(GLEV_INVALID_ENUM, GLEV_MAP1_VERTEX_3, good, good);
  expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP2_VERTEX_3, good, bad);
  glevActiveTexture(gl, GLEV_TEXTURE0);
  expect_rejected_in_primitive(GLEV_INVALID_ENUM, [&] { define_f(0, good, good); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { define_f(GLEV_MAP2_VERTEX_3, bad, good); });
}

TEST_F(Map2, AFailingCallLeavesADefinedMapAlone) {
  define_f(GLEV_MAP2_VERTEX_3, {3, 7, 3, 5}, {1, 2, 15, 4});
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  floats.fill(99);
  doubles.fill(99);
  for (const Direction& bad : {Direction{0, 1, 2, 4}, {0, 0, 3, 4}, {0, 1, 3, kMax + 1}}) {
    expect_rejected_direction(GLEV_INVALID_VALUE, GLEV_MAP2_VERTEX_3, bad);
  }
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] {
    define_f(GLEV_MAP2_VERTEX_3, {0, 2, 3, 2}, {0, 2, 6, 2});
  });
}

// ---- What is accepted

TEST_F(Map2, OrdersFromOneToTheLargestInBothDirections) {
  for (const TargetRow& row : target_rows()) {
    const glev_enum target = GLEV_MAP2_COLOR_4 + row.offset;
    const int k = row.components;
    for (auto [n, m] :
         {std::pair{1, 1}, {1, kMax}, {kMax, 1}, {kMax, kMax}, {2, 5}, {7, 3}, {kMax - 1, kMax}, {8, 8}}) {
      expect_accepted([&, n = n, m = m] { define_f(target, {0, 1, k * m, n}, {0, 1, k, m}); });
      EXPECT_EQ(get_map(target, GLEV_ORDER, 2), (std::vector<double>{1.0 * n, 1.0 * m}));
      const auto count = static_cast<std::size_t>(n * m * k);
      EXPECT_EQ(get_map(target, GLEV_COEFF, count),
                std::vector<double>(doubles.begin(), doubles.begin() + count));
    }
  }
}

TEST_F(Map2, StridesCountValuesAndAreIndependent) {
  const int n = 3, m = 4;
  for (const TargetRow& row : target_rows()) {
    const glev_enum target = GLEV_MAP2_COLOR_4 + row.offset;
    const int k = row.components;
    // Layouts: u-major, v-major, padded, and control points that share memory.
    for (auto [us, vs] : {std::pair{k * m, k},
                          {k, k * n},
                          {k * m + 7, k},
                          {k + 1, (k + 1) * n + 5},
                          {k, k},
                          {2 * k, k},
                          {k + 1, k}}) {
      std::vector<double> expected;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
          for (int c = 0; c < k; ++c) expected.push_back(1 + i * us + j * vs + c);
        }
      }
      for (bool f : {true, false}) {
        define_f(target, {0, 1, 4, 1}, {0, 1, 4, 1});
        expect_accepted([&, us = us, vs = vs] {
          if (f)
            define_f(target, {0, 1, us, n}, {0, 1, vs, m});
          else
            define_d(target, {0, 1, us, n}, {0, 1, vs, m});
        });
        EXPECT_EQ(get_map(target, GLEV_COEFF, expected.size()), expected) << us << " " << vs;
      }
    }
  }
}

TEST_F(Map2, AHugeStrideWithOrderOneIsNotUsed) {
  const float points[] = {1, 2, 3, 4, 5, 6};
  expect_accepted([&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, INT_MAX, 1, 0, 1, 3, 2, points); });
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_3, GLEV_COEFF, 6), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  expect_accepted([&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, INT_MAX, 1, points); });
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_3, GLEV_COEFF, 6), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_F(Map2, DomainsAreKeptAsGiven) {
  for (auto [u1, u2, v1, v2] :
       {std::array{1.0, 0.0, 5.0, -2.0}, {-3.0, -1.0, 1e9, -1e9}, {0.5, 2.0, 7.0, 9.0}}) {
    for (bool f : {true, false}) {
      define_f(GLEV_MAP2_VERTEX_4, {0, 1, 4, 1}, {0, 1, 4, 1});
      expect_accepted([&, u1 = u1, u2 = u2, v1 = v1, v2 = v2] {
        const Direction u = {u1, u2, 4, 3}, v = {v1, v2, 12, 2};
        f ? define_f(GLEV_MAP2_VERTEX_4, u, v) : define_d(GLEV_MAP2_VERTEX_4, u, v);
      });
      EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_4, GLEV_DOMAIN, 4), (std::vector<double>{u1, u2, v1, v2}));
    }
  }
  define_d(GLEV_MAP2_VERTEX_4, {0.1, 0.1 + 0x1p-56, 4, 3}, {1.0 / 3, 1, 12, 2});
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_4, GLEV_DOMAIN, 4),
            (std::vector<double>{0.1, 0.1 + 0x1p-56, 1.0 / 3, 1}));
}

TEST_F(Map2, DataComesBackBitForBit) {
  const double given[] = {0.1, -0.0, 0x1p-1074, -0x1.fffffffffffffp1023, 1.0 / 3.0, 1e300};
  glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, 3, 2, 0, 1, 1, 3, given);
  double got[6];
  glevGetMapdv(gl, GLEV_MAP2_TEXTURE_COORD_1, GLEV_COEFF, got);
  EXPECT_EQ(std::memcmp(got, given, sizeof given), 0);
  const float floats_given[] = {0.1f, -0.0f, 0x1p-149f, std::numeric_limits<float>::max()};
  glevMap2f(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, 2, 2, 0, 1, 1, 2, floats_given);
  float floats_got[4];
  glevGetMapfv(gl, GLEV_MAP2_TEXTURE_COORD_1, GLEV_COEFF, floats_got);
  EXPECT_EQ(std::memcmp(floats_got, floats_given, sizeof floats_given), 0);
  int integers[4];
  const double fractions[] = {1.4, -1.6, 1e20, 2.51};
  glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, 1, 2, 0, 1, 2, 2, fractions);
  glevGetMapiv(gl, GLEV_MAP2_TEXTURE_COORD_1, GLEV_COEFF, integers);
  EXPECT_EQ(std::vector<int>(integers, integers + 4), (std::vector<int>{1, INT_MAX, -2, 3}));
}

TEST_F(Map2, PaddingIsNotLookedAtAndPointsAreCopied) {
  std::vector<float> points(200, static_cast<float>(kNaN));
  std::vector<double> expected;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int c = 0; c < 3; ++c) {
        points[i * 5 + j * 31 + c] = static_cast<float>(100 * i + 10 * j + c);
        expected.push_back(100 * i + 10 * j + c);
      }
    }
  }
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 5, 3, 0, 1, 31, 4, points.data());
  points.assign(200, 77);
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_3, GLEV_COEFF, expected.size()), expected);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  EXPECT_EQ(values_of(one_vertex([&] { glevEvalCoord2f(gl, 1, 0); }).position), (Floats{200, 201, 202, 1}));
}

TEST_F(Map2, ASuccessfulCallReplacesThatTargetOnlyAndNoEnable) {
  const std::vector<double> untouched = query_state();
  for (const TargetRow& row : target_rows()) {
    const int k = static_cast<int>(row.offset);
    std::fill(floats.begin(), floats.end(), static_cast<float>(k) + 0.5f);
    if (k % 2 == 1) glevEnable(gl, GLEV_MAP2_COLOR_4 + row.offset);
    define_f(GLEV_MAP2_COLOR_4 + row.offset, {1.0 * k, 20, 4, k + 2}, {-1.0 * k, 30, 5, k + 1});
  }
  for (const TargetRow& row : target_rows()) {
    const int k = static_cast<int>(row.offset);
    const glev_enum target = GLEV_MAP2_COLOR_4 + row.offset;
    EXPECT_EQ(glevIsEnabled(gl, target), k % 2 == 1 ? GLEV_TRUE : GLEV_FALSE);
    EXPECT_EQ(get_map(target, GLEV_ORDER, 2), (std::vector<double>{k + 2.0, k + 1.0}));
    EXPECT_EQ(get_map(target, GLEV_DOMAIN, 4), (std::vector<double>{1.0 * k, 20, -1.0 * k, 30}));
    const auto count = static_cast<std::size_t>((k + 2) * (k + 1) * row.components);
    EXPECT_EQ(get_map(target, GLEV_COEFF, count), std::vector<double>(count, k + 0.5));
    const glev_enum target1 = GLEV_MAP1_COLOR_4 + row.offset;
    EXPECT_EQ(get_map(target1, GLEV_ORDER, 1), (std::vector<double>{1}));
    EXPECT_EQ(get_map(target1, GLEV_DOMAIN, 2), (std::vector<double>{0, 1}));
    EXPECT_EQ(get_map(target1, GLEV_COEFF, row.components), row.initial);
  }
  EXPECT_NE(query_state(), untouched);
}

TEST_F(Map2, Map1LeavesItAlone) {
  define_f(GLEV_MAP2_VERTEX_3, {3, 7, 3, 5}, {1, 2, 15, 4});
  const float points[] = {9, 9, 9};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 4, 5, 3, 1, points);
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_3, GLEV_ORDER, 2), (std::vector<double>{5, 4}));
  EXPECT_EQ(get_map(GLEV_MAP2_VERTEX_3, GLEV_DOMAIN, 4), (std::vector<double>{3, 7, 1, 2}));
}

}  // namespace
}  // namespace glev_tests
