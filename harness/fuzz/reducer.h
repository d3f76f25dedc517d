// Reduces programs that differ from the executable specification to minimal ones. Private to harness/fuzz.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/fuzz/campaign.h>
#include "shared_context.h"

namespace evalcts::fuzz {

class Reducer {
 public:
  // Functions of the caller that run around each program. Each may be empty.
  struct Hooks {
    std::function<void()> alive = {};    // called before each program
    std::function<bool()> is_over = {};  // returns true if the time is over; no more programs are run then
    // Called before a program runs. If it returns false, the program is not run, for example because the
    // library has died in it before.
    std::function<bool(const gl::Case&)> try_start = {};
    std::function<void()> finish = {};                         // called after the last program of a reduction
    std::function<void(const Finding& finding)> smaller = {};  // called with the smallest program so far
  };

  // `causes`: the known causes. `shared`: a context in which programs are tried first; may be null.
  // `most_attempts`: approximate maximum number of programs for a reduction. `subject` and `shared` must
  // outlive the object.
  Reducer(const Subject& subject, SharedContext* shared, std::vector<std::string> causes, int most_attempts,
          Hooks hooks);

  // Returns the finding with its cause. If the cause is new, the program is minimal, and the cause becomes
  // known. If `careful`, the shared context is not used to shrink the program, because the library has died
  // in an earlier attempt. `tried`: true if recognise() has already returned nothing for the program.
  Finding explain(gl::Case program, Finding finding, bool careful = false, bool tried = false);

  // Returns the finding with a known cause if the shared context shows that the cause explains the finding,
  // otherwise nothing. Much faster than explain(), which spends most of its time on fresh contexts.
  std::optional<Finding> recognise(const gl::Case& program, const Finding& finding);

  // Returns the number of known causes.
  std::size_t causes() const { return causes_.size(); }

 private:
  using Judge = std::function<Judged(const gl::Case&, const Specified&)>;
  // Returns the difference of a candidate if it is of the wanted kind.
  std::optional<Finding> difference_of(const gl::Case& candidate, const std::string& wanted,
                                       const Judge& judge) const;
  // Returns the first known cause of the wanted kind for which `applies` returns true with a form of the
  // program.
  using Applies =
      std::function<bool(const std::string& cause, const gl::Case& form, const Specified& of_form)>;
  std::optional<std::string> first_cause(const gl::Case& program, const std::string& wanted,
                                         const Applies& applies) const;

  const Subject& subject_;
  SharedContext* shared_;
  const gl::Table table_;
  const int max_order_;
  std::vector<std::string> causes_;
  const int most_attempts_;
  const Hooks hooks_;
};

}  // namespace evalcts::fuzz
