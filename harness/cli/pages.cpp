// Writes index.html and summary.md.
#include "pages.h"

#include <evalcts/reports.h>
#include <fmt/format.h>

#include <utility>

#include <evalcts/cli/places.h>
#include <evalcts/results/files.h>
#include <evalcts/results/requirements.h>

namespace evalcts::cli {

namespace fs = std::filesystem;

namespace {

// Returns the files of a result that exist, relative to the folder of the page.
std::vector<std::string> files_of(const RunResult& result, const fs::path& output) {
  fs::path folder = result.origin.empty() ? output : fs::path(result.origin);
  if (fs::is_regular_file(folder)) folder = folder.parent_path();
  std::vector<std::string> files;
  for (const auto& [kind, extension] : {std::pair{"results", "json"}, {"log", "txt"}, {"junit", "xml"}}) {
    const fs::path file = folder / fmt::format("{}-{}.{}", kind, result.file_label(), extension);
    if (fs::exists(file)) files.push_back(fs::proximate(file, output).string());
  }
  return files;
}

}  // namespace

void write_pages(const fs::path& output, const std::vector<RunResult>& results,
                 const std::vector<RunResult>& before, const std::vector<reports::PastRun>& history) {
  reports::PageOptions options;
  options.before = before;
  options.history = history;
  for (const RunResult& result : results) options.files.push_back(files_of(result, output));
  // In a checkout, the folder of the vectors lies next to that of the tests.
  const fs::path repository = places().vectors.parent_path();
  if (fs::exists(repository / "suites/findings.cpp"))
    options.sources = fs::proximate(repository, output).string();
  write_atomically(output / "index.html", reports::html(results, catalogue(), options));
  write_atomically(output / "summary.md", reports::markdown_summary(results, before));
}

}  // namespace evalcts::cli
