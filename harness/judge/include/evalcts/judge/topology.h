// How primitives are taken apart on their way to a capture: into separate lines, triangles or polygons, in
// an order and by diagonals that are the implementation's own. It is learned from explicit vertices, so that
// only what evaluation adds is judged.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/observation.h>
#include <evalcts/judge/prediction.h>

namespace evalcts {

// The primitives that come out: mode and number of vertices. Points that follow each other are one.
using Shape = std::vector<std::pair<GLenum, std::size_t>>;
Shape shape_of(const Observation& observation);
std::string describe(const Shape& shape);  // "8 vertices", "3 LINES and 1 POLYGON of 4 vertices"

struct Topology {
  Shape shape;
  std::vector<std::size_t> vertices;  // which vertex of the case each one is that comes out

  // What draws only points comes out as it is.
  static Topology points(std::size_t count);
  bool only_points() const;
};

PrimitiveKinds kinds_of(const Prediction& prediction);

// The most vertices that can come out: triangles of a strip share none.
std::size_t most_vertices_of(const Prediction& prediction);

// The primitives of the prediction with explicit vertices, each of which has its number as x and s.
gl::Case explicit_primitives(const Prediction& prediction);

// Reads the numbers back. Empty where they do not come back, or where a vertex of a complete primitive is
// missing: then the implementation does not draw such primitives at all, evaluated or not.
std::optional<Topology> read_topology(const Prediction& prediction, const Observation& observation);

// The same for a case of quads only (QUADS, QUAD_STRIP) by what came out itself: quads in their order, each
// whole or as two triangles by either diagonal, turned any way but not over. An implementation may draw them
// so whatever it does with explicit quads (U-FEEDBACK-DECOMP). Empty where something else came out.
std::optional<Topology> match_quads(const Prediction& prediction, const Observation& observation);

// The same for a case with EvalMesh2: each of its meshes has the points, lines or polygons of `topology`, but
// in an order of its own, and lines may go either way. An implementation that draws a mesh in another order
// than the text has it is wrong (EV-MESH2-POINT, EV-MESH2-LINE, EV-MESH2-FILL), yet the vertices may be
// right. Quads are matched as above. Empty where something else came out, or where no mesh is drawn.
std::optional<Topology> match_meshes(const Prediction& prediction, const Topology& topology,
                                     const Observation& observation);

}  // namespace evalcts
