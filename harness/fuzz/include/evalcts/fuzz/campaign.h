// Judges random programs on one implementation, in this process.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/testkit/test.h>

namespace evalcts::fuzz {

struct Campaign {
  std::uint32_t first = 0;                // number of the first program
  std::uint32_t step = 1;                 // difference between the numbers of successive programs
  std::optional<std::uint32_t> programs;  // number of programs; none: until the time is over
  double seconds = 0;                     // time limit; 0: none
  int length = 120;                       // approximate number of commands of a program
  int most_attempts = 400;                // maximum number of candidates for the reduction of a program
  std::vector<std::string> known = {};    // known causes; programs that they explain are not reduced further
  // File to which each candidate of a reduction is written before it runs, so that the candidate is known if
  // the library dies in it. The file is empty at other times. An empty name means no file.
  std::string in_flight = {};
  std::vector<std::string> deadly = {};  // candidates (JSON) in which the library has died; not run again
  // True: each program has its own context. False: most programs share a context, if the implementation can
  // create it beside others. Creating a context and its shaders takes most of the time of a program. A
  // difference in the shared context must be reproduced in a fresh context, alone or after some of the
  // earlier programs.
  bool fresh_contexts = false;
};

// A difference of a program from the executable specification.
struct Finding {
  gl::Case program;
  Failure failure;  // the first difference
  // Key of the cause: the words of the program's commands, regardless of their arguments and order, and the
  // kind of difference: "Begin, Enable, End, EvalCoord1, Map1: color".
  std::string cause;
  std::string requirement;          // the violated requirement, guessed from the commands
  bool outside_evaluators = false;  // a control (gl/explicit_vertices.h) fails in the same way
};

// Returns the program without commands that the implementation does not provide, or that use features that it
// does not declare.
gl::Case with_what_exists(const ImplementationInfo& info, const gl::Table& table, const gl::Case& program);

// The result of judge_program().
struct Judged {
  std::optional<Finding> finding;
  bool judged = true;   // at least some effects of the program could be observed
  bool in_full = true;  // all effects of the program could be observed
};
// Judges the program, whose outcome must be `specified`, on the implementation. Throws std::logic_error for
// an internal error of evalcts.
Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified,
                     Outcomes outcomes = Outcomes::kAll);

// Returns the key of a cause, see Finding::cause. `what`: the difference, "position.x of vertex
// 3", or "crash".
std::string cause_of(const gl::Case& program, const std::string& what);

// Returns the most specific requirement that the commands concern, see Finding::requirement.
std::string requirement_of(const gl::Case& program, const std::string& what);

// Returns the commands of the program that the cause names, if they have this cause; otherwise none. If the
// cause does not contain GetError, commands that raise errors are left out. `still` (true if a program still
// differs) must return true for these commands, and false if all commands with any one word are removed,
// because that would be another cause.
std::optional<gl::Case> reduced_to(const std::string& cause, const gl::Case& program,
                                   const Specified& specified,
                                   const std::function<bool(const gl::Case&)>& still);

// Returns the controls of the program, one for each function of gl/explicit_vertices.h.
// with_calls_of_no_list() is included only if the program uses display lists.
std::vector<gl::Case> controls_without_evaluators(const gl::Case& program);

}  // namespace evalcts::fuzz
