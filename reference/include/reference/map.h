// An evaluator map as the GL keeps it: nine kinds of data in one and in two dimensions (GL 2.1 table 5.1).
#pragma once

#include <GL/gl.h>

#include <vector>

#include <reference/bernstein.h>

namespace evalcts::reference {

// The nine targets of each dimension are consecutive tokens (EV-API-ENUM-MAP1, EV-API-ENUM-MAP2).
inline constexpr int kMapKinds = 9;

bool is_map1_target(GLenum target);
bool is_map2_target(GLenum target);

// k, the number of values of one control point (EV-MAP1-K, EV-MAP2-K); 0 if `target` is not a map target.
int values_per_point(GLenum target);

// The power of two that bounds the magnitudes which a GL of that version (10 * major + minor) promises to
// represent for the data of the target: kReducedRange for colours, before GL 2.0 for texture coordinates too,
// else kFullRange.
int guaranteed_range(GLenum target, int version);

// Immutable once it is in a context, so that a redefinition never changes what was emitted before it.
struct Map {
  struct Direction {
    int order = 1;
    double first = 0;  // u1 or v1
    double last = 1;   // u2 or v2
  };

  GLenum target;
  Direction u, v;  // v of a one-dimensional map stays as it is here
  // Packed, without the padding of the caller's strides: component c of R_ij is points[(i * v.order + j) * k
  // + c], which is the order in which GetMap returns them (C-COEFF-ORDER).
  std::vector<double> points;

  bool is_two_dimensional() const { return is_map2_target(target); }
  int components() const { return values_per_point(target); }

  // Views of one component, 0 <= component < components(); valid as long as the map.
  Curve curve(int component) const;       // one-dimensional maps only
  Surface surface(int component) const;   // both: a one-dimensional map is constant in v
  std::vector<Surface> surfaces() const;  // of all components
};

// The map that a new context holds for the target: order 1, domain (0,1), one constant control point
// (EV-INIT-*). `target` must be one of the 18.
Map initial_map(GLenum target);

}  // namespace evalcts::reference
