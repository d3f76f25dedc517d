// Checks on its exact values that a case has the property that its theme or its requirements claim.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Returns a message about a claim that does not hold, or an empty string if all hold. `entry` has passed
// check_structure().
std::string broken_claim(const nlohmann::json& entry);

}  // namespace evalcts::vectors
