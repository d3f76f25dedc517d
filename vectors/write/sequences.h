// Makes cases that are sequences of commands (INTERPRETING.md, "Sequences").
#pragma once

#include <evalcts/gl/case.h>
#include "document.h"
#include "maps.h"

namespace evalcts::vectors {

// The attributes that are listed for a vertex in addition to its position.
struct Shown {
  bool color = false, normal = false;
  int texture_units = 0;
};

// Returns {"level", "since", "steps": [...]}: each command with the errors that it may raise, its answers and
// the primitives that it emits, by the executable specification. Throws std::logic_error for queries whose
// answers the specification leaves open beyond a choice of roundings (integers from colours and normals,
// values beyond binary32), and if a primitive is open at the end.
Json sequence(const gl::Case& script, const Shown& shown = {});

// Append Map1f or Map1d, and so on.
void map1(gl::Case& c, Type type, GLenum target, double u1, double u2, int stride, int order,
          const Values& points);
void map2(gl::Case& c, Type type, GLenum target, double u1, double u2, int ustride, int uorder, double v1,
          double v2, int vstride, int vorder, const Values& points);
void grid1(gl::Case& c, Type type, int segments, double u1, double u2);
void grid2(gl::Case& c, Type type, int usegments, double u1, double u2, int vsegments, double v1, double v2);
// Appends the definition of a map without padding; its target determines the dimension.
void define(gl::Case& c, Type type, const Map& map);
// Appends queries of ORDER, DOMAIN and COEFF of a map with `values` control values.
void query_all(gl::Case& c, GLenum target, int values);
// Appends queries of segments and domains of both grids.
void query_grids(gl::Case& c);

// Returns small integers, each of which differs from its neighbours.
Values numbered(int count, int first = 1);

}  // namespace evalcts::vectors
