// Implements the normal form: facts about the program, from which the words of the cause are chosen.
#include <evalcts/fuzz/normal_form.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include "legal.h"

namespace evalcts::fuzz {
namespace {

using gl::Command;
using gl::EntryPoint;
using gl::Role;

bool is_vertex_map(std::int64_t target, int dimension) {
  return dimension == 1 ? target == GL_MAP1_VERTEX_3 || target == GL_MAP1_VERTEX_4
                        : target == GL_MAP2_VERTEX_3 || target == GL_MAP2_VERTEX_4;
}

// Facts about the commands of a program.
struct Facts {
  enum class Lists { kNone, kCompiled, kExecuted } lists = Lists::kNone;
  int evaluations = 0;
  bool meshes = false, points = false, grids = false, explicit_vertices = false;
  bool automatic_normals = false, attribute_maps = false, nested_lists = false;
  bool without_vertices = false;   // evaluates in a dimension without an enabled vertex map
  bool surfaces_only = false;      // has maps, all of them of two dimensions
  bool rational_normals = false;   // has automatic normals of a surface whose w is not constant
  std::int64_t mesh_mode = 0;      // of the last EvalMesh
  std::set<std::int64_t> queried;  // names that Get queries
  // Words for the commands, without those that only frame or observe others (Begin, GetError): "Map",
  // "evaluation", "PopAttrib".
  std::set<std::string> words;

  explicit Facts(const gl::Case& program) {
    std::set<std::int64_t> enabled;  // now; through lists or the attribute stack: at any time
    const bool in_order =
        !gl::uses_lists(program) && std::ranges::none_of(program.commands(), [](const Command& command) {
          return command.entry == EntryPoint::PushAttrib;
        });
    std::set<int> dimensions_of_maps;
    bool is_list_open = false;
    for (const Command& command : program.commands())
      if (!in_order && command.entry == EntryPoint::Enable) enabled.insert(gl::integer_of(command, 0));
    for (const Command& command : program.commands()) {
      const EntryPoint entry = command.entry;
      const Role role = gl::role_of(entry);
      const int dimension = gl::dimension_of(entry);
      const std::int64_t name = gl::integer_of(command, 0);
      if (entry == EntryPoint::NewList)
        lists =
            std::max(lists, gl::integer_of(command, 1) == GL_COMPILE ? Lists::kCompiled : Lists::kExecuted);
      if (entry == EntryPoint::NewList || entry == EntryPoint::EndList)
        is_list_open = entry == EntryPoint::NewList;
      if (entry == EntryPoint::Enable) enabled.insert(name);
      if (entry == EntryPoint::Disable && in_order) enabled.erase(name);
      nested_lists = nested_lists || (is_list_open && entry == EntryPoint::CallList);
      if (gl::is_evaluation(entry)) {
        ++evaluations;
        meshes = meshes || role == Role::kEvalMesh;
        points = points || role == Role::kEvalPoint;
        if (role == Role::kEvalMesh) mesh_mode = name;
        without_vertices = without_vertices || std::ranges::none_of(enabled, [&](std::int64_t cap) {
                             return is_vertex_map(cap, dimension);
                           });
      }
      grids = grids || role == Role::kMapGrid;
      explicit_vertices = explicit_vertices || role == Role::kVertex;
      if (role == Role::kMap) {
        dimensions_of_maps.insert(dimension);
        attribute_maps = attribute_maps || !is_vertex_map(name, dimension);
      }
      if (entry == EntryPoint::Enable && name == GL_AUTO_NORMAL) automatic_normals = true;
      if (role == Role::kGet) queried.insert(name);
      if (const std::string word = word_of(command); !word.empty()) words.insert(word);
    }
    surfaces_only = dimensions_of_maps == std::set<int>{2};
  }

  static std::string word_of(const Command& command) {
    const EntryPoint entry = command.entry;
    if (gl::is_evaluation(entry)) return "evaluation";
    for (const EntryPoint frame :
         {EntryPoint::GetError, EntryPoint::Begin, EntryPoint::End, EntryPoint::Flush, EntryPoint::Finish,
          EntryPoint::NewList, EntryPoint::EndList, EntryPoint::CallList})
      if (entry == frame) return {};
    if (gl::role_of(entry) == Role::kCurrentValue) return "current value";
    if ((entry == EntryPoint::Enable || entry == EntryPoint::Disable) &&
        gl::integer_of(command, 0) == GL_AUTO_NORMAL)
      return "AUTO_NORMAL";
    return gl::stem_without_dimension(entry);
  }

  bool asks_for_current_values() const {
    return std::ranges::any_of(queried, [](std::int64_t name) {
      return (name >= GL_CURRENT_COLOR && name <= GL_CURRENT_TEXTURE_COORDS) || name == GL_EDGE_FLAG;
    });
  }
};

struct Rejected {
  std::string word;   // "Map"
  std::string error;  // "GL_INVALID_VALUE", "GL_INVALID_ENUM or GL_INVALID_VALUE"
  std::string rules;  // the rules of gl::broken_map_rules(), if they make the error due
};

// Returns the first command that has to be rejected; none if there is none.
std::optional<Rejected> rejected_command(const gl::Case& program, const Specified& specified,
                                         int max_eval_order) {
  for (std::size_t i = 0; i < specified.errors.size(); ++i) {
    const std::string word = Facts::word_of(program.commands()[i]);
    const std::vector<GLenum>& errors = specified.errors[i];
    if (errors.empty() || word.empty()) continue;
    std::vector<std::string> names;
    for (const GLenum error : errors) names.push_back(gl::error_name(error));
    return Rejected{word, fmt::format("{}", fmt::join(names, " or ")),
                    errors == std::vector<GLenum>{GL_INVALID_VALUE}
                        ? gl::broken_map_rules(program.commands()[i], max_eval_order)
                        : ""};
  }
  return std::nullopt;
}

// Returns the noun for the value that differs or is queried, such as "colour".
std::string noun_of(const std::string& kind, const Facts& facts) {
  if (kind == "color" || facts.queried.contains(GL_CURRENT_COLOR)) return "colour";
  if (kind == "normal" || facts.queried.contains(GL_CURRENT_NORMAL)) return "normal";
  if (kind == "texture coordinate" || facts.queried.contains(GL_CURRENT_TEXTURE_COORDS))
    return "texture coordinates";
  if (facts.queried.contains(GL_CURRENT_INDEX)) return "colour index";
  return kind == "position" ? "position" : "edge flag";
}

std::string in_lists(const Facts& facts) {
  if (facts.lists == Facts::Lists::kNone) return {};
  return facts.lists == Facts::Lists::kCompiled ? " in a display list"
                                                : " in a list that is compiled and executed";
}

// Returns "head; part; part" of the parts that are not empty, without their leading spaces.
std::string cause_from(const std::string& head, const std::vector<std::string>& parts) {
  std::string cause = head;
  for (const std::string& part : parts)
    if (!part.empty()) cause += "; " + part.substr(part.starts_with(" ") ? 1 : 0);
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

struct Name {
  std::string cause, title;
};

Name of_current_values(const std::string& kind, const Facts& facts, bool after) {
  const bool automatic = facts.automatic_normals && !facts.attribute_maps;
  const std::string without = facts.without_vertices ? " without a vertex map" : "";
  const std::string with = automatic ? " with AUTO_NORMAL" : "";
  return {cause_from(after ? "current values after an evaluation" : "current values at an evaluated vertex",
                     {without, automatic ? "AUTO_NORMAL" : "", in_lists(facts)}),
          after ? fmt::format("An evaluation{}{}{} changes the current {}", without, with, in_lists(facts),
                              noun_of(kind, facts))
                : fmt::format("A vertex that is evaluated{}{} does not take the current {}", with,
                              in_lists(facts), noun_of(kind, facts))};
}

Name of_evaluated_values(const std::string& kind, const Facts& facts) {
  const std::string noun = noun_of(kind, facts);
  const bool on_grid = facts.meshes || facts.points;
  const std::string command = facts.meshes ? "EvalMesh" : facts.points ? "EvalPoint" : "EvalCoord";
  const std::string grid = !on_grid ? "" : facts.grids ? " on a grid of MapGrid" : " on the initial grid";
  const std::string with = facts.automatic_normals ? " with AUTO_NORMAL" : "";
  const std::string others = words_without(facts, {"Map", "Enable", "evaluation", "MapGrid", "AUTO_NORMAL"});
  return {cause_from(on_grid ? "evaluated values" : "evaluated " + noun,
                     {command + grid, facts.automatic_normals ? "AUTO_NORMAL" : "", in_lists(facts), others}),
          fmt::format("{}{}{}{} gives {}wrong {}{}", command, grid, with, in_lists(facts),
                      noun == "texture coordinates" ? "" : "a ", noun,
                      others.empty() ? "" : fmt::format(" (with {})", others))};
}

Name of_vertices(const std::string& relation, const Facts& facts) {
  const bool lists = facts.lists != Facts::Lists::kNone;
  const std::string command = facts.meshes && !lists   ? "EvalMesh"
                              : facts.points && !lists ? "EvalPoint"
                                                       : "An evaluation";
  const std::string without = facts.without_vertices ? " without a vertex map" : "";
  const char* const how = relation == "more"    ? "too many vertices"
                          : relation == "fewer" ? "too few vertices"
                                                : "other vertices or primitives than it has to";
  return {cause_from("vertices that are drawn",
                     {lists                        ? ""
                      : command == "An evaluation" ? "evaluation"
                                                   : command,
                      without, facts.automatic_normals ? "AUTO_NORMAL" : "", in_lists(facts)}),
          fmt::format("{}{}{} draws {}", command, without, in_lists(facts), how)};
}

Name of_order(const Facts& facts) {
  const char* const what = facts.mesh_mode == GL_FILL   ? "FILL draws its quads in another order or division"
                           : facts.mesh_mode == GL_LINE ? "LINE draws its lines in another order"
                                                        : "POINT draws its points in another order";
  return {cause_from("order of a mesh", {in_lists(facts)}),
          fmt::format("EvalMesh2 of {}{}", what, in_lists(facts))};
}

Name of_errors(const Failure& failure, const Facts& facts, const std::string& rules) {
  const std::string& relation = failure.difference.relation;
  const std::string kind = relation.starts_with("missing")    ? "missing error"
                           : relation.starts_with("spurious") ? "spurious error"
                                                              : "wrong error";
  std::string words = words_without(facts, {});
  if (words.empty()) words = "Begin, End";
  const std::string due =
      kind == "missing error"    ? fmt::format("raises no error, {} is due", failure.expected)
      : kind == "spurious error" ? fmt::format("raises {} without a cause", failure.captured)
                                 : fmt::format("raises {} instead of {}", failure.captured, failure.expected);
  return {cause_from(kind, {words, rules, in_lists(facts)}),
          fmt::format("{}{}{} {}", words, rules.empty() ? "" : " (" + rules + ")", in_lists(facts), due)};
}

Name of_answers(const Failure& failure, const Facts& facts) {
  if (facts.asks_for_current_values() && facts.evaluations > 0)
    return of_current_values(failure.difference.kind, facts, true);
  const std::string query = failure.difference.place.substr(0, failure.difference.place.find(' '));
  const std::string words = words_without(facts, {"Map", "GetMap", "GetnMap", "Get", "IsEnabled"});
  const std::string& asked = query == "IsEnabled" ? query : failure.difference.place;
  return {cause_from("answer of " + asked, {words, in_lists(facts)}),
          fmt::format("{} answers {} instead of {}{}{}", query, failure.captured, failure.expected,
                      words.empty() ? "" : " after " + words, in_lists(facts))};
}

Name name_of(const Finding& minimal, const Facts& facts, const std::optional<Rejected>& rejected) {
  const Difference& difference = minimal.failure.difference;
  const std::string& kind = difference.kind;
  const std::string lists = in_lists(facts);
  if (kind == Difference::kCrash || kind == Difference::kHang) {
    const std::string words = words_without(facts, {"Enable"});
    return {cause_from(kind, {words, lists}),
            fmt::format("{} of the library: {}{}", kind == Difference::kCrash ? "Crash" : "Hang",
                        words.empty() ? "Begin, End" : words, lists)};
  }
  if (kind == Difference::kError) return of_errors(minimal.failure, facts, rejected ? rejected->rules : "");
  // A minimal program does not fail without the rejected command, whose error is right.
  if (rejected)
    return {cause_from("effect of a rejected command", {rejected->word, rejected->error, lists}),
            fmt::format("{} is rejected with {}{} and has an effect nevertheless", rejected->word,
                        rejected->error, lists)};
  if (kind == Difference::kOrder) return of_order(facts);
  if (kind == Difference::kVertices) return of_vertices(difference.relation, facts);
  if (kind == Difference::kAnswer) return of_answers(minimal.failure, facts);
  if (difference.place.empty() || difference.place == Difference::kMap ||
      difference.place == Difference::kAutomaticNormal)
    return of_evaluated_values(kind, facts);
  if (kind == "position")
    return {cause_from("position of an explicit vertex after an evaluation", {lists}),
            fmt::format("An evaluation{} changes the position of an explicit vertex", lists)};
  return of_current_values(kind, facts,
                           facts.evaluations > 1 || difference.place == Difference::kExplicitVertex);
}

// --- the requirement that a minimal program violates

const char* requirement_of_rejection(const Facts& facts) {
  return facts.surfaces_only ? "EV-MAP2-ERR-NOEFFECT" : "EV-MAP1-ERR-NOEFFECT";
}

const char* requirement_of_error(const Facts& facts) {
  const bool active_texture = facts.words.contains("ActiveTexture");
  if (facts.lists != Facts::Lists::kNone) return active_texture ? "EV-DL-ACTIVETEX" : "EV-DL-ERR-ALL";
  if (active_texture) return facts.surfaces_only ? "EV-MAP2-ERR-ACTIVETEX" : "EV-MAP1-ERR-ACTIVETEX";
  return requirement_of_rejection(facts);
}

const char* requirement_of_answer(const std::string& place, const Facts& facts) {
  if (place.starts_with("GetMap")) return facts.surfaces_only ? "EV-GETMAP-COEFF2" : "EV-GETMAP-COEFF1";
  if (place.starts_with("IsEnabled")) return "EV-EN-GETS";
  if (place.find("_GRID_DOMAIN") != std::string::npos) return "EV-GET-GRIDDOMAIN";
  if (place.find("_GRID_SEGMENTS") != std::string::npos) return "EV-GET-GRIDSEG";
  if (facts.lists == Facts::Lists::kExecuted) return "EV-DL-COMPEXEC";
  if (facts.without_vertices) return facts.automatic_normals ? "EV-AUTON-NOVERTEX" : "EV-COORD-NOVERTEX";
  if (facts.lists == Facts::Lists::kCompiled) return "EV-DL-EXECUTE";
  if (facts.words.contains("PopAttrib")) return "EV-ATTRIB-EVALBIT";
  if (facts.queried.contains(GL_CURRENT_NORMAL))
    return facts.automatic_normals ? "EV-AUTON-CURRENT" : "EV-CUR-NORMAL";
  return facts.queried.contains(GL_CURRENT_TEXTURE_COORDS) ? "EV-CUR-TEX" : "EV-CUR-COLOR";
}

const char* requirement_of_vertices(const Difference& difference, const Facts& facts) {
  if (facts.lists == Facts::Lists::kExecuted) return "EV-DL-COMPEXEC";
  if (facts.without_vertices) return facts.automatic_normals ? "EV-AUTON-NOVERTEX" : "EV-COORD-NOVERTEX";
  if (facts.lists == Facts::Lists::kCompiled) return "EV-DL-EXECUTE";
  if (difference.place == Difference::kAutomaticNormal)
    return facts.rational_normals ? "EV-AUTON-RATIONAL" : "EV-AUTON-CURVED";
  const bool is_position = difference.kind == "position";
  if (is_position && facts.automatic_normals) return "EV-AUTON-SAMEVERTEX";
  if (facts.words.contains("PopAttrib")) return "EV-ATTRIB-EVALBIT";
  if (is_position || difference.kind == Difference::kVertices) {
    if (!facts.meshes) return "EV-COORD-ASIF";
    return facts.surfaces_only ? "EV-MESH2-COORDS" : "EV-MESH1-COORDS";
  }
  return facts.explicit_vertices ? "EV-CUR-NEXTVERTEX" : "EV-COORD-CURRENT";
}

const char* requirement_of(const Difference& difference, const Facts& facts, bool has_rejected_map) {
  const std::string& kind = difference.kind;
  if (kind == Difference::kCrash || kind == Difference::kHang)
    return facts.nested_lists                   ? "EV-DL-NESTED"
           : facts.lists != Facts::Lists::kNone ? "EV-DL-EXECUTE"
                                                : "EV-NUM-SPECIAL-SAFE";
  if (kind == Difference::kOrder)
    return facts.mesh_mode == GL_POINT  ? "EV-MESH2-POINT"
           : facts.mesh_mode == GL_LINE ? "EV-MESH2-LINE"
                                        : "EV-MESH2-FILL";
  if (kind == Difference::kError) return requirement_of_error(facts);
  if (has_rejected_map) return requirement_of_rejection(facts);
  if (kind == Difference::kAnswer) return requirement_of_answer(difference.place, facts);
  return requirement_of_vertices(difference, facts);
}

}  // namespace

void name_finding(Finding& minimal, int max_eval_order) {
  Facts facts(minimal.program);
  std::optional<Rejected> rejected;
  if (const std::optional<Specified> specified = specify_if_defined(minimal.program, max_eval_order)) {
    facts.rational_normals = specified->prediction.has_rational_normals();
    rejected = rejected_command(minimal.program, *specified, max_eval_order);
  }
  const Name name = name_of(minimal, facts, rejected);
  minimal.cause = name.cause;
  minimal.title = name.title;
  minimal.requirement =
      requirement_of(minimal.failure.difference, facts, rejected && rejected->word == "Map");
}

}  // namespace evalcts::fuzz
