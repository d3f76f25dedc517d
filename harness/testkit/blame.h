// The requirements of a test that a wrong observation violates.
#pragma once

#include <vector>

#include <evalcts/results/requirement_id.h>

namespace evalcts {

enum class Observed {
  kError,           // an error that is due and missing, or one that is not due
  kCompilingError,  // the same while a display list is compiled
  kAnswer,          // the answer of a query
  kChange,          // the answer of a query that was another one before, and must be the same
  kWritten,         // an array into which a rejected query must not write
};

// Returns the requirements of a test that a wrong observation of this kind violates.
std::vector<RequirementId> violated_by(Observed observed, const std::vector<RequirementId>& requirements);

}  // namespace evalcts
