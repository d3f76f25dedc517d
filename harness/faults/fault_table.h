// The requirement-by-fault table: the suite is run against each fault, and has to catch it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "harness/results/json.h"

namespace evalcts::faults {

struct TableRequest {
  std::filesystem::path suite_program;  // the one with faults
  nlohmann::json faults;                // to try: as it lists them ("arguments" are for the suite program)
  nlohmann::json tests;                 // all: {"name", "requirements", "level", "from"}
  int jobs = 1;                         // faults side by side
  double seconds_per_test = 20;
  std::filesystem::path scratch;  // an existing folder for lists and logs
};

// Tries each fault and returns, in the same order, what became of it:
//   {"name", "implementation", "level", "kind", "what", "outcome": "caught" | "survives" | "not-tried",
//   "reason",
//    "requirements": [{"id", "caught", "test", "test_level", "depth", "verdict", "message"}]}
// For each requirement that the fault breaks, the tests that name it are played at quick depth, then, if none
// catches it, at full depth. A test catches a fault where it passes on the implementation
// without the fault and fails (or, for a fault of quality level, warns) with it, at the fault's level or
// above. A fault is caught where a test of each of its requirements catches it. What an implementation that
// cannot be started here would have to show is not tried. Stops early, with what is known, when `interrupted`
// is set.
nlohmann::json try_faults(const TableRequest& request,
                          const std::function<void(std::size_t done, const std::string& fault)>& progress);

// The faults of each requirement, in the order of `coverage` (the requirements that tests decide):
// [{"id", "faults": [names]}].
nlohmann::json faults_by_requirement(const nlohmann::json& faults, const std::vector<std::string>& decided);

// The table for people: requirements, their faults, and which test betrays each.
std::string as_markdown(const nlohmann::json& table);

}  // namespace evalcts::faults
