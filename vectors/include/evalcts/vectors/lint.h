// Looks after files of vectors: whether they are what INTERPRETING.md says, and agree with themselves.
#pragma once

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

// A file that is no file of vectors: no JSON, or not of the structure. Says where and what.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Checks schema/vectors-1.schema.json and the counts that follow from the targets of maps. Throws Malformed.
void check_structure(const nlohmann::json& file);

struct Report {
  std::string kind;
  std::size_t cases = 0, flags = 0;
  std::vector<std::string> findings;  // in words, with the id of the case
};

// Ids that stand twice, requirements that do not exist, flags without a note, notes without a flag, a wrong
// number of tests, cases that are not what their theme or a requirement of theirs claims, rejected queries
// that answer. Throws Malformed as check_structure does, and for text
// that is no JSON.
Report lint(const std::string& text, const std::set<std::string>& requirements);

}  // namespace evalcts::vectors
