// The bugs of implementations that are known, as data (suites/bugs).
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirement_id.h>
#include <evalcts/results/run_result.h>

namespace evalcts {

struct KnownBug {
  std::string id;  // "mesa-mesh-steps"
  std::string title;
  std::string product;               // a word of GL_VENDOR, GL_RENDERER or GL_VERSION: "Mesa"
  std::vector<std::string> affects;  // implementations and versions: "Mesa 20.3 to 26.2"
  std::vector<RequirementId> requirements;
  std::string clause;
  std::string program;  // the minimal program as JSON text, see gl/case_json.h; empty if it needs more
  std::string expected, captured;  // what the program has to show, and what it shows
  std::string cause;               // what in the library causes it: the function, in words
  bool suspected = false;          // the cause was read from the source, not proven by a repair
  std::string real_programs;       // how real programs notice
  std::string verified;            // how it was verified
  // Causes of bugs of a run (Bug::cause) that are this one.
  std::vector<std::string> signs;
};

// The known bugs that this build was made with, in the order of their IDs.
const std::vector<KnownBug>& known_bugs();
// Null if there is none.
const KnownBug* find_known_bug(const std::string& id);
// The known bug of this implementation, in whatever version, that has the sign; null if there is none. The
// same sign on another product may have another root cause.
const KnownBug* known_bug_with_sign(const std::string& cause, const ImplementationRecord& implementation);

// Reads {"bugs": [...]}. Throws FormatError.
std::vector<KnownBug> parse_known_bugs(const std::string& text);

// Describes the mistakes in known bugs: fields that are missing, IDs and signs of a product that stand twice,
// requirements that do not exist.
std::vector<std::string> lint(const std::vector<KnownBug>& bugs);

// docs/known-bugs.md.
std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c);

}  // namespace evalcts
