// The text of a checkpoint, for those who have to make a damaged one.
#pragma once

#include <string>

#include <evalcts/results/json.h>

namespace evalcts::accuracy {

std::string with_checksum(nlohmann::json checkpoint);

}  // namespace evalcts::accuracy
