// Writes recordings for tests, by the description in record/format.h alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts {

// The text of a recording.
class RecordingFile {
 public:
  RecordingFile();

  // Append records of a thread, which begins a chunk of its own if the thread before was another one.
  void context(std::uint64_t number, std::uint32_t thread = 0);
  void destroy(std::uint64_t number);
  void frame();
  void command(const gl::Command& command);
  void commands(const gl::Case& script);
  // A Map1f whose array has an unknown size.
  void unknown_array();

  // Returns the file. `commands`: replaces the names of the commands in the header.
  std::string text() const;
  void write(const std::filesystem::path& file) const;

 private:
  struct Part {
    std::uint32_t thread;
    std::string records;
  };
  void begin(const std::string& name);
  template <class T>
  void put(T value);

  std::vector<Part> parts_ = {{0, ""}};
  std::uint64_t order_ = 0, frames_ = 0;
};

}  // namespace evalcts
