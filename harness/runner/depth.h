// How much a run plays.
#pragma once

#include <string_view>

namespace evalcts {

enum class Depth { quick, full, thorough };

constexpr const char* name_of(Depth depth) {
  return depth == Depth::quick ? "quick" : depth == Depth::full ? "full" : "thorough";
}
// The inverse; full for anything else.
constexpr Depth depth_named(std::string_view name) {
  return name == "quick" ? Depth::quick : name == "thorough" ? Depth::thorough : Depth::full;
}

}  // namespace evalcts
