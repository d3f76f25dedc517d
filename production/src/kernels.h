// The kernels: functions that evaluate many points at a time, for each instruction set.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <glevaluator.h>

#include "parameter.h"
#include "prepared_map.h"

namespace glev {

// An array of arguments: argument i is the float or double at data + i * stride bytes.
struct Input {
  const std::byte* data;
  std::size_t stride;
  bool is_double;

  double operator[](std::size_t i) const {
    if (is_double) {
      double argument;
      std::memcpy(&argument, data + i * stride, sizeof argument);
      return argument;
    }
    float argument;
    std::memcpy(&argument, data + i * stride, sizeof argument);
    return argument;
  }
};

// An array of results: element i is `components` floats at data + i * stride bytes; in meshes of two
// dimensions element (i, j) is at data + i * stride + j * row_stride. Components that a map does not have are
// those of (0,0,0,1).
struct Destination {
  std::byte* data;
  std::size_t stride, row_stride;
  int components;
};

// The columns from i1 on and the rows from j1 on of the grids u and v.
struct MeshRange {
  Grid u, v;
  std::int64_t i1, j1;
  std::size_t columns, rows;

  GridArgument u_of(std::size_t column) const { return {u, i1 + static_cast<std::int64_t>(column)}; }
  GridArgument v_of(std::size_t row) const { return {v, j1 + static_cast<std::int64_t>(row)}; }
  std::int64_t last_column() const { return i1 + static_cast<std::int64_t>(columns) - 1; }
  std::int64_t last_row() const { return j1 + static_cast<std::int64_t>(rows) - 1; }
};

// Returns true if GLEV_FAST would take longer than correct rounding on a grid, for a map with degrees up to
// kMaxCentredDegree: most points are on the boundary, or places have so few bits that double is exact for
// most maps. Such meshes are correctly rounded. The result depends on the grid and not on the range, so
// adjacent ranges have the same points.
inline bool has_few_segments(const Surface& surface, const MeshRange& range) {
  constexpr std::int64_t kFewestSegments = 225;
  constexpr int kFewBits = 18;
  const auto [n, m] = surface.degree;
  const auto [domain_u, domain_v] = surface.domain;
  const int bits =
      n * bits_of_places(domain_u, range.u) + (m == 0 ? 0 : m * bits_of_places(domain_v, range.v));
  const std::int64_t segments = std::int64_t{range.u.segments} * (m == 0 ? 1 : range.v.segments);
  return segments < kFewestSegments || bits <= kFewBits;
}

// The magnitudes of components for which GLEV_FAST has a bound.
inline constexpr double kLeastFast = 0x1p-80, kMostFast = 0x1p80;
// Returns false if the control points or the domain are so extreme that GLEV_FAST has no bound.
inline bool has_fast_bound(const PreparedMap& map) {
  for (int k = 0; k < map.surface.components; ++k) {
    const double largest = map.component[k].largest;
    if (map.component[k].kind == PreparedComponent::Kind::kUnclaimed) return false;
    if (largest == 0) continue;
    // Without a unit there is no bound, because arguments in such a domain overflow or underflow.
    const bool has_bound = std::isfinite(map.component[k].unit);
    if (!has_bound || !(largest >= kLeastFast && largest <= kMostFast)) return false;
  }
  return true;
}

// At most kPatchLanes patches of the same degrees, 1 to kMaxCentredDegree in u and 0 to kMaxCentredDegree in
// v, which are evaluated at the same arguments, one patch in each lane.
inline constexpr std::size_t kPatchLanes = 8;
// Patches with more points are faster one at a time.
inline constexpr std::size_t kMostPatchPoints = 2048;
struct PatchBlock {
  std::array<int, 2> degree;
  int components;
  std::size_t patches;
  // Value i of the control points of patch p, v fastest, is net[i * kPatchLanes + p]. Missing patches may
  // have any values.
  const double* net;
  // t - s of the columns and rows, from -1 to 1, with the errors that centred_units() assumes.
  const double *x, *y;
  std::size_t columns, rows;
  // The largest number of fractional bits of x^degree and y^degree together; kManyBits if they are not
  // dyadic.
  int bits_of_places;
  // Values along lines, whose x and y must be exact, have a rounding test of their own. This takes longer,
  // but decides ties and zeros.
  bool has_lines;
  bool fast;       // for grids that span the domain only
  Destination to;  // destination of patch 0; patch p begins p * patch_stride bytes later
  std::size_t patch_stride;
  const MeshRange* range;  // the points, if their grid spans the domain, otherwise null
  std::array<Domain, 2> domain;
};

// Computes the position at real arguments, which must not be subnormal, for plans that can be evaluated
// directly, in any floating-point environment without traps. Returns false if the result is not certain;
// `position` is then undefined.
using EvaluatesDirectly = bool (*)(const glev_plan& plan, double u, double v, float* position);

// The kernels of an instruction set. All results of maps are correctly rounded, unless `fast` is set.
// They require the default floating-point environment.
struct Kernels {
  const char* name;
  // Evaluates one point. `result` must have room for four components; those that the map does not have are
  // undefined.
  void (*point)(const PreparedMap& map, const GridArgument& u, const GridArgument& v, float* result);
  EvaluatesDirectly direct, direct_cubic_curve, direct_bicubic;
  // Evaluate curves and surfaces at many arguments.
  void (*curve)(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to);
  void (*surface)(const PreparedMap& map, const Input& u, const Input& v, std::size_t count, bool fast,
                  const Destination& to);
  // Evaluates a mesh. `scratch`: mesh_scratch() bytes, aligned to a cache line.
  void (*mesh)(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
               std::byte* scratch);
  // Evaluates the automatic normals of a plan that has them, with the bits of NormalRow, as floats. If
  // with_vertices is set, also writes the correctly rounded vertices of a VERTEX_3 map, each directly before
  // its normal. `scratch`: normal_mesh_scratch() bytes, aligned to a cache line.
  void (*normals)(const glev_plan& plan, const MeshRange& range, const Destination& to, bool with_vertices,
                  std::byte* scratch);
  Encloses encloses;  // see the type
  // Same as curve and mesh, with double results within one ULP. Return false, and do nothing, for maps and
  // grids that they do not support. The bits do not depend on the instruction set.
  bool (*double_curve)(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to);
  bool (*double_mesh)(const PreparedMap& map, const MeshRange& range, const Destination& to,
                      std::byte* scratch);
  // Converts the control points of kPatchLanes patches, `count` contiguous values of each, for
  // PatchBlock::net. They need not be aligned.
  void (*load_patches)(const float* const* points, std::size_t count, double* net);
  // Evaluates patches. Returns the undecided patches as bits; their results are undefined.
  unsigned (*patches)(const PatchBlock& block);
};

// Returns the bytes of scratch memory for `columns` columns of a map of degree `degree` in u.
std::size_t mesh_scratch(int degree, std::size_t columns);
// Returns the bytes for normals, which need the weights of the vertex map and of its derivative.
inline std::size_t normal_mesh_scratch(int degree, std::size_t columns) {
  return mesh_scratch(2 * degree, columns);
}

// Returns the kernels that this machine can run, best first; null for an index beyond the last.
const Kernels* kernels_of(std::size_t index);
// Returns the kernels with this name, or the best ones if `name` is null. Returns null for an unknown name.
const Kernels* find_kernels(const char* name);

}  // namespace glev
