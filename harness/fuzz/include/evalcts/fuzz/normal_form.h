// Computes the normal form of a minimal program, which is the same for programs that show the same bug.
#pragma once

#include <string>

#include <evalcts/fuzz/campaign.h>

namespace evalcts::fuzz {

// Minimal programs with the same `cause` show one bug. The cause does not depend on properties that do not
// distinguish bugs: the dimension, the type of the arguments, the attribute of a map, the command that
// evaluates (if others do the same), and the way in which a wrong current value was noticed (a query, the
// next vertex, the next evaluated vertex). The cause depends on the kind of difference, display lists,
// AUTO_NORMAL, a missing vertex map, meshes and grids. An effect of a rejected command has the same cause
// wherever it was noticed.
struct NormalForm {
  std::string cause;  // "current values after an evaluation; in a display list"
  std::string title;  // one sentence: "An evaluation in a display list changes the current colour"
};
NormalForm normal_form(const Finding& minimal, int max_eval_order);

}  // namespace evalcts::fuzz
