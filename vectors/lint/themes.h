// Checks that the cases of a theme have the property that its name claims.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Returns the theme of a case if the case does not have its property, otherwise an empty string; also if
// there is no check for the theme. `entry` asks for a value or a normal.
std::string broken_theme(const nlohmann::json& entry);

}  // namespace evalcts::vectors
