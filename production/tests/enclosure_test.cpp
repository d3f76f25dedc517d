// Tests that double-double enclosures contain the exact value: those of enclosure.h and of every instruction
// set.
#include <cmath>
#include <random>
#include <vector>

#include "exact.h"
#include "fixture.h"
#include "src/enclosure.h"
#include "src/kernels.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::GridArgument;

class Enclosures : public ::testing::Test {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  // Returns control points that are multiples of 2^-30 below 1, so that differences are doubles, and padding
  // that vectors may read.
  std::vector<double> random_points(std::array<int, 2> order) {
    std::vector<double> points;
    for (int i = 0; i < order[0] * order[1]; ++i) points.push_back(whole(-(1 << 30), 1 << 30) * 0x1p-30);
    points.resize(points.size() + 3, 0);
    return points;
  }

  static double largest_of(const std::vector<double>& points) {
    double largest = 0;
    for (const double point : points) largest = std::max(largest, std::fabs(point));
    return largest;
  }

  static Rational t_of(int order, const Domain& domain, const GridArgument& at) {
    return order == 1 ? Rational(0) : exact_t(domain, at);
  }

  static void expect_contains(const glev::Enclosure& enclosure, const Rational& exact, const char* name) {
    ASSERT_LT(enclosure.error, kInfinity) << name;
    const Rational value = to_rational(enclosure.value.high) + to_rational(enclosure.value.low);
    EXPECT_LE(abs(value - exact), to_rational(enclosure.error)) << name;
  }

  static void check(std::array<int, 2> order, const std::vector<double>& points,
                    const std::array<Domain, 2>& domain, const GridArgument& u, const GridArgument& v) {
    const glev::Component component = {points.data(), 1, order, domain};
    const Rational t_u = t_of(order[0], domain[0], u), t_v = t_of(order[1], domain[1], v);
    const Rational exact = exact_point(points, order, t_u, t_v).value;
    expect_contains(glev::enclose(component, largest_of(points), u, v), exact, "Enclose");
    for (std::size_t i = 0; const glev::Kernels* kernels = glev::kernels_of(i); ++i)
      expect_contains(kernels->encloses(component, largest_of(points), u, v), exact, kernels->name);
  }

  // Checks a derivative. For each order, it is the polynomial of the differences, times the degree.
  static void check_derivative(const std::array<int, 2>& order, const std::vector<double>& points,
                               const std::array<Domain, 2>& domain, const glev::Derivative& derivative,
                               const GridArgument& u, const GridArgument& v) {
    std::array<int, 2> lower = order;
    std::vector<double> differences = points;
    Integer factor = 1;
    for (const int direction : {0, 1}) {
      for (int k = 0; k < derivative[direction]; ++k) {
        const int row = lower[1];
        const std::vector<double> from = differences;
        factor *= --lower[direction];
        if (factor == 0) return;
        differences.clear();
        for (int i = 0; i < lower[0]; ++i) {
          for (int j = 0; j < lower[1]; ++j) {
            const int here = i * row + j;
            differences.push_back(from[direction == 0 ? here + row : here + 1] - from[here]);
          }
        }
      }
    }
    const Rational t_u = t_of(lower[0], domain[0], u), t_v = t_of(lower[1], domain[1], v);
    const Rational exact = factor * exact_point(differences, lower, t_u, t_v).value;
    const glev::Component component = {points.data(), 1, order, domain};
    expect_contains(glev::enclose_derivative(component, derivative, u, v), exact, "EncloseDerivative");
  }

  std::mt19937_64 random_{kSeed};
};

constexpr std::array<int, 2> kOrders[] = {{2, 1}, {4, 1}, {10, 1}, {33, 1}, {64, 1}, {1, 4},
                                          {3, 3}, {4, 4}, {8, 5},  {2, 20}, {20, 2}};

TEST_F(Enclosures, ContainValuesInsideAndOutsideTheDomain) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const std::array<Domain, 2> domain = {Domain{between(-1, 0), between(0.1, 1)}, {between(2, 3), 0.3}};
      const double reach = trial % 3 == 2 ? 8 : 0;
      const auto argument = [&](const Domain& in) {
        return glev::argument_at(in.u1 + between(-reach, 1 + reach) * (in.u2 - in.u1));
      };
      check(order, random_points(order), domain, argument(domain[0]), argument(domain[1]));
    }
  }
}

TEST_F(Enclosures, ContainValuesAtPointsOfGrids) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const Domain domain = {between(-1, 0), between(0.1, 1)};
      const bool against = trial % 2 == 1;
      const glev::Grid grid = {against ? domain.u2 : domain.u1, against ? domain.u1 : domain.u2,
                               whole(1, 1000000)};
      const auto argument = [&] { return GridArgument{grid, whole(-10, grid.segments + 10)}; };
      check(order, random_points(order), {domain, domain}, argument(), argument());
    }
  }
}

// Points of long grids in short domains: the argument is a difference of large numbers.
TEST_F(Enclosures, ContainValuesWhereArgumentsCancel) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const int segments = whole(900000, 1000000), index = whole(1, segments - 1);
      // Ends of different magnitudes, so that multiples of their difference do not fit into two doubles.
      const glev::Grid grid = {between(-7, -3), std::ldexp(between(1, 2), -45), segments};
      const double middle = grid.u1 + (grid.u2 - grid.u1) * index / segments;
      const double width = std::ldexp(between(1, 2), -whole(5, 24));
      const Domain domain = {middle - between(0, 1) * width, middle + between(0.1, 1) * width};
      const GridArgument at = {grid, index};
      check(order, random_points(order), {domain, domain}, at, at);
    }
  }
}

TEST_F(Enclosures, ContainDerivatives) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const std::array<Domain, 2> domain = {Domain{between(-1, 0), between(0.1, 1)}, {between(2, 3), 0.3}};
      const GridArgument u = glev::argument_at(between(domain[0].u1, domain[0].u2)),
                         v = glev::argument_at(between(domain[1].u2, domain[1].u1));
      for (const glev::Derivative& derivative : {glev::Derivative{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}})
        check_derivative(order, random_points(order), domain, derivative, u, v);
    }
  }
}

}  // namespace
}  // namespace glev_tests
