// Finds and leaves out queries that an implementation rejects, because their errors would be taken for errors
// of the command under test.
#pragma once

#include <memory>
#include <set>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Returns the names for which GetFloatv raises an error in a fresh context, among MAX_EVAL_ORDER and the
// names of state outside evaluators that tests query.
std::set<GLenum> find_rejected_queries(Implementation& implementation);

// Wraps an implementation so that outside Begin and End, GetBooleanv, GetIntegerv, GetFloatv and GetDoublev
// of one of the names do nothing. At most one such implementation may exist at a time.
std::unique_ptr<Implementation> without_queries(std::unique_ptr<Implementation> inner,
                                                const std::set<GLenum>& names);

}  // namespace evalcts
