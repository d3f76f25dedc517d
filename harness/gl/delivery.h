// Deliveries: a case is written once, with the f commands, and delivered through other commands that have to
// do the same.
#pragma once

#include <vector>

#include "harness/gl/case.h"

namespace evalcts::gl {

struct Delivery {
  const char* name;  // part of test names: the command that evaluates
  bool doubles;      // Map1d and EvalCoord1d instead of Map1f and EvalCoord1f
  bool arrays;       // EvalCoord1fv, EvalCoord1dv

  // The case with its Map1 and EvalCoord1 commands replaced, one for one: Refs stay what they are. Values
  // that need doubles lose their last digits on the way to floats.
  Case apply(const Case& script) const;
};

// Through f, fv, d and dv.
const std::vector<Delivery>& deliveries();

}  // namespace evalcts::gl
