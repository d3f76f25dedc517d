// Reads the value of --baseline, and writes baselines.
#include "chosen_baseline.h"

#include <fmt/format.h>

namespace evalcts::cli {

namespace fs = std::filesystem;

ChosenFiles chosen_files(const std::string& given) {
  const fs::path path = given;
  if (!fs::is_directory(path) && path.has_filename() && fs::exists(given + "-fails.txt"))
    return {path.has_parent_path() ? path.parent_path() : ".", path.filename().string()};
  return {path, ""};
}

BaselineChoice choice_of(const std::string& given, bool must_exist) {
  if (given.empty()) return {};
  const ChosenFiles chosen = chosen_files(given);
  if (must_exist && !fs::is_directory(chosen.folder))
    throw BadBaseline(
        fmt::format("--baseline '{}': not a directory, a baseline in a directory (DIR/NAME, for "
                    "DIR/NAME-fails.txt), or 'none'",
                    given));
  return {.files = BaselineFiles::read_all(chosen.folder), .name = chosen.name};
}

std::string write_baseline(const fs::path& folder, const BaselineFiles* before, const BaselineFiles& after) {
  after.write(folder);
  std::size_t added = 0, kept = 0;
  for (const auto& [test, entry] : after.entries)
    (before && before->entries.contains(test) ? kept : added) += 1;
  const std::size_t removed = (before ? before->entries.size() : 0) - kept;
  return fmt::format("Baseline: {}: {} {} ({} new, {} removed)\n",
                     (folder / (after.name + "-fails.txt")).string(), after.entries.size(),
                     after.entries.size() == 1 ? "entry" : "entries", added, removed);
}

}  // namespace evalcts::cli
