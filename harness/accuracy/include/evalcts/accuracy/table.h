// Measurement of the errors of a subject: rows of the accuracy table, a curve along its domain, single
// inputs.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include <evalcts/accuracy/errors.h>
#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {

struct RowRequest {
  Class what;
  std::string target;
  std::uint64_t values = 0;  // the least number of values
  std::uint32_t seed = 1;
};

// Measures the errors of random maps of the class at random arguments. All subjects get the same maps and
// arguments. Ends early when `stop` becomes true. Throws NotObservable.
Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop);

// Searches for inputs with larger errors than those of measure(), by hill climbing from its worst inputs.
// Half of `request.values` results maximise the error in ULP, half the condition-aware error. Each step moves
// to the worst of many neighbours, whose control points and arguments differ in some bits; if there is no
// progress for a while, the search restarts from a random input. Larger errors replace errors.ulp and
// errors.condition_aware; other members of `errors` do not change. The outcome depends only on the request
// and the results of the subject. Ends early when `stop` becomes true. Throws NotObservable.
void climb(Subject& subject, const RowRequest& request, Errors& errors, const std::atomic<bool>& stop);

// A cubic with three zeros over [0,1].
const std::vector<double>& profile_curve();

// Returns the largest error in ULP of the curve in each of 256 intervals of [0,1], of 16 arguments spread
// over the interval. Throws NotObservable.
std::vector<double> measure_profile(Subject& subject, const std::string& target);

// Evaluates the input again and returns the result. All components of the target get its polynomial.
float replay(Subject& subject, const std::string& target, const Input& input);

}  // namespace evalcts::accuracy
