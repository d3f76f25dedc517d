// The enabled maps, and the attributes that they generate.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "gl_below.h"

namespace glev::dropin {

// The bits of Context::enabled: nine maps of each dimension, in the order of their tokens, and AUTO_NORMAL.
inline constexpr int kColorMap = 0, kNormalMap = 2, kFirstTextureMap = 3, kLastTextureMap = 6,
                     kVertex3Map = 7, kVertex4Map = 8, kMaps = 9;
inline constexpr std::uint32_t kAutoNormal = 1u << (2 * kMaps);

constexpr std::uint32_t enable_bit(int dimension, int map) { return 1u << (map + (dimension - 1) * kMaps); }
constexpr std::uint32_t both_enable_bits(int map) { return enable_bit(1, map) | enable_bit(2, map); }

inline GLenum cap_of(int bit) {
  if (bit == 2 * kMaps) return GL_AUTO_NORMAL;
  return static_cast<GLenum>(bit < kMaps ? GL_MAP1_COLOR_4 + bit : GL_MAP2_COLOR_4 + bit - kMaps);
}

// The attributes that the enabled maps of a dimension generate. `texture` and `vertex` are numbers of
// components, 0 for none.
struct GeneratedAttributes {
  bool color, normal;
  int texture, vertex;
};

inline GeneratedAttributes generated_by(std::uint32_t enabled, int dimension) {
  GeneratedAttributes generated = {};
  generated.color = (enabled & enable_bit(dimension, kColorMap)) != 0;
  generated.normal =
      (enabled & enable_bit(dimension, kNormalMap)) != 0 || (dimension == 2 && (enabled & kAutoNormal) != 0);
  for (int map = kFirstTextureMap; map <= kLastTextureMap; ++map)
    if ((enabled & enable_bit(dimension, map)) != 0) generated.texture = map - kFirstTextureMap + 1;
  for (const int map : {kVertex3Map, kVertex4Map})
    if ((enabled & enable_bit(dimension, map)) != 0) generated.vertex = map - kVertex3Map + 3;
  return generated;
}

}  // namespace glev::dropin
