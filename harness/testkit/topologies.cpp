// Learns topologies by drawing explicit primitives, and keeps them.
#include <evalcts/testkit/topologies.h>

#include <fmt/format.h>

#include <optional>

namespace evalcts {

Topology Topologies::find(const Prediction& prediction, const Capture& capture,
                          Implementation& implementation) {
  constexpr std::size_t kMostKnown = 1000;
  const PrimitiveKinds kinds = kinds_of(prediction);
  if (kinds == kPoints) return Topology::points(prediction.vertex_count());
  Shape drawn;
  for (const reference::Primitive& primitive : prediction.primitives)
    drawn.emplace_back(primitive.mode, primitive.vertices.size());
  const std::pair key(capture.name(), std::move(drawn));
  if (const auto known = known_.find(key); known != known_.end()) return known->second;

  const Attributes numbered = capture.attributes() & kPosition ? kPosition : kTextureCoordinate0;
  const Observation control = capture.observe(implementation, explicit_primitives(prediction),
                                              {numbered, most_vertices_of(prediction), kinds});
  std::optional<Topology> topology = read_topology(prediction, control);
  if (!topology || control.error != GL_NO_ERROR)
    throw NotObservable(fmt::format(
        "pipeline: {} does not show these primitives with explicit vertices, either", capture.name()));
  if (known_.size() < kMostKnown) known_.emplace(key, *topology);
  return *std::move(topology);
}

}  // namespace evalcts
