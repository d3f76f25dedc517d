#include "harness/judge/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "harness/gl/tokens.h"

namespace evalcts {
namespace {

// How many of n vertices a primitive uses: what is left over at its end is ignored (GL 2.1 section 2.6.1).
std::size_t used_vertices(GLenum mode, std::size_t n) {
  switch (mode) {
    case GL_POINTS:
      return n;
    case GL_LINES:
      return n - n % 2;
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      return n < 2 ? 0 : n;
    case GL_TRIANGLES:
      return n - n % 3;
    case GL_QUADS:
      return n - n % 4;
    case GL_QUAD_STRIP:
      return n < 4 ? 0 : n - n % 2;
    default:
      return n < 3 ? 0 : n;
  }
}

}  // namespace

Shape shape_of(const Observation& observation) {
  Shape shape;
  for (const ObservedPrimitive& primitive : observation.primitives) {
    if (primitive.mode == GL_POINTS && !shape.empty() && shape.back().first == GL_POINTS) {
      shape.back().second += primitive.vertices.size();
    } else if (!primitive.vertices.empty()) {
      shape.emplace_back(primitive.mode, primitive.vertices.size());
    }
  }
  return shape;
}

std::string describe(const Shape& shape) {
  if (shape.empty()) return "0 vertices";
  if (shape.size() == 1 && shape[0].first == GL_POINTS) return fmt::format("{} vertices", shape[0].second);
  std::string text;
  for (std::size_t i = 0; i < shape.size();) {
    std::size_t same = i;
    while (same < shape.size() && shape[same] == shape[i]) ++same;
    text += fmt::format("{}{} {} of {} vertices", text.empty() ? "" : ", ", same - i,
                        gl::primitive_name(shape[i].first).substr(3), shape[i].second);
    i = same;
  }
  return text;
}

Topology Topology::points(std::size_t count) {
  Topology topology;
  if (count > 0) topology.shape.emplace_back(GL_POINTS, count);
  topology.vertices.resize(count);
  std::iota(topology.vertices.begin(), topology.vertices.end(), std::size_t{0});
  return topology;
}

bool Topology::only_points() const {
  return shape.empty() || (shape.size() == 1 && shape[0].first == GL_POINTS);
}

PrimitiveKinds kinds_of(const Prediction& prediction) {
  PrimitiveKinds kinds = 0;
  for (const reference::Primitive& primitive : prediction.primitives) kinds |= kind_of(primitive.mode);
  return kinds ? kinds : static_cast<PrimitiveKinds>(kPoints);
}

std::size_t most_vertices_of(const Prediction& prediction) {
  const std::size_t count = prediction.vertex_count();
  switch (kinds_of(prediction)) {
    case kPoints:
      return count;
    case kLines:
      return 2 * count;
    default:
      return 3 * count;
  }
}

gl::Case explicit_primitives(const Prediction& prediction) {
  gl::Case c("explicit vertices");
  float number = 0;
  for (const reference::Primitive& primitive : prediction.primitives) {
    c.Begin(primitive.mode);
    for (std::size_t i = 0; i < primitive.vertices.size(); ++i, ++number) {
      c.TexCoord1f(number);
      c.Vertex2f(number, 0.0f);
    }
    c.End();
  }
  return c;
}

std::optional<Topology> read_topology(const Prediction& prediction, const Observation& observation) {
  Topology topology{shape_of(observation), {}};
  std::set<std::size_t> seen;
  for (const ObservedPrimitive& primitive : observation.primitives)
    for (const ObservedVertex& vertex : primitive.vertices) {
      const float number =
          observation.attributes & kPosition ? vertex.position[0] : vertex.texture_coordinate[0][0];
      if (!(number >= 0) || number >= static_cast<float>(prediction.vertex_count())) return std::nullopt;
      const auto index = static_cast<std::size_t>(number);
      if (static_cast<float>(index) != number) return std::nullopt;
      topology.vertices.push_back(index);
      seen.insert(index);
    }
  std::size_t first = 0;
  for (const reference::Primitive& primitive : prediction.primitives) {
    for (std::size_t i = 0; i < used_vertices(primitive.mode, primitive.vertices.size()); ++i)
      if (!seen.count(first + i)) return std::nullopt;
    first += primitive.vertices.size();
  }
  return topology;
}

}  // namespace evalcts
