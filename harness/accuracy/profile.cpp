// Defines the curves of profiles, finds their zeros, and measures the errors of a subject along them.
#include <evalcts/accuracy/profile.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <reference/bernstein_form.h>
#include <reference/rounding.h>

#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

constexpr int kArgumentsOfBin = 16;
constexpr int kLog2Steps = 24;

reference::BernsteinForm form_of(const ProfileCurve& curve) {
  return reference::BernsteinForm(
      reference::Curve{curve.points.data(), 1, static_cast<int>(curve.points.size()), 0, 1});
}

int sign_at(const reference::BernsteinForm& form, int step, int log2_steps) {
  const reference::Rational value =
      form.evaluate(reference::Argument::coordinate(std::ldexp(static_cast<double>(step), -log2_steps)));
  return value.is_zero() ? 0 : value > 0 ? 1 : -1;
}

}  // namespace

const std::vector<ProfileCurve>& profile_curves() {
  static const std::vector<ProfileCurve> kAll = {
      {"cubic", "a cubic with three zeros", {0.37F, -0.98F, 0.87F, -0.31F}},
      {"triple-zero", "(1 - 2u)^3, a zero of three", {1, -1, 1, -1}},
      {"order-10",
       "degree 9, ordinary control points",
       {-0.96515F, -0.28550F, -0.97586F, 0.36928F, -0.55154F, 0.79035F, 0.60867F, -0.48497F, -0.63306F,
        -0.35262F}},
      {"order-20",
       "degree 19, control points of alternating sign: all terms are large, their sum is small",
       {1,     -0.75F, 1.25F, -1,     0.75F, -1.25F, 1,     -0.75F, 1.25F, -1,
        0.75F, -1.25F, 1,     -0.75F, 1.25F, -1,     0.75F, -1.25F, 1,     -0.75F}},
  };
  return kAll;
}

// Finds sign changes on a grid that is fine enough for these curves, then uses bisection.
std::vector<double> zeros_of(const ProfileCurve& curve) {
  constexpr int kLog2Grid = 10;
  const reference::BernsteinForm form = form_of(curve);
  std::vector<double> zeros;
  int before = 0;
  for (int i = 0; i <= 1 << kLog2Grid; ++i) {
    const int now = sign_at(form, i, kLog2Grid);
    if (now == 0) {
      zeros.push_back(std::ldexp(static_cast<double>(i), -kLog2Grid));
    } else if (before * now < 0) {
      int low = (i - 1) << (kLog2Steps - kLog2Grid), high = i << (kLog2Steps - kLog2Grid);
      while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (sign_at(form, middle, kLog2Steps) == before ? low : high) = middle;
      }
      zeros.push_back(std::ldexp(static_cast<double>(high), -kLog2Steps));
    }
    before = now;
  }
  for (double& zero : zeros) zero = std::round(zero * 1e7) / 1e7;
  return zeros;
}

Profile measure_profile(Subject& subject, const std::string& target_name, const ProfileCurve& curve) {
  const GLenum target = target_of(target_name, false);
  Map map{static_cast<int>(curve.points.size()), 1, gl::components_of(target), true, {0, 1, 0, 1}, {}};
  for (const double point : curve.points) map.points.insert(map.points.end(), map.components, point);
  constexpr int kWidth = (1 << kLog2Steps) / kProfileBins;
  // Random offsets avoid arguments that all lie midway between two fractions of small denominators.
  Random random(1, 0);
  const reference::BernsteinForm form = form_of(curve);
  std::vector<float> u(kProfileBins), results(u.size() * map.components);
  std::vector<double> ulp(kProfileBins), condition(kProfileBins);
  for (int i = 0; i < kArgumentsOfBin; ++i) {
    constexpr int kPart = kWidth / kArgumentsOfBin;
    for (int bin = 0; bin < kProfileBins; ++bin)
      u[bin] = std::ldexp(
          static_cast<float>(bin * kWidth + i * kPart + static_cast<int>(random.below(kPart))), -kLog2Steps);
    subject.evaluate(target, map, u, {}, results);
    for (int bin = 0; bin < kProfileBins; ++bin) {
      const float got = results[bin * map.components];
      const reference::Evaluation exact =
          form.evaluate_with_magnitude(reference::Argument::coordinate(u[bin]));
      condition[bin] =
          std::max(condition[bin], reference::condition_distance(got, exact.value, exact.magnitude));
      if (!exact.value.is_zero()) ulp[bin] = std::max(ulp[bin], reference::ulp_distance(got, exact.value));
    }
  }
  // A picture does not show more than four digits.
  const auto round = [](std::vector<double>& errors) {
    for (double& error : errors)
      if (std::isfinite(error)) error = std::stod(fmt::format("{:.4g}", error));
  };
  round(ulp);
  round(condition);
  return {curve.name, {}, std::move(ulp), std::move(condition)};
}

}  // namespace evalcts::accuracy
