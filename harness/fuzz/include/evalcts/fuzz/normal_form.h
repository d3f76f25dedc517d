// Names the cause of a minimal program: the normal form, which is the same for programs that show the same
// bug.
#pragma once

#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

// Sets cause, title and requirement of a finding by the commands of its program. If the program is not
// minimal, commands that do not matter are named as well. Findings with the same cause are one bug. The cause
// does not depend on properties that do not distinguish bugs: the dimension, the type of the arguments, the
// attribute (except of values that EvalCoord evaluates), and the way in which a wrong current value was
// noticed (a query, the next vertex, the next evaluated vertex). It depends on the kind of difference,
// display lists, AUTO_NORMAL, a missing vertex map, meshes and grids. An effect of a rejected command has the
// same cause wherever it was noticed. cause: "current values after an evaluation; in a display list" title:
// "An evaluation in a display list changes the current colour" requirement: the most specific one that the
// commands concern, such as EV-CUR-COLOR
void name_finding(Finding& minimal, int max_eval_order);

}  // namespace evalcts::fuzz
