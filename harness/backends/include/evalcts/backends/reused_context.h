// One shared context for all cases: the second pass of a run, which finds bugs that depend on history. Fresh
// contexts remain the rule, because restoring state by calls hides bugs of the initial state.
#pragma once

#include <memory>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/case.h>

namespace evalcts {

// The shader programs of captures: made for each case, or kept by the shared context.
enum class Programs { kMadeAnew, kKept };
// Returns an implementation whose create_context() returns handles to a single context of `inner`, which the
// first call creates. Each further call restores the state first: it closes what earlier cases left open,
// deletes the objects that they made, and runs restoring_commands(). No other context of `inner` may be
// created while the implementation exists, because it would become current. `inner` must outlive the returned
// implementation. `programs` determines if captures make their shader programs for each case, or keep them.
// To keep them is much faster, but less like a fresh context.
std::unique_ptr<Implementation> reuse_context(Implementation& inner, const ImplementationInfo& info,
                                              Programs programs = Programs::kMadeAnew);

// Returns the commands that set all state that a case or capture can change to its initial value. Commands
// for features that the implementation does not support may raise errors, which the player must drain.
gl::Case restoring_commands(const ImplementationInfo& info);

}  // namespace evalcts
