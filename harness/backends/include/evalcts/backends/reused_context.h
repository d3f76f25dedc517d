// One context for all cases: the second pass of a run, which hunts defects that depend on history. (A fresh
// context for every pass of a case stays the rule: restoring state by calls hides defects of the initial
// state.)
#pragma once

#include <memory>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/case.h>

namespace evalcts {

// An implementation whose create_context() gives a handle to one and the same context of `inner`, made at the
// first call; at each further call its state is restored by calls first: what the cases before have left open
// is closed, what they made is deleted, and restoring_commands() are played. While it lives, no other context
// of `inner` may be made (it would become current). `inner` must outlive it. Captures make their programs
// anew for each case, unless those are kept: that is much faster, and less like a fresh context.
enum class Programs { made_anew, kept };
std::unique_ptr<Implementation> reuse_context(Implementation& inner, const ImplementationInfo& info,
                                              Programs programs = Programs::made_anew);

// The commands that give all state that a case or capture can have set its initial value: evaluators first.
// Errors of commands for what an implementation lacks are for the player to drain.
gl::Case restoring_commands(const ImplementationInfo& info);

}  // namespace evalcts
