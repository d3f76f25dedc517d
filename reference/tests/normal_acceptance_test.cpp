// Tests the acceptance rule of automatic normals: comparison with a second implementation of
// its formulas, the conditions for a must and for not judging, and the rejection of typical mistakes.
#include <gtest/gtest.h>
#include <reference/normal.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "patch.h"
#include "second_bound.h"

namespace evalcts::reference {
namespace {

using Decimal = boost::multiprecision::cpp_bin_float_100;
using Floats = std::array<float, 3>;

Decimal decimal(const Fraction& f) { return Decimal(numerator(f)) / Decimal(denominator(f)); }

Decimal decimal_length(const SecondVector& m) {
  return sqrt(decimal(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
}

// A number, known by its magnitude |x| and its error E.
struct BoundedNumber {
  Fraction size, error;
  Fraction most() const { return size + error; }
};

// Returns the error E of a difference of two products.
Fraction products_error(const BoundedNumber& a, const BoundedNumber& b, const BoundedNumber& c,
                        const BoundedNumber& d) {
  return (1 + 3 * kEpsilon) * (a.most() * b.most() + c.most() * d.most()) - a.size * b.size - c.size * d.size;
}

struct KnownJet {
  BoundedNumber value, u, v;
};

KnownJet known_jet(const Patch& patch, int c, const Argument& u, const Argument& v, bool fit) {
  const int n = patch.uorder - 1, m = patch.vorder - 1;
  const auto r = [&](int i, int j) { return Fraction(abs(fraction(patch.at(i, j, c)))); };
  // Computes the bound over the net of `size(i, j)`, which has n - du + 1 rows and m - dv + 1 columns.
  const auto bound = [&](int du, int dv, int more) {
    std::vector<Fraction> sizes;
    for (int i = 0; i <= n - du; ++i) {
      for (int j = 0; j <= m - dv; ++j) {
        sizes.push_back(du + dv == 0 ? r(i, j) : Fraction(r(i + du, j + dv) + r(i, j)));
      }
    }
    const SecondDirection along_u{n - du, patch.u1, patch.u2, u}, along_v{m - dv, patch.v1, patch.v2, v};
    const int k = (n - du) * (m - dv) + 5 * (n - du + m - dv) + 4;
    return second_bound(sizes, along_u, along_v, k + more, fit);
  };
  const SecondJet p = second_jet(patch, c, u, v);
  return {{abs(p.value), bound(0, 0, 0)},
          {abs(p.u), n == 0 ? Fraction(0) : Fraction(n * bound(1, 0, 3))},
          {abs(p.v), m == 0 ? Fraction(0) : Fraction(m * bound(0, 1, 3))}};
}

struct SecondAcceptance {
  bool judged;
  Decimal bound, vector_bound;
};

SecondAcceptance second_acceptance(const Patch& patch, const Argument& u, const Argument& v) {
  const SecondDirection along_u{0, patch.u1, patch.u2, u}, along_v{0, patch.v1, patch.v2, v};
  const bool fit =
      along_u.fits() && along_v.fits() && std::all_of(patch.points.begin(), patch.points.end(), fits_single);
  std::vector<KnownJet> p;
  for (int c = 0; c < patch.size; ++c) p.push_back(known_jet(patch, c, u, v, fit));
  const bool four = patch.size == 4;
  const Fraction w = four ? second_jet(patch, 3, u, v).value : Fraction(1);
  if (w == 0) return {false, 0, 0};
  const SecondVector q_u = second_tangent(patch, u, v, &SecondJet::u);
  const SecondVector q_v = second_tangent(patch, u, v, &SecondJet::v);
  std::array<BoundedNumber, 3> a, b;
  for (int c = 0; c < 3; ++c) {
    a[c] = four ? BoundedNumber{abs(Fraction(w * w * q_u[c])),
                                products_error(p[3].value, p[c].u, p[3].u, p[c].value)}
                : p[c].u;
    b[c] = four ? BoundedNumber{abs(Fraction(w * w * q_v[c])),
                                products_error(p[3].value, p[c].v, p[3].v, p[c].value)}
                : p[c].v;
  }
  const Decimal d =
      decimal_length({products_error(a[1], b[2], a[2], b[1]), products_error(a[2], b[0], a[0], b[2]),
                      products_error(a[0], b[1], a[1], b[0])});
  const Decimal m = decimal_length(second_normal(patch, u, v)) * decimal(power(w, 4));
  const Fraction w_error = four ? p[3].value.error : Fraction(0);
  if (4 * d >= m || 2 * w_error >= abs(w)) return {false, 0, 0};
  const Decimal eps = decimal(kEpsilon);
  const Decimal w_least = decimal(abs(w) - w_error);
  return {true, 2 * d / m + 10 * eps,
          (m + d) * (1 + 10 * eps) / pow(w_least, 4) - m / pow(decimal(abs(w)), 4)};
}

void expect_just_above(const Rational& bound, const Decimal& exact) {
  EXPECT_GE(decimal(fraction(bound)), exact);
  EXPECT_LE(decimal(fraction(bound)), exact * (1 + Decimal("1e-6")));
}

TEST(NormalAcceptance, IsThatOfTheRequirements) {
  std::mt19937_64 generator = make_generator();
  const double domains[][2] = {{0, 1}, {0, 1}, {2, 5}, {5, -2}, {0.1f, 0.7f}, {0.1, 0.7}};
  int judged = 0, not_judged = 0;
  for (int repetition = 0; repetition < 50; ++repetition) {
    const Data kinds[] = {Data::kFloats, Data::kFloats, Data::kDoubles, Data::kIntegers, Data::kCancelling};
    Patch patch = random_patch(generator, kinds[pick(generator, 0, 4)], pick(generator, 3, 4),
                               pick(generator, 1, 4), pick(generator, 1, 4));
    const auto& u_domain = domains[pick(generator, 0, 5)];
    const auto& v_domain = domains[pick(generator, 0, 5)];
    patch.u1 = u_domain[0], patch.u2 = u_domain[1], patch.v1 = v_domain[0], patch.v2 = v_domain[1];
    const auto argument = [&](double low, double high) {
      return pick(generator, 0, 1)
                 ? at(static_cast<float>(low + uniform(generator, -0.1, 1.1) * (high - low)))
                 : Argument::grid(pick(generator, 0, 5), 5, low, high);
    };
    const Argument u = argument(patch.u1, patch.u2), v = argument(patch.v1, patch.v2);
    const NormalAcceptance got = normal_acceptance(patch.surface(), u, v);
    const SecondAcceptance expected = second_acceptance(patch, u, v);
    ++(expected.judged ? judged : not_judged);
    ASSERT_EQ(got.bound.has_value(), expected.judged);
    ASSERT_EQ(got.vector_bound.has_value(), expected.judged);
    if (!expected.judged) continue;
    expect_just_above(*got.bound, expected.bound);
    expect_just_above(*got.vector_bound, expected.vector_bound);
  }
  EXPECT_GT(judged, 15);
  EXPECT_GT(not_judged, 5);
}

TEST(NormalAcceptance, IsRoundedOutwardAtHighOrdersToo) {
  std::mt19937_64 generator = make_generator();
  for (const int size : {3, 4}) {
    Patch patch = random_patch(generator, Data::kIntegers, size, 11, 5);
    for (int i = 0; i < 11; ++i) {
      for (int j = 0; j < 5; ++j) {
        patch.at(i, j, 0) = i - 5, patch.at(i, j, 1) = j - 2, patch.at(i, j, 2) /= 64;
        if (size == 4) patch.at(i, j, 3) = 8 + i / 64.0;
      }
    }
    const NormalAcceptance got = normal_acceptance(patch.surface(), at(0.75), at(0.25));
    const SecondAcceptance expected = second_acceptance(patch, at(0.75), at(0.25));
    ASSERT_TRUE(expected.judged && got.bound && got.vector_bound);
    expect_just_above(*got.bound, expected.bound);
    expect_just_above(*got.vector_bound, expected.vector_bound);
  }
}

TEST(NormalAcceptance, AllowsAnyMethodTwoInAThousand) {
  EXPECT_EQ(normal_method_allowance(), Rational(1) / 500);
}

TEST(NormalAcceptance, HasABoundOfSinglePrecision) {
  EXPECT_EQ(normal_quality_bound(Rational(1) / 1000), Rational(1) / 128000);
}

// Returns a unit square at z = 5 with the given w.
template <std::size_t kSize>
Patch square(double scale = 1, double w = 1) {
  return make_patch<kSize>(2, 2, [=](int i, int j) {
    std::array<double, kSize> point{w * scale * i, w * scale * j, 0};
    if constexpr (kSize == 4) point[3] = w;
    return point;
  });
}

TEST(NormalAcceptance, IsAMustWhereTheValuesAre) {
  std::mt19937_64 generator = make_generator();
  int musts = 0, others = 0;
  for (int repetition = 0; repetition < 300; ++repetition) {
    Patch patch = square<4>(1, pick(generator, 1, 3));
    patch.at(0, 0, pick(generator, 0, 3)) *= std::ldexp(1.0, pick(generator, 0, 3) * 12);
    patch.u1 = pick(generator, 0, 9) == 0 ? 0x1p-140 : 0;
    patch.u2 = std::ldexp(1.0, pick(generator, -2, 2) * 29);
    const Argument u = at(patch.u2 * pick(generator, 0, 3)), v = at(std::ldexp(1.0, pick(generator, -3, 24)));
    const int range = pick(generator, 0, 1) ? kFullRange : kReducedRange;
    bool values = true;
    for (const Surface& component : patch.surface()) values = values && must_applies(component, u, v, range);
    const bool must = normal_acceptance(patch.surface(), u, v, range).must_applies;
    ASSERT_LE(must, values);
    ++(values ? musts : others);
  }
  EXPECT_GT(musts, 30);
  EXPECT_GT(others, 30);
  const auto must = [](const Patch& patch, int range = kFullRange) {
    return normal_acceptance(patch.surface(), at(0.5), at(0.5), range).must_applies;
  };
  EXPECT_TRUE(must(square<3>()));
  EXPECT_TRUE(must(square<4>()));
  // The values are within the range.
  EXPECT_TRUE(must(square<3>(1000), kReducedRange));
  EXPECT_FALSE(must(square<3>(1025), kReducedRange));
  Patch tiny_domain = square<3>();
  tiny_domain.u1 = 0x1p-127;
  EXPECT_FALSE(must(tiny_domain));
}

TEST(NormalAcceptance, IsAMustOnlyForOrdinarySizes) {
  const auto must = [](const Patch& patch) {
    return normal_acceptance(patch.surface(), at(0.5 * patch.u2), at(0.5 * patch.v2)).must_applies;
  };
  // |m| is between 2^-32 and 2^32.
  EXPECT_TRUE(must(square<3>(0x1p16)));
  EXPECT_FALSE(must(square<3>(0x1.1p16)));
  EXPECT_TRUE(must(square<3>(0x1p-16)));
  EXPECT_FALSE(must(square<3>(0x1.fp-17)));
  // EV-AUTON-UNIT
  EXPECT_TRUE(must(square<3>(0.01f)));
  EXPECT_TRUE(must(square<3>(1000)));
  // The limits hold with the factor w^4 and without it.
  EXPECT_TRUE(must(square<4>(1, 0x1p8)));
  EXPECT_FALSE(must(square<4>(1, 0x1.1p8)));
  EXPECT_TRUE(must(square<4>(1, -0x1p-8)));
  EXPECT_FALSE(must(square<4>(1, -0x1.fp-9)));
  EXPECT_FALSE(must(square<4>(0x1.1p16, 0.5)));
  EXPECT_FALSE(must(square<4>(0x1.fp-17, 2)));
  EXPECT_TRUE(must(square<4>(0x1p-16, 1)));
  // The derivatives have different magnitudes: the patch is long and thin.
  Patch thin = make_patch<3>(2, 2, [](int i, int j) { return std::array{0x1.8p31 * i, 0x1p-40 * j, 0.0}; });
  EXPECT_TRUE(must(thin));
  thin.at(0, 0, 0) = thin.at(0, 1, 0) = -0x1.8p31;
  EXPECT_FALSE(must(thin));
  // The limits hold for derivatives in u and v instead of t, too.
  for (double Patch::*end : {&Patch::u2, &Patch::v2}) {
    Patch wide = square<3>();
    wide.*end = 0x1p32;
    EXPECT_TRUE(must(wide));
    wide.*end = 0x1.1p32;
    EXPECT_FALSE(must(wide));
    wide.*end = 0x1.1p-32;
    EXPECT_TRUE(must(wide));
    wide.*end = 0x1.fp-33;
    EXPECT_FALSE(must(wide));
  }
}

TEST(NormalAcceptance, JudgesNothingWithoutANormal) {
  const auto judged = [](const Patch& patch, double u, double v) {
    const NormalAcceptance acceptance = normal_acceptance(patch.surface(), at(u), at(v));
    EXPECT_EQ(acceptance.bound.has_value(), acceptance.vector_bound.has_value());
    return acceptance.bound.has_value();
  };
  EXPECT_TRUE(judged(square<3>(), 0.5, 0.5));
  // Nothing is judged if all points are equal, for order 1, and at and near a collapsed edge.
  EXPECT_FALSE(judged(make_patch<3>(3, 3, [](int, int) { return std::array{1.0, 2.0, 3.0}; }), 0.5, 0.5));
  EXPECT_FALSE(judged(make_patch<3>(3, 1,
                                    [](int i, int) {
                                      return std::array{1.0 * i, 2.0, 3.0};
                                    }),
                      0.5, 0.5));
  EXPECT_FALSE(judged(make_patch<3>(1, 1, [](int, int) { return std::array{1.0, 2.0, 3.0}; }), 0.5, 0.5));
  const auto fan = [](double x) {
    return make_patch<3>(2, 2, [x](int i, int j) { return std::array{x + i, x + 1.0 * i * j, x}; });
  };
  EXPECT_FALSE(judged(fan(0), 0, 0.5));
  EXPECT_TRUE(judged(fan(0), 1e-5, 0.5));  // nothing cancels
  EXPECT_FALSE(judged(fan(5), 1e-5, 0.5));
  EXPECT_TRUE(judged(fan(5), 0.5, 0.5));
  // w passes through zero at u = 0.5.
  const Patch through = make_patch<4>(2, 2, [](int i, int j) {
    return std::array{1.0 * i, 1.0 * j, 0.5, i == 0 ? 1.0 : -1.0};
  });
  EXPECT_FALSE(judged(through, 0.5, 0.5));
  EXPECT_FALSE(judged(through, 0.50001, 0.5));
  EXPECT_TRUE(judged(through, 0.25, 0.5));
  EXPECT_TRUE(judged(through, 0.75, 0.5));
  // The values exceed the range of binary64, where nothing is a must.
  EXPECT_FALSE(judged(square<3>(1e300), 0.5, 0.5));
  EXPECT_FALSE(judged(square<3>(1e-300), 0.5, 0.5));
  EXPECT_FALSE(judged(square<4>(1e70, 1e70), 1e200, 0.5));
}

// A square moves away until the errors of its position exceed its size.
TEST(NormalAcceptance, StopsJudgingWhereTheRequirementsDo) {
  int judged = 0, not_judged = 0;
  for (double place = 10; place < 1e5; place *= 1.1) {
    const Patch patch = make_patch<3>(2, 2, [=](int i, int j) {
      return std::array{std::floor(place) + i, 1.0 * j, 0.0};
    });
    const bool expected = second_acceptance(patch, at(0.5), at(0.5)).judged;
    EXPECT_EQ(normal_acceptance(patch.surface(), at(0.5), at(0.5)).bound.has_value(), expected) << place;
    ++(expected ? judged : not_judged);
  }
  EXPECT_GT(judged, 10);
  EXPECT_GT(not_judged, 10);
}

// A normal by a wrong method, exact except for the last rounding.
struct Wrong {
  Floats normal;
  const char* what;
};

Floats rounded(const Vector& m) {
  return {static_cast<float>(m[0].to_double()), static_cast<float>(m[1].to_double()),
          static_cast<float>(m[2].to_double())};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

TEST(NormalAcceptance, RefusesTheUsualMistakes) {
  // A bump, with w from 1 to 2.
  const Patch bump = make_patch<4>(3, 3, [](int i, int j) {
    const double w = 1 + 0.25 * i + 0.25 * j * (i + 1) / 3;
    return std::array{w * i, w * j, w * (i == 1 && j == 1 ? 2 : 0.5), w};
  });
  const Argument u = at(0.375), v = at(0.25);
  const std::vector<Surface> surface = bump.surface();
  const NormalAcceptance acceptance = normal_acceptance(surface, u, v);
  ASSERT_TRUE(acceptance.must_applies && acceptance.bound);
  const Rational strict = *acceptance.bound, must = strict + normal_method_allowance();
  const Vector& m = acceptance.m;
  const Floats right = rounded_unit_vector(m);
  EXPECT_TRUE(is_within(right, m, strict, false));
  EXPECT_LT(strict, Rational(1) / 30);

  Vector p_u, p_v;
  for (int c = 0; c < 3; ++c) {
    const Jet p = jet(surface[c], u, v);
    p_u[c] = p.u, p_v[c] = p.v;
  }
  const Wrong wrongs[] = {
      {rounded_unit_vector({-m[0], -m[1], -m[2]}), "u and v swapped"},
      {rounded_unit_vector(cross(p_u, p_v)), "derivatives of p instead of q"},
      {rounded(normal_vector(surface, u, v)), "not normalised"},
      {rounded_unit_vector(normal_vector(surface, at(0.5), v)), "elsewhere in u"},
      {rounded_unit_vector(normal_vector(surface, u, at(0.5))), "elsewhere in v"},
      {{right[0], right[1], 0}, "no z"},
      {{right[0] * 1.05f, right[1] * 1.05f, right[2] * 1.05f}, "too long"},
      {{right[0] * 0.95f, right[1] * 0.95f, right[2] * 0.95f}, "too short"},
      {{0, 0, 0}, "nothing"},
  };
  for (const Wrong& wrong : wrongs) {
    EXPECT_FALSE(is_within(wrong.normal, m, must, false)) << wrong.what;
  }
  // Swapping changes only the sign, and the length does not affect the direction.
  EXPECT_TRUE(is_within(wrongs[0].normal, m, strict, true));
  EXPECT_TRUE(direction_is_within(wrongs[2].normal, m, strict, false));
  EXPECT_FALSE(direction_is_within(wrongs[1].normal, m, must, true));

  // The vector has the length |q_u x q_v|, not that of the homogeneous coordinates.
  ASSERT_TRUE(acceptance.vector_bound);
  const Vector exact = normal_vector(surface, u, v);
  const auto vector_accepted = [&](const Vector& got) {
    for (int c = 0; c < 3; ++c) {
      if (abs(got[c] - exact[c]) > *acceptance.vector_bound) return false;
    }
    return true;
  };
  EXPECT_TRUE(vector_accepted(exact));
  EXPECT_FALSE(vector_accepted(m));
  EXPECT_FALSE(vector_accepted(cross(p_u, p_v)));
  EXPECT_FALSE(vector_accepted({right[0], right[1], right[2]}));
}

}  // namespace
}  // namespace evalcts::reference
