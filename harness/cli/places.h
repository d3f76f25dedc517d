// Where the files of evalcts are, and which names a filter chooses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <evalcts/runner/folder_lock.h>

namespace evalcts::cli {

// Where this program, the suite programs and the usual output folder are.
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

// True if the name matches a GoogleTest-like filter: patterns with * and ?, separated by ':', those after a
// '-' excluded. An empty filter matches every name.
bool is_chosen(const std::string& name, const std::string& filter);

// The items whose names match the filter.
template <class Named>
std::vector<Named> matching(std::vector<Named> items, const std::string& filter) {
  std::erase_if(items, [&](const Named& item) { return !is_chosen(item.name, filter); });
  return items;
}

}  // namespace evalcts::cli
