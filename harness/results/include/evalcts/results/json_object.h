// Reads a JSON object field by field, with error messages that name the field. Used only by the files that
// read formats.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/results/json.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/text.h>

namespace evalcts {

// If a field is missing or null, the functions return an empty or false value, or none. They throw
// FormatError if it has another type.
class JsonObject {
 public:
  JsonObject(const nlohmann::json& value, std::string path) : value_(value), path_(std::move(path)) {
    if (!value.is_object()) fail(path_.empty() ? "the record" : path_, "an object", value);
  }

  std::string path(const std::string& key) const {
    return path_.empty() ? key : fmt::format("{}.{}", path_, key);
  }

  bool has(const std::string& key) const { return find(key) != nullptr; }

  std::string text(const std::string& key) const {
    const auto* value = find(key);
    return value ? text(*value, path(key)) : std::string();
  }

  // Returns any value as JSON text in ASCII; empty if the field is empty.
  std::string json_text(const std::string& key) const {
    const auto* value = find(key);
    return value ? value->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) : std::string();
  }

  // Returns parse(text), an optional; none if the field is empty. Throws FormatError if `parse` returns none.
  template <class Parse>
  auto word(const std::string& key, Parse parse) const -> decltype(parse(std::string())) {
    const std::string found = text(key);
    if (found.empty()) return {};
    auto value = parse(found);
    if (!value) throw FormatError(fmt::format("{}: unknown word \"{}\"", path(key), found));
    return value;
  }

  bool boolean(const std::string& key) const {
    const auto* value = find(key);
    if (value && !value->is_boolean()) fail(path(key), "a boolean", *value);
    return value && value->get<bool>();
  }

  // Returns a number that may be infinite, which JSON stores as null; none if the field is missing.
  std::optional<double> distance(const std::string& key) const {
    const auto found = value_.find(key);
    if (found != value_.end() && found->is_null()) return std::numeric_limits<double>::infinity();
    return real(key);
  }

  std::optional<double> real(const std::string& key) const {
    const auto* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number()) fail(path(key), "a number", *value);
    return value->get<double>();
  }

  std::optional<std::int64_t> integer(const std::string& key) const {
    const auto* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number_integer()) fail(path(key), "an integer", *value);
    return value->get<std::int64_t>();
  }

  std::optional<std::uint64_t> natural(const std::string& key) const {
    const auto* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number_integer() || (!value->is_number_unsigned() && value->get<std::int64_t>() < 0))
      fail(path(key), "a non-negative integer", *value);
    return value->get<std::uint64_t>();
  }

  // Returns the object in the field; none if the field is empty.
  std::optional<JsonObject> object(const std::string& key) const {
    const auto* value = find(key);
    if (!value) return std::nullopt;
    return JsonObject(*value, path(key));
  }

  std::vector<std::string> texts(const std::string& key) const {
    std::vector<std::string> out;
    each(key, [&](const auto& item, const std::string& where) { out.push_back(text(item, where)); });
    return out;
  }

  // Returns an array of numbers. Null, which JSON stores for infinities and NaN, becomes NaN.
  std::vector<double> reals(const std::string& key) const {
    std::vector<double> out;
    each(key, [&](const auto& item, const std::string& where) {
      if (!item.is_null() && !item.is_number()) fail(where, "a number", item);
      out.push_back(item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.template get<double>());
    });
    return out;
  }

  // Calls use(element, its path) for each element of an array.
  template <class Use>
  void each(const std::string& key, Use use) const {
    const auto* value = find(key);
    if (!value) return;
    if (!value->is_array()) fail(path(key), "an array", *value);
    for (std::size_t i = 0; i < value->size(); ++i) use((*value)[i], fmt::format("{}[{}]", path(key), i));
  }

  // Calls use(object) for each element of an array of objects.
  template <class Use>
  void each_object(const std::string& key, Use use) const {
    each(key, [&](const auto& item, const std::string& where) { use(JsonObject(item, where)); });
  }

  // Calls use(name, clean name) for each field; see text.h for the latter.
  template <class Use>
  void each_key(Use use) const {
    for (const auto& item : value_.items()) use(item.key(), clean(item.key()));
  }

  const std::string& place() const { return path_; }

 private:
  [[noreturn]] static void fail(const std::string& where, const char* expected, const nlohmann::json& found) {
    throw FormatError(fmt::format("{}: expected {}, found {} {}", where, expected,
                                  found.is_array() || found.is_object() ? "an" : "a", found.type_name()));
  }

  static std::string text(const nlohmann::json& value, const std::string& where) {
    if (!value.is_string()) fail(where, "a string", value);
    return clean(value.get_ref<const std::string&>());
  }

  const nlohmann::json* find(const std::string& key) const {
    const auto it = value_.find(key);
    return it == value_.end() || it->is_null() ? nullptr : &*it;
  }

  const nlohmann::json& value_;
  std::string path_;
};

}  // namespace evalcts
