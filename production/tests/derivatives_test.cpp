// Compares first and second derivatives with exact rationals: floats must be correctly rounded, and doubles
// within one ULP.
#include <cmath>

#include "batches.h"
#include "exact.h"
#include "src/parameter.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::Grid, glev::GridArgument;

struct DerivativeRow {
  glev_attribute attribute;
  std::array<int, 2> order;  // by u and v
};
constexpr DerivativeRow kDerivativeRows[] = {{GLEV_ATTRIBUTE_TANGENT_U, {1, 0}},
                                             {GLEV_ATTRIBUTE_TANGENT_V, {0, 1}},
                                             {GLEV_ATTRIBUTE_SECOND_UU, {2, 0}},
                                             {GLEV_ATTRIBUTE_SECOND_UV, {1, 1}},
                                             {GLEV_ATTRIBUTE_SECOND_VV, {0, 2}}};
constexpr std::size_t kComponents = 3;

struct Patch {
  std::array<int, 2> order;
  std::array<Domain, 2> domain;
  std::vector<double> points;  // v fastest
};

class Derivatives : public ContextTest {
 protected:
  void define(const Patch& patch) {
    const auto [n, m] = patch.order;
    const auto& [u, v] = patch.domain;
    glevMap2d(gl, GLEV_MAP2_VERTEX_3, u.u1, u.u2, 3 * m, n, v.u1, v.u2, 3, m, patch.points.data());
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    ASSERT_EQ(glevGetError(gl), glev_enum{GLEV_NO_ERROR});
  }

  static Rational exact(const Patch& patch, const DerivativeRow& row, std::size_t k, const GridArgument& u,
                        const GridArgument& v) {
    Rational width = 1;
    for (const std::size_t d : {0, 1}) {
      const Domain& domain = patch.domain[d];
      for (int i = 0; i < row.order[d]; ++i) width *= to_rational(domain.u2) - to_rational(domain.u1);
    }
    return exact_point(patch.points, patch.order, exact_t(patch.domain[0], u), exact_t(patch.domain[1], v),
                       row.order, kComponents, k)
               .value /
           width;
  }

  // Expects right results at each argument. `rows`: the floats and doubles of an attribute, packed.
  void expect_right(const Patch& patch, const DerivativeRow& row, const std::vector<GridArgument>& u,
                    const std::vector<GridArgument>& v, const std::vector<float>& floats,
                    const std::vector<double>& doubles) {
    ASSERT_EQ(floats.size(), u.size() * kComponents);
    for (std::size_t at = 0; at < floats.size(); ++at) {
      const std::size_t e = at / kComponents;
      const Rational value = exact(patch, row, at % kComponents, u[e], v[e]);
      const float right = nearest_float(value);
      const auto where = [&] {
        std::ostringstream out;
        out << std::hexfloat << "attribute " << row.attribute << ", order " << patch.order[0] << " x "
            << patch.order[1] << ", element " << e << ", component " << at % kComponents << ", u "
            << u[e].grid.u1 << " " << u[e].index << ", v " << v[e].grid.u1 << " " << v[e].index;
        return out.str();
      };
      ASSERT_EQ(float_bits(floats[at]), float_bits(right))
          << where() << std::hexfloat << ": " << floats[at] << ", not " << right;
      const auto nearest = std::fabs(value.convert_to<double>());
      const double ulp = std::nextafter(nearest, HUGE_VAL) - nearest;
      if (nearest < 0x1p1000) {
        ASSERT_FALSE(value == 0 && std::signbit(doubles[at])) << where();  // zeros are +0
        ASSERT_LE(abs(to_rational(doubles[at]) - value), to_rational(value == 0 ? 0 : ulp))
            << where() << std::hexfloat << ": " << doubles[at] << ", not " << nearest;
      }
    }
  }

  void expect_right_everywhere(const Patch& patch) {
    define(patch);
    std::vector<double> u, v;
    std::vector<GridArgument> at_u, at_v;
    const auto [domain_u, domain_v] = patch.domain;
    for (int i = 0; i < 8; ++i) {
      const auto argument = [&](const Domain& domain) {
        const double t = chance_.one_of({0.0, 1.0, 0.5, 0.25, 1.75, 0x1p-40, chance_.next_double(),
                                         chance_.next_double(), chance_.next_double()});
        return t == 1 ? domain.u2 : domain.u1 + t * (domain.u2 - domain.u1);
      };
      u.push_back(argument(domain_u)), v.push_back(argument(domain_v));
      at_u.push_back(glev::argument_at(u.back())), at_v.push_back(glev::argument_at(v.back()));
    }
    const auto part = [](const Domain& domain, double t) { return domain.u1 + t * (domain.u2 - domain.u1); };
    const bool spans = chance_.whole(0, 1) == 0;
    const Grid grid_u = {spans ? domain_u.u1 : part(domain_u, 0.1), spans ? domain_u.u2 : part(domain_u, 0.9),
                         3},
               grid_v = {domain_v.u2, domain_v.u1, chance_.one_of({2, 5})};
    const Range range = {0, 3, -1, 2};
    std::vector<GridArgument> grid_at_u, grid_at_v;
    for (int j = range.j1; j <= range.j2; ++j) {
      for (int i = range.i1; i <= range.i2; ++i)
        grid_at_u.push_back({grid_u, i}), grid_at_v.push_back({grid_v, j});
    }
    glevMapGrid2d(gl, grid_u.segments, grid_u.u1, grid_u.u2, grid_v.segments, grid_v.u1, grid_v.u2);
    const Plan plan(gl, 2);
    for (const DerivativeRow& row : kDerivativeRows) {
      ASSERT_EQ(glevGetPlanComponents(plan, row.attribute), kComponents);
      expect_right(patch, row, at_u, at_v, evaluate_scattered(plan, row.attribute, u, v),
                   evaluate_scattered<double>(plan, row.attribute, u, v));
      expect_right(patch, row, grid_at_u, grid_at_v, evaluate_grid(plan, row.attribute, range),
                   evaluate_grid<double>(plan, row.attribute, range));
      if (HasFailure()) return;
    }
  }

  // Returns the largest magnitude of component k of the control points of a derivative.
  static double largest_point(const Patch& patch, const DerivativeRow& row, std::size_t k) {
    std::array<int, 2> order = patch.order;
    std::vector<double> net;
    for (std::size_t i = k; i < patch.points.size(); i += kComponents) net.push_back(patch.points[i]);
    for (const std::size_t d : {0, 1}) {
      for (int time = 0; time < row.order[d] && order[d] > 0; ++time) {
        std::vector<double> next;
        const double factor = (order[d] - 1) / (patch.domain[d].u2 - patch.domain[d].u1);
        const std::size_t step = d == 0 ? static_cast<std::size_t>(order[1]) : 1;
        for (std::size_t i = 0; i < net.size(); ++i) {
          const auto index = static_cast<int>(d == 0 ? i / step : i % static_cast<std::size_t>(order[1]));
          if (index + 1 < order[d]) next.push_back(factor * (net[i + step] - net[i]));
        }
        --order[d];
        net = next;
      }
    }
    double largest = 0;
    for (const double point : net) largest = std::max(largest, std::fabs(point));
    return largest;
  }

  Patch choose_patch(int most_order) {
    Patch patch;
    patch.order = {chance_.whole(1, most_order), chance_.whole(1, most_order)};
    for (Domain& domain : patch.domain)
      domain =
          chance_.one_of({Domain{0, 1}, Domain{0, 1}, Domain{1, 0}, Domain{-0.3, 0.9}, Domain{100, 103}});
    return patch;
  }
  template <class Point>
  void fill(Patch& patch, const Point& point) {
    for (std::size_t i = 0; i < kComponents * static_cast<std::size_t>(patch.order[0] * patch.order[1]); ++i)
      patch.points.push_back(point());
  }

  Chance chance_;
};

TEST_F(Derivatives, OfFloatMapsAreRight) {
  for (int k = 0; k < 60 && !HasFailure(); ++k) {
    Patch patch = choose_patch(k < 55 ? 5 : 12);
    fill(patch, [&] { return chance_.between(-2, 2); });
    expect_right_everywhere(patch);
  }
}

// Ties and zeros are frequent.
TEST_F(Derivatives, OfIntegersAreRight) {
  for (int k = 0; k < 40 && !HasFailure(); ++k) {
    Patch patch = choose_patch(4);
    const double step = chance_.one_of({1.0, 0.25, 0x1p-25});
    fill(patch, [&] { return 1 + step * chance_.whole(-4, 4); });
    expect_right_everywhere(patch);
  }
}

// Differences are not doubles.
TEST_F(Derivatives, OfDoublesOfAllMagnitudesAreRight) {
  for (int k = 0; k < 60 && !HasFailure(); ++k) {
    Patch patch = choose_patch(4);
    const int range = chance_.one_of({0, 30, 100, 250});
    fill(patch, [&] { return std::ldexp(chance_.next_double() - 0.5, chance_.whole(-range, range)); });
    expect_right_everywhere(patch);
  }
}

// The derivative is much smaller than the differences.
TEST_F(Derivatives, ThatCancelAreRight) {
  for (int k = 0; k < 30 && !HasFailure(); ++k) {
    Patch patch = choose_patch(5);
    const int digits = chance_.one_of({10, 30, 45});
    const auto [n, m] = patch.order;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) {
        for (std::size_t c = 0; c < kComponents; ++c)
          patch.points.push_back(0.1 * i + 0.7 * j + 0.3 + std::ldexp(chance_.next_double(), -digits));
      }
    }
    expect_right_everywhere(patch);
  }
}

TEST_F(Derivatives, InExtremeDomainsAreRight) {
  for (const double size : {0x1p-200, 0x1p-60, 0x1p60, 0x1p149, 0x1p160, 1e300}) {
    Patch patch = choose_patch(4);
    patch.order = {4, 3};
    patch.domain = {Domain{0, size}, Domain{size, 3 * size}};
    if (size == 1e300) patch.domain[1] = {1, 0};
    fill(patch, [&] { return chance_.between(-2, 2); });
    expect_right_everywhere(patch);
  }
}

TEST_F(Derivatives, OfHighOrderAreRight) {
  for (const std::array<int, 2> order : {std::array{64, 3}, std::array{17, 16}}) {
    Patch patch = choose_patch(1);
    patch.order = order;
    fill(patch, [&] { return chance_.between(-2, 2); });
    expect_right_everywhere(patch);
  }
}

// There is no room for all components at a time.
TEST_F(Derivatives, OfTheLargestNetsAreRight) {
  for (const std::array<int, 2> order : {std::array{40, 41}, std::array{64, 64}}) {
    Patch patch = {order, {Domain{0, 1}, Domain{0, 1}}, {}};
    fill(patch, [&] { return chance_.between(-2, 2); });
    define(patch);
    const Plan plan(gl, 2);
    const std::vector<double> u = {chance_.next_double()}, v = {0.25};
    for (const DerivativeRow& row : {kDerivativeRows[0], kDerivativeRows[3]})
      expect_right(patch, row, {glev::argument_at(u[0])}, {glev::argument_at(v[0])},
                   evaluate_scattered(plan, row.attribute, u, v),
                   evaluate_scattered<double>(plan, row.attribute, u, v));
  }
}

TEST_F(Derivatives, ComponentsThatTheMapDoesNotHaveAreZero) {
  Patch patch = {{3, 3}, {Domain{0, 1}, Domain{0, 1}}, {}};
  fill(patch, [&] { return chance_.between(-2, 2); });
  for (const double last : {1.0, 0x1p-60}) {  // the differences with the last number are not doubles
    patch.points.back() = last;
    define(patch);
    const Plan plan(gl, 2);
    for (const DerivativeRow& row : kDerivativeRows) {
      const Floats at = {0.25F, 0.5F, 0.75F};
      Floats results(12, 7.0F);
      const glev_output output = output_to(results, 4);
      glev_batch batch = {sizeof batch, 3,       GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, input_of(at),
                          input_of(at), nullptr, 0};
      const Outputs outputs(batch, {{row.attribute, &output}});
      ASSERT_EQ(glevEvaluate(plan, &batch), GLEV_SUCCESS);
      for (const std::size_t element : {0, 1, 2}) EXPECT_EQ(results[4 * element + 3], 0) << row.attribute;
    }
  }
}

// The bound of FAST holds with the control points of the derivative.
TEST_F(Derivatives, FastKeepsItsBound) {
  double worst = 0;
  for (int k = 0; k < 20 && !HasFailure(); ++k) {
    Patch patch = choose_patch(6);
    patch.domain = {chance_.one_of({Domain{0, 1}, Domain{0.5, 0}, Domain{-4, 4}}), Domain{0, 1}};
    fill(patch, [&] { return chance_.between(-2, 2); });
    define(patch);
    const Grid grid_u = {patch.domain[0].u1, patch.domain[0].u2, 23}, grid_v = {0, 1, 1000};
    glevMapGrid2d(gl, 23, grid_u.u1, grid_u.u2, 1000, 0, 1);
    const Range range = {0, 23, 300, 302};
    const Plan plan(gl, 2);
    for (const DerivativeRow& row : kDerivativeRows) {
      const std::vector<float> got = evaluate_grid(plan, row.attribute, range, GLEV_FAST);
      const auto [n, m] = patch.order;
      const std::array<int, 2> degree = {n - 1 - row.order[0], m - 1 - row.order[1]};
      const double units = 6 * std::max(degree[0] + degree[1], 0) + 12;
      std::size_t at = 0;
      for (int j = range.j1; j <= range.j2; ++j) {
        for (int i = range.i1; i <= range.i2; ++i) {
          for (std::size_t c = 0; c < kComponents; ++c) {
            const Rational value = exact(patch, row, c, {grid_u, i}, {grid_v, j});
            const auto error = abs(to_rational(got[at++]) - value).convert_to<double>();
            const double largest = largest_point(patch, row, c);
            worst = std::max(worst, largest == 0 ? error * HUGE_VAL : error / (units * 0x1p-24 * largest));
          }
        }
      }
    }
  }
  EXPECT_LE(worst, 1);
  EXPECT_GT(worst, 0.01);  // results are not correctly rounded
}

}  // namespace
}  // namespace glev_tests
