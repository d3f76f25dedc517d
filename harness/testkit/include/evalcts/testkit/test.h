// Tests: they name the requirements that they decide, run cases and report failures.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/capture/varyings.h>
#include <evalcts/gl/case.h>
#include <evalcts/gl/check.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/judge.h>
#include <evalcts/results/test_record.h>
#include <evalcts/testkit/explicit_control.h>
#include <evalcts/testkit/played.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

// The rule does not apply to this implementation: its version or extension is missing, or it is no GL and
// does not declare what the rule is about.
struct NotSupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Handed to the body of each test.
class Test {
 public:
  Test(const Subject& subject, TestRecord& record) : subject_(subject), record_(record), control_(subject) {}

  const ImplementationInfo& gl() const { return subject_.info; }
  // An order that has to be accepted, as large as possible (see ImplementationInfo).
  int max_order() const { return gl().max_order(); }
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
  void deliver_by(const gl::Delivery& delivery) {
    delivery_ = delivery;
    if (other_lists_) delivery_.lists = *other_lists_;
  }

  // True if the cases of this test go through display lists.
  bool is_delivered_in_lists() const { return delivery_.lists != gl::Lists::kNone; }

  // From now on a failure violates these requirements only, some of those of the test or of others; without
  // any, all of the test.
  void decide(std::vector<RequirementId> requirements) { decided_ = std::move(requirements); }

  // The requirement of this test with the given ID, of the dimension that the test is about.
  RequirementId requirement(const std::string& id) const;

  // From now on values that no map supplies are not the subject of the test: a wrong one violates
  // Mismatch::rule_of_current_values, and the test leaves its own requirements undecided.
  void leave_current_values_to_their_rules() { judges_current_values_ = false; }

  // From now on the order counts in which a mesh of EvalMesh2 is drawn. Other tests find its points, lines
  // and polygons wherever they come in it, so that what draws them in another order fails where that is said.
  void judge_order_of_meshes() { judges_order_of_meshes_ = true; }

  // Appends commands that the test can do without, apart from those that crash the implementation; the record
  // names these. Returns where each command has come to stand; no position (-1) if it was left out. No
  // command uses what another one gives.
  std::vector<gl::Ref> append_optional(gl::Case& c, const gl::Case& optional);

  // Runs the case in a fresh context. Errors that the case leaves behind unasked are failures.
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
  // Returns the mismatches of an observation; may throw NotObservable.
  using OwnJudge = std::function<std::vector<Mismatch>(const Observation&)>;
  // The same, and fails for each mismatch that the test's own judge finds. What it looks at may come after
  // all lists of the case.
  enum class Judged { kInLists, kAfterLists };
  void expect_observation(const gl::Case& script, Attributes required, std::size_t most_vertices,
                          PrimitiveKinds kinds, const OwnJudge& judge, Judged judged = Judged::kInLists);

  // Returns the outputs of a vertex shader of the test's own. Throws NotObservable.
  RecordedVaryings record_varyings(const gl::Case& script, const VaryingShader& shader,
                                   std::size_t most_vertices);

  // The implementation follows this reading of an ambiguous text: both are named in "readings" of the
  // catalogue. A failure where another reading was asked for.
  void follows(const std::string& text, const std::string& reading);

  // `calls` is asked for those failures only that are kept in full.
  // `check`: decides the failure in a stand-alone C program.
  // `rule`: the requirement that it violates; empty: those of decide().
  void fail(Failure failure, const std::function<std::vector<std::string>()>& calls = {},
            const std::optional<gl::Check>& check = {}, const std::string& rule = {});
  // True if a failure has a plot already: one is enough for a test.
  bool has_plot() const;

  // Runs the test; called by the runner.
  void run(const std::function<void(Test&)>& body);

 private:
  gl::DeliveredCase begin_case(const gl::Case& script);
  const Capture& choose_capture(Attributes required, PrimitiveKinds kinds);
  void note_capture(const Capture& capture);

  // Sets the violated requirements of a test that failed through display lists: the row of the list is
  // violated only if the same commands are right without a list, or in a list of the simplest kind.
  void blame_list_or_commands(const std::function<void(Test&)>& body);

  // One capture's observation of a case.
  struct Look {
    const Capture* capture;
    Topology topology;
    Observation observation;
  };
  JudgeOptions options_for(const gl::Case& script, const Capture& capture, Attributes required) const;
  std::vector<Look> look_at(const gl::Case& script, const Prediction& prediction, Attributes required,
                            std::size_t most_vertices);
  void judge_emission(const gl::Case& delivered, const Prediction& prediction, Attributes required,
                      bool measured);
  // A failure for each mismatch that `judge` finds in what the capture saw of the case. With a prediction,
  // the first one in positions or vertices gets a plot, otherwise the first.
  void fail_each(const gl::Case& script, const Capture& capture, const Wanted& wanted,
                 const Observation& seen, const OwnJudge& judge, const Prediction* prediction = nullptr);

  const Subject& subject_;
  TestRecord& record_;
  bool judges_order_of_meshes_ = false, judges_current_values_ = true;
  std::vector<RequirementId> decided_;
  bool violates_all_ = false;  // a failure was not told apart
  gl::Delivery delivery_;
  std::optional<gl::Lists> other_lists_;  // in the place of those of the delivery
  bool lists_used_ = false;
  ExplicitControl control_;
  Attributes unobserved_ = 0;  // of those that the test is about
  std::uint64_t cases_ = 0, failed_cases_ = 0, last_failed_case_ = 0;
  std::mt19937 random_;
};

}  // namespace evalcts
