// Starts the suite program with the executable specification as the implementation.
#include <evalcts/cli/specified_run.h>

#include <unistd.h>

#include <stdexcept>

#include <evalcts/cli/places.h>
#include <evalcts/runner/worker.h>

namespace evalcts::cli {

namespace fs = std::filesystem;

Scratch::Scratch() : path_((fs::temp_directory_path() / "evalcts-XXXXXX").string()) {
  if (!mkdtemp(path_.data())) throw std::runtime_error("cannot make a temporary folder");
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool run_on_specification(const std::vector<std::string>& tests,
                          const std::function<void(const Event&)>& each) {
  constexpr double kPatience = 60;  // seconds
  Worker worker({places().suite_program.string(), "--implementation", "reference", "--depth", "quick"}, {},
                {kPatience});
  for (const std::string& test : tests) worker.give({.kind = "test", .name = test, .traces_cases = true});
  worker.finish();
  return worker.wait({}, each).complete;
}

}  // namespace evalcts::cli
