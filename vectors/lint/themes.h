// Themes that are what they say.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Returns the theme of a case that asks for a value or a normal if the case is not what the theme claims;
// empty if it is, or if the claim is not one about exact values.
std::string broken_theme(const nlohmann::json& entry);

}  // namespace evalcts::vectors
