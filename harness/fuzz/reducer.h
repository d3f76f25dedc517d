// Reduces programs that differ from the executable specification to minimal ones. Private to harness/fuzz.
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>

#include <evalcts/fuzz/finding.h>
#include <evalcts/fuzz/known_programs.h>
#include "shared_context.h"
#include "shrink.h"

namespace evalcts::fuzz {

// Returns the commands of the program whose stems occur in the minimal program as well ("Map1", "EvalCoord1";
// the form of the arguments does not count). Returns none if the program does not have all of these stems.
std::optional<gl::Case> with_stems_of(const gl::Case& minimal, const gl::Case& program);

// Returns true if these commands still show the difference, and no longer do so without all commands of any
// one stem: the program then has the bug of the minimal program. Commands that have to raise an error, which
// `specified` tells, are left out unless the minimal program asks for errors.
bool is_explained_by(const gl::Case& minimal, const gl::Case& program, const Specified& specified,
                     const InterestingnessTest& is_interesting);

// Keeps what may have bugs of its own out of the candidates of a reduction: a mesh or a point of the initial
// grid, evaluation of an initial map, and calls of a list that is not defined.
class Alikeness {
 public:
  enum class InitialMaps { kNot, kAllowed };

  explicit Alikeness(const gl::Case& program);
  // Returns false if the candidate does such a thing, and the program does not.
  bool holds_for(const gl::Case& candidate, InitialMaps initial_maps = InitialMaps::kNot) const;

 private:
  bool keeps_to_grids_, keeps_to_maps_, calls_missing_list_;
};

// Keeps the identity of a difference (Difference) while it reduces: a candidate counts only if it differs in
// the same way. The controls of the test kit (ExplicitControl) belong to each judgement, so that a difference
// that explicit commands show as well does not count.
class Reducer {
 public:
  // Functions of the caller that run around each program. Each may be empty.
  struct Hooks {
    std::function<bool()> is_over = {};  // returns true if the time is over; no more programs are run then
    // Called before a program runs. If it returns false, the program is not run, for example because the
    // library has died in it before.
    std::function<bool(const gl::Case&)> try_start = {};
    std::function<void()> finish = {};                         // called when no program is running any more
    std::function<void(const Finding& finding)> smaller = {};  // called with the smallest program so far
    // Returns true if the library has died in an earlier attempt. The shared context is not used then.
    std::function<bool()> is_careful = {};
  };

  // `shared`: a context in which programs are tried first; may be null. `most_attempts`: approximate maximum
  // number of programs for a reduction. `subject` and `shared` must outlive the object.
  Reducer(const Subject& subject, SharedContext* shared, int most_attempts, Hooks hooks);

  // Runs the program in a fresh context. Returns its difference that is like the given one; none if there is
  // none.
  std::optional<Finding> find(const gl::Case& program, const Difference& difference) const;

  // Returns the finding with a minimal program and a name. If a known program explains it, the result has
  // that program.
  Finding reduce(Finding finding);

  // Returns the finding that the difference of the program is reduced to; none if the program does not differ
  // in this way. A large program whose difference is complete is not run as a whole if a part of it differs.
  std::optional<Finding> reduce(const gl::Case& program, const Difference& difference);

  // Returns the finding of a known program if the shared context shows that it explains the difference,
  // otherwise nothing. Much faster than reduce(), which spends most of its time on fresh contexts.
  std::optional<Finding> recognise(const gl::Case& program, const Difference& difference);

  // Runs the first program of the known bug that fails as the register describes. Returns its finding; none
  // if there is none.
  std::optional<Finding> prove(const std::string& bug);

  // Returns the number of findings that reduce() has made without a known program.
  std::size_t new_findings() const { return new_findings_; }

 private:
  using Judge = std::function<Judged(const gl::Case&, const Specified&, Outcomes, Attributes)>;
  // A program by which others are recognised: of the register, or a minimal one that was found here.
  struct Known {
    const KnownProgram* record = nullptr;  // null: found here
    gl::Case program;
    Difference difference;
    std::string cause;
    bool was_run = false;            // true unless it is a program of the register that has not been run
    std::optional<Finding> finding;  // none: it has not been run, or does not fail here as described
  };

  bool is_over() const { return hooks_.is_over && hooks_.is_over(); }
  SharedContext* shared() const { return hooks_.is_careful && hooks_.is_careful() ? nullptr : shared_; }
  Judge fresh() const;
  Judge in_shared() const;
  // Returns true if no part of the program shows the difference.
  bool is_minimal(const gl::Case& program, const Difference& difference) const;
  // Returns the difference of a candidate that is like the given one.
  std::optional<Finding> difference_of(const gl::Case& candidate, const Difference& difference,
                                       const Judge& judge) const;
  // Returns the finding of the first known program that explains the difference of the program.
  const Finding* explanation(const gl::Case& program, const Difference& difference, bool tries_shared);
  // Runs a program of the register, if it was not run yet. Returns its finding, null if it does not fail here
  // as described, or if a part of it does: this is then another bug.
  const Finding* finding_of(Known& known);
  // Names the finding, and replaces it by that of a program of the register with the same cause and relation.
  void name(Finding& finding);

  const Subject& subject_;
  SharedContext* shared_;
  const gl::Table table_;
  const int max_order_;
  const int most_attempts_;
  const Hooks hooks_;
  std::list<Known> known_;  // found here, then bugs of the same product, then others; small programs first
  std::size_t new_findings_ = 0;
  mutable std::size_t not_started_ = 0;  // number of programs that try_start has rejected
};

}  // namespace evalcts::fuzz
