#include <evalcts/capture/capture.h>

#include <algorithm>
#include <iostream>

namespace evalcts {

Attributes Capture::shown_of(Attributes wanted) const {
  const Attributes shown = wanted & (attributes() | inexact_attributes());
  const bool other_normals = wanted & ~shown & (kUnitNormal | kShaderNormal);
  return shown & kAllAttributes & ~(other_normals ? kNormal : 0u);
}

std::vector<std::unique_ptr<Capture>> all_captures() {
  std::vector<std::unique_ptr<Capture>> captures;
  captures.push_back(make_sink());
  captures.push_back(make_transform_feedback());
  captures.push_back(make_feedback_buffer());
  captures.push_back(make_pixels());
  return captures;
}

Captures::Captures(Implementation& implementation, const ImplementationInfo& info,
                   const std::vector<std::string>* names)
    : implementation_(implementation), info_(info) {
  for (auto& capture : all_captures())
    if (!names || std::find(names->begin(), names->end(), capture->name()) != names->end())
      captures_.push_back({std::move(capture)});
}

const Capture* Captures::at(std::size_t index) {
  Entry& entry = captures_.at(index);
  if (!entry.proved && entry.capture) {
    try {
      entry.capture->prove(implementation_, info_);
      entry.proved = true;
    } catch (const NotObservable& exception) {
      std::cout << "capture " << entry.capture->name() << " is not available: " << exception.what() << "\n";
      entry.capture.reset();
    }
  }
  return entry.capture.get();
}

void Captures::prove_all() {
  for (std::size_t i = 0; i < size(); ++i) at(i);
}

WrappedCase begin_wrapping(gl::Case prologue, const gl::Case& script) {
  WrappedCase wrapped{std::move(prologue), {}, {}};
  wrapped.error_before = wrapped.commands.GetError();
  wrapped.commands.append(script);
  wrapped.error_after = wrapped.commands.GetError();
  return wrapped;
}

}  // namespace evalcts
