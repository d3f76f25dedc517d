// Statements of the vectors on sequences of commands (INTERPRETING.md, "Sequences").
#pragma once

#include <evalcts/gl/case.h>
#include "document.h"
#include "maps.h"

namespace evalcts::vectors {

// Attributes of a vertex that are stated, beside its position.
struct Shown {
  bool color = false, normal = false;
  int texture_units = 0;
};

// {"level", "since", "steps": [...]}: each command with the errors that it may raise, what it answers and
// what it emits, by the executable specification. Commands whose answers the GL leaves open beyond a choice
// of roundings (integers from colours and normals, values that no float holds) and open primitives or lists
// at the end are std::logic_error.
Json sequence(const gl::Case& script, const Shown& shown = {});

// Map1f or Map1d, and so on.
void map1(gl::Case& c, Type type, GLenum target, double u1, double u2, int stride, int order,
          const Values& points);
void map2(gl::Case& c, Type type, GLenum target, double u1, double u2, int ustride, int uorder, double v1,
          double v2, int vstride, int vorder, const Values& points);
void grid1(gl::Case& c, Type type, int segments, double u1, double u2);
void grid2(gl::Case& c, Type type, int usegments, double u1, double u2, int vsegments, double v1, double v2);
// A map, packed: of one dimension or of two, as its target says.
void define(gl::Case& c, Type type, const Map& map);
// ORDER, DOMAIN and COEFF of a map with so many values.
void query_all(gl::Case& c, GLenum target, int values);

// Small whole numbers, all different from their neighbours.
Values numbered(int count, int first = 1);

}  // namespace evalcts::vectors
