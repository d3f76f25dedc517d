// Judges programs by the executable specification, and keeps what differs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/testkit/test.h>

namespace evalcts::fuzz {

// A difference of a program from the executable specification.
struct Finding {
  gl::Case program;
  Failure failure;

  // Set by name_finding() for a minimal program, see normal_form.h.
  std::string cause = {}, title = {}, requirement = {};
  // ID of the known bug whose own program shows this difference here; empty if there is none. The finding
  // then has this program.
  std::string known = {};
  // The library dies as well if explicit vertices take the place of evaluations. Other differences that
  // explicit commands show as well are no findings.
  bool outside_evaluators = false;
};

// Returns the program without commands that the implementation does not provide, or that use features that it
// does not declare.
gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program);

// The result of judge_program().
struct Judged {
  std::vector<Failure> failures;  // the first few; none if the program does what is specified
  bool judged = true;             // at least some effects of the program could be observed
  bool in_full = true;            // all effects of the program could be observed
};
// Judges the program, whose outcome must be `specified`, on the implementation. `attributes`: the attributes
// of vertices that are compared. Throws std::logic_error for an internal error of evalcts.
Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified,
                     Outcomes outcomes = Outcomes::kAll, Attributes attributes = kAllAttributes);

// Returns the outcomes, and the attributes, in which a difference of this kind shows.
Outcomes outcomes_of(const std::string& kind);
Attributes attributes_of(const std::string& kind);

}  // namespace evalcts::fuzz
