// Errors along the domain of a few curves: where they are large, and how near to a zero of the polynomial.
#pragma once

#include <string>
#include <vector>

#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {

struct ProfileCurve {
  std::string name, what;
  std::vector<double> points;
};
// The same for everybody.
const std::vector<ProfileCurve>& profile_curves();

// [0,1] is divided into so many intervals of the same width.
inline constexpr int kProfileBins = 256;

// The zeros that its polynomial has between 0 and 1, to seven digits.
std::vector<double> zeros_of(const ProfileCurve& curve);

// Errors of an implementation along a curve, to four digits: the largest in each interval.
struct Profile {
  std::string curve;
  std::string not_measured;  // why there are no errors; empty if there are
  std::vector<double> max_ulp, max_condition_aware;
};

// Samples 16 multiples of 2^-24 spread over each interval; the errors of an exact zero count for the
// condition-aware error only. Throws NotObservable.
Profile measure_profile(Subject& subject, const std::string& target, const ProfileCurve& curve);

}  // namespace evalcts::accuracy
