// Derives the roles of entry points from their names.
#include <evalcts/gl/roles.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <evalcts/gl/tokens.h>

namespace evalcts::gl {
namespace {

struct Properties {
  Role role = Role::kOther;
  std::string stem;
};

// The stems of the roles that have several forms. A form is digits and letters: "3fv". The first stem that
// fits is the one of the command.
struct Row {
  std::string_view stem;
  Role role;
};
constexpr Row kRows[] = {{"MapGrid1", Role::kMapGrid},
                         {"MapGrid2", Role::kMapGrid},
                         {"Map1", Role::kMap},
                         {"Map2", Role::kMap},
                         {"EvalCoord1", Role::kEvalCoord},
                         {"EvalCoord2", Role::kEvalCoord},
                         {"EvalPoint1", Role::kEvalPoint},
                         {"EvalPoint2", Role::kEvalPoint},
                         {"EvalMesh1", Role::kEvalMesh},
                         {"EvalMesh2", Role::kEvalMesh},
                         {"GetMap", Role::kGetMap},
                         {"GetnMap", Role::kGetMap},
                         {"Vertex", Role::kVertex},
                         {"Color", Role::kCurrentValue},
                         {"Normal", Role::kCurrentValue},
                         {"TexCoord", Role::kCurrentValue},
                         {"MultiTexCoord", Role::kCurrentValue},
                         {"Index", Role::kCurrentValue},
                         {"EdgeFlag", Role::kCurrentValue}};
constexpr std::string_view kGets[] = {"GetBooleanv", "GetIntegerv", "GetFloatv", "GetDoublev"};

bool is_form(std::string_view rest) {
  return rest.size() <= 3 && std::ranges::all_of(rest, [](unsigned char c) {
           return std::isdigit(c) || c == 'f' || c == 'd' || c == 'i' || c == 'v';
         });
}

Properties properties_from(std::string_view name) {
  if (std::ranges::count(kGets, name) > 0) return {Role::kGet, "Get"};
  for (const Row& row : kRows)
    if (name.starts_with(row.stem) && is_form(name.substr(row.stem.size())))
      return {row.role, std::string(row.stem)};
  return {Role::kOther, std::string(name)};
}

const Properties& properties_of(EntryPoint entry) {
  static const std::array<Properties, kEntryPointCount> kAll = [] {
    std::array<Properties, kEntryPointCount> all;
    for (std::size_t i = 0; i < kEntryPointCount; ++i)
      all[i] = properties_from(name_of(static_cast<EntryPoint>(i)).substr(2));
    return all;
  }();
  return kAll[static_cast<std::size_t>(entry)];
}

}  // namespace

Role role_of(EntryPoint entry) { return properties_of(entry).role; }

bool is_evaluation(EntryPoint entry) {
  const Role role = role_of(entry);
  return role == Role::kEvalCoord || role == Role::kEvalPoint || role == Role::kEvalMesh;
}

bool emits_vertex(EntryPoint entry) {
  const Role role = role_of(entry);
  return role == Role::kEvalCoord || role == Role::kEvalPoint || role == Role::kVertex;
}

bool asks(EntryPoint entry) {
  const std::string_view name = name_of(entry);
  return name.starts_with("glGet") || name.starts_with("glIs");
}

std::string stem_of(EntryPoint entry) { return properties_of(entry).stem; }

std::string stem_without_dimension(EntryPoint entry) {
  std::string stem = stem_of(entry);
  if (dimension_of(entry) != 0) stem.pop_back();
  return stem;
}

int dimension_of(EntryPoint entry) {
  const char last = stem_of(entry).back();
  const bool is_of_evaluators =
      is_evaluation(entry) || role_of(entry) == Role::kMap || role_of(entry) == Role::kMapGrid;
  return is_of_evaluators ? last - '0' : 0;
}

std::string broken_map_rules(const Command& command, int max_order) {
  const auto target = static_cast<GLenum>(integer_of(command, 0));
  const int dimension = dimension_of(command.entry);
  if (role_of(command.entry) != Role::kMap || components_of(target) == 0) return {};
  const std::size_t domains[] = {1, 5}, strides[] = {3, 7}, orders[] = {4, 8};
  const auto real = [&](std::size_t i) {
    const auto* const single = std::get_if<float>(&command.arguments[i]);
    return single ? static_cast<double>(*single) : std::get<double>(command.arguments[i]);
  };
  const auto breaks = [&](const std::size_t(&places)[2], const auto& is_broken) {
    return std::any_of(places, places + dimension, is_broken);
  };
  const std::pair<const char*, bool> rules[] = {
      {"equal ends", breaks(domains, [&](std::size_t i) { return real(i) == real(i + 1); })},
      {"stride too small",
       breaks(strides, [&](std::size_t i) { return integer_of(command, i) < components_of(target); })},
      {"order below 1", breaks(orders, [&](std::size_t i) { return integer_of(command, i) < 1; })},
      {"order too high", breaks(orders, [&](std::size_t i) { return integer_of(command, i) > max_order; })}};
  std::string broken;
  for (const auto& [rule, is_broken] : rules)
    if (is_broken) broken += (broken.empty() ? "" : ", ") + std::string(rule);
  return broken;
}

std::int64_t integer_of(const Command& command, std::size_t argument) {
  const auto* const value =
      command.arguments.size() > argument ? std::get_if<std::int64_t>(&command.arguments[argument]) : nullptr;
  return value ? *value : 0;
}

}  // namespace evalcts::gl
