// The file in which the suite program reports its events, one line each. It is the only channel between the
// suite program and the runner, so it survives what a library does to the process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace evalcts {

// Exit status of the suite program if an event cannot be written (disk full), and the beginning of its last
// line on standard error.
inline constexpr int kExitCannotWrite = 74;
inline constexpr char kCannotWriteEvent[] = "evalcts: cannot write the result of a test: ";

class EventFile {
 public:
  // Appends to the file; an empty path keeps nothing. Throws CannotWrite.
  explicit EventFile(const std::filesystem::path& path);
  ~EventFile();
  EventFile(const EventFile&) = delete;
  EventFile& operator=(const EventFile&) = delete;

  // Writes a line, which ends with a newline, at once: no result is lost when the process dies. A process
  // that a library has forked off ends here. If the file cannot be written the process ends as above.
  void write(const std::string& line);
  // The same in a signal handler (async-signal-safe). Writes nothing in a process that a library has forked
  // off, or if the file cannot be written: the process is about to end anyway.
  void write_in_handler(std::string_view line) const noexcept;

  // True if somebody else closed the descriptor and the file had to be opened again.
  bool was_closed() const { return was_closed_; }

 private:
  void open();
  bool is_open() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  pid_t process_;
  bool was_closed_ = false;
};

}  // namespace evalcts
