#include <evalcts/testkit/list_control.h>

#include <utility>
#include <vector>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/judge/judge.h>

namespace evalcts {

void ListControl::set_observed(const gl::Case& script, const Capture& capture, Attributes judged) {
  // A reproduction shows a failure whose lists are known to be right, and the control is not its case.
  if (!gl::uses_lists(script) || subject_.reproduction) return;
  // If vertices are out of place, no other attribute of them is right.
  observed_ = {script, &capture, (judged | kPosition) & capture.shown()};
}

void ListControl::require_explicit_vertices() {
  const std::optional<Observed> observed = std::exchange(observed_, std::nullopt);
  if (!observed) return;
  const auto& [script, capture, judged] = *observed;
  const gl::Case control = gl::with_explicit_vertices(script);
  const Prediction prediction = predict(control, subject_.info.max_order());
  const PrimitiveKinds kinds = kinds_of(prediction);
  if (!capture->takes(kinds)) return;
  const Topology topology = subject_.topologies->find(prediction, *capture, *subject_.implementation);
  const Observation seen =
      capture->observe(*subject_.implementation, control, {judged, most_vertices_of(prediction) + 8, kinds});
  const std::vector<Mismatch> mismatches =
      judge(prediction, topology, seen, {.attributes = judged, .version = subject_.info.version_number()})
          .mismatches;
  if (!mismatches.empty())
    throw NotObservable("pipeline: in display lists explicit vertices go wrong, too: " +
                        mismatches.front().message);
}

}  // namespace evalcts
