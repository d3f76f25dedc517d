// All vectors, byte for byte the same whenever and wherever they are made.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace evalcts::vectors {

// "map1_eval", "map2_eval", "grid", "auto_normal", "errors", "get_map", "state".
const std::vector<std::string>& kinds();

// The text of the file of that kind. Throws std::invalid_argument for another name.
std::string text_of(const std::string& kind);

// Writes KIND.json for all kinds, each whole or not at all, and calls `wrote` after each with its name, cases
// and bytes. Throws std::runtime_error where one cannot be written.
struct Written {
  std::string kind;
  std::size_t cases, bytes;
};
void write_all(const std::filesystem::path& folder, const std::function<void(const Written&)>& wrote);

}  // namespace evalcts::vectors
