// A pipe between a child process and its log. It limits the log, so that a library that prints without end
// does not fill the disk.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace evalcts {

// Maximum number of bytes that the log keeps of the output before the first test, and of the output of each
// test. A test begins with GoogleTest's line "[ RUN      ] ...".
inline constexpr std::size_t kMostPrinted = 64 * 1024;
// Maximum number of bytes that are remembered for messages about a process that does not start.
inline constexpr std::size_t kMostRemembered = 16 * 1024;

class OutputLog {
 public:
  // `log`: the file to append to. Throws CannotWrite.
  explicit OutputLog(const std::filesystem::path& log);
  ~OutputLog();
  OutputLog(const OutputLog&) = delete;
  OutputLog& operator=(const OutputLog&) = delete;

  // Returns the write end, which the child inherits. Close it with close_writer() after the
  // child has started.
  int writer() const { return writer_; }
  void close_writer();

  // Returns the read end, for poll(); negative once all writers have closed their ends.
  int reader() const { return reader_; }
  // Copies the available output to the log, without waiting for more. Errors of writing are ignored, because
  // the log is only for people.
  void take();
  // Copies the rest of the output, after the last writer has ended.
  void finish();

  // Returns up to kMostRemembered bytes from the start of the output, in complete lines.
  const std::string& first_lines() const { return first_lines_; }

 private:
  void take_line(const std::string& line);
  void flush();
  void say_what_is_left_out();

  int reader_ = -1, writer_ = -1, log_ = -1;
  std::string partial_;  // the beginning of a line whose end has not arrived yet
  // The output of the current test, which is written as a whole, because several processes share a log.
  std::string unwritten_;
  std::size_t kept_ = 0, left_out_ = 0;
  std::string first_lines_;
};

}  // namespace evalcts
