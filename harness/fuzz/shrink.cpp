// Shrinks programs: removes commands by delta debugging, then simplifies arguments one by one.
#include "shrink.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/numbers.h>
#include <evalcts/gl/roles.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/runner/delta_debugging.h>

namespace evalcts::fuzz {
namespace {

constexpr std::size_t kMostElements = 24;  // elements of larger arrays are not changed one by one

using gl::Command;
using gl::EntryPoint;

// A cause shows in many forms of a program, which the plainest form identifies. Each function
// `Command(Command)` below returns a plainer form of the command, or the command itself.

// Returns the coordinates of an EvalCoord command, at least two: 0 for those that it does not have.
std::vector<double> coordinates_of(const Command& command) {
  std::vector<double> coordinates;
  for (const gl::Value& argument : command.arguments)
    if (const auto* const input = std::get_if<gl::Input>(&argument))
      coordinates = gl::elements(*input);
    else if (!std::holds_alternative<std::nullptr_t>(argument))
      coordinates.push_back(gl::number(argument));
  coordinates.resize(std::max<std::size_t>(coordinates.size(), 2));
  return coordinates;
}

Command in_one_dimension(Command command) {
  using enum EntryPoint;
  // The commands for curves, and the arguments that they have.
  static const std::map<EntryPoint, std::pair<EntryPoint, std::vector<std::size_t>>> kForCurves = {
      {Enable, {Enable, {0}}},
      {Disable, {Disable, {0}}},
      {IsEnabled, {IsEnabled, {0}}},
      {GetMapfv, {GetMapfv, {0, 1, 2}}},
      {GetMapdv, {GetMapdv, {0, 1, 2}}},
      {GetMapiv, {GetMapiv, {0, 1, 2}}},
      {Map2f, {Map1f, {0, 1, 2, 3, 4, 9}}},
      {Map2d, {Map1d, {0, 1, 2, 3, 4, 9}}},
      {MapGrid2f, {MapGrid1f, {0, 1, 2}}},
      {MapGrid2d, {MapGrid1d, {0, 1, 2}}},
      {EvalCoord2f, {EvalCoord1f, {0}}},
      {EvalCoord2d, {EvalCoord1d, {0}}},
      {EvalCoord2fv, {EvalCoord1f, {0}}},
      {EvalCoord2dv, {EvalCoord1d, {0}}},
      {EvalPoint2, {EvalPoint1, {0}}},
      {EvalMesh2, {EvalMesh1, {0, 1, 2}}}};
  const auto found = kForCurves.find(command.entry);
  if (found == kForCurves.end()) return command;
  Command curve{found->second.first, {}};
  for (const std::size_t i : found->second.second) curve.arguments.push_back(command.arguments[i]);
  gl::Value& first = curve.arguments[0];
  auto* const token = std::get_if<std::int64_t>(&first);
  if (curve.entry == EvalCoord1f || curve.entry == EvalCoord1d) {
    first = gl::real(coordinates_of(command)[0], curve.entry == EvalCoord1d);
  } else if (curve.entry == EvalMesh1) {
    if (token && *token == GL_FILL) *token = GL_LINE;
  } else if (gl::parameter_kinds(curve.entry)[0] == 'e') {
    if (token && *token >= GL_MAP2_COLOR_4 && *token <= GL_MAP2_VERTEX_4)
      *token += GL_MAP1_COLOR_4 - GL_MAP2_COLOR_4;
  }
  return curve;
}

// Replaces commands that evaluate at a point by EvalCoord1f and EvalCoord2f.
Command as_coordinate(Command command) {
  const gl::Role role = gl::role_of(command.entry);
  if (role != gl::Role::kEvalCoord && role != gl::Role::kEvalPoint) return command;
  const std::vector<double> at =
      role == gl::Role::kEvalCoord ? coordinates_of(command) : std::vector<double>(2);
  const auto u = static_cast<float>(at[0]), v = static_cast<float>(at[1]);
  if (gl::dimension_of(command.entry) == 1) return {EntryPoint::EvalCoord1f, {u}};
  return {EntryPoint::EvalCoord2f, {u, v}};
}

Command as_points(Command command) {
  if (command.entry == EntryPoint::Begin) command.arguments[0] = std::int64_t{GL_POINTS};
  if (command.entry == EntryPoint::EvalMesh1 || command.entry == EntryPoint::EvalMesh2)
    command.arguments[0] = std::int64_t{GL_POINT};
  if (gl::role_of(command.entry) == gl::Role::kVertex) return {EntryPoint::Vertex3f, {0.0f, 0.0f, 0.0f}};
  return command;
}

gl::Case with_all(const gl::Case& program, Command (*plainer)(Command)) {
  gl::Case plain(program.identity());
  for (const Command& command : program.commands()) plain.add(plainer(command));
  return plain;
}

class Shrinker {
 public:
  Shrinker(gl::Case best, const InterestingnessTest& is_interesting, int most,
           const std::function<void(const gl::Case&)>& smaller)
      : best_(std::move(best)), is_interesting_(is_interesting), left_(most), smaller_(smaller) {}

  gl::Case shrink() {
    for (bool again = true; again && left_ > 0;) {
      again = remove_commands();
      for (const auto plainer : {in_one_dimension, as_coordinate, as_points})
        again = replace_all(plainer) || again;
      again = primitives_instead() || again;
      again = flush_instead() || again;
      again = simplify_arguments() || again;
    }
    return best_;
  }

 private:
  std::size_t size() const { return best_.commands().size(); }

  bool attempt(std::vector<Command> commands) {
    if (left_ <= 0) return false;
    --left_;
    gl::Case candidate(best_.identity());
    for (Command& command : commands) candidate.add(std::move(command));
    if (!is_interesting_(candidate)) return false;
    best_ = std::move(candidate);
    if (smaller_) smaller_(best_);
    return true;
  }

  // Removes runs of commands, then pairs that can only be removed together (Begin and End, PushAttrib and
  // PopAttrib, NewList and EndList with the calls of the list, a command and its GetError).
  bool remove_commands() {
    const std::size_t before = size();
    std::vector<Command> all = best_.commands();
    reduce(all, Direction::kBackwards, [&](const std::vector<Command>& rest) { return attempt(rest); });
    for (std::size_t first = 0; first < size() && left_ > 0; ++first)
      for (const std::size_t second : partners(first)) {
        std::vector<Command> commands = best_.commands();
        const Command opening = commands[first];
        commands.erase(commands.begin() + static_cast<std::ptrdiff_t>(second));
        commands.erase(commands.begin() + static_cast<std::ptrdiff_t>(first));
        if (opening.entry == EntryPoint::NewList)
          std::erase_if(commands, [&](const Command& command) { return calls_list_of(opening, command); });
        if (!attempt(std::move(commands))) continue;
        if (first > 0) --first;
        break;
      }
    return size() < before;
  }

  static bool calls_list_of(const Command& new_list, const Command& command) {
    if (command.entry != EntryPoint::CallList) return false;
    const auto* const made = std::get_if<std::int64_t>(&new_list.arguments[0]);
    const auto* const called = std::get_if<std::int64_t>(&command.arguments[0]);
    return made && called && *made == *called;
  }

  std::vector<std::size_t> partners(std::size_t first) const {
    constexpr std::pair<EntryPoint, EntryPoint> kPairs[] = {
        {EntryPoint::Begin, EntryPoint::End},
        {EntryPoint::PushAttrib, EntryPoint::PopAttrib},
        {EntryPoint::NewList, EntryPoint::EndList},
        {EntryPoint::ActiveTexture, EntryPoint::ActiveTexture}};
    const std::vector<Command>& commands = best_.commands();
    std::vector<std::size_t> found;
    for (const auto& [opening, closing] : kPairs) {
      if (commands[first].entry != opening) continue;
      for (std::size_t i = first + 1; i < commands.size() && found.size() < 3; ++i)
        if (commands[i].entry == closing) found.push_back(i);
    }
    if (found.empty() && first + 1 < commands.size() && commands[first + 1].entry == EntryPoint::GetError)
      found.push_back(first + 1);
    return found;
  }

  bool simplify_arguments() {
    bool any = false;
    for (std::size_t i = 0; i < size() && left_ > 0; ++i) {
      any = trim_points(i) || any;
      any = lower_order(i) || any;
      for (std::size_t k = 0; i < size() && k < best_.commands()[i].arguments.size(); ++k)
        any = simplify(i, k) || any;
    }
    return any;
  }

  bool replace(std::size_t i, Command command) {
    std::vector<Command> commands = best_.commands();
    commands[i] = std::move(command);
    return attempt(std::move(commands));
  }

  // Replaces each mesh by a vertex between Begin and End.
  bool primitives_instead() {
    bool any = false;
    for (std::size_t i = 0; i < size() && left_ > 0; ++i) {
      std::vector<Command> commands = best_.commands();
      const EntryPoint mesh = commands[i].entry;
      if (mesh != EntryPoint::EvalMesh1 && mesh != EntryPoint::EvalMesh2) continue;
      commands[i] = mesh == EntryPoint::EvalMesh1 ? Command{EntryPoint::EvalCoord1f, {0.0f}}
                                                  : Command{EntryPoint::EvalCoord2f, {0.0f, 0.0f}};
      const auto at = static_cast<std::ptrdiff_t>(i);
      commands.insert(commands.begin() + at + 1, {EntryPoint::End, {}});
      commands.insert(commands.begin() + at, {EntryPoint::Begin, {std::int64_t{GL_POINTS}}});
      any = attempt(std::move(commands)) || any;
    }
    return any;
  }

  // Replaces commands by Flush. Many commands contribute to a cause only because they make an implementation
  // draw its pending vertices, as Flush does.
  bool flush_instead() {
    bool any = false;
    for (const std::size_t count : {2u, 1u})
      for (std::size_t i = 0; i + count <= size() && left_ > 0; ++i) {
        std::vector<Command> commands = best_.commands();
        if (commands[i].entry == EntryPoint::Flush) continue;
        commands[i] = {EntryPoint::Flush, {}};
        const auto behind = commands.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        commands.erase(behind, behind + static_cast<std::ptrdiff_t>(count) - 1);
        any = attempt(std::move(commands)) || any;
      }
    return any;
  }

  // Replaces all commands that the function changes; if that fails, all from one command on; if that fails,
  // each command alone.
  bool replace_all(Command (*plainer)(Command)) {
    const std::vector<Command> before = best_.commands();
    std::vector<Command> after;
    for (const Command& command : before) after.push_back(plainer(command));
    const auto differs = [&](std::size_t i) { return gl::to_c(after[i]) != gl::to_c(before[i]); };
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (differs(i)) changed.push_back(i);
    if (changed.empty()) return false;
    if (attempt(after)) return true;
    if (changed.size() == 1) return false;
    for (std::size_t k = 1; k < changed.size(); ++k) {
      const auto from = static_cast<std::ptrdiff_t>(changed[k]);
      std::vector<Command> mixed(before.begin(), before.begin() + from);
      mixed.insert(mixed.end(), after.begin() + from, after.end());
      if (attempt(std::move(mixed))) return true;
    }
    bool any = false;
    for (const std::size_t i : changed) any = replace(i, after[i]) || any;
    return any;
  }

  // Removes what stands behind the last control point of a map, if its arguments are valid: a library may
  // read what a rejected command points to.
  bool trim_points(std::size_t i) {
    Command command = best_.commands()[i];
    if (gl::role_of(command.entry) != gl::Role::kMap) return false;
    const std::int64_t components = gl::components_of(static_cast<GLenum>(gl::integer_of(command, 0)));
    std::int64_t count = components;
    for (std::size_t stride = 3; stride + 1 < command.arguments.size(); stride += 4) {
      const std::int64_t step = gl::integer_of(command, stride), order = gl::integer_of(command, stride + 1);
      if (components == 0 || step < components || order < 1) return false;
      count += (order - 1) * step;
    }
    auto* const points = std::get_if<gl::Input>(&command.arguments.back());
    if (!points || points->bytes.size() <= static_cast<std::size_t>(count) * size_of(points->type))
      return false;
    points->bytes.resize(static_cast<std::size_t>(count) * size_of(points->type));
    return replace(i, std::move(command));
  }

  // Removes the last control point of a Map1 as often as possible.
  bool lower_order(std::size_t i) {
    bool any = false;
    for (;;) {
      Command command = best_.commands()[i];
      if (command.entry != EntryPoint::Map1f && command.entry != EntryPoint::Map1d) return any;
      auto& order = std::get<std::int64_t>(command.arguments[4]);
      auto* points = std::get_if<gl::Input>(&command.arguments[5]);
      const auto bytes =
          static_cast<std::size_t>(std::max<std::int64_t>(std::get<std::int64_t>(command.arguments[3]), 0)) *
          (points ? size_of(points->type) : 0);
      if (order < 2 || !points || points->bytes.size() <= bytes) return any;
      --order;
      points->bytes.resize(points->bytes.size() - bytes);
      if (!replace(i, std::move(command))) return any;
      any = true;
    }
  }

  static double rounded(double value) {
    return std::abs(value) < 8 ? std::trunc(value) + 0.0 : std::copysign(1.0, value);
  }

  bool simplify(std::size_t i, std::size_t k) {
    const gl::Value& value = best_.commands()[i].arguments[k];
    const auto with = [&](gl::Value simpler) {
      Command command = best_.commands()[i];
      command.arguments[k] = std::move(simpler);
      return replace(i, std::move(command));
    };
    const auto with_simpler = [&](auto now) {
      using Number = decltype(now);
      for (const Number simpler : {Number(0), Number(1), static_cast<Number>(rounded(now)), Number(0.5)}) {
        if (simpler == now) return false;
        if (with(simpler)) return true;
      }
      return false;
    };
    if (const auto* single = std::get_if<float>(&value)) {
      return with_simpler(*single);
    } else if (const auto* real = std::get_if<double>(&value)) {
      return with_simpler(*real);
    } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      if (gl::parameter_kinds(best_.commands()[i].entry)[k] != '.') return false;
      const std::int64_t now = *integer;
      for (const std::int64_t simpler : {std::int64_t{0}, std::int64_t{1}, now - 1}) {
        if (simpler == now || now < 0) return false;
        if (with(simpler)) return true;
      }
    } else if (const auto* input = std::get_if<gl::Input>(&value)) {
      return simplify_array(i, k, *input, with);
    }
    return false;
  }

  template <class With>
  bool simplify_array(std::size_t i, std::size_t k, const gl::Input& input, const With& with) {
    if (input.type == gl::Scalar::kF32) return simplify_elements<float>(i, k, input, with);
    if (input.type == gl::Scalar::kF64) return simplify_elements<double>(i, k, input, with);
    return false;
  }

  // Simplifies all elements at once, then one by one.
  template <class Real, class With>
  bool simplify_elements(std::size_t i, std::size_t k, const gl::Input& input, const With& with) {
    std::vector<Real> values(input.bytes.size() / sizeof(Real));
    std::memcpy(values.data(), input.bytes.data(), values.size() * sizeof(Real));
    std::vector<Real> simple = values;
    for (Real& value : simple) value = static_cast<Real>(rounded(value));
    for (const std::vector<Real>& all :
         {std::vector<Real>(values.size(), 0), std::vector<Real>(values.size(), 1), simple})
      if (all != values && with(gl::array(all))) {
        values = all;
        if (std::ranges::all_of(values, [](Real value) { return value == 0; })) return true;
        break;
      }
    bool any = false;
    if (values.size() > kMostElements) return any;
    for (std::size_t e = 0; e < values.size() && left_ > 0; ++e)
      for (const Real simpler : {Real(0), Real(1), static_cast<Real>(rounded(values[e]))}) {
        if (simpler == values[e]) break;
        std::vector<Real> changed = values;
        changed[e] = simpler;
        Command command = best_.commands()[i];
        command.arguments[k] = gl::array(changed);
        if (!replace(i, std::move(command))) continue;
        values = std::move(changed);
        any = true;
        break;
      }
    return any;
  }

  gl::Case best_;
  const InterestingnessTest& is_interesting_;
  int left_;
  const std::function<void(const gl::Case&)>& smaller_;
};

}  // namespace

gl::Case shrink(const gl::Case& program, const InterestingnessTest& is_interesting, int most,
                const std::function<void(const gl::Case&)>& smaller) {
  return Shrinker(program, is_interesting, most, smaller).shrink();
}

std::vector<gl::Case> forms_of(const gl::Case& program) {
  const auto as_coordinates = [](Command command) { return as_points(as_coordinate(std::move(command))); };
  return {program, with_all(program, as_coordinates),
          with_all(with_all(program, in_one_dimension), as_coordinates)};
}

}  // namespace evalcts::fuzz
