// Observes the values of an attribute.
#include <evalcts/capture/observed_values.h>

#include <fmt/format.h>

#include <stdexcept>

#include <evalcts/gl/case_json.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/results/json.h>

namespace evalcts {
namespace {

using nlohmann::json;

const float* values_of(const ObservedVertex& vertex, Attributes attribute) {
  if (attribute == kPosition) return vertex.position.data();
  if (attribute == kColor) return vertex.color.data();
  if (attribute == kNormal) return vertex.normal.data();
  return vertex.texture_coordinate[0].data();
}

}  // namespace

std::string to_text(const ValuesRequest& request) {
  return json{{"program", gl::to_json(request.program)},
              {"attribute", request.attribute},
              {"components", request.components},
              {"vertices", request.vertices}}
      .dump();
}

ValuesRequest parse_values_request(const std::string& text) try {
  const json in = parse_json(text);
  ValuesRequest request{gl::case_from_json(in.at("program")), in.at("attribute"), in.at("components"),
                        in.at("vertices")};
  if (request.components > 4) throw std::invalid_argument("more than 4 components");
  return request;
} catch (const json::exception& error) {
  throw std::invalid_argument(error.what());
}

ObservedValues observe_values(Captures& captures, Implementation& implementation,
                              const ValuesRequest& request) {
  const Capture& capture = captures.showing_all(request.attribute, kPoints);
  const Observation seen =
      capture.observe(implementation, request.program, {request.attribute, request.vertices});
  if (seen.error != GL_NO_ERROR)
    throw NotObservable(fmt::format("the commands raised {}", gl::error_name(seen.error)));
  if (seen.overflow || seen.vertex_count() != request.vertices)
    throw NotObservable(
        fmt::format("expected {} vertices, captured {}", request.vertices, seen.vertex_count()));
  if (request.attribute == kColor && seen.clamped_colors)
    throw NotObservable("colours are clamped to [0,1] on the way");
  ObservedValues observed{capture.name(), {}};
  for (const ObservedPrimitive& primitive : seen.primitives)
    for (const ObservedVertex& vertex : primitive.vertices) {
      const float* const values = values_of(vertex, request.attribute);
      observed.values.insert(observed.values.end(), values, values + request.components);
    }
  return observed;
}

}  // namespace evalcts
