// The current values, and evaluated vertices made from them.
#pragma once

#include <glevaluator.h>

namespace glev {

// Keeps the current values and the last evaluated vertex. A vertex is large, and only the evaluated values
// differ between evaluations, so the last vertex is reused for the same plan until a current value changes.
class CurrentVertex {
 public:
  const glev_vertex& values() const { return current_; }  // position is not state
  glev_vertex& change() {
    staged_for_ = nullptr;
    return current_;
  }

  // Returns a vertex in which all values that `plan` does not evaluate have their current values. `plan` must
  // not be null.
  glev_vertex& staged_for(const void* plan) {
    if (staged_for_ != plan) {
      staged_ = current_;
      staged_for_ = plan;
    }
    return staged_;
  }
  // Returns this vertex if it is ready, otherwise null.
  glev_vertex* find_staged_for(const void* plan) { return staged_for_ == plan ? &staged_ : nullptr; }
  // Must be called when a plan is dropped, because another plan may get the same address.
  void unstage() { staged_for_ = nullptr; }

 private:
  glev_vertex current_{}, staged_{};
  const void* staged_for_ = nullptr;
};

}  // namespace glev
