// Sees everything that a test runs, and writes the case that fails as a stand-alone C program: before each
// case, so that a crash leaves the program of the case in flight, and with its check at the first failure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/check.h>
#include <evalcts/judge/judge.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

class Reproduction {
 public:
  // Writes to `file`, and only where `file` is named; throws std::runtime_error where that fails.
  Reproduction(Implementation& implementation, std::string file);
  ~Reproduction();

  // The implementation to run the test against.
  Implementation& implementation();

  // A new case of the test: what was run before has nothing to do with it.
  void begin_case();

  // The check behind one of `all` mismatches that a capture showed. Which answer it rests on is found by
  // experiment: `rejudge` observes and judges the case once more, on an implementation that gives the
  // recorded answers with one of them changed. None if no single answer is behind it.
  using Rejudge = std::function<std::vector<Mismatch>(Implementation&)>;
  std::optional<gl::Check> check_of(const Mismatch& mismatch, const std::vector<Mismatch>& all,
                                    const Rejudge& rejudge) const;

  // The first failure ends the recording.
  // `check`: what decides it; missing if that is a comparison of the test's own.
  void failed(const Failure& failure, const std::optional<gl::Check>& check);
  // The check of the first failure, as it was written.
  const std::optional<gl::Check>& check() const { return check_; }

 private:
  class Recorder;
  std::unique_ptr<Recorder> recorder_;
  std::string file_;
  std::optional<gl::Check> check_;
};

}  // namespace evalcts
