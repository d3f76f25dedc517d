// The places of the files of evalcts.
#pragma once

#include <filesystem>
#include <string>

#include <evalcts/runner/folder_lock.h>

namespace evalcts::cli {

// Paths of the suite programs and of the usual output folder.
struct Places {
  std::filesystem::path suite_program, faulty_suite_program;
  std::filesystem::path output;
  std::filesystem::path baselines;
  std::filesystem::path vectors;
  // libglevaluator for C programs; empty where it is not known.
  std::filesystem::path production_headers, production_library;
};
Places places();

// The output folder, for this command alone while the result lives; made where it is missing. Throws
// CannotStart where nothing can be written into it or another command writes there.
FolderLock claim(const std::filesystem::path& output, const std::string& command);

}  // namespace evalcts::cli
