// What a case must emit: the case played on the executable specification, symbolically.
#pragma once

#include <reference/specification.h>

#include <vector>

#include "harness/gl/case.h"

namespace evalcts {

struct Prediction {
  std::vector<reference::Primitive> primitives;
  GLenum error = GL_NO_ERROR;  // the first error that the case raises

  std::size_t vertex_count() const;
  bool has_nonpositive_w() const;
};

// Commands that the specification does not have (pixel store, buffers, matrices) do not concern evaluators
// and are left out.
Prediction predict(const gl::Case& script, int max_eval_order);

}  // namespace evalcts
