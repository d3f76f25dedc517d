// The control of cases that go through display lists: if such a case fails, the same case with explicit
// vertices has to come out right. Otherwise the lists are the root cause, not the evaluators.
#pragma once

#include <optional>

#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

class ListControl {
 public:
  explicit ListControl(const Subject& subject) : subject_(subject) {}

  // `script` was observed through the capture and is judged by these attributes.
  void set_observed(const gl::Case& script, const Capture& capture, Attributes judged);
  // Another case begins.
  void clear() { observed_.reset(); }

  // The observed case, if there is one, has failed. Throws NotObservable if its display lists are the root
  // cause; plays the control once only.
  void require_explicit_vertices();

 private:
  struct Observed {
    gl::Case script;
    const Capture* capture;
    Attributes judged;
  };

  const Subject& subject_;
  std::optional<Observed> observed_;
};

}  // namespace evalcts
