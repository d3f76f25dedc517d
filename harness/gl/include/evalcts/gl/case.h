// A case: a recorded list of GL commands with copies of the memory that their pointers refer to. Captures,
// controls, the call log, C programs, faults and random programs all replay cases; nothing else calls a GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts::gl {

// Element type of a client array.
enum class Scalar { kU8, kI8, kI32, kU32, kI64, kF32, kF64 };

template <class T>
constexpr Scalar scalar_of() {
  using U = std::remove_const_t<T>;
  if constexpr (std::is_same_v<U, float>) return Scalar::kF32;
  if constexpr (std::is_same_v<U, double>) return Scalar::kF64;
  if constexpr (std::is_same_v<U, std::int32_t>) return Scalar::kI32;
  if constexpr (std::is_same_v<U, std::uint32_t>) return Scalar::kU32;
  if constexpr (std::is_same_v<U, std::int64_t>) return Scalar::kI64;
  if constexpr (std::is_same_v<U, char> || std::is_same_v<U, std::int8_t>) return Scalar::kI8;
  return Scalar::kU8;
}
std::size_t size_of(Scalar type);

// Treatment of a client array after the command has returned.
enum class AfterCall {
  kKeep,       // unchanged until the case ends
  kOverwrite,  // filled with other values
  kUnmap,      // its pages are unmapped, so that access crashes
  kProtect,    // its pages become neither readable nor writable
};

// A client array that a command reads. Its last byte is followed by an unmapped page.
struct Input {
  Scalar type = Scalar::kU8;
  std::vector<std::byte> bytes;
  AfterCall after = AfterCall::kKeep;
  // Arrays of a case with the same slot (>= 0) and size share their memory, which is filled before each call.
  int slot = -1;
};

// An array that a command writes: `count` elements, followed by guard elements.
struct Output {
  Scalar type = Scalar::kU8;
  std::size_t count = 0;
};

// An array of strings (shader source, names of varyings).
struct Strings {
  std::vector<std::string> values;
};

// A result of an earlier command of the case: its returned value (element < 0), or an element of the array
// that it wrote.
struct ResultOf {
  int command = 0;
  int element = -1;
};

// An argument. Integers of every GL type are stored as 64 bits; the signature of the entry point determines
// their type.
using Value = std::variant<std::nullptr_t, std::int64_t, float, double, Input, Output, Strings, ResultOf>;

struct Command {
  EntryPoint entry;
  std::vector<Value> arguments;
};

// Returns the larger order of Map1 or Map2; 0 for any other command.
std::int64_t largest_order(const Command& command);

// Identifies a command of a case, to get its result from a Trace.
struct Ref {
  int index = -1;
};

template <class T>
struct OutputArray {
  std::size_t count;
};
// `out<GLfloat>(4)`: an array of four floats for a query to fill.
template <class T>
OutputArray<T> out(std::size_t count) {
  return {count};
}

// `array(values, AfterCall::kProtect)`: a client array and its treatment after the call.
template <class T>
Input array(std::span<const T> values, AfterCall after = AfterCall::kKeep) {
  Input input{scalar_of<T>(), std::vector<std::byte>(values.size_bytes()), after};
  if (!values.empty()) std::memcpy(input.bytes.data(), values.data(), values.size_bytes());
  return input;
}
template <class T>
Input array(const std::vector<T>& values, AfterCall after = AfterCall::kKeep) {
  return array(std::span<const T>(values), after);
}
template <class T>
Input array(std::initializer_list<T> values, AfterCall after = AfterCall::kKeep) {
  return array(std::span<const T>(values.begin(), values.size()), after);
}

// Returns a client array with a string and its terminator.
inline Input text(const std::string& characters) {
  return array(std::span<const char>(characters.c_str(), characters.size() + 1));
}

// Tells a case from the others of its test.
struct Identity {
  std::string text;  // stable from run to run, no commas at the ends
  bool is_control = false;

  Identity() = default;
  Identity(std::string name, bool control = false) : text(std::move(name)), is_control(control) {}
  Identity(const char* name) : text(name) {}
};

// Returns the identity of a control, which draws explicit vertices instead of evaluating, under the
// same state. If a control raises an error, crashes or hangs, the evaluators are not at fault, and the
// test is not-observable.
inline Identity control(const std::string& name) { return {"control: " + name, true}; }

class Case {
 public:
  Case() = default;
  // `identity` distinguishes the case from others of its test. It is stable from run to run and has no commas
  // at its ends.
  explicit Case(Identity identity) : identity_(std::move(identity)) {}

  // One method for each GL command: c.Map1f(target, u1, u2, stride, order, points). Arguments are
  // vectors, spans, array(...) or nullptr for pointers that a command reads, out<T>(count) for pointers that
  // it writes, and Ref or ResultOf for results of earlier commands.
#define GL_ENTRY(name, kinds)                                                                   \
  template <class... Arguments>                                                                 \
  Ref name(const Arguments&... arguments) {                                                     \
    return record(EntryPoint::name, static_cast<decltype(Table::name)>(nullptr), arguments...); \
  }
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY

  Ref add(Command command) {
    commands_.push_back(std::move(command));
    return {static_cast<int>(commands_.size()) - 1};
  }
  // Appends all commands of another case. Returns the number of earlier commands, by which the indices of
  // Refs to the appended commands grow.
  int append(const Case& other);

  const std::string& identity() const { return identity_.text; }
  bool is_control() const { return identity_.is_control; }
  void set_identity(Identity identity) { identity_ = std::move(identity); }
  // Returns an empty case with the same identity.
  Case without_commands() const { return Case(identity_); }
  const std::vector<Command>& commands() const { return commands_; }
  bool empty() const { return commands_.empty(); }

 private:
  // Returns an integer, a float, a double or a Value.
  template <class Parameter, class A>
  static auto value(const A& argument) {
    if constexpr (std::is_same_v<A, Ref>) {
      return Value(ResultOf{argument.index, -1});
    } else if constexpr (std::is_same_v<A, ResultOf> || std::is_same_v<A, Input> ||
                         std::is_same_v<A, Strings> || std::is_same_v<A, std::nullptr_t>) {
      return Value(argument);
    } else if constexpr (std::is_pointer_v<Parameter>) {
      return pointer(argument);
    } else if constexpr (std::is_same_v<Parameter, float>) {
      return static_cast<float>(argument);
    } else if constexpr (std::is_same_v<Parameter, double>) {
      return static_cast<double>(argument);
    } else {
      return static_cast<std::int64_t>(static_cast<Parameter>(argument));
    }
  }
  template <class T>
  static Value pointer(OutputArray<T> output) {
    return Output{scalar_of<T>(), output.count};
  }
  template <class T>
  static Value pointer(const std::vector<T>& values) {
    return array(values);
  }
  template <class T>
  static Value pointer(std::span<const T> values) {
    return array(values);
  }

  template <class Result, class... Parameters, class... Arguments>
  Ref record(EntryPoint entry, Result (*)(Parameters...), const Arguments&... arguments) {
    static_assert(sizeof...(Parameters) == sizeof...(Arguments),
                  "wrong number of arguments for this command");
    const Ref command = begin_command(entry, sizeof...(Arguments));
    (add_argument(value<Parameters>(arguments)), ...);
    return command;
  }
  // Not inline, because tests have thousands of commands.
  Ref begin_command(EntryPoint entry, std::size_t count_of_arguments);
  void add_argument(std::int64_t argument);
  void add_argument(float argument);
  void add_argument(double argument);
  void add_argument(Value argument);

  Identity identity_;
  std::vector<Command> commands_;
};

}  // namespace evalcts::gl
