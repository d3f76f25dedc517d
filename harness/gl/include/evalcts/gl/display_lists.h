// A case made to go through display lists: what it does stays the same.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

enum class Lists {
  none,
  compiled,  // COMPILE before everything else; CallList where the commands were
  executed,  // COMPILE_AND_EXECUTE around the commands where they are
  nested,    // compiled in two halves, called by a third list
  repeated,  // compiled, and called twice wherever that leaves no Begin or End without the other
  split      // compiled three commands at a time; every third piece stays as it is
};

// A case as it is played. Command i of the case as it was written has become command positions[i], among
// others that prepare it.
struct DeliveredCase {
  Case script;
  std::vector<int> positions;
};

// Commands that the GL executes at once (queries, client state, objects), those that need what such a command
// returned, and those between a NewList and an EndList of the case itself stay where they are. What a case
// draws is drawn twice by `repeated`; everything else is the same for every way.
DeliveredCase through_lists(const Case& script, Lists lists);

// True if the case makes a display list.
bool uses_lists(const Case& script);

}  // namespace evalcts::gl
