// The vertices that the executable specification emits. Evaluated values are symbolic: a component of a map
// and an argument. Their exact values are computed when they are needed.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <reference/acceptance.h>
#include <reference/map.h>
#include <reference/normal.h>

namespace evalcts::reference {

inline constexpr int kTextureUnits = 8;

// A map and the argument at which it is evaluated.
struct EvaluatedMap {
  std::shared_ptr<const Map> map;
  Argument u;
  std::optional<Argument> v;  // for two-dimensional maps
};

// One component of an evaluated map. The components share it, because primitives have tens of thousands of
// vertices with up to 45 components each.
struct Sample {
  Sample(std::shared_ptr<const EvaluatedMap> evaluated_map, int number)
      : evaluated(std::move(evaluated_map)), component(number) {}
  Sample(const std::shared_ptr<const Map>& map, int number, const Argument& u,
         const std::optional<Argument>& v)
      : Sample(std::make_shared<const EvaluatedMap>(EvaluatedMap{map, u, v}), number) {}

  const Map& map() const { return *evaluated->map; }
  const Argument& u() const { return evaluated->u; }
  const std::optional<Argument>& v() const { return evaluated->v; }

  std::shared_ptr<const EvaluatedMap> evaluated;
  int component;
};

// An explicit value, or a sample. Arguments of commands with double parameters (Vertex3d) are rounded to
// single precision, because the GL keeps current values in that precision and promises no more for a vertex
// (GL 2.1 section 2.1.1).
using Component = std::variant<float, Sample>;

// The normal that AUTO_NORMAL generates from a two-dimensional vertex map.
struct AutomaticNormal {
  std::shared_ptr<const Map> map;
  Argument u, v;
};

using Normal = std::variant<std::array<Component, 3>, AutomaticNormal>;

// Texture coordinates s, t, r, q of each unit. Evaluation sets those of unit 0 only (EV-ATTR-UNIT0).
struct TextureCoordinates {
  std::array<Component, 4> of_unit_0;
  std::array<std::array<float, 4>, kTextureUnits - 1> of_others;

  std::array<Component, 4> operator[](std::size_t unit) const {
    if (unit == 0) return of_unit_0;
    const auto& [s, t, r, q] = of_others.at(unit - 1);
    return {s, t, r, q};
  }
};

struct Vertex {
  std::array<Component, 4> position;  // x, y, z, w
  std::array<Component, 4> color;     // R, G, B, A, not clamped (EV-ATTR-COLOR-CLAMP)
  Normal normal;                      // x, y, z
  TextureCoordinates texture_coordinate;
  Component index;  // colour index, which has no effect in RGBA mode (EV-ATTR-INDEX-RGBA)
  bool edge_flag;
};

struct Primitive {
  GLenum mode;  // the argument of Begin
  std::vector<Vertex> vertices;
  std::size_t mesh = 0;  // number of the EvalMesh2 that drew it, from 1; 0: none
};

// Returns true if the component has an exact value: a finite float, or a sample whose data and arguments are
// finite. The functions below, except rounded(), throw std::domain_error if it has none.
bool is_finite(const Component& component);

Rational exact(const Component& component);
// Returns the exact value and its magnitude, which is the absolute value for an explicit float.
Evaluation exact_with_magnitude(const Component& component);

// Returns the correctly rounded value; an explicit float is returned unchanged. NaN for a sample without an
// exact value.
float rounded(const Component& component);
// Returns the rounded normal. An automatic normal has unit length, as without a vertex shader, or is NaN if
// it does not exist: non-finite data, parallel derivatives, w = 0.
std::array<float, 3> rounded(const Normal& normal);

// Same as in acceptance.h (the accuracy rule). For an explicit float, the bounds are zero and
// always a must.
Rational acceptance_bound(const Component& component);
bool must_applies(const Component& component, int range = kFullRange);
Rational quality_bound(const Component& component);
Acceptance acceptance(const Component& component, int range = kFullRange);

// The same for an automatic normal. Returns nothing if its data is not finite.
std::optional<NormalAcceptance> acceptance(const AutomaticNormal& normal, int range = kFullRange);

}  // namespace evalcts::reference
