// Errors along the domain of a few curves, which show how errors grow near the zeros of a polynomial.
#pragma once

#include <string>
#include <vector>

#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {

struct ProfileCurve {
  std::string name, what;
  std::vector<double> points;
};
// Returns the curves, which are the same for all implementations.
const std::vector<ProfileCurve>& profile_curves();

// Number of intervals of equal width into which [0,1] is divided.
inline constexpr int kProfileBins = 256;

// Returns the zeros of the curve in [0,1], rounded to seven decimal places.
std::vector<double> zeros_of(const ProfileCurve& curve);

// The largest errors of an implementation in each interval of a curve, to four significant digits.
struct Profile {
  std::string curve;
  std::string not_measured;  // reason if there are no errors, otherwise empty
  std::vector<double> max_ulp, max_condition_aware;
};

// Evaluates the curve at 16 multiples of 2^-24 spread over each interval. An exact zero contributes to the
// condition-aware error only. Throws NotObservable.
Profile measure_profile(Subject& subject, const std::string& target, const ProfileCurve& curve);

}  // namespace evalcts::accuracy
