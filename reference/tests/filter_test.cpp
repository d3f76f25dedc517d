// Tests that the enclosures of the filter contain the exact values on every instruction set, and that decided
// values are correctly rounded.
#include <gtest/gtest.h>
#include <reference/filter.h>
#include <reference/rounding.h>

#include <cmath>
#include <functional>
#include <limits>

#include "filter/bound.h"
#include "random_data.h"

namespace evalcts::reference {
namespace {

struct Domain {
  double first, last;
};

const std::vector<Domain> kDomains{{0, 1},
                                   {1, 0},
                                   {2, 5},
                                   {-3, -1},
                                   {0.1f, 0.7f},
                                   {0.1, 0.7},
                                   {1000, 1000 + 0x1p-20},
                                   {-0x1p60, 0x1p60},
                                   {0, 0x1p-149},
                                   {1e9, -1e-9},
                                   {-1e-300, 1e300}};

// Returns coordinates in the domain, near its ends, outside, far outside, and extreme ones.
std::vector<double> coordinates(std::mt19937_64& random, const Domain& domain, std::size_t count) {
  std::vector<double> result(count);
  for (double& x : result) {
    const double width = domain.last - domain.first;
    switch (pick(random, 0, 6)) {
      case 0:
        x = pick(random, 0, 1) == 0 ? domain.first : domain.last;
        break;
      case 1:
        x = domain.first + width * std::ldexp(uniform(random, -1, 1), pick(random, -90, 0));
        break;
      case 2:
        x = domain.first + width * std::ldexp(uniform(random, -1, 1), pick(random, 0, 9));
        break;
      case 3:
        x = pick(random, 0, 60) == 0 ? any_double(random) : domain.last;
        break;
      default:
        x = domain.first + width * uniform(random, 0, 1);
        if (pick(random, 0, 1) == 0) x = static_cast<float>(x);
    }
    if (!std::isfinite(x)) x = domain.first;
  }
  return result;
}

// Coordinates, or indices of a grid over the domain or another one.
struct TestDirection {
  Domain domain;
  std::vector<double> values;
  std::optional<Arguments::Grid> grid;

  Arguments arguments() const { return {values, grid}; }
  Argument at(std::size_t k) const {
    if (values.empty()) return {};  // the v of a curve
    if (!grid) return Argument::coordinate(values[k]);
    return Argument::grid(static_cast<std::int64_t>(values[k]), grid->segments, grid->first, grid->last);
  }
};

TestDirection random_direction(std::mt19937_64& random, const Domain& domain, std::size_t count) {
  if (pick(random, 0, 2) != 0) return {domain, coordinates(random, domain, count), std::nullopt};
  TestDirection direction{domain, std::vector<double>(count), Arguments::Grid{1, domain.first, domain.last}};
  direction.grid->segments = pick(random, 0, 1) == 0 ? pick(random, 1, 64) : pick(random, 1, 2147483647);
  if (pick(random, 0, 2) == 0) {
    const double width = domain.last - domain.first;
    direction.grid->first = domain.first + width * uniform(random, -1, 1);
    direction.grid->last = domain.first + width * uniform(random, 0, 2);
  }
  const int most = static_cast<int>(std::min<std::int64_t>(direction.grid->segments, 1'000'000'000));
  for (double& i : direction.values) i = pick(random, -most / 4, most);
  return direction;
}

// Collects ratios of error and bound; a ratio above 1 refutes the proof.
class Usage {
 public:
  void add(const Enclosure& enclosure, const Rational& value) {
    ++count_;
    if (!(enclosure.error < std::numeric_limits<double>::infinity())) {
      ++nothing_said_;
      return;
    }
    const Rational error = abs(Rational(enclosure.high) + Rational(enclosure.low) - value);
    ASSERT_LE(error, Rational(enclosure.error));
    largest_ = std::max(largest_, (error / Rational(enclosure.error)).to_double());
  }
  double largest() const { return largest_; }
  int count() const { return count_; }
  int nothing_said() const { return nothing_said_; }

 private:
  double largest_ = 0;
  int count_ = 0, nothing_said_ = 0;
};

class FilterOf : public testing::TestWithParam<std::string> {
 protected:
  FilterOf() { use_filter_target(GetParam()); }
  ~FilterOf() override { use_filter_target(""); }
};

template <typename Float>
bool same_bits(Float a, Float b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

// Expects the correct float and double wherever the filter decides them.
template <typename Form>
void expect_rounded(const Filter& filter, const Form& exact, const TestDirection& u, const TestDirection& v,
                    std::size_t count, int& decided_floats, int& decided_doubles) {
  std::vector<float> floats(count);
  std::vector<double> doubles(count);
  std::vector<std::uint8_t> decided(count);
  filter.to_float(u.arguments(), v.arguments(), floats, decided);
  for (std::size_t k = 0; k < count; ++k) {
    if (decided[k] == 0) continue;
    ++decided_floats;
    ASSERT_TRUE(same_bits(floats[k], exact.to_float(u.at(k), v.at(k)))) << floats[k];
  }
  filter.to_double(u.arguments(), v.arguments(), doubles, decided);
  for (std::size_t k = 0; k < count; ++k) {
    if (decided[k] == 0) continue;
    ++decided_doubles;
    ASSERT_TRUE(same_bits(doubles[k], exact.to_double(u.at(k), v.at(k)))) << doubles[k];
  }
}

// Compares many random maps with the exact method. A map of order 1 in v has no arguments in v.
void expect_enclosed(std::mt19937_64& random, int rounds, const std::function<std::array<int, 2>()>& orders) {
  Usage usage;
  int floats = 0, doubles = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto [uorder, vorder] = orders();
    const Data kind = static_cast<Data>(pick(random, 0, static_cast<int>(Data::kAnyDouble)));
    const std::vector<double> points = control_values(random, kind, uorder * vorder);
    const Domain du = kDomains[pick(random, 0, static_cast<int>(kDomains.size()) - 1)],
                 dv = kDomains[pick(random, 0, static_cast<int>(kDomains.size()) - 1)];
    const std::size_t count = pick(random, 1, 16);
    const TestDirection u = random_direction(random, du, count),
                        v = vorder == 1 ? TestDirection{dv, {}, {}} : random_direction(random, dv, count);
    SCOPED_TRACE(testing::Message() << "orders " << uorder << " " << vorder << " data "
                                    << static_cast<int>(kind) << " domain " << du.first << " " << du.last
                                    << " grid " << u.grid.has_value());
    const Surface surface{points.data(), {1, uorder, du.first, du.last}, {uorder, vorder, dv.first, dv.last}};
    const Filter filter(surface);
    const BernsteinForm exact(surface);
    std::vector<Enclosure> enclosures(count);
    filter.enclose(u.arguments(), v.arguments(), enclosures);
    for (std::size_t k = 0; k < count; ++k) usage.add(enclosures[k], exact.evaluate(u.at(k), v.at(k)));
    expect_rounded(filter, exact, u, v, count, floats, doubles);
    if (testing::Test::HasFatalFailure()) return;
  }
  std::cout << usage.count() << " values, " << usage.nothing_said() << " not enclosed, " << floats
            << " floats and " << doubles << " doubles decided, largest error over bound " << usage.largest()
            << '\n';
  EXPECT_LT(usage.nothing_said(), usage.count() / 3);
  EXPECT_GT(floats, usage.count() / 3);
  EXPECT_GT(doubles, usage.count() / 3);
  // A much wider bound would hide errors.
  EXPECT_GT(usage.largest(), 0x1p-8);
}

TEST_P(FilterOf, EnclosesCurves) {
  std::mt19937_64 random = make_generator();
  expect_enclosed(random, 600, [&] {
    return std::array{pick(random, 0, 3) == 0 ? pick(random, 1, kMaxOrder) : pick(random, 1, 10), 1};
  });
}

TEST_P(FilterOf, EnclosesSurfaces) {
  std::mt19937_64 random = make_generator();
  expect_enclosed(random, 300, [&] {
    return std::array{pick(random, 1, 6), pick(random, 0, 9) == 0 ? pick(random, 1, 30) : pick(random, 1, 6)};
  });
}

// All terms cancel: (1-2u)^n near 1/2, and a polynomial with roots at j/n.
TEST_P(FilterOf, EnclosesWhatCancels) {
  std::mt19937_64 random = make_generator();
  Usage usage;
  for (const int order : {4, 10, 30, 64}) {
    std::vector<double> points;
    for (int i = 0; i < order; ++i) points.push_back(i % 2 == 0 ? 1 : -1);
    std::vector<double> coordinates;
    for (int i = 0; i < 500; ++i)
      coordinates.push_back(0.5 + std::ldexp(uniform(random, -1, 1), -pick(random, 2, 60)));
    const Surface curve{points.data(), {1, order, 0, 1}};
    const BernsteinForm exact(curve);
    std::vector<Enclosure> enclosures(coordinates.size());
    Filter(curve).enclose({coordinates}, {}, enclosures);
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      usage.add(enclosures[k], exact.evaluate(Argument::coordinate(coordinates[k])));
    }
  }
  EXPECT_EQ(usage.nothing_said(), 0);
  std::cout << "largest error over bound " << usage.largest() << '\n';
}

// The grid begins far outside the domain, so that a and b are small differences of large numbers.
TEST_P(FilterOf, EnclosesGridsFromFarAway) {
  std::mt19937_64 random = make_generator();
  Usage usage;
  for (int round = 0; round < 200; ++round) {
    const int order = pick(random, 2, 12);
    const std::vector<double> points = control_values(random, Data::kCancelling, order);
    const Surface curve{points.data(), {1, order, 0, 1}};
    const double distance = std::ldexp(uniform(random, 1, 2), pick(random, 10, 25));
    const Arguments::Grid grid{2000000011, -distance, distance + uniform(random, 0, 1)};
    std::vector<double> indices(20);
    for (double& i : indices) {
      const double u = uniform(random, 0, 1);
      i = std::floor((u - grid.first) / (grid.last - grid.first) * static_cast<double>(grid.segments));
    }
    const BernsteinForm exact(curve);
    std::vector<Enclosure> enclosures(indices.size());
    Filter(curve).enclose({indices, grid}, {}, enclosures);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      usage.add(enclosures[k], exact.evaluate(Argument::grid(static_cast<std::int64_t>(indices[k]),
                                                             grid.segments, grid.first, grid.last)));
    }
  }
  EXPECT_EQ(usage.nothing_said(), 0);
  EXPECT_GT(usage.largest(), 0x1p-8);
  std::cout << "largest error over bound " << usage.largest() << '\n';
}

TEST_P(FilterOf, LeavesTiesToTheExactRoute) {
  const double points[] = {0, 1, 2, 3};
  const Surface curve{points, {1, 4, 0, 1}};
  std::mt19937_64 random = make_generator();
  std::vector<double> coordinates;
  for (int i = 0; i < 4096; ++i) coordinates.push_back(static_cast<float>(uniform(random, 0, 1)));
  std::vector<float> results(coordinates.size());
  std::vector<std::uint8_t> decided(coordinates.size());
  Filter(curve).to_float({coordinates}, {}, results, decided);
  int ties = 0;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const double value = 3 * coordinates[k];  // exact
    const double above = std::nextafter(static_cast<float>(value), 10.0f),
                 below = std::nextafter(static_cast<float>(value), -10.0f);
    const bool tie =
        value != static_cast<float>(value) && (value == (static_cast<float>(value) + above) / 2 ||
                                               value == (static_cast<float>(value) + below) / 2);
    ties += tie ? 1 : 0;
    ASSERT_EQ(decided[k] == 0, tie) << coordinates[k];
  }
  EXPECT_GT(ties, 100);
  EXPECT_EQ(CorrectlyRounded(curve).to_float({coordinates}, {}, results), static_cast<std::size_t>(ties));
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    ASSERT_EQ(results[k], static_cast<float>(3 * coordinates[k]));
}

TEST_P(FilterOf, SaysNothingOfWhatIsNotFinite) {
  const double points[] = {5};
  const Surface constant{points, {1, 1, 0, 1}};
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> coordinates{0, infinity, std::numeric_limits<double>::quiet_NaN(), 1e200};
  std::vector<Enclosure> enclosures(4);
  Filter(constant).enclose({coordinates}, {}, enclosures);
  EXPECT_EQ(enclosures[0].high, 5);
  EXPECT_LT(enclosures[0].error, 1e-20);
  for (int k = 1; k < 4; ++k) EXPECT_EQ(enclosures[k].error, infinity) << k;
  std::vector<float> results(4);
  EXPECT_THROW(CorrectlyRounded(constant).to_float({coordinates}, {}, results), std::domain_error);
  const Arguments grid{coordinates, Arguments::Grid{4, 0, infinity}};
  Filter(constant).enclose(grid, {}, enclosures);
  EXPECT_EQ(enclosures[0].error, infinity);
}

// Far outside the domain a value may be beyond the range of binary64, though its enclosure without the scale
// is not.
TEST_P(FilterOf, SaysNothingOfValuesBeyondTheRange) {
  const double points[] = {0, 0x1p+890};
  const std::vector<double> coordinates{0.5, 0x1p+100, 0x1p+200, -0x1p+200};
  std::vector<Enclosure> enclosures(coordinates.size());
  Filter(Surface{points, {1, 2, 0, 1}}).enclose({coordinates}, {}, enclosures);
  for (int k : {0, 1}) {
    EXPECT_EQ(enclosures[k].high, coordinates[k] * 0x1p+890);
    EXPECT_LT(enclosures[k].error, enclosures[k].high);
  }
  for (int k : {2, 3}) EXPECT_EQ(enclosures[k].error, std::numeric_limits<double>::infinity());
}

TEST_P(FilterOf, RefusesWrongSizes) {
  const double points[] = {5, 6};
  const Surface line{points, {1, 2, 0, 1}};
  const std::vector<double> two(2);
  std::vector<Enclosure> enclosures(3);
  EXPECT_THROW(Filter(line).enclose({two}, {}, enclosures), std::invalid_argument);
  enclosures.resize(2);
  EXPECT_THROW(Filter(line).enclose({two, Arguments::Grid{0, 0, 1}}, {}, enclosures), std::invalid_argument);
  EXPECT_THROW(Filter(Surface{points, {1, 1}, {1, 2}}).enclose({two}, {}, enclosures), std::invalid_argument);
  EXPECT_THROW(Filter(Surface{points, {1, 2, 1, 1}}), std::domain_error);
  EXPECT_THROW(Filter(Surface{points, {1, 65, 0, 1}}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Targets, FilterOf, testing::ValuesIn(filter_targets()),
                         [](const auto& target) { return target.param; });

TEST(FilterTargets, RefusesUnknownNames) {
  EXPECT_THROW(use_filter_target("abacus"), std::invalid_argument);
  EXPECT_FALSE(filter_targets().empty());
}

}  // namespace
}  // namespace evalcts::reference
