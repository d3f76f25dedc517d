// Queries that an implementation does not answer. An error that they leave behind would be taken for that of
// the command under test.
#pragma once

#include <memory>
#include <set>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Returns the names, among those of state outside evaluators that tests query, and MAX_EVAL_ORDER, that raise
// an error in GetFloatv in a fresh context.
std::set<GLenum> find_refused_queries(Implementation& implementation);

// The implementation without these queries: outside Begin and End, GetBooleanv, GetIntegerv, GetFloatv and
// GetDoublev of one of the names do nothing. At most one such implementation at a time.
std::unique_ptr<Implementation> without_queries(std::unique_ptr<Implementation> inner,
                                                const std::set<GLenum>& names);

}  // namespace evalcts
