// The structure of a file of vectors, member by member.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "vectors/lint/lint.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

// --- a small language of checks

[[noreturn]] void complain(const std::string& where, const std::string& what) {
  throw Malformed(fmt::format("{}: {}", where, what));
}

// The beginning of what is there, for messages.
std::string shown(const json& value) {
  std::string text = value.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

using Check = std::function<void(const json& value, const std::string& where)>;

struct Member {
  const char* name;
  Check check;
  bool is_optional = false;
};

// An object with these members and no others.
Check object(std::vector<Member> members) {
  return [members = std::move(members)](const json& value, const std::string& where) {
    if (!value.is_object()) complain(where, fmt::format("{} is no object", shown(value)));
    for (const auto& [name, check, is_optional] : members) {
      if (value.contains(name))
        check(value[name], fmt::format("{}/{}", where, name));
      else if (!is_optional)
        complain(where, fmt::format("there is no '{}'", name));
    }
    for (const auto& item : value.items())
      if (std::ranges::none_of(members, [&](const Member& member) { return item.key() == member.name; }))
        complain(where, fmt::format("'{}' has no place here", item.key()));
  };
}

Check list(Check check, std::size_t least, std::size_t most = SIZE_MAX) {
  return [=](const json& value, const std::string& where) {
    if (!value.is_array()) complain(where, fmt::format("{} is no list", shown(value)));
    if (value.size() < least || value.size() > most)
      complain(where, fmt::format("{} entries, {} are right", value.size(),
                                  least == most      ? fmt::format("{}", least)
                                  : most == SIZE_MAX ? fmt::format("{} and more", least)
                                                     : fmt::format("{} to {}", least, most)));
    for (std::size_t i = 0; i < value.size(); ++i) check(value[i], fmt::format("{}/{}", where, i));
  };
}

Check or_null(Check check) {
  return [=](const json& value, const std::string& where) {
    if (!value.is_null()) check(value, where);
  };
}

Check text(bool (*is_right)(std::string_view), const char* what) {
  return [=](const json& value, const std::string& where) {
    if (!value.is_string() || !is_right(value.get_ref<const std::string&>()))
      complain(where, fmt::format("{} is no {}", shown(value), what));
  };
}

Check one_of(std::vector<std::string> names) {
  return [names = std::move(names)](const json& value, const std::string& where) {
    if (!value.is_string() || std::ranges::find(names, value.get<std::string>()) == names.end())
      complain(where, fmt::format("{} is none of the names that belong here", shown(value)));
  };
}

Check integer(std::int64_t least, std::int64_t most) {
  return [=](const json& value, const std::string& where) {
    if (!value.is_number_integer() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
      complain(where, fmt::format("{} is no integer from {} to {}", shown(value), least, most));
  };
}

Check boolean() {
  return [](const json& value, const std::string& where) {
    if (!value.is_boolean()) complain(where, fmt::format("{} is neither true nor false", shown(value)));
  };
}

// --- numbers and names

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_whole(std::string_view digits) {
  return !digits.empty() && digits.front() != '0' && std::ranges::all_of(digits, is_digit);
}

bool is_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text == "0x0p+0") return true;
  if (!text.starts_with("0x1")) return false;
  text.remove_prefix(3);
  const std::size_t p = text.find('p');
  if (p == std::string_view::npos) return false;
  const std::string_view digits = text.substr(0, p), exponent = text.substr(p + 1);
  const auto is_hexadecimal = [](char c) { return is_digit(c) || (c >= 'a' && c <= 'f'); };
  if (!digits.empty() && (digits.size() < 2 || digits.front() != '.' || digits.back() == '0' ||
                          !std::ranges::all_of(digits.substr(1), is_hexadecimal)))
    return false;
  if (exponent == "+0") return true;
  return (exponent.starts_with('+') || exponent.starts_with('-')) && is_whole(exponent.substr(1));
}

bool is_rounded(std::string_view text) { return text == "inf" || text == "-inf" || is_number(text); }

bool is_rational(std::string_view text) {
  if (text == "0/1") return true;
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return false;
  std::string_view numerator = text.substr(0, slash);
  if (numerator.starts_with('-')) numerator.remove_prefix(1);
  return is_whole(numerator) && is_whole(text.substr(slash + 1));
}

bool is_flag(std::string_view text) {
  const auto is_letter = [](char c) {
    return is_digit(c) || c == '-' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  return !text.empty() && text.front() != '-' && std::ranges::all_of(text, is_letter);
}

bool is_id(std::string_view text) {
  const std::size_t first = text.find('.'), last = text.rfind('.');
  return first != std::string_view::npos && first < last &&
         is_flag(text.substr(first + 1, last - first - 1)) && is_whole(text.substr(last + 1));
}

bool is_requirement(std::string_view text) { return text.starts_with("EV-"); }
bool is_words(std::string_view text) { return !text.empty(); }

const Check& number() {
  static const Check check = text(is_number, "hexadecimal number");
  return check;
}
const Check& rational() {
  static const Check check = text(is_rational, "rational number");
  return check;
}
const Check& rounded() {
  static const Check check = text(is_rounded, "hexadecimal number or infinity");
  return check;
}

constexpr std::int64_t kLeastInt = INT32_MIN, kMostInt = INT32_MAX;
constexpr std::size_t kMostOrder = 64;

// --- the parts of cases

Check interval() { return or_null(list(number(), 2, 2)); }

Check value() {
  return object({{"exact", rational()},
                 {"magnitude", rational()},
                 {"float", rounded()},
                 {"double", rounded()},
                 {"accept", interval()}});
}

Check quotient() {
  return object({{"exact", rational()}, {"float", rounded()}, {"double", rounded()}, {"accept", interval()}});
}

Check grid_point() {
  return object({{"segments", integer(1, kMostInt)},
                 {"first", number()},
                 {"last", number()},
                 {"index", integer(kLeastInt, kMostInt)},
                 {"exact", rational()}});
}

// A number, or something that is an object or a list.
Check number_or(const Check& other) {
  return [=](const json& value, const std::string& where) {
    if (value.is_string())
      number()(value, where);
    else
      other(value, where);
  };
}

// The number of components of each target, by the name without its dimension.
std::size_t components_of(const std::string& target) {
  static const std::map<std::string, std::size_t> table = {
      {"COLOR_4", 4},         {"INDEX", 1},           {"NORMAL", 3},
      {"TEXTURE_COORD_1", 1}, {"TEXTURE_COORD_2", 2}, {"TEXTURE_COORD_3", 3},
      {"TEXTURE_COORD_4", 4}, {"VERTEX_3", 3},        {"VERTEX_4", 4}};
  const std::size_t prefix = std::string_view("GL_MAP1_").size();
  const auto found = target.size() > prefix ? table.find(target.substr(prefix)) : table.end();
  return found == table.end() ? 0 : found->second;
}

void check_map(const json& map, const std::string& where, int dimension) {
  const auto is_target = [=](const json& target, const std::string& place) {
    if (!target.is_string() ||
        !target.get<std::string>().starts_with(dimension == 1 ? "GL_MAP1_" : "GL_MAP2_") ||
        components_of(target) == 0)
      complain(place, fmt::format("{} is no target of this dimension", shown(target)));
  };
  const std::size_t ends = dimension == 1 ? 2 : 4;
  if (!map.is_object() || !map.contains("target")) complain(where, "no map with a target");
  is_target(map["target"], where + "/target");
  const std::size_t k = components_of(map["target"]);
  Check points = list(list(number(), k, k), 1, kMostOrder);
  if (dimension == 2) points = list(points, 1, kMostOrder);
  object({{"target", is_target},
          {"type", one_of({"f", "d"})},
          {"domain", list(number(), ends, ends)},
          {"points", points}})(map, where);
  if (dimension == 1) return;
  for (const json& row : map["points"])
    if (row.size() != map["points"][0].size()) complain(where + "/points", "rows of different length");
}

Check map_of(int dimension) {
  return [=](const json& value, const std::string& where) { check_map(value, where, dimension); };
}

Check unit_normal() {
  return or_null(
      list(object({{"enclosure", list(rational(), 2, 2)}, {"float", number()}, {"double", number()}}), 3, 3));
}
Check accepted_normal() { return or_null(object({{"bound", number()}, {"either_sign", boolean()}})); }

// What every case has, and its own members.
Check case_with(std::vector<Member> members) {
  std::vector<Member> all = {{"id", text(is_id, "id")},
                             {"requirements", list(text(is_requirement, "requirement"), 1)},
                             {"flags", list(text(is_flag, "flag"), 1)}};
  all.insert(all.end(), members.begin(), members.end());
  return object(std::move(all));
}

// As many entries as the target has components.
void check_components(const json& entry, const std::string& where, const char* member) {
  const std::size_t k = components_of(entry["map"]["target"]);
  if (entry[member].size() != k)
    complain(where, fmt::format("'{}' has {} entries for {} components", member, entry[member].size(), k));
}

Check value_case(int dimension, const Check& argument, const Check& intermediate) {
  std::vector<Member> members = {{"map", map_of(dimension)}, {"u", argument}};
  if (dimension == 2) members.push_back({"v", argument});
  members.push_back({"components", list(value(), 1, 4)});
  members.push_back({"quotients", list(quotient(), 3, 3), true});
  if (intermediate) members.push_back({"intermediate", intermediate, true});
  return [check = case_with(std::move(members))](const json& entry, const std::string& where) {
    check(entry, where);
    check_components(entry, where, "components");
    if (entry.contains("quotients") && !entry["map"]["target"].get<std::string>().ends_with("VERTEX_4"))
      complain(where, "quotients without w");
  };
}

Check intermediate(int dimension) {
  const Check values = list(rational(), 1, kMostOrder);
  if (dimension == 1)
    return object({{"uh", rational()}, {"basis_u", values}, {"de_casteljau", list(values, 1, kMostOrder)}});
  return object({{"uh", rational()}, {"vh", rational()}, {"basis_u", values}, {"basis_v", values}});
}

Check grid_case() {
  const Check one = value_case(1, grid_point(), {}), two = value_case(2, grid_point(), {});
  return
      [=](const json& entry, const std::string& where) { (entry.contains("v") ? two : one)(entry, where); };
}

Check normal_case() {
  const Check derivatives = list(rational(), 3, 4), argument = number_or(grid_point());
  const Check check = case_with({{"map", map_of(2)},
                                 {"u", argument},
                                 {"v", argument},
                                 {"derivatives", object({{"u", derivatives}, {"v", derivatives}})},
                                 {"m", or_null(list(rational(), 3, 3))},
                                 {"normal", unit_normal()},
                                 {"accept", accepted_normal()}});
  return [=](const json& entry, const std::string& where) {
    check(entry, where);
    for (const char* direction : {"u", "v"})
      if (entry["derivatives"][direction].size() != components_of(entry["map"]["target"]))
        complain(where, "as many derivatives as components are right");
    if (entry["m"].is_null() && !entry["normal"].is_null()) complain(where, "a normal without m");
  };
}

// --- sequences

void check_argument(const json& value, const std::string& where) {
  const auto is_name = [](std::string_view name) {
    return name.starts_with("GL_") && std::ranges::all_of(name, [](char c) {
             return is_digit(c) || c == '_' || c == '|' || (c >= 'A' && c <= 'Z');
           });
  };
  if (value.is_number_integer()) return;
  if (value.is_string()) {
    if (!is_name(value.get<std::string>())) number()(value, where);
    return;
  }
  if (!value.is_object() || value.empty()) complain(where, fmt::format("{} is no argument", shown(value)));
  if (value.contains("out")) {
    object({{"out", one_of({"f32", "f64", "i32", "u32", "u8"})}, {"count", integer(1, kMostInt)}})(value,
                                                                                                   where);
    return;
  }
  const std::string type = value.begin().key();
  const bool is_real = type == "f32" || type == "f64";
  if (!is_real) one_of({"i32", "u32", "u8"})(type, where);
  object({{type.c_str(), list(is_real ? number() : integer(kLeastInt, UINT32_MAX), 0)}})(value, where);
}

void check_call(const json& value, const std::string& where) {
  const auto is_command = [](std::string_view name) {
    return !name.empty() && name.front() >= 'A' && name.front() <= 'Z';
  };
  if (!value.is_array() || value.empty()) complain(where, fmt::format("{} is no call", shown(value)));
  text(is_command, "command")(value[0], where + "/0");
  for (std::size_t i = 1; i < value.size(); ++i) check_argument(value[i], fmt::format("{}/{}", where, i));
}

Check vertex() {
  const Check component = number_or(value());
  const Check three = list(component, 3, 3), four = list(component, 4, 4);
  return object({{"position", four},
                 {"color", four, true},
                 {"normal", three, true},
                 {"automatic_normal",
                  object({{"m", or_null(list(rational(), 3, 3))},
                          {"normal", unit_normal()},
                          {"accept", accepted_normal()}}),
                  true},
                 {"texture_coordinates", list(four, 1, 8), true}});
}

Check step() {
  const Check answer = [](const json& entry, const std::string& where) {
    if (!entry.is_number_integer()) number()(entry, where);
  };
  const std::vector<std::string> modes = {
      "GL_POINTS",         "GL_LINES",        "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES",
      "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS",     "GL_QUAD_STRIP", "GL_POLYGON"};
  const Check primitive = object({{"mode", one_of(modes)}, {"vertices", list(vertex(), 1)}});
  return object({{"call", check_call},
                 {"errors",
                  list(one_of({"GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION",
                               "GL_STACK_OVERFLOW", "GL_STACK_UNDERFLOW"}),
                       0),
                  true},
                 {"answers", list(list(answer, 1, 3), 0), true},
                 {"emits", list(primitive, 0), true}});
}

Check sequence_case() { return case_with({{"steps", list(step(), 1)}}); }

const std::map<std::string, Check>& checks_of_cases() {
  static const std::map<std::string, Check> checks = {{"map1_eval", value_case(1, number(), intermediate(1))},
                                                      {"map2_eval", value_case(2, number(), intermediate(2))},
                                                      {"grid", grid_case()},
                                                      {"auto_normal", normal_case()},
                                                      {"errors", sequence_case()},
                                                      {"get_map", sequence_case()},
                                                      {"state", sequence_case()}};
  return checks;
}

}  // namespace

void check_structure(const json& file) {
  if (!file.is_object() || !file.contains("kind") || !file["kind"].is_string())
    complain("file", "no object with a 'kind'");
  const auto check = checks_of_cases().find(file["kind"]);
  if (check == checks_of_cases().end())
    complain("kind", fmt::format("{} is no kind of vectors", shown(file["kind"])));
  const Check notes = [](const json& value, const std::string& where) {
    if (!value.is_object()) complain(where, "the notes are no object");
    for (const auto& note : value.items()) text(is_words, "note")(note.value(), where + "/" + note.key());
  };
  const Check cases = [&](const json& value, const std::string& where) {
    if (!value.is_array() || value.empty()) complain(where, "there are no cases");
    for (std::size_t i = 0; i < value.size(); ++i) {
      const bool has_id = value[i].is_object() && value[i].contains("id") && value[i]["id"].is_string();
      check->second(value[i], has_id ? value[i]["id"].get<std::string>() : fmt::format("case {}", i + 1));
    }
  };
  object({{"format", one_of({"evalcts-vectors-1"})},
          {"kind", text(is_words, "kind")},
          {"description", text(is_words, "description")},
          {"notes", notes},
          {"cases", cases}})(file, "file");
}

}  // namespace evalcts::vectors
