// Files that are read as a whole, and written as a whole or not at all.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace evalcts {

// A file that has to be kept cannot be written: the disk is full, the folder is read-only. The message names
// the file.
struct CannotWrite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the content of the file; empty if it cannot be read.
std::string read_file(const std::filesystem::path& path);

// Writes the whole file or leaves the old one. Throws CannotWrite.
void write_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace evalcts
