// Learns topologies by drawing explicit primitives, and keeps them.
#include <evalcts/testkit/topologies.h>

#include <fmt/format.h>

#include <optional>

#include <evalcts/gl/player.h>

namespace evalcts {
namespace {

gl::Case without_texture_coordinates(const gl::Case& script) {
  gl::Case c = script.without_commands();
  for (const gl::Command& command : script.commands())
    if (command.entry != gl::EntryPoint::TexCoord1f) c.add(command);
  return c;
}

// Observes explicit vertices with their numbers as positions and texture coordinates. A sink need not support
// texture coordinates.
Observation observe_numbered(const gl::Case& script, const Capture& capture, Implementation& implementation,
                             const CaptureRequest& request) {
  try {
    return capture.observe(implementation, script, request);
  } catch (const gl::MissingEntryPoint&) {
    if (!(request.attributes & kPosition)) throw;
    return capture.observe(implementation, without_texture_coordinates(script), request);
  }
}

}  // namespace

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
  const Observation control = observe_numbered(explicit_primitives(prediction), capture, implementation,
                                               {numbered, most_vertices_of(prediction), kinds});
  std::optional<Topology> topology = read_topology(prediction, control);
  if (!topology || control.error != GL_NO_ERROR)
    throw NotObservable(fmt::format(
        "pipeline: {} does not show these primitives with explicit vertices, either", capture.name()));
  if (known_.size() < kMostKnown) known_.emplace(key, *topology);
  return *std::move(topology);
}

}  // namespace evalcts
