// Drawings for tests of the pipeline after evaluation, each with evaluated and with explicit vertices, and
// comparisons of their pictures under the same state.
#pragma once

#include <string>
#include <vector>

#include <evalcts/judge/prediction.h>
#include "grid_cases.h"
#include "pictures.h"

namespace evalcts {

// --- The grid --------------------------------------------------------------------------------------------

// The patch has 4 by 3 quads. Its vertex (i, j) lies in the pixel (8 + 12 i, 8 + 16 j), vertex i of the curve
// in the pixel (8 + 12 i, kCurveRow). All have the offset kOff from the lower left corner of the pixel, so
// that no vertex and no edge is near the centre or the border of a pixel, or the border of its diamond (line
// rasterization).
inline constexpr int kColumns = 4, kRows = 3;
inline constexpr int kLeft = 8, kBottom = 8, kWidth = 12, kHeight = 16;
inline constexpr int kCurveRow = 30;
inline constexpr double kOff = 0.3;

// The evaluated colour at a vertex. No colour is black, and neighbours differ clearly.
std::array<double, 4> curve_color_at(int i);
std::array<double, 4> patch_color_at(int i, int j);

// Define and enable maps of VERTEX_3, COLOR_4, NORMAL and TEXTURE_COORD_4, and set the grid. Both are curved
// in z, within [-0.5,0.5].
void define_curve(gl::Case& c);
void define_patch(gl::Case& c);

// --- Drawings --------------------------------------------------------------------------------------------

struct Drawing {
  std::string name;
  bool two;
  GLenum primitive;      // the mode of Begin: POINTS, LINE_STRIP or QUAD_STRIP
  gl::Case evaluated;    // maps, grid and evaluation commands
  gl::Case vertices;     // the same drawing by explicit vertices
  Prediction predicted;  // the vertices of `evaluated`
};

// Returns the drawing of `evaluated`. Its explicit commands have no edge flags, see without_edge_flags().
Drawing drawing(Test& t, std::string name, bool two, GLenum primitive, gl::Case evaluated);

// Returns EvalMesh1 of POINT and LINE and EvalMesh2 of POINT, LINE and FILL over the whole grid, with
// `before` between the maps and the mesh; or those of them that draw the primitive.
std::vector<Drawing> meshes(Test& t, const gl::Case& before = {});
std::vector<Drawing> meshes(Test& t, GLenum primitive);

// Meshes of points and lines, and of quads: parameters of tests that treat quads differently.
struct MeshKind {
  const char* name;
  bool filled;
};
inline constexpr MeshKind kMeshKinds[] = {{"POINT_AND_LINE", false}, {"FILL", true}};
std::vector<Drawing> meshes_of(Test& t, const MeshKind& kind);

// Returns drawings by EvalCoord and EvalPoint of both dimensions between Begin and End.
std::vector<Drawing> primitives(Test& t);

// Returns meshes(), then primitives().
std::vector<Drawing> all_drawings(Test& t);

std::vector<Scene> scenes_of(const std::vector<Drawing>& drawings, bool evaluated,
                             const std::string& state_name = {}, const gl::Case& state = {});

// Returns explicit commands that draw the vertices of `evaluated`.
gl::Case explicit_commands(Test& t, const gl::Case& evaluated);
// Returns the commands without EdgeFlag, because some implementations lose vertices if it is set between
// them. All vertices then have the current edge flag.
gl::Case without_edge_flags(const gl::Case& commands);

// --- Comparisons -----------------------------------------------------------------------------------------

// Expects the feedback of a mesh of points or lines to have the points or lines of the control, in any order.
void expect_mesh_like_explicit(CheckedTrace& checked, const Part& seen, const Part& control);
// The same for all parts of the picture.
void expect_meshes_like_explicit(Picture& picture, const Picture& control);

// Expects the feedback of a drawing to be like that of the control: its points and lines one by one, for
// meshes in any order; for quads only the vertices of its polygons, because implementations may split quads
// freely.
void expect_drawn_like_explicit(CheckedTrace& checked, const Drawing& drawing, const Part& seen,
                                const Part& control);
void expect_drawn_like_explicit(Picture& picture, const std::vector<Drawing>& drawings,
                                const Picture& control);

// Returns true if any value of the part is above 0.05.
bool lit(const Part& part);
// Returns the number of values above 0.05 that a ReadPixels command returned.
std::size_t count_lit(const CheckedTrace& checked, gl::Ref read);

// The whole window.
inline constexpr Area kWindow = {0, 0, kSide, kSide};

}  // namespace evalcts
