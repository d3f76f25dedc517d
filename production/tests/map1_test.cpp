// Tests Map1 and GetMap: accepted and rejected arguments, and stored values.
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "fixture.h"

namespace glev_tests {
namespace {

class Map1 : public ContextTest {
 protected:
  Map1() {
    std::iota(floats.begin(), floats.end(), 1.0f);
    std::iota(doubles.begin(), doubles.end(), 1.0);
  }

  // Calls both forms with the same arguments.
  void define(glev_enum target, double u1, double u2, int stride, int order) {
    glevMap1f(gl, target, static_cast<float>(u1), static_cast<float>(u2), stride, order, floats.data());
  }
  void expect_rejected_forms(glev_enum error, glev_enum target, double u1, double u2, int stride, int order) {
    SCOPED_TRACE(testing::Message() << std::hex << target << std::dec << " [" << u1 << "," << u2
                                    << "] stride " << stride << " order " << order);
    expect_rejected(error, [&] { define(target, u1, u2, stride, order); });
    expect_rejected(error, [&] { glevMap1d(gl, target, u1, u2, stride, order, doubles.data()); });
  }

  int order_of(glev_enum target) {
    int order = -1;
    glevGetMapiv(gl, target, GLEV_ORDER, &order);
    return order;
  }
  std::vector<double> coefficients_of(glev_enum target, std::size_t count) {
    std::vector<double> values(count + 1, -12345);
    glevGetMapdv(gl, target, GLEV_COEFF, values.data());
    EXPECT_EQ(values.back(), -12345) << "written past the end";
    values.pop_back();
    return values;
  }
  std::vector<double> domain_of(glev_enum target) {
    std::vector<double> values(3, -12345);
    glevGetMapdv(gl, target, GLEV_DOMAIN, values.data());
    EXPECT_EQ(values.back(), -12345) << "written past the end";
    values.pop_back();
    return values;
  }

  std::array<float, 4096> floats;
  std::array<double, 4096> doubles;
};

// ---- Errors

TEST_F(Map1, TargetMustBeOneOfTheNine) {
  const glev_enum bad[] = {0,      0x0D8F, 0x0D99, 0x0DAF,           0x0DB9,    0x0DE1,
                           0x8660, 0x8444, 0x81CB, GLEV_AUTO_NORMAL, 0xFFFFFFFF};
  for (glev_enum target : bad) expect_rejected_forms(GLEV_INVALID_ENUM, target, 0, 1, 4, 2);
  for (const TargetRow& row : target_rows()) {
    expect_rejected_forms(GLEV_INVALID_ENUM, GLEV_MAP2_COLOR_4 + row.offset, 0, 1, 4, 2);
  }
}

TEST_F(Map1, OrderMustBeFromOneToTheLargest) {
  for (const TargetRow& row : target_rows()) {
    for (int order : {0, -1, INT_MIN, kMax + 1, INT_MAX}) {
      expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_COLOR_4 + row.offset, 0, 1, 4, order);
    }
  }
}

TEST_F(Map1, StrideMustHoldAControlPointEvenForOrderOne) {
  for (const TargetRow& row : target_rows()) {
    for (int stride : {row.components - 1, 0, -1, INT_MIN}) {
      for (int order : {1, 2}) {
        expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_COLOR_4 + row.offset, 0, 1, stride, order);
      }
    }
  }
}

TEST_F(Map1, DomainMustNotBeEmpty) {
  for (double u : {0.0, 1.0, -2.5, 1e30, kInfinity}) {
    expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_VERTEX_3, u, u, 3, 2);
  }
  expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_VERTEX_3, 0.0, -0.0, 3, 2);
}

TEST_F(Map1, NullPointsAreRefused) {
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, nullptr); });
}

TEST_F(Map1, NotBetweenBeginAndEnd) {
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { define(GLEV_MAP1_VERTEX_3, 0, 2, 3, 2); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                               [&] { glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 2, 3, 2, doubles.data()); });
}

TEST_F(Map1, NotWithAnotherActiveTexture) {
  for (glev_enum unit : {1, GLEV_TEXTURE_UNITS - 1}) {
    glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
    for (const TargetRow& row : target_rows()) {
      expect_rejected_forms(GLEV_INVALID_OPERATION, GLEV_MAP1_COLOR_4 + row.offset, 0, 2, 4, 2);
    }
  }
  glevActiveTexture(gl, GLEV_TEXTURE0);
  expect_accepted([&] { define(GLEV_MAP1_VERTEX_3, 0, 2, 3, 2); });
}

TEST_F(Map1, ErrorsOfArgumentsComeBeforeErrorsOfState) {
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  expect_rejected(GLEV_INVALID_ENUM, [&] { define(GLEV_MAP2_VERTEX_3, 0, 1, 3, 2); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { define(GLEV_MAP1_VERTEX_3, 0, 1, 3, 0); });
  glevActiveTexture(gl, GLEV_TEXTURE0);
  expect_rejected_in_primitive(GLEV_INVALID_ENUM, [&] { define(0, 0, 1, 3, 2); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { define(GLEV_MAP1_VERTEX_3, 0, 1, 2, 2); });
}

TEST_F(Map1, AFailingCallLeavesADefinedMapAlone) {
  define(GLEV_MAP1_VERTEX_3, 3, 7, 3, 5);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  floats.fill(99);
  doubles.fill(99);
  expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_VERTEX_3, 0, 1, 2, 4);
  expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_VERTEX_3, 0, 0, 3, 4);
  expect_rejected_forms(GLEV_INVALID_VALUE, GLEV_MAP1_VERTEX_3, 0, 1, 3, kMax + 1);
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { define(GLEV_MAP1_VERTEX_3, 0, 2, 3, 2); });
}

// ---- What is accepted

TEST_F(Map1, EveryOrderOfEveryTargetIsKept) {
  for (const TargetRow& row : target_rows()) {
    const glev_enum target = GLEV_MAP1_COLOR_4 + row.offset;
    for (int order = 1; order <= kMax; ++order) {
      expect_accepted([&] { define(target, 0, 1, row.components, order); });
      EXPECT_EQ(order_of(target), order);
      const std::size_t count = static_cast<std::size_t>(order) * row.components;
      EXPECT_EQ(coefficients_of(target, count),
                std::vector<double>(doubles.begin(), doubles.begin() + count));
    }
  }
}

TEST_F(Map1, StrideCountsValuesAndPaddingIsNotLookedAt) {
  for (const TargetRow& row : target_rows()) {
    const glev_enum target = GLEV_MAP1_COLOR_4 + row.offset;
    for (int stride : {row.components, row.components + 1, 2 * row.components, 17}) {
      std::vector<float> f(5 * stride, std::numeric_limits<float>::quiet_NaN());
      std::vector<double> d(5 * stride, kNaN);
      std::vector<double> expected;
      for (int i = 0; i < 5; ++i) {
        for (int k = 0; k < row.components; ++k) {
          f[i * stride + k] = static_cast<float>(d[i * stride + k] = 10 * i + k);
          expected.push_back(10 * i + k);
        }
      }
      expect_accepted([&] { glevMap1f(gl, target, 0, 1, stride, 5, f.data()); });
      EXPECT_EQ(coefficients_of(target, expected.size()), expected);
      define(target, 0, 1, 4, 5);
      expect_accepted([&] { glevMap1d(gl, target, 0, 1, stride, 5, d.data()); });
      EXPECT_EQ(coefficients_of(target, expected.size()), expected);
    }
  }
}

TEST_F(Map1, AHugeStrideWithOrderOneReadsOnePoint) {
  const float point[3] = {1, 2, 3};
  expect_accepted([&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, INT_MAX, 1, point); });
  EXPECT_EQ(coefficients_of(GLEV_MAP1_VERTEX_3, 3), (std::vector<double>{1, 2, 3}));
}

TEST_F(Map1, UnusualButLegalDomains) {
  for (auto [u1, u2] : {std::pair{1.0, 0.0}, {5.0, -2.0}, {-3.0, -1.0}, {1e9, -1e9}, {0.0, 0x1p-149}}) {
    expect_accepted([&, u1 = u1, u2 = u2] { define(GLEV_MAP1_VERTEX_4, u1, u2, 4, 3); });
    EXPECT_EQ(domain_of(GLEV_MAP1_VERTEX_4), (std::vector<double>{u1, u2})) << "not sorted, not rounded";
  }
}

TEST_F(Map1, PointsAreCopied) {
  define(GLEV_MAP1_VERTEX_3, 0, 1, 3, 4);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  const std::vector<double> before = query_state();
  floats.fill(77);
  EXPECT_EQ(query_state(), before);
  EXPECT_EQ(values_of(one_vertex([&] { glevEvalCoord1f(gl, 0); }).position), (Floats{1, 2, 3, 1}));
}

TEST_F(Map1, ASuccessfulCallReplacesThatTargetOnly) {
  for (const TargetRow& row : target_rows()) {
    std::fill(floats.begin(), floats.end(), static_cast<float>(row.offset) + 0.5f);
    define(GLEV_MAP1_COLOR_4 + row.offset, row.offset, 20, 4, static_cast<int>(row.offset) + 2);
  }
  for (const TargetRow& row : target_rows()) {
    const glev_enum target = GLEV_MAP1_COLOR_4 + row.offset;
    EXPECT_EQ(order_of(target), static_cast<int>(row.offset) + 2);
    EXPECT_EQ(domain_of(target), (std::vector<double>{static_cast<double>(row.offset), 20}));
    const std::size_t count = (row.offset + 2) * row.components;
    EXPECT_EQ(coefficients_of(target, count), std::vector<double>(count, row.offset + 0.5));
    int order2[3] = {-7, -7, -7};
    glevGetMapiv(gl, GLEV_MAP2_COLOR_4 + row.offset, GLEV_ORDER, order2);
    EXPECT_EQ(std::vector<int>(order2, order2 + 3), (std::vector<int>{1, 1, -7}));
    EXPECT_EQ(coefficients_of(GLEV_MAP2_COLOR_4 + row.offset, row.components), row.initial);
  }
  // lower, then higher order
  std::iota(floats.begin(), floats.end(), 1.0f);
  for (int order : {2, 60, 3}) {
    define(GLEV_MAP1_VERTEX_3, 0, 1, 3, order);
    EXPECT_EQ(order_of(GLEV_MAP1_VERTEX_3), order);
    EXPECT_EQ(coefficients_of(GLEV_MAP1_VERTEX_3, 3 * order),
              std::vector<double>(doubles.begin(), doubles.begin() + 3 * order));
  }
}

TEST_F(Map1, TheEnableIsNotTouched) {
  for (bool enabled : {false, true}) {
    for (const TargetRow& row : target_rows()) {
      const glev_enum target = GLEV_MAP1_COLOR_4 + row.offset;
      (enabled ? glevEnable : glevDisable)(gl, target);
      define(target, 0, 1, 4, 3);
      EXPECT_EQ(glevIsEnabled(gl, target), enabled ? GLEV_TRUE : GLEV_FALSE);
    }
  }
}

// ---- GetMap

TEST_F(Map1, FloatDataComesBackBitForBit) {
  const float given[] = {
      0.1f,        -0.0f,        0x1p-149f, -0x1.fffffcp-127f, std::numeric_limits<float>::max(),
      1.0f / 3.0f, -16777217.0f, 4.2e9f,    0x1p-126f};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0.1f, 1.0f / 3.0f, 3, 3, given);
  float got[9];
  glevGetMapfv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, got);
  EXPECT_EQ(std::memcmp(got, given, sizeof given), 0);
  float domain[2];
  glevGetMapfv(gl, GLEV_MAP1_VERTEX_3, GLEV_DOMAIN, domain);
  EXPECT_EQ(domain[0], 0.1f);
  EXPECT_EQ(domain[1], 1.0f / 3.0f);
}

TEST_F(Map1, DoubleDataComesBackBitForBit) {
  const double given[] = {0.1, -0.0, 0x1p-1074, -0x1.fffffffffffffp1023, 1.0 / 3.0, 1e300};
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0.1, 0.1 + 0x1p-56, 1, 6, given);
  double got[6];
  glevGetMapdv(gl, GLEV_MAP1_TEXTURE_COORD_1, GLEV_COEFF, got);
  EXPECT_EQ(std::memcmp(got, given, sizeof given), 0);
  EXPECT_EQ(domain_of(GLEV_MAP1_TEXTURE_COORD_1), (std::vector<double>{0.1, 0.1 + 0x1p-56}));
}

TEST_F(Map1, FormsShareTheState) {
  const double given[] = {1.0 / 3.0, 1e300, -1e300, kInfinity, -kInfinity};
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 5, given);
  float f[6] = {0, 0, 0, 0, 0, -7};
  glevGetMapfv(gl, GLEV_MAP1_TEXTURE_COORD_1, GLEV_COEFF, f);
  constexpr float kLargest = std::numeric_limits<float>::max(), kInf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(values_of(f), (Floats{1.0f / 3.0f, kLargest, -kLargest, kInf, -kInf, -7}))
      << "nearest representable";
  float order[2] = {0, -7};
  glevGetMapfv(gl, GLEV_MAP1_TEXTURE_COORD_1, GLEV_ORDER, order);
  EXPECT_EQ(values_of(order), (Floats{5, -7}));
}

TEST_F(Map1, IntegersAreRoundedToNearestAndSaturated) {
  const double given[] = {
      1.4,          -1.6,         2.51,          0.49999999999999994, -0.49999999999999994, 0.5,
      -0.5,         1e20,         -1e20,         kInfinity,           -kInfinity,           kNaN,
      2147483646.4, 2147483646.6, -2147483647.6, 2147483647.4};
  const std::vector<int> expected = {1,       -2,      3,       0, 0,          1,          -1,      INT_MAX,
                                     INT_MIN, INT_MAX, INT_MIN, 0, 2147483646, 2147483647, INT_MIN, INT_MAX};
  for (glev_enum target : {GLEV_MAP1_VERTEX_4, GLEV_MAP1_TEXTURE_COORD_4, GLEV_MAP1_COLOR_4}) {
    glevMap1d(gl, target, -1.6, 1e20, 4, 4, given);
    std::vector<int> got(17, -7);
    glevGetMapiv(gl, target, GLEV_COEFF, got.data());
    EXPECT_EQ(got.back(), -7);
    got.pop_back();
    EXPECT_EQ(got, expected);
    int domain[3] = {-7, -7, -7};
    glevGetMapiv(gl, target, GLEV_DOMAIN, domain);
    EXPECT_EQ(std::vector<int>(domain, domain + 3), (std::vector<int>{-2, INT_MAX, -7}));
  }
}

TEST_F(Map1, GetMapWritesNothingOnError) {
  double d = -7;
  float f = -7;
  int i = -7;
  const auto all = [&](glev_enum target, glev_enum query) {
    glevGetMapdv(gl, target, query, &d);
    glevGetMapfv(gl, target, query, &f);
    glevGetMapiv(gl, target, query, &i);
  };
  for (glev_enum target : {0, 0x0D8F, 0x0D99, 0x0DAF, 0x0DB9, GLEV_AUTO_NORMAL, 0x0DE1}) {
    for (glev_enum query : {GLEV_ORDER, GLEV_DOMAIN, GLEV_COEFF}) {
      expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetMapdv(gl, target, query, &d); });
      expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetMapfv(gl, target, query, &f); });
      expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetMapiv(gl, target, query, &i); });
    }
  }
  for (glev_enum query : {0x09FF, 0x0A03, GLEV_MAX_EVAL_ORDER}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { all(GLEV_MAP1_VERTEX_3, query); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { all(GLEV_MAP2_VERTEX_3, query); });
  }
  for (glev_enum query : {GLEV_ORDER, GLEV_DOMAIN, GLEV_COEFF}) {
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                                 [&] { glevGetMapdv(gl, GLEV_MAP1_INDEX, query, &d); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                                 [&] { glevGetMapfv(gl, GLEV_MAP1_INDEX, query, &f); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                                 [&] { glevGetMapiv(gl, GLEV_MAP1_INDEX, query, &i); });
  }
  EXPECT_EQ(d, -7);
  EXPECT_EQ(f, -7);
  EXPECT_EQ(i, -7);
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetMapdv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetMapfv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetMapiv(gl, GLEV_MAP1_INDEX, GLEV_ORDER, nullptr); });
}

TEST_F(Map1, GetMapIgnoresTheActiveTexture) {
  glevActiveTexture(gl, GLEV_TEXTURE0 + 3);
  expect_accepted([&] { EXPECT_EQ(order_of(GLEV_MAP1_TEXTURE_COORD_2), 1); });
}

}  // namespace
}  // namespace glev_tests
