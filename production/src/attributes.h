// The attribute stack: what PushAttrib saves and PopAttrib brings back (GL §21.6, the tables of chapter 23).
#pragma once

#include <array>

#include <glevaluator.h>

#include "parameter.h"
#include "target.h"

namespace glev {

inline constexpr int kAttribStackDepth = 16;

// Group eval, of which ENABLE_BIT has the flags, too. Map specifications are in no group.
struct EvalAttributes {
  // [dimension - 1]
  std::array<std::array<bool, kSlots>, 2> enabled{};
  std::array<std::array<Grid, 2>, 2> grid;  // u, v; one-dimensional maps have no use for v
  bool auto_normal = false;
};

// All groups are saved, the mask says which ones count.
struct SavedAttributes {
  glev_bitfield mask;
  EvalAttributes eval;
  glev_vertex current;
  unsigned active_unit;  // group texture
  glev_uint list_base;
};

}  // namespace glev
