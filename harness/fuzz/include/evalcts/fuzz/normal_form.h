// The normal form of a minimal program: what it has in common with others that show the same bug.
#pragma once

#include <string>

#include <evalcts/fuzz/campaign.h>

namespace evalcts::fuzz {

// Minimal programs with the same `cause` are one bug. The cause leaves out what does not make a bug: the
// dimension, the type of the arguments, which attribute a map has, the command that evaluates if others do
// the same, and how a wrong current value was noticed (a query, the next vertex, the next evaluated vertex).
// It keeps the kind of difference, display lists, AUTO_NORMAL, a missing vertex map, meshes and grids.
struct NormalForm {
  std::string cause;  // "current values after an evaluation; in a display list"
  std::string title;  // one sentence: "An evaluation in a display list changes the current colour"
};
NormalForm normal_form(const Finding& minimal, int max_eval_order);

}  // namespace evalcts::fuzz
