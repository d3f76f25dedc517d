// Checks the primitives, lists and errors of a program for effects that the specification does not define.
#include "legal.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include <evalcts/gl/roles.h>
#include <evalcts/judge/prediction.h>

namespace evalcts::fuzz {
namespace {

using gl::EntryPoint;

// Tracks where primitives begin and end, inside display lists as well.
class Primitives {
 public:
  // Returns false if the command emits a vertex outside of a primitive.
  bool issue(const gl::Command& command) {
    if (command.entry == EntryPoint::NewList && !inside_ && !open_) {
      open_ = static_cast<GLuint>(gl::integer_of(command, 0));
      compile_only_ = gl::integer_of(command, 1) == GL_COMPILE;
      lists_[*open_].clear();
      return true;
    }
    if (command.entry == EntryPoint::EndList) {
      if (!inside_) open_.reset();
      return true;
    }
    if (open_) lists_[*open_].push_back(command);
    return open_ && compile_only_ ? true : execute(command, 0);
  }
  bool is_open() const { return inside_ || open_; }

 private:
  static constexpr int kMostNesting = 16;  // nesting of lists; programs have less

  bool execute(const gl::Command& command, int depth) {
    if (gl::emits_vertex(command.entry)) return inside_;
    if (command.entry == EntryPoint::Begin && gl::integer_of(command, 0) <= GL_POLYGON) inside_ = true;
    if (command.entry == EntryPoint::End) inside_ = false;
    if (command.entry != EntryPoint::CallList) return true;
    if (depth == kMostNesting) return false;
    const auto list = lists_.find(static_cast<GLuint>(gl::integer_of(command, 0)));
    if (list == lists_.end()) return true;
    // If a list is called while it is being replaced, the GL executes its old contents, which are
    // not known here.
    if (open_ && *open_ == list->first) return false;
    for (const gl::Command& inner : list->second)
      if (!execute(inner, depth + 1)) return false;
    return true;
  }

  bool inside_ = false;
  bool compile_only_ = false;
  std::optional<GLuint> open_;
  std::map<GLuint, std::vector<gl::Command>> lists_;
};

// Returns true if vertices are only between Begin and End, and no primitive or list stays open.
bool has_whole_primitives(const gl::Case& program) {
  Primitives primitives;
  for (const gl::Command& command : program.commands())
    if (!primitives.issue(command)) return false;
  return !primitives.is_open();
}

// Returns true if the program does not call list 0. By the reference page of glCallList, this has no effect,
// but libraries raise an error.
bool calls_names_only(const gl::Case& program) {
  return std::ranges::none_of(program.commands(), [](const gl::Command& command) {
    return command.entry == EntryPoint::CallList && gl::integer_of(command, 0) == 0;
  });
}

// Returns true if GetError follows each error before the next one. A list may raise several errors at once.
bool has_clear_errors(const gl::Case& program, const std::vector<std::vector<GLenum>>& errors) {
  bool pending = false;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const EntryPoint entry = program.commands()[i].entry;
    if (gl::emits_vertex(entry)) continue;
    if (entry == EntryPoint::GetError) {
      if (!errors[i].empty()) return false;
      pending = false;
    } else if (!errors[i].empty()) {
      const bool runs_list = entry == EntryPoint::CallList || entry == EntryPoint::CallLists;
      if (pending || (runs_list && errors[i].size() > 1)) return false;
      pending = true;
    }
  }
  return !pending;
}

}  // namespace

std::optional<Specified> specify_if_defined(const gl::Case& program, int max_eval_order) {
  if (!has_whole_primitives(program) || !calls_names_only(program)) return std::nullopt;
  Specified specified = specify(program, max_eval_order);
  if (std::ranges::count(specified.known, false) > 0) return std::nullopt;
  if (!has_clear_errors(program, specified.errors)) return std::nullopt;
  return specified;
}

gl::Case with_errors_asked_for(const gl::Case& program, int max_eval_order) {
  const Specified specified = specify(program, max_eval_order);
  const std::vector<gl::Command>& commands = program.commands();
  gl::Case asking(program.identity());
  for (std::size_t i = 0; i < commands.size(); ++i) {
    asking.add(commands[i]);
    const bool is_asked = i + 1 < commands.size() && commands[i + 1].entry == EntryPoint::GetError;
    if (!specified.errors[i].empty() && !is_asked) asking.GetError();
  }
  return asking;
}

}  // namespace evalcts::fuzz
