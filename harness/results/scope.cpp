// Compares implementations with scopes.
#include <evalcts/results/scope.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace evalcts {

bool Scope::fits(const ImplementationRecord& implementation, Pass for_pass) const {
  return pass.value_or(for_pass) == for_pass && implementation.vendor.find(vendor) != std::string::npos &&
         implementation.renderer.find(renderer) != std::string::npos &&
         version.contains(implementation.version) &&
         (implementations.empty() || std::ranges::count(implementations, implementation.kind) > 0);
}

std::vector<std::pair<std::string, std::string>> Scope::fields() const {
  std::vector<std::pair<std::string, std::string>> given = {
      {"vendor", vendor},
      {"renderer", renderer},
      {"version", version.text()},
      {"implementation", fmt::format("{}", fmt::join(implementations, ", "))},
      {"pass", pass ? name_of(*pass) : ""}};
  std::erase_if(given, [](const auto& field) { return field.second.empty(); });
  return given;
}

}  // namespace evalcts
