// Claims of a case by its theme and its requirements, checked on its exact value.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Why the case is not what its theme or a requirement says; empty if it is. `entry` has passed
// check_structure().
std::string broken_claim(const nlohmann::json& entry);

}  // namespace evalcts::vectors
