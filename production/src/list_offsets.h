// Reads the array of offsets of CallLists (GL §21.4).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <glevaluator.h>

namespace glev {

// Returns the bytes of one offset; 0 if the type is invalid.
inline std::size_t bytes_of_offset(glev_enum type) {
  switch (type) {
    case GLEV_BYTE:
    case GLEV_UNSIGNED_BYTE:
      return 1;
    case GLEV_SHORT:
    case GLEV_UNSIGNED_SHORT:
    case GLEV_2_BYTES:
      return 2;
    case GLEV_3_BYTES:
      return 3;
    case GLEV_INT:
    case GLEV_UNSIGNED_INT:
    case GLEV_FLOAT:
    case GLEV_4_BYTES:
      return 4;
    default:
      return 0;
  }
}

// The array need not be aligned.
template <class Value>
Value load_offset(const unsigned char* bytes) {
  Value value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Returns an offset modulo 2^32, because it is added to the list base.
inline glev_uint offset_at(glev_enum type, const unsigned char* bytes) {
  const auto big_endian = [bytes](int count) {
    glev_uint value = 0;
    for (int k = 0; k < count; ++k) value = value << 8 | bytes[k];
    return value;
  };
  switch (type) {
    case GLEV_BYTE:
      return static_cast<glev_uint>(load_offset<signed char>(bytes));
    case GLEV_UNSIGNED_BYTE:
      return *bytes;
    case GLEV_SHORT:
      return static_cast<glev_uint>(load_offset<std::int16_t>(bytes));
    case GLEV_UNSIGNED_SHORT:
      return load_offset<std::uint16_t>(bytes);
    case GLEV_2_BYTES:
      return big_endian(2);
    case GLEV_3_BYTES:
      return big_endian(3);
    case GLEV_4_BYTES:
      return big_endian(4);
    case GLEV_FLOAT: {
      const float whole = std::floor(load_offset<float>(bytes));
      const bool fits = whole > -0x1p63f && whole < 0x1p63f;  // false for NaN
      return fits ? static_cast<glev_uint>(static_cast<std::int64_t>(whole)) : 0;
    }
    default:  // INT, UNSIGNED_INT
      return load_offset<glev_uint>(bytes);
  }
}

}  // namespace glev
