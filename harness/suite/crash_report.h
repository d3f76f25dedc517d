// The last event of a process that crashes: where the library crashed, and in which command of the GL.
#pragma once

#include <evalcts/results/event_file.h>

namespace evalcts {

// From now on a signal that stands for a crash writes the event Crashed before it does what it did. `events`
// must outlive the process's last crash. A library that handles these signals itself gets them instead.
void report_crashes(const EventFile& events);

}  // namespace evalcts
