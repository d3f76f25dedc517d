// Grids for tests, in one dimension and in two, and the probe that shows at which argument a grid point is
// evaluated.
#pragma once

#include <functional>

#include "maps.h"

namespace evalcts {

// One direction of a grid, as MapGrid is given it.
struct Grid {
  int segments;
  float first, last;
};
gl::Ref map_grid(gl::Case& c, const Grid& u);
gl::Ref map_grid(gl::Case& c, const Grid& u, const Grid& v);
// MapGrid1f of u alone, or MapGrid2f.
gl::Ref map_grid(gl::Case& c, bool two, const Grid& u, const Grid& v);

// Grids whose ends and steps are awkward in single precision. None is the domain of awkward_domain maps.
std::vector<Grid> awkward_grids();

struct Dimension {
  const char* name;
  bool two;
};
inline constexpr Dimension kDimensions[] = {{"1-D", false}, {"2-D", true}};

// The modes of EvalMesh, with the primitives that stand for their meshes.
struct MeshMode {
  const char* name;
  GLenum mode, primitive;
  PrimitiveKind kind;
};
inline constexpr MeshMode kMeshModes[] = {{"POINT", GL_POINT, GL_POINTS, kPoints},
                                          {"LINE", GL_LINE, GL_LINE_STRIP, kLines},
                                          {"FILL", GL_FILL, GL_QUAD_STRIP, kPolygons}};

// Enables maps of all kinds that show but one texture map, over [-1,3] and, in two dimensions, x [2,1].
void enable_maps(Test& t, gl::Case& c, bool two);

// --- Probes (technique O8 of the requirements) ---

// A direction of the evaluation that a probe looks along.
struct Along {
  const char* name;  // part of test names
  bool two;          // EvalPoint2 and EvalMesh2 instead of EvalPoint1 and EvalMesh1
  bool v;            // the grid under test is that of v
};
inline constexpr Along kAlong[] = {{"1-D_U", false, false}, {"2-D_U", true, false}, {"2-D_V", true, true}};

// MapGrid with the grid in the direction of the probe; in the other there is one of two steps over [0,1].
void map_grid(gl::Case& c, const Along& along, const Grid& grid);

// The first or the last end of many grids: 1 to some hundred segments over an awkward interval, and random
// ones, none with steps too small for the probe.
std::vector<Grid> probed_grids(Test& t);

// At an end of a grid the argument is that end itself. For each grid: what `draw` draws (called after
// map_grid, with the grid; primitives of one kind) goes through a map whose x is 0 at the end, 1 a little
// further on (1e-5 of it, more where it is small) and so on, so that the neighbouring number shows as another
// value. The text makes the argument exact, not the value: those of its vertices that lie near the end have
// to be nearer to what EvalCoord gives there than to what it gives at the neighbouring numbers. Where
// EvalCoord does not tell those apart, nothing is said. Throws NotObservable if that is so of all grids.
void expect_exact_end(Test& t, const Along& along, bool last, PrimitiveKind kind,
                      const std::function<void(gl::Case&, const Grid&)>& draw, std::size_t most_vertices);

}  // namespace evalcts
