// A hill-climbing search for inputs with larger errors than those of a random sample.
#pragma once

#include <atomic>
#include <cstdint>

#include <evalcts/accuracy/table.h>

namespace evalcts::accuracy {

// Searches from the worst inputs of `errors`, which measure() must have found for the same request. Half of
// `values` results maximise the error in ULP, half the condition-aware error. Each step moves to the worst of
// many neighbours, whose control points and arguments differ in some bits; if there is no progress for a
// while, the search restarts from a random input. Larger errors replace errors.ulp and
// errors.condition_aware; other members of `errors` do not change. The outcome depends only on the request,
// `values` and the results of the subject. Ends early when `stop` becomes true. Throws NotObservable.
void climb(Subject& subject, const RowRequest& request, std::uint64_t values, Errors& errors,
           const std::atomic<bool>& stop);

}  // namespace evalcts::accuracy
