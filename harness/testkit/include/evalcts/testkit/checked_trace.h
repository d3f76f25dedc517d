// The result of a case that was run without a capture, and the checks on its answers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/check.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/player.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

class Test;
enum class Observed : unsigned;  // see blame.h

// A failed check is recorded with the calls of the case and does not stop the test.
class CheckedTrace {
 public:
  // `trace`: the answers of the delivered case.
  CheckedTrace(Test& test, gl::DeliveredCase delivered, const gl::Trace& trace);

  // Returns the answers to the commands of the case before delivery.
  const gl::Trace& trace() const { return trace_; }

  // Checks that GetError returned one of these errors. The message says "missing error", "spurious error" or
  // "wrong error". The error is that of the command `raises`, which is the one before GetError by default.
  void expect_error(gl::Ref get_error, const std::vector<GLenum>& allowed);
  void expect_error_of(gl::Ref raises, gl::Ref get_error, const std::vector<GLenum>& allowed);
  void expect_no_error(gl::Ref get_error) { expect_error(get_error, {GL_NO_ERROR}); }
  // Checks the value that a command (IsEnabled, ...) returned.
  void expect_result(gl::Ref command, std::int64_t expected);
  // Checks that the query wrote exactly these values (compared as numbers, so that -0 equals +0) and nothing
  // after them.
  template <class T>
  void expect_values(gl::Ref query, const std::vector<T>& expected) {
    check_values(query, {expected.begin(), expected.end()}, 0);
  }
  // Checks the values with a relative tolerance, for queries that may lose precision in conversions.
  template <class T>
  void expect_values_near(gl::Ref query, const std::vector<T>& expected, double relative) {
    check_values(query, {expected.begin(), expected.end()}, relative);
  }
  // Checks that the query wrote as many values as there are elements in `permitted`, each in one of the
  // intervals [first, second] of its element. `expected`: the likeliest values, for the message.
  using Intervals = std::vector<std::pair<double, double>>;
  void expect_permitted(gl::Ref query, const std::vector<Intervals>& permitted,
                        const std::vector<double>& expected);
  // Returns true if that check succeeds.
  bool is_permitted(gl::Ref query, const std::vector<Intervals>& permitted) const;
  // Returns the values that the query wrote.
  std::vector<double> written_values(gl::Ref query) const;
  // True for GetBooleanv, GetIntegerv, GetFloatv and GetDoublev.
  bool is_query_of_state(gl::Ref query) const;
  // Checks that the query did not write to its array.
  void expect_nothing_written(gl::Ref query);
  // Returns the number of checks that have failed so far.
  std::size_t failures() const { return failures_; }

  // Checks that two queries gave the same answer, bit for bit. Succeeds if one of them was left
  // out (index -1).
  void expect_same(gl::Ref before, gl::Ref after);
  // Checks any other condition on the answer of the command. `captured` and `expected` are texts
  // for the reader.
  void expect(bool holds, gl::Ref command, const std::string& message, const std::string& expected,
              const std::string& captured);

  // Makes the following checks observations of this kind, see Test::fail().
  void set_observed(Observed observed) { observed_ = observed; }
  // Checks that fail from here on are shown in this plot, unless a failure of the test has one already.
  // Empty: no plot.
  void set_plot(std::function<std::optional<Plot>()> plot) { plot_ = std::move(plot); }

 private:
  void check_values(gl::Ref query, const std::vector<double>& expected, double relative);
  // `check`: the condition that a C program can decide.
  void fail(gl::Check check, const Difference& difference, const std::string& message,
            const std::string& expected, const std::string& captured);
  // Returns the place of a wrong answer: "GetMap GL_COEFF", "Get GL_CURRENT_COLOR", "IsEnabled
  // GL_MAP_VERTEX_3".
  std::string place_of(gl::Ref query) const;

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
  std::optional<Observed> observed_;
  std::function<std::optional<Plot>()> plot_;
  std::size_t failures_ = 0;
};

}  // namespace evalcts
