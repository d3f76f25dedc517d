// Tests the bounds of FAST and of double results, as documented at glev_precision and glev_output, against
// exact rationals.
#include <cmath>
#include <limits>

#include "batches.h"
#include "exact.h"
#include "src/parameter.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::Grid, glev::GridArgument;

// A map of one component, or a component of it, and where it is evaluated.
struct GivenNet {
  std::array<int, 2> order = {1, 1};
  std::array<Domain, 2> domain;
  std::vector<double> points;  // v fastest

  Rational t_of(int direction, const GridArgument& at) const {
    return order[direction] == 1 ? Rational(0) : exact_t(domain[direction], at);
  }
  Rational value_at(const std::vector<double>& of, const GridArgument& u, const GridArgument& v) const {
    return exact_point(of, order, t_of(0, u), t_of(1, v)).value;
  }
};

class Precision : public ContextTest {
 protected:
  void define(const GivenNet& net) {
    const auto& [n, m] = net.order;
    const auto& [u, v] = net.domain;
    glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, u.u1, u.u2, m, n, v.u1, v.u2, 1, m, net.points.data());
    glevEnable(gl, GLEV_MAP2_TEXTURE_COORD_1);
  }

  void define(const GivenNet& net, const Grid& u, const Grid& v) {
    define(net);
    glevMapGrid2d(gl, u.segments, u.u1, u.u2, v.segments, v.u1, v.u2);
  }

  // Expects that FAST does not change the bits.
  void expect_rounded(const GivenNet& net, const Grid& u, const Grid& v, const Range& range) {
    define(net, u, v);
    const Plan plan(gl, 2);
    ASSERT_EQ(bits_of(evaluate_grid(plan, GLEV_ATTRIBUTE_TEXCOORD, range, GLEV_FAST)),
              bits_of(evaluate_grid(plan, GLEV_ATTRIBUTE_TEXCOORD, range)))
        << show(net, {u, range.i1}, {v, range.j1});
  }

  // Returns the largest error of the mesh in units of the bound of FAST.
  double worst_of_fast(const GivenNet& net, const Grid& u, const Grid& v, const Range& range) {
    define(net, u, v);
    const Plan plan(gl, 2);
    const Floats got = evaluate_grid(plan, GLEV_ATTRIBUTE_TEXCOORD, range, GLEV_FAST);
    double largest = 0, worst = 0;
    for (double point : net.points) largest = std::max(largest, std::fabs(point));
    const double bound = (6 * (net.order[0] + net.order[1] - 2) + 12) * 0x1p-24 * largest;
    std::size_t k = 0;
    for (int j = range.j1; j <= range.j2; ++j) {
      for (int i = range.i1; i <= range.i2; ++i) {
        const Rational exact = net.value_at(net.points, {u, i}, {v, j});
        const auto error = abs(to_rational(got[k++]) - exact).convert_to<double>();
        worst = std::max(worst, largest == 0 ? error * HUGE_VAL : error / bound);
      }
    }
    return worst;
  }

  // Expects that the error of a double result is within the documented bound.
  void expect_double(const GivenNet& net, const GridArgument& u, const GridArgument& v, double got) {
    const Sum<Rational> exact = exact_point(net.points, net.order, net.t_of(0, u), net.t_of(1, v));
    const Rational error = abs(to_rational(got) - exact.value);
    if (abs(exact.value) * (Integer(1) << 40) >= exact.magnitude) {
      const auto nearest = std::fabs(exact.value.convert_to<double>());
      const double ulp = std::nextafter(nearest, HUGE_VAL) - nearest;
      EXPECT_LE(error, to_rational(ulp)) << show(net, u, v) << " gives " << got;
    } else {
      const int units = 64 * (net.order[0] + net.order[1] - 2) + 64;
      EXPECT_LE(error * (Integer(1) << 105), units * exact.magnitude) << show(net, u, v) << " gives " << got;
    }
  }

  void expect_doubles(const GivenNet& net, const Grid& u, const Grid& v, const Range& range) {
    define(net, u, v);
    const Plan plan(gl, 2);
    const std::vector<double> got = evaluate_grid<double>(plan, GLEV_ATTRIBUTE_TEXCOORD, range);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const auto column = static_cast<int>(i % range.columns()), row = static_cast<int>(i / range.columns());
      expect_double(net, {u, range.i1 + column}, {v, range.j1 + row}, got[i]);
    }
  }
  void expect_doubles(const GivenNet& net, const std::vector<double>& u, const std::vector<double>& v) {
    define(net);
    const Plan plan(gl, 2);
    const std::vector<double> got = evaluate_scattered<double>(plan, GLEV_ATTRIBUTE_TEXCOORD, u, v);
    for (std::size_t i = 0; i < u.size(); ++i)
      expect_double(net, glev::argument_at(u[i]), glev::argument_at(v[i]), got[i]);
    EXPECT_EQ(bits_of(evaluate_scattered<double>(plan, GLEV_ATTRIBUTE_TEXCOORD, u, v, GLEV_FAST)),
              bits_of(got));
  }

  static std::string show(const GivenNet& net, const GridArgument& u, const GridArgument& v) {
    std::ostringstream out;
    out << std::hexfloat;
    for (int k : {0, 1}) {
      const auto& [grid, index] = k == 0 ? u : v;
      out << "order " << net.order[k] << " on [" << net.domain[k].u1 << ", " << net.domain[k].u2 << "] at "
          << index << " / " << grid.segments << " of [" << grid.u1 << ", " << grid.u2 << "]; ";
    }
    return out.str();
  }

  GivenNet choose_net(int most_order, const std::array<Domain, 2>& domain) {
    GivenNet net = {{chance_.whole(1, most_order), chance_.whole(1, most_order)}, domain, {}};
    for (int k = 0; k < net.order[0] * net.order[1]; ++k) net.points.push_back(4 * chance_.next_double() - 2);
    return net;
  }

  Chance chance_;
};

// ---- FAST

TEST_F(Precision, FastMeshesKeepTheirBound) {
  double worst = 0;
  for (int k = 0; k < 120; ++k) {
    const Domain domain = chance_.one_of({Domain{0, 1}, Domain{1, 0}, Domain{-0.3, 0.9}});
    GivenNet net = choose_net(k < 100 ? 6 : 30, {domain, Domain{0, 1}});
    // Data with maximal cancellation, and magnitudes at both ends of the documented range.
    for (std::size_t i = 0; i < net.points.size(); ++i) {
      if (k % 4 == 1) net.points[i] = i % 2 == 0 ? 1 : -1;
      if (k % 4 == 2) net.points[i] = std::ldexp(net.points[i] / 4, chance_.one_of({80, 79, 20}));
      if (k % 4 == 3) net.points[i] = std::ldexp(1, -80);
    }
    const Grid u = chance_.whole(0, 1) == 1 ? Grid{domain.u1, domain.u2, 23} : Grid{0.01, 0.87, 23};
    // Meshes of low degree with fewer segments would be correctly rounded.
    const int first = chance_.one_of({0, 300, 995});
    worst = std::max(worst, worst_of_fast(net, u, {0, 1, 1000}, {0, 23, first, first + 5}));
  }
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.01);  // the mesh is not correctly rounded
}

// Points on the boundary and outside are correctly rounded. All 40 arguments are in one block of vectors with
// some of these, or in the last block, which is not full.
TEST_F(Precision, FastScatteredPointsKeepTheirBound) {
  double worst = 0;
  const auto test = [&]<class Real>(Real, int k) {
    const Domain domain = chance_.one_of({Domain{0, 1}, Domain{1, 0}, Domain{-0.3, 0.9}, Domain{-2, 6}});
    GivenNet net = {{4, 4}, {domain, Domain{0, 1}}, {}};
    for (int i = 0; i < 16; ++i) {
      net.points.push_back(4 * chance_.next_double() - 2);
      if (k % 3 == 1) net.points.back() = i % 2 == 0 ? 1 : -1;
      if (k % 3 == 2) net.points.back() = std::ldexp(net.points.back() / 4, chance_.one_of({80, 79, 20}));
    }
    define(net);
    const Plan plan(gl, 2);
    std::vector<Real> u, v;
    for (int i = 0; i < 40; ++i) {
      const auto choose = [&](const Domain& of) {
        const double t = chance_.one_of({chance_.next_double(), chance_.next_double(), 0x1p-45,
                                         i < 20 ? 0.5 : 1.0, i < 20 ? 0.25 : 0.0, i < 20 ? 0.75 : 1.25});
        return static_cast<Real>(t == 1 ? of.u2 : of.u1 + t * (of.u2 - of.u1));
      };
      u.push_back(choose(domain)), v.push_back(choose(Domain{0, 1}));
    }
    const Floats got = evaluate_scattered(plan, GLEV_ATTRIBUTE_TEXCOORD, u, v, GLEV_FAST),
                 rounded = evaluate_scattered(plan, GLEV_ATTRIBUTE_TEXCOORD, u, v);
    double largest = 0;
    for (const double point : net.points) largest = std::max(largest, std::fabs(point));
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto is_inside = [](const Domain& of, double at) {
        return std::min(of.u1, of.u2) < at && at < std::max(of.u1, of.u2);
      };
      const GridArgument at_u = glev::argument_at(u[i]), at_v = glev::argument_at(v[i]);
      if (!is_inside(domain, u[i]) || !is_inside({0, 1}, v[i])) {
        EXPECT_EQ(float_bits(got[i]), float_bits(rounded[i])) << show(net, at_u, at_v);
        continue;
      }
      const Rational error = abs(to_rational(got[i]) - net.value_at(net.points, at_u, at_v));
      worst = std::max(worst, error.convert_to<double>() / (48 * 0x1p-24 * largest));
    }
  };
  for (int k = 0; k < 60; ++k) test(float{}, k), test(double{}, k);
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.02);  // results are not correctly rounded
}

// If the bound would not hold, results are correctly rounded.
TEST_F(Precision, FastIsCorrectlyRoundedOutsideTheDomainAndForExtremeMaps) {
  const Grid unit = {0, 1, 17}, many = {0, 1, 1000};
  for (int k = 0; k < 30; ++k) {
    GivenNet net = choose_net(5, {});
    net.order[0] = net.order[1] = 4;
    net.points = choose_net(1, {}).points;
    for (int i = 1; i < 16; ++i) net.points.push_back(chance_.next_double());
    expect_rounded(net, unit, many, {-1, 17, 0, 17});
    expect_rounded(net, unit, many, {0, 18, 0, 17});
    expect_rounded(net, unit, many, {0, 17, -1, 17});
    expect_rounded(net, unit, many, {0, 17, 985, 1001});
    expect_rounded(net, {-0x1p-60, 1, 17}, many, {0, 17, 0, 17});
    expect_rounded(net, unit, {0, 1 + 0x1p-52, 1000}, {0, 17, 983, 1000});
    for (double scale : {0x1p81, 0x1p120, 0x1p-82, 0x1p-140, 0x1p-1000}) {
      GivenNet extreme = net;
      for (double& point : extreme.points) point *= scale;
      extreme.points[0] = scale;
      expect_rounded(extreme, unit, many, {0, 17, 0, 17});
    }
  }
}

// Arguments outside the domain count in a direction of order 1, too.
TEST_F(Precision, FastIsCorrectlyRoundedOutsideTheDomainOfOrderOne) {
  for (int k = 0; k < 60; ++k) {
    const int across = k % 2;  // the direction of order 1
    GivenNet net = {{4, 4}, {}, {}};
    net.order[across] = 1;
    for (int i = 0; i < 4; ++i) net.points.push_back(chance_.next_double() - 0.5);
    const Grid beyond = {-0.25, chance_.one_of({0.75, 1.25}), 8}, unit = {0, 1, 2700};
    const Grid &u = across == 0 ? beyond : unit, &v = across == 0 ? unit : beyond;
    expect_rounded(net, u, v, {0, std::min(u.segments, 27), 0, std::min(v.segments, 27)});
  }
}

// Tests domains and grids near the largest double.
TEST_F(Precision, FastKeepsItsBoundInHugeDomains) {
  for (const double size : {0x1p899, 0x1p901, 1e300, 0x1p1000, 0x1p1022}) {
    for (int k = 0; k < 8; ++k) {
      const Domain domain = chance_.one_of({Domain{0, size}, Domain{-size, size}, Domain{-size, size / 2}});
      const GivenNet net = choose_net(5, {domain, domain});
      const Grid u = chance_.one_of({Grid{domain.u1, domain.u2, 9}, Grid{0, size / 4, 9}, Grid{0, 1, 9}}),
                 v = chance_.one_of({Grid{domain.u1, domain.u2, 5}, Grid{0, size / 4, 5}, Grid{0, 1, 5}});
      EXPECT_LE(worst_of_fast(net, u, v, {0, 9, 0, 5}), 1) << size;
    }
  }
}

TEST_F(Precision, FastZeroMapsAreZero) {
  EXPECT_EQ(worst_of_fast({{4, 4}, {}, std::vector<double>(16)}, {0, 1, 9}, {0, 1, 9}, {0, 9, 0, 9}), 0);
}

// Packed meshes of three components have their own code path. The meshes have more columns and rows than it
// processes at once, with and without partial vectors, on every instruction set.
TEST(FastMeshes, AreTheSamePackedAndApart) {
  constexpr std::size_t kApart = 5;
  Chance chance;
  on_every_instruction_set([&](glev_context* gl) {
    for (const auto& [columns, rows] :
         {std::pair{1, 1}, {15, 3}, {16, 64}, {17, 65}, {511, 2}, {513, 130}, {1100, 1}}) {
      for (int order = 1; order <= 5; ++order) {
        std::vector<double> points(static_cast<std::size_t>(order) * 4 * 3);
        for (double& point : points) point = 2 * chance.next_double() - 1;
        glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, order, 0, 1, 3, 4, points.data());
        glevEnable(gl, GLEV_MAP2_VERTEX_3);
        const int first = chance.whole(0, 3);
        glevMapGrid2d(gl, columns + 5, 0, chance.whole(0, 3) == 0 ? 0.75 : 1, rows + (1 << 14), 0, 1);
        const Plan plan(gl, 2);
        const Range range = {first, first + columns - 1, 1, rows};
        const Floats packed = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, range, GLEV_FAST);
        const Floats apart = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, range, GLEV_FAST, kApart, -7.0f);
        Floats found;
        for (std::size_t i = 0; i < apart.size(); ++i) {
          if (i % kApart < 3)
            found.push_back(apart[i]);
          else
            ASSERT_EQ(apart[i], -7);
        }
        ASSERT_EQ(bits_of(packed), bits_of(found)) << "order " << order << ", " << columns << " by " << rows;
      }
    }
  });
}

// Patches that share a corner have no crack there.
TEST(FastMeshes, GoThroughTheirCorners) {
  Chance chance;
  on_every_instruction_set([&](glev_context* gl) {
    for (int k = 0; k < 1500; ++k) {
      const int order = chance.whole(2, 5), segments = k < 1200 ? k + 1 : chance.whole(1200, 1 << 21);
      std::vector<float> points(static_cast<std::size_t>(order) * 4 * 3);
      for (float& point : points) point = static_cast<float>(2 * chance.next_double() - 1);
      glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, order, 0, 1, 3, 4, points.data());
      glevEnable(gl, GLEV_MAP2_VERTEX_3);
      glevMapGrid2d(gl, segments, 0, 1, segments, 0, 1);
      const Plan plan(gl, 2);
      const auto expect = [&](int i, int j) {
        const int near = std::min(segments, 40);
        const Range range = i == 0 ? Range{0, near, j, j} : Range{segments - near, segments, j, j};
        Floats got = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, range, GLEV_FAST);
        got.erase(i == 0 ? got.begin() + 3 : got.begin(), i == 0 ? got.end() : got.end() - 3);
        const float* const point = &points[(i == 0 ? 0 : (order - 1) * 12) + (j == 0 ? 0 : 9)];
        EXPECT_EQ(bits_of(got), bits_of(Floats(point, point + 3)))
            << "order " << order << ", " << segments << " segments, " << i << ", " << j;
      };
      for (const int i : {0, segments}) expect(i, 0), expect(i, segments);
    }
  });
}

// ---- Double results

TEST_F(Precision, DoubleResultsOfScatteredPointsKeepTheirBound) {
  for (int k = 0; k < 150; ++k) {
    const Domain domain = chance_.one_of({Domain{0, 1}, Domain{1, 0}, Domain{-0.3, 0.9}, Domain{100, 100.5}});
    GivenNet net = choose_net(k < 130 ? 5 : 16, {domain, Domain{0, 1}});
    for (std::size_t i = 0; i < net.points.size(); ++i) {
      if (k % 3 == 1) net.points[i] = i % 2 == 0 ? 1 : -1;
      if (k % 3 == 2) net.points[i] = std::round(net.points[i] * 4);
    }
    std::vector<double> u, v;
    for (int i = 0; i < 12; ++i) {
      const double t =
          chance_.one_of({chance_.next_double(), chance_.next_double(), 0.5, 1.75, 0x1p-50, 0.0, 1.0});
      u.push_back(domain.u1 + t * (domain.u2 - domain.u1));
      v.push_back(chance_.one_of({chance_.next_double(), 0.5, -0.25, 1.0}));
    }
    expect_doubles(net, u, v);
  }
}

TEST_F(Precision, DoubleResultsOfMeshesKeepTheirBound) {
  for (int k = 0; k < 60; ++k) {
    const GivenNet net = choose_net(5, {Domain{0, 1}, Domain{-1, 2}});
    const Grid u = chance_.one_of({Grid{0, 1, 7}, Grid{1, 0, 7}, Grid{0.1, 0.7, 7}, Grid{-1, 3, 8}}),
               v = chance_.one_of({Grid{-1, 2, 3}, Grid{0.2, 1.1, 3}});
    expect_doubles(net, u, v, {-1, 9, 0, 3});
  }
}

// Float maps on grids that span the domain, and scattered arguments of curves, have their own code path.
TEST_F(Precision, DoubleResultsOfFloatMapsKeepTheirBound) {
  for (int k = 0; k < 120; ++k) {
    const Domain domain = chance_.one_of({Domain{0, 1}, Domain{1, 0}, Domain{-1, 1}, Domain{0.1, 0.7}});
    GivenNet net = choose_net(4, {domain, Domain{0, 1}});
    for (std::size_t i = 0; i < net.points.size(); ++i) {
      double& point = net.points[i];
      point = static_cast<float>(point);
      if (k % 4 == 1) point = i % 2 == 0 ? 0.1F : -0.1F;
      if (k % 4 == 2) point = std::round(point * 10) / 8;
      if (k % 4 == 3) point = 0.7F;
    }
    const Grid u = {domain.u1, domain.u2, chance_.one_of({1, 7, 8, 30})},
               v = {0, 1, chance_.one_of({1, 3, 4})};
    expect_doubles(net, u, v, {0, u.segments, 0, v.segments});
    net.points.resize(static_cast<std::size_t>(net.order[0]));
    net.order[1] = 1;
    glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, domain.u1, domain.u2, 1, net.order[0], net.points.data());
    glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
    const Plan curve(gl, 1);
    std::vector<double> at = {domain.u1, domain.u2, 0, 0.5, 1, -7, 0x1p-30, 0x1p-1074};
    for (int i = 0; i < 15; ++i) at.push_back(domain.u1 + chance_.next_double() * (domain.u2 - domain.u1));
    const std::vector<double> values = evaluate_scattered<double>(curve, GLEV_ATTRIBUTE_TEXCOORD, at);
    for (std::size_t i = 0; i < at.size(); ++i)
      expect_double(net, glev::argument_at(at[i]), glev::argument_at(0), values[i]);
  }
}

// Tests magnitudes up to the limits of the documented bound, and beyond.
TEST_F(Precision, DoubleResultsOfLargeAndSmallMagnitudesKeepTheirBound) {
  for (double scale : {0x1p299, 0x1p-299, 0x1p350, 0x1p-350, 0x1p398, 0x1p-400}) {
    for (bool is_domain : {false, true}) {
      for (int k = 0; k < 12; ++k) {
        GivenNet net = choose_net(4, {});
        const double width = is_domain ? scale : 1;
        if (is_domain) net.domain[0] = {0, scale};
        for (double& point : net.points) {
          point = is_domain ? point : std::fabs(point) < 0.25 ? 0 : point * scale;
        }
        expect_doubles(net, {width * 0.25, width / 3, width * chance_.next_double(), width},
                       std::vector<double>(4, chance_.next_double()));
      }
    }
  }
}

TEST_F(Precision, DoubleResultsAreExactWhereDoubleHoldsThem) {
  const GivenNet net = {{4, 1}, {}, {0, 1, 2, 3}};
  define(net);
  const Plan plan(gl, 2);
  const std::vector<double> u = {0, 0.25, 0.5, 0.75, 1, 3, -7};
  const std::vector<double> got = evaluate_scattered<double>(plan, GLEV_ATTRIBUTE_TEXCOORD, u, u);
  for (std::size_t i = 0; i < u.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(got[i]), std::bit_cast<std::uint64_t>(3 * u[i]));
}

}  // namespace
}  // namespace glev_tests
