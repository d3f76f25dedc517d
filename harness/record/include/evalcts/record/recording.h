// Reads a recording: the evaluator commands that a program made, by context.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::record {

// Thrown if a file is not a recording, or one of another version. what() says what to do.
struct BadRecording : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns true if the file begins like a recording of any version.
bool is_recording(const std::filesystem::path& file);

// A command that was counted, or left out.
struct Counted {
  std::string name;  // with "gl"
  std::uint64_t times = 0;
};

// Returns true if each array that the command reads has all elements that it reads, or is null. False for
// arrays of an unknown size.
bool has_all_elements(const gl::Command& command);

class Recording {
 public:
  // Maps the file into memory, which must not change while the object lives. Throws BadRecording.
  explicit Recording(const std::filesystem::path& file);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  // The command line of the recorded program.
  const std::vector<std::string>& program() const { return program_; }
  // The number of contexts that the program made current.
  std::size_t contexts() const { return contexts_.size(); }
  // The recorded commands, most frequent first.
  const std::vector<Counted>& commands() const { return commands_; }
  // The number of frames that ended.
  std::uint64_t frames() const { return frames_; }
  // Commands of other parts of the GL, which were only counted, most frequent first.
  const std::vector<Counted>& others() const { return others_; }
  // Commands that cannot be replayed: this version does not know them, or they read an array of unknown size.
  const std::vector<Counted>& left_out() const { return left_out_; }
  // A sentence about the missing part of the file; empty if nothing is missing.
  const std::string& problem() const { return problem_; }

  // Calls `command` with each command of a context, in order, and `end_of_frame` behind each frame. If no
  // buffers were ever swapped, Flush and Finish end a frame.
  void read(std::size_t context, const std::function<void(gl::Command)>& command,
            const std::function<void()>& end_of_frame) const;

 private:
  struct Kind;      // of commands
  struct Segment;   // records of a thread while a context is current
  struct RecordAt;  // a record in the file
  void read_header();
  void find_segments();
  RecordAt record_at(std::uint64_t offset, std::uint64_t end) const;
  bool is_replayable(const RecordAt& record) const;
  gl::Command command_of(const RecordAt& record) const;

  const std::byte* data_ = nullptr;
  std::uint64_t size_ = 0;
  std::vector<std::string> program_;
  std::vector<Kind> kinds_;
  std::vector<std::vector<Segment>> contexts_;
  std::vector<Counted> commands_, others_, left_out_;
  std::string problem_;
  std::uint64_t frames_ = 0;
};

}  // namespace evalcts::record
