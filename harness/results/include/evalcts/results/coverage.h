// Coverage: the requirements that tests decide, and the reasons why others cannot be decided.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// Coverage of one requirement. A test may decide only one half of a requirement, "/1-D" or "/2-D".
struct Coverage {
  enum class State { kDecided, kInPart, kUndecidable, kUndecided };
  std::string id, section;
  State state = State::kUndecided;
  std::string lacks = {};   // for kInPart: the half that no test decides, "1-D" or "2-D"
  std::string reason = {};  // why the requirement, or the missing half, cannot be decided; may be empty
  std::vector<std::string> tests = {};
};
// Returns "decided", "in part", "undecidable" or "undecided".
const char* name_of(Coverage::State state);

// Returns one entry for each requirement, in the order of the catalogue.
std::vector<Coverage> coverage_of(const Catalogue& catalogue, const std::vector<ListedTest>& tests);

// Returns JSON: {"requirements": [{"id", "section", "state", "lacks", "reason", "tests"}], "problems": [...]}
std::string to_text(const std::vector<Coverage>& coverage, const std::vector<std::string>& problems);

// Returns descriptions of the contradictions between catalogue and tests: duplicate names of tests, names
// with a comma, tests without a requirement, requirement IDs that do not exist, and halves that are
// undecidable although a test decides them, without a reason, or with an unknown name.
std::vector<std::string> lint(const Catalogue& catalogue, const std::vector<ListedTest>& tests);

}  // namespace evalcts
