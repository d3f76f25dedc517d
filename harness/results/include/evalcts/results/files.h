// Reads and writes whole files.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace evalcts {

// Thrown if a file cannot be written, for example because the disk is full or the folder is read-only. The
// message names the file.
struct CannotWrite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the content of the file; empty if it cannot be read.
std::string read_file(const std::filesystem::path& path);

// Writes the whole file. If this fails, the old file stays unchanged. Throws CannotWrite.
void write_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace evalcts
