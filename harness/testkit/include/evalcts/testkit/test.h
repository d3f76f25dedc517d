// Defines the class Test, through which tests name the requirements that they decide, run cases
// and report failures.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <evalcts/capture/varyings.h>
#include <evalcts/gl/case.h>
#include <evalcts/gl/check.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/table.h>
#include <evalcts/gl/tokens.h>
#include <evalcts/judge/judge.h>
#include <evalcts/results/test_record.h>
#include <evalcts/testkit/checked_trace.h>
#include <evalcts/testkit/conditions.h>
#include <evalcts/testkit/explicit_control.h>
#include <evalcts/testkit/pipeline_probes.h>

namespace evalcts {

enum class Observed : unsigned;  // see blame.h

// The outcomes of a case to judge. The order in which a mesh draws its points, lines or quads is free except
// for kOrder. kAll judges the vertices only if the case has to draw some.
enum class Outcomes { kAll, kAnswers, kVertices, kOrder };

// The first argument of the body of each test.
class Test : public Conditions {
 public:
  Test(const Subject& subject, TestRecord& record) : Conditions(subject, record), control_(subject) {}

  // Makes all following cases go through this delivery.
  void deliver_by(const gl::Delivery& delivery) {
    delivery_ = delivery;
    if (other_lists_) delivery_.lists = *other_lists_;
  }

  // Makes following failures violate only these requirements, which need not be requirements of the test.
  // With an empty list, they violate those that the table in blame.cpp gives them, or all requirements of the
  // test.
  void decide(std::vector<RequirementId> requirements) { decided_ = std::move(requirements); }

  // Returns the requirement of this test with the given ID, or the half of it that the test decides. Throws
  // std::logic_error if the test does not decide it.
  RequirementId requirement(const std::string& id) const;

  // Makes the test judge the order in which EvalMesh2 draws. Other tests accept the points, lines and
  // polygons of a mesh in any order, so that an implementation with another order fails only in the tests of
  // this order.
  void judge_order_of_meshes() { judges_order_of_meshes_ = true; }

  // Runs the case in a fresh context. Errors that are pending at the end of the case are failures.
  CheckedTrace play(const gl::Case& script);

  // Runs the case, and judges all answers of its commands, including errors, and the vertices that it has to
  // draw by the executable specification, within the permitted tolerances (the accuracy rule,
  // EV-GETMAP-FLOAT). The table in blame.cpp says which of the test's requirements a wrong answer violates.
  // If an answer is wrong in a case with commands that are rejected between Begin and End, other commands
  // have to be rejected there, too. Throws NotObservable.
  void judge(const gl::Case& script);
  // The same for answers and errors only: other tests judge the vertices.
  void judge_answers(const gl::Case& script);
  // The same for vertices only, of a test that is about these attributes, or about vertices that must not be
  // drawn. All attributes that the best capture shows are judged; attributes in `about` that no capture shows
  // are recorded as unobserved, and if none of them is shown, the test is not-observable. In one test of 32
  // (at thorough depth in all tests), other captures observe the case, too, and must agree.
  void judge_vertices(const gl::Case& script, Attributes about);
  // Judges some outcomes and attributes by a given specification of the case. Vertices are judged only up to
  // the first 64 mismatches, and their accuracy is not recorded, because both take longer than the rest.
  // Throws std::logic_error if the test has a delivery.
  void judge_specified(const gl::Case& script, const Specified& specified, Outcomes outcomes,
                       Attributes attributes);

  // Makes the answers of these queries of the next judged case a snapshot: an answer violates a requirement
  // only if the same query has had another answer earlier, and the specification says that it does not
  // change. Other tests judge whether the answers themselves are right.
  void compare_only(const std::vector<gl::Ref>& queries);

  // Returns the largest subset of `required` that one capture shows exactly, and records the rest as
  // unobserved. For tests that can judge each attribute without the others. Throws NotObservable.
  Attributes shown_exactly(Attributes required, PrimitiveKinds kinds = kPoints);
  // Observes a case that draws these kinds of primitives through the first capture that shows `required`. The
  // test judges the observation itself. `most_vertices`: see CaptureRequest. Throws NotObservable.
  Observation observe(const gl::Case& script, Attributes required, std::size_t most_vertices,
                      PrimitiveKinds kinds = kPoints);
  // Returns the mismatches of an observation; may throw NotObservable.
  using OwnJudge = std::function<std::vector<Mismatch>(const Observation&)>;
  // Observes a case as observe() does, and fails for each mismatch that `judge` returns. All vertices
  // of the controls are compared with the prediction, unless `of_controls` judges a part of them.
  void expect_observation(const gl::Case& script, Attributes required, std::size_t most_vertices,
                          PrimitiveKinds kinds, const OwnJudge& judge,
                          const ExplicitControl::Judge& of_controls = {});

  // Runs the case with a vertex shader of the test, and returns the outputs of the
  // shader. Throws NotObservable.
  RecordedVaryings record_varyings(const gl::Case& script, const VaryingShader& shader,
                                   std::size_t most_vertices);

  // Plays the case 48 times, all in one context or each in a new one. Returns the memory that each time
  // keeps, in bytes: the median growth over the last five of six rounds of the memory that malloc has given
  // out, or of the resident memory of the process if that grows more.
  double kept_memory(const gl::Case& script, bool in_new_contexts);

  // Runs `body` in a new thread, until it ends. All contexts of its cases are created there. Throws
  // NotObservable, MissingEntryPoint if contexts stay in one thread, and all exceptions of `body`.
  void run_in_thread(const std::function<void()>& body);
  // Runs `body` while a new thread plays the case `other` again and again in one context; it has played the
  // case once before. Throws the same.
  void run_beside(const gl::Case& other, const std::function<void()>& body);

  // Records that the implementation follows this reading of an ambiguous passage; both are named in
  // "readings" of the catalogue. Fails if the user chose another reading.
  void follows(const std::string& text, const std::string& reading);

  // Adds a failure. In a warm context, throws FreshContextsDecide instead. Throws NotObservable if the
  // control of the observed case fails in the same way. `calls`: returns the calls of the case; called only
  // for failures that are kept in full. `check`: decides the failure in a stand-alone C program. `observed`:
  // by which the table in blame.cpp tells the violated requirements, unless decide() has named them.
  void fail(Failure failure, const std::function<std::vector<std::string>()>& calls = {},
            const std::optional<gl::Check>& check = {}, std::optional<Observed> observed = {});
  // True if a failure has a plot already: one is enough for a test.
  bool has_plot() const;

  // Throws NotObservable if the commands before GetError raise the error that it answered with explicit
  // commands in place of the evaluations as well, or without commands of evaluators.
  void require_no_error_of_explicit_commands(const gl::Case& script, gl::Ref get_error, GLenum answered);

  // Runs the test; called by the runner.
  void run(const std::function<void(Test&)>& body);

 private:
  struct VerdictAndReason {
    Verdict verdict;
    std::string why;
  };
  // Returns the texture units for predictions.
  TextureUnits units() const { return {texture_units(), gl().active_units}; }
  // Specifies the case without its vertices.
  Specified specify_answers(const gl::Case& script) const;
  VerdictAndReason end_of(const std::function<void(Test&)>& body);
  std::string mistake() const;
  Difference difference_of(const Mismatch& mismatch) const;
  // Returns the reason if the same query of state gives a wrong answer with explicit commands in place of
  // evaluations as well; otherwise an empty text. `script`: before delivery.
  std::string fault_of_explicit_answer(const gl::Case& script, gl::Ref query);
  gl::DeliveredCase begin_case(const gl::Case& script);
  // Throws NotObservable or MissingEntryPoint unless the test can use contexts in several threads.
  void require_threads();
  CheckedTrace play(const gl::DeliveredCase& delivered);
  // Runs the case with Enable(CULL_FACE), IsEnabled(LIGHTING) or GetIntegerv(MATRIX_MODE) in place of the
  // commands, queries by Is or Get that are rejected between Begin and End. Throws NotObservable if these
  // take effect or raise no error: the library has then lost the Begin, for example in a display list, or
  // raises no errors at all.
  void require_rejections_in_primitives(const gl::Case& script, const Specified& specified);
  void check_answers(const gl::Case& script, const gl::DeliveredCase& delivered, const Specified& specified);
  void judge_answer(CheckedTrace& checked, const gl::Case& script, const Specified& specified, gl::Ref query);
  // Returns the first query of the snapshot with which this one must agree; -1 if there is none.
  gl::Ref same_as(const Specified& specified, const gl::Case& script, gl::Ref query) const;
  // Throws NotObservable if GetIntegerv rounds FOG_START wrongly.
  void require_rounding_of_other_state();
  // Chooses a capture for the script as it is delivered. Throws NotObservable.
  const Capture& choose_capture(const gl::Case& script, Attributes required, PrimitiveKinds kinds);
  void note_capture(const Capture& capture);

  void violate(const RequirementId& id);

  // Sets the violated requirements of a test that failed through display lists, by running it without a list
  // and in a list of the simplest kind. The requirement of the form of lists is violated only if both pass.
  void blame_list_or_commands(const std::function<void(Test&)>& body);

  // The observation of a case by one capture.
  struct CapturedObservation {
    const Capture* capture;
    Topology topology;
    Observation observation;
  };
  JudgeOptions options_for(const gl::Case& script, const Capture& capture, Attributes required) const;
  std::vector<CapturedObservation> observe_by_captures(const gl::Case& script, const Prediction& prediction,
                                                       Attributes required, std::size_t most_vertices);
  enum class Thoroughness { kAllVertices, kFirstMismatches };
  void judge_emission(const gl::Case& delivered, const Prediction& prediction, Attributes required,
                      Thoroughness thoroughness, Attributes judged = kAllAttributes);
  // Adds a failure for each of `mismatches`, which `judge` has found in the observation `seen`. If there is a
  // prediction, the first failure in positions or vertices gets a plot, otherwise the first failure.
  void fail_each(const gl::Case& script, const Capture& capture, const CaptureRequest& request,
                 const Observation& seen, const std::vector<Mismatch>& mismatches, const OwnJudge& judge,
                 const Prediction* prediction = nullptr, Attributes required = 0);
  std::optional<gl::Check> check_of(const Mismatch& mismatch, const std::vector<Mismatch>& all,
                                    const gl::Case& script, const Capture& capture,
                                    const CaptureRequest& request, const OwnJudge& judge);

  bool judges_order_of_meshes_ = false;
  bool is_order_wrong_ = false;           // true if the vertices of a mesh are right in another order
  std::vector<RequirementId> decided_;    // by decide()
  bool violates_all_ = false;             // a failure violates all requirements of the test
  std::optional<gl::Lists> other_lists_;  // replaces the form of lists of the delivery
  ExplicitControl control_;
  PipelineProbes probes_;
  Attributes unobserved_ = 0;             // required attributes that no capture shows
  std::string fault_outside_evaluators_;  // the reason why an answer of the case is not judged; or empty
  std::set<int> snapshot_;                // positions of the queries of compare_only()
  std::uint64_t cases_ = 0, failed_cases_ = 0, last_failed_case_ = 0;
};

}  // namespace evalcts
