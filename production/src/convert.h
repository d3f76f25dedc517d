// Conversion of state to the type of a query (GL §2.2.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <glevaluator.h>

namespace glev {

// A double holds every value of state exactly: booleans, 32-bit integers, floats, doubles.
enum class StateKind {
  kNumber,     // to integers by rounding
  kNormalized  // RGBA components and normals: to integers by the linear map of 1 to the largest integer
};

// Returns the nearest int, halves away from zero. Values out of range saturate; NaN gives 0.
inline glev_int round_to_int(double value) {
  constexpr double kMost = std::numeric_limits<glev_int>::max(),
                   kLeast = std::numeric_limits<glev_int>::min();
  if (std::isnan(value)) return 0;
  if (value >= kMost) return std::numeric_limits<glev_int>::max();
  if (value <= kLeast) return std::numeric_limits<glev_int>::min();
  const auto whole = static_cast<glev_int>(value);
  const double rest = value - whole;  // exact; value + 0.5 would not be
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

inline void convert(double value, StateKind, glev_double* out) { *out = value; }

inline void convert(double value, StateKind, glev_float* out) {
  // "The nearest representable value": a finite number never becomes infinite.
  constexpr double kMost = std::numeric_limits<glev_float>::max();
  const bool too_large = std::isfinite(value) && std::fabs(value) > kMost;
  *out = static_cast<glev_float>(too_large ? std::copysign(kMost, value) : value);
}

inline void convert(double value, StateKind kind, glev_int* out) {
  if (kind == StateKind::kNormalized) {
    value = std::clamp(value, -1.0, 1.0) * std::numeric_limits<glev_int>::max();
  }
  *out = round_to_int(value);
}

inline void convert(double value, StateKind, glev_boolean* out) {
  *out = value != 0 ? GLEV_TRUE : GLEV_FALSE;
}

}  // namespace glev
