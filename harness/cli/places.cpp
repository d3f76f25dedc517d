#include <fnmatch.h>

#include <sstream>

#include "harness/cli/commands.h"

namespace evalcts::cli {

namespace fs = std::filesystem;

Places places() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  // In a checkout the program lies in build/PRESET/harness/cli.
  const fs::path top = folder / "../../../..";
  const bool in_checkout = fs::exists(top / "reports/schema") && fs::exists(top / "suites/requirements.json");
  return {
      folder / "evalcts-suite",
      folder / "evalcts-faulty-suite",
      in_checkout ? fs::weakly_canonical(top / "reports/out") : fs::current_path() / "evalcts-results",
      in_checkout ? fs::weakly_canonical(top / "suites/baselines") : folder / "../share/evalcts/baselines",
      in_checkout ? fs::weakly_canonical(top / "vectors") : folder / "../share/evalcts/vectors",
      in_checkout ? fs::weakly_canonical(top / "production/include") : fs::path(),
      in_checkout ? fs::weakly_canonical(folder / "../../production/libglevaluator.a") : fs::path()};
}

nlohmann::json matching(const nlohmann::json& tests, const std::string& filter) {
  const auto any = [](const std::string& patterns, const std::string& name) {
    std::istringstream stream(patterns);
    for (std::string pattern; std::getline(stream, pattern, ':');)
      if (fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0) return true;
    return false;
  };
  // The first '-' at the beginning of a pattern starts the negative ones, as in GoogleTest.
  std::size_t dash = filter.starts_with('-') ? 0 : filter.find(":-");
  const std::string positive = dash == std::string::npos ? filter : filter.substr(0, dash);
  std::string negative;
  if (dash != std::string::npos) negative = filter.substr(filter[dash] == ':' ? dash + 2 : dash + 1);
  nlohmann::json matched = nlohmann::json::array();
  for (const auto& test : tests.at("tests")) {
    const std::string name = test.at("name");
    if (any(positive.empty() ? "*" : positive, name) && !any(negative, name)) matched.push_back(test);
  }
  return matched;
}

bool is_chosen(const std::string& name, const std::string& filter) {
  const nlohmann::json named = {{"name", name}};
  return filter.empty() || !matching({{"tests", nlohmann::json::array({named})}}, filter).empty();
}

}  // namespace evalcts::cli
