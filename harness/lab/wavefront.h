// Writes meshes in the format of Wavefront (.obj).
#pragma once

#include <reference/specification.h>

#include <string>
#include <vector>

namespace evalcts::lab {

struct Object {
  std::string name;
  std::vector<reference::Primitive> primitives;
};

// Returns the file: a position for each vertex, x/w, y/w and z/w of the exact values, rounded to doubles
// once; colours behind it, texture coordinates of unit 0 and normals, if any vertex of the object has another
// value than the initial one and all of them are finite; then points, lines, triangles, quads and polygons in
// the order of their vertices. Primitives with a vertex that has no finite position are left out, and a
// comment says so.
std::string wavefront(const std::vector<Object>& objects);

}  // namespace evalcts::lab
