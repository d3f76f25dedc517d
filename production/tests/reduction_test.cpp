// Degree reduction against differences in rational arithmetic.
#include "src/reduction.h"

#include <cfenv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "fixture.h"
#include "nearest.h"

namespace glev_tests {
namespace {

using Orders = std::array<int, 2>;
using Line = std::vector<Rational>;

constexpr double kTiny = 0x1p-1074, kHuge = std::numeric_limits<double>::max();

struct Net {
  Orders order;
  std::vector<double> points;  // v fastest
};

// Compares zeros by sign as well.
bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

Net Reduced(const Net& net, std::ptrdiff_t stride = 1) {
  std::vector<double> spread(net.points.size() * stride, kNaN);
  for (std::size_t i = 0; i < net.points.size(); ++i) spread[i * stride] = net.points[i];
  Net result = {{}, std::vector<double>(net.points.size(), kNaN)};
  result.order = glev::Reduce({spread.data(), stride, net.order, {}}, result.points.data());
  result.points.resize(static_cast<std::size_t>(result.order[0]) * result.order[1]);
  return result;
}

// ---- The oracle

Rational Choose(int n, int k) {
  Rational result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

// The k-th forward differences at the first point.
Line Differences(Line points) {
  Line differences;
  while (!points.empty()) {
    differences.push_back(points.front());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) points[i] = points[i + 1] - points[i];
    points.pop_back();
  }
  return differences;
}

int DegreeOf(const Line& points) {
  const Line differences = Differences(points);
  int degree = static_cast<int>(points.size()) - 1;
  while (degree > 0 && differences[degree] == 0) --degree;
  return degree;
}

// The control points at another degree, not below that of the curve.
Line AtDegree(const Line& points, int degree) {
  const int n = static_cast<int>(points.size()) - 1;
  const Line differences = Differences(points);
  Line result(degree + 1);
  for (int j = 0; j <= degree; ++j) {
    for (int k = 0; k <= std::min(j, n); ++k) {
      if (differences[k] != 0) result[j] += Choose(j, k) / Choose(degree, k) * Choose(n, k) * differences[k];
    }
  }
  return result;
}

bool IsDouble(const Rational& x) {
  if (x == 0) return true;
  Integer significand = abs(numerator(x)), ones = denominator(x);
  const int zeros = static_cast<int>(lsb(significand)), twos = static_cast<int>(lsb(ones));
  significand >>= zeros;
  const int width = static_cast<int>(msb(significand)) + 1, exponent = zeros - twos;
  return (ones >> twos) == 1 && width <= 53 && exponent >= -1074 && exponent + width <= 1024;
}

std::vector<Line> Lines(const Net& net, int direction) {
  std::vector<Line> lines(net.order[1 - direction]);
  for (int i = 0; i < net.order[0]; ++i) {
    for (int j = 0; j < net.order[1]; ++j) {
      lines[direction == 0 ? j : i].push_back(Exactly(net.points[i * net.order[1] + j]));
    }
  }
  return lines;
}

// The lowest order in one direction.
int LowestOrder(const Net& net, int direction) {
  const std::vector<Line> lines = Lines(net, direction);
  int lowest = 0;
  for (const Line& line : lines) lowest = std::max(lowest, DegreeOf(line));
  for (;; ++lowest) {
    bool doubles = true;
    for (const Line& line : lines) {
      for (const Rational& point : AtDegree(line, lowest)) doubles = doubles && IsDouble(point);
      if (!doubles) break;
    }
    if (doubles) return lowest + 1;
  }
}

// That both nets are the same polynomial and neither direction of the second can go down alone.
void ExpectReduced(const Net& net) {
  const Net reduced = Reduced(net);
  ASSERT_LE(reduced.order[0], net.order[0]);
  ASSERT_LE(reduced.order[1], net.order[1]);
  for (int direction : {0, 1}) EXPECT_EQ(reduced.order[direction], LowestOrder(reduced, direction));
  // Elevated again, v first.
  const std::vector<Line> rows = Lines(reduced, 1);
  std::vector<Line> wide;
  for (const Line& row : rows) wide.push_back(AtDegree(row, net.order[1] - 1));
  for (int j = 0; j < net.order[1]; ++j) {
    Line column;
    for (const Line& row : wide) column.push_back(row[j]);
    column = AtDegree(column, net.order[0] - 1);
    for (int i = 0; i < net.order[0]; ++i) ASSERT_EQ(column[i], Exactly(net.points[i * net.order[1] + j]));
  }
  EXPECT_TRUE(SameBits(Reduced(net, 3).points, reduced.points));
  EXPECT_TRUE(SameBits(Reduced(reduced).points, reduced.points));
}

void ExpectUnchanged(const Net& net) {
  const Net reduced = Reduced(net);
  EXPECT_EQ(reduced.order, net.order);
  EXPECT_TRUE(SameBits(reduced.points, net.points));
}

class Reduction : public ::testing::Test {
 protected:
  int Below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  // Control points of these orders, integers times a power of two, of a polynomial of these degrees or lower
  // ones.
  Net Elevated(const Orders& order, const Orders& degree, int exponent) {
    std::vector<int> differences((degree[0] + 1) * (degree[1] + 1));
    for (int& difference : differences) difference = Below(19) - 9;
    Net net = {order, {}};
    for (int i = 0; i < order[0]; ++i) {
      for (int j = 0; j < order[1]; ++j) {
        Rational point = 0;
        for (int k = 0; k <= std::min(i, degree[0]); ++k) {
          for (int l = 0; l <= std::min(j, degree[1]); ++l) {
            point += Choose(i, k) * Choose(j, l) * differences[k * (degree[1] + 1) + l];
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
  // At degree 7 its points are no doubles.
  Net line = {{10, 1}, {}};
  for (int i = 0; i < 10; ++i) line.points.push_back(i);
  const Net reduced = Reduced(line);
  EXPECT_EQ(reduced.order, (Orders{2, 1}));
  EXPECT_EQ(reduced.points, (std::vector<double>{0, 9}));
  line.order = {1, 10};
  EXPECT_EQ(Reduced(line).order, (Orders{1, 2}));
  line.points[4] = std::nextafter(4.0, 5);
  ExpectUnchanged(line);
}

TEST_F(Reduction, ConstantsAndZeros) {
  for (int order : {1, 2, 3, 10, 64}) {
    for (double value : {0.1, kTiny, -kHuge, 0.0, 3.0}) {
      const Net reduced = Reduced({{order, 1}, std::vector<double>(order, value)});
      EXPECT_EQ(reduced.order, (Orders{1, 1}));
      EXPECT_TRUE(SameBits(reduced.points, {value}));
    }
  }
  EXPECT_EQ(Reduced({{64, 64}, std::vector<double>(64 * 64, -0.0)}).order, (Orders{1, 1}));
  EXPECT_TRUE(SameBits(Reduced({{2, 1}, {-0.0, -0.0}}).points, {0.0}));
  ExpectUnchanged({{1, 1}, {-0.0}});
  ExpectUnchanged({{2, 2}, {-0.0, 1, 2, -0.0}});
}

TEST_F(Reduction, CurvesOfEveryDegree) {
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const int order = 1 + Below(i % 20 == 0 ? 64 : 14);
    ExpectReduced(Elevated({order, 1}, {Below(std::min(order, 7)), 0}, Below(1900) - 1070));
  }
}

TEST_F(Reduction, OneBitIsEnoughToKeepTheOrder) {
  for (int i = 0; i < 200; ++i) {
    const int order = 3 + Below(62);
    Net net = Elevated({order, 1}, {Below(std::min(order - 1, 5)), 0}, 0);
    double& point = net.points[Below(order)];
    point = std::nextafter(point, Below(2) == 0 ? kHuge : -kHuge);
    if (point != 0 && std::fabs(point) < 0x1p-300) continue;  // too wide to see, so kept anyway
    ExpectUnchanged(net);
  }
}

TEST_F(Reduction, Surfaces) {
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const Orders order = {1 + Below(9), 1 + Below(9)};
    const Orders degree = {Below(std::min(order[0], 4)), Below(std::min(order[1], 4))};
    Net net = Elevated(order, degree, 0);
    ExpectReduced(net);
    // One row or column that is of another degree than the rest keeps all of them.
    if (order[0] < 3 || order[1] < 3) continue;
    net.points[Below(order[0] * order[1])] += 1;
    ExpectUnchanged(net);
  }
  ExpectReduced(Elevated({30, 30}, {1, 2}, -40));
}

TEST_F(Reduction, RowsMayBeFarApart) {
  // Each row is constant, the widest floats one below the other.
  Net net = {{3, 4}, {}};
  for (double value : {0x1p-149, 0x1.fffffep127, -0x1p-140}) net.points.insert(net.points.end(), 4, value);
  const Net reduced = Reduced(net);
  EXPECT_EQ(reduced.order, (Orders{3, 1}));
  EXPECT_EQ(reduced.points, (std::vector<double>{0x1p-149, 0x1.fffffep127, -0x1p-140}));
  // The whole range of float in a row, cubic by its points and quadratic by its polynomial.
  ExpectReduced({{4, 1}, {0x1p-149, 0x1p-149, 0x1p-149, 0x1.8p127}});
  ExpectReduced({{4, 1}, {0, 0, 0x1p127, 3 * 0x1p127}});
}

TEST_F(Reduction, RowsAgreeOnADegree) {
  // Two curves of degree 4, by their differences at degree 11: the first has doubles at 4, the second at 5,
  // where the first has none; both have only at 11.
  Net net = {{2, 12}, {}};
  for (const std::array<int, 5>& differences : {std::array{0, -1, -3, -1, -2}, std::array{0, 0, 1, 0, -1}}) {
    for (int j = 0; j < 12; ++j) {
      Rational point = 0;
      for (int k = 0; k <= 4; ++k) point += k <= j ? Choose(j, k) * differences[k] : 0;
      net.points.push_back(point.convert_to<double>());
    }
  }
  EXPECT_EQ(Reduced({{1, 12}, {net.points.begin(), net.points.begin() + 12}}).order, (Orders{1, 5}));
  EXPECT_EQ(Reduced({{1, 12}, {net.points.begin() + 12, net.points.end()}}).order, (Orders{1, 6}));
  ExpectUnchanged(net);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    ExpectReduced(Elevated({2, 8 + Below(6)}, {1, 3 + Below(4)}, 0));
  }
}

TEST_F(Reduction, WhatIsTooWideStays) {
  // 0 modulo any 448 bits.
  ExpectUnchanged({{3, 1}, {0x1p-599, 0x1p-600, 1}});
  ExpectUnchanged({{3, 1}, {-0x1p1000, 0x1p-1000, 0x1p1000}});
  // Not a line only by 2^-1074: the bits that decide are far apart.
  ExpectUnchanged({{3, 1}, {-1, kTiny, 1}});
  ExpectReduced({{3, 1}, {-kHuge, 0, kHuge}});
  ExpectReduced({{3, 1}, {-kTiny, 0, kTiny}});
}

TEST_F(Reduction, PointsThatAreNoDoublesAtTheTrueDegree) {
  // Thirds, and too many bits: cubics of order 5 and 6.
  int kept = 0;
  for (int i = 0; i < 200; ++i) {
    const Net net = Elevated({5 + i % 3, 1}, {3, 0}, 0);
    ExpectReduced(net);
    kept += Reduced(net).order == net.order;
  }
  EXPECT_GT(kept, 20);
  EXPECT_LT(kept, 180);
}

TEST_F(Reduction, TheEndsOfTheRangeOfDouble) {
  // (0, x, x, 0) is (0, 3x/2, 0).
  const auto order = [](double x) { return Reduced({{4, 1}, {0, x, x, 0}}).order[0]; };
  EXPECT_EQ(order(2 * 0x1.8p52), 3);
  EXPECT_EQ(order(2 * (0x1p53 + 1) / 3), 4);  // 2^53 + 1 has 54 bits
  EXPECT_EQ(order(2 * (0x1p53 - 2) / 3), 3);
  EXPECT_EQ(order(kTiny), 4);
  EXPECT_EQ(order(2 * kTiny), 3);
  EXPECT_EQ(order(0x1p1022), 3);
  EXPECT_EQ(order(-0x1.5555555555554p1023), 3);
  EXPECT_EQ(order(0x1.5555555555556p1023), 4);
  EXPECT_EQ(order(0x1.8p1023), 4);
  for (double x : {0x1p52, 2 * kTiny, 0x1p1022, -0x1.5555555555554p1023})
    ExpectReduced({{4, 1}, {0, x, x, 0}});
}

TEST_F(Reduction, RandomDataIsKept) {
  for (int i = 0; i < 300; ++i) {
    Net net = {{2 + Below(20), 1 + Below(20)}, {}};
    for (int k = 0; k < net.order[0] * net.order[1]; ++k) {
      const double value = static_cast<double>(random_() >> 11) * 0x1p-53 - 0.5;
      net.points.push_back(i % 2 == 0 ? value : static_cast<float>(value));
    }
    ExpectUnchanged(net);
  }
}

TEST_F(Reduction, TheRoundingModeHasNoInfluence) {
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (int i = 0; i < 50; ++i) {
      const Net net = Elevated({6, 4}, {2, 1}, -1070);
      const Net expected = Reduced(net);
      std::fesetround(mode);
      const Net got = Reduced(net);
      std::fesetround(FE_TONEAREST);
      EXPECT_EQ(got.order, expected.order);
      EXPECT_TRUE(SameBits(got.points, expected.points));
    }
  }
}

TEST_F(Reduction, ResultsStayTheSame) {
  for (int i = 0; i < 300; ++i) {
    const Orders order = {1 + Below(9), 1 + Below(9)};
    const Net net = Elevated(order, {Below(std::min(order[0], 3)), Below(std::min(order[1], 3))}, -10);
    const Net reduced = Reduced(net);
    const std::array<glev::Domain, 2> domain = {glev::Domain{0.1, 0.7}, glev::Domain{2, -1}};
    const auto at = [&](double u) { return glev::GridArgument{{u, u, 1}, 0}; };
    const double u = Below(1000) / 900.0, v = Below(1000) / 300.0 - 1;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(
                  glev::RoundExactly({net.points.data(), 1, net.order, domain}, at(u), at(v))),
              std::bit_cast<std::uint32_t>(
                  glev::RoundExactly({reduced.points.data(), 1, reduced.order, domain}, at(u), at(v))));
  }
}

}  // namespace
}  // namespace glev_tests
