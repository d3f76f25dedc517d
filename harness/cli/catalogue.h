// The requirements as data (suites/requirements.json, part of the program) and what the tests decide of them.
#pragma once

#include <string>
#include <vector>

#include "harness/results/json.h"

namespace evalcts {

// {"requirements": [...], "contradictions": [...], "undefined": [...]}. A requirement that nothing here can
// decide says why: "undecidable": "reason", or {"1-D": "reason"} for one of its halves.
const nlohmann::json& catalogue();

// The programs that random search found and every run replays: {"name", "cause", "requirement", "program",
// ...} each.
const nlohmann::json& findings();

// The ambiguous texts with more than one accepted reading: {"id", "readings": {name: meaning}, ...} each, of
// "contradictions" and "undefined".
std::vector<nlohmann::json> interpretations();

// How far the tests decide one requirement. A test may decide one half of it, "/1-D" or "/2-D".
struct Coverage {
  std::string id;
  std::string section;
  std::string state = {};   // "decided", "in part", "undecidable", "undecided"
  std::string lacks = {};   // "in part": the half that no test decides, "1-D" or "2-D"
  std::string reason = {};  // why the requirement, or what is lacking of it, cannot be decided; may be empty
  std::vector<std::string> tests = {};
};

// One entry for each requirement, in the order of the catalogue. `tests`: what the suite program lists.
std::vector<Coverage> coverage_of(const nlohmann::json& requirements, const nlohmann::json& tests);

// Tests without a requirement, requirement IDs that do not exist, and "undecidable" where a test decides, of
// a half that does not exist, or without a reason: empty where all is well.
std::vector<std::string> lint(const nlohmann::json& requirements, const nlohmann::json& tests);

}  // namespace evalcts
