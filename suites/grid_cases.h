// One- and two-dimensional grids for tests, and a probe that shows at which argument an implementation
// evaluates the first and the last grid point.
#pragma once

#include <functional>

#include "maps.h"

namespace evalcts {

// The arguments of MapGrid for one direction.
struct Grid {
  int segments;
  float first, last;
};
gl::Ref map_grid(gl::Case& c, const Grid& u);
gl::Ref map_grid(gl::Case& c, const Grid& u, const Grid& v);
// Appends MapGrid2f, or MapGrid1f of u alone.
gl::Ref map_grid(gl::Case& c, bool two, const Grid& u, const Grid& v);

// Grids whose ends and steps round in single precision, and simple ones.
std::vector<Grid> awkward_grids();

struct Dimension {
  const char* name;
  bool two;
};
inline constexpr Dimension kDimensions[] = {{"1-D", false}, {"2-D", true}};

// The modes of EvalMesh, with the primitives by which the specification defines their meshes.
struct MeshMode {
  const char* name;
  GLenum mode, primitive;
  PrimitiveKind kind;
};
inline constexpr MeshMode kMeshModes[] = {{"POINT", GL_POINT, GL_POINTS, kPoints},
                                          {"LINE", GL_LINE, GL_LINE_STRIP, kLines},
                                          {"FILL", GL_FILL, GL_QUAD_STRIP, kPolygons}};

// Defines and enables random maps of VERTEX_4, COLOR_4, NORMAL and TEXTURE_COORD_4 over [-1,3], in two
// dimensions over [-1,3] x [2,1].
void enable_maps(Test& t, gl::Case& c, bool two);

// --- Probes (technique O8 of the requirements) ---

// The dimension and the direction in which a probe examines a grid.
struct Along {
  const char* name;  // part of test names
  bool two;          // true: EvalPoint2 and EvalMesh2; false: EvalPoint1 and EvalMesh1
  bool v;            // true if the grid under test is that of v
};
inline constexpr Along kAlong[] = {{"1-D_U", false, false}, {"2-D_U", true, false}, {"2-D_V", true, true}};

// Appends MapGrid with the grid in the direction of the probe, and two segments over [0,1] in the other one.
void map_grid(gl::Case& c, const Along& along, const Grid& grid);

// Returns the grids that expect_exact_end() examines: awkward ones, 1 to 60 or more segments (by depth) over
// [0.1,0.7], and random ones. All have steps that are large enough for the probe.
std::vector<Grid> probed_grids(Test& t);

// Expects the argument at the first or last grid point to be exactly the end of the grid, for all
// probed_grids(). `draw` is called with each grid after its MapGrid and appends primitives of one kind with
// at most `most_vertices` vertices in all. They are evaluated with a map that is so steep (x rises from 0 at
// the end to 1 within 1e-5 of its magnitude) that adjacent arguments give different values. The specification
// makes the argument exact, not the value: vertices near the end have to be nearer to what EvalCoord gives at
// the end than to what it gives at the adjacent floats. Grids for which EvalCoord gives the same value there
// are not judged. Throws NotObservable if none is judged.
void expect_exact_end(Test& t, const Along& along, bool last, PrimitiveKind kind,
                      const std::function<void(gl::Case&, const Grid&)>& draw, std::size_t most_vertices);

}  // namespace evalcts
