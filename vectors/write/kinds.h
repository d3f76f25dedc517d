// The functions that make the seven files.
#pragma once

#include <string>
#include <vector>

#include <evalcts/vectors/write.h>
#include "document.h"

namespace evalcts::vectors {

Document map1_eval();
Document map2_eval();
Document grid();
Document auto_normal();
// Makes a file of sequences, "errors", "get_map" or "state", from those of the cases that belong to it.
Document sequences(const std::string& kind, const std::string& description,
                   const std::vector<SuiteCase>& cases);

}  // namespace evalcts::vectors
