// The event Crashed as a line, built without allocating memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace evalcts {

class CrashLine {
 public:
  // Builds tables, which is not allowed when a process crashes.
  static void prepare();

  // Begins the line with the GL command in flight.
  CrashLine();
  // Adds a frame, the innermost one first: "libGL.so.1 glGetMapiv+0x2c", or "libGL.so.1+0x5d2c" without a
  // name of a function. `offset`: from the function, or else from the module. An empty `module`: code of no
  // file.
  void add_frame(std::string_view module, std::string_view function, std::uint64_t offset);
  // Ends the line, and returns it.
  std::string_view finish();

 private:
  void add(std::string_view text);
  void add_text(std::string_view text);
  void add_number(std::uint64_t value, int base);

  std::array<char, 4096> text_{};
  std::size_t length_ = 0;
  bool has_frames_ = false;
};

}  // namespace evalcts
