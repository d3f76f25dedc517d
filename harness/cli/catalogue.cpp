#include "harness/cli/catalogue.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "requirements_data.h"  // generated: kRequirements

namespace evalcts {
namespace {

// "EV-API-ENTRY/1-D" -> "EV-API-ENTRY", "1-D"; no half: the whole requirement.
std::pair<std::string, std::string> split(const std::string& id) {
  const std::size_t slash = id.find('/');
  return slash == std::string::npos ? std::pair{id, std::string()}
                                    : std::pair{id.substr(0, slash), id.substr(slash + 1)};
}

}  // namespace

const nlohmann::json& catalogue() {
  static const nlohmann::json data = nlohmann::json::parse(kRequirements);
  return data;
}

std::vector<Coverage> coverage_of(const nlohmann::json& tests) {
  std::map<std::string, std::set<std::string>> halves;
  std::map<std::string, std::vector<std::string>> names;
  for (const auto& test : tests.at("tests"))
    for (const std::string given : test.at("requirements")) {
      const auto [id, half] = split(given);
      halves[id].insert(half);
      names[id].push_back(test.at("name"));
    }
  std::vector<Coverage> coverage;
  for (const auto& requirement : catalogue().at("requirements")) {
    const std::string id = requirement.at("id");
    const std::set<std::string>& found = halves[id];
    const bool whole = found.count("") || (found.count("1-D") && found.count("2-D"));
    coverage.push_back({id, whole ? "decided" : found.empty() ? "undecided" : "in part", names[id]});
  }
  return coverage;
}

std::vector<std::string> lint(const nlohmann::json& tests) {
  std::set<std::string> known;
  for (const auto& requirement : catalogue().at("requirements"))
    known.insert(requirement.at("id").get<std::string>());
  std::vector<std::string> problems;
  std::set<std::string> names;
  for (const auto& test : tests.at("tests")) {
    const std::string name = test.at("name");
    if (!names.insert(name).second) problems.push_back(fmt::format("two tests are called {}", name));
    if (name.find(',') != std::string::npos) problems.push_back(fmt::format("the name {} has a comma", name));
    if (test.at("requirements").empty()) problems.push_back(fmt::format("{} names no requirement", name));
    for (const std::string given : test.at("requirements")) {
      const auto [id, half] = split(given);
      if (!known.count(id) || !(half.empty() || half == "1-D" || half == "2-D"))
        problems.push_back(fmt::format("{} names {}, which does not exist", name, given));
    }
  }
  return problems;
}

}  // namespace evalcts
