// Checks files of vectors: their format (INTERPRETING.md), and the consistency of their cases.
#pragma once

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// The text is not JSON or does not follow the format. The message names the place and the problem.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Checks a file by schema/vectors-1.schema.json, and the numbers of components that follow from the targets
// of maps. Throws Malformed.
void check_structure(const nlohmann::json& file);

struct Report {
  std::string kind;
  std::size_t cases = 0, flags = 0;
  std::vector<std::string> findings;  // messages, each with the id of the case
};

// Returns the findings in the text of a file: duplicate ids, requirements that are not in `requirements`,
// flags without a note, notes without a case, a wrong number of tests, and cases that do not have the
// property that their theme or a requirement claims. Throws Malformed if the text is not JSON or
// check_structure() fails.
Report lint(const std::string& text, const std::set<std::string>& requirements);

}  // namespace evalcts::vectors
