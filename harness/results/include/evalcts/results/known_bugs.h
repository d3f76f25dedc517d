// The known bugs of implementations, which are stored as data in suites/bugs.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/requirement_id.h>
#include <evalcts/results/run_result.h>

namespace evalcts {

struct KnownBug {
  std::string id;  // "mesa-mesh-steps"
  std::string title;
  std::string product;               // a part of GL_VENDOR, GL_RENDERER or GL_VERSION: "Mesa"
  std::vector<std::string> affects;  // implementations and versions: "Mesa 20.3 to 26.2"
  std::vector<RequirementId> requirements;
  std::string clause;
  std::string program;  // the minimal program as JSON text (gl/case_json.h); empty if JSON cannot express it
  std::string expected, captured;  // the required and the observed result of the program
  std::string cause;               // the root cause in the library, in words, with the function
  bool suspected = false;          // the cause was read from the source, not proven by a repair
  std::string real_programs;       // the effect on real programs
  std::string verified;            // the way in which the bug was verified
  // Values of Bug::cause by which this bug is recognised in a run.
  std::vector<std::string> signs;
};

// Returns the known bugs that are compiled in, in the order of their IDs.
const std::vector<KnownBug>& known_bugs();
// Returns the known bug with this ID; null if there is none.
const KnownBug* find_known_bug(const std::string& id);
// Returns the known bug that has `cause` among its signs and whose product is that of the implementation, in
// any version; null if there is none. The same sign on another product may have another root cause.
const KnownBug* known_bug_with_sign(const std::string& cause, const ImplementationRecord& implementation);

// Reads {"bugs": [...]}. Throws FormatError.
std::vector<KnownBug> parse_known_bugs(const std::string& text);

// Returns descriptions of the mistakes in known bugs: missing fields, duplicate IDs, duplicate signs of a
// product, and requirements that do not exist.
std::vector<std::string> lint(const std::vector<KnownBug>& bugs);

// Returns the text of docs/known-bugs.md. `programs_as_c` has the minimal program of each bug as
// C; empty: none.
std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c);

}  // namespace evalcts
