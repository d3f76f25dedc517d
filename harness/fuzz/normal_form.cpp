// Implements the normal form: facts about the program and its difference, from which the words of the cause
// are chosen.
#include <evalcts/fuzz/normal_form.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <evalcts/gl/tokens.h>
#include "causes.h"
#include "legal.h"

namespace evalcts::fuzz {
namespace {

using gl::Command;
using gl::EntryPoint;

enum class Lists { kNone, kCompiled, kExecuted };

std::int64_t integer_of(const Command& command, std::size_t i) {
  const auto* value =
      command.arguments.size() > i ? std::get_if<std::int64_t>(&command.arguments[i]) : nullptr;
  return value ? *value : 0;
}

bool starts_with(EntryPoint entry, std::string_view stem) {
  return gl::name_of(entry).substr(2).starts_with(stem);
}

bool is_evaluation(EntryPoint entry) {
  return starts_with(entry, "EvalCoord") || starts_with(entry, "EvalPoint") || starts_with(entry, "EvalMesh");
}

// Returns the dimension, 1 or 2, in the name of the command; 0 if there is none.
int dimension_of(EntryPoint entry) {
  for (const char c : gl::name_of(entry))
    if (c == '1' || c == '2') return c - '0';
  return 0;
}

bool is_vertex_map(std::int64_t target, int dimension) {
  return dimension == 1 ? target == GL_MAP1_VERTEX_3 || target == GL_MAP1_VERTEX_4
                        : target == GL_MAP2_VERTEX_3 || target == GL_MAP2_VERTEX_4;
}

// Facts about the commands of a program.
struct Facts {
  Lists lists = Lists::kNone;
  int evaluations = 0;
  bool meshes = false, points = false, grids = false, automatic_normals = false, attribute_maps = false;
  bool without_vertices = false;   // evaluates in a dimension without an enabled vertex map
  std::set<std::int64_t> queried;  // names that Get queries
  // Words for the commands, without those that only frame or observe others (Begin, GetError): "Map",
  // "evaluation", "PopAttrib".
  std::set<std::string> words;

  explicit Facts(const gl::Case& program) {
    std::set<std::int64_t> enabled;
    for (const Command& command : program.commands())
      if (command.entry == EntryPoint::Enable) enabled.insert(integer_of(command, 0));
    for (const Command& command : program.commands()) {
      const EntryPoint entry = command.entry;
      const int dimension = dimension_of(entry);
      if (entry == EntryPoint::NewList)
        lists = std::max(lists, integer_of(command, 1) == GL_COMPILE ? Lists::kCompiled : Lists::kExecuted);
      if (is_evaluation(entry)) {
        ++evaluations;
        meshes = meshes || starts_with(entry, "EvalMesh");
        points = points || starts_with(entry, "EvalPoint");
        without_vertices = without_vertices || std::ranges::none_of(enabled, [&](std::int64_t cap) {
                             return is_vertex_map(cap, dimension);
                           });
      }
      grids = grids || starts_with(entry, "MapGrid");
      if (starts_with(entry, "Map1") || starts_with(entry, "Map2"))
        attribute_maps = attribute_maps || !is_vertex_map(integer_of(command, 0), dimension);
      if (entry == EntryPoint::Enable && integer_of(command, 0) == GL_AUTO_NORMAL) automatic_normals = true;
      if (starts_with(entry, "Get") && !starts_with(entry, "GetError") && !starts_with(entry, "GetMap") &&
          !starts_with(entry, "GetnMap"))
        queried.insert(integer_of(command, 0));
      if (const std::string word = word_of(command); !word.empty()) words.insert(word);
    }
  }

  static std::string word_of(const Command& command) {
    const EntryPoint entry = command.entry;
    if (is_evaluation(entry)) return "evaluation";
    for (const std::string_view looking :
         {"GetError", "Begin", "End", "Flush", "Finish", "NewList", "CallList"})
      if (starts_with(entry, looking)) return {};
    for (const std::string_view stem : {"MapGrid", "Map", "GetMap", "GetnMap", "Vertex"})
      if (starts_with(entry, stem)) return std::string(stem);
    for (const std::string_view stem : {"MultiTexCoord", "TexCoord", "Color", "Normal", "Index", "EdgeFlag"})
      if (starts_with(entry, stem)) return "current value";
    if ((entry == EntryPoint::Enable || entry == EntryPoint::Disable) &&
        integer_of(command, 0) == GL_AUTO_NORMAL)
      return "AUTO_NORMAL";
    std::string name(gl::name_of(entry).substr(2));
    for (const std::string_view get : {"GetFloatv", "GetIntegerv", "GetDoublev", "GetBooleanv"})
      if (name == get) return "Get";
    return name;
  }

  bool asks_for_current_values() const {
    return std::ranges::any_of(queried, [](std::int64_t name) {
      return (name >= GL_CURRENT_COLOR && name <= GL_CURRENT_TEXTURE_COORDS) || name == GL_EDGE_FLAG;
    });
  }
};

// Properties of the component of a vertex that differs.
struct Difference {
  bool given = false;  // a current value, or a component of an explicit vertex
  bool explicit_vertex = false;
};

bool is_given(const reference::Component& component) { return std::holds_alternative<float>(component); }

struct Rejected {
  std::string word;  // "Map"
  std::string error;
};

// Returns the first command that has to be rejected; none if there is none.
std::optional<Rejected> rejected_command(const gl::Case& program, int max_eval_order) {
  const std::optional<Specified> specified = specify_if_defined(program, max_eval_order);
  if (!specified) return std::nullopt;
  for (std::size_t i = 0; i < specified->errors.size(); ++i) {
    const std::string word = Facts::word_of(program.commands()[i]);
    if (!specified->errors[i].empty() && !word.empty())
      return Rejected{word, gl::error_name(specified->errors[i].front())};
  }
  return std::nullopt;
}

// Returns the number that follows `word` in the text; none if there is none.
std::optional<std::size_t> number_behind(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos) return std::nullopt;
  std::size_t number = 0;
  const char* const begin = text.data() + at + word.size();
  return std::from_chars(begin, text.data() + text.size(), number).ec == std::errc() ? std::optional(number)
                                                                                     : std::nullopt;
}

// Returns the properties of the component in the failure ("texture coordinate 0.s of vertex 3") according to
// the specification; none if the failure is not about a component.
std::optional<Difference> difference_of(const Finding& minimal, int max_eval_order) {
  const std::string& what = minimal.failure.what;
  const std::optional<std::size_t> index = number_behind(what, "vertex ");
  const std::optional<Specified> specified = specify_if_defined(minimal.program, max_eval_order);
  if (!index || !specified) return std::nullopt;
  const reference::Vertex* vertex = nullptr;
  std::size_t left = *index;
  for (const reference::Primitive& primitive : specified->prediction.primitives) {
    if (left < primitive.vertices.size()) {
      vertex = &primitive.vertices[left];
      break;
    }
    left -= primitive.vertices.size();
  }
  if (!vertex) return std::nullopt;
  Difference difference;
  difference.explicit_vertex = is_given(vertex->position[0]);
  if (what.starts_with("position")) {
    difference.given = difference.explicit_vertex;
  } else if (what.starts_with("color")) {
    difference.given = is_given(vertex->color[0]);
  } else if (what.starts_with("normal")) {
    const auto* components = std::get_if<std::array<reference::Component, 3>>(&vertex->normal);
    difference.given = components && is_given((*components)[0]);
  } else if (what.starts_with("texture coordinate")) {
    const std::size_t unit = number_behind(what, "coordinate ").value_or(0);
    difference.given =
        unit >= vertex->texture_coordinate.size() || is_given(vertex->texture_coordinate[unit][0]);
  } else {
    return std::nullopt;
  }
  return difference;
}

// Returns the noun for the value that differs or is queried, such as "colour".
std::string noun_of(const std::string& what, const Facts& facts) {
  if (what.starts_with("color") || facts.queried.contains(GL_CURRENT_COLOR)) return "colour";
  if (what.starts_with("normal") || facts.queried.contains(GL_CURRENT_NORMAL)) return "normal";
  if (what.starts_with("texture") || facts.queried.contains(GL_CURRENT_TEXTURE_COORDS))
    return "texture coordinates";
  if (facts.queried.contains(GL_CURRENT_INDEX)) return "colour index";
  if (what.starts_with("position")) return "position";
  return "edge flag";
}

std::string in_lists(const Facts& facts) {
  if (facts.lists == Lists::kNone) return {};
  return facts.lists == Lists::kCompiled ? " in a display list" : " in a list that is compiled and executed";
}

std::string cause_from(const std::string& head, const std::vector<std::string>& flags) {
  std::string cause = head;
  for (const std::string& flag : flags)
    if (!flag.empty()) cause += "; " + flag;
  return cause;
}

// Returns the words of the commands, such as "Map, evaluation", except `left_out`.
std::string words_without(const Facts& facts, std::initializer_list<const char*> left_out) {
  std::vector<std::string> words;
  for (const std::string& word : facts.words)
    if (std::ranges::none_of(left_out, [&](const char* other) { return word == other; }))
      words.push_back(word);
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string trimmed(std::string text) {
  if (text.starts_with(" ")) text.erase(0, 1);
  return text;
}

NormalForm of_current_values(const std::string& what, const Facts& facts, bool after) {
  const bool automatic = facts.automatic_normals && !facts.attribute_maps;
  const std::string without = facts.without_vertices ? " without a vertex map" : "";
  const std::string with = automatic ? " with AUTO_NORMAL" : "";
  return {cause_from(after ? "current values after an evaluation" : "current values at an evaluated vertex",
                     {trimmed(without), automatic ? "AUTO_NORMAL" : "", trimmed(in_lists(facts))}),
          after ? fmt::format("An evaluation{}{}{} changes the current {}", without, with, in_lists(facts),
                              noun_of(what, facts))
                : fmt::format("A vertex that is evaluated{}{} does not take the current {}", with,
                              in_lists(facts), noun_of(what, facts))};
}

NormalForm of_evaluated_values(const std::string& what, const Facts& facts) {
  const std::string noun = noun_of(what, facts);
  const bool on_grid = facts.meshes || facts.points;
  const std::string command = facts.meshes ? "EvalMesh" : facts.points ? "EvalPoint" : "EvalCoord";
  const std::string grid = !on_grid ? "" : facts.grids ? " on a grid of MapGrid" : " on the initial grid";
  const std::string with = facts.automatic_normals ? " with AUTO_NORMAL" : "";
  const std::string others = words_without(facts, {"Map", "Enable", "evaluation", "MapGrid", "AUTO_NORMAL"});
  return {cause_from(on_grid ? "evaluated values" : "evaluated " + noun,
                     {command + grid, facts.automatic_normals ? "AUTO_NORMAL" : "", trimmed(in_lists(facts)),
                      others}),
          fmt::format("{}{}{}{} gives a wrong {}{}", command, grid, with, in_lists(facts), noun,
                      others.empty() ? "" : fmt::format(" (with {})", others))};
}

NormalForm of_vertices(const Failure& failure, const Facts& facts) {
  const bool lists = facts.lists != Lists::kNone;
  const std::string command = facts.meshes && !lists   ? "EvalMesh"
                              : facts.points && !lists ? "EvalPoint"
                                                       : "An evaluation";
  const std::string without = facts.without_vertices ? " without a vertex map" : "";
  const auto expected = number_behind(failure.expected, ""), captured = number_behind(failure.captured, "");
  const char* how = "other vertices or primitives than it has to";
  if (expected && captured)
    how = *captured > *expected ? "too many vertices" : *captured < *expected ? "too few vertices" : how;
  if (facts.evaluations == 0)
    return {cause_from("vertices that are drawn",
                       {"no evaluation", trimmed(in_lists(facts)), words_without(facts, {})}),
            fmt::format("Vertices without any evaluation{}: {}", in_lists(facts), how)};
  return {
      cause_from("vertices that are drawn",
                 {lists                        ? ""
                  : command == "An evaluation" ? "evaluation"
                                               : command,
                  trimmed(without), facts.automatic_normals ? "AUTO_NORMAL" : "", trimmed(in_lists(facts))}),
      fmt::format("{}{}{} draws {}", command, without, in_lists(facts), how)};
}

NormalForm of_errors(const Failure& failure, const Facts& facts) {
  const std::string kind = failure.message.substr(0, failure.message.find(':'));
  std::string words = words_without(facts, {});
  if (words.empty()) words = "Begin, End";
  const std::string due =
      kind == "missing error"    ? fmt::format("raises no error, {} is due", failure.expected)
      : kind == "spurious error" ? fmt::format("raises {} without a cause", failure.captured)
                                 : fmt::format("raises {} instead of {}", failure.captured, failure.expected);
  return {cause_from(kind, {words, trimmed(in_lists(facts))}),
          fmt::format("{}{} {}", words, in_lists(facts), due)};
}

}  // namespace

NormalForm normal_form(const Finding& minimal, int max_eval_order) {
  const Facts facts(minimal.program);
  const Failure& failure = minimal.failure;
  const std::string& what = failure.what;
  const std::string kind = kind_of(what);
  const std::string lists = in_lists(facts);
  if (kind == "crash" || kind == "timeout") {
    const std::string words = words_without(facts, {"Enable"});
    return {cause_from(kind, {words, trimmed(lists)}),
            fmt::format("{} of the library: {}{}", kind == "crash" ? "Crash" : "Hang",
                        words.empty() ? "Begin, End" : words, lists)};
  }
  if (kind == "glGetError") return of_errors(failure, facts);
  // The program is minimal, so it does not fail without the rejected command.
  if (const std::optional<Rejected> rejected = rejected_command(minimal.program, max_eval_order))
    return {cause_from("effect of a rejected command", {rejected->word, rejected->error, trimmed(lists)}),
            fmt::format("{} is rejected with {}{} and has an effect nevertheless", rejected->word,
                        rejected->error, lists)};
  if (kind == kOrder)
    return {cause_from("order of a mesh", {trimmed(lists)}),
            fmt::format("EvalMesh{} draws its vertices in another order", lists)};
  if (kind == kPrimitives) return of_vertices(failure, facts);
  if (kind.starts_with("glGet") && !kind.starts_with("glGetMap") && !kind.starts_with("glGetnMap") &&
      facts.asks_for_current_values()) {
    if (facts.evaluations > 0) return of_current_values(what, facts, true);
    return {cause_from("current values without any evaluation", {trimmed(lists)}),
            fmt::format("The current {} is wrong{} without any evaluation", noun_of(what, facts), lists)};
  }
  if (kind.starts_with("gl")) {
    std::string command = kind.substr(2);
    while (!command.empty() && (command.back() == 'v' || command.back() == 'f' || command.back() == 'd' ||
                                command.back() == 'i')) {
      const bool vector = command.back() == 'v';
      command.pop_back();
      if (!vector) break;
    }
    for (const std::string_view stem : {"GetMap", "GetnMap"})
      if (command.starts_with(stem)) command = stem;
    if (kind == "glIsEnabled") command = "IsEnabled";
    const std::string words = words_without(facts, {"Map", "GetMap", "GetnMap", "Get", "IsEnabled"});
    return {cause_from("answer of " + command, {words, trimmed(lists)}),
            fmt::format("{} answers {} instead of {}{}{}", command, failure.captured, failure.expected,
                        words.empty() ? "" : " after " + words, lists)};
  }
  const std::optional<Difference> difference = difference_of(minimal, max_eval_order);
  if (facts.evaluations == 0)
    return {cause_from("explicit vertices", {kind, trimmed(lists), words_without(facts, {})}),
            fmt::format("The {} of an explicit vertex{} is wrong without any evaluation",
                        noun_of(what, facts), lists)};
  if (difference && difference->given && !what.starts_with("position"))
    return of_current_values(what, facts, facts.evaluations > 1 || difference->explicit_vertex);
  if (difference && difference->given)
    return {cause_from("position of an explicit vertex after an evaluation", {trimmed(lists)}),
            fmt::format("An evaluation{} changes the position of an explicit vertex", lists)};
  return of_evaluated_values(what, facts);
}

}  // namespace evalcts::fuzz
