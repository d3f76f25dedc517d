// Implements the channels of a worker.
#include <evalcts/results/job_reader.h>

#include <array>
#include <cerrno>

#include "posix.h"

namespace evalcts {

JobReader::JobReader() : descriptor_(duplicate(STDIN_FILENO)) {
  const int empty = open(kNoFile, O_RDONLY | O_CLOEXEC);
  dup2(empty, STDIN_FILENO);
  close(empty);
}

JobReader::~JobReader() { close(descriptor_); }

std::optional<std::string> JobReader::next() {
  std::size_t end;
  while ((end = read_.find('\n')) == std::string::npos) {
    std::array<char, 65536> bytes{};
    const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  std::string line = read_.substr(0, end);
  read_.erase(0, end + 1);
  return line;
}

int take_standard_output() {
  const int events = duplicate(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return events;
}

}  // namespace evalcts
