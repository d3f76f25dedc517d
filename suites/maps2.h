// Two-dimensional maps for tests: how they are made, laid out in memory, defined and shown.
#pragma once

#include <string>
#include <vector>

#include "maps.h"

namespace evalcts {

// A map as Map2 is given it: R_ij begins ustride*i + vstride*j values after the first. The memory ends with
// the whole block of the last point, the smaller stride, so that nothing legal is out of bounds (U-TAIL).
struct Map2 {
  GLenum target = GL_MAP2_VERTEX_3;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  int ustride = 3, vstride = 3, uorder = 1, vorder = 1;
  std::vector<double> points;

  int components() const { return gl::components_of(target); }
  // The control points packed, v fastest, as GetMap returns them.
  std::vector<double> coefficients() const;
};

// `coefficients` (packed, v fastest, uorder*vorder*k of them) over [0,1]x[0,1], laid out with the strides;
// padding is poisoned. Where the strides make points share memory, the last one written stays:
// Map2::coefficients() says what the map then is.
Map2 make_map2(GLenum target, int uorder, int vorder, int ustride, int vstride,
               const std::vector<double>& coefficients);
// Tightly packed, v fastest.
Map2 make_map2(GLenum target, int uorder, int vorder, const std::vector<double>& coefficients);
// Random points, tightly packed or with the strides.
Map2 random_map2(Test& t, GLenum target, int uorder, int vorder);
Map2 random_map2(Test& t, GLenum target, int uorder, int vorder, int ustride, int vstride);

// Where the control points lie in memory: the strides by k and the orders.
struct Layout {
  const char* name;
  int (*ustride)(int k, int uorder, int vorder);
  int (*vstride)(int k, int uorder, int vorder);
  bool shared;  // points share memory
};
inline constexpr Layout kLayouts[] = {
    {"U_MAJOR", [](int k, int, int vorder) { return k * vorder; }, [](int k, int, int) { return k; }, false},
    {"V_MAJOR", [](int k, int, int) { return k; }, [](int k, int uorder, int) { return k * uorder; }, false},
    // As one attribute of several, in rows that are longer than the net.
    {"EMBEDDED_U_MAJOR", [](int k, int, int vorder) { return (k + 5) * (vorder + 2); },
     [](int k, int, int) { return k + 5; }, false},
    {"EMBEDDED_V_MAJOR", [](int k, int, int) { return k + 3; },
     [](int k, int uorder, int) { return (k + 3) * (uorder + 1) + 1; }, false},
    {"EQUAL_STRIDES", [](int k, int, int) { return k; }, [](int k, int, int) { return k; }, true},
    {"EQUAL_PADDED_STRIDES", [](int k, int, int) { return k + 2; }, [](int k, int, int) { return k + 2; },
     true},
    {"OVERLAPPING_POINTS", [](int k, int, int) { return k + 1; }, [](int k, int, int) { return k; }, true},
};
Map2 random_map2(Test& t, GLenum target, int uorder, int vorder, const Layout& layout);

// All nine MAP2 targets in both forms ("MAP2_VERTEX_3_f"), or the eight whose values show.
const std::vector<TargetForm>& target_forms2();
const std::vector<TargetForm>& visible_target_forms2();
const std::vector<GLenum>& visible_targets2();

// Map2f or Map2d.
gl::Ref define(gl::Case& c, const Map2& map, bool doubles = false, gl::AfterCall after = gl::AfterCall::keep);
// The same memory for every call with this slot, with the contents of the moment.
gl::Ref define_in_slot(gl::Case& c, const Map2& map, bool doubles, int slot);

// EvalCoord2f or EvalCoord2d; EvalCoord2fv or EvalCoord2dv, whose array ends before an inaccessible page.
gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles = false);
gl::Ref evaluate2_vector(gl::Case& c, double u, double v, bool doubles);

// Orders, domain and points of one map, through GetMapfv or GetMapdv.
MapQuery query_map2(gl::Case& c, GLenum target, int max_order, bool doubles = false);
// ... are those of this map, to single precision where it was given in doubles.
void expect_map2(Played& played, const MapQuery& query, const Map2& map, bool doubles = false);

}  // namespace evalcts
