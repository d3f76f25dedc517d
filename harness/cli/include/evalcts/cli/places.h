// Finds the files of evalcts, in a checkout or an installation.
#pragma once

#include <filesystem>
#include <string>

#include <evalcts/runner/folder_lock.h>

namespace evalcts::cli {

// Paths of the suite programs, the default output folder, and the data of evalcts.
struct Places {
  std::filesystem::path suite_program, faulty_suite_program;
  // $EVALCTS_OUTPUT, or reports/out in a checkout, or evalcts-results in the working directory. Has a folder
  // for each run, and files of other commands.
  std::filesystem::path output;
  std::filesystem::path vectors;
  // Headers and library of libglevaluator for C programs; empty in an installation, where the
  // compiler finds them.
  std::filesystem::path production_headers, production_library;
  // The library that `record` preloads; may not exist.
  std::filesystem::path recorder;
};
Places places();

// Replaces this program by another one in its folder, with the same arguments. Returns only if that fails.
void become(const std::string& program);

// Creates the output folder if it does not exist, and locks it while the result lives. Throws CannotStart if
// the folder is not writable or another command has locked it.
FolderLock claim(const std::filesystem::path& output, const std::string& command);

}  // namespace evalcts::cli
