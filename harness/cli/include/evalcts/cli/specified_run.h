// Runs tests of the suite on the executable specification, and observes their cases.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <evalcts/results/serialization.h>

namespace evalcts::cli {

// A folder for temporary files, which the destructor removes.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
};

// Runs tests, given by name, at quick depth with all their cases traced, and calls `each` with every event.
// Returns true if all of them were run to the end.
bool run_on_specification(const std::vector<std::string>& tests,
                          const std::function<void(const Event&)>& each);

}  // namespace evalcts::cli
