// Converts observations and predictions to the positions of a plot, divided by w.
#include "plot.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

std::array<float, 3> divided_by_w(const std::array<float, 4>& position) {
  const auto [x, y, z, w] = position;
  return {x / w, y / w, z / w};
}

std::array<float, 4> position_of(const ObservedVertex& vertex) { return vertex.position; }
std::array<float, 4> position_of(const reference::Vertex& vertex) {
  std::array<float, 4> position;
  std::ranges::transform(vertex.position, position.begin(),
                         [](const reference::Component& component) { return reference::rounded(component); });
  return position;
}

template <class Primitive>
std::vector<PlottedPrimitive> plotted(const std::vector<Primitive>& primitives, bool& is_cut) {
  std::vector<PlottedPrimitive> out;
  std::size_t room = Plot::kMostVertices;
  for (const Primitive& primitive : primitives) {
    const std::span vertices = std::span(primitive.vertices).first(std::min(room, primitive.vertices.size()));
    is_cut = is_cut || vertices.size() < primitive.vertices.size();
    room -= vertices.size();
    if (vertices.empty()) continue;
    PlottedPrimitive& one = out.emplace_back();
    one.mode = gl::primitive_name(primitive.mode);
    for (const auto& vertex : vertices) one.positions.push_back(divided_by_w(position_of(vertex)));
  }
  return out;
}

}  // namespace

Plot plot_of(const Observation& observation) {
  Plot plot;
  plot.is_cut = observation.overflow;
  plot.captured = plotted(observation.primitives, plot.is_cut);
  return plot;
}

Plot plot_of(const Prediction& prediction, const Observation& observation) {
  Plot plot = plot_of(observation);
  plot.expected = plotted(prediction.primitives, plot.is_cut);
  return plot;
}

}  // namespace evalcts
