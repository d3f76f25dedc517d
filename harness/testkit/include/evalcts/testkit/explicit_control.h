// Runs the controls of failing cases. A control is the same case with explicit commands instead of
// evaluation. If it fails as well, the root cause is in the rest of the pipeline, not in the evaluators.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>
#include <evalcts/judge/judge.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

// Returns the attribute of a vertex that a mismatch is about; 0 if there is none. Texture coordinates of all
// units count as those of unit 0.
Attributes attribute_of(const Mismatch& mismatch);

class ExplicitControl {
 public:
  explicit ExplicitControl(const Subject& subject) : subject_(subject) {}

  // Compares a part of the vertices of a control with its prediction.
  using Judge = std::function<std::vector<Mismatch>(const Prediction&, const Observation&)>;

  // Must be called before `script` is judged by these attributes of its observation through the capture.
  // Without `judge`, all vertices of the controls are compared.
  void set_observed(const gl::Case& script, const Capture& capture, Attributes judged, Judge judge = {});
  // Makes all controls run in fresh contexts, because the warm context belongs to another thread.
  void leave_warm_context() { uses_warm_context_ = false; }
  // Must be called when another case begins.
  void clear() {
    observed_.reset();
    wrong_.clear();
  }

  // Runs the controls of the observed case, if there is one and they have not run: in the warm context if the
  // case fails there in the same way, which `fails` says, and the controls pass there; otherwise in fresh
  // contexts. They hold the case and its controls to the same conditions either way, and making contexts
  // takes most of the time.
  void run_controls(const std::function<bool(Implementation&)>& fails = {});

  // Returns the attributes that are wrong in the control of the case, because the capture or the rest of the
  // pipeline loses them.
  Attributes lost_attributes(const gl::Case& script, const Capture& capture) const;

  // Returns the attributes that the controls, which have run, lose while positions and vertices are right.
  Attributes lost_in_controls() const;

  // Must be called when the case leaves these errors behind. Returns the one that it leaves behind with
  // explicit vertices or other explicit commands in place of its evaluations as well, if there is one.
  std::optional<GLenum> error_without_evaluators(const gl::Case& script,
                                                 const std::vector<GLenum>& errors) const;

  // Must be called when the observed case, if there is one, has failed in `what` ("color.R of vertex 3").
  // Throws NotObservable if the controls fail in the same attribute, in positions, or in the number of
  // vertices. If `what` names no attribute, any mismatch of the controls counts. The controls of a case run
  // only once.
  void require_explicit_vertices(const std::string& what);

 private:
  struct ObservedCase {
    gl::Case script;
    const Capture* capture;
    Attributes judged;
    Judge judge;  // may be empty
  };

  struct ControlObservation {
    Prediction prediction;
    Topology topology;
    Observation observation;
  };
  // Observes a case without evaluation; empty if the capture does not take its primitives.
  std::optional<ControlObservation> observe_control(Implementation& implementation, const gl::Case& control,
                                                    const Capture& capture, Attributes judged) const;
  std::vector<Mismatch> mismatches(const ControlObservation& seen, Attributes judged) const;

  const Subject& subject_;
  bool uses_warm_context_ = true;
  std::optional<ObservedCase> observed_;
  std::vector<Mismatch> wrong_;  // the mismatches of the controls, after they have run
};

}  // namespace evalcts
