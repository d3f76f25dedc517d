// What the executable specification emits. Evaluated values are symbolic: which component of which map at
// which argument. Whoever judges them decides what to compute, lazily and exactly.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <reference/acceptance.h>
#include <reference/map.h>
#include <reference/normal.h>

namespace evalcts::reference {

inline constexpr int kTextureUnits = 8;

// One component of a map, evaluated.
struct Sample {
  std::shared_ptr<const Map> map;
  int component;
  Argument u;
  std::optional<Argument> v;  // for two-dimensional maps
};

// A value given as it is, or a sample. Values given to d commands (Vertex3d) are rounded to single precision
// first: the GL keeps current values in that precision and promises no more of a vertex (GL 2.1 section
// 2.1.1).
using Component = std::variant<float, Sample>;

// The normal that AUTO_NORMAL generates: of the surface of a two-dimensional vertex map.
struct AutomaticNormal {
  std::shared_ptr<const Map> map;
  Argument u, v;
};

using Normal = std::variant<std::array<Component, 3>, AutomaticNormal>;

struct Vertex {
  std::array<Component, 4> position;  // x, y, z, w
  std::array<Component, 4> color;     // R, G, B, A, not clamped (EV-ATTR-COLOR-CLAMP)
  Normal normal;                      // x, y, z
  std::array<std::array<Component, 4>, kTextureUnits> texture_coordinate;  // s, t, r, q of each unit
  Component index;  // colour index; in RGBA mode nothing that is drawn depends on it (EV-ATTR-INDEX-RGBA)
  bool edge_flag;
};

struct Primitive {
  GLenum mode;  // as given to Begin
  std::vector<Vertex> vertices;
  std::size_t mesh = 0;  // which EvalMesh2 drew it, counted from 1; 0: none
};

// Whether the component has an exact value: a finite float, or a sample whose data and arguments are finite.
// The other functions below throw std::domain_error where it has none, except rounded().
bool is_finite(const Component& component);

Rational exact(const Component& component);
// For a plain float the magnitude is its absolute value.
Evaluation exact_with_magnitude(const Component& component);

// The correctly rounded value; a plain float is itself. NaN for a sample without an exact value.
float rounded(const Component& component);
// An automatic normal has unit length, as without a vertex shader; NaN where there is none: data that is not
// finite, parallel derivatives, w = 0.
std::array<float, 3> rounded(const Normal& normal);

// Section 0.5 of the requirements, as in acceptance.h; `range` as there. A plain float has the bounds zero
// and always is a must.
Rational acceptance_bound(const Component& component);
bool must_applies(const Component& component, int range = kFullRange);
Rational quality_bound(const Component& component);
Acceptance acceptance(const Component& component, int range = kFullRange);

// The same for an automatic normal. None where it has no finite data.
std::optional<NormalAcceptance> acceptance(const AutomaticNormal& normal, int range = kFullRange);

}  // namespace evalcts::reference
