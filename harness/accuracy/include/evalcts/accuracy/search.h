// From the worst inputs of a random sample to worse ones.
#pragma once

#include <atomic>
#include <cstdint>

#include <evalcts/accuracy/table.h>

namespace evalcts::accuracy {

// Climbs from the worst inputs of `errors`, which measure() has found for the same request, half of `values`
// results by the error in ULP, half by the condition-aware one: again and again to the worst of many
// neighbours, whose control points and arguments differ in some bits, and from another random input where
// none has been worse for long. What is worse than errors.ulp and errors.condition_aware takes their place;
// nothing else of `errors` changes. Depends on the request, `values` and the subject's results alone. Throws
// NotObservable. Ends early when `stop` becomes true.
void climb(Subject& subject, const RowRequest& request, std::uint64_t values, Errors& errors,
           const std::atomic<bool>& stop);

}  // namespace evalcts::accuracy
