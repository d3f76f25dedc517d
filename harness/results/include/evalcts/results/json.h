// Includes nlohmann-json for all files of the project. Comparisons between JSON values and strings do not
// compile, because whether the library accepts them depends on its version, the compiler and the order of the
// operands.
#pragma once

#include <concepts>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace evalcts {

template <class T>
concept Json = std::same_as<T, nlohmann::json> || std::same_as<T, nlohmann::ordered_json>;

// Types that are compared like a string.
template <class T>
concept Text = std::convertible_to<const T&, std::string_view> && !Json<T>;

// Returns the text of a JSON string, which lives as long as `value`; empty if `value` is not a string.
std::string_view as_text(const Json auto& value) {
  const auto* text = value.template get_ptr<const std::string*>();
  return text ? std::string_view(*text) : std::string_view();
}

// Parses a text with nlohmann's parser, which takes long to compile and is slow without optimization. The
// value is discarded (is_discarded()) if the text is no JSON.
nlohmann::json parse_json(std::string_view text);

}  // namespace evalcts

namespace nlohmann {

// Compare evalcts::as_text(value) with the string instead.
bool operator==(const evalcts::Json auto&, const evalcts::Text auto&) = delete;
bool operator==(const evalcts::Text auto&, const evalcts::Json auto&) = delete;
bool operator!=(const evalcts::Json auto&, const evalcts::Text auto&) = delete;
bool operator!=(const evalcts::Text auto&, const evalcts::Json auto&) = delete;

}  // namespace nlohmann
