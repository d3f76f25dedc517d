// Runs a case on a table of entry points and records the answers of its commands.
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

// Number of guard elements after each array that a command fills. They must not change.
inline constexpr std::size_t kGuardElements = 16;

// Thrown if the implementation under test does not provide a command, so that its effects cannot be observed.
struct MissingEntryPoint : std::runtime_error {
  explicit MissingEntryPoint(EntryPoint missing);
  EntryPoint entry;
};

// The answers of the commands of an executed case.
class Trace {
 public:
  // The value that a command returned (enumerant, boolean, name); 0 for commands that return nothing.
  std::int64_t result(Ref command) const;
  GLenum error(Ref get_error) const { return static_cast<GLenum>(result(get_error)); }
  // Returns the result of GetString; empty if it was null.
  const std::string& text(Ref get_string) const;

  // Returns the whole array that was passed to the command to be filled, without guard elements. T must be
  // the element type. Throws std::logic_error if the command writes no array.
  template <class T>
  std::vector<T> values(Ref command) const {
    const Output& written = output(command);
    std::vector<T> values(written.count);
    std::memcpy(values.data(), written.bytes.data(), written.count * sizeof(T));
    return values;
  }
  // Returns the number of leading elements that the command may have written: one more than the index of the
  // last element, guard elements included, that no longer contains the filler.
  std::size_t written(Ref command) const;
  // Returns the number of elements of the array.
  std::size_t capacity(Ref command) const { return output(command).count; }
  Scalar type(Ref command) const { return output(command).type; }
  bool has_output(Ref command) const;
  // Returns the bytes of the array, without guard elements.
  std::vector<std::byte> bytes(Ref command) const;
  // Returns true if two commands have the same answers, bit for bit: returned value, text and written arrays.
  bool same(Ref a, const Trace& other, Ref b) const;

  // Returns the errors that remained after the last command, drained outside Begin/End (at most 16).
  const std::vector<GLenum>& left_over_errors() const { return left_over_errors_; }

  std::size_t size() const { return results_.size(); }

  // Returns a trace with the answers of these commands only, renumbered from 0 in the given order. A negative
  // position gives an empty answer.
  Trace of(const std::vector<int>& commands) const;

  // Replace an answer. Judging the changed trace shows whether a failure depends on this answer.
  void replace_result(Ref command, std::int64_t value);
  void replace_element(Ref command, std::size_t element, double value);

 private:
  friend class Player;
  struct Output {
    Scalar type;
    std::size_t count;
    std::vector<std::byte> bytes;  // count elements and the guard elements
  };
  struct Result {
    std::int64_t value = 0;
    std::string text;
    std::optional<Output> output;
  };
  const Output& output(Ref command) const;

  std::vector<Result> results_;
  std::vector<GLenum> left_over_errors_;
};

// Runs all commands of the case in order on the current context. No other commands are issued, except
// GetError after the last one; inside Begin/End, GetError would itself raise an error. Throws
// MissingEntryPoint before the first command if an entry point of the case is null in the table. `after_each`
// is called after each command with its position. `set_current` makes the context current in the calling
// thread, or leaves none current there; needed if the table has MoveToThreadEVALCTS. The default
// floating-point environment is restored afterwards, because the judge needs it.
Trace play(const Case& script, const Table& table,
           const std::function<void(std::size_t position)>& after_each = {},
           const std::function<void(bool is_current)>& set_current = {});

}  // namespace evalcts::gl
