// Starts the suite program with the executable specification as the implementation.
#include "specified_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include <evalcts/runner/suite_child.h>
#include "places.h"

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
  constexpr double kLook = 0.01, kPatience = 60;  // seconds
  const Scratch scratch;
  const fs::path list = scratch.path() / "tests.txt", events = scratch.path() / "events.jsonl";
  std::ofstream(list) << fmt::format("{}\n", fmt::join(tests, "\n"));
  SuiteChild child(
      {places().suite_program.string(), "--implementation", "reference", "--depth", "quick", "--tests",
       list.string(), "--records", events.string(), "--trace-cases", "--die-with-parent", "--gtest_brief=1"},
      events, scratch.path() / "log.txt", {kPatience});
  while (!child.look(kLook, {}, each)) continue;
  return child.run().complete;
}

}  // namespace evalcts::cli
