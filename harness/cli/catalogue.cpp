#include "harness/cli/catalogue.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "requirements_data.h"  // generated: kRequirements
#include "suites/generated/findings_data.h"

namespace evalcts {
namespace {

// "EV-API-ENTRY/1-D" -> "EV-API-ENTRY", "1-D"; no half: the whole requirement.
std::pair<std::string, std::string> split(const std::string& id) {
  const std::size_t slash = id.find('/');
  return slash == std::string::npos ? std::pair{id, std::string()}
                                    : std::pair{id.substr(0, slash), id.substr(slash + 1)};
}

constexpr const char* kHalves[] = {"1-D", "2-D"};

// Half -> why it cannot be decided.
std::map<std::string, std::string> undecidable_halves(const nlohmann::json& requirement) {
  const auto found = requirement.find("undecidable");
  if (found == requirement.end()) return {};
  if (found->is_object()) return found->get<std::map<std::string, std::string>>();
  return {{"1-D", found->get<std::string>()}, {"2-D", found->get<std::string>()}};
}

}  // namespace

const nlohmann::json& catalogue() {
  static const nlohmann::json data = nlohmann::json::parse(kRequirements);
  return data;
}

const nlohmann::json& findings() {
  static const nlohmann::json data = nlohmann::json::parse(kFindings);
  return data;
}

std::vector<nlohmann::json> interpretations() {
  std::vector<nlohmann::json> all;
  for (const char* part : {"contradictions", "undefined"})
    for (const nlohmann::json& entry : catalogue()[part])
      if (entry.contains("readings")) all.push_back(entry);
  return all;
}

std::vector<Coverage> coverage_of(const nlohmann::json& requirements, const nlohmann::json& tests) {
  std::map<std::string, std::set<std::string>> halves;
  std::map<std::string, std::vector<std::string>> names;
  for (const auto& test : tests.at("tests"))
    for (const std::string given : test.at("requirements")) {
      const auto [id, half] = split(given);
      if (half.empty()) {
        halves[id].insert({"1-D", "2-D"});
      } else {
        halves[id].insert(half);
      }
      names[id].push_back(test.at("name"));
    }
  std::vector<Coverage> coverage;
  for (const auto& requirement : requirements.at("requirements")) {
    const std::string id = requirement.at("id");
    Coverage entry{.id = id, .section = requirement.value("section", ""), .tests = names[id]};
    const std::map<std::string, std::string> reasons = undecidable_halves(requirement);
    std::vector<std::string> lacking;
    for (const char* half : kHalves)
      if (!halves[id].count(half)) lacking.emplace_back(half);
    for (const std::string& half : lacking)
      if (reasons.count(half) && entry.reason.empty()) entry.reason = reasons.at(half);
    if (lacking.empty()) {
      entry.state = "decided";
    } else if (lacking.size() == 1) {
      entry.state = "in part";
      entry.lacks = lacking.front();
    } else {
      entry.state = reasons.count("1-D") && reasons.count("2-D") ? "undecidable" : "undecided";
    }
    coverage.push_back(std::move(entry));
  }
  return coverage;
}

std::vector<std::string> lint(const nlohmann::json& requirements, const nlohmann::json& tests) {
  std::set<std::string> known;
  for (const auto& requirement : requirements.at("requirements"))
    known.insert(requirement.at("id").get<std::string>());
  std::vector<std::string> problems;
  std::set<std::string> names;
  std::map<std::string, std::string> decided;  // by half: one of the tests
  for (const auto& test : tests.at("tests")) {
    const std::string name = test.at("name");
    if (!names.insert(name).second) problems.push_back(fmt::format("two tests are called {}", name));
    if (name.find(',') != std::string::npos) problems.push_back(fmt::format("the name {} has a comma", name));
    if (test.at("requirements").empty()) problems.push_back(fmt::format("{} names no requirement", name));
    for (const std::string given : test.at("requirements")) {
      const auto [id, half] = split(given);
      if (!known.count(id) || !(half.empty() || half == "1-D" || half == "2-D"))
        problems.push_back(fmt::format("{} names {}, which does not exist", name, given));
      for (const char* one : kHalves)
        if (half.empty() || half == one) decided[id + "/" + one] = name;
    }
  }
  for (const auto& requirement : requirements.at("requirements")) {
    if (!requirement.contains("undecidable")) continue;
    const std::string id = requirement.at("id");
    for (const auto& [half, reason] : undecidable_halves(requirement)) {
      if (half != "1-D" && half != "2-D") {
        problems.push_back(fmt::format("{}: there is no half '{}' to be undecidable", id, half));
      } else if (reason.empty()) {
        problems.push_back(fmt::format("{} is undecidable without a reason", id));
      } else if (const auto test = decided.find(fmt::format("{}/{}", id, half)); test != decided.end()) {
        problems.push_back(fmt::format("{}/{} is undecidable, but {} decides it", id, half, test->second));
      }
    }
  }
  return problems;
}

}  // namespace evalcts
