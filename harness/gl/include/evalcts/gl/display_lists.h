// Rewrites a case so that its commands go through display lists, with the same effect.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

enum class Lists {
  kNone,
  kCompiled,  // COMPILE before everything else; CallList where the commands were
  kExecuted,  // COMPILE_AND_EXECUTE around the commands where they are
  kNested,    // compiled in two halves, called by a third list
  kRepeated,  // compiled, and called twice wherever that leaves no Begin or End without the other
  kSplit      // compiled three commands at a time; every third piece stays as it is
};

// A rewritten case. Command i of the original case is command positions[i]; other commands prepare it.
struct DeliveredCase {
  Case script;
  std::vector<int> positions;
};

// Returns the case with its commands in display lists. Three kinds of commands stay outside: those that the
// GL executes at once (queries, client state, objects), those that use the result of such a command, and
// those between NewList and EndList of the case itself. `repeated` draws everything twice; otherwise all
// forms have the same effect.
DeliveredCase through_lists(const Case& script, Lists lists);

// True if the case makes a display list.
bool uses_lists(const Case& script);

}  // namespace evalcts::gl
