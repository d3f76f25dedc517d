// The request to stop, from a signal handler.
#pragma once

#include <atomic>

namespace evalcts {

// If set, runs stop and keep what was obtained with the status "interrupted".
inline std::atomic<bool> interrupted = false;

}  // namespace evalcts
