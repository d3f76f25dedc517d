// The programs of the register of known bugs, by which bugs are recognised.
#pragma once

#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/results/known_bugs.h>

namespace evalcts::fuzz {

struct KnownProgram {
  std::string bug;  // ID
  BugProgram record;
  gl::Case program;  // parsed; its identity is the name

  // Returns the cause that the program has according to the register (Finding::cause).
  std::string cause(int max_eval_order) const;
  // Returns true if the failure is the one that the register describes.
  bool is_shown_by(const Failure& failure) const;
};
// Returns the programs of all known bugs, in the order of the register.
const std::vector<KnownProgram>& known_programs();

}  // namespace evalcts::fuzz
