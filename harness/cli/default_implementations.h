// Implementations that can be judged on this machine.
#pragma once

#include <string>
#include <vector>

namespace evalcts::cli {

// Why an implementation does not start; empty where it does. Asked in a child: libraries do not share a
// process well.
std::string why_not(const std::string& implementation);

// The implementations that `run` and `ulp` use unless told otherwise. If OSMesa does not start, egl takes its
// place, and a line on standard output says so.
std::vector<std::string> default_implementations();

}  // namespace evalcts::cli
