// The register of known bugs, which is stored as data in suites/bugs: what each bug is, the programs that
// show it, and the tests that it makes fail.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <evalcts/results/documents.h>
#include <evalcts/results/requirement_id.h>
#include <evalcts/results/run_result.h>
#include <evalcts/results/scope.h>

namespace evalcts {

// The versions of a product that have a bug.
struct AffectedVersions {
  std::string product;      // "Mesa", which stands in GL_VERSION in front of the number of the version
  std::string first, last;  // "20.3" and "26.2", which includes 26.2.6
  std::string renderer;     // a part of GL_RENDERER, "llvmpipe"; empty: any
  std::string server;       // the X server that has the bug, if it is not in the product
  // The versions that were tested: those that have the bug, from the first to the last, and those that do
  // not.
  std::vector<std::string> tested, without;

  // Returns "Mesa 20.3 to 26.2 with llvmpipe", or "X.Org server 21.1.7 with clients of Mesa 20.3 to 26.2".
  std::string text() const;
  // Returns "20.3.5 and 22.3.6 have the bug, 25.0.7 does not", or "with clients of Mesa 20.3.5 and 22.3.6"
  // for a bug of a server.
  std::string tested_text() const;
  // True for the first and all newer versions, if the evaluators of the implementation are those of the
  // product.
  bool may_contain(const ImplementationRecord& implementation) const;
};

// A minimal program of a bug, and how it fails. With a name, every run replays it as the test Findings.NAME.
struct BugProgram {
  std::string name, requirement;  // requirement: of the test; both may be empty
  Difference difference;
  std::string captured;  // Failure::captured, if only this value is the bug; empty: any
  std::string commands;  // as JSON text (gl/case_json.h)
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
  std::string
      component;  // the part of the product as its bug tracker calls it, "llvmpipe"; empty: evaluators
  AffectedVersions affects;
  std::vector<RequirementId> requirements;
  std::string clause;
  Quote quote;                      // empty: that of the first requirement
  std::string expected, captured;   // the required and the observed result of the program
  std::string cause;                // the root cause in the library, in words, with the function
  bool outside_evaluators = false;  // explicit vertices or other commands show it as well
  bool suspected = false;           // the cause was read from the source, not proven by a repair
  std::string real_programs;        // the effect on real programs
  std::string verified;             // the way in which the bug was verified
  // Empty if JSON cannot express one.
  std::vector<BugProgram> programs;
  // Statements of C, with a GL that is current, which show the bug and print it. Reports show them, or else
  // the first program. `fails` is a C expression that is true then; empty: the library crashes or hangs.
  std::vector<std::string> example;
  std::string fails;
  std::string context;  // kind of context of the example: kCoreProfile or kIndirectGlx; empty: any
  std::vector<FailingTests> tests;  // Findings.NAME of `programs` included

  static constexpr char kCoreProfile[] = "core profile", kIndirectGlx[] = "indirect GLX";

  // True if the library crashes or hangs in the programs.
  bool dies() const;
  // Returns `quote`, or that of the first requirement if evaluators are to blame; empty: there is none.
  Quote quoted_rule() const;
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

// Returns descriptions of the mistakes in known bugs: missing fields, duplicate IDs and names, and
// requirements that do not exist.
std::vector<std::string> lint(const std::vector<KnownBug>& bugs);

// Returns the text of docs/known-bugs.md. `programs_as_c` has the minimal program of each bug as
// C; empty: none.
std::string known_bugs_as_markdown(const std::vector<KnownBug>& bugs,
                                   const std::vector<std::string>& programs_as_c);

}  // namespace evalcts
