// Replays failing cases with explicit vertices or explicit commands, and compares the results with the
// prediction.
#include <evalcts/testkit/explicit_control.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include <evalcts/gl/errors.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/player.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/judge.h>

namespace evalcts {
namespace {

// Returns "color" for "color.R of vertex 3"; empty if `what` names no attribute.
std::string attribute_in(const std::string& what) {
  for (const char* attribute : {"position", "color", "normal", "texture coordinate"})
    if (what.starts_with(attribute)) return what.substr(0, what.find('.'));
  return {};
}

// True if the mismatch of a control may have the same root cause as a failure in `what`.
bool explains(const Mismatch& mismatch, const std::string& what) {
  const std::string failed = attribute_in(what), wrong = attribute_in(mismatch.what);
  return failed.empty() || mismatch.kind == Mismatch::Kind::kVertices || wrong == "position" ||
         wrong == failed;
}

}  // namespace

Attributes attribute_of(const Mismatch& mismatch) {
  if (mismatch.kind != Mismatch::Kind::kValue) return 0;
  const std::string attribute = kind_of(mismatch.what);
  return attribute == "position"             ? kPosition
         : attribute == "color"              ? kColor
         : attribute == "normal"             ? kNormal
         : attribute == "texture coordinate" ? kTextureCoordinate0
                                             : 0u;
}

void ExplicitControl::set_observed(const gl::Case& script, const Capture& capture, Attributes judged,
                                   Judge judge) {
  // For a reproduction, the control is known to pass, and must not be recorded in place of the case.
  if (subject_.reproduction) return;
  // Positions are always judged, because wrong positions make other attributes of vertices meaningless.
  observed_ = {script, &capture, (judged | kPosition) & capture.shown(), std::move(judge)};
}

void ExplicitControl::require_explicit_vertices(const std::string& what) {
  run_controls();
  const auto found =
      std::ranges::find_if(wrong_, [&](const Mismatch& mismatch) { return explains(mismatch, what); });
  if (found != wrong_.end())
    throw NotObservable("pipeline: explicit commands instead of evaluations go wrong as well: " +
                        found->message);
}

std::optional<GLenum> ExplicitControl::error_without_evaluators(const gl::Case& script,
                                                                const std::vector<GLenum>& errors) const {
  if (subject_.reproduction || subject_.is_warm) return std::nullopt;  // fresh contexts decide
  // Without calls of lists that do not exist, in which a library may crash that does not crash here.
  for (const gl::Case& control : {gl::with_explicit_vertices(script), gl::with_explicit_commands(script)}) {
    try {
      const gl::Trace trace = subject_.implementation->create_context()->play(control);
      for (const GLenum error : trace.left_over_errors())
        if (std::ranges::count(errors, error) > 0) return error;
    } catch (const gl::MissingEntryPoint&) {
      // A sink need not support explicit commands, as in run_controls().
    }
  }
  return std::nullopt;
}

void ExplicitControl::run_controls(const std::function<bool(Implementation&)>& fails) {
  const std::optional<ObservedCase> observed = std::exchange(observed_, std::nullopt);
  if (!observed) return;
  // Each array has mappings of its own, and a process has about 65,000 mappings at most.
  constexpr std::size_t kMostCommands = 2048;
  const bool has_arrays = observed->script.commands().size() <= kMostCommands;
  std::vector<gl::Case> controls;
  const auto add_controls = [&](gl::IdleCapability idle) {
    controls.push_back(gl::with_explicit_vertices(observed->script, idle));
    controls.push_back(gl::with_explicit_commands(observed->script, idle));
    if (has_arrays)
      controls.push_back(gl::with_explicit_commands(observed->script, idle, gl::Arguments::kArray));
  };
  add_controls(subject_.info.idle_capability);
  // A library in front of another GL may keep commands of maps to itself, which changes no state below.
  if (subject_.info.is_in_front) add_controls({});
  const auto wrong_on = [&](Implementation& implementation) {
    std::vector<Mismatch> wrong;
    for (const gl::Case& control : controls) {
      std::optional<ControlObservation> seen;
      try {
        seen = observe_control(implementation, control, *observed->capture, observed->judged);
      } catch (const gl::MissingEntryPoint&) {
        // A sink need not support explicit commands. It has no further pipeline that could be at fault.
      }
      if (!seen) continue;
      std::ranges::move(observed->judge ? observed->judge(seen->prediction, seen->observation)
                                        : mismatches(*seen, observed->judged),
                        std::back_inserter(wrong));
    }
    return wrong;
  };
  const auto shows_evaluation_at_fault = [&](WarmContext& warm) {
    try {
      return fails(warm.implementation()) && wrong_on(warm.implementation()).empty() && warm.restore();
    } catch (const NotObservable&) {
      return false;
    }
  };
  if (fails && uses_warm_context_ && subject_.warm && shows_evaluation_at_fault(*subject_.warm)) return;
  wrong_ = wrong_on(*subject_.implementation);
}

Attributes ExplicitControl::lost_in_controls() const {
  Attributes lost = 0;
  for (const Mismatch& mismatch : wrong_) {
    const Attributes attribute = attribute_of(mismatch);
    if (attribute == 0 || attribute == kPosition) return 0;
    lost |= attribute;
  }
  return lost;
}

Attributes ExplicitControl::lost_attributes(const gl::Case& script, const Capture& capture) const {
  const std::optional<ControlObservation> seen =
      observe_control(*subject_.implementation, gl::with_explicit_vertices(script), capture, capture.shown());
  Attributes lost = 0;
  for (Attributes attribute = 1; seen && attribute <= kAllAttributes; attribute <<= 1)
    if ((attribute & kAllAttributes & capture.shown()) && !mismatches(*seen, attribute).empty())
      lost |= attribute;
  return lost;
}

std::optional<ExplicitControl::ControlObservation> ExplicitControl::observe_control(
    Implementation& implementation, const gl::Case& control, const Capture& capture,
    Attributes judged) const {
  Prediction prediction = predict(control, subject_.info.max_order());
  const PrimitiveKinds kinds = kinds_of(prediction);
  if (!capture.takes(kinds)) return std::nullopt;
  Topology topology = subject_.topologies->find(prediction, capture, implementation);
  Observation observation =
      capture.observe(implementation, control, {judged, most_vertices_of(prediction) + 8, kinds});
  return ControlObservation{std::move(prediction), std::move(topology), std::move(observation)};
}

std::vector<Mismatch> ExplicitControl::mismatches(const ControlObservation& seen, Attributes judged) const {
  return judge(seen.prediction, seen.topology, seen.observation,
               {.attributes = judged, .version = subject_.info.version_number()})
      .mismatches;
}

}  // namespace evalcts
