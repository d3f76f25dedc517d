// Deliveries: variants of a case that must have the same effect. A case is written once, with Map1f and
// EvalCoord1f or with Map2f and EvalCoord2f, and delivered through other commands.
#pragma once

#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/display_lists.h>

namespace evalcts::gl {

struct Delivery {
  enum class Evaluation { as_written, coordinates, array, point, mesh };

  std::string
      name;  // part of test names: the command that evaluates, and the use of display lists; may be empty
  Evaluation evaluation = Evaluation::as_written;
  bool doubles = false;       // Map1d and EvalCoord1d instead of Map1f and EvalCoord1f
  bool lifted = false;        // a one-dimensional case becomes a two-dimensional one, see lift.h
  bool along_v = false;       // ... in which the curve runs along v
  Lists lists = Lists::none;  // and what came of all that goes through display lists
  bool sparing = false;       // for dear tests: below thorough depth one of these in turn is enough

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

  // Returns true for EvalCoord1f and EvalCoord2f, with which cases are written, and for the unmodified case.
  bool is_plain() const;
};

// Returns the deliveries of cases written with Map1f and EvalCoord1f: EvalCoord1f, 1fv, 1d, 1dv, EvalPoint1,
// EvalMesh1, the same commands in two dimensions, and all of these through each form of display lists.
const std::vector<Delivery>& curve_deliveries();
// Returns the deliveries of cases written with Map2f and EvalCoord2f: EvalCoord2f, 2fv, 2d, 2dv, EvalPoint2,
// EvalMesh2, and all of these through each form of display lists.
const std::vector<Delivery>& surface_deliveries();
// Returns the deliveries of all other cases: unmodified, and through each form of display lists.
const std::vector<Delivery>& list_deliveries();

// Properties of deliveries that a test may not support.
enum Trait : unsigned {
  kMeshes = 1,      // primitives become meshes
  kGrids = 2,       // arguments become grid points: the same arguments need not be the same commands
  kArrays = 4,      // arguments are read from arrays
  kLists = 8,       // display lists
  kRepetition = 16  // what is drawn is drawn twice
};
std::vector<Delivery> without(unsigned traits, const std::vector<Delivery>& deliveries);
std::vector<Delivery> sparing(std::vector<Delivery> deliveries);

}  // namespace evalcts::gl
