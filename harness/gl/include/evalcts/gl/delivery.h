// Deliveries: variants of a case that must have the same effect. A case is written once, with Map1f and
// EvalCoord1f or with Map2f and EvalCoord2f, and delivered through other commands.
#pragma once

#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/display_lists.h>

namespace evalcts::gl {

struct Delivery {
  enum class Evaluation { kAsWritten, kCoordinates, kArray, kPoint, kMesh };

  std::string name;  // part of test names: the evaluation command and the form of display lists; may be empty
  Evaluation evaluation = Evaluation::kAsWritten;
  bool doubles = false;        // Map1d and EvalCoord1d instead of Map1f and EvalCoord1f
  bool lifted = false;         // a one-dimensional case becomes a two-dimensional one, see lift.h
  bool along_v = false;        // if lifted: the curve runs along v instead of u
  Lists lists = Lists::kNone;  // the form of display lists through which the resulting case goes
  bool sparing = false;        // for expensive tests: full depth runs as few as quick depth does

  // Returns the delivered case.
  //
  // coordinates, array: each Map and EvalCoord command is replaced by one command. Doubles are rounded to
  // floats if the delivery uses floats.
  //
  // point: a primitive whose arguments lie on a grid gets that grid (MapGrid), and EvalPoint replaces
  // EvalCoord. Other points become separate primitives, each with a grid whose first end is the point.
  //
  // mesh: EvalMesh replaces whole primitives: a POINT mesh for each point or run of points on a grid, and a
  // LINE mesh for line strips along a grid.
  //
  // Throws std::logic_error if this is not possible: for primitives other than points whose arguments lie on
  // no grid of less than 2^16 segments, and in meshes for primitives other than points and line strips.
  DeliveredCase apply(const Case& script) const;

  // Returns true for the unmodified case, and for EvalCoord1f and EvalCoord2f, which cases are written with.
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
  kGrids = 2,       // arguments become grid points: equal arguments need not become equal commands
  kArrays = 4,      // arguments are read from arrays
  kLists = 8,       // display lists
  kRepetition = 16  // everything is drawn twice
};
std::vector<Delivery> without(unsigned traits, const std::vector<Delivery>& deliveries);
std::vector<Delivery> sparing(std::vector<Delivery> deliveries);

}  // namespace evalcts::gl
