// Determines the implementations that are judged if the user names none, and the reason why one does not
// start.
#include <evalcts/cli/default_implementations.h>

#include <fmt/format.h>

#include <iostream>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/places.h>
#include <evalcts/runner/worker.h>

namespace evalcts::cli {

std::string why_not(const std::string& implementation) {
  std::string reason;
  const std::vector<std::string> command = {places().suite_program.string(), "--implementation",
                                            implementation};
  return ask<Description>(command, {"describe", "describe"}, reason) ? std::string() : reason;
}

std::vector<std::string> default_implementations() {
  std::vector<std::string> names;
  for (const ImplementationKind& kind : implementation_kinds()) {
    if (!kind.by_default) continue;
    names.push_back(kind.name);
    if (kind.name != "osmesa") continue;
    const std::string reason = why_not("osmesa");
    if (reason.empty()) continue;
    std::cout << fmt::format("osmesa does not start ({}): egl is judged instead\n", reason);
    names.back() = "egl";
  }
  return names;
}

}  // namespace evalcts::cli
