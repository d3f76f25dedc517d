// Evaluator maps as GL state: nine kinds of data in one and in two dimensions (GL 2.1 table 5.1).
#pragma once

#include <GL/gl.h>

#include <vector>

#include <reference/bernstein.h>

namespace evalcts::reference {

// The nine targets of each dimension are consecutive tokens (EV-API-ENUM-MAP1, EV-API-ENUM-MAP2).
inline constexpr int kMapKinds = 9;

bool is_map1_target(GLenum target);
bool is_map2_target(GLenum target);

// Returns k, the number of values of one control point (EV-MAP1-K, EV-MAP2-K); 0 if `target` is not a map
// target.
int values_per_point(GLenum target);

// Returns the exponent of the largest magnitude that a GL of the version (10 * major + minor) promises to
// represent for data of the target: kReducedRange for colours and, before GL 2.0, texture coordinates;
// otherwise kFullRange.
int guaranteed_range(GLenum target, int version);

// An evaluator map. It is immutable once it is in a context, so that a redefinition does not change emitted
// vertices.
struct Map {
  struct Direction {
    int order = 1;
    double first = 0;  // u1 or v1
    double last = 1;   // u2 or v2
  };

  GLenum target;
  Direction u, v;  // v of a one-dimensional map keeps the values above
  // Control points without the padding of the caller's strides: component c of R_ij is points[(i * v.order +
  // j) * k + c]. GetMap returns them in this order (C-COEFF-ORDER).
  std::vector<double> points;
  bool is_initial = false;  // true for the map of a new context

  bool is_two_dimensional() const { return is_map2_target(target); }
  int components() const { return values_per_point(target); }

  // Views of one component, 0 <= component < components(), and of all; valid as long as the map.
  Surface surface(int component) const;
  std::vector<Surface> surfaces() const;
};

// Returns the map of a new context for the target: order 1, domain (0,1), one constant control point
// (EV-INIT-*). `target` must be one of the 18 map targets.
Map initial_map(GLenum target);

}  // namespace evalcts::reference
