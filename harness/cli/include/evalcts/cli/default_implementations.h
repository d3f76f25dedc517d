// Determines the implementations that can be judged.
#pragma once

#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts::cli {

// Returns the reason why an implementation does not start; empty if it starts. Tries it in a worker,
// because GL libraries disturb each other in one process.
std::string why_not(const std::string& implementation);

// Throws CannotStart if the implementation is opened by a worker elsewhere that does not start, or that was
// built from other sources. `run` and `check` find that out by themselves.
void require_own_sources(const ImplementationOptions& implementation);

// Returns the implementations that `run` and `ulp` use by default. If OSMesa does not start, egl replaces it,
// and a message is printed to standard output.
std::vector<std::string> default_implementations();

}  // namespace evalcts::cli
