// Determines the tests that decide each requirement, in one and in two dimensions, and checks the stated
// reasons for requirements without tests.
#include <evalcts/results/coverage.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include <evalcts/results/json.h>

namespace evalcts {
namespace {

constexpr const char* kHalves[] = {"1-D", "2-D"};

bool is_half(const std::string& text) { return std::ranges::count(kHalves, text) > 0; }

// The halves that a test of the requirement decides.
std::vector<std::string> halves_of(const RequirementId& requirement) {
  if (requirement.dimension == 0) return {std::begin(kHalves), std::end(kHalves)};
  return {kHalves[requirement.dimension - 1]};
}

}  // namespace

const char* name_of(Coverage::State state) {
  constexpr const char* kNames[] = {"decided", "in part", "undecidable", "undecided"};
  return kNames[static_cast<std::size_t>(state)];
}

std::vector<Coverage> coverage_of(const Catalogue& catalogue, const std::vector<ListedTest>& tests) {
  std::map<std::string_view, std::set<std::string>> halves;
  std::map<std::string_view, std::vector<std::string>> names;
  for (const ListedTest& test : tests)
    for (const RequirementId& named : test.requirements) {
      for (const std::string& half : halves_of(named)) halves[named.id].insert(half);
      names[named.id].push_back(test.name);
    }
  std::vector<Coverage> coverage;
  for (const Requirement& requirement : catalogue.requirements) {
    Coverage entry{.id = requirement.id, .section = requirement.section, .tests = names[requirement.id]};
    std::vector<std::string> lacking;
    for (const char* half : kHalves)
      if (!halves[requirement.id].contains(half)) lacking.emplace_back(half);
    for (const std::string& half : lacking)
      if (const auto reason = requirement.undecidable.find(half);
          reason != requirement.undecidable.end() && entry.reason.empty())
        entry.reason = reason->second;
    if (lacking.empty()) {
      entry.state = Coverage::State::kDecided;
    } else if (lacking.size() == 1) {
      entry.state = Coverage::State::kInPart;
      entry.lacks = lacking.front();
    } else if (requirement.undecidable.contains("1-D") && requirement.undecidable.contains("2-D")) {
      entry.state = Coverage::State::kUndecidable;
    }
    coverage.push_back(std::move(entry));
  }
  return coverage;
}

std::string to_text(const std::vector<Coverage>& coverage, const std::vector<std::string>& problems) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Coverage& entry : coverage)
    rows.push_back({{"id", entry.id},
                    {"section", entry.section},
                    {"state", name_of(entry.state)},
                    {"lacks", entry.lacks},
                    {"reason", entry.reason},
                    {"tests", entry.tests}});
  return nlohmann::json{{"requirements", rows}, {"problems", problems}}.dump(1) + "\n";
}

std::vector<std::string> lint(const Catalogue& catalogue, const std::vector<ListedTest>& tests) {
  std::vector<std::string> problems;
  std::set<std::string> names;
  std::map<std::string, std::string> decided;  // one of the tests that decide a half, by "ID/half"
  for (const ListedTest& test : tests) {
    const std::string& name = test.name;
    if (!names.insert(name).second) problems.push_back(fmt::format("two tests are called {}", name));
    if (name.find(',') != std::string::npos) problems.push_back(fmt::format("the name {} has a comma", name));
    if (test.requirements.empty()) problems.push_back(fmt::format("{} names no requirement", name));
    for (const RequirementId& named : test.requirements) {
      if (!catalogue.find(named))
        problems.push_back(fmt::format("{} names {}, which does not exist", name, named.text()));
      for (const std::string& half : halves_of(named)) decided[fmt::format("{}/{}", named.id, half)] = name;
    }
  }
  for (const Requirement& requirement : catalogue.requirements)
    for (const auto& [half, reason] : requirement.undecidable) {
      const std::string& id = requirement.id;
      if (!is_half(half)) {
        problems.push_back(fmt::format("{}: no half '{}' exists that could be undecidable", id, half));
      } else if (reason.empty()) {
        problems.push_back(fmt::format("{} is undecidable without a reason", id));
      } else if (const auto test = decided.find(fmt::format("{}/{}", id, half)); test != decided.end()) {
        problems.push_back(fmt::format("{}/{} is undecidable, but {} decides it", id, half, test->second));
      }
    }
  return problems;
}

}  // namespace evalcts
