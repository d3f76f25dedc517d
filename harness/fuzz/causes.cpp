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

bool uses(const gl::Case& program, EntryPoint entry) {
  return std::ranges::any_of(program.commands(),
                             [&](const gl::Command& command) { return command.entry == entry; });
}
bool uses_stem(const gl::Case& program, std::string_view stem) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    return without_form(std::string(gl::name_of(command.entry))) == stem;
  });
}

bool has_argument(const gl::Case& program, EntryPoint entry, std::size_t position, std::int64_t wanted) {
  return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
    if (command.entry != entry || command.arguments.size() <= position) return false;
    const auto* value = std::get_if<std::int64_t>(&command.arguments[position]);
    return value && *value == wanted;
  });
}

// Returns true if the program evaluates while no map generates vertices.
bool evaluates_without_vertices(const gl::Case& program) {
  const auto enables = [&](GLenum cap) { return has_argument(program, EntryPoint::Enable, 0, cap); };
  return (uses_stem(program, "EvalCoord1") && !enables(GL_MAP1_VERTEX_3) && !enables(GL_MAP1_VERTEX_4)) ||
         (uses_stem(program, "EvalCoord2") && !enables(GL_MAP2_VERTEX_3) && !enables(GL_MAP2_VERTEX_4));
}

bool calls_in_a_list(const gl::Case& program) {
  bool open = false;
  for (const gl::Command& command : program.commands()) {
    if (command.entry == EntryPoint::NewList) open = true;
    if (command.entry == EntryPoint::EndList) open = false;
    if (open && command.entry == EntryPoint::CallList) return true;
  }
  return false;
}

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
  const bool two = uses_stem(program, "Map2") && !uses_stem(program, "Map1");
  const bool list = uses(program, EntryPoint::NewList);
  if (kind == "crash" || kind == "timeout") {
    if (!list) return "EV-NUM-SPECIAL-SAFE";
    return calls_in_a_list(program) ? "EV-DL-NESTED" : "EV-DL-EXECUTE";
  }
  if (kind.starts_with("glGetMap")) return two ? "EV-GETMAP-COEFF2" : "EV-GETMAP-COEFF1";
  if (kind == "glIsEnabled") return "EV-EN-GETS";
  if (kind == "glGetError" && uses(program, EntryPoint::ActiveTexture))
    return list ? "EV-DL-ACTIVETEX" : two ? "EV-MAP2-ERR-ACTIVETEX" : "EV-MAP1-ERR-ACTIVETEX";
  if (kind == kOrder)
    return has_argument(program, EntryPoint::EvalMesh2, 0, GL_POINT)  ? "EV-MESH2-POINT"
           : has_argument(program, EntryPoint::EvalMesh2, 0, GL_LINE) ? "EV-MESH2-LINE"
                                                                      : "EV-MESH2-FILL";
  if (kind == "glGetError" && list) return "EV-DL-ERR-ALL";
  if (kind == "glGetError") return two ? "EV-MAP2-ERR-NOEFFECT" : "EV-MAP1-ERR-NOEFFECT";
  if (has_argument(program, EntryPoint::NewList, 1, GL_COMPILE_AND_EXECUTE)) return "EV-DL-COMPEXEC";
  if (evaluates_without_vertices(program))
    return has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL) ? "EV-AUTON-NOVERTEX"
                                                                        : "EV-COORD-NOVERTEX";
  if (list) return "EV-DL-EXECUTE";
  if (kind == "position" && has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL))
    return "EV-AUTON-SAMEVERTEX";
  if (uses(program, EntryPoint::PopAttrib)) return "EV-ATTRIB-EVALBIT";
  if (has_argument(program, EntryPoint::GetFloatv, 0, GL_CURRENT_NORMAL))
    return has_argument(program, EntryPoint::Enable, 0, GL_AUTO_NORMAL) ? "EV-AUTON-CURRENT"
                                                                        : "EV-CUR-NORMAL";
  if (has_argument(program, EntryPoint::GetFloatv, 0, GL_CURRENT_TEXTURE_COORDS)) return "EV-CUR-TEX";
  if (kind.starts_with("glGet")) return "EV-CUR-COLOR";
  if (kind != "position" && kind != kPrimitives)
    return uses_stem(program, "Vertex") ? "EV-CUR-NEXTVERTEX" : "EV-COORD-CURRENT";
  if (uses(program, EntryPoint::EvalMesh1)) return "EV-MESH1-COORDS";
  if (uses(program, EntryPoint::EvalMesh2)) return "EV-MESH2-COORDS";
  return "EV-COORD-ASIF";
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
