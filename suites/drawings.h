// Drawings of tests of the rest of the pipeline: the same with evaluated and with explicit vertices, which
// have to show the rule under the same state.
#pragma once

#include <string>
#include <vector>

#include <evalcts/judge/prediction.h>
#include "grid_cases.h"
#include "pictures.h"

namespace evalcts {

// --- The grid --------------------------------------------------------------------------------------------

// 4 by 3 quads. Vertex (i, j) of the patch is in the pixel (8 + 12 i, 8 + 16 j), vertex i of the curve in the
// pixel (8 + 12 i, kCurveRow): a little off its middle, so that neither the middle nor the border of a pixel,
// nor of its diamond, is near a vertex or an edge.
inline constexpr int kColumns = 4, kRows = 3;
inline constexpr int kLeft = 8, kBottom = 8, kWidth = 12, kHeight = 16;
inline constexpr int kCurveRow = 30;
inline constexpr double kOff = 0.3;

// The evaluated colour at a vertex; none is black, and neighbours are far apart.
std::array<double, 4> curve_color_at(int i);
std::array<double, 4> patch_color_at(int i, int j);

// Maps of positions, colours, normals and texture coordinates (s, t, r, q) with the grid, enabled. Both are
// curved in z, within 0.5 of 0.
void define_curve(gl::Case& c);
void define_patch(gl::Case& c);

// --- Drawings --------------------------------------------------------------------------------------------

struct Drawing {
  std::string name;
  bool two;
  GLenum primitive;      // what Begin is given: POINTS, LINE_STRIP or QUAD_STRIP
  gl::Case evaluated;    // maps, grid and what evaluates
  gl::Case vertices;     // the explicit commands
  Prediction predicted;  // their vertices
};

// The explicit commands are those without_edge_flags().
Drawing drawing(Test& t, std::string name, bool two, GLenum primitive, gl::Case evaluated);

// EvalMesh1 in POINT and LINE, EvalMesh2 in POINT, LINE and FILL, over the whole grid. `before` comes after
// the maps.
std::vector<Drawing> meshes(Test& t, const gl::Case& before = {});
std::vector<Drawing> meshes(Test& t, GLenum primitive);

// Apart where quads go a way of their own.
struct MeshKind {
  const char* name;
  bool filled;
};
inline constexpr MeshKind kMeshKinds[] = {{"POINT_AND_LINE", false}, {"FILL", true}};
std::vector<Drawing> meshes_of(Test& t, const MeshKind& kind);

// EvalCoord and EvalPoint of either dimension, between Begin and End.
std::vector<Drawing> primitives(Test& t);

// Meshes, then the others.
std::vector<Drawing> all_drawings(Test& t);

std::vector<Scene> scenes_of(const std::vector<Drawing>& drawings, bool evaluated,
                             const std::string& state_name = {}, const gl::Case& state = {});

// The explicit commands for what `evaluated` emits.
gl::Case explicit_commands(Test& t, const gl::Case& evaluated);
// The commands but EdgeFlag: the current edge flag counts for all vertices, and an implementation may lose
// everything if it is set between them.
gl::Case without_edge_flags(const gl::Case& commands);

// --- Comparisons -----------------------------------------------------------------------------------------

// Feedback of one EvalMesh2 in POINT or LINE: its points or lines are those of the control, in any order.
void expect_mesh_like_explicit(Played& played, const Part& seen, const Part& control);
// All parts of the picture are.
void expect_meshes_like_explicit(Picture& picture, const Picture& control);

// Feedback: points and lines are like those of the control, one for one, those of EvalMesh2 in any order. Of
// polygons the vertices are: how quads are decomposed is free.
void expect_drawn_like_explicit(Played& played, const Drawing& drawing, const Part& seen,
                                const Part& control);
void expect_drawn_like_explicit(Picture& picture, const std::vector<Drawing>& drawings,
                                const Picture& control);

// True if anything but 0 was read.
bool lit(const Part& part);
// Number of values other than 0 that a command read.
std::size_t count_lit(const Played& played, gl::Ref read);

// The whole window.
inline constexpr Area kWindow = {0, 0, kSide, kSide};

}  // namespace evalcts
