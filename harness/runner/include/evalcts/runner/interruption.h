// The flag by which a signal handler asks runs to stop.
#pragma once

#include <atomic>

namespace evalcts {

// If set, runs stop and keep the results so far, with the status "interrupted".
inline std::atomic<bool> interrupted = false;

}  // namespace evalcts
