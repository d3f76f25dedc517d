// Tracks the evaluator state of a context by the last command that set each part of it.
#include "state.h"

#include <algorithm>
#include <cstring>

#include <evalcts/gl/roles.h>
#include <evalcts/gl/targets.h>

namespace evalcts::record {
namespace {

constexpr int kMostNesting = 64;  // MAX_LIST_NESTING

std::uint64_t steps(const gl::Command& command, std::size_t first) {
  const std::int64_t count = gl::integer_of(command, first + 1) - gl::integer_of(command, first) + 1;
  return count > 0 ? static_cast<std::uint64_t>(count) : 0;
}

template <class T>
std::vector<GLuint> names_in(const gl::Input& input) {
  std::vector<GLuint> names;
  for (std::size_t at = 0; at + sizeof(T) <= input.bytes.size(); at += sizeof(T)) {
    T name;
    std::memcpy(&name, &input.bytes[at], sizeof name);
    names.push_back(static_cast<GLuint>(static_cast<std::int64_t>(name)));
  }
  return names;
}

// Returns the offsets of lists in the array of CallLists.
std::vector<GLuint> offsets_in(const gl::Input& input, std::int64_t type) {
  switch (type) {
    case GL_BYTE:
      return names_in<std::int8_t>(input);
    case GL_SHORT:
      return names_in<std::int16_t>(input);
    case GL_UNSIGNED_SHORT:
      return names_in<std::uint16_t>(input);
    case GL_INT:
      return names_in<std::int32_t>(input);
    case GL_UNSIGNED_INT:
      return names_in<std::uint32_t>(input);
    case GL_FLOAT:
      return names_in<float>(input);
    default:
      break;
  }
  const std::size_t size = type == GL_2_BYTES ? 2 : type == GL_3_BYTES ? 3 : type == GL_4_BYTES ? 4 : 1;
  std::vector<GLuint> names;
  for (std::size_t at = 0; at + size <= input.bytes.size(); at += size) {
    GLuint name = 0;
    for (std::size_t i = 0; i < size; ++i) name = name << 8 | std::to_integer<GLuint>(input.bytes[at + i]);
    names.push_back(name);
  }
  return names;
}

bool is_capability_of_evaluators(std::int64_t name) {
  return std::ranges::count(gl::all_caps(), static_cast<GLenum>(name)) > 0;
}

// Returns the attribute groups that contain a part of the state.
GLbitfield groups_of(const std::string& stem) {
  if (stem == "Enable") return GL_EVAL_BIT | GL_ENABLE_BIT;
  if (stem.starts_with("MapGrid")) return GL_EVAL_BIT;
  if (stem == "ListBase") return GL_LIST_BIT;
  if (stem == "ActiveTexture") return GL_TEXTURE_BIT;
  return stem.starts_with("Map") ? 0 : GL_CURRENT_BIT;  // control points belong to no group
}

gl::Command with_numbers(gl::EntryPoint entry, std::vector<std::int64_t> numbers) {
  return {entry, {numbers.begin(), numbers.end()}};
}

}  // namespace

void Drawing::add(const Drawing& other) {
  vertices += other.vertices;
  concerns_evaluators = concerns_evaluators || other.concerns_evaluators;
}

std::optional<State::Key> State::key_of(const gl::Command& command) {
  using gl::EntryPoint;
  const std::string stem = gl::stem_of(command.entry);
  switch (gl::role_of(command.entry)) {
    case gl::Role::kMap:
      return Key{stem, gl::integer_of(command, 0)};
    case gl::Role::kMapGrid:
      return Key{stem, 0};
    case gl::Role::kCurrentValue:
      if (stem == "MultiTexCoord") return Key{"TexCoord", gl::integer_of(command, 0)};
      if (stem == "TexCoord") return Key{stem, GL_TEXTURE0};
      return Key{stem, 0};
    default:
      break;
  }
  if (command.entry == EntryPoint::Enable || command.entry == EntryPoint::Disable) {
    const std::int64_t capability = gl::integer_of(command, 0);
    if (!is_capability_of_evaluators(capability)) return {};
    return Key{"Enable", capability};
  }
  if (command.entry == EntryPoint::ListBase || command.entry == EntryPoint::ActiveTexture)
    return Key{stem, 0};
  return {};
}

Drawing State::drawing_of(const gl::Command& command) const {
  using gl::EntryPoint;
  const gl::Role role = gl::role_of(command.entry);
  const auto mode = static_cast<GLenum>(gl::integer_of(command, 0));
  Drawing drawing;
  drawing.concerns_evaluators = gl::is_evaluation(command.entry) || role == gl::Role::kMap ||
                                role == gl::Role::kMapGrid || role == gl::Role::kGetMap ||
                                (command.entry == EntryPoint::IsEnabled && is_capability_of_evaluators(mode));
  if (gl::emits_vertex(command.entry)) drawing.vertices = 1;
  if (command.entry == EntryPoint::EvalMesh1) drawing.vertices = steps(command, 1);
  if (command.entry == EntryPoint::EvalMesh2) drawing.vertices = 2 * steps(command, 1) * steps(command, 3);
  for (const GLuint name : called_lists(command))
    if (const auto list = lists_.find(name); list != lists_.end()) drawing.add(list->second->drawing);
  return drawing;
}

std::size_t State::control_values(GLenum target) const {
  for (const char* const stem : {"Map1", "Map2"})
    if (const auto part = parts_.find({stem, target}); part != parts_.end()) {
      const gl::Command& map = part->second.command;
      const std::int64_t values =
          4 * gl::integer_of(map, 4) * (map.arguments.size() > 6 ? gl::integer_of(map, 8) : 1);
      return static_cast<std::size_t>(std::max<std::int64_t>(values, 0));
    }
  return 0;
}

std::vector<GLuint> State::called_lists(const gl::Command& command) const {
  if (command.entry == gl::EntryPoint::CallList) return {static_cast<GLuint>(gl::integer_of(command, 0))};
  const auto* const array = command.entry == gl::EntryPoint::CallLists && command.arguments.size() == 3
                                ? std::get_if<gl::Input>(&command.arguments[2])
                                : nullptr;
  if (!array) return {};
  std::vector<GLuint> names = offsets_in(*array, gl::integer_of(command, 1));
  const auto base = parts_.find({"ListBase", 0});
  for (GLuint& name : names)
    if (base != parts_.end()) name += static_cast<GLuint>(gl::integer_of(base->second.command, 0));
  return names;
}

void State::apply(const gl::Command& command, const Accepts& accepts) {
  using gl::EntryPoint;
  if (command.entry == EntryPoint::NewList && !is_inside_ && !compiled_) {
    compiled_ = List{static_cast<GLuint>(gl::integer_of(command, 0)),
                     gl::integer_of(command, 1) == GL_COMPILE_AND_EXECUTE};
  } else if (command.entry == EntryPoint::EndList && !is_inside_ && compiled_) {
    lists_[compiled_->name] = std::make_shared<const List>(std::move(*compiled_));
    compiled_.reset();
  } else if (command.entry != EntryPoint::NewList && command.entry != EntryPoint::EndList) {
    const bool is_compiled =
        compiled_ && !gl::asks(command.entry) && command.entry != EntryPoint::DeleteLists;
    if (is_compiled) {
      compiled_->drawing.add(drawing_of(command));
      compiled_->commands.push_back(command);
    }
    if (!is_compiled || compiled_->is_executed) execute(command, accepts, 0);
  }
}

void State::execute(const gl::Command& command, const Accepts& accepts, int depth) {
  using gl::EntryPoint;
  if (command.entry == EntryPoint::CallList || command.entry == EntryPoint::CallLists) {
    if (depth < kMostNesting)
      for (const GLuint name : called_lists(command))
        if (const auto list = lists_.find(name); list != lists_.end())
          for (const gl::Command& each : list->second->commands) execute(each, accepts, depth + 1);
    return;
  }
  const gl::Role role = gl::role_of(command.entry);
  if (gl::emits_vertex(command.entry) || gl::is_evaluation(command.entry) || gl::asks(command.entry)) return;
  if (role != gl::Role::kCurrentValue && !accepts(command)) return;
  if (command.entry == EntryPoint::Begin) is_inside_ = true;
  if (command.entry == EntryPoint::End) is_inside_ = false;
  if (command.entry == EntryPoint::DeleteLists)
    for (std::int64_t i = 0, first = gl::integer_of(command, 0); i < gl::integer_of(command, 1); ++i)
      lists_.erase(static_cast<GLuint>(first + i));
  if (command.entry == EntryPoint::PushAttrib) stack_.push_back({command, parts_});
  if (command.entry == EntryPoint::PopAttrib) pop();
  if (const std::optional<Key> key = key_of(command)) parts_.insert_or_assign(*key, Part{command, time_++});
}

void State::pop() {
  if (stack_.empty()) return;
  const Pushed pushed = std::move(stack_.back());
  stack_.pop_back();
  const auto mask = static_cast<GLbitfield>(gl::integer_of(pushed.command, 0));
  const auto is_restored = [&](const auto& part) { return (groups_of(part.first.first) & mask) != 0; };
  std::erase_if(parts_, is_restored);
  for (const auto& part : pushed.before)
    if (is_restored(part)) parts_.insert(part);
}

void State::collect_lists(const std::vector<gl::Command>& commands, std::vector<GLuint>& called) const {
  for (const gl::Command& command : commands)
    for (const GLuint name : called_lists(command)) {
      const auto list = lists_.find(name);
      if (list == lists_.end() || std::ranges::count(called, name) > 0) continue;
      called.push_back(name);
      collect_lists(list->second->commands, called);
    }
}

gl::Case State::commands_before(const std::vector<gl::Command>& following) const {
  gl::Case before;
  std::vector<GLuint> called;
  collect_lists(following, called);
  for (const GLuint name : called) {
    before.add(with_numbers(gl::EntryPoint::NewList, {name, GL_COMPILE}));
    for (const gl::Command& command : lists_.at(name)->commands) before.add(command);
    before.add(with_numbers(gl::EntryPoint::EndList, {}));
  }
  // Maps can be defined only while unit 0 is active (EV-MAP1-ERR-ACTIVETEX).
  std::int64_t active = GL_TEXTURE0;
  const auto activate = [&](std::int64_t unit) {
    if (unit != active) before.add(with_numbers(gl::EntryPoint::ActiveTexture, {unit}));
    active = unit;
  };
  const Parts* made = nullptr;
  const auto make = [&](const Parts& parts) {
    std::int64_t unit = GL_TEXTURE0;
    for (const auto& [key, part] : parts) {
      if (part.command.entry == gl::EntryPoint::ActiveTexture) {
        unit = gl::integer_of(part.command, 0);
      } else if (!made || !made->contains(key) || made->at(key).time != part.time) {
        if (gl::role_of(part.command.entry) == gl::Role::kMap) activate(GL_TEXTURE0);
        before.add(part.command);
      }
    }
    activate(unit);
    made = &parts;
  };
  for (const Pushed& pushed : stack_) {
    make(pushed.before);
    before.add(pushed.command);
  }
  make(parts_);
  return before;
}

}  // namespace evalcts::record
