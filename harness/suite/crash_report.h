// Reports a crash of the process as its last event: the place in the library, and the GL command in flight.
#pragma once

#include <evalcts/results/event_file.h>

namespace evalcts {

// Installs handlers for crashes. A handler writes the event Crashed to `events`, which must exist until the
// process ends, and then restores the earlier action of the signal. If the library installs its own handlers,
// it receives the signals instead. The calling thread is the one that runs jobs.
void report_crashes(const EventFile& events);

// Ends the process, whose job hangs, from another thread. Reports the command in flight like a crash.
[[noreturn]] void end_hanging_job();

}  // namespace evalcts
