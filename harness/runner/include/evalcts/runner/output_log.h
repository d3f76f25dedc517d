// A pipe between a child process and its log, so that a library that floods its output fills no disk, and so
// that its last words are known where the disk is full.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace evalcts {

// Bytes that are kept of what comes before the first test, and of each test. A test begins with the line in
// which GoogleTest says so.
inline constexpr std::size_t kMostPrinted = 64 * 1024;
// Bytes that are remembered for messages about a process that does not start.
inline constexpr std::size_t kMostRemembered = 16 * 1024;

class OutputLog {
 public:
  // `log`: the file to append to. Throws CannotWrite.
  explicit OutputLog(const std::filesystem::path& log);
  ~OutputLog();
  OutputLog(const OutputLog&) = delete;
  OutputLog& operator=(const OutputLog&) = delete;

  // The end for the child. Close it here once the child has its own.
  int writer() const { return writer_; }
  void close_writer();

  // A descriptor to wait for; negative once nobody writes any more.
  int reader() const { return reader_; }
  // Takes in what has come, without waiting for more. What cannot be written is lost: nothing depends on it.
  void take();
  // The same, for the last time: nobody is expected to write any more.
  void finish();

  // The latest whole line that says something about evalcts ("evalcts: ...").
  const std::string& own_words() const { return own_words_; }
  // The first kMostRemembered bytes, in whole lines.
  const std::string& beginning() const { return beginning_; }

 private:
  void take_line(const std::string& line);
  void append(const std::string& text) const;
  void say_what_is_left_out();

  int reader_ = -1, writer_ = -1, log_ = -1;
  std::string partial_;  // the beginning of a line
  std::size_t kept_ = 0, left_out_ = 0;
  std::string own_words_, beginning_;
};

}  // namespace evalcts
