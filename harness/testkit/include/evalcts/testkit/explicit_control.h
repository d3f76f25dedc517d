// The control of failing cases: the same case with explicit commands in the place of evaluation has to come
// out right. Otherwise the rest of the pipeline is the root cause, not the evaluators.
#pragma once

#include <optional>
#include <string>
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
  void clear() {
    observed_.reset();
    wrong_.clear();
  }

  // Returns the attributes of explicit vertices that come out wrong in place of those that the case
  // evaluates: what the capture or the rest of the pipeline loses.
  Attributes lost_attributes(const gl::Case& script, const Capture& capture) const;

  // The observed case, if there is one, has failed in `what` ("color.R of vertex 3"). Throws NotObservable if
  // explicit commands go wrong in the same attribute, in positions, or in the number of vertices. If `what`
  // names no attribute, any mismatch of the controls counts. Runs the controls of a case once only.
  void require_explicit_vertices(const std::string& what);

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
  void play_controls(const Observed& observed);
  // Observes a case without evaluation; empty if the capture does not take its primitives.
  std::optional<Seen> observe_control(const gl::Case& control, const Capture& capture,
                                      Attributes judged) const;
  std::vector<Mismatch> mismatches(const Seen& seen, Attributes judged) const;

  const Subject& subject_;
  std::optional<Observed> observed_;
  std::vector<Mismatch> wrong_;  // of the controls, once they were run
};

}  // namespace evalcts
