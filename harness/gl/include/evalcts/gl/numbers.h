// Reads and writes the real numbers among the arguments of a command, independent of their type.
#pragma once

#include <stdexcept>
#include <variant>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Returns a float or double argument. Throws std::bad_variant_access for any other argument.
inline double number(const Value& value) {
  if (const auto* single = std::get_if<float>(&value)) return *single;
  return std::get<double>(value);
}

// Returns the value as a double argument, or rounded to a float argument.
inline Value real(double value, bool as_double) {
  if (as_double) return value;
  return static_cast<float>(value);
}

// Returns the elements of an array of floats or doubles.
inline std::vector<double> elements(const Input& input) {
  std::vector<double> values(input.bytes.size() / size_of(input.type));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::byte* const bytes = input.bytes.data() + i * size_of(input.type);
    if (input.type == Scalar::kF32) {
      float single = 0;
      std::memcpy(&single, bytes, sizeof single);
      values[i] = single;
    } else {
      std::memcpy(&values[i], bytes, sizeof values[i]);
    }
  }
  return values;
}

// Returns a client array of doubles, or of floats.
inline Input reals(const std::vector<double>& values, bool as_double) {
  return as_double ? array(values) : array(std::vector<float>(values.begin(), values.end()));
}

// Converts the array to floats or doubles and keeps its other properties.
inline Input reals(const Input& input, bool as_double) {
  Input converted = reals(elements(input), as_double);
  converted.after = input.after;
  converted.slot = input.slot;
  return converted;
}

}  // namespace evalcts::gl
