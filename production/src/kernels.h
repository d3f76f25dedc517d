// Evaluation of many points at a time, for each instruction set.
#pragma once

#include <array>
#include <cstddef>

#include <glevaluator.h>

#include "parameter.h"
#include "prepared_map.h"

namespace glev {

// Arguments: number i is the float or double at data + i * stride bytes.
struct Input {
  const std::byte* data;
  std::size_t stride;
  bool is_double;

  double operator[](std::size_t i) const;
};

// Results: element i is `components` floats at data + i * stride bytes, in meshes of two dimensions element
// (i, j) at data + i * stride + j * row_stride. Those that a map does not give are (0,0,0,1)'s.
struct Destination {
  std::byte* data;
  std::size_t stride, row_stride;
  int components;
};

// Columns i1..., rows j1... of the grids u and v.
struct MeshRange {
  Grid u, v;
  std::int64_t i1, j1;
  std::size_t columns, rows;

  GridArgument u_of(std::size_t column) const { return {u, i1 + static_cast<std::int64_t>(column)}; }
  GridArgument v_of(std::size_t row) const { return {v, j1 + static_cast<std::int64_t>(row)}; }
  std::int64_t last_column() const { return i1 + static_cast<std::int64_t>(columns) - 1; }
  std::int64_t last_row() const { return j1 + static_cast<std::int64_t>(rows) - 1; }
};

// Tells if a mesh of a grid with so few segments, of a map with centred coefficients and degree m in v, takes
// longer if it is fast, and so is correctly rounded. By the grid, not by the range, so that ranges agree
// where they meet.
inline bool has_few_segments(const MeshRange& range, int m) {
  constexpr std::int64_t kFewestSegments = 1 << 14;
  return static_cast<std::int64_t>(range.u.segments) * (m == 0 ? 1 : range.v.segments) < kFewestSegments;
}

// Patches of degrees 1 to kMaxCentredDegree in u and 0 to kMaxCentredDegree in v, at most kPatchLanes of
// them, side by side at the same places.
inline constexpr std::size_t kPatchLanes = 8;
struct PatchBlock {
  std::array<int, 2> degree;
  int components;
  std::size_t patches;
  // Value number i of the control points of patch p, v fastest, is net[i * kPatchLanes + p]; those of missing
  // patches are any numbers.
  const double* net;
  // t - s of the columns and rows, from -1 to 1, as centred_units supposes.
  const double *x, *y;
  std::size_t columns, rows;
  // Bits behind the points of x^degree and y^degree together, at most; kManyBits if they are not dyadic.
  int bits_of_places;
  Destination to;  // that of patch p begins p * patch_stride bytes later
  std::size_t patch_stride;
};

// The position at real arguments that are no subnormal numbers, in whatever environment without traps, of
// plans that can be evaluated directly. False, and nothing claimed, where that is not sure.
using EvaluatesDirectly = bool (*)(const glev_plan& plan, double u, double v, float* position);

// All results of maps are correctly rounded, but those of fast meshes. The environment is the default one.
struct Kernels {
  const char* name;
  // One point: the components of the map. There is room for four; those that the map has not are then
  // anything.
  void (*point)(const PreparedMap& map, const GridArgument& u, const GridArgument& v, float* result);
  EvaluatesDirectly direct, direct_cubic_curve, direct_bicubic;
  // v counts for nets of two dimensions only.
  void (*curve)(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to);
  void (*surface)(const PreparedMap& map, const Input& u, const Input& v, std::size_t count,
                  const Destination& to);
  // scratch: mesh_scratch bytes, aligned to a cache line.
  void (*mesh)(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
               std::byte* scratch);
  // Automatic normals of a plan that has them, with the bits of NormalRow. `to` is of floats. If
  // with_vertices is set, also the correctly rounded vertices of a VERTEX_3 map: each lies right before its
  // normal. scratch: normal_mesh_scratch bytes, aligned to a cache line.
  void (*normals)(const glev_plan& plan, const MeshRange& range, const Destination& to, bool with_vertices,
                  std::byte* scratch);
  Encloses encloses;  // for maps as that type says
  // The same as curve and mesh, to doubles within one ULP. False, and nothing done, for maps and grids for
  // which there is no good way. The bits do not depend on the instruction set.
  bool (*double_curve)(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to);
  bool (*double_mesh)(const PreparedMap& map, const MeshRange& range, const Destination& to,
                      std::byte* scratch);
  // Returns the patches that are not decided, as bits; anything is written for these.
  unsigned (*patches)(const PatchBlock& block);
};

// Bytes for so many columns of a map of so high a degree in u.
std::size_t mesh_scratch(int degree, std::size_t columns);
// Normals need the weights of the vertex map and of its derivative.
inline std::size_t normal_mesh_scratch(int degree, std::size_t columns) {
  return mesh_scratch(2 * degree, columns);
}

// The kernels that this machine can run, best first; null for an index beyond the last.
const Kernels* kernels_of(std::size_t index);
// Returns the kernels of that name, the best ones for null; null if there are none.
const Kernels* find_kernels(const char* name);

}  // namespace glev
