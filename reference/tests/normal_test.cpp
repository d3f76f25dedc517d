// Compares exact derivatives and normals with a second method and with surfaces whose normals are known.
#include <gtest/gtest.h>
#include <reference/normal.h>

#include <limits>
#include <stdexcept>

#include "patch.h"

namespace evalcts::reference {
namespace {

Argument random_argument(std::mt19937_64& generator) {
  if (pick(generator, 0, 2) == 0) {
    return Argument::grid(pick(generator, -1, 8), 7, uniform(generator, -1, 1), static_cast<float>(1.5));
  }
  return at(pick(generator, 0, 1) ? static_cast<float>(uniform(generator, -0.5, 1.5))
                                  : pick(generator, 0, 1));
}

void set_random_domain(std::mt19937_64& generator, Patch& patch) {
  const double domains[][2] = {{0, 1}, {0, 1}, {2, 5}, {5, -2}, {0.1f, 0.7}, {1, 0}};
  const auto& u = domains[pick(generator, 0, 5)];
  const auto& v = domains[pick(generator, 0, 5)];
  patch.u1 = u[0], patch.u2 = u[1], patch.v1 = v[0], patch.v2 = v[1];
}

// Returns a point (x,y,z) of the surface.
Vector point(const Patch& patch, const Argument& u, const Argument& v) {
  const std::vector<Surface> surface = patch.surface();
  Vector q;
  for (int c = 0; c < 3; ++c) {
    q[c] = evaluate(surface[c], u, v);
    if (patch.size == 4) q[c] /= evaluate(surface[3], u, v);
  }
  return q;
}

Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool are_parallel(const Vector& a, const Vector& b) {
  return dot(a, b) * dot(a, b) == dot(a, a) * dot(b, b) && dot(a, b).sign() > 0;
}

TEST(NormalVector, IsThatOfTheSecondRoute) {
  std::mt19937_64 generator = make_generator();
  const Data kinds[] = {Data::kFloats, Data::kDoubles, Data::kIntegers, Data::kCancelling, Data::kSparse};
  int with_w = 0;
  for (int repetition = 0; repetition < 150; ++repetition) {
    Patch patch = random_patch(generator, kinds[pick(generator, 0, 4)], pick(generator, 3, 4),
                               pick(generator, 1, 6), pick(generator, 1, 6));
    set_random_domain(generator, patch);
    const Argument u = random_argument(generator), v = random_argument(generator);
    const std::vector<Surface> surface = patch.surface();
    if (patch.size == 4 && evaluate(surface[3], u, v).is_zero()) {
      EXPECT_THROW(normal_vector(surface, u, v), std::domain_error);
      continue;
    }
    with_w += patch.size == 4;
    const Vector m = normal_vector(surface, u, v);
    ASSERT_EQ(fractions(m), second_normal(patch, u, v));
    // The m of the acceptance is w^4 times as long, so it has the same direction for any sign of w.
    const Rational w = patch.size == 4 ? evaluate(surface[3], u, v) : Rational(1);
    for (int c = 0; c < 3; ++c) ASSERT_EQ(normal_acceptance(surface, u, v).m[c], m[c] * pow(w, 4));
  }
  EXPECT_GT(with_w, 40);
}

TEST(NormalVector, IsExactAtHighOrders) {
  std::mt19937_64 generator = make_generator();
  for (const int size : {3, 4}) {
    const Patch patch = random_patch(generator, Data::kIntegers, size, 30, 17);
    const Argument u = at(0.75), v = Argument::grid(1, 3, 0, 1);
    ASSERT_EQ(fractions(normal_vector(patch.surface(), u, v)), second_normal(patch, u, v));
  }
}

TEST(NormalVector, IsAsLongAsTheParallelogram) {
  // EV-AUTON-SHADER: 10 by 10 gives 100.
  const Patch square = make_patch<3>(2, 2, [](int i, int j) { return std::array{10.0 * i, 10.0 * j, 3.0}; });
  EXPECT_EQ(normal_vector(square.surface(), at(0.3), at(7)), (Vector{0, 0, 100}));
  Patch swapped = make_patch<3>(2, 2, [](int i, int j) { return std::array{10.0 * j, 10.0 * i, 3.0}; });
  EXPECT_EQ(normal_vector(swapped.surface(), at(0.3), at(7)), (Vector{0, 0, -100}));
  // Derivatives are in the normalised coordinates: neither width nor direction of the domain matters.
  swapped.u1 = 4, swapped.u2 = -3, swapped.v1 = 10, swapped.v2 = 12;
  EXPECT_EQ(normal_vector(swapped.surface(), at(0.3), at(7)), (Vector{0, 0, -100}));
}

// EV-AUTON-RATIONAL
TEST(NormalVector, OfAPlanarRationalPatchIsThatOfThePlane) {
  const auto net = [](double sign) {
    return make_patch<4>(3, 3, [sign](int i, int j) {
      const double w = sign * (1 + 0.25 * i + 0.5 * j * j);  // 1 to 3.5
      return std::array{w * i, w * j, w * 5, w};
    });
  };
  for (const double u : {0.0, 0.25, 1.0, 1.5}) {
    for (const double v : {0.0, 0.7, 1.0}) {
      const Vector m = normal_vector(net(1).surface(), at(u), at(v));
      EXPECT_TRUE(m[0].is_zero() && m[1].is_zero());
      EXPECT_EQ(rounded_unit_vector(m), (std::array<float, 3>{0, 0, 1}));
      // The same points with w < 0.
      EXPECT_EQ(normal_vector(net(-1).surface(), at(u), at(v)), m);
      EXPECT_EQ(normal_acceptance(net(-1).surface(), at(u), at(v)).m,
                normal_acceptance(net(1).surface(), at(u), at(v)).m);
    }
  }
}

// (1 - u^2, 2u, ., 1 + u^2) is a quarter of a circle, its Bernstein coefficients are (1,0,1), (1,1,1),
// (0,2,2).
constexpr double kCircle[3][3] = {{1, 0, 1}, {1, 1, 1}, {0, 2, 2}};

TEST(NormalVector, OfARationalSphereIsRadialAndVanishesAtThePole) {
  // The quarter circle turned about z: u is the longitude, v the latitude.
  const Patch sphere = make_patch<4>(3, 3, [](int i, int j) {
    return std::array{kCircle[i][0] * kCircle[j][0], kCircle[i][1] * kCircle[j][0],
                      kCircle[i][2] * kCircle[j][1], kCircle[i][2] * kCircle[j][2]};
  });
  for (const double u : {0.0, 0.1, 0.5, 1.0}) {
    for (const double v : {0.0, 0.3, 0.875}) {
      const Vector q = point(sphere, at(u), at(v));
      EXPECT_EQ(dot(q, q), 1);
      EXPECT_TRUE(are_parallel(normal_vector(sphere.surface(), at(u), at(v)), q));
    }
    EXPECT_TRUE(is_degenerate(normal_vector(sphere.surface(), at(u), at(1))));
    const Argument beside = at(1 - 0x1p-40);
    EXPECT_TRUE(are_parallel(normal_vector(sphere.surface(), at(u), beside), point(sphere, at(u), beside)));
  }
}

TEST(IsDegenerate, WhereTheDerivativesSpanNoPlane) {
  const auto degenerate = [](const Patch& patch, double u, double v) {
    const Vector m = normal_vector(patch.surface(), at(u), at(v));
    return is_degenerate(m);
  };
  const Patch point = make_patch<3>(3, 3, [](int, int) { return std::array{0.1, 0.2, 0.3}; });
  EXPECT_TRUE(degenerate(point, 0.3, 0.6));
  const Patch line = make_patch<3>(3, 4, [](int i, int j) {
    const double at = i * i - 3 * j;
    return std::array{at, 2 * at, -3 * at};
  });
  EXPECT_TRUE(degenerate(line, 0.3, 0.6));
  const Patch curve_u = make_patch<3>(4, 1, [](int i, int) { return std::array{0.1 * i, 2.0, 1.0 * i * i}; });
  EXPECT_TRUE(degenerate(curve_u, 0.3, 0.6));
  const Patch curve_v = make_patch<4>(1, 4, [](int, int i) {
    return std::array{0.1 * i, 2.0, 1.0 * i * i, 2.0};
  });
  EXPECT_TRUE(degenerate(curve_v, 0.3, 0.6));
  // The edge u = 0 is a single point, where the normal is degenerate.
  const Patch fan = make_patch<3>(2, 2, [](int i, int j) { return std::array{1.0 * i, 1.0 * i * j, 0.0}; });
  EXPECT_TRUE(degenerate(fan, 0, 0.6));
  EXPECT_FALSE(degenerate(fan, 0x1p-1000, 0.6));
  EXPECT_FALSE(degenerate(fan, 1, 0.6));
  EXPECT_FALSE(is_degenerate({0, 0, Rational::power_of_two(-5000)}));
  EXPECT_FALSE(is_degenerate({-1, 0, 0}));
}

TEST(NormalVector, RefusesWhatIsNoVertexMap) {
  const Patch patch = make_patch<4>(2, 2, [](int i, int j) {
    return std::array{1.0 * i, 1.0 * j, 0.0, 1.0};
  });
  const Argument u = at(0.5);
  std::vector<Surface> surface = patch.surface();
  const auto expect_rejected = [&] {
    EXPECT_THROW(normal_vector(surface, u, u), std::invalid_argument);
    EXPECT_THROW(normal_acceptance(surface, u, u), std::invalid_argument);
  };
  surface.push_back(surface.back());
  expect_rejected();
  surface.resize(2);
  expect_rejected();
  surface.clear();
  expect_rejected();
  for (const auto& change : {+[](Surface& s) { s.u.order = 1; }, +[](Surface& s) { s.v.order = 1; },
                             +[](Surface& s) { s.u.first = -1; }, +[](Surface& s) { s.u.last = 2; },
                             +[](Surface& s) { s.v.first = -1; }, +[](Surface& s) { s.v.last = 2; },
                             +[](Surface& s) { s.u.order = 0; }, +[](Surface& s) { s.v.order = 65; }}) {
    surface = patch.surface();
    change(surface[2]);
    expect_rejected();
  }
  surface = patch.surface();
  EXPECT_THROW(normal_vector(surface, at(std::numeric_limits<double>::infinity()), u), std::domain_error);
  for (Surface& s : surface) s.u.last = s.u.first;
  EXPECT_THROW(normal_vector(surface, u, u), std::domain_error);
  EXPECT_THROW(normal_acceptance(surface, u, u), std::domain_error);
}

}  // namespace
}  // namespace evalcts::reference
