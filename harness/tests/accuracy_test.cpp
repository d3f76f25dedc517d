// Tests the statistics of errors, the textbook algorithms, and rows of the accuracy table for subjects with
// known errors.
#include <gtest/gtest.h>

#include <cmath>

#include <reference/filter.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/table.h>

namespace evalcts::accuracy {
namespace {

using reference::Evaluation, reference::Rational;

Errors errors_of(std::initializer_list<std::pair<float, Evaluation>> results) {
  Errors errors;
  Input input;
  for (const auto& [got, exact] : results) {
    input.u += 1;
    errors.add(got, exact, input);
  }
  return errors;
}

TEST(Errors, AreCountedInUlpAndBesideTheCondition) {
  // The results are 1.75 and 4.25 ULP above 1.25. The magnitudes of the terms sum up to 5.
  const Rational x = 1.25;
  const Errors errors = errors_of({{1.25F, {x, 5}},
                                   {1.25F + 0x1p-22F, {x + Rational(0x1p-25), 5}},
                                   {1.25F + 0x1p-21F, {x - Rational(0x1p-25), 5}}});
  EXPECT_EQ(errors.values, 3u);
  EXPECT_EQ(errors.not_correctly_rounded, 2u);
  EXPECT_EQ(errors.ulp.error, 4.25);
  EXPECT_EQ(errors.ulp.got, 1.25F + 0x1p-21F);
  EXPECT_EQ(errors.ulp.right, 1.25F);
  EXPECT_EQ(errors.ulp.input.u, 3);
  EXPECT_EQ(errors.condition_aware.error, 4.25 * 2 / 5);
  EXPECT_EQ(errors.mean(errors.sum_of_ulp), 2);
  EXPECT_DOUBLE_EQ(errors.mean(errors.sum_of_condition_aware), 2 * 2 / 5.0);
}

TEST(Errors, ZerosAreCountedApart) {
  const Errors errors = errors_of({{0.0F, {0, 3}},
                                   {-0.0F, {0, 3}},
                                   {0x1p-20F, {0, 1}},
                                   {0x1p-10F, {0, 0x1p20}},
                                   {0.0F, {0, 0}},
                                   {1.0F, {0, 0}}});
  EXPECT_EQ(errors.values, 0u);
  EXPECT_EQ(errors.zeros, 6u);
  EXPECT_EQ(errors.zeros_wrong, 3u);
  EXPECT_LT(errors.ulp.error, 0) << "none";
}

TEST(Errors, WhatIsNotFiniteIsNotInTheMeans) {
  const Errors errors = errors_of({{NAN, {1, 1}}, {INFINITY, {1, 1}}, {1.0F, {1, 1}}});
  EXPECT_EQ(errors.values, 3u);
  EXPECT_EQ(errors.not_correctly_rounded, 2u);
  EXPECT_EQ(errors.not_finite, 2u);
  EXPECT_EQ(errors.mean(errors.sum_of_ulp), 0);
  EXPECT_TRUE(std::isinf(errors.ulp.error));
  // If the exact value is out of range, infinity is correct.
  const Errors large = errors_of({{INFINITY, {Rational::power_of_two(130), Rational::power_of_two(130)}}});
  EXPECT_EQ(large.not_finite, 0u);
  EXPECT_EQ(large.not_correctly_rounded, 0u);
}

// A subject whose results are `floats` floats above the correctly rounded results.
class Shifted final : public Subject {
 public:
  explicit Shifted(int floats) : floats_(floats) {}
  ImplementationInfo info() const override { return {}; }
  std::vector<float> evaluate(GLenum, const Map& map, std::span<const float> u,
                              std::span<const float> v) override {
    std::vector<float> results(u.size() * map.components);
    for (int k = 0; k < map.components; ++k) {
      const reference::BernsteinForm form(reference::Surface{map.points.data() + k,
                                                             {map.vorder * map.components, map.uorder, 0, 1},
                                                             {map.components, map.vorder, 0, 1}});
      for (std::size_t i = 0; i < u.size(); ++i) {
        float& result = results[i * map.components + k];
        result = form.to_float(reference::Argument::coordinate(u[i]),
                               reference::Argument::coordinate(v.empty() ? 0 : v[i]));
        for (int n = 0; n < floats_; ++n) result = std::nextafter(result, INFINITY);
      }
    }
    return results;
  }

 private:
  int floats_;
};

Errors measured(Subject& subject, const Class& what, std::uint32_t seed = 1) {
  const std::atomic<bool> never = false;
  return measure(subject, {what, "vertex_3", 3000, seed}, never);
}

double mean_ulp(const Errors& errors) { return errors.mean(errors.sum_of_ulp); }

TEST(AccuracyTable, MeasuresWhatASubjectIsOff) {
  for (const Class& what : {Class{4, 0, "ordinary"}, Class{3, 8, "ordinary"}, Class{30, 30, "wide"}}) {
    Shifted right(0), one(1), seven(7);
    const Errors none = measured(right, what);
    EXPECT_GE(none.values, 3000u);
    EXPECT_EQ(none.not_correctly_rounded, 0u) << what.name();
    EXPECT_LE(none.ulp.error, 0.5);
    EXPECT_GT(mean_ulp(none), 0.2);
    const Errors off = measured(one, what);
    EXPECT_EQ(off.not_correctly_rounded, off.values);
    EXPECT_GT(off.ulp.error, 1.4);
    EXPECT_LE(off.ulp.error, 2) << "at a power of two half of the gaps are as wide";
    EXPECT_NEAR(mean_ulp(off), 1, 0.05);
    EXPECT_NEAR(mean_ulp(measured(seven, what)), 7, 0.2);
  }
}

TEST(AccuracyTable, SeesZerosOfCancellingMaps) {
  Shifted one(1);
  const Errors errors = measured(one, {4, 0, "cancelling"});
  EXPECT_GT(errors.zeros, 0u);
  EXPECT_EQ(errors.zeros_wrong, errors.zeros);
}

TEST(AccuracyTable, DependsOnTheSeed) {
  Shifted right(0);
  const Class what = {4, 0, "ordinary"};
  EXPECT_EQ(mean_ulp(measured(right, what, 5)), mean_ulp(measured(right, what, 5)));
  EXPECT_NE(mean_ulp(measured(right, what, 5)), mean_ulp(measured(right, what, 6)));
}

TEST(AccuracyTable, WorstInputsGiveTheSameAgain) {
  for (const std::string& name : own_subjects()) {
    const auto subject = open_subject({name});
    for (const Class& what : {Class{6, 0, "ordinary"}, Class{3, 8, "wide"}}) {
      const Errors errors = measured(*subject, what);
      EXPECT_EQ(replay(*subject, "vertex_3", errors.ulp.input), errors.ulp.got) << name;
      EXPECT_EQ(replay(*subject, "vertex_4", errors.condition_aware.input), errors.condition_aware.got)
          << name;
    }
  }
}

// For small integers as control points and arguments with few bits, no algorithm rounds.
TEST(Textbook, IsExactWhereNothingIsRounded) {
  const Map map{3, 4, 1, kUnitDomain, 0, {1, -2, 3, 5, -7, 11, 2, 0, 6, -1, 4, 8}};
  const std::vector<float> u = {0, 0.5F, 1, 0.25F}, v = {0.5F, 0.5F, 1, 0.75F};
  for (const std::string& name : own_subjects()) {
    const std::vector<float> got = open_subject({name})->evaluate(GL_MAP2_TEXTURE_COORD_1, map, u, v);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const reference::Surface surface = {map.points.data(), {4, 3, 0, 1}, {1, 4, 0, 1}};
      EXPECT_EQ(Rational(got[i]), reference::evaluate(surface, reference::Argument::coordinate(u[i]),
                                                      reference::Argument::coordinate(v[i])))
          << name;
    }
  }
}

// The bounds follow from the number of rounded operations for each term. They are tight enough to distinguish
// algorithms in float from algorithms in double.
TEST(Textbook, ErrorsAreThoseOfTheirPrecision) {
  const Class what = {10, 0, "ordinary"};
  for (const char* name : {"casteljau", "horner", "sum"}) {
    const auto single = open_subject({std::string(name) + "-float"});
    const auto twice = open_subject({std::string(name) + "-double"});
    const Errors rough = measured(*single, what), fine = measured(*twice, what);
    EXPECT_GT(rough.condition_aware.error, 1) << name;
    EXPECT_LT(rough.condition_aware.error, 5 * 9 + 1) << name;
    EXPECT_LE(fine.condition_aware.error, 1.001) << name;
    EXPECT_LT(fine.not_correctly_rounded, rough.not_correctly_rounded / 100) << name;
  }
}

// The polynomial of the profile has three zeros, where the errors of a subject in float are large.
TEST(AccuracyProfile, IsHighAtZeros) {
  const std::vector<double> errors = measure_profile(*open_subject({"horner-float"}), "vertex_3");
  ASSERT_EQ(errors.size(), 256u);
  std::size_t peaks = 0;
  for (std::size_t i = 1; i + 1 < errors.size(); ++i)
    if (errors[i] > 100 && errors[i] > errors[i - 1] && errors[i] >= errors[i + 1]) ++peaks;
  EXPECT_EQ(peaks, 3u);
  Shifted right(0);
  for (const double error : measure_profile(right, "vertex_3")) EXPECT_LE(error, 0.5);
}

TEST(AccuracyTargets, HaveTokensOfBothDimensions) {
  EXPECT_EQ(target_of("vertex_3", false), static_cast<GLenum>(GL_MAP1_VERTEX_3));
  EXPECT_EQ(target_of("texture_coord_4", true), static_cast<GLenum>(GL_MAP2_TEXTURE_COORD_4));
  EXPECT_EQ(target_names().size(), 8u);
  EXPECT_THROW(target_of("index", false), std::invalid_argument);
}

}  // namespace
}  // namespace evalcts::accuracy
