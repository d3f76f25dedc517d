#include <fmt/format.h>
#include <fnmatch.h>
#include <unistd.h>

#include <sstream>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/text.h>
#include "places.h"

namespace evalcts::cli {

namespace fs = std::filesystem;

Places places() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  // In a checkout the program lies in build/PRESET/harness/cli.
  const fs::path top = fs::weakly_canonical(folder / "../../../..");
  if (fs::exists(top / "reports/schema") && fs::exists(top / "suites/requirements.json"))
    return {.suite_program = folder / "evalcts-suite",
            .faulty_suite_program = folder / "evalcts-faulty-suite",
            .output = top / "reports/out",
            .baselines = top / "suites/baselines",
            .vectors = top / "vectors",
            .production_headers = top / "production/include",
            .production_library = fs::weakly_canonical(folder / "../../production/libglevaluator.a")};
  const fs::path data = fs::weakly_canonical(folder / EVALCTS_DATA_FROM_PROGRAMS);
  return {.suite_program = folder / "evalcts-suite",
          .faulty_suite_program = folder / "evalcts-faulty-suite",
          .output = fs::current_path() / "evalcts-results",
          .baselines = data / "baselines",
          .vectors = data / "vectors",
          .production_headers = {},
          .production_library = {}};
}

FolderLock claim(const fs::path& output, const std::string& command) {
  std::error_code error;
  fs::create_directories(output, error);
  if (error || access(output.c_str(), W_OK) != 0)
    throw CannotStart(
        fmt::format("cannot write into '{}'; choose another folder with --output", output.string()));
  try {
    return {output, fmt::format("process {}: {}", getpid(), command)};
  } catch (const FolderInUse& problem) {
    throw CannotStart(
        fmt::format("{}; wait for it, or choose another folder with --output", clean(problem.what())));
  }
}

bool is_chosen(const std::string& name, const std::string& filter) {
  const auto matches_any = [&](const std::string& patterns) {
    std::istringstream stream(patterns);
    for (std::string pattern; std::getline(stream, pattern, ':');)
      if (fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0) return true;
    return false;
  };
  // The first '-' at the beginning of a pattern starts the negative ones, as in GoogleTest.
  const std::size_t dash = filter.starts_with('-') ? 0 : filter.find(":-");
  const std::string positive = dash == std::string::npos ? filter : filter.substr(0, dash);
  const std::string negative =
      dash == std::string::npos ? "" : filter.substr(dash + (filter[dash] == ':' ? 2 : 1));
  return (positive.empty() || matches_any(positive)) && !(!negative.empty() && matches_any(negative));
}

}  // namespace evalcts::cli
