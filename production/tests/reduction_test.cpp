// Tests degree reduction against differences in rational arithmetic.
#include "src/reduction.h"

#include <cfenv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "exact.h"
#include "fixture.h"

namespace glev_tests {
namespace {

using Orders = std::array<int, 2>;
using Line = std::vector<Rational>;

constexpr double kSmallestDouble = 0x1p-1074, kLargestDouble = std::numeric_limits<double>::max();

struct Net {
  Orders order;
  std::vector<double> points;  // v fastest
};

// Returns true if all numbers are equal, including the signs of zeros.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

Net reduce_net(const Net& net, std::ptrdiff_t stride = 1) {
  std::vector<double> spread(net.points.size() * stride, kNaN);
  for (std::size_t i = 0; i < net.points.size(); ++i) spread[i * stride] = net.points[i];
  Net result = {{}, std::vector<double>(net.points.size(), kNaN)};
  result.order = glev::reduce({spread.data(), stride, net.order, {}}, result.points.data());
  result.points.resize(static_cast<std::size_t>(result.order[0]) * result.order[1]);
  return result;
}

// ---- The oracle

Rational choose(int n, int k) {
  Rational result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

// Returns the forward differences of all orders at the first point.
Line forward_differences(Line points) {
  Line differences;
  while (!points.empty()) {
    differences.push_back(points.front());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) points[i] = points[i + 1] - points[i];
    points.pop_back();
  }
  return differences;
}

int degree_of(const Line& points) {
  const Line differences = forward_differences(points);
  int degree = static_cast<int>(points.size()) - 1;
  while (degree > 0 && differences[degree] == 0) --degree;
  return degree;
}

// Returns the control points of the curve at a degree that is not lower.
Line elevate_to_degree(const Line& points, int degree) {
  const int n = static_cast<int>(points.size()) - 1;
  const Line differences = forward_differences(points);
  Line result(degree + 1);
  for (int j = 0; j <= degree; ++j) {
    for (int k = 0; k <= std::min(j, n); ++k) {
      if (differences[k] != 0) result[j] += choose(j, k) / choose(degree, k) * choose(n, k) * differences[k];
    }
  }
  return result;
}

bool is_double(const Rational& x) {
  if (x == 0) return true;
  Integer significand = abs(numerator(x)), ones = denominator(x);
  const int zeros = static_cast<int>(lsb(significand)), twos = static_cast<int>(lsb(ones));
  significand >>= zeros;
  const int width = static_cast<int>(msb(significand)) + 1, exponent = zeros - twos;
  return (ones >> twos) == 1 && width <= 53 && exponent >= -1074 && exponent + width <= 1024;
}

std::vector<Line> lines_of(const Net& net, int direction) {
  std::vector<Line> lines(net.order[1 - direction]);
  for (int i = 0; i < net.order[0]; ++i) {
    for (int j = 0; j < net.order[1]; ++j) {
      lines[direction == 0 ? j : i].push_back(to_rational(net.points[i * net.order[1] + j]));
    }
  }
  return lines;
}

// Returns the lowest order in one direction.
int lowest_order(const Net& net, int direction) {
  const std::vector<Line> lines = lines_of(net, direction);
  int lowest = 0;
  for (const Line& line : lines) lowest = std::max(lowest, degree_of(line));
  for (;; ++lowest) {
    bool doubles = true;
    for (const Line& line : lines) {
      for (const Rational& point : elevate_to_degree(line, lowest)) doubles = doubles && is_double(point);
      if (!doubles) break;
    }
    if (doubles) return lowest + 1;
  }
}

// Expects that the reduced net is the same polynomial and cannot be reduced further in either direction.
void expect_reduced(const Net& net) {
  const Net reduced = reduce_net(net);
  ASSERT_LE(reduced.order[0], net.order[0]);
  ASSERT_LE(reduced.order[1], net.order[1]);
  for (int direction : {0, 1}) EXPECT_EQ(reduced.order[direction], lowest_order(reduced, direction));
  // Elevates the reduced net again, v first.
  const std::vector<Line> rows = lines_of(reduced, 1);
  std::vector<Line> wide;
  for (const Line& row : rows) wide.push_back(elevate_to_degree(row, net.order[1] - 1));
  for (int j = 0; j < net.order[1]; ++j) {
    Line column;
    for (const Line& row : wide) column.push_back(row[j]);
    column = elevate_to_degree(column, net.order[0] - 1);
    for (int i = 0; i < net.order[0]; ++i)
      ASSERT_EQ(column[i], to_rational(net.points[i * net.order[1] + j]));
  }
  EXPECT_TRUE(same_bits(reduce_net(net, 3).points, reduced.points));
  EXPECT_TRUE(same_bits(reduce_net(reduced).points, reduced.points));
}

void expect_unchanged(const Net& net) {
  const Net reduced = reduce_net(net);
  EXPECT_EQ(reduced.order, net.order);
  EXPECT_TRUE(same_bits(reduced.points, net.points));
}

class Reduction : public ::testing::Test {
 protected:
  int integer_below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  // Returns a net of these orders, with integers times a power of two, of a polynomial of at most these
  // degrees.
  Net elevated(const Orders& order, const Orders& degree, int exponent) {
    std::vector<int> differences((degree[0] + 1) * (degree[1] + 1));
    for (int& difference : differences) difference = integer_below(19) - 9;
    Net net = {order, {}};
    for (int i = 0; i < order[0]; ++i) {
      for (int j = 0; j < order[1]; ++j) {
        Rational point = 0;
        for (int k = 0; k <= std::min(i, degree[0]); ++k) {
          for (int l = 0; l <= std::min(j, degree[1]); ++l) {
            point += choose(i, k) * choose(j, l) * differences[k * (degree[1] + 1) + l];
          }
        }
        net.points.push_back(std::ldexp(point.convert_to<double>(), exponent));
      }
    }
    return net;
  }

  std::mt19937_64 random_{kSeed};
};

TEST_F(Reduction, ALineOfOrderTen) {
  // At degree 7, the control points are not doubles.
  Net line = {{10, 1}, {}};
  for (int i = 0; i < 10; ++i) line.points.push_back(i);
  const Net reduced = reduce_net(line);
  EXPECT_EQ(reduced.order, (Orders{2, 1}));
  EXPECT_EQ(reduced.points, (std::vector<double>{0, 9}));
  line.order = {1, 10};
  EXPECT_EQ(reduce_net(line).order, (Orders{1, 2}));
  line.points[4] = std::nextafter(4.0, 5);
  expect_unchanged(line);
}

TEST_F(Reduction, ConstantsAndZeros) {
  for (int order : {1, 2, 3, 10, 64}) {
    for (double value : {0.1, kSmallestDouble, -kLargestDouble, 0.0, 3.0}) {
      const Net reduced = reduce_net({{order, 1}, std::vector<double>(order, value)});
      EXPECT_EQ(reduced.order, (Orders{1, 1}));
      EXPECT_TRUE(same_bits(reduced.points, {value}));
    }
  }
  EXPECT_EQ(reduce_net({{64, 64}, std::vector<double>(64 * 64, -0.0)}).order, (Orders{1, 1}));
  EXPECT_TRUE(same_bits(reduce_net({{2, 1}, {-0.0, -0.0}}).points, {0.0}));
  expect_unchanged({{1, 1}, {-0.0}});
  expect_unchanged({{2, 2}, {-0.0, 1, 2, -0.0}});
}

TEST_F(Reduction, CurvesOfEveryDegree) {
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const int order = 1 + integer_below(i % 20 == 0 ? 64 : 14);
    expect_reduced(elevated({order, 1}, {integer_below(std::min(order, 7)), 0}, integer_below(1900) - 1070));
  }
}

TEST_F(Reduction, OneBitIsEnoughToKeepTheOrder) {
  for (int i = 0; i < 200; ++i) {
    const int order = 3 + integer_below(62);
    Net net = elevated({order, 1}, {integer_below(std::min(order - 1, 5)), 0}, 0);
    double& point = net.points[integer_below(order)];
    point = std::nextafter(point, integer_below(2) == 0 ? kLargestDouble : -kLargestDouble);
    if (point != 0 && std::fabs(point) < 0x1p-300) continue;  // the range is too wide for a reduction
    expect_unchanged(net);
  }
}

TEST_F(Reduction, Surfaces) {
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const Orders order = {1 + integer_below(9), 1 + integer_below(9)};
    const Orders degree = {integer_below(std::min(order[0], 4)), integer_below(std::min(order[1], 4))};
    Net net = elevated(order, degree, 0);
    expect_reduced(net);
    // A single row or column of a higher degree prevents the reduction of all.
    if (order[0] < 3 || order[1] < 3) continue;
    net.points[integer_below(order[0] * order[1])] += 1;
    expect_unchanged(net);
  }
  expect_reduced(elevated({30, 30}, {1, 2}, -40));
}

TEST_F(Reduction, RowsMayBeFarApart) {
  // Each row is constant; the rows have the whole range of float.
  Net net = {{3, 4}, {}};
  for (double value : {0x1p-149, 0x1.fffffep127, -0x1p-140}) net.points.insert(net.points.end(), 4, value);
  const Net reduced = reduce_net(net);
  EXPECT_EQ(reduced.order, (Orders{3, 1}));
  EXPECT_EQ(reduced.points, (std::vector<double>{0x1p-149, 0x1.fffffep127, -0x1p-140}));
  // A row has the whole range of float; it has order 4, and its polynomial is quadratic.
  expect_reduced({{4, 1}, {0x1p-149, 0x1p-149, 0x1p-149, 0x1.8p127}});
  expect_reduced({{4, 1}, {0, 0, 0x1p127, 3 * 0x1p127}});
}

TEST_F(Reduction, RowsAgreeOnADegree) {
  // Two curves of degree 4, given by their differences at degree 11. The control points of the first are
  // doubles at degree 4, but not at 5; those of the second not below degree 5. Only at degree 11 are all of
  // them doubles.
  Net net = {{2, 12}, {}};
  for (const std::array<int, 5>& differences : {std::array{0, -1, -3, -1, -2}, std::array{0, 0, 1, 0, -1}}) {
    for (int j = 0; j < 12; ++j) {
      Rational point = 0;
      for (int k = 0; k <= 4; ++k) point += k <= j ? choose(j, k) * differences[k] : 0;
      net.points.push_back(point.convert_to<double>());
    }
  }
  EXPECT_EQ(reduce_net({{1, 12}, {net.points.begin(), net.points.begin() + 12}}).order, (Orders{1, 5}));
  EXPECT_EQ(reduce_net({{1, 12}, {net.points.begin() + 12, net.points.end()}}).order, (Orders{1, 6}));
  expect_unchanged(net);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    expect_reduced(elevated({2, 8 + integer_below(6)}, {1, 3 + integer_below(4)}, 0));
  }
}

TEST_F(Reduction, WhatIsTooWideStays) {
  // The second difference is 0 in any window of 448 bits.
  expect_unchanged({{3, 1}, {0x1p-599, 0x1p-600, 1}});
  expect_unchanged({{3, 1}, {-0x1p1000, 0x1p-1000, 0x1p1000}});
  // The curve differs from a line only by 2^-1074: the relevant bits are far apart.
  expect_unchanged({{3, 1}, {-1, kSmallestDouble, 1}});
  expect_reduced({{3, 1}, {-kLargestDouble, 0, kLargestDouble}});
  expect_reduced({{3, 1}, {-kSmallestDouble, 0, kSmallestDouble}});
}

TEST_F(Reduction, PointsThatAreNoDoublesAtTheTrueDegree) {
  // Cubics of order 5 and 6, whose control points need thirds or too many bits.
  int kept = 0;
  for (int i = 0; i < 200; ++i) {
    const Net net = elevated({5 + i % 3, 1}, {3, 0}, 0);
    expect_reduced(net);
    kept += reduce_net(net).order == net.order;
  }
  EXPECT_GT(kept, 20);
  EXPECT_LT(kept, 180);
}

TEST_F(Reduction, TheEndsOfTheRangeOfDouble) {
  // The cubic (0, x, x, 0) is the quadratic (0, 3x/2, 0).
  const auto order = [](double x) { return reduce_net({{4, 1}, {0, x, x, 0}}).order[0]; };
  EXPECT_EQ(order(2 * 0x1.8p52), 3);
  EXPECT_EQ(order(2 * (0x1p53 + 1) / 3), 4);  // 2^53 + 1 has 54 bits
  EXPECT_EQ(order(2 * (0x1p53 - 2) / 3), 3);
  EXPECT_EQ(order(kSmallestDouble), 4);
  EXPECT_EQ(order(2 * kSmallestDouble), 3);
  EXPECT_EQ(order(0x1p1022), 3);
  EXPECT_EQ(order(-0x1.5555555555554p1023), 3);
  EXPECT_EQ(order(0x1.5555555555556p1023), 4);
  EXPECT_EQ(order(0x1.8p1023), 4);
  for (double x : {0x1p52, 2 * kSmallestDouble, 0x1p1022, -0x1.5555555555554p1023})
    expect_reduced({{4, 1}, {0, x, x, 0}});
}

TEST_F(Reduction, RandomDataIsKept) {
  for (int i = 0; i < 300; ++i) {
    Net net = {{2 + integer_below(20), 1 + integer_below(20)}, {}};
    for (int k = 0; k < net.order[0] * net.order[1]; ++k) {
      const double value = static_cast<double>(random_() >> 11) * 0x1p-53 - 0.5;
      net.points.push_back(i % 2 == 0 ? value : static_cast<float>(value));
    }
    expect_unchanged(net);
  }
}

TEST_F(Reduction, TheRoundingModeHasNoInfluence) {
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (int i = 0; i < 50; ++i) {
      const Net net = elevated({6, 4}, {2, 1}, -1070);
      const Net expected = reduce_net(net);
      std::fesetround(mode);
      const Net got = reduce_net(net);
      std::fesetround(FE_TONEAREST);
      EXPECT_EQ(got.order, expected.order);
      EXPECT_TRUE(same_bits(got.points, expected.points));
    }
  }
}

TEST_F(Reduction, ResultsStayTheSame) {
  for (int i = 0; i < 300; ++i) {
    const Orders order = {1 + integer_below(9), 1 + integer_below(9)};
    const Net net =
        elevated(order, {integer_below(std::min(order[0], 3)), integer_below(std::min(order[1], 3))}, -10);
    const Net reduced = reduce_net(net);
    const std::array<glev::Domain, 2> domain = {glev::Domain{0.1, 0.7}, glev::Domain{2, -1}};
    const auto at = [&](double u) { return glev::GridArgument{{u, u, 1}, 0}; };
    const double u = integer_below(1000) / 900.0, v = integer_below(1000) / 300.0 - 1;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(
                  glev::round_exactly({net.points.data(), 1, net.order, domain}, at(u), at(v))),
              std::bit_cast<std::uint32_t>(
                  glev::round_exactly({reduced.points.data(), 1, reduced.order, domain}, at(u), at(v))));
  }
}

}  // namespace
}  // namespace glev_tests
