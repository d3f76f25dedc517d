// The control of failing cases: the same case with explicit commands in the place of evaluation has to come
// out right. Otherwise the rest of the pipeline is the root cause, not the evaluators.
#pragma once

#include <optional>
#include <vector>

#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/judge/judge.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

class ExplicitControl {
 public:
  explicit ExplicitControl(const Subject& subject) : subject_(subject) {}

  // `script` was observed through the capture and is judged by these attributes.
  void set_observed(const gl::Case& script, const Capture& capture, Attributes judged);
  // Another case begins.
  void clear() { observed_.reset(); }

  // Returns the attributes of explicit vertices that come out wrong in place of those that the case
  // evaluates: what the capture or the rest of the pipeline loses.
  Attributes lost_attributes(const gl::Case& script, const Capture& capture) const;

  // The observed case, if there is one, has failed. Throws NotObservable if explicit commands go wrong, too.
  // Plays the controls of a case once only.
  void require_explicit_vertices();

 private:
  struct Observed {
    gl::Case script;
    const Capture* capture;
    Attributes judged;
  };

  struct Seen {
    Prediction prediction;
    Topology topology;
    Observation observation;
  };
  // Observes a case without evaluation; empty if the capture does not take its primitives.
  std::optional<Seen> observe_control(const gl::Case& control, const Capture& capture,
                                      Attributes judged) const;
  std::vector<Mismatch> mismatches(const Seen& seen, Attributes judged) const;

  const Subject& subject_;
  std::optional<Observed> observed_;
};

}  // namespace evalcts
