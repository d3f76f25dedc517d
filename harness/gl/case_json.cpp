// Converts cases to JSON and back, with tokens by name and numbers that read back exactly.
#include <evalcts/gl/case_json.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <evalcts/gl/tokens.h>
#include <evalcts/results/json.h>

namespace evalcts::gl {
namespace {

using nlohmann::json;

constexpr std::pair<Scalar, const char*> kTypes[] = {
    {Scalar::kU8, "u8"},   {Scalar::kI8, "i8"},   {Scalar::kI32, "i32"}, {Scalar::kU32, "u32"},
    {Scalar::kI64, "i64"}, {Scalar::kF32, "f32"}, {Scalar::kF64, "f64"}};

const char* name_of_type(Scalar type) {
  for (const auto& [of, name] : kTypes)
    if (of == type) return name;
  throw std::invalid_argument("no such type");
}

Scalar type_named(const std::string& name) {
  for (const auto& [type, of] : kTypes)
    if (name == of) return type;
  throw std::invalid_argument(fmt::format("'{}' is not a type of array elements", name));
}

constexpr std::pair<AfterCall, const char*> kAfterCalls[] = {
    {AfterCall::kOverwrite, "overwrite"}, {AfterCall::kUnmap, "unmap"}, {AfterCall::kProtect, "protect"}};

template <class Use>
auto with_type(Scalar type, Use use) {
  switch (type) {
    case Scalar::kU8:
      return use(std::uint8_t());
    case Scalar::kI8:
      return use(std::int8_t());
    case Scalar::kI32:
      return use(std::int32_t());
    case Scalar::kU32:
      return use(std::uint32_t());
    case Scalar::kI64:
      return use(std::int64_t());
    case Scalar::kF32:
      return use(float());
    default:
      return use(double());
  }
}

template <class Number>
json number_as_json(Number value, NonFinite non_finite) {
  if constexpr (std::is_floating_point_v<Number>) {
    if (std::isfinite(value)) return static_cast<double>(value);
    if (non_finite == NonFinite::kRejected) throw std::invalid_argument("a non-finite value");
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  } else {
    return value;
  }
}

// Returns a number, or a value that is not finite by its name. Throws std::invalid_argument for other data.
template <class Number>
Number number_from(const json& data) {
  if (data.is_number()) return data.get<Number>();
  if constexpr (std::is_floating_point_v<Number>)
    for (const auto& [name, value] : {std::pair{"nan", std::numeric_limits<Number>::quiet_NaN()},
                                      {"inf", std::numeric_limits<Number>::infinity()},
                                      {"-inf", -std::numeric_limits<Number>::infinity()}})
      if (as_text(data) == name) return value;
  throw std::invalid_argument(fmt::format("{} is not a number", data.dump()));
}

json values_as_json(const Input& input, NonFinite non_finite) {
  return with_type(input.type, [&](auto zero) {
    json values = json::array();
    for (std::size_t at = 0; at + sizeof zero <= input.bytes.size(); at += sizeof zero) {
      auto value = zero;
      std::memcpy(&value, input.bytes.data() + at, sizeof value);
      values.push_back(number_as_json(value, non_finite));
    }
    return values;
  });
}

json array_as_json(const Input& input, NonFinite non_finite) {
  json data = {{name_of_type(input.type), values_as_json(input, non_finite)}};
  for (const auto& [after, name] : kAfterCalls)
    if (input.after == after) data["after"] = name;
  if (input.slot >= 0) data["slot"] = input.slot;
  return data;
}

json argument_of(const Value& value, char kind, NonFinite non_finite) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    const auto token = static_cast<GLenum>(*integer);
    const std::string name = kind == 'm' ? primitive_name(token) : kind == 'e' ? token_name(token) : "";
    if (name.starts_with("GL_")) return name;
    return *integer;
  }
  if (const auto* single = std::get_if<float>(&value)) return number_as_json(*single, non_finite);
  if (const auto* real = std::get_if<double>(&value)) return number_as_json(*real, non_finite);
  if (const auto* input = std::get_if<Input>(&value)) return array_as_json(*input, non_finite);
  if (const auto* output = std::get_if<Output>(&value))
    return {{"out", name_of_type(output->type)}, {"count", output->count}};
  if (std::holds_alternative<std::nullptr_t>(value)) return nullptr;
  throw std::invalid_argument("a result of another command, or strings");
}

// Returns all tokens whose name does not depend on the context.
const std::map<std::string, GLenum>& tokens_by_name() {
  static const std::map<std::string, GLenum> kAll = [] {
    std::map<std::string, GLenum> map;
    for (GLenum token = 0xFFFF; token > 0; --token)
      if (const std::string name = token_name(token); name.starts_with("GL_")) map[name] = token;
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) map[primitive_name(mode)] = mode;
    return map;
  }();
  return kAll;
}

std::int64_t integer_from(const json& data) {
  if (data.is_string()) {
    const auto found = tokens_by_name().find(data.get<std::string>());
    if (found == tokens_by_name().end())
      throw std::invalid_argument(fmt::format("'{}' is not a known token", data.get<std::string>()));
    return found->second;
  }
  if (!data.is_number_integer())
    throw std::invalid_argument(fmt::format("{} is not an integer", data.dump()));
  return data.get<std::int64_t>();
}

// Upper limit of array sizes: more than any command writes, and not too much for memory.
constexpr std::size_t kMostWritten = std::size_t{1} << 24;

// Largest accepted slot. Tests use the numbers of targets as slots.
constexpr std::uint64_t kMostSlots = 0xFFFF;

Output output_from(const json& data) {
  const json count = data.value("count", json());
  if (!data["out"].is_string() || !count.is_number_unsigned() || count.get<std::uint64_t>() > kMostWritten)
    throw std::invalid_argument(fmt::format("{} is not a buffer for an answer", data.dump()));
  return {type_named(data["out"].get<std::string>()), count.get<std::size_t>()};
}

AfterCall after_call_from(const json& data) {
  for (const auto& [after, name] : kAfterCalls)
    if (as_text(data) == name) return after;
  throw std::invalid_argument(fmt::format("{} is not a treatment of an array after the call", data.dump()));
}

int slot_from(const json& data) {
  if (!data.is_number_unsigned() || data.get<std::uint64_t>() > kMostSlots)
    throw std::invalid_argument(fmt::format("{} is not a slot of an array", data.dump()));
  return data.get<int>();
}

Input input_from(json data) {
  const json after = data.value("after", json()), slot = data.value("slot", json());
  data.erase("after");
  data.erase("slot");
  if (data.size() != 1 || !data.begin()->is_array())
    throw std::invalid_argument(fmt::format("{} is not an array", data.dump()));
  Input input = with_type(type_named(data.begin().key()), [&](auto zero) {
    std::vector<decltype(zero)> values;
    for (const json& element : data.begin().value()) values.push_back(number_from<decltype(zero)>(element));
    return array(values);
  });
  if (!after.is_null()) input.after = after_call_from(after);
  if (!slot.is_null()) input.slot = slot_from(slot);
  // The next array of the slot is written into the same memory.
  if (input.slot >= 0 && (input.after == AfterCall::kUnmap || input.after == AfterCall::kProtect))
    throw std::invalid_argument("an array with a slot cannot be unmapped or protected");
  return input;
}

template <class Parameter>
Value value_from(const json& data) {
  if constexpr (std::is_pointer_v<Parameter>) {
    if (data.is_null()) return nullptr;
    if (!data.is_object()) throw std::invalid_argument(fmt::format("{} is not an array", data.dump()));
    if (data.contains("out")) return output_from(data);
    return input_from(data);
  } else if constexpr (std::is_floating_point_v<Parameter>) {
    return number_from<Parameter>(data);
  } else {
    return integer_from(data);
  }
}

template <class Result, class... Parameters>
std::vector<Value> arguments_from(Result (*)(Parameters...), const json& data) {
  if (data.size() != sizeof...(Parameters) + 1)
    throw std::invalid_argument(fmt::format("{} takes {} arguments", data[0].dump(), sizeof...(Parameters)));
  [[maybe_unused]] std::size_t i = 0;
  std::vector<Value> arguments;
  (arguments.push_back(value_from<Parameters>(data[++i])), ...);
  return arguments;
}

Command command_from(const json& data) {
  if (!data.is_array() || data.empty() || !data[0].is_string())
    throw std::invalid_argument(fmt::format("{} is not a command", data.dump()));
  const std::string name = data[0];
#define GL_ENTRY(entry, kinds) \
  if (name == #entry) return {EntryPoint::entry, arguments_from(decltype(Table::entry)(nullptr), data)};
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  throw std::invalid_argument(fmt::format("unknown command '{}'", name));
}

}  // namespace

json to_json(const Case& script, NonFinite non_finite) {
  json commands = json::array();
  for (const Command& command : script.commands()) {
    const std::string_view kinds = parameter_kinds(command.entry);
    json data = {std::string(name_of(command.entry).substr(2))};
    for (std::size_t i = 0; i < command.arguments.size(); ++i)
      data.push_back(argument_of(command.arguments[i], kinds[i], non_finite));
    commands.push_back(std::move(data));
  }
  return commands;
}

Case case_from_json(const json& commands) {
  if (!commands.is_array()) throw std::invalid_argument("the commands of a case must be an array");
  Case script;
  for (const json& command : commands) script.add(command_from(command));
  return script;
}

std::string to_text(const Case& script, NonFinite non_finite) { return to_json(script, non_finite).dump(); }

std::string to_text_if_possible(const Case& script) {
  try {
    return to_text(script);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

Case parse_case(const std::string& text) {
  const json data = parse_json(text);
  if (data.is_discarded()) throw std::invalid_argument("the program is not JSON");
  return case_from_json(data);
}

}  // namespace evalcts::gl
