// Ends a worker whose job hangs. A worker elsewhere does so by itself, because nobody there sends it a
// signal.
#pragma once

#include <evalcts/results/event_file.h>

namespace evalcts {

// From now on, ends this process if a job runs and no event is written for `seconds`. It reports Hung, and
// the command in flight as in a crash. `events` must outlive the process. Called once, by the thread that
// runs the jobs.
void end_if_hanging(const EventFile& events, double seconds);

// Tells whether a job runs. Without a call, none does.
void set_working(bool is_working);

}  // namespace evalcts
