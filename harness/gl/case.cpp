// Joins cases, and determines properties of their commands and element types.
#include <evalcts/gl/case.h>
#include <algorithm>

namespace evalcts::gl {

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::kU8:
    case Scalar::kI8:
      return 1;
    case Scalar::kI32:
    case Scalar::kU32:
    case Scalar::kF32:
      return 4;
    case Scalar::kI64:
    case Scalar::kF64:
      return 8;
  }
  return 1;
}

Ref Case::begin_command(EntryPoint entry, std::size_t count_of_arguments) {
  commands_.push_back({entry, {}});
  commands_.back().arguments.reserve(count_of_arguments);
  return {static_cast<int>(commands_.size()) - 1};
}

void Case::add_argument(std::int64_t argument) { commands_.back().arguments.emplace_back(argument); }
void Case::add_argument(float argument) { commands_.back().arguments.emplace_back(argument); }
void Case::add_argument(double argument) { commands_.back().arguments.emplace_back(argument); }
void Case::add_argument(Value argument) { commands_.back().arguments.push_back(std::move(argument)); }

int Case::append(const Case& other) {
  const int shift = static_cast<int>(commands_.size());
  for (Command command : other.commands_) {
    for (Value& value : command.arguments)
      if (auto* result = std::get_if<ResultOf>(&value)) result->command += shift;
    commands_.push_back(std::move(command));
  }
  return shift;
}

std::int64_t largest_order(const Command& command) {
  const auto order = [&](std::size_t argument) {
    return std::get<std::int64_t>(command.arguments[argument]);
  };
  switch (command.entry) {
    case EntryPoint::Map1f:
    case EntryPoint::Map1d:
      return order(4);
    case EntryPoint::Map2f:
    case EntryPoint::Map2d:
      return std::max(order(4), order(8));
    default:
      return 0;
  }
}

}  // namespace evalcts::gl
