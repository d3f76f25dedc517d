// Implements wavefront().
#include "wavefront.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <reference/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <evalcts/results/text.h>

namespace evalcts::lab {
namespace {

using reference::Component;
using reference::Primitive;
using reference::Rational;
using reference::Vertex;

using Position = std::array<double, 3>;

template <class Values>
bool are_finite(const Values& values) {
  return std::ranges::all_of(values, [](auto value) { return std::isfinite(value); });
}

// Returns nothing if the position is not finite.
std::optional<Position> position_of(const Vertex& vertex) {
  for (const Component& each : vertex.position)
    if (!is_finite(each)) return {};
  const Rational w = exact(vertex.position[3]);
  if (w.is_zero()) return {};
  Position position;
  for (std::size_t i = 0; i < 3; ++i) position[i] = reference::round_to_double(exact(vertex.position[i]) / w);
  return position;
}

template <std::size_t kCount>
std::array<float, kCount> values_of(const std::array<Component, kCount>& components) {
  std::array<float, kCount> values;
  for (std::size_t i = 0; i < kCount; ++i) values[i] = rounded(components[i]);
  return values;
}

// Returns s/q and t/q.
std::array<float, 2> coordinates_of(const Vertex& vertex) {
  const auto [s, t, r, q] = values_of(vertex.texture_coordinate.of_unit_0);
  return {s / q, t / q};
}

// The attributes of an object that are written: those of which a vertex has another value than the initial
// one, if the values of all vertices are finite.
struct Attributes {
  explicit Attributes(const Object& object) {
    bool finite_colors = true, finite_normals = true, finite_coordinates = true;
    for (const Primitive& primitive : object.primitives)
      for (const Vertex& vertex : primitive.vertices) {
        const auto color = values_of(vertex.color);
        const auto normal = rounded(vertex.normal);
        const auto coordinates_here = coordinates_of(vertex);
        colors = colors || color != std::array{1.0f, 1.0f, 1.0f, 1.0f};
        normals = normals || normal != std::array{0.0f, 0.0f, 1.0f};
        coordinates = coordinates || coordinates_here != std::array{0.0f, 0.0f};
        finite_colors = finite_colors && are_finite(color);
        finite_normals = finite_normals && are_finite(normal);
        finite_coordinates = finite_coordinates && are_finite(coordinates_here);
      }
    colors = colors && finite_colors;
    normals = normals && finite_normals;
    coordinates = coordinates && finite_coordinates;
  }

  bool colors = false, normals = false, coordinates = false;
};

// Returns the vertices of each point, line or face of a primitive, from 0, as the GL assembles them (GL 2.1
// section 2.6.1).
std::vector<std::vector<std::size_t>> elements_of(GLenum mode, std::size_t count) {
  std::vector<std::vector<std::size_t>> elements;
  const auto all = [&](std::size_t size, std::size_t step, auto element) {
    for (std::size_t i = 0; i + size <= count; i += step) elements.push_back(element(i));
  };
  using Element = std::vector<std::size_t>;
  switch (mode) {
    case GL_POINTS:
      all(1, 1, [](std::size_t i) { return Element{i}; });
      break;
    case GL_LINES:
      all(2, 2, [](std::size_t i) { return Element{i, i + 1}; });
      break;
    case GL_LINE_STRIP:
    case GL_LINE_LOOP:
      all(2, 1, [](std::size_t i) { return Element{i, i + 1}; });
      if (mode == GL_LINE_LOOP && count > 1) elements.push_back({count - 1, 0});
      break;
    case GL_TRIANGLES:
      all(3, 3, [](std::size_t i) { return Element{i, i + 1, i + 2}; });
      break;
    case GL_TRIANGLE_STRIP:
      all(3, 1, [](std::size_t i) { return i % 2 ? Element{i + 1, i, i + 2} : Element{i, i + 1, i + 2}; });
      break;
    case GL_TRIANGLE_FAN:
      all(3, 1, [](std::size_t i) { return Element{0, i + 1, i + 2}; });
      break;
    case GL_QUADS:
      all(4, 4, [](std::size_t i) { return Element{i, i + 1, i + 2, i + 3}; });
      break;
    case GL_QUAD_STRIP:
      all(4, 2, [](std::size_t i) { return Element{i, i + 1, i + 3, i + 2}; });
      break;
    case GL_POLYGON:
      if (count > 2) {
        elements.emplace_back();
        for (std::size_t i = 0; i < count; ++i) elements.back().push_back(i);
      }
      break;
    default:
      break;
  }
  return elements;
}

// The text of a file. Vertices, texture coordinates and normals are numbered from 1 through the whole file.
class ObjText {
 public:
  void add(const Object& object) {
    const Attributes shown(object);
    text_ += fmt::format("o {}\n", object.name);
    std::size_t left_out = 0;
    for (const Primitive& primitive : object.primitives)
      if (!add(primitive, shown)) ++left_out;
    if (left_out > 0)
      text_ +=
          fmt::format("# Left out, because they have no finite position: {}\n", count(left_out, "primitive"));
  }
  std::string text() const { return text_; }

 private:
  // Returns false if the primitive has a vertex without a finite position.
  bool add(const Primitive& primitive, const Attributes& shown) {
    std::string lines;
    for (const Vertex& vertex : primitive.vertices) {
      const std::optional<Position> position = position_of(vertex);
      if (!position) return false;
      lines += fmt::format("v {}", fmt::join(*position, " "));
      if (shown.colors) {
        const auto [red, green, blue, alpha] = values_of(vertex.color);
        lines += fmt::format(" {} {} {}", red, green, blue);
      }
      lines += "\n";
      if (shown.coordinates) lines += fmt::format("vt {}\n", fmt::join(coordinates_of(vertex), " "));
      if (shown.normals) lines += fmt::format("vn {}\n", fmt::join(rounded(vertex.normal), " "));
    }
    for (const std::vector<std::size_t>& element : elements_of(primitive.mode, primitive.vertices.size())) {
      lines += element.size() == 1 ? "p" : element.size() == 2 ? "l" : "f";
      for (const std::size_t i : element) lines += " " + reference_to(i, element.size(), shown);
      lines += "\n";
    }
    text_ += lines;
    vertices_ += primitive.vertices.size();
    if (shown.coordinates) coordinates_ += primitive.vertices.size();
    if (shown.normals) normals_ += primitive.vertices.size();
    return true;
  }

  // Returns "V", "V/VT", "V//VN" or "V/VT/VN". Points have positions only, lines have no normals.
  std::string reference_to(std::size_t i, std::size_t element_size, const Attributes& shown) const {
    std::string text = fmt::format("{}", vertices_ + i + 1);
    const bool has_normal = shown.normals && element_size > 2;
    if (element_size > 1 && shown.coordinates) text += fmt::format("/{}", coordinates_ + i + 1);
    if (has_normal) text += fmt::format("{}/{}", shown.coordinates ? "" : "/", normals_ + i + 1);
    return text;
  }

  std::string text_;
  std::size_t vertices_ = 0, coordinates_ = 0, normals_ = 0;  // so far
};

}  // namespace

std::string wavefront(const std::vector<Object>& objects) {
  ObjText text;
  for (const Object& object : objects) text.add(object);
  return text.text();
}

}  // namespace evalcts::lab
