// Reduces programs that differ from the executable specification to minimal ones. Private to harness/fuzz.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <evalcts/fuzz/campaign.h>
#include "shared_context.h"

namespace evalcts::fuzz {

class Reducer {
 public:
  // Functions of the caller that run around each program. Each may be empty.
  struct Hooks {
    std::function<void()> alive = {};    // before each program
    std::function<bool()> is_over = {};  // true: the time is over, no program is run any more
    // Before a program is run; false: it is left out, because the library has died in it before.
    std::function<bool(const gl::Case&)> takes_off = {};
    std::function<void()> landed = {};                         // after the last program of a reduction
    std::function<void(const Finding& finding)> smaller = {};  // the smallest program so far
  };

  // `causes`: those that have been seen. `shared`: a context in which programs are tried first; may be null.
  Reducer(const Subject& subject, SharedContext* shared, std::vector<std::string> causes, int most_attempts,
          Hooks hooks);

  // Returns the cause of the difference, with a program that is as small as it can be if the cause is new.
  // `careful`: not by way of the shared context, because the library has died on the way.
  Finding explain(const gl::Case& program, Finding finding, bool careful = false);

 private:
  const Subject& subject_;
  SharedContext* shared_;
  const gl::Table table_;
  const int max_order_;
  std::vector<std::string> causes_;
  const int most_attempts_;
  const Hooks hooks_;
};

}  // namespace evalcts::fuzz
