// Errors along the domain of a few curves: where they are large, and how near to a zero of the polynomial.
#pragma once

#include <string>
#include <vector>

#include <evalcts/accuracy/subject.h>
#include <evalcts/results/json.h>

namespace evalcts::accuracy {

struct ProfileCurve {
  std::string name, what;
  std::vector<double> points;
};
// The same for everybody.
const std::vector<ProfileCurve>& profile_curves();

// [0,1] is divided into so many intervals of the same width.
inline constexpr int kProfileBins = 256;

// The curves, with the zeros that their polynomials have between 0 and 1 to seven digits: what the profiles
// of all implementations have in common (reports/schema/ulp-1.schema.json).
nlohmann::json profile_curves_as_json();

// The largest errors in each interval, of 16 multiples of 2^-24 spread over it; those of an exact zero count
// for the condition-aware error only. Throws NotObservable.
nlohmann::json profile_as_json(Subject& subject, const std::string& target, const ProfileCurve& curve);

}  // namespace evalcts::accuracy
