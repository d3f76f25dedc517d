// Tests components: exact values, bounds and rounding of the output of the executable specification.
#include <gtest/gtest.h>
#include <reference/component.h>
#include <reference/rounding.h>

#include <cmath>
#include <stdexcept>

namespace evalcts::reference {
namespace {

std::shared_ptr<const Map> curve_map() {
  return std::make_shared<const Map>(
      Map{GL_MAP1_VERTEX_3, {3, 0, 2}, {}, {1, -1, NAN, 1.0 / 3, -5, 0, 4, 7, 0}});
}

TEST(PlainComponent, IsExact) {
  const Component component = -2.5f;
  EXPECT_TRUE(is_finite(component));
  EXPECT_EQ(exact(component), Rational(-2.5));
  EXPECT_EQ(exact_with_magnitude(component).magnitude, Rational(2.5));
  EXPECT_EQ(rounded(component), -2.5f);
  EXPECT_TRUE(acceptance_bound(component).is_zero());
  EXPECT_TRUE(quality_bound(component).is_zero());
  EXPECT_TRUE(must_applies(component));
  EXPECT_TRUE(must_applies(Component(3e38f), kReducedRange));
  EXPECT_EQ(acceptance(component).exact, Rational(-2.5));
  EXPECT_TRUE(acceptance(component).bound.is_zero());
}

TEST(PlainComponent, MayBeNoNumber) {
  for (const float value : {NAN, INFINITY, -INFINITY}) {
    const Component component = value;
    EXPECT_FALSE(is_finite(component));
    EXPECT_THROW(exact(component), std::domain_error);
    EXPECT_THROW(acceptance(component), std::domain_error);
    EXPECT_THROW(acceptance_bound(component), std::domain_error);
  }
  EXPECT_EQ(rounded(Component(-INFINITY)), -INFINITY);
  EXPECT_TRUE(std::isnan(rounded(Component(NAN))));
}

void expect_sample(const Component& component, const Surface& surface, int degree, const Argument& u,
                   const Argument& v = {}) {
  const Evaluation evaluation = evaluate_with_magnitude(surface, u, v);
  EXPECT_TRUE(is_finite(component));
  EXPECT_EQ(exact(component), evaluation.value);
  EXPECT_EQ(exact_with_magnitude(component).magnitude, evaluation.magnitude);
  EXPECT_EQ(rounded(component), round_to_float(evaluation.value));
  EXPECT_EQ(acceptance_bound(component), acceptance_bound(surface, u, v));
  EXPECT_EQ(quality_bound(component), quality_bound(degree, evaluation.magnitude));
  EXPECT_EQ(acceptance(component).quality_bound, quality_bound(component));
  EXPECT_EQ(acceptance(component).bound, acceptance_bound(component));
  EXPECT_TRUE(must_applies(component));
}

TEST(SampleOfACurve, IsItsValue) {
  const auto map = curve_map();
  const Argument u = Argument::grid(1, 3, 0, 2);
  expect_sample(Sample(map, 0, u, std::nullopt), {map->points.data(), {3, 3, 0, 2}}, 2, u);
  const Component far = Sample(map, 0, Argument::coordinate(100), std::nullopt);
  EXPECT_TRUE(must_applies(far, kFullRange));
  EXPECT_FALSE(must_applies(far, kReducedRange));
  EXPECT_FALSE(acceptance(far, kReducedRange).must_applies);
}

TEST(SampleOfACurve, MayHaveNoValue) {
  const auto map = curve_map();
  const Component of_nan = Sample(map, 2, Argument::coordinate(1), std::nullopt);
  const Component at_infinity = Sample(map, 0, Argument::coordinate(INFINITY), std::nullopt);
  for (const Component& component : {of_nan, at_infinity}) {
    EXPECT_FALSE(is_finite(component));
    EXPECT_TRUE(std::isnan(rounded(component)));
    EXPECT_THROW(exact(component), std::domain_error);
    EXPECT_THROW(must_applies(component), std::domain_error);
    EXPECT_THROW(quality_bound(component), std::domain_error);
  }
}

TEST(SampleOfASurface, IsItsValue) {
  // Orders 2 and 3, two components; v varies fastest.
  const auto map = std::make_shared<const Map>(Map{
      GL_MAP2_TEXTURE_COORD_2, {2, 0, 1}, {3, 2, 4}, {0, 100, 1, 101, 2, 102, 10, 110, 11, 111, 12, 112}});
  const Argument u = Argument::coordinate(0.5), v = Argument::coordinate(3);
  const Component component = Sample(map, 1, u, v);
  expect_sample(component, {map->points.data() + 1, {6, 2, 0, 1}, {2, 3, 2, 4}}, 3, u, v);
  EXPECT_EQ(exact(component), Rational(106));  // 100 + 10 * u + (v - 2)
  EXPECT_EQ(exact(Sample(map, 0, Argument::coordinate(1), Argument::coordinate(2))), Rational(10));
  EXPECT_EQ(exact(Sample(map, 0, Argument::coordinate(0), Argument::coordinate(4))), Rational(2));
  EXPECT_FALSE(is_finite(Sample(map, 0, u, Argument::coordinate(NAN))));
}

TEST(GuaranteedRange, DependsOnTargetAndVersion) {
  EXPECT_EQ(guaranteed_range(GL_MAP1_VERTEX_3, 10), kFullRange);
  EXPECT_EQ(guaranteed_range(GL_MAP2_NORMAL, 10), kFullRange);
  EXPECT_EQ(guaranteed_range(GL_MAP1_INDEX, 10), kFullRange);
  EXPECT_EQ(guaranteed_range(GL_MAP1_COLOR_4, 46), kReducedRange);
  EXPECT_EQ(guaranteed_range(GL_MAP2_COLOR_4, 10), kReducedRange);
  for (GLenum i = 0; i < 4; ++i) {
    EXPECT_EQ(guaranteed_range(GL_MAP1_TEXTURE_COORD_1 + i, 15), kReducedRange);
    EXPECT_EQ(guaranteed_range(GL_MAP2_TEXTURE_COORD_1 + i, 15), kReducedRange);
    EXPECT_EQ(guaranteed_range(GL_MAP1_TEXTURE_COORD_1 + i, 20), kFullRange);
    EXPECT_EQ(guaranteed_range(GL_MAP2_TEXTURE_COORD_1 + i, 20), kFullRange);
  }
}

}  // namespace
}  // namespace evalcts::reference
