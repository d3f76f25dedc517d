// Writes recordings (format.h) of commands that `evalcts record` did not record.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::record {

// The text of a recording.
class RecordingWriter {
 public:
  // `program`: the command line of the recorded program. `others`: numbers of calls of commands that are only
  // counted, by their names with "gl".
  explicit RecordingWriter(std::vector<std::string> program,
                           std::map<std::string, std::uint64_t> others = {});

  // Chooses the thread of the following records; 0 at first.
  void thread(std::uint32_t number) { thread_ = number; }
  // The following commands of the thread are for this context; 0: none.
  void context(std::uint64_t number);
  void destroy(std::uint64_t number);
  void frame();
  // `is_complete`: false if the arrays that the command reads have an unknown size; they are left out.
  void command(const gl::Command& command, bool is_complete = true);

  // Counts a call of a command that is not recorded.
  void count(const std::string& name) { ++others_[name]; }

  // Returns the file.
  std::string text() const;

 private:
  void begin(std::size_t number);
  template <class T>
  void put(T value);

  std::vector<std::string> program_;
  std::map<std::string, std::uint64_t> others_;
  std::map<std::uint32_t, std::string> records_;  // by thread
  std::uint32_t thread_ = 0;
  std::uint64_t order_ = 0, frames_ = 0;
};

}  // namespace evalcts::record
