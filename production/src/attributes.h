// The attribute stack: the state that PushAttrib saves and PopAttrib restores (GL §21.6, the tables of
// chapter 23).
#pragma once

#include <array>

#include <glevaluator.h>

#include "parameter.h"
#include "target.h"

namespace glev {

inline constexpr int kAttribStackDepth = 16;

// The group "eval". ENABLE_BIT has its flags, too. Map specifications belong to no group.
struct EvalAttributes {
  // [dimension - 1]
  std::array<std::array<bool, kSlots>, 2> enabled{};
  std::array<std::array<Grid, 2>, 2> grid;  // u, v; one-dimensional maps do not use v
  bool auto_normal = false;
};

// All groups are saved; the mask selects the groups to restore.
struct SavedAttributes {
  glev_bitfield mask;
  EvalAttributes eval;
  glev_vertex current;
  unsigned active_unit;  // group texture
  glev_uint list_base;
};

}  // namespace glev
