/* The sink of smallest_sink.c with a mistake: all maps have the domain 0 to 1. If EVALCTS_DRILL is "order",
 * maps of order 6 end the process; if it is "hang", they never return, and create the file EVALCTS_DRILL_FILE
 * before. */
#include <evalcts_sink.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define evalcts_sink_open open_right_sink  // NOLINT(readability-identifier-naming): its real name
#include "../../examples/smallest_sink.c"
#undef evalcts_sink_open

static void map1f_of_unit_domain(unsigned target, float a, float b, int stride, int n, const float* p) {
  const char* drill = getenv("EVALCTS_DRILL");
  if (n == 6 && drill && strcmp(drill, "order") == 0) abort();
  if (n == 6 && drill && strcmp(drill, "hang") == 0) {
    fclose(fopen(getenv("EVALCTS_DRILL_FILE"), "w"));
    for (;;) pause();
  }
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
