// The requirements as data (suites/requirements.json, part of the program) and what the tests decide of them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace evalcts {

// {"requirements": [...], "contradictions": [...], "undefined": [...]}
const nlohmann::json& catalogue();

// How far the tests decide one requirement. "in part": only one of its halves "/1-D" and "/2-D".
struct Coverage {
  std::string id;
  std::string state;  // "decided", "in part", "undecided"
  std::vector<std::string> tests;
};

// One entry for each requirement, in the order of the catalogue. `tests`: what the suite program lists.
std::vector<Coverage> coverage_of(const nlohmann::json& tests);

// Tests without a requirement, and requirement IDs that do not exist: empty where all is well.
std::vector<std::string> lint(const nlohmann::json& tests);

}  // namespace evalcts
