// Implements the reduction of failing cases, in the suite program.
#include <evalcts/fuzz/reduction.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include <evalcts/gl/case_json.h>
#include "excerpt.h"
#include "legal.h"
#include "reducer.h"
#include "shrink.h"

namespace evalcts::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostCandidates = 150;  // maximum number of candidates for one program

// Answers the jobs of the kind "reduce" of a worker.
class ReductionJobs {
 public:
  explicit ReductionJobs(const Subject& subject)
      : subject_(subject),
        table_(subject.implementation->create_context()->table()),
        max_order_(subject.info.max_order()),
        shared_(SharedContext::of(subject)),
        reducer_(subject, shared_.get(), kMostCandidates, {.is_over = [this] { return is_over(); }}) {}

  Reduction run(const FailingCase& failing) {
    seconds_ = failing.seconds;
    begin_ = Clock::now();
    if (failing.commands.empty())
      return not_reduced(failing, "the test compares several cases, or its case has no plain form as data");
    if (failing.difference.kind.empty())
      return not_reduced(failing,
                         "what the test compares is not a difference from the executable specification");
    gl::Case script = gl::parse_case(failing.commands);
    script.set_identity("program");
    gl::Case program;
    try {
      program = with_what_exists(subject_.info, table_, only_specified(script));
    } catch (const std::invalid_argument& error) {
      return not_reduced(failing, error.what());
    }
    if (!specify_if_defined(program, max_order_)) program = with_errors_asked_for(program, max_order_);
    if (!specify_if_defined(program, max_order_))
      return not_reduced(failing, "the specification does not define everything that its case does");
    const gl::Case plain = forms_of(program).back();
    const std::string key = failing.difference.text() + ": " + gl::to_text(plain);
    if (const auto same = reduced_.find(key); same != reduced_.end()) return {failing.test, same->second, ""};
    const std::optional<Finding> minimal = reducer_.reduce(program, failing.difference);
    if (!minimal) return not_reduced(failing, is_over() ? kOutOfTime : why_it_does_not_show(script, program));
    if (is_over() && minimal->known.empty()) return not_reduced(failing, kOutOfTime);
    if (vertices_of(program) <= kMostVertices && reducer_.find(plain, failing.difference))
      reduced_[key] = *minimal;
    return {failing.test, minimal, ""};
  }

 private:
  static Reduction not_reduced(const FailingCase& failing, const std::string& why) {
    return {failing.test, {}, why};
  }

  bool is_over() const {
    return seconds_ > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() >= seconds_;
  }

  // Returns the reason why the case alone does not differ from the executable specification in this way.
  static std::string why_it_does_not_show(const gl::Case& script, const gl::Case& program) {
    for (const gl::Command& command : script.commands()) {
      const auto is_same = [&](const gl::Command& other) { return other.entry == command.entry; };
      if (std::ranges::none_of(program.commands(), is_same))
        return fmt::format("the executable specification does not have {}", gl::name_of(command.entry));
    }
    return "what the test compares is not a difference from the executable specification";
  }

  const Subject& subject_;
  double seconds_ = 0;  // time limit of the current case; 0: none
  Clock::time_point begin_ = Clock::now();
  const gl::Table table_;
  const int max_order_;
  std::unique_ptr<SharedContext> shared_;  // may be null
  Reducer reducer_;
  std::map<std::string, Finding> reduced_;  // by difference and plain form
};

}  // namespace

std::function<Reduction(const FailingCase&)> case_reducer(const Subject& subject) {
  const auto jobs = std::make_shared<ReductionJobs>(subject);
  return [jobs](const FailingCase& failing) { return jobs->run(failing); };
}

std::function<std::optional<Finding>(const std::string&, double)> bug_prover(const Subject& subject) {
  const auto end = std::make_shared<Clock::time_point>();
  const std::shared_ptr<SharedContext> shared = SharedContext::of(subject);
  const auto reducer =
      std::make_shared<Reducer>(subject, shared.get(), kMostCandidates,
                                Reducer::Hooks{.is_over = [end] { return Clock::now() >= *end; }});
  return [end, shared, reducer](const std::string& bug, double seconds) {
    *end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    return reducer->prove(bug);
  };
}

}  // namespace evalcts::fuzz
