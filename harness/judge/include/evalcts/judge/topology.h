// Topology: how an implementation splits primitives into separate lines, triangles or polygons on their way
// to a capture. The order and the diagonals are the implementation's choice. They are learned from explicit
// vertices, so that only the effect of evaluation is judged.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/observation.h>
#include <evalcts/judge/prediction.h>

namespace evalcts {

// The captured primitives: mode and number of vertices of each. Consecutive points form one entry.
using Shape = std::vector<std::pair<GLenum, std::size_t>>;
Shape shape_of(const Observation& observation);
std::string describe(const Shape& shape);  // "8 vertices", "3 LINES and 1 POLYGON of 4 vertices"

struct Topology {
  Shape shape;
  std::vector<std::size_t> vertices;  // for each captured vertex, the index of the vertex in the case

  // The topology of `count` points, which are never split.
  static Topology points(std::size_t count);
  bool only_points() const;
};

// Returns the kinds of the predicted primitives; kPoints if there are none.
PrimitiveKinds kinds_of(const Prediction& prediction);

// Returns the largest possible number of captured vertices, which counts each triangle of a strip separately.
std::size_t most_vertices_of(const Prediction& prediction);

// Returns a case that draws the predicted primitives with explicit vertices; the index of each vertex is its
// x and its s coordinate.
gl::Case explicit_primitives(const Prediction& prediction);

// Reads the topology from the captured output of explicit_primitives(). Returns nothing if the indices do not
// come back or a vertex of a complete primitive is missing: the implementation then does not draw such
// primitives at all, evaluated or explicit.
std::optional<Topology> read_topology(const Prediction& prediction, const Observation& observation);

// Finds the topology of a case that draws only quads (QUADS, QUAD_STRIP) by matching its own captured output:
// quads in order, each whole or as two triangles along either diagonal, starting at any corner with the same
// orientation. An implementation may split evaluated quads differently from explicit ones
// (U-FEEDBACK-DECOMP). Returns nothing if the output is different.
std::optional<Topology> match_quads(const Prediction& prediction, const Observation& observation);

// Replaces TRIANGLE_STRIP by QUAD_STRIP where a sink hands over the quads of a mesh as triangles: the strips
// have the same vertices in the same order.
void take_triangles_of_meshes_for_quads(const Prediction& prediction, const Topology& topology,
                                        Observation& observation);

// Finds the topology of a case with EvalMesh2 by matching its captured output: each mesh has the points,
// lines or polygons of `topology` in any order, and lines may have either direction. Drawing a mesh in
// another order than the text prescribes is an error (EV-MESH2-POINT, EV-MESH2-LINE, EV-MESH2-FILL), but its
// vertices may still be right. Quads are matched as by match_quads(). Returns nothing if the output is
// different or no mesh is drawn.
std::optional<Topology> match_meshes(const Prediction& prediction, const Topology& topology,
                                     const Observation& observation);

}  // namespace evalcts
