// Random programs against one implementation, in this process.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/fuzz/as_specified.h>
#include <evalcts/gl/case.h>
#include <evalcts/testkit/test.h>

namespace evalcts::fuzz {

struct Campaign {
  std::uint32_t first = 0;                // number of the first program
  std::uint32_t step = 1;                 // to the next one
  std::optional<std::uint32_t> programs;  // how many; none: until the time is over
  double seconds = 0;                     // 0: no limit
  int length = 120;                       // commands of a program, about
  int most_attempts = 400;                // to make a failing program smaller
  std::vector<std::string> known = {};    // causes: what they explain is not made smaller
  // A program that is made smaller is written to this file before it is run, so that it is known where the
  // library dies in it; the file is empty meanwhile. Empty: nowhere.
  std::string in_flight = {};
  std::vector<std::string> deadly = {};  // such programs that the library has died in: not run again
  // A context for each program. Otherwise most share one, where the implementation makes contexts that live
  // beside it: making one, and shaders in it, takes most of the time of a program. What differs there has to
  // differ in a fresh one as well, at least behind programs that were run before.
  bool fresh_contexts = false;
};

// One difference from the executable specification.
struct Finding {
  gl::Case program;
  Failure failure;  // the first
  // Key of the finding's cause: the commands of the program, whatever their arguments and order, and what
  // differs: "Begin, Enable, End, EvalCoord1, Map1: color".
  std::string cause;
  std::string requirement;          // that is broken, as far as the commands tell
  bool outside_evaluators = false;  // the same goes wrong without them, see gl/explicit_vertices.h
};

// Returns the program without the commands that the implementation lacks, and without those that use what it
// does not declare.
gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program);

// The program, of which `specified` is, on the implementation. Throws std::logic_error on a fault of evalcts
// itself.
struct Judged {
  std::optional<Finding> finding;
  bool judged = true;   // at least some of what it does could be observed
  bool in_full = true;  // all of it could
};
Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified,
                     Look look = Look::kAll);

// See Finding::cause; "position.x of vertex 3" differs, or "crash".
std::string cause_of(const gl::Case& program, const std::string& what);

// The most special rule that the commands are about; see Finding::requirement.
std::string requirement_of(const gl::Case& program, const std::string& what);

// The commands of the program that the cause names, without those that raise errors where it has none: if
// `still` holds for them, and for no part of them that lacks one of its words, which would be another cause.
std::optional<gl::Case> reduced_to(const std::string& cause, const gl::Case& program,
                                   const Specified& specified,
                                   const std::function<bool(const gl::Case&)>& still);

// The controls of gl/explicit_vertices.h for each kind of commands that can stand in the place of evaluation;
// calls of lists only if the program has lists.
std::vector<gl::Case> controls_without_evaluators(const gl::Case& program);

}  // namespace evalcts::fuzz
