// Determines the implementations that are judged if the user names none, and the reason why one does not
// start.
#include <evalcts/cli/default_implementations.h>

#include <fmt/format.h>

#include <iostream>

#include <evalcts/cli/places.h>
#include <evalcts/runner/runner.h>
#include <evalcts/runner/worker.h>

namespace evalcts::cli {

std::string why_not(const std::string& implementation) {
  std::string reason;
  const std::vector<std::string> command = {places().suite_program.string(), "--implementation",
                                            implementation};
  return ask<Description>(command, {"describe", "describe"}, reason) ? std::string() : reason;
}

void require_own_sources(const ImplementationOptions& implementation) {
  if (implementation.worker.empty()) return;
  const std::string suite = places().suite_program.string();
  std::vector<std::string> command = implementation.words();
  command.insert(command.begin(), suite);
  std::string reason;
  const std::optional<Description> description = ask<Description>(command, {"describe", "describe"}, reason);
  if (description) reason = why_other_suite(list_tests(suite), *description);
  if (!reason.empty()) throw CannotStart(reason);
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
