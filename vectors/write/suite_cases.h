// Makes errors.json, get_map.json and state.json from the cases of the suite.
#pragma once

#include <string>
#include <vector>

#include <evalcts/vectors/write.h>
#include "document.h"

namespace evalcts::vectors {

// Makes a file of sequences, "errors", "get_map" or "state", from those of the cases that belong to it.
Document sequences(const std::string& kind, const std::string& description,
                   const std::vector<SuiteCase>& cases);

}  // namespace evalcts::vectors
