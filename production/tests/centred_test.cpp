// Tests maps in powers of x = t - s and y against rational arithmetic: their coefficients, and the bound of
// Horner's rule with them.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "exact.h"
#include "fixture.h"
#include "src/prepared_map.h"

namespace glev_tests {
namespace {

using glev::PreparedMap;

struct Centred {
  std::array<int, 2> order;
  int components;
  std::vector<double> points, scaled, lowest, coefficients;
  PreparedMap map;

  Centred(std::array<int, 2> orders, int count, std::vector<double> given)
      : order(orders),
        components(count),
        points(std::move(given)),
        scaled(points.size() + 3),
        lowest(points.size()),
        coefficients(glev::centred_values(3, 3)),
        map(glev::prepare_map(points.data(), order, components, {}, scaled.data(), lowest.data(),
                              coefficients.data())) {}

  Rational value_at(int k, const Rational& x, const Rational& y) const {
    return exact_point(points, order, (1 + x) / 2, (1 + y) / 2, {}, components, k).value;
  }

  double coefficient(int i, int j, int k) const { return map.centred[4 * (order[0] * j + i) + k]; }

  // Returns component k by Horner's rule, with numbers of type T.
  template <class T, class From>
  T sum_of(int k, const T& x, const T& y, const From& from) const {
    T result = 0;
    for (int i = order[0] - 1; i >= 0; --i) {
      T row = 0;
      for (int j = order[1] - 1; j >= 0; --j) row = row * y + from(coefficient(i, j, k));
      result = result * x + row;
    }
    return result;
  }

  double largest_of(int k) const {
    double largest = 0;
    for (std::size_t i = k; i < points.size(); i += components)
      largest = std::max(largest, std::fabs(points[i]));
    return largest;
  }

  // Returns the units of the bound for coefficients that are exact or not.
  double error_units(int k, bool is_exact) const {
    double sum = 0;
    for (int i = 0; i < order[0] * order[1]; ++i) sum += std::fabs(map.centred[4 * i + k]);
    return glev::centred_units(order[0] - 1, order[1] - 1, sum / largest_of(k), is_exact);
  }
};

class CentredMaps : public ::testing::Test {
 protected:
  // Returns a map with control points of one or many magnitudes, as floats, integers or doubles, or with
  // maximal cancellation.
  Centred choose(int kind) {
    std::uniform_int_distribution<int> order(1, 4), components(1, 4), whole(-9, 9), exponent(-60, 0),
        bits(40, 52);
    std::uniform_real_distribution<double> value(-1, 1);
    const std::array<int, 2> orders = {order(random_), order(random_)};
    const int count = components(random_);
    std::vector<double> points(static_cast<std::size_t>(orders[0]) * orders[1] * count);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double& point = points[i];
      if (kind == 0) point = static_cast<float>(value(random_));
      if (kind == 1) point = whole(random_) + 100;
      if (kind == 2) point = value(random_);
      if (kind == 3) point = std::ldexp(static_cast<float>(value(random_)), exponent(random_));
      if (kind == 4) point = (i / count % orders[1] + i / count / orders[1]) % 2 == 0 ? 0.1 : -0.1;
    }
    return {orders, count, points};
  }

  static bool is_taken_as_exact(const Centred& given, int k) {
    const double units = given.map.centred_test.error[k] / given.map.component[k].unit - 2;
    const bool is_exact = std::fabs(units - given.error_units(k, true)) < 1e-6;
    EXPECT_NEAR(units, given.error_units(k, is_exact), 1e-6);
    return is_exact;
  }

  // Polynomials that agree at this many places are equal.
  static void expect_exact(const Centred& given, int k) {
    for (int i = 0; i < given.order[0]; ++i) {
      for (int j = 0; j < given.order[1]; ++j) {
        const Rational x = 2 * i - 3, y = 2 * j - 3;
        EXPECT_EQ(given.sum_of(k, x, y, to_rational), given.value_at(k, x, y)) << "seed " << kSeed;
      }
    }
  }

  std::mt19937 random_{kSeed};
};

TEST_F(CentredMaps, CoefficientsThatAreTakenAsExactAre) {
  std::array<int, 2> taken{};
  for (int round = 0; round < 1500; ++round) {
    const Centred given = choose(round % 5);
    for (int k = 0; k < given.components; ++k) {
      if (given.largest_of(k) == 0) continue;
      ++taken[is_taken_as_exact(given, k)];
      if (is_taken_as_exact(given, k)) expect_exact(given, k);
    }
  }
  EXPECT_GT(taken[0], 500);
  EXPECT_GT(taken[1], 500);
}

// The coefficients have as many bits as a double can hold, or more.
TEST_F(CentredMaps, CoefficientsOfManyBitsAreExactOrNotTakenAsThat) {
  std::array<int, 2> taken{};
  for (int round = 0; round < 500; ++round) {
    std::uniform_real_distribution<double> value(-1, 1);
    std::vector<double> points(16);
    for (double& point : points) point = std::rint(std::ldexp(value(random_), 43 + round % 5));
    const Centred given({4, 4}, 1, points);
    ++taken[is_taken_as_exact(given, 0)];
    if (is_taken_as_exact(given, 0)) expect_exact(given, 0);
  }
  EXPECT_GT(taken[0], 100);
  EXPECT_GT(taken[1], 200);
}

TEST_F(CentredMaps, TheFloatsOfOrdinaryDataAreExact) {
  std::uniform_real_distribution<double> value(-1, 1);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> points(16);
    for (double& point : points) point = static_cast<float>(value(random_) + (round % 2 == 0 ? 3 : 0));
    const Centred given({4, 4}, 1, points);
    EXPECT_NEAR(given.map.centred_test.error[0] / given.map.component[0].unit - 2, given.error_units(0, true),
                1e-6);
  }
}

TEST_F(CentredMaps, HornersRuleKeepsTheBound) {
  std::uniform_real_distribution<double> place(-1, 1);
  double worst = 0;
  for (int round = 0; round < 3000; ++round) {
    const Centred given = choose(round % 5);
    const auto& [n, m] = given.map.surface.degree;
    for (int k = 0; k < given.components; ++k) {
      if (given.largest_of(k) == 0) continue;
      EXPECT_GE(given.map.centred_test.error[k], given.map.test.error[k] * (1 - 0x1p-40));
      // The bound without the errors of x and y.
      const double unit = given.map.component[k].unit,
                   bound = given.map.centred_test.error[k] - (4 * (n + m) + 8) * unit;
      for (int i = 0; i < 4; ++i) {
        const double x = i == 0 ? 1 : place(random_), y = i == 1 ? -1 : place(random_);
        const double got = given.sum_of(k, x, y, [](double c) { return c; });
        const Rational error = abs(to_rational(got) - given.value_at(k, to_rational(x), to_rational(y)));
        worst = std::max(worst, error.convert_to<double>() / bound);
      }
    }
  }
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.02);  // with a much larger bound, too many values would be undecided
}

// Zero components of flat patches are decided in double.
TEST_F(CentredMaps, ZeroIsCertain) {
  const Centred given({4, 4}, 2, std::vector<double>(32));
  EXPECT_EQ(given.map.centred_test.error[0], 0);
  EXPECT_EQ(given.map.centred_test.error[1], 0);
}

TEST_F(CentredMaps, NothingIsClaimedForWhatIsNotFinite) {
  std::vector<double> points(16, 1.0);
  points[5] = kNaN;
  EXPECT_EQ(Centred({4, 4}, 1, points).map.centred_test.error[0], HUGE_VAL);
  points[5] = 0x1p1000;
  EXPECT_EQ(Centred({4, 4}, 1, points).map.centred_test.error[0], HUGE_VAL);
}

}  // namespace
}  // namespace glev_tests
