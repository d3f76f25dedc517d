// Implements lifting: the control points are repeated for an order of 1 to 3 in the other direction, so that
// the surface is constant along it.
#include <evalcts/gl/lift.h>

#include <array>
#include <tuple>
#include <utility>

#include <evalcts/gl/numbers.h>

namespace evalcts::gl {
namespace {

constexpr std::int64_t kMap1First = GL_MAP1_COLOR_4, kMap1Last = GL_MAP1_VERTEX_4;
constexpr std::int64_t kMap2First = GL_MAP2_COLOR_4, kMap2Last = GL_MAP2_VERTEX_4;

std::int64_t other_dimension(std::int64_t token) {
  if (token >= kMap1First && token <= kMap1Last) return token - kMap1First + kMap2First;
  if (token >= kMap2First && token <= kMap2Last) return token - kMap2First + kMap1First;
  return token;
}

std::int64_t integer(const Value& value) { return std::get<std::int64_t>(value); }

// Returns a Map2 command whose control points are `copies` copies of the order*stride values of the Map1.
Command map2(const Command& map1, std::int64_t copies, bool along_v) {
  const auto& [target, u1, u2, stride, order, points] =
      std::tie(map1.arguments[0], map1.arguments[1], map1.arguments[2], map1.arguments[3], map1.arguments[4],
               map1.arguments[5]);
  const bool doubles = map1.entry == EntryPoint::Map1d;
  Value net = points;
  std::int64_t across = integer(stride);
  if (const auto* input = std::get_if<Input>(&points)) {
    Input repeated = *input;
    for (std::int64_t copy = 1; copy < copies; ++copy)
      repeated.bytes.insert(repeated.bytes.end(), input->bytes.begin(), input->bytes.end());
    // The stride across is the distance between the starts of consecutive copies.
    if (copies > 1) across = static_cast<std::int64_t>(input->bytes.size() / size_of(input->type));
    net = std::move(repeated);
  }
  Command command{doubles ? EntryPoint::Map2d : EntryPoint::Map2f, {other_dimension(integer(target))}};
  const std::vector<Value> along = {u1, u2, stride, order};
  const std::vector<Value> constant = {real(0, doubles), real(1, doubles), across, copies};
  for (const auto* direction : along_v ? std::array{&constant, &along} : std::array{&along, &constant})
    command.arguments.insert(command.arguments.end(), direction->begin(), direction->end());
  command.arguments.push_back(std::move(net));
  return command;
}

Command eval_coord2(double along, bool doubles, bool array_form, bool along_v) {
  const std::vector<double> at = along_v ? std::vector{kAcross, along} : std::vector{along, kAcross};
  if (array_form)
    return {doubles ? EntryPoint::EvalCoord2dv : EntryPoint::EvalCoord2fv, {reals(at, doubles)}};
  return {doubles ? EntryPoint::EvalCoord2d : EntryPoint::EvalCoord2f,
          {real(at[0], doubles), real(at[1], doubles)}};
}

}  // namespace

GLenum in_two_dimensions(GLenum token) {
  return token >= kMap1First && token <= kMap1Last ? static_cast<GLenum>(other_dimension(token)) : token;
}

Case lift(const Case& script, bool along_v) {
  Case lifted = script.without_commands();
  std::int64_t maps = 0;
  for (const Command& command : script.commands()) {
    switch (command.entry) {
      case EntryPoint::Map1f:
      case EntryPoint::Map1d:
        lifted.add(map2(command, 1 + maps++ % 3, along_v));
        break;
      case EntryPoint::EvalCoord1f:
      case EntryPoint::EvalCoord1d:
        lifted.add(eval_coord2(number(command.arguments[0]), command.entry == EntryPoint::EvalCoord1d, false,
                               along_v));
        break;
      case EntryPoint::EvalCoord1fv:
      case EntryPoint::EvalCoord1dv:
        lifted.add(eval_coord2(elements(std::get<Input>(command.arguments[0])).at(0),
                               command.entry == EntryPoint::EvalCoord1dv, true, along_v));
        break;
      case EntryPoint::Enable:
      case EntryPoint::Disable:
      case EntryPoint::IsEnabled:
        lifted.add({command.entry, {other_dimension(integer(command.arguments[0]))}});
        break;
      default:
        lifted.add(command);
    }
  }
  return lifted;
}

}  // namespace evalcts::gl
