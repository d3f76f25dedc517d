/* The sink of smallest_sink.c with a mistake: all maps have the domain 0 to 1. If EVALCTS_DRILL is set, maps
 * of order 6 end the process. */
#include <evalcts_sink.h>
#include <stdlib.h>

#define evalcts_sink_open open_right_sink  // NOLINT(readability-identifier-naming): its real name
#include "../../examples/smallest_sink.c"
#undef evalcts_sink_open

static void map1f_of_unit_domain(unsigned target, float a, float b, int stride, int n, const float* p) {
  if (n == 6 && getenv("EVALCTS_DRILL")) abort();
  if (a != b) Map1f(target, 0, 1, stride, n, p);
}

const evalcts_sink* evalcts_sink_open(void) {
  static const evalcts_sink_command kWrongCommands[] = {EVALCTS_SINK_COMMAND(Enable),
                                                        {"glMap1f", (void (*)(void))map1f_of_unit_domain},
                                                        EVALCTS_SINK_COMMAND(EvalCoord1f),
                                                        {0, 0}};
  static evalcts_sink wrong;
  wrong = *open_right_sink();
  wrong.commands = kWrongCommands;
  return &wrong;
}
