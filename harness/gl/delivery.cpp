#include "harness/gl/delivery.h"

#include <utility>

namespace evalcts::gl {
namespace {

double number(const Value& value) {
  if (const auto* single = std::get_if<float>(&value)) return *single;
  return std::get<double>(value);
}

Value real(double value, bool as_double) {
  if (as_double) return value;
  return static_cast<float>(value);
}

std::vector<double> elements(const Input& input) {
  std::vector<double> values(input.bytes.size() / size_of(input.type));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::byte* const bytes = input.bytes.data() + i * size_of(input.type);
    if (input.type == Scalar::f32) {
      float single = 0;
      std::memcpy(&single, bytes, sizeof single);
      values[i] = single;
    } else {
      std::memcpy(&values[i], bytes, sizeof values[i]);
    }
  }
  return values;
}

Input reals(const std::vector<double>& values, bool as_double) {
  return as_double ? array(values) : array(std::vector<float>(values.begin(), values.end()));
}

Command map1(const Command& command, bool doubles) {
  Command delivered = command;
  delivered.entry = doubles ? EntryPoint::Map1d : EntryPoint::Map1f;
  for (const std::size_t domain : {1u, 2u})
    delivered.arguments[domain] = real(number(command.arguments[domain]), doubles);
  if (const auto* points = std::get_if<Input>(&command.arguments[5])) {
    Input converted = reals(elements(*points), doubles);
    converted.after = points->after;
    converted.slot = points->slot;
    delivered.arguments[5] = std::move(converted);
  }
  return delivered;
}

Command eval_coord1(double u, bool doubles, bool arrays) {
  Command command;
  if (arrays) {
    command.entry = doubles ? EntryPoint::EvalCoord1dv : EntryPoint::EvalCoord1fv;
    command.arguments.emplace_back(reals({u}, doubles));
  } else {
    command.entry = doubles ? EntryPoint::EvalCoord1d : EntryPoint::EvalCoord1f;
    command.arguments.push_back(real(u, doubles));
  }
  return command;
}

}  // namespace

Case Delivery::apply(const Case& script) const {
  Case delivered(script.identity());
  for (const Command& command : script.commands()) {
    switch (command.entry) {
      case EntryPoint::Map1f:
      case EntryPoint::Map1d:
        delivered.add(map1(command, doubles));
        break;
      case EntryPoint::EvalCoord1f:
      case EntryPoint::EvalCoord1d:
        delivered.add(eval_coord1(number(command.arguments[0]), doubles, arrays));
        break;
      case EntryPoint::EvalCoord1fv:
      case EntryPoint::EvalCoord1dv:
        delivered.add(eval_coord1(elements(std::get<Input>(command.arguments[0])).at(0), doubles, arrays));
        break;
      default:
        delivered.add(command);
    }
  }
  return delivered;
}

const std::vector<Delivery>& deliveries() {
  static const std::vector<Delivery> all = {{"EvalCoord1f", false, false},
                                            {"EvalCoord1fv", false, true},
                                            {"EvalCoord1d", true, false},
                                            {"EvalCoord1dv", true, true}};
  return all;
}

}  // namespace evalcts::gl
