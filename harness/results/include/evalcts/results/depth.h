// Depth of a run: how many values and variants of each test are run.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace evalcts {

enum class Depth { kQuick, kFull, kThorough };

inline constexpr std::array kDepthNames{"quick", "full", "thorough"};

constexpr const char* name_of(Depth depth) { return kDepthNames[static_cast<std::size_t>(depth)]; }

constexpr std::optional<Depth> depth_named(std::string_view name) {
  for (std::size_t i = 0; i < kDepthNames.size(); ++i)
    if (name == kDepthNames[i]) return static_cast<Depth>(i);
  return std::nullopt;
}

}  // namespace evalcts
