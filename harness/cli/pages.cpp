// Writes index.html and summary.md.
#include "pages.h"

#include <evalcts/reports.h>

#include <evalcts/results/files.h>
#include <evalcts/results/requirements.h>

namespace evalcts::cli {

namespace fs = std::filesystem;

void write_pages(const fs::path& output, const std::vector<RunResult>& results,
                 const std::vector<RunResult>& before) {
  reports::PageOptions options;
  options.before = before;
  options.accuracy_page = fs::exists(output / "accuracy.html");
  write_atomically(output / "index.html", reports::html(results, catalogue(), options));
  write_atomically(output / "summary.md", reports::markdown_summary(results, before));
}

}  // namespace evalcts::cli
