// Rewrites a case so that its commands go through display lists, with the same effect.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

enum class Lists {
  kNone,
  kCompiled,  // lists are compiled (COMPILE) before everything else; CallList replaces the commands
  kExecuted,  // the commands keep their place, enclosed by NewList(COMPILE_AND_EXECUTE) and EndList
  kNested,    // like kCompiled, but in two halves, which a third list calls
  kRepeated,  // like kCompiled, but a list whose Begin and End commands match is called twice
  kSplit      // like kCompiled, but three commands at a time; every third piece is not compiled
};

// A rewritten case. Command i of the original case is command positions[i] of `script`, whose other commands
// prepare it. If a delivery omits command i, positions[i] is the command before its place, or -1.
struct DeliveredCase {
  Case script;
  std::vector<int> positions;
};

// Returns the case with its commands in display lists. Three kinds of commands stay outside: those that the
// GL executes at once (queries, client state, objects), those that use the result of such a command, and
// those between NewList and EndList of the case itself. `repeated` draws everything twice; otherwise all
// forms have the same effect.
DeliveredCase through_lists(const Case& script, Lists lists);

// Returns the commands of the case in the order in which the GL executes them, with those of a list in place
// of each call of it. A case that uses results of its commands is returned as it is.
Case without_lists(const Case& script);

// Returns true if the case itself contains NewList.
bool uses_lists(const Case& script);

}  // namespace evalcts::gl
