// Records the cases of a test, and writes the failing case as a stand-alone C program. The program is written
// before each case, so that it exists if the case crashes, and again with its check at the first failure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/c_program.h>
#include <evalcts/gl/check.h>
#include <evalcts/judge/judge.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

class Reproduction {
 public:
  // `implementation`: the implementation under test, which must outlive the object. `write`: called with each
  // C program, or "#error REASON" if there is none in this style.
  using Write = std::function<void(const std::string& program)>;
  Reproduction(Implementation& implementation, Write write, gl::CStyle style);
  ~Reproduction();

  // Returns the recording implementation, on which the test must run.
  Implementation& implementation();

  // Returns true if the C program of a failure was written.
  bool is_complete() const;

  // Must be called at the beginning of each case of the test. Discards the recorded commands of earlier
  // cases. A control is not recorded and discards nothing, because it may run after the case that it belongs
  // to.
  void begin_case(const gl::Case& script);

  // Observes and judges the case again on the given implementation.
  using Rejudge = std::function<std::vector<Mismatch>(Implementation&)>;
  // Returns the check that decides `mismatch`, one of `all` mismatches of an observation; none if it does not
  // depend on a single answer. The answer is found by experiment: `rejudge` observes and judges the case
  // again on an implementation that gives the recorded answers, with one of them changed.
  std::optional<gl::Check> check_of(const Mismatch& mismatch, const std::vector<Mismatch>& all,
                                    const Rejudge& rejudge) const;

  // Writes the C program of the first failure and ends the recording. `check` decides the failure; none if
  // the test compared the answers by itself.
  void failed(const Failure& failure, const std::optional<gl::Check>& check);
  // Returns the check in the C program; none if there was no failure.
  const std::optional<gl::Check>& check() const { return check_; }

 private:
  class Recorder;
  std::unique_ptr<Recorder> recorder_;
  std::optional<gl::Check> check_;
};

}  // namespace evalcts
