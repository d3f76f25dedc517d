// The register of known bugs, which is stored as data in suites/bugs: what each bug is, by which differences
// it shows, the programs that random search has found for it, and the tests that it makes fail.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <evalcts/results/requirement_id.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/scope.h>

namespace evalcts {

// The versions of a product that have a bug.
struct AffectedVersions {
  std::string product;      // "Mesa", which stands in GL_VERSION in front of the number of the version
  std::string first, last;  // "20.3" and "26.2", which includes 26.2.6
  std::string renderer;     // a part of GL_RENDERER, "llvmpipe"; empty: any

  // Returns "Mesa 20.3 to 26.2 with llvmpipe".
  std::string text() const;
  // True if this version was seen to have the bug, or is between such versions.
  bool contains(const ImplementationRecord& implementation) const;
  // The same for the first and all newer versions, and only for implementations whose evaluators are those of
  // the product.
  bool may_contain(const ImplementationRecord& implementation) const;
};

// A difference by which a known bug shows. `what`, `expected` and `captured` are regular expressions that
// match the whole text of the member of Failure with the same name. An empty text permits everything.
struct BugSign {
  std::string cause;  // Bug::cause
  std::string what, expected, captured;
  // The captured number in relation to the expected number or interval: "more", "less", or "near", at most
  // 0.01 away, or 1 % of a larger number.
  std::string relation;

  bool matches(const std::string& of_cause, const Failure& failure) const;
};

// A minimal program that random search has found, which every run replays as the test Findings.NAME.
struct FindingRecord {
  std::string name, requirement;
  std::string what;     // the difference, as in Failure
  std::string program;  // as JSON text (gl/case_json.h)
};

// Tests that a bug makes fail.
struct FailingTests {
  Scope scope;  // beyond the affected versions
  // Fail, Crash or Timeout; Flaky: they may fail in any way or pass; Skip: they are not run.
  std::string status = "Fail";
  std::vector<std::string> tests;  // names or patterns, see baseline.h
};

struct KnownBug {
  std::string id;  // "mesa-mesh-steps"
  std::string title;
  AffectedVersions affects;
  std::vector<RequirementId> requirements;
  std::string clause;
  std::string program;  // the minimal program as JSON text (gl/case_json.h); empty if JSON cannot express it
  std::string expected, captured;   // the required and the observed result of the program
  std::string cause;                // the root cause in the library, in words, with the function
  bool outside_evaluators = false;  // explicit vertices or other commands show it as well
  bool suspected = false;           // the cause was read from the source, not proven by a repair
  std::string real_programs;        // the effect on real programs
  std::string verified;             // the way in which the bug was verified
  bool crashes = false;             // the library crashes or hangs in the program; there are no signs then
  std::vector<BugSign> signs;       // the differences by which the bug shows
  std::vector<FindingRecord> findings;
  std::vector<FailingTests> tests;  // Findings.NAME of `findings` included

  bool has_sign(const std::string& of_cause, const Failure& failure) const;
};

// Returns the known bugs that are compiled in, in the order of their IDs.
const std::vector<KnownBug>& known_bugs();
// Returns the known bug with this ID; null if there is none.
const KnownBug* find_known_bug(const std::string& id);

// Returns the signatures of a test function ("Map1Errors.BadTarget") in runs of the product ("mesa"): the
// failing cases that its tests are known to have at quick or full depth, with any version or driver.
const std::set<std::string>& known_signatures(const std::string& product, const std::string& function);

// Reads {"bugs": [...]}. Throws FormatError.
std::vector<KnownBug> parse_known_bugs(const std::string& text);

// Returns descriptions of the mistakes in known bugs: missing fields, duplicate IDs, duplicate signs of a
// product, wrong expressions and relations in signs, and requirements that do not exist.
std::vector<std::string> lint(const std::vector<KnownBug>& bugs);

// Returns the text of docs/known-bugs.md. `programs_as_c` has the minimal program of each bug as
// C; empty: none.
std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c);

}  // namespace evalcts
