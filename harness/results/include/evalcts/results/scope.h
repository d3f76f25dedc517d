// The implementations that known failures are for.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/results/run_result.h>
#include <evalcts/results/version_range.h>

namespace evalcts {

// An empty member permits everything.
struct Scope {
  std::string vendor = {}, renderer = {};  // parts of GL_VENDOR and GL_RENDERER
  VersionRange version = {};
  std::vector<std::string> implementations = {};  // names, see `evalcts list implementations`
  std::optional<Pass> pass = {};

  bool fits(const ImplementationRecord& implementation, Pass for_pass) const;
  // Returns the members as text, in the order of a baseline's header: {"version", "Mesa 20.3 or newer"}.
  std::vector<std::pair<std::string, std::string>> fields() const;
};

}  // namespace evalcts
