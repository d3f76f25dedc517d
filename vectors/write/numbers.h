// Reads numbers as the files write them (INTERPRETING.md, "Numbers").
#pragma once

#include <reference/rational.h>

#include <cstdlib>
#include <stdexcept>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Reads a floating-point number, such as "0x1.8p-3" or "inf". Throws std::exception if the text is not a
// number.
inline double number(const nlohmann::json& text) {
  const auto& word = text.get_ref<const std::string&>();
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0') throw std::invalid_argument("'" + word + "' is not a number");
  return value;
}

// Reads a rational number, such as "-3/8".
inline reference::Rational rational(const nlohmann::json& fraction) {
  const auto& text = fraction.get_ref<const std::string&>();
  const std::size_t slash = text.find('/');
  return reference::Rational(reference::Integer(text.substr(0, slash)),
                             reference::Integer(text.substr(slash + 1)));
}

}  // namespace evalcts::vectors
