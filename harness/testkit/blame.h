// The requirements of a test that a wrong observation violates.
#pragma once

#include <vector>

#include <evalcts/results/requirement_id.h>

namespace evalcts {

enum class Observed : unsigned {
  kError = 1,              // an error that is due and missing, or one that is not due
  kCompilingError = 2,     // the same while a display list is compiled
  kAnswer = 4,             // the answer of a query
  kChange = 8,             // the answer of a query that was another one before, and must be the same
  kWritten = 16,           // an array into which a rejected query must not write
  kEvaluatedVertex = 32,   // a current value of an evaluated vertex, for which no map is enabled
  kExplicitVertex = 64,    // a current value of an explicit vertex
  kAutomaticNormal = 128,  // a normal of AUTO_NORMAL on a surface with one w
  kRationalNormal = 256,   // the same on a surface with several w
};

// Returns the requirements that a wrong observation of this kind violates: some of those of the test, or the
// one to which the table of blame gives this kind of observation.
std::vector<RequirementId> violated_by(Observed observed, const std::vector<RequirementId>& requirements);

}  // namespace evalcts
