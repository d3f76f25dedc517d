// Tests the statistics of errors, the textbook algorithms, and rows of the accuracy table for subjects with
// known errors.
#include <gtest/gtest.h>

#include <glevaluator.h>

#include <cmath>
#include <numeric>

#include <reference/filter.h>
#include <reference/rounding.h>

#include <evalcts/accuracy/digest.h>
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
  EXPECT_EQ(errors.mean_ulp(), 2);
  EXPECT_DOUBLE_EQ(errors.mean_condition_aware(), 2 * 2 / 5.0);
  EXPECT_EQ(errors.histogram[0], 1u);
  EXPECT_EQ(errors.histogram[2], 1u);
  EXPECT_EQ(errors.histogram[4], 1u);
}

TEST(Errors, BinsEndWithPowersOfTwo) {
  const auto bin = [](double ulp) {
    const Errors errors = errors_of({{1.0F, {Rational(1) - Rational(ulp * 0x1p-24), 1}}});
    return std::find(errors.histogram.begin(), errors.histogram.end(), 1u) - errors.histogram.begin();
  };
  EXPECT_EQ(bin(0), 0);
  EXPECT_EQ(bin(0.5), 0);
  EXPECT_EQ(bin(0.5000001), 1);
  EXPECT_EQ(bin(1), 1);
  EXPECT_EQ(bin(1.5), 2);
  EXPECT_EQ(bin(2), 2);
  EXPECT_EQ(bin(0x1p22), 23);
  EXPECT_EQ(bin(0x1.8p22), 24);
}

TEST(Errors, ZerosAreCountedApart) {
  const Errors errors = errors_of({{0.0F, {0, 3}},
                                   {-0.0F, {0, 3}},
                                   {0x1p-20F, {0, 1}},
                                   {0x1p-10F, {0, 0x1p20}},
                                   {0.0F, {0, 0}},
                                   {1.0F, {0, 0}}});
  EXPECT_EQ(errors.values, 0u);
  EXPECT_EQ(errors.zeros, 4u);
  EXPECT_EQ(errors.zeros_wrong, 2u);
  EXPECT_EQ(errors.zero.error, 16);
  EXPECT_EQ(errors.zero.got, 0x1p-20F);
  EXPECT_EQ(errors.without_terms, 2u);
  EXPECT_EQ(errors.without_terms_wrong, 1u);
  EXPECT_LT(errors.ulp.error, 0) << "none";
}

TEST(Errors, WhatIsNotFiniteIsNotInTheMeans) {
  const Errors errors = errors_of({{NAN, {1, 1}}, {INFINITY, {1, 1}}, {1.0F, {1, 1}}});
  EXPECT_EQ(errors.values, 3u);
  EXPECT_EQ(errors.not_correctly_rounded, 2u);
  EXPECT_EQ(errors.not_finite, 2u);
  EXPECT_EQ(errors.mean_ulp(), 0);
  EXPECT_TRUE(std::isinf(errors.ulp.error));
  EXPECT_EQ(std::accumulate(errors.histogram.begin(), errors.histogram.end(), std::uint64_t{0}), 1u);
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
  void evaluate(GLenum, const Map& map, std::span<const float> u, std::span<const float> v,
                std::span<float> results) override {
    for (int k = 0; k < map.components; ++k) {
      const reference::BernsteinForm form(reference::Surface{map.points.data() + k,
                                                             map.vorder * map.components, map.components,
                                                             map.uorder, map.vorder, 0, 1, 0, 1});
      for (std::size_t i = 0; i < u.size(); ++i) {
        float& result = results[i * map.components + k];
        result = form.to_float(reference::Argument::coordinate(u[i]),
                               reference::Argument::coordinate(v.empty() ? 0 : v[i]));
        for (int n = 0; n < floats_; ++n) result = std::nextafter(result, INFINITY);
      }
    }
  }

 private:
  int floats_;
};

Errors measured(Subject& subject, const Class& what, std::uint32_t seed = 1) {
  const std::atomic<bool> never = false;
  return measure(subject, {what, "vertex_3", 3000, seed}, never);
}

TEST(AccuracyTable, MeasuresWhatASubjectIsOff) {
  for (const Class& what : {Class{4, 0, "ordinary"}, Class{3, 8, "ordinary"}, Class{30, 30, "wide"}}) {
    Shifted right(0), one(1), seven(7);
    const Errors none = measured(right, what);
    EXPECT_GE(none.values, 3000u);
    EXPECT_EQ(none.not_correctly_rounded, 0u) << what.name();
    EXPECT_LE(none.ulp.error, 0.5);
    EXPECT_GT(none.mean_ulp(), 0.2);
    const Errors off = measured(one, what);
    EXPECT_EQ(off.not_correctly_rounded, off.values);
    EXPECT_GT(off.ulp.error, 1.4);
    EXPECT_LE(off.ulp.error, 2) << "at a power of two half of the gaps are as wide";
    EXPECT_NEAR(off.mean_ulp(), 1, 0.05);
    EXPECT_NEAR(measured(seven, what).mean_ulp(), 7, 0.2);
  }
}

TEST(AccuracyTable, SeesZerosOfCancellingMaps) {
  Shifted one(1);
  const Errors errors = measured(one, {4, 0, "cancelling"});
  EXPECT_GT(errors.zeros, 0u);
  EXPECT_EQ(errors.zeros_wrong, errors.zeros);
  EXPECT_EQ(errors.zero.got, 0x1p-149F);
}

TEST(AccuracyTable, DependsOnTheSeed) {
  Shifted right(0);
  const Class what = {4, 0, "ordinary"};
  EXPECT_EQ(measured(right, what, 5).mean_ulp(), measured(right, what, 5).mean_ulp());
  EXPECT_NE(measured(right, what, 5).mean_ulp(), measured(right, what, 6).mean_ulp());
}

TEST(AccuracyTable, WorstInputsGiveTheSameAgain) {
  for (const SubjectKind& kind : own_subjects()) {
    const auto subject = open_subject({kind.name});
    for (const Class& what : {Class{6, 0, "ordinary"}, Class{3, 8, "wide"}}) {
      const Errors errors = measured(*subject, what);
      EXPECT_EQ(replay(*subject, "vertex_3", errors.ulp.input), errors.ulp.got) << kind.name;
      EXPECT_EQ(replay(*subject, "vertex_4", errors.condition_aware.input), errors.condition_aware.got)
          << kind.name;
    }
  }
}

// For small integers as control points and arguments with few bits, no algorithm rounds.
TEST(Textbook, IsExactWhereNothingIsRounded) {
  const Map map{3, 4, 1, true, {0, 1, 0, 1}, {1, -2, 3, 5, -7, 11, 2, 0, 6, -1, 4, 8}};
  const std::vector<float> u = {0, 0.5F, 1, 0.25F}, v = {0.5F, 0.5F, 1, 0.75F};
  for (const SubjectKind& kind : own_subjects()) {
    std::vector<float> got(u.size());
    open_subject({kind.name})->evaluate(GL_MAP2_TEXTURE_COORD_1, map, u, v, got);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const reference::Surface surface = {map.points.data(), 4, 1, 3, 4, 0, 1, 0, 1};
      EXPECT_EQ(Rational(got[i]), reference::evaluate(surface, reference::Argument::coordinate(u[i]),
                                                      reference::Argument::coordinate(v[i])))
          << kind.name;
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

std::uint64_t digest_of(const StreamSource& source, std::uint64_t values, int threads = 1,
                        std::uint32_t seed = 1) {
  const std::atomic<bool> never = false;
  return digest(source, {values, seed, threads}, never);
}

// Correctly rounded results are the same everywhere, so this number may change only if the generator of
// inputs changes. A longer digest of this kind is published.
TEST(Digest, IsTheSameOnEveryInstructionSet) {
  for (std::size_t i = 0; glevGetTargetName(i) != nullptr; ++i)
    EXPECT_EQ(digest_of(production_source(glevGetTargetName(i)), 100'000), 2974708037908367321u)
        << glevGetTargetName(i);
}

TEST(Digest, OfProductionIsThatOfTheOracle) {
  EXPECT_EQ(digest_of(stream_source({"production"}), 12'345),
            digest_of(stream_source({"reference"}), 12'345));
}

TEST(Digest, DependsOnResultsAndNotOnThreads) {
  const StreamSource source = stream_source({"production"});
  const std::uint64_t one = digest_of(source, 10'000);
  EXPECT_EQ(digest_of(source, 10'000, 3), one);
  EXPECT_NE(digest_of(source, 9'999), one);
  EXPECT_NE(digest_of(source, 10'000, 1, 2), one);
  EXPECT_NE(digest_of(stream_source({"sum-float"}), 10'000), one);
}

TEST(AccuracyTargets, HaveTokensOfBothDimensions) {
  EXPECT_EQ(target_of("vertex_3", false), static_cast<GLenum>(GL_MAP1_VERTEX_3));
  EXPECT_EQ(target_of("texture_coord_4", true), static_cast<GLenum>(GL_MAP2_TEXTURE_COORD_4));
  EXPECT_EQ(target_names().size(), 8u);
  EXPECT_THROW(target_of("index", false), std::invalid_argument);
}

}  // namespace
}  // namespace evalcts::accuracy
