// The evaluator state of a context, as the commands that made it. A program that begins in the middle of a
// recording begins with these commands.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::record {

// The effect of commands when they are executed.
struct Drawing {
  std::uint64_t vertices = 0;        // an upper bound
  bool concerns_evaluators = false;  // evaluates, defines maps or grids, or asks for them

  void add(const Drawing& other);
};

class State {
 public:
  // Executes a command on a context, which has no display lists, and returns true if it raises no error.
  using Accepts = std::function<bool(const gl::Command&)>;
  // Takes the effect of a command. What it executes, possibly the commands of a list, is given to `accepts`.
  void apply(const gl::Command& command, const Accepts& accepts);
  Drawing drawing_of(const gl::Command& command) const;

  // Returns true if no primitive is open and no display list is compiled.
  bool is_neutral() const { return !is_inside_ && !compiled_; }
  bool is_compiling() const { return compiled_.has_value(); }
  bool executes() const { return !compiled_ || compiled_->is_executed; }
  // Returns an upper bound for the number of values of the control points of a map; 0 in the initial state.
  std::size_t control_values(GLenum target) const;

  // Returns the commands that make this state, which is neutral, from the initial state. Display lists are
  // left out unless `following` or the lists that it calls call them.
  gl::Case commands_before(const std::vector<gl::Command>& following) const;

 private:
  // A part of the state: the stem of its commands, and a target, capability or texture unit.
  using Key = std::pair<std::string, std::int64_t>;
  struct Part {
    gl::Command command;  // the last one that set it
    std::uint64_t time;   // number of parts that were set before
  };
  using Parts = std::map<Key, Part>;  // those that are not in the initial state
  struct Pushed {
    gl::Command command;
    Parts before;
  };
  struct List {
    GLuint name = 0;
    bool is_executed = false;  // when it is compiled
    std::vector<gl::Command> commands = {};
    Drawing drawing = {};
  };

  static std::optional<Key> key_of(const gl::Command& command);
  void execute(const gl::Command& command, const Accepts& accepts, int depth);
  void pop();
  std::vector<GLuint> called_lists(const gl::Command& command) const;
  void collect_lists(const std::vector<gl::Command>& commands, std::vector<GLuint>& called) const;

  Parts parts_;
  std::uint64_t time_ = 0;
  std::vector<Pushed> stack_;
  std::map<GLuint, std::shared_ptr<const List>> lists_;  // shared by the copies of a state
  std::optional<List> compiled_;
  bool is_inside_ = false;
};

}  // namespace evalcts::record
