#include "harness/capture/capture.h"

namespace evalcts {

std::vector<std::unique_ptr<Capture>> all_captures() {
  std::vector<std::unique_ptr<Capture>> captures;
  captures.push_back(make_sink());
  captures.push_back(make_transform_feedback());
  captures.push_back(make_feedback_buffer());
  return captures;
}

WrappedCase begin_wrapping(gl::Case prologue, const gl::Case& script) {
  WrappedCase wrapped{std::move(prologue), {}, {}};
  wrapped.error_before = wrapped.commands.GetError();
  wrapped.commands.append(script);
  wrapped.error_after = wrapped.commands.GetError();
  return wrapped;
}

}  // namespace evalcts
