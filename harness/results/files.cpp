// Reads whole files, and replaces files atomically by renaming a complete new one.
#include <evalcts/results/files.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "posix.h"

namespace evalcts {

std::string read_file(const std::filesystem::path& path) {
  std::ostringstream content;  // copies blocks; iterators would copy single characters
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(content).str();
}

void write_atomically(const std::filesystem::path& path, const std::string& content) {
  const std::filesystem::path temporary = path.string() + ".new";
  const auto fail = [&](const char* what) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw CannotWrite(fmt::format("cannot {} '{}': {}", what, path.string(), std::strerror(error)));
  };
  const int descriptor = open(temporary.string().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail("create");
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written < 0) {
      if (errno == EINTR) continue;
      close(descriptor);
      fail("write");
    }
    done += static_cast<std::size_t>(written);
  }
  if (fsync(descriptor) != 0 || close(descriptor) != 0) fail("write");
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  errno = error.value();
  if (error) fail("replace");
}

}  // namespace evalcts
