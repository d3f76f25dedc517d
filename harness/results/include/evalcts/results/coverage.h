// How far the tests decide the requirements.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// How far the tests decide one requirement. A test may decide one half of it, "/1-D" or "/2-D".
struct Coverage {
  enum class State { kDecided, kInPart, kUndecidable, kUndecided };
  std::string id, section;
  State state = State::kUndecided;
  std::string lacks = {};   // in part: the half that no test decides, "1-D" or "2-D"
  std::string reason = {};  // why the requirement, or the missing half, cannot be decided; may be empty
  std::vector<std::string> tests = {};
};
// "decided", "in part", "undecidable", "undecided".
const char* name_of(Coverage::State state);

// One entry for each requirement, in the order of the catalogue.
std::vector<Coverage> coverage_of(const Catalogue& catalogue, const std::vector<ListedTest>& tests);

// {"requirements": [{"id", "section", "state", "lacks", "reason", "tests"}], "problems": [...]}
std::string to_text(const std::vector<Coverage>& coverage, const std::vector<std::string>& problems);

// Contradictions between catalogue and tests: tests without a requirement, requirement IDs that do not exist,
// and "undecidable" although a test decides, for a half that does not exist, or without a reason.
std::vector<std::string> lint(const Catalogue& catalogue, const std::vector<ListedTest>& tests);

}  // namespace evalcts
