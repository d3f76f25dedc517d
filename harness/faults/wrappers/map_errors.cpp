// Section 5: errors of Map1 and Map2.
#include <algorithm>

#include "harness/faults/forms.h"
#include "harness/gl/tokens.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(OrderZeroTaken, production, must, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1") {
  map1(in, [](auto call, auto go) {
    if (call.order == 0) call.order = 1;
    go(call);
  });
}

EVALCTS_FAULT(StrideErrorIsInvalidEnum, production, must, "EV-MAP1-ERR-STRIDE",
              "Map1d with a stride below k raises INVALID_ENUM") {
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    const bool wrong = gl::components_of(target) > stride;
    sound.Map1d(wrong ? 0 : target, u1, u2, stride, order, points);
  };
}

}  // namespace
}  // namespace evalcts::faults
