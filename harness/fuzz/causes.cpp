// Derives the words of a cause from the commands of a minimal program and from the kind of its difference.
#include "causes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/gl/display_lists.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;

// Returns "Map1" for "glMap1fv", because the form of the arguments does not distinguish causes.
std::string without_form(std::string name) {
  name = name.substr(2);
  for (const std::string_view stem :
       {"GetMap", "GetnMap", "MapGrid1", "MapGrid2", "Map1", "Map2", "EvalCoord1", "EvalCoord2", "Vertex"})
    if (name.starts_with(stem)) return std::string(stem);
  for (const std::string_view stem : {"MultiTexCoord", "TexCoord", "Color", "Normal", "Index", "EdgeFlag"})
    if (name.starts_with(stem)) return "current value";
  if (name == "GetFloatv" || name == "GetIntegerv" || name == "GetDoublev" || name == "GetBooleanv")
    return "Get";
  return name;
}

// Returns the word for a command in a cause.
std::string word_of(const gl::Command& command) {
  const auto* cap = command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
  return cap && *cap == GL_AUTO_NORMAL ? "AUTO_NORMAL"
                                       : without_form(std::string(gl::name_of(command.entry)));
}

// --- The requirement that the minimal program of a difference violates

constexpr char kCallInList[] = "CallList in a list", kSurfaces[] = "surfaces only",
               kNoVertexMap[] = "evaluation without a vertex map";

// Returns what the table below may ask for: the words of all commands ("Map1", "current value"), the commands
// with a token ("Enable GL_AUTO_NORMAL", "EvalMesh2 GL_LINE"), and the three marks above.
std::set<std::string> marks_of(const gl::Case& program) {
  std::set<std::string> marks;
  bool is_open = false;
  for (const gl::Command& command : program.commands()) {
    const std::string name(gl::name_of(command.entry));
    marks.insert(without_form(name));
    for (const gl::Value& value : command.arguments)
      if (const auto* token = std::get_if<std::int64_t>(&value))
        marks.insert(name.substr(2) + " " + gl::token_name(static_cast<GLenum>(*token)));
    if (command.entry == EntryPoint::NewList) is_open = true;
    if (command.entry == EntryPoint::EndList) is_open = false;
    if (is_open && command.entry == EntryPoint::CallList) marks.insert(kCallInList);
  }
  const auto has = [&](const std::string& mark) { return marks.contains(mark); };
  const bool one = has("Enable GL_MAP1_VERTEX_3") || has("Enable GL_MAP1_VERTEX_4"),
             two = has("Enable GL_MAP2_VERTEX_3") || has("Enable GL_MAP2_VERTEX_4");
  if ((has("EvalCoord1") && !one) || (has("EvalCoord2") && !two)) marks.insert(kNoVertexMap);
  if (has("Map2") && !has("Map1")) marks.insert(kSurfaces);
  return marks;
}

// A row applies to the kinds of differences that begin with `kind`, and to programs with all of the marks.
// The first row that applies gives the requirement.
struct Row {
  std::string_view kind;
  std::initializer_list<const char*> marks;
  const char* requirement;
};
constexpr Row kRequirements[] = {
    {"crash", {kCallInList}, "EV-DL-NESTED"},
    {"crash", {"NewList"}, "EV-DL-EXECUTE"},
    {"crash", {}, "EV-NUM-SPECIAL-SAFE"},
    {"timeout", {kCallInList}, "EV-DL-NESTED"},
    {"timeout", {"NewList"}, "EV-DL-EXECUTE"},
    {"timeout", {}, "EV-NUM-SPECIAL-SAFE"},
    {"glGetMap", {kSurfaces}, "EV-GETMAP-COEFF2"},
    {"glGetMap", {}, "EV-GETMAP-COEFF1"},
    {"glIsEnabled", {}, "EV-EN-GETS"},
    {"glGetError", {"ActiveTexture", "NewList"}, "EV-DL-ACTIVETEX"},
    {"glGetError", {"ActiveTexture", kSurfaces}, "EV-MAP2-ERR-ACTIVETEX"},
    {"glGetError", {"ActiveTexture"}, "EV-MAP1-ERR-ACTIVETEX"},
    {kOrder, {"EvalMesh2 GL_POINT"}, "EV-MESH2-POINT"},
    {kOrder, {"EvalMesh2 GL_LINE"}, "EV-MESH2-LINE"},
    {kOrder, {}, "EV-MESH2-FILL"},
    {"glGetError", {"NewList"}, "EV-DL-ERR-ALL"},
    {"glGetError", {kSurfaces}, "EV-MAP2-ERR-NOEFFECT"},
    {"glGetError", {}, "EV-MAP1-ERR-NOEFFECT"},
    {"", {"NewList GL_COMPILE_AND_EXECUTE"}, "EV-DL-COMPEXEC"},
    {"", {kNoVertexMap, "Enable GL_AUTO_NORMAL"}, "EV-AUTON-NOVERTEX"},
    {"", {kNoVertexMap}, "EV-COORD-NOVERTEX"},
    {"", {"NewList"}, "EV-DL-EXECUTE"},
    {"position", {"Enable GL_AUTO_NORMAL"}, "EV-AUTON-SAMEVERTEX"},
    {"", {"PopAttrib"}, "EV-ATTRIB-EVALBIT"},
    {"", {"GetFloatv GL_CURRENT_NORMAL", "Enable GL_AUTO_NORMAL"}, "EV-AUTON-CURRENT"},
    {"", {"GetFloatv GL_CURRENT_NORMAL"}, "EV-CUR-NORMAL"},
    {"", {"GetFloatv GL_CURRENT_TEXTURE_COORDS"}, "EV-CUR-TEX"},
    {"glGet", {}, "EV-CUR-COLOR"},
    {"position", {"EvalMesh1"}, "EV-MESH1-COORDS"},
    {"position", {"EvalMesh2"}, "EV-MESH2-COORDS"},
    {"position", {}, "EV-COORD-ASIF"},
    {kPrimitives, {"EvalMesh1"}, "EV-MESH1-COORDS"},
    {kPrimitives, {"EvalMesh2"}, "EV-MESH2-COORDS"},
    {kPrimitives, {}, "EV-COORD-ASIF"},
    {"", {"Vertex"}, "EV-CUR-NEXTVERTEX"},
    {"", {}, "EV-COORD-CURRENT"},
};

}  // namespace

std::string kind_of(const std::string& what) {
  const std::string kind = what.substr(0, what.find_first_of(". "));
  return kind == "number" ? kPrimitives : kind;
}

Outcomes outcomes_of(const std::string& kind) {
  return kind == kOrder           ? Outcomes::kOrder
         : kind.starts_with("gl") ? Outcomes::kAnswers
                                  : Outcomes::kVertices;
}

std::set<std::string> words_of(const gl::Case& program) {
  std::set<std::string> words;
  for (const gl::Command& command : program.commands()) words.insert(word_of(command));
  return words;
}

gl::Case without_word(const gl::Case& program, const std::string& word) {
  gl::Case without(program.identity());
  for (const gl::Command& command : program.commands())
    if (word_of(command) != word) without.add(command);
  return without;
}

gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program) {
  const auto is_declared = [&](const gl::Command& command) {
    return !info.declaration || undeclared_part(*info.declaration, command).empty();
  };
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::has(table, command.entry) && is_declared(command)) left.add(command);
  return left;
}

std::string cause_of(const gl::Case& program, const std::string& what) {
  return fmt::format("{}: {}", fmt::join(words_of(program), ", "), kind_of(what));
}

std::string requirement_of(const gl::Case& program, const std::string& what) {
  const std::string kind = kind_of(what);
  const std::set<std::string> marks = marks_of(program);
  const auto applies = [&](const Row& row) {
    return kind.starts_with(row.kind) &&
           std::ranges::all_of(row.marks, [&](const char* mark) { return marks.contains(mark); });
  };
  return std::ranges::find_if(kRequirements, applies)->requirement;
}

std::optional<gl::Case> reduced_to(const std::string& cause, const gl::Case& program,
                                   const Specified& specified,
                                   const std::function<bool(const gl::Case&)>& still) {
  const std::string words = ", " + cause.substr(0, cause.find(": ")) + ", ";
  const auto has_word = [&](const std::string& word) {
    return words.find(", " + word + ", ") != std::string::npos;
  };
  const bool errors = has_word("GetError");
  gl::Case reduced(program.identity());
  for (std::size_t i = 0; i < program.commands().size(); ++i) {
    const gl::Command& command = program.commands()[i];
    if (has_word(word_of(command)) && (errors || specified.errors[i].empty())) reduced.add(command);
  }
  const std::set<std::string> needed = words_of(reduced);
  if (fmt::format(", {}, ", fmt::join(needed, ", ")) != words || !still(reduced)) return std::nullopt;
  for (const std::string& word : needed)
    if (still(without_word(reduced, word))) return std::nullopt;
  return reduced;
}

std::vector<gl::Case> controls_without_evaluators(const gl::Case& program) {
  std::vector<gl::Case> controls = {gl::with_explicit_vertices(program), gl::with_explicit_commands(program),
                                    gl::with_explicit_commands(program, {}, gl::Arguments::kArray)};
  if (gl::uses_lists(program)) controls.push_back(gl::with_calls_of_no_list(program));
  return controls;
}

}  // namespace evalcts::fuzz
