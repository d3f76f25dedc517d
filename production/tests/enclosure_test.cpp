// Double-double enclosures contain the exact value: those of enclosure.h and those of every instruction set.
#include <cmath>
#include <random>
#include <vector>

#include "fixture.h"
#include "nearest.h"
#include "src/enclosure.h"
#include "src/kernels.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::GridArgument;

class Enclosures : public ::testing::Test {
 protected:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int Whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  // Multiples of 2^-30 below 1, so that differences are doubles, and what vectors may read behind them.
  std::vector<double> Points(std::array<int, 2> order) {
    std::vector<double> points;
    for (int i = 0; i < order[0] * order[1]; ++i) points.push_back(Whole(-(1 << 30), 1 << 30) * 0x1p-30);
    points.resize(points.size() + 3, 0);
    return points;
  }

  static double Largest(const std::vector<double>& points) {
    double largest = 0;
    for (const double point : points) largest = std::max(largest, std::fabs(point));
    return largest;
  }

  static Rational T(int order, const Domain& domain, const GridArgument& at) {
    return order == 1 ? Rational(0) : ExactT(domain, at);
  }

  static void ExpectContains(const glev::Enclosure& enclosure, const Fraction& exact, const char* name) {
    ASSERT_LT(enclosure.error, kInfinity) << name;
    const Rational value = Exactly(enclosure.value.high) + Exactly(enclosure.value.low);
    EXPECT_LE(abs(value - Rational(exact.numerator, exact.denominator)), Exactly(enclosure.error)) << name;
  }

  static void Check(std::array<int, 2> order, const std::vector<double>& points,
                    const std::array<Domain, 2>& domain, const GridArgument& u, const GridArgument& v) {
    const glev::Component component = {points.data(), 1, order, domain};
    const Rational t_u = T(order[0], domain[0], u), t_v = T(order[1], domain[1], v);
    const Fraction exact = ExactValue(points, order, t_u, t_v);
    ExpectContains(glev::Enclose(component, Largest(points), u, v), exact, "Enclose");
    for (std::size_t i = 0; const glev::Kernels* kernels = glev::KernelsOf(i); ++i)
      ExpectContains(kernels->encloses(component, Largest(points), u, v), exact, kernels->name);
  }

  // The derivatives are polynomials of the differences times the degree.
  static void CheckDerivative(std::array<int, 2> order, const std::vector<double>& points,
                              const std::array<Domain, 2>& domain, int direction, const GridArgument& u,
                              const GridArgument& v) {
    std::array<int, 2> lower = order;
    --lower[direction];
    std::vector<double> differences;
    for (int i = 0; i < lower[0]; ++i) {
      for (int j = 0; j < lower[1]; ++j) {
        const int here = i * order[1] + j, next = direction == 0 ? here + order[1] : here + 1;
        differences.push_back(points[next] - points[here]);
      }
    }
    const Rational t_u = T(lower[0], domain[0], u), t_v = T(lower[1], domain[1], v);
    Fraction exact = ExactValue(differences, lower, t_u, t_v);
    exact.numerator *= order[direction] - 1;
    const glev::Component component = {points.data(), 1, order, domain};
    ExpectContains(glev::EncloseDerivative(component, direction, u, v), exact, "EncloseDerivative");
  }

  std::mt19937_64 random_{kSeed};
};

constexpr std::array<int, 2> kOrders[] = {{2, 1}, {4, 1}, {10, 1}, {33, 1}, {64, 1}, {1, 4},
                                          {3, 3}, {4, 4}, {8, 5},  {2, 20}, {20, 2}};

TEST_F(Enclosures, ContainValuesInsideAndOutsideTheDomain) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const std::array<Domain, 2> domain = {Domain{Between(-1, 0), Between(0.1, 1)}, {Between(2, 3), 0.3}};
      const double reach = trial % 3 == 2 ? 8 : 0;
      const auto argument = [&](const Domain& in) {
        return glev::At(in.u1 + Between(-reach, 1 + reach) * (in.u2 - in.u1));
      };
      Check(order, Points(order), domain, argument(domain[0]), argument(domain[1]));
    }
  }
}

TEST_F(Enclosures, ContainValuesAtPointsOfGrids) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const Domain domain = {Between(-1, 0), Between(0.1, 1)};
      const bool against = trial % 2 == 1;
      const glev::Grid grid = {against ? domain.u2 : domain.u1, against ? domain.u1 : domain.u2,
                               Whole(1, 1000000)};
      const auto argument = [&] { return GridArgument{grid, Whole(-10, grid.segments + 10)}; };
      Check(order, Points(order), {domain, domain}, argument(), argument());
    }
  }
}

// Points of long grids in short domains: the argument is a difference of large numbers.
TEST_F(Enclosures, ContainValuesWhereArgumentsCancel) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const int segments = Whole(900000, 1000000), index = Whole(1, segments - 1);
      // Ends of different magnitudes, so that multiples of their difference do not fit into two doubles.
      const glev::Grid grid = {Between(-7, -3), std::ldexp(Between(1, 2), -45), segments};
      const double middle = grid.u1 + (grid.u2 - grid.u1) * index / segments;
      const double width = std::ldexp(Between(1, 2), -Whole(5, 24));
      const Domain domain = {middle - Between(0, 1) * width, middle + Between(0.1, 1) * width};
      const GridArgument at = {grid, index};
      Check(order, Points(order), {domain, domain}, at, at);
    }
  }
}

TEST_F(Enclosures, ContainDerivatives) {
  for (const std::array<int, 2> order : kOrders) {
    for (int trial = 0; trial < 12; ++trial) {
      const std::array<Domain, 2> domain = {Domain{Between(-1, 0), Between(0.1, 1)}, {Between(2, 3), 0.3}};
      const GridArgument u = glev::At(Between(domain[0].u1, domain[0].u2)),
                         v = glev::At(Between(domain[1].u2, domain[1].u1));
      for (const int direction : {0, 1}) {
        if (order[direction] > 1) CheckDerivative(order, Points(order), domain, direction, u, v);
      }
    }
  }
}

}  // namespace
}  // namespace glev_tests
