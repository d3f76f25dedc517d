// The current values, and evaluated vertices made from them.
#pragma once

#include <glevaluator.h>

namespace glev {

// A vertex is large, and from one evaluation to the next only the evaluated values differ: the last evaluated
// one is kept, and is good for the same plan until a current value changes.
class CurrentVertex {
 public:
  const glev_vertex& values() const { return current_; }  // position is not state
  glev_vertex& change() {
    staged_for_ = nullptr;
    return current_;
  }

  // Everything but what `plan`, not null, evaluates has its current value.
  glev_vertex& staged_for(const void* plan) {
    if (staged_for_ != plan) {
      staged_ = current_;
      staged_for_ = plan;
    }
    return staged_;
  }
  // The same if it is ready, else null.
  glev_vertex* find_staged_for(const void* plan) { return staged_for_ == plan ? &staged_ : nullptr; }
  // A plan may be gone, and another one be where it was.
  void unstage() { staged_for_ = nullptr; }

 private:
  glev_vertex current_{}, staged_{};
  const void* staged_for_ = nullptr;
};

}  // namespace glev
