// Writes the text of a checkpoint. Tests use this function to make damaged files with a valid checksum.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::accuracy {

std::string with_checksum(nlohmann::json checkpoint);

}  // namespace evalcts::accuracy
