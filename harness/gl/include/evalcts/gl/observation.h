// Defines observations: the captured vertices of a case, with the attributes that the capture can observe.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts {

// Thrown if the implementation provides no way to observe an effect. This is neither a pass nor a failure.
struct NotObservable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Attributes of a vertex, as a set.
enum Attribute : std::uint32_t {
  kPosition = 1u << 0,
  kColor = 1u << 1,
  kNormal = 1u << 2,
  kTextureCoordinate0 = 1u << 3,
  kTextureCoordinatesOther = 1u << 4,  // units 1 and up
  // The length of automatic normals: they are normalised unless a vertex shader is active (EV-AUTON-UNIT,
  // EV-AUTON-SHADER). A capture with kNormal also has one of these two.
  kUnitNormal = 1u << 5,
  kShaderNormal = 1u << 6,
};
using Attributes = std::uint32_t;
inline constexpr Attributes kAllAttributes =
    kPosition | kColor | kNormal | kTextureCoordinate0 | kTextureCoordinatesOther;

// Returns the names of the attributes, for messages.
std::string describe(Attributes attributes);

// Returns the attribute that shows the values of a map with this target, of either dimension. Throws
// NotObservable for INDEX, which has an effect in colour-index contexts only.
Attributes attribute_of(GLenum target);

inline constexpr std::size_t kTextureUnits = 8;

struct ObservedVertex {
  std::array<float, 4> position{};
  std::array<float, 4> color{};
  std::array<float, 3> normal{};
  std::array<std::array<float, 4>, kTextureUnits> texture_coordinate{};
  friend bool operator==(const ObservedVertex&, const ObservedVertex&) = default;
};

// Kinds of primitives, as a set.
enum PrimitiveKind : std::uint32_t {
  kPoints = 1u << 0,
  kLines = 1u << 1,     // LINES, LINE_STRIP, LINE_LOOP
  kPolygons = 1u << 2,  // everything that is filled
};
using PrimitiveKinds = std::uint32_t;
// Returns the kind of the primitives that Begin(mode) starts.
PrimitiveKind kind_of(GLenum mode);

// A captured primitive. An implementation may have split a strip, a quad or a polygon.
struct ObservedPrimitive {
  GLenum mode = GL_POINTS;
  std::vector<ObservedVertex> vertices;
};

struct Observation {
  Attributes attributes = 0;    // the attributes that hold observed values
  bool clamped_colors = false;  // colours were clamped to [0,1] on the way
  double color_error = 0;       // largest absolute error that the capture itself may add to a colour
  std::size_t units = 1;        // texture units observed
  GLenum error = GL_NO_ERROR;   // error that the case itself raised
  bool error_observed = true;   // false: the implementation has no GetError
  bool overflow = false;        // there was no room for some of the vertices
  std::vector<ObservedPrimitive> primitives;

  std::size_t vertex_count() const;
};

}  // namespace evalcts
