// One shared context for many cases: the warm context in which tests run first, and that of the second pass
// of a run, which finds bugs that depend on history. Fresh contexts decide, because restoring state by calls
// hides bugs of the initial state.
#pragma once

#include <memory>
#include <optional>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/case.h>
#include <evalcts/gl/player.h>

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

// A context that many tests share, beside the fresh contexts of an implementation. Making a context and its
// shader programs takes most of the time of a test.
class WarmContext {
 public:
  // Returns null if `inner` cannot make contexts beside others, or has a sink, for which a shared context is
  // not faster. `inner` must outlive the result.
  static std::unique_ptr<WarmContext> of(Implementation& inner, const ImplementationInfo& info);

  // The implementation all of whose contexts are this one, with the state restored.
  Implementation& implementation() { return *shared_; }
  // Restores the state and compares what can be queried of it with that of the new context. Returns false if
  // it differs; another context then replaces this one.
  bool restore();
  // True if so many contexts were replaced that the state of this library is not worth restoring, for example
  // because its answers change by themselves.
  bool is_hopeless() const { return replaced_ >= kMostReplaced; }
  // Replaces this context by another one.
  void renew();

 private:
  WarmContext(Implementation& inner, const ImplementationInfo& info);

  static constexpr int kMostReplaced = 16;

  std::unique_ptr<Implementation> beside_, shared_;
  ImplementationInfo info_;
  int replaced_ = 0;
  gl::Case queries_;
  std::optional<gl::Trace> initial_;
};

// Returns queries of all state that cases and captures change, as far as it can be queried by commands that
// this project knows.
gl::Case state_queries(const ImplementationInfo& info);

// Returns the commands that set all state that a case or capture can change to its initial value. Commands
// for features that the implementation does not support may raise errors, which the player must drain.
gl::Case restoring_commands(const ImplementationInfo& info);

}  // namespace evalcts
