// A distinct bug of an implementation: the failures of a run that one minimal program explains.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/test_record.h>

namespace evalcts {

struct Bug {
  // The requirement and a hash of the cause: "EV-COORD-CURRENT-5f3c". Every run that finds the bug gives it
  // the same ID.
  std::string id;
  std::string title;  // one sentence
  // The property that the failures share: the normalised minimal program and the kind of difference, or, if
  // the bug was not reduced, the requirement, the kind of difference and the family of the tests.
  std::string cause;

  std::vector<RequirementId> requirements;  // violated by the minimal program, the decisive one first
  std::string clause;                       // the violated passage: "GL 2.1 5.1; glEvalCoord page"
  Level level = Level::kMust;
  Verdict verdict = Verdict::kFail;  // crash, timeout, fail or quality warning

  // The failure of the minimal program; `calls` are its commands as C, with values in decimal and
  // hexadecimal. If the bug was not reduced: the first failure of its first test.
  Failure failure;
  // The minimal program as JSON text, see gl/case_json.h; `evalcts reproduce` replays it. Empty if it was not
  // reduced.
  std::string commands;
  std::string why_not_reduced;      // empty if it was reduced
  bool outside_evaluators = false;  // the bug also shows with explicit vertices instead of evaluation

  std::vector<std::string> tests;       // names of the failing tests that the bug explains, sorted
  std::vector<RequirementId> explains;  // requirements of these tests, sorted

  std::string known;                  // ID of this bug in suites/bugs; empty if it is not a known bug
  std::string known_in;               // "Mesa 22.3" in the label "known in Mesa 22.3"
  bool breaks_real_programs = false;  // a program of the theme RealPrograms fails because of it

  bool is_reduced() const { return why_not_reduced.empty(); }
};

// Sorts by importance: bugs that break real programs, then must before interpretation before quality, crashes
// and timeouts before fails, then those that explain more tests.
void sort_by_importance(std::vector<Bug>& bugs);

}  // namespace evalcts
