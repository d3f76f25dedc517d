// Implements the reduction of failing cases, in the suite program.
#include <evalcts/fuzz/reduction.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <stdexcept>

#include <evalcts/fuzz/events.h>
#include <evalcts/gl/case_json.h>
#include "causes.h"
#include "excerpt.h"
#include "legal.h"
#include "reducer.h"
#include "shrink.h"

namespace evalcts::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostAttempts = 150;          // maximum number of candidates for one program
constexpr double kShareOfLargeCase = 0.05;  // share of the time for one case that draws very much
constexpr auto kReportReductionEvery = std::chrono::milliseconds(500);

// Returns the causes of the programs that random search has found, which explain most failures.
std::vector<std::string> known_causes() {
  std::set<std::string> causes;
  for (const KnownFinding& finding : known_findings()) causes.insert(cause_of(finding.program, finding.what));
  return {causes.begin(), causes.end()};
}

class CaseReducer {
 public:
  CaseReducer(const Subject& subject, double seconds,
              const std::function<void(const ReductionEvent&)>& report)
      : subject_(subject),
        seconds_(seconds),
        report_(report),
        table_(subject.implementation->create_context()->table()),
        max_order_(subject.info.max_order()),
        shared_(SharedContext::of(subject)),
        reducer_(subject, shared_.get(), known_causes(), kMostAttempts,
                 {.alive = [this] { report_now_and_then(); },
                  .is_over = [this] { return is_over(); },
                  .try_start = [this](const gl::Case& candidate) { return stays_alike(candidate); }}) {}

  Reduction reduce(const FailingCase& failing) {
    is_large_ = false;
    if (is_over()) return not_reduced(failing, kOutOfTime);
    if (failing.commands.empty())
      return not_reduced(failing, "the test compares several cases, or its case has no plain form as data");
    gl::Case script = gl::parse_case(failing.commands);
    script.set_identity("program");
    gl::Case program;
    try {
      program = with_what_exists(subject_.info, table_, only_specified(script));
    } catch (const std::invalid_argument& error) {
      return not_reduced(failing, error.what());
    }
    keeps_to_grids_ = keeps_to_grids(program);
    calls_missing_list_ = calls_missing_list(program);
    const Outcomes outcomes = outcomes_of(kind_of(failing.what));
    std::optional<Finding> found;
    is_large_ = vertices_of(program) > kMostVertices;
    case_begin_ = Clock::now();
    if (is_large_) {
      if (const Finding* const known = known_of_large(program, outcomes)) return {failing.test, *known, ""};
      program = excerpt_of(program, [&](const gl::Case& part) {
        report_now_and_then();
        if (is_over() || !stays_alike(part)) return false;
        std::optional<Finding> of_part = difference_of(part, outcomes);
        if (!of_part) return false;
        found = std::move(of_part);
        return true;
      });
    }
    if (!found) {
      if (!specify_if_defined(program, max_order_)) program = with_errors_asked_for(program, max_order_);
      const std::optional<Specified> specified = specify_if_defined(program, max_order_);
      if (!specified)
        return not_reduced(failing, "the specification does not define everything that its case does");
      found = judge_program(subject_, program, *specified, outcomes).finding;
      if (!found) found = judge_program(subject_, program, *specified, Outcomes::kAll).finding;
      if (!found && has(program, "glEvalMesh2"))
        found = judge_program(subject_, program, *specified, Outcomes::kOrder).finding;
      if (!found) return not_reduced(failing, why_it_does_not_show(script, program));
    }

    const std::string kind = kind_of(found->failure.what);
    const gl::Case plain = forms_of(program).back();
    const std::string key = kind + ": " + gl::to_text(plain);
    if (const auto same = reduced_.find(key); same != reduced_.end()) return {failing.test, same->second, ""};
    Finding minimal = reducer_.explain(program, *found);
    // If the minimal program also gives a wrong answer, such as a missing error, this answer becomes the
    // finding, because it is closer to the root cause than its effects on vertices.
    if (!kind.starts_with("gl") && !without_answers_.contains(minimal.cause)) {
      if (const std::optional<Finding> answer = difference_of(minimal.program, Outcomes::kAnswers)) {
        minimal = reducer_.explain(gl::Case(minimal.program), *answer);
      } else {
        without_answers_.insert(minimal.cause);
      }
    }
    if (is_over()) return not_reduced(failing, kOutOfTime);
    if (vertices_of(plain) <= kMostVertices && fails_alike(plain, kind)) reduced_[key] = minimal;
    by_cause_.try_emplace(minimal.cause, minimal);
    return {failing.test, minimal, ""};
  }

 private:
  static Reduction not_reduced(const FailingCase& failing, const std::string& why) {
    return {failing.test, {}, why};
  }

  static bool has(const gl::Case& program, std::string_view stem) {
    return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
      return gl::name_of(command.entry).starts_with(stem);
    });
  }

  // Returns the minimal program of an earlier case if the same commands of this program differ in the same
  // way; otherwise null. This saves the reduction of the large program.
  const Finding* known_of_large(const gl::Case& program, Outcomes outcomes) {
    for (const auto& [cause, minimal] : by_cause_) {
      const std::set<std::string> words = words_of(minimal.program);
      gl::Case part = program;
      for (const std::string& word : words_of(program))
        if (!words.contains(word)) part = without_word(part, word);
      if (words_of(part) != words || vertices_of(part) == 0 || !stays_alike(part)) continue;
      report_now_and_then();
      const std::optional<Finding> found = difference_of(part, outcomes);
      if (found && found->cause == cause) return &minimal;
    }
    return nullptr;
  }

  // Returns true if a list is called before it is defined.
  static bool calls_missing_list(const gl::Case& program) {
    std::set<std::int64_t> defined;
    std::int64_t open = 0;
    return std::ranges::any_of(program.commands(), [&](const gl::Command& command) {
      if (command.entry == gl::EntryPoint::EndList) defined.insert(open);
      const auto* const list =
          command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
      if (list && command.entry == gl::EntryPoint::NewList) open = *list;
      return list && command.entry == gl::EntryPoint::CallList && !defined.contains(*list);
    });
  }

  // Returns false if a mesh or grid point is drawn over an initial grid: no MapGrid has its dimension.
  static bool keeps_to_grids(const gl::Case& program) {
    return (has(program, "glMapGrid1") || (!has(program, "glEvalMesh1") && !has(program, "glEvalPoint1"))) &&
           (has(program, "glMapGrid2") || (!has(program, "glEvalMesh2") && !has(program, "glEvalPoint2")));
  }

  // Returns false if the candidate does what the case does not do and what has bugs of its own: it draws a
  // mesh or grid point over the initial grid, or calls a list that does not exist, which crashes Mesa.
  bool stays_alike(const gl::Case& candidate) const {
    return (calls_missing_list_ || !calls_missing_list(candidate)) &&
           (!keeps_to_grids_ || keeps_to_grids(candidate));
  }

  void report_now_and_then() {
    if (Clock::now() - reported_ < kReportReductionEvery) return;
    report_(StillReducing());
    reported_ = Clock::now();
  }

  bool is_over() const {
    const auto seconds_since = [](Clock::time_point begin) {
      return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    return seconds_ > 0 && (seconds_since(begin_) >= seconds_ ||
                            (is_large_ && seconds_since(case_begin_) >= kShareOfLargeCase * seconds_));
  }

  // Returns the reason why the case alone does not differ from the executable specification.
  static std::string why_it_does_not_show(const gl::Case& script, const gl::Case& program) {
    for (const gl::Command& command : script.commands()) {
      const auto is_same = [&](const gl::Command& other) { return other.entry == command.entry; };
      if (std::ranges::none_of(program.commands(), is_same))
        return fmt::format("the executable specification does not have {}", gl::name_of(command.entry));
    }
    return "what the test compares is not a difference from the executable specification";
  }

  std::optional<Finding> difference_of(const gl::Case& program, Outcomes outcomes) {
    const std::optional<Specified> specified = specify_if_defined(program, max_order_);
    return specified ? judge_program(subject_, program, *specified, outcomes).finding : std::nullopt;
  }

  // True if the program has this kind of difference. Runs in the shared context, if there is one.
  bool fails_alike(const gl::Case& program, const std::string& kind) {
    const Outcomes outcomes = outcomes_of(kind);
    const std::optional<Specified> specified = specify_if_defined(program, max_order_);
    if (!specified) return false;
    const std::optional<Finding> found = shared_
                                             ? shared_->judge(program, *specified, outcomes).finding
                                             : judge_program(subject_, program, *specified, outcomes).finding;
    return found && kind_of(found->failure.what) == kind;
  }

  const Subject& subject_;
  const double seconds_;
  const std::function<void(const ReductionEvent&)>& report_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point reported_ = begin_;
  Clock::time_point case_begin_ = begin_;
  bool is_large_ = false;  // the current case draws very much
  const gl::Table table_;
  const int max_order_;
  std::unique_ptr<SharedContext> shared_;  // may be null
  Reducer reducer_;
  bool keeps_to_grids_ = false;             // see keeps_to_grids(), of the current case
  bool calls_missing_list_ = false;         // see calls_missing_list(), of the current case
  std::map<std::string, Finding> reduced_;  // by kind of difference and plain form
  std::map<std::string, Finding> by_cause_;
  std::set<std::string> without_answers_;  // causes whose minimal programs give only correct answers
};

}  // namespace

void reduce(const Subject& subject, const std::vector<FailingCase>& cases, Claims& claims, double seconds,
            const std::function<void(const ReductionEvent&)>& report) {
  CaseReducer reducer(subject, seconds, report);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!claims.take(i)) continue;
    report(TestStarted{cases[i].test});
    report(reducer.reduce(cases[i]));
  }
}

}  // namespace evalcts::fuzz
