// Reads topologies from explicit vertices, and matches captured quads and meshes.
#include <evalcts/judge/topology.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>

#include <evalcts/gl/tokens.h>

namespace evalcts {
namespace {

// Returns the number of vertices that a primitive with n vertices uses. Vertices of an incomplete last part
// are ignored (GL 2.1 section 2.6.1).
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
  const auto vertices = [](std::size_t n) { return n == 1 ? "1 vertex" : fmt::format("{} vertices", n); };
  if (shape.size() == 1 && shape[0].first == GL_POINTS) return vertices(shape[0].second);
  std::string text;
  for (std::size_t i = 0; i < shape.size();) {
    std::size_t same = i;
    while (same < shape.size() && shape[same] == shape[i]) ++same;
    text += fmt::format("{}{} {} of {}", text.empty() ? "" : ", ", same - i,
                        gl::primitive_name(shape[i].first).substr(3), vertices(shape[i].second));
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
  const std::size_t count = prediction.vertex_count();
  std::vector<bool> seen(count);
  for (const ObservedPrimitive& primitive : observation.primitives)
    for (const ObservedVertex& vertex : primitive.vertices) {
      const float number =
          observation.attributes & kPosition ? vertex.position[0] : vertex.texture_coordinate[0][0];
      if (!(number >= 0) || number >= static_cast<float>(count)) return std::nullopt;
      const auto index = static_cast<std::size_t>(number);
      if (static_cast<float>(index) != number) return std::nullopt;
      topology.vertices.push_back(index);
      seen[index] = true;
    }
  std::size_t first = 0;
  for (const reference::Primitive& primitive : prediction.primitives) {
    for (std::size_t i = 0; i < used_vertices(primitive.mode, primitive.vertices.size()); ++i)
      if (!seen[first + i]) return std::nullopt;
    first += primitive.vertices.size();
  }
  return topology;
}

namespace {

using Quad = std::array<std::size_t, 4>;  // indices of vertices of the case, in winding order

// Appends the quads of a primitive whose first vertex has the index `first`. Returns false if the primitive
// does not consist of quads.
bool append_quads(const reference::Primitive& primitive, std::size_t first, std::vector<Quad>& quads) {
  const std::size_t used = used_vertices(primitive.mode, primitive.vertices.size());
  if (primitive.mode == GL_QUADS) {
    for (std::size_t i = first; i < first + used; i += 4) quads.push_back({i, i + 1, i + 2, i + 3});
  } else if (primitive.mode == GL_QUAD_STRIP) {
    for (std::size_t i = first; i + 2 < first + used; i += 2) quads.push_back({i, i + 1, i + 3, i + 2});
  } else {
    return used == 0;
  }
  return true;
}

// Returns the quads of a prediction, or nothing if it has other primitives.
std::optional<std::vector<Quad>> quads_of(const Prediction& prediction) {
  std::vector<Quad> quads;
  std::size_t first = 0;
  for (const reference::Primitive& primitive : prediction.primitives) {
    if (!append_quads(primitive, first, quads)) return {};
    first += primitive.vertices.size();
  }
  return quads;
}

// Distance between a captured vertex and a predicted vertex, which is near zero if they are the same vertex.
// Automatic normals may have any length and, with some maps, either sign. Their weight is small, so they only
// distinguish vertices that agree in all other attributes, such as those of a seam.
class Distance {
 public:
  Distance(const Prediction& prediction, const Observation& observation)
      : attributes_(observation.attributes) {
    for (const reference::Primitive& primitive : prediction.primitives)
      for (const reference::Vertex& vertex : primitive.vertices) {
        std::vector<float> values;
        for (const auto* four : {&vertex.position, &vertex.texture_coordinate.of_unit_0, &vertex.color})
          for (const reference::Component& component : *four) values.push_back(reference::rounded(component));
        if (observation.clamped_colors)
          for (auto color = values.end() - 4; color != values.end(); ++color)
            *color = std::clamp(*color, 0.0f, 1.0f);
        double sum = 0;
        for (const auto& [attribute, first] :
             {std::pair{kPosition, 0}, std::pair{kTextureCoordinate0, 4}, std::pair{kColor, 8}})
          if (attributes_ & attribute)
            sum = std::accumulate(values.begin() + first, values.begin() + first + 4, sum);
        for (const float component : reference::rounded(vertex.normal)) values.push_back(component);
        expected_.push_back(
            {std::move(values), sum, std::holds_alternative<reference::AutomaticNormal>(vertex.normal)});
      }
  }

  // Sum of the values of a vertex but those of its normal. Vertices whose sums differ by d have at least the
  // distance min(d, kFar).
  double sum(std::size_t vertex) const { return expected_[vertex].sum; }
  double sum(const ObservedVertex& seen) const {
    double sum = 0;
    const auto add = [&](Attribute attribute, const auto& values) {
      if (attributes_ & attribute) sum = std::accumulate(values.begin(), values.end(), sum);
    };
    add(kPosition, seen.position);
    add(kTextureCoordinate0, seen.texture_coordinate[0]);
    add(kColor, seen.color);
    return sum;
  }
  static double at_least(double difference_of_sums) {
    return std::min(std::max(difference_of_sums, 0.0), kFar);
  }

  double operator()(std::size_t vertex, const ObservedVertex& seen) const {
    const float* expected = expected_[vertex].values.data();
    double distance = 0;
    const auto add = [&](Attribute attribute, const auto& values) {
      for (std::size_t i = 0; i < values.size() && (attributes_ & attribute); ++i) {
        const double difference = std::abs(static_cast<double>(values[i]) - expected[i]);
        distance += difference <= kFar ? difference : kFar;  // also for NaN
      }
      expected += values.size();
    };
    add(kPosition, seen.position);
    add(kTextureCoordinate0, seen.texture_coordinate[0]);
    add(kColor, seen.color);
    if (!expected_[vertex].has_automatic_normal) {
      add(kNormal, seen.normal);
    } else if (attributes_ & kNormal) {
      distance += kWeightOfDirection * angle(expected, seen.normal);
    }
    return distance;
  }

 private:
  struct Expected {
    std::vector<float> values;
    double sum;
    bool has_automatic_normal;
  };

  // Returns 1 - |cos| of the angle between two normals, and little more if they have opposite signs; 0 if one
  // has no direction.
  static double angle(const float* expected, const std::array<float, 3>& seen) {
    double product = 0, a = 0, b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      product += static_cast<double>(expected[i]) * seen[i];
      a += static_cast<double>(expected[i]) * expected[i];
      b += static_cast<double>(seen[i]) * seen[i];
    }
    const double cosine = std::clamp(product / std::sqrt(a * b), -1.0, 1.0);
    return std::isnan(cosine) ? 0 : 1 - std::abs(cosine) + 1e-3 * (1 - cosine);
  }

  static constexpr double kFar = 1e6, kWeightOfDirection = 1e-3;
  Attributes attributes_;
  std::vector<Expected> expected_;
};

struct Match {
  double distance = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> vertices;
};

// Matches captured vertices with the corners of a polygon, rotated to the best fit.
Match turned(const Distance& distance, std::vector<std::size_t> corners,
             const std::vector<ObservedVertex>& seen) {
  Match best;
  for (std::size_t turn = 0; turn < corners.size(); ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) sum += distance(corners[i], seen[i]);
    if (sum < best.distance) best = {sum, corners};
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  return best;
}

Match two_triangles(const Distance& distance, const Quad& q, const std::vector<ObservedVertex>& first,
                    const std::vector<ObservedVertex>& second) {
  const std::vector<std::size_t> halves[][2] = {{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}},
                                                {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}};
  Match best;
  for (const auto& diagonal : halves)
    for (const int swapped : {0, 1}) {
      const Match a = turned(distance, diagonal[swapped], first);
      const Match b = turned(distance, diagonal[1 - swapped], second);
      if (!(a.distance + b.distance < best.distance)) continue;
      best = {a.distance + b.distance, a.vertices};
      best.vertices.insert(best.vertices.end(), b.vertices.begin(), b.vertices.end());
    }
  return best;
}

// Returns the captured points, lines and polygons.
std::vector<ObservedPrimitive> pieces_of(const Observation& observation) {
  std::vector<ObservedPrimitive> pieces;
  for (const ObservedPrimitive& primitive : observation.primitives) {
    if (primitive.mode != GL_POINTS) {
      if (!primitive.vertices.empty()) pieces.push_back(primitive);
    } else {
      for (const ObservedVertex& vertex : primitive.vertices) pieces.push_back({GL_POINTS, {vertex}});
    }
  }
  return pieces;
}

// A point, line or polygon of a mesh that must be captured; `found` is true if it was.
struct ExpectedPiece {
  GLenum mode;
  std::vector<std::size_t> vertices;
  std::size_t mesh;
  bool found = false;
};

std::vector<ExpectedPiece> pieces_of(const Topology& topology, const std::vector<std::size_t>& mesh_of) {
  std::vector<ExpectedPiece> pieces;
  auto vertex = topology.vertices.begin();
  for (const auto& [mode, count] : topology.shape) {
    const std::size_t size = mode == GL_POINTS ? 1 : count;
    for (std::size_t i = 0; i < count; i += size, vertex += static_cast<std::ptrdiff_t>(size))
      pieces.push_back({mode, {vertex, vertex + static_cast<std::ptrdiff_t>(size)}, mesh_of[*vertex]});
  }
  return pieces;
}

// Finds expected pieces by sums (see Distance), the nearest to that of a captured piece first. A piece may
// have several sums.
class Sums {
 public:
  void add(double sum, std::size_t piece) {
    all_finite_ = all_finite_ && std::isfinite(sum);
    sorted_.emplace_back(std::isfinite(sum) ? sum : 0, piece);
  }
  void sort() { std::ranges::sort(sorted_); }

  // Calls `visit` with each piece, as often as it has sums, and with a lower bound of its distance. If
  // `visit` returns false, no sum that is farther away in the same direction follows.
  template <class Visit>
  void for_each_from(double sum, const Visit& visit) const {
    auto above = std::ranges::lower_bound(sorted_, std::pair(sum, std::size_t{0}));
    auto below = above;
    bool up = above != sorted_.end(), down = below != sorted_.begin();
    while (up || down) {
      if (down && (!up || sum - (below - 1)->first <= above->first - sum)) {
        --below;
        down = visit(below->second, at_least(sum - below->first)) && below != sorted_.begin();
      } else {
        up = visit(above->second, at_least(above->first - sum));
        up = ++above != sorted_.end() && up;
      }
    }
  }

 private:
  double at_least(double distance) const { return all_finite_ ? Distance::at_least(distance) : 0; }

  std::vector<std::pair<double, std::size_t>> sorted_;
  bool all_finite_ = true;
};

// Assigns each captured piece, in order, to the nearest expected piece that has not been found yet. Lines may
// have either direction.
class MeshMatch {
 public:
  MeshMatch(const Distance& distance, const std::vector<ObservedPrimitive>& seen)
      : distance_(distance), seen_(seen) {}

  bool pieces(const std::span<ExpectedPiece> expected) {
    Sums sums;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      double sum = 0;
      for (const std::size_t vertex : expected[i].vertices) sum += distance_.sum(vertex);
      sums.add(sum, i);
    }
    sums.sort();
    for (std::size_t n = 0; n < expected.size(); ++n, ++next_) {
      if (next_ == seen_.size()) return false;
      const ObservedPrimitive& piece = seen_[next_];
      double sum = 0;
      for (const ObservedVertex& vertex : piece.vertices) sum += distance_.sum(vertex);
      Match best;
      ExpectedPiece* nearest = nullptr;
      sums.for_each_from(sum, [&](std::size_t i, double at_least) {
        ExpectedPiece& candidate = expected[i];
        if (candidate.found || candidate.mode != piece.mode ||
            candidate.vertices.size() != piece.vertices.size())
          return true;
        if (at_least >= best.distance || ++comparisons_ > kMostComparisons) return false;
        std::vector<std::size_t> vertices = candidate.vertices;
        for (int way = 0; way < (piece.vertices.size() == 2 ? 2 : 1); ++way) {
          double distance = 0;
          for (std::size_t k = 0; k < vertices.size(); ++k)
            distance += distance_(vertices[k], piece.vertices[k]);
          if (distance < best.distance) best = {distance, vertices}, nearest = &candidate;
          std::ranges::reverse(vertices);
        }
        return true;
      });
      if (!nearest || comparisons_ > kMostComparisons) return false;
      nearest->found = true;
      append(best);
    }
    return true;
  }

  // Matches the next captured piece, or the next two triangles, with a quad.
  bool quad(const Quad& expected) {
    const std::size_t count = pieces_of_quad();
    if (count == 0) return false;
    append(count == 2 ? two_triangles(distance_, expected, seen_[next_].vertices, seen_[next_ + 1].vertices)
                      : turned(distance_, {expected.begin(), expected.end()}, seen_[next_].vertices));
    next_ += count;
    return true;
  }

  bool quads(const std::vector<Quad>& expected) {
    Sums sums;
    for (std::size_t i = 0; i < expected.size(); ++i)
      for (const std::size_t corner : expected[i]) sums.add(distance_.sum(corner), i);
    sums.sort();
    std::vector<bool> found(expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
      const std::size_t count = pieces_of_quad();
      if (count == 0) return false;
      const auto distance_to = [&](const Quad& quad) {
        double sum = 0;
        for (std::size_t i = next_; i < next_ + count; ++i)
          for (const ObservedVertex& vertex : seen_[i].vertices) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const std::size_t corner : quad) nearest = std::min(nearest, distance_(corner, vertex));
            sum += nearest;
          }
        return sum;
      };
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = expected.size();
      sums.for_each_from(distance_.sum(seen_[next_].vertices[0]), [&](std::size_t i, double at_least) {
        if (found[i]) return true;
        if (at_least >= least || ++comparisons_ > kMostComparisons) return false;
        if (const double distance = distance_to(expected[i]); distance < least) nearest = i, least = distance;
        return true;
      });
      if (nearest == expected.size() || comparisons_ > kMostComparisons) return false;
      found[nearest] = quad(expected[nearest]);
    }
    return true;
  }

  bool complete() const { return next_ == seen_.size(); }
  std::vector<std::size_t> take_vertices() { return std::move(vertices_); }

 private:
  // Returns how many pieces the next captured quad consists of: 1, 2 for triangles, 0 if it is no quad.
  std::size_t pieces_of_quad() const {
    const auto size = [&](std::size_t i) { return i < seen_.size() ? seen_[i].vertices.size() : 0; };
    return size(next_) == 3 && size(next_ + 1) == 3 ? 2 : size(next_) == 4 ? 1 : 0;
  }
  void append(const Match& match) {
    vertices_.insert(vertices_.end(), match.vertices.begin(), match.vertices.end());
  }

  // If most pieces are nowhere near where they should be, every piece would be compared with every other.
  static constexpr std::size_t kMostComparisons = 5'000'000;
  const Distance& distance_;
  const std::vector<ObservedPrimitive>& seen_;
  std::size_t next_ = 0, comparisons_ = 0;
  std::vector<std::size_t> vertices_;
};

}  // namespace

void take_triangles_of_meshes_for_quads(const Prediction& prediction, const Topology& topology,
                                        Observation& observation) {
  if (!prediction.has_meshes() || shape_of(observation).size() != topology.shape.size()) return;
  std::vector<bool> is_of_mesh;  // for each vertex
  for (const reference::Primitive& primitive : prediction.primitives)
    is_of_mesh.insert(is_of_mesh.end(), primitive.vertices.size(), primitive.mesh != 0);
  std::size_t vertex = 0, points = 0;  // `points`: number of captured points of the current entry
  auto expected = topology.shape.begin();
  for (ObservedPrimitive& primitive : observation.primitives) {
    const std::size_t size = primitive.vertices.size();
    if (size == 0) continue;
    if (expected == topology.shape.end() || vertex >= topology.vertices.size()) return;
    const auto [mode, count] = *expected;
    if (mode == GL_QUAD_STRIP && primitive.mode == GL_TRIANGLE_STRIP && size == count &&
        is_of_mesh[topology.vertices[vertex]])
      primitive.mode = GL_QUAD_STRIP;
    vertex += size;
    // Points that follow each other are one entry of a shape.
    points = mode == GL_POINTS ? points + size : count;
    if (points < count) continue;
    points = 0;
    ++expected;
  }
}

std::optional<Topology> match_meshes(const Prediction& prediction, const Topology& topology,
                                     const Observation& observation) {
  if (!prediction.has_meshes()) return {};
  std::vector<std::size_t> mesh_of;  // the mesh of each vertex; 0 for none
  std::map<std::size_t, std::vector<Quad>> quads;
  for (const reference::Primitive& primitive : prediction.primitives) {
    if (primitive.mesh != 0 && primitive.mode == GL_QUAD_STRIP)
      append_quads(primitive, mesh_of.size(), quads[primitive.mesh]);
    mesh_of.insert(mesh_of.end(), primitive.vertices.size(), primitive.mesh);
  }
  std::vector<ExpectedPiece> expected = pieces_of(topology, mesh_of);
  const std::vector<ObservedPrimitive> seen = pieces_of(observation);
  const Distance distance(prediction, observation);
  MeshMatch match(distance, seen);
  for (std::size_t first = 0, end = 0; first < expected.size(); first = end) {
    const std::size_t mesh = expected[first].mesh;
    end = first + 1;
    while (mesh != 0 && end < expected.size() && expected[end].mesh == mesh) ++end;
    const auto filled = quads.find(mesh);
    if (filled == quads.end() ? !match.pieces({expected.begin() + static_cast<std::ptrdiff_t>(first),
                                               expected.begin() + static_cast<std::ptrdiff_t>(end)})
                              : !match.quads(filled->second))
      return {};
  }
  if (!match.complete()) return {};
  return Topology{shape_of(observation), match.take_vertices()};
}

std::optional<Topology> match_quads(const Prediction& prediction, const Observation& observation) {
  const std::optional<std::vector<Quad>> quads = quads_of(prediction);
  if (!quads || quads->empty()) return {};
  // A strip that is captured unchanged is not a quad, even if it has four vertices.
  const auto is_strip = [](const ObservedPrimitive& primitive) {
    return primitive.mode == GL_QUAD_STRIP || primitive.mode == GL_TRIANGLE_STRIP;
  };
  if (std::ranges::any_of(observation.primitives, is_strip)) return {};
  const Distance distance(prediction, observation);
  MeshMatch match(distance, observation.primitives);
  for (const Quad& quad : *quads)
    if (!match.quad(quad)) return {};
  if (!match.complete()) return {};
  return Topology{shape_of(observation), match.take_vertices()};
}

}  // namespace evalcts
