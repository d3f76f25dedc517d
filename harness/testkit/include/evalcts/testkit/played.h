// A case that was run without a capture, and the checks on what it answered.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/gl/check.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/player.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

class Test;

// Each check that does not hold is recorded with the case's calls and does not stop the test.
class Played {
 public:
  // `trace` is that of the case as it was delivered.
  Played(Test& test, gl::DeliveredCase delivered, const gl::Trace& trace);

  // The answers to the commands of the case as it was written.
  const gl::Trace& trace() const { return trace_; }

  // GetError gave one of these. The message says "missing error" or "spurious error".
  void expect_error(gl::Ref get_error, std::initializer_list<GLenum> allowed);
  void expect_no_error(gl::Ref get_error) { expect_error(get_error, {GL_NO_ERROR}); }
  // A returned value (IsEnabled, ...).
  void expect_result(gl::Ref command, std::int64_t expected);
  // The query wrote exactly these values (as numbers, -0 equal to +0) and nothing behind them.
  template <class T>
  void expect_values(gl::Ref query, const std::vector<T>& expected) {
    check_values(query, {expected.begin(), expected.end()}, 0);
  }
  // The same with a relative tolerance: what a query may lose in conversion.
  template <class T>
  void expect_values_near(gl::Ref query, const std::vector<T>& expected, double relative) {
    check_values(query, {expected.begin(), expected.end()}, relative);
  }
  // The query left its array alone.
  void expect_nothing_written(gl::Ref query);
  // Two queries gave the same answer, bit for bit. Nothing is expected if one of them was left out.
  void expect_same(gl::Ref before, gl::Ref after);
  // Anything else: `captured` and `expected` are for the reader.
  void expect(bool holds, gl::Ref command, const std::string& message, const std::string& expected,
              const std::string& captured);

  // Checks that fail from here on are shown in this plot, unless a failure of the test has one already. Empty: no plot.
  void set_plot(std::function<std::optional<Plot>()> plot) { plot_ = std::move(plot); }

 private:
  void check_values(gl::Ref query, const std::vector<double>& expected, double relative);
  std::vector<double> written_values(gl::Ref query) const;
  // `check`: what a C program can decide.
  void fail(gl::Check check, const std::string& message, const std::string& expected,
            const std::string& captured);

  gl::Ref as_delivered(gl::Ref command) const {
    return {delivered_.positions.at(static_cast<std::size_t>(command.index))};
  }
  // Throws NotObservable if the command is a query that the implementation does not answer.
  void require_answer(gl::Ref query) const;
  const gl::Command& command(gl::Ref written) const {
    return delivered_.script.commands().at(static_cast<std::size_t>(as_delivered(written).index));
  }

  Test& test_;
  gl::DeliveredCase delivered_;
  gl::Trace trace_;
  std::function<std::optional<Plot>()> plot_;
};

}  // namespace evalcts
