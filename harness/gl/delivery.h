// Deliveries: a case is written once, with Map1f and EvalCoord1f or with Map2f and EvalCoord2f, and delivered
// through other commands that have to do the same.
#pragma once

#include <vector>

#include "harness/gl/case.h"

namespace evalcts::gl {

// A case as it is played. Command i of the case as it was written has become command positions[i], among
// others that prepare it.
struct DeliveredCase {
  Case script;
  std::vector<int> positions;
};

struct Delivery {
  enum class Evaluation { coordinates, array, point, mesh };

  const char* name;  // part of test names: the command that evaluates
  Evaluation evaluation;
  bool doubles;  // Map1d and EvalCoord1d instead of Map1f and EvalCoord1f
  bool lifted;   // a one-dimensional case becomes a two-dimensional one, see lift.h
  bool along_v;  // ... in which the curve runs along v

  // coordinates, array: Map and EvalCoord commands are replaced one for one. Values that need doubles lose
  // their last digits on the way to floats.
  //
  // point: a primitive whose arguments lie on a grid gets that grid (MapGrid) and EvalPoint for EvalCoord; of
  // other points each is a primitive and has a grid of its own, of which it is the first end.
  // mesh: EvalMesh in place of whole primitives: POINT meshes, one for each point or run of points on a grid,
  // and LINE meshes for line strips along a grid.
  // Throws std::logic_error where that cannot be done: other primitives whose arguments are on no grid of
  // less than 2^16 segments, and for meshes all primitives but points and line strips.
  DeliveredCase apply(const Case& script) const;

  // EvalCoord1f and EvalCoord2f: the commands that cases are written with.
  bool is_plain() const;
};

// For cases written with Map1f and EvalCoord1f: EvalCoord1f, 1fv, 1d, 1dv, EvalPoint1, EvalMesh1, and the
// same in two dimensions.
const std::vector<Delivery>& curve_deliveries();
// For cases written with Map2f and EvalCoord2f: EvalCoord2f, 2fv, 2d, 2dv, EvalPoint2, EvalMesh2.
const std::vector<Delivery>& surface_deliveries();
// Those that keep each primitive what it is: all but meshes.
std::vector<Delivery> without_meshes(const std::vector<Delivery>& deliveries);
// Those that read no arguments from arrays.
std::vector<Delivery> without_arrays(const std::vector<Delivery>& deliveries);
// Those that need no grid: the same arguments are the same commands.
std::vector<Delivery> without_grids(const std::vector<Delivery>& deliveries);

}  // namespace evalcts::gl
