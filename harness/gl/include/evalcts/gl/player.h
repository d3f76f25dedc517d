// Plays a case on a table of entry points and keeps what its commands answered.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Behind each array that a command fills: room that stays as it is.
inline constexpr std::size_t kGuardElements = 16;

// The implementation under test has no such command: what rests on it cannot be observed.
struct MissingEntryPoint : std::runtime_error {
  explicit MissingEntryPoint(EntryPoint missing);
  EntryPoint entry;
};

// What the commands of one played case answered.
class Trace {
 public:
  // The value that a command returned (enumerant, boolean, name); 0 for commands that return nothing.
  std::int64_t result(Ref command) const;
  GLenum error(Ref get_error) const { return static_cast<GLenum>(result(get_error)); }
  // What GetString returned; empty where it was null.
  const std::string& text(Ref get_string) const;

  // The array that the command was given to fill, whole, guard elements excluded. T must be the element type.
  template <class T>
  std::vector<T> values(Ref command) const {
    const Written& written = output(command);
    std::vector<T> values(written.count);
    std::memcpy(values.data(), written.bytes.data(), written.count * sizeof(T));
    return values;
  }
  // How many leading elements the command may have written: one more than the index of the last element
  // that no longer holds the filler, guard elements included.
  std::size_t written(Ref command) const;
  // How many elements the array has room for, and its bytes.
  std::size_t capacity(Ref command) const { return output(command).count; }
  Scalar type(Ref command) const { return output(command).type; }
  bool has_output(Ref command) const;
  // The array's bytes, guard elements excluded.
  std::vector<std::byte> bytes(Ref command) const;
  // Same answers, bit for bit: returned value, text and written arrays.
  bool same(Ref a, const Trace& other, Ref b) const;

  // Errors left behind after the last command, drained outside Begin/End (at most 16 of them).
  const std::vector<GLenum>& left_over_errors() const { return left_over_errors_; }

  std::size_t size() const { return results_.size(); }

  // The answers of these commands, which are numbered anew from 0.
  Trace of(const std::vector<int>& commands) const;

  // What would have been judged if the command had answered something else: finds the answer that a failure
  // rests on.
  void replace_result(Ref command, std::int64_t value);
  void replace_element(Ref command, std::size_t element, double value);

 private:
  friend class Player;
  struct Written {
    Scalar type;
    std::size_t count;
    std::vector<std::byte> bytes;  // count elements and the guard elements
  };
  struct Result {
    std::int64_t value = 0;
    std::string text;
    std::optional<Written> output;
  };
  const Written& output(Ref command) const;

  std::vector<Result> results_;
  std::vector<GLenum> left_over_errors_;
};

// Plays all commands of the case in order on the context that is current. The commands themselves are all
// that is issued, but for GetError after the last one (never between: inside Begin/End it would leave an
// error behind). Throws MissingEntryPoint before the first command if the table lacks one of them.
// `after_each` is called after each command, with its position. The floating-point environment is the default
// one afterwards, whatever the library makes of it: the judge computes in it.
Trace play(const Case& script, const Table& table,
           const std::function<void(std::size_t position)>& after_each = {});

}  // namespace evalcts::gl
