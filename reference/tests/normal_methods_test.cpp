// Tests that every usual method to compute a normal stays within the acceptance bound, in single precision
// and with errors of one part in 10^5 in every operation. The bound is not much wider than necessary.
#include <gtest/gtest.h>
#include <reference/normal.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "perturbed_normal.h"

namespace evalcts::reference {
namespace {

NormalMethod random_method(std::mt19937_64& generator) {
  return {kParameters[pick(generator, 0, 2)], kMethods[pick(generator, 0, 6)], kSlopes[pick(generator, 0, 2)],
          kTangents[pick(generator, 0, 4)],   kUnits[pick(generator, 0, 2)],   pick(generator, 0, 1) != 0,
          pick(generator, 0, 1) != 0};
}

struct NormalCase {
  Patch patch;
  Argument u, v;

  NormalAcceptance acceptance() const { return normal_acceptance(patch.surface(), u, v); }
};

void set_random_domain(std::mt19937_64& generator, double& low, double& high) {
  const double domains[][2] = {{0, 1}, {0, 1}, {0, 1}, {2, 5}, {5, -2}, {0.1f, 0.7f}, {1000, 1008}};
  const auto& domain = domains[pick(generator, 0, 6)];
  low = domain[0], high = domain[1];
}

// Returns an argument in the domain, at its ends, or slightly outside.
Argument random_argument(std::mt19937_64& generator, double u1, double u2) {
  if (pick(generator, 0, 3) == 0) {
    return Argument::grid(pick(generator, 0, 13), 13, static_cast<float>(u1), u2);
  }
  const double t = pick(generator, 0, 3) == 0 ? uniform(generator, -0.2, 1.2) : uniform(generator, 0, 1);
  return Argument::coordinate(static_cast<float>(u1 + t * (u2 - u1)));
}

// Returns a bumpy patch of random size and position, or a random net; w is between 1/2 and 4 with either
// sign.
NormalCase random_case(std::mt19937_64& generator, int size, int uorder, int vorder) {
  Patch patch = random_patch(generator, Data::kFloats, size, uorder, vorder);
  const double scales[] = {0.01, 1, 1, 1000};
  const double scale = scales[pick(generator, 0, 3)];
  const double offset = pick(generator, 0, 2) == 0 ? uniform(generator, -5, 5) : 0;
  const bool chaos = pick(generator, 0, 4) == 0;
  const double noise = chaos ? 1 : uniform(generator, 0, 0.6), weights = uniform(generator, 1, 4);
  const double sign = pick(generator, 0, 2) == 0 ? -1 : 1;
  for (int i = 0; i < uorder; ++i) {
    for (int j = 0; j < vorder; ++j) {
      const double w = size == 4 ? sign * (1 + (weights - 1) * std::fabs(patch.at(i, j, 3))) : 1;
      for (int c = 0; c < 3; ++c) {
        const double sheet = chaos ? 0 : c == 0 ? i : c == 1 ? j : 0;
        patch.at(i, j, c) = static_cast<float>(w * scale * (offset + sheet + noise * patch.at(i, j, c)));
      }
      if (size == 4) patch.at(i, j, 3) = static_cast<float>(w);
    }
  }
  set_random_domain(generator, patch.u1, patch.u2);
  set_random_domain(generator, patch.v1, patch.v2);
  const Argument u = random_argument(generator, patch.u1, patch.u2);
  const Argument v = random_argument(generator, patch.v1, patch.v2);
  return {std::move(patch), u, v};
}

RealVector run(Arithmetic& a, const NormalCase& c, const NormalMethod& how, bool clear) {
  const long double u = coordinate(a, c.u), v = coordinate(a, c.v);
  return normal_by(a, how, c.patch, u, v, clear);
}

RealVector run_unit(Arithmetic& a, const NormalCase& c, const NormalMethod& how) {
  return unit_by(a, how.unit, run(a, c, how, false));
}

// Converts to a long double, within about one ULP.
long double real(const Rational& x) {
  const double high = x.to_double();
  return high + static_cast<long double>((x - Rational(high)).to_double());
}

RealVector exact_unit(const Vector& m) {
  const std::array<Interval, 3> unit = unit_vector(m, 80);
  return {real(unit[0].low), real(unit[1].low), real(unit[2].low)};
}

// True if the normal has the opposite sign: derivatives with respect to the domain variables change their
// sign with each reversed domain.
bool is_flipped(const NormalCase& c, const NormalMethod& how) {
  return how.domain_variable && (c.patch.u1 > c.patch.u2) != (c.patch.v1 > c.patch.v2);
}

// Returns the largest ratio of a component's error and the bound.
double excess(const RealVector& got, const RealVector& exact, bool flipped, long double bound) {
  long double most = 0;
  for (int c = 0; c < 3; ++c) most = std::fmax(most, std::fabs((flipped ? -got[c] : got[c]) - exact[c]));
  return std::isnan(got[0]) ? HUGE_VAL : static_cast<double>(most / bound);
}

std::string in_words(const NormalCase& c, const NormalMethod& how) {
  return "components " + std::to_string(c.patch.size) + " orders " + std::to_string(c.patch.uorder) + " " +
         std::to_string(c.patch.vorder) + " method " + std::to_string(static_cast<int>(how.method)) +
         " slope " + std::to_string(static_cast<int>(how.slope)) + " tangent " +
         std::to_string(static_cast<int>(how.tangent));
}

// Counts of all and of judged results, and the largest error.
struct Statistics {
  int judged = 0, all = 0;
  double worst = 0;
  // Expects that an error is not larger than the bound.
  void record(double share, const NormalCase& c, const NormalMethod& how) {
    EXPECT_LE(share, 1) << in_words(c, how);
    worst = std::max(worst, share);
  }
  ~Statistics() {
    std::cout << "judged " << judged << " of " << all << ", largest error / bound " << worst << "\n";
  }
};

// Normals of unit length, and vectors that are not normalised, as with a vertex shader.
TEST(EveryNormalMethod, IsAccepted) {
  std::mt19937_64 generator = make_generator();
  RandomErrors random(generator);
  SinglePrecision single;
  Statistics seen, vectors;
  for (int repetition = 0; repetition < 2500; ++repetition) {
    const NormalCase c =
        random_case(generator, pick(generator, 3, 4), pick(generator, 2, 8), pick(generator, 2, 8));
    const NormalAcceptance a = c.acceptance();
    ++seen.all, ++vectors.all;
    if (!a.bound || !a.vector_bound) continue;
    ++seen.judged, ++vectors.judged;
    const RealVector exact = exact_unit(a.m);
    const Vector m = normal_vector(c.patch.surface(), c.u, c.v);
    const RealVector exact_vector{real(m[0]), real(m[1]), real(m[2])};
    for (Arithmetic* arithmetic : {static_cast<Arithmetic*>(&random), static_cast<Arithmetic*>(&single)}) {
      if (arithmetic == &single && !a.must_applies) continue;
      for (int k = 0; k < 4; ++k) {
        NormalMethod how = random_method(generator);
        const bool flipped = is_flipped(c, how);
        const RealVector got = run_unit(*arithmetic, c, how);
        seen.record(excess(got, exact, flipped, real(*a.bound)), c, how);
        if (arithmetic == &single) {
          const std::array<float, 3> floats{static_cast<float>(got[0]), static_cast<float>(got[1]),
                                            static_cast<float>(got[2])};
          EXPECT_TRUE(is_within(floats, a.m, *a.bound, flipped)) << in_words(c, how);
          EXPECT_TRUE(direction_is_within(floats, a.m, *a.bound, flipped)) << in_words(c, how);
        }
        how.domain_variable = false;
        vectors.record(excess(run(*arithmetic, c, how, true), exact_vector, false, real(*a.vector_bound)), c,
                       how);
      }
    }
  }
  EXPECT_GT(seen.judged, seen.all / 2);
}

TEST(EveryNormalMethod, IsAcceptedWithTheWorstErrors) {
  std::mt19937_64 generator = make_generator();
  Statistics seen, vectors;
  for (int repetition = 0; repetition < 160; ++repetition) {
    const NormalCase c =
        random_case(generator, pick(generator, 3, 4), pick(generator, 2, 4), pick(generator, 2, 4));
    const NormalAcceptance acceptance = c.acceptance();
    ++seen.all, ++vectors.all;
    if (!acceptance.bound) continue;
    ++seen.judged, ++vectors.judged;
    NormalMethod how = random_method(generator);
    const int component = pick(generator, 0, 2);
    const RealVector exact = exact_unit(acceptance.m);
    search_worst_errors([&](Arithmetic& a) { return run_unit(a, c, how)[component]; },
                        [&](Arithmetic& a) {
                          seen.record(
                              excess(run_unit(a, c, how), exact, is_flipped(c, how), real(*acceptance.bound)),
                              c, how);
                        });
    how.domain_variable = false;
    const Vector m = normal_vector(c.patch.surface(), c.u, c.v);
    const RealVector exact_vector{real(m[0]), real(m[1]), real(m[2])};
    search_worst_errors(
        [&](Arithmetic& a) { return run(a, c, how, true)[component]; },
        [&](Arithmetic& a) {
          vectors.record(excess(run(a, c, how, true), exact_vector, false, real(*acceptance.vector_bound)), c,
                         how);
        });
  }
  EXPECT_GT(seen.judged, seen.all / 2);
  // A bound far above all real errors would prove nothing about an implementation.
  EXPECT_GT(seen.worst, 0.03);
  EXPECT_GT(vectors.worst, 0.15);
}

}  // namespace
}  // namespace evalcts::reference
