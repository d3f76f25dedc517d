// The nine kinds of map (GL table 21.1), the same for both dimensions.
#pragma once

#include <array>

#include <glevaluator.h>

namespace glev {

inline constexpr int kMaxOrder = 64;
inline constexpr int kSlots = 9;

// The attributes that the maps of a plan produce. INDEX maps are missing, because RGBA mode ignores them.
enum class Attribute { kVertex, kColor, kNormal, kTexcoord };
inline constexpr int kAttributes = 4;

struct Slot {
  int components;
  std::array<double, 4> initial;  // control point of the initial map
};

// The slots in the order of the tokens. Within an attribute, later slots have precedence over earlier ones
// (GL §21.1).
inline constexpr std::array<Slot, kSlots> kSlotTable = {{
    {4, {1, 1, 1, 1}},  // COLOR_4
    {1, {1}},           // INDEX
    {3, {0, 0, 1}},     // NORMAL
    {1, {0}},           // TEXTURE_COORD_1
    {2, {0, 0}},        // TEXTURE_COORD_2
    {3, {0, 0, 0}},     // TEXTURE_COORD_3
    {4, {0, 0, 0, 1}},  // TEXTURE_COORD_4
    {3, {0, 0, 0}},     // VERTEX_3
    {4, {0, 0, 0, 1}},  // VERTEX_4
}};

struct SlotRange {
  int first, last;
};

inline constexpr SlotRange slots_of(Attribute attribute) {
  constexpr std::array<SlotRange, kAttributes> kRanges = {{{7, 8}, {0, 0}, {2, 2}, {3, 6}}};
  return kRanges[static_cast<std::size_t>(attribute)];
}

// A map name: dimension 1 or 2 and slot; dimension 0 if the token is not one of the 18.
struct Target {
  int dimension = 0;
  int slot = 0;
  explicit operator bool() const { return dimension != 0; }
};

inline constexpr Target find_target(glev_enum name) {
  if (name >= GLEV_MAP1_COLOR_4 && name <= GLEV_MAP1_VERTEX_4)
    return {1, static_cast<int>(name - GLEV_MAP1_COLOR_4)};
  if (name >= GLEV_MAP2_COLOR_4 && name <= GLEV_MAP2_VERTEX_4)
    return {2, static_cast<int>(name - GLEV_MAP2_COLOR_4)};
  return {};
}

}  // namespace glev
