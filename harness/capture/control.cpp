// Draws the control of captures, compares its vertices with the known values, and measures the error of
// inexact colours.
#include "control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

std::vector<ObservedVertex> vertices_of(const Observation& observation) {
  std::vector<ObservedVertex> vertices;
  for (const ObservedPrimitive& primitive : observation.primitives)
    vertices.insert(vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
  return vertices;
}

}  // namespace

Control make_control(const ControlOptions& options) {
  Control control;
  gl::Case& c = control.commands;
  c.Begin(GL_POINTS);
  for (int i = 0; i < 24; ++i) {
    const float x = std::ldexp(1.0f + static_cast<float>(i) / 7.0f, (i * 5) % 29 - 14);
    const float sign = i % 2 ? -1.0f : 1.0f;
    ObservedVertex vertex;
    vertex.color = {0.03f * static_cast<float>(i), 1.0f - 0.03f * static_cast<float>(i), 1.0f / 3.0f, 0.7f};
    if (options.unclamped_color && i % 3 == 0) vertex.color = {sign * x, -2.5f, 7.0f, 1.0f / 3.0f};
    vertex.normal = {sign * x, 0.1f, -x};
    vertex.texture_coordinate[0] = {x, sign * 0.3f, -x * 3.0f, 1.0f + static_cast<float>(i)};
    float w = i % 4 ? 1.0f : 0.25f + 0.1f * static_cast<float>(i);
    if (options.negative_w && i % 5 == 1) w = i % 10 == 1 ? -w : 0.0f;
    vertex.position = {-sign * x, x * 0.7f, 0.1f * static_cast<float>(i) + 0.01f, w};
    const auto& [position, color, normal, textures] = vertex;
    const auto& texture = textures[0];
    c.Color4f(color[0], color[1], color[2], color[3]);
    c.Normal3f(normal[0], normal[1], normal[2]);
    c.TexCoord4f(texture[0], texture[1], texture[2], texture[3]);
    c.Vertex4f(position[0], position[1], position[2], position[3]);
    control.vertices.push_back(vertex);
  }
  c.End();
  return control;
}

std::string try_control(const Capture& capture, Implementation& implementation, const ControlOptions& options,
                        Attributes attributes) {
  const Control control = make_control(options);
  const Observation observation =
      capture.observe(implementation, control.commands, {attributes, control.vertices.size()});
  if (observation.error != GL_NO_ERROR)
    return fmt::format("the control of explicit vertices raised {}", gl::error_name(observation.error));
  return compare(control, observation, attributes);
}

std::string compare(const Control& control, const Observation& observation, Attributes attributes) {
  const std::vector<ObservedVertex> seen = vertices_of(observation);
  if (seen.size() != control.vertices.size())
    return fmt::format("the control of {} explicit vertices came back as {}", control.vertices.size(),
                       seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto differs = [&](Attribute attribute, const auto& got, const auto& given) {
      return (attributes & attribute) && got != given;
    };
    const ObservedVertex& got = seen[i];
    const ObservedVertex& given = control.vertices[i];
    if (differs(kPosition, got.position, given.position) || differs(kColor, got.color, given.color) ||
        differs(kNormal, got.normal, given.normal) ||
        differs(kTextureCoordinate0, got.texture_coordinate[0], given.texture_coordinate[0]))
      return fmt::format("explicit vertex {} of the control came back changed", i);
  }
  return {};
}

Attributes confirm_attributes(const Capture& capture, Implementation& implementation,
                              const ControlOptions& options, Attributes attributes) {
  Attributes confirmed = 0;
  for (const Attribute attribute : {kTextureCoordinate0, kPosition, kNormal, kColor}) {
    if (!(attributes & attribute)) continue;
    try {
      if (try_control(capture, implementation, options, attribute).empty()) confirmed |= attribute;
    } catch (const NotObservable&) {
    } catch (const gl::MissingEntryPoint&) {
    }
  }
  return confirmed;
}

std::optional<double> measure_color_error(const Capture& capture, Implementation& implementation) {
  constexpr double kLargest = 1.0 / 63;
  const Control control = make_control({});
  std::vector<ObservedVertex> seen;
  try {
    seen = vertices_of(capture.observe(implementation, control.commands, {kColor, control.vertices.size()}));
  } catch (const NotObservable&) {
    return {};
  } catch (const gl::MissingEntryPoint&) {
    return {};
  }
  if (seen.size() != control.vertices.size()) return {};
  double largest = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const double error =
          std::abs(static_cast<double>(seen[i].color[k]) - static_cast<double>(control.vertices[i].color[k]));
      if (!(error <= kLargest)) return {};
      largest = std::max(largest, error);
    }
  return 2 * largest;
}

}  // namespace evalcts
