// The file in which the suite program reports its events, one line of JSON each: the only channel between it
// and the runner, so it has to survive what a library does to the process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

namespace evalcts {

// What has to be kept cannot be: the disk is full, the folder is read-only. The message names the file.
struct CannotWrite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How the suite program ends where an event cannot be written (disk full), and how its last words begin.
inline constexpr int kExitCannotWrite = 74;
inline constexpr char kCannotWriteEvent[] = "evalcts: cannot write the result of a test: ";

class EventFile {
 public:
  // Appends to the file; an empty path keeps nothing. Throws CannotWrite.
  explicit EventFile(const std::filesystem::path& path);
  ~EventFile();
  EventFile(const EventFile&) = delete;
  EventFile& operator=(const EventFile&) = delete;

  // One line, at once: nothing obtained is lost when the process dies. A process that a library has forked
  // off ends here; where the file cannot be written the process ends as above.
  void write(const nlohmann::json& event);

  // Whether the descriptor was closed by somebody else, and the file had to be opened again.
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
