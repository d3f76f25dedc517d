// Converts numbers to and from JSON.
#include "numbers.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <evalcts/accuracy/table.h>
#include <evalcts/gl/hexadecimal.h>

namespace evalcts::accuracy {

using nlohmann::json;

json number_as_json(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json float_as_json(float value) { return {{"value", hexadecimal(value)}, {"bits", bits(value)}}; }

json hex_as_json(const std::vector<double>& values) {
  json all = json::array();
  for (const double value : values) all.push_back(hexadecimal(value));
  return all;
}

double number_from(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

float float_from(const json& value) {
  return std::bit_cast<float>(
      static_cast<std::uint32_t>(std::stoul(value.at("bits").get<std::string>(), nullptr, 16)));
}

// Uses strtod, because std::stod rejects subnormal numbers.
double hex_from(const json& value) {
  const auto text = value.get<std::string>();
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw std::invalid_argument("no number: " + text);
  return x;
}

std::vector<double> hex_list_from(const json& value) {
  std::vector<double> all;
  for (const json& item : value) all.push_back(hex_from(item));
  return all;
}

}  // namespace evalcts::accuracy
