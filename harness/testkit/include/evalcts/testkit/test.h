// What a suite is written in: tests that name the requirements they decide, and what a test may do.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/capture/varyings.h>
#include <evalcts/gl/case.h>
#include <evalcts/gl/check.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/player.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/judge.h>
#include <evalcts/judge/topology.h>
#include <evalcts/results/depth.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// The rule does not apply to this implementation: its version or extension is missing, or it is no GL and
// does not declare what the rule is about.
struct NotSupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Reproduction;

// How captures, by name, take primitives apart, by their modes and numbers of vertices.
using KnownTopologies = std::map<std::pair<std::string, Shape>, Topology>;

// What all tests of a process are run against.
struct Subject {
  Implementation* implementation = nullptr;
  ImplementationInfo info;
  Captures* captures = nullptr;
  Depth depth = Depth::full;
  std::uint32_t seed = 1;
  std::map<std::string, std::string> readings;       // of ambiguous text that are asked for, by its name
  std::function<void(const gl::Case&)> before_case;  // may be empty
  Reproduction* reproduction = nullptr;              // where a C program of the first failure is wanted
  std::shared_ptr<KnownTopologies> topologies = std::make_shared<KnownTopologies>();
};

class Test;

// A case that was played without a capture, and the checks on what it answered. Each check that does not hold
// is recorded with the case's calls and does not stop the test.
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
  // Two queries gave the same answer, bit for bit.
  void expect_same(gl::Ref before, gl::Ref after);
  // Anything else: `captured` and `expected` are for the reader.
  void expect(bool holds, gl::Ref command, const std::string& message, const std::string& expected,
              const std::string& captured);

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
};

// Handed to the body of each test.
class Test {
 public:
  Test(const Subject& subject, TestRecord& record) : subject_(subject), record_(record) {}

  const ImplementationInfo& gl() const { return subject_.info; }
  // An order that has to be accepted, as large as possible: MAX_EVAL_ORDER up to 64, or 8 if the
  // implementation claims less (EV-INIT-MAXORDER is a test of its own) or does not answer.
  int max_order() const;
  // The order beyond which all are rejected. Throws NotObservable if MAX_EVAL_ORDER is not answered: then it
  // may be any from 8 on.
  int order_limit() const;
  // At full depth quick for all deliveries but the plain ones: what remains to be shown there is that they do
  // the same.
  Depth depth() const;
  // One of three values by depth.
  int by_depth(int quick, int full, int thorough) const;
  // Random numbers of this test: the same for the same seed, whatever other tests run.
  std::mt19937& random() { return random_; }

  // Throws NotSupported below the version unless the extension is advertised.
  void require(int major, int minor, const std::string& or_extension = {}) const;

  // Throws NotObservable if the state that a case begins with was restored by calls.
  void require_initial_state() const;

  // From now on each case goes through this delivery.
  void deliver_by(const gl::Delivery& delivery) { delivery_ = delivery; }

  // From now on the order counts in which a mesh of EvalMesh2 is drawn. Other tests find its points, lines
  // and polygons wherever they come in it, so that what draws them in another order fails where that is said.
  void judge_order_of_meshes() { judges_order_of_meshes_ = true; }

  // Plays the case in a fresh context. Errors that the case leaves behind unasked are failures.
  Played play(const gl::Case& script);

  // Observes what the case emits through the first capture that can see it (in one test of 32, at
  // thorough depth in all, through the others as well: they have to agree), and judges it against the
  // executable specification at the level of the test. All attributes that the capture shows are judged.
  // Those of the `required` ones that no capture shows are recorded as unobserved; if none is shown, the test
  // is not-observable.
  void expect_emission(const gl::Case& script, Attributes required);
  // The same with a prediction that is at hand. Not through a delivery. Unless `measured`, the accuracy of
  // what is judged, which takes longer than the verdict, is not recorded.
  void expect_emission(const gl::Case& script, const Prediction& prediction, Attributes required,
                       bool measured = true);

  // Observes a case that draws these kinds of primitives through the first capture that sees `required`; the
  // test judges by itself.
  Observation observe(const gl::Case& script, Attributes required, std::size_t most_vertices,
                      PrimitiveKinds kinds = kPoints);
  // What is wrong with what came out; may throw NotObservable.
  using OwnJudge = std::function<std::vector<Mismatch>(const Observation&)>;
  // The same, and fails for each mismatch that the test's own judge finds. What it looks at may come after
  // all lists of the case.
  enum class Judged { in_lists, after_lists };
  void expect_observation(const gl::Case& script, Attributes required, std::size_t most_vertices,
                          PrimitiveKinds kinds, const OwnJudge& judge, Judged judged = Judged::in_lists);

  // What comes out through a vertex shader of the test's own. Throws NotObservable.
  RecordedVaryings record_varyings(const gl::Case& script, const VaryingShader& shader,
                                   std::size_t most_vertices);

  // The implementation follows this reading of an ambiguous text: both are named in "readings" of the
  // catalogue. A failure where another reading was asked for.
  void follows(const std::string& text, const std::string& reading);

  // `calls` is asked for those failures only that are kept in full.
  // `check`: decides the failure in a stand-alone C program.
  void fail(Failure failure, const std::function<std::vector<std::string>()>& calls = {},
            const std::optional<gl::Check>& check = {});

  // For the runner.
  void run(const std::function<void(Test&)>& body);

 private:
  friend class Played;
  gl::DeliveredCase begin_case(const gl::Case& script);
  void judge_emission(const gl::Case& delivered, const Prediction& prediction, Attributes required,
                      bool measured);
  bool cross_checked(const Prediction& prediction) const;
  // The first capture that shows all of these attributes exactly. Throws NotObservable.
  const Capture& capture_for(Attributes required, PrimitiveKinds kinds) const;
  // The capture that shows most of the required attributes, and up to `most` - 1 more that show the same.
  // Throws NotObservable.
  std::vector<const Capture*> captures_showing(Attributes required, PrimitiveKinds kinds, bool nonpositive_w,
                                               std::size_t most) const;
  void note_capture(const Capture& capture);
  // A failure for each mismatch that `judge` finds in what the capture saw of the case.
  void fail_each(const gl::Case& script, const Capture& capture, const Wanted& wanted,
                 const Observation& seen, const OwnJudge& judge);
  Topology topology_of(const Prediction& prediction, const Capture& capture) const;

  // A case that was observed through display lists.
  struct Listed {
    gl::Case script;
    const Capture* capture;
    Attributes judged;
  };
  void note_lists(const gl::Case& script, const Capture& capture, Attributes judged);
  void require_lists_of_vertices(const Listed& listed) const;

  const Subject& subject_;
  TestRecord& record_;
  bool judges_order_of_meshes_ = false;
  std::optional<gl::Delivery> delivery_;
  bool lists_used_ = false;
  std::optional<Listed> lists_in_doubt_;  // until explicit vertices come right out of them
  Attributes unobserved_ = 0;             // of those that the test is about
  std::uint64_t cases_ = 0, failed_cases_ = 0, last_failed_case_ = 0;
  std::mt19937 random_;
};

}  // namespace evalcts
