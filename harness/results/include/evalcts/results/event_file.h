// The file or pipe to which a worker writes its events, one line each. It is the only channel from a worker
// to the runner, so it stays usable if a library closes descriptors or forks.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace evalcts {

// Exit status of a worker if an event cannot be written (disk full), and the beginning of its last
// line on standard error.
inline constexpr int kExitCannotWrite = 74;
inline constexpr char kCannotWriteEvent[] = "evalcts: cannot write the result of a test: ";

class EventFile {
 public:
  // Appends to the file or pipe. If the path is empty, events are discarded. Throws CannotWrite.
  explicit EventFile(const std::filesystem::path& path);
  // Writes to an open descriptor, which cannot be opened again.
  explicit EventFile(int descriptor);
  ~EventFile();
  EventFile(const EventFile&) = delete;
  EventFile& operator=(const EventFile&) = delete;

  // Writes a line, which must end with a newline, without buffering, so that no result is lost if the process
  // dies. In a process that a library has forked off, ends that process. If the file cannot be written, ends
  // the process with kExitCannotWrite. Throws CannotWrite if the file cannot be opened again. Another thread
  // must not call it.
  void write(const std::string& line);
  // Writes a line in a signal handler (async-signal-safe). Does nothing in a process that a library has
  // forked off, or if the file cannot be written, because the process is about to end anyway.
  void write_in_handler(std::string_view line) const noexcept;

  // Returns the number of lines that write() has begun. May be called in any thread.
  std::uint64_t lines() const { return lines_; }
  // True if a library closed the descriptor and the file had to be opened again.
  bool was_closed() const { return was_closed_; }

 private:
  void open();
  void identify();
  bool is_open() const;

  std::string path_;
  int descriptor_ = -1;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  pid_t process_;
  bool was_closed_ = false;
  std::atomic<std::uint64_t> lines_ = 0;
};

}  // namespace evalcts
