// Reads numbers as the files write them (INTERPRETING.md, "Numbers").
#pragma once

#include <reference/rational.h>

#include <cstdlib>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// Reads a floating-point number, such as "0x1.8p-3" or "inf".
inline double number(const nlohmann::json& text) {
  return std::strtod(text.get_ref<const std::string&>().c_str(), nullptr);
}

// Reads a rational number, such as "-3/8".
inline reference::Rational rational(const nlohmann::json& fraction) {
  const auto& text = fraction.get_ref<const std::string&>();
  const std::size_t slash = text.find('/');
  return reference::Rational(reference::Integer(text.substr(0, slash)),
                             reference::Integer(text.substr(slash + 1)));
}

}  // namespace evalcts::vectors
