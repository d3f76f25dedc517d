// Reports a crash of the process as its last event: the place in the library, and the GL command in flight.
#pragma once

#include <evalcts/results/event_file.h>

namespace evalcts {

// Installs handlers for the signals of crashes. A handler writes the event Crashed to `events`, which must
// exist until the process ends, and then restores the earlier action of the signal. If the library installs
// its own handlers, it receives the signals instead.
void report_crashes(const EventFile& events);

}  // namespace evalcts
