// Runs random programs one after the other, most of them in the shared context, repeats differences in a
// fresh context, and reduces them to findings.
#include <evalcts/fuzz/campaign.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/case_json.h>
#include "legal.h"
#include "reducer.h"
#include "shared_context.h"

namespace evalcts::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostAttempts = 400;         // maximum number of candidates for a reduction
constexpr std::uint64_t kFreshEvery = 16;  // every 16th program has its own context

// Returns the program without maps of a higher order, because it is unknown if they are accepted or rejected.
gl::Case without_orders_above(const gl::Case& program, int limit) {
  gl::Case left(program.identity());
  for (const gl::Command& command : program.commands())
    if (gl::largest_order(command) <= limit) left.add(command);
  return left;
}

class CampaignRunner {
 public:
  using Report = std::function<void(const CampaignEvent&)>;

  CampaignRunner(const Subject& subject, Report report)
      : subject_(subject),
        report_(std::move(report)),
        table_(subject.implementation->create_context()->table()),
        max_order_(subject.info.max_order()),
        knows_limit_(max_order_ == subject.info.max_eval_order),
        shared_(SharedContext::of(subject)),
        reducer_(subject, shared_.get(), kMostAttempts,
                 {.is_over = [this] { return is_over(); },
                  .try_start = [this](const gl::Case& candidate) { return try_start(candidate); },
                  .finish =
                      [this] {
                        report_(CandidateStarted{job_.number, ""});
                      },
                  .smaller =
                      [this](const Finding& finding) {
                        report_(FindingShrank{job_.number, finding});
                      },
                  .is_careful = [this] { return !job_.deadly.empty(); }}) {
    report_(CampaignStarted{max_order_});
  }

  void run(const RandomJob& job) {
    job_ = job;
    begin_ = Clock::now();
    ProgramJudged result;
    run(job.number, result);
    report_(result);
  }

 private:
  bool is_over() const {
    return job_.seconds > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() >= job_.seconds;
  }

  void run(std::uint32_t number, ProgramJudged& result) {
    auto [program, specified] = random_specified_program(subject_.seed, number, job_.length, max_order_);
    result.judged = result.in_full = false;
    gl::Case left = with_what_exists(subject_.info, table_, program);
    if (!knows_limit_) left = without_orders_above(left, max_order_);
    if (left.commands().size() < program.commands().size()) {
      std::optional<Specified> of_left = specify_if_defined(left, max_order_);
      if (!of_left) return;
      program = std::move(left);
      specified = *std::move(of_left);
    }
    const bool shares = shared_ && !job_.in_fresh_context && number % kFreshEvery != kFreshEvery - 1;
    const Judged outcome =
        shares ? shared_->judge(program, specified) : judge_program(subject_, program, specified);
    result.judged = outcome.judged;
    result.in_full = outcome.in_full;
    result.commands = program.commands().size();
    if (outcome.failures.empty()) return;
    const Clock::time_point begin = Clock::now();
    const std::size_t before = reducer_.new_findings();
    if (const std::optional<Finding> finding = explained(program, outcome.failures.front(), shares))
      report_(FindingMade{number, *finding});
    else
      result.not_repeated = true;
    if (reducer_.new_findings() == before)
      result.seconds_of_known = std::chrono::duration<double>(Clock::now() - begin).count();
  }

  // Returns the finding that the difference is reduced to, or nothing if a fresh context does not show the
  // difference.
  std::optional<Finding> explained(const gl::Case& program, const Failure& failure, bool shares) {
    if (shares)
      if (std::optional<Finding> known = reducer_.recognise(program, failure.difference)) return known;
    const std::optional<Finding> found =
        shares ? repeated(program, failure.difference) : std::optional(Finding{program, failure});
    return found ? std::optional(reducer_.reduce(*found)) : std::nullopt;
  }

  // Reproduces a difference of the shared context in a fresh context, with the program alone or after some of
  // the programs that preceded it. Returns none if the difference does not occur.
  std::optional<Finding> repeated(const gl::Case& program, const Difference& difference) {
    std::optional<Finding> found = reducer_.find(program, difference);
    if (found) return found;
    for (std::size_t count = 1; count <= kMostHistory && !found; count *= 2) {
      const gl::Case joint = shared_->behind(count);
      if (!joint.commands().empty()) found = reducer_.find(joint, difference);
    }
    shared_->renew();  // its state may differ from a fresh context in a way that no command restores
    return found;
  }

  // Reports the candidate before it runs. Returns false if the library has died in it before.
  bool try_start(const gl::Case& candidate) const {
    std::string text = gl::to_text(candidate);
    if (std::ranges::count(job_.deadly, text) > 0) return false;
    report_(CandidateStarted{job_.number, std::move(text)});
    return true;
  }

  const Subject& subject_;
  const Report report_;
  const gl::Table table_;
  const int max_order_;
  const bool knows_limit_;  // true if orders above max_order_ must be rejected
  RandomJob job_;           // the current one
  Clock::time_point begin_ = Clock::now();
  std::unique_ptr<SharedContext> shared_;  // may be null
  Reducer reducer_;
};

}  // namespace

std::function<void(const RandomJob&)> campaign(const Subject& subject,
                                               const std::function<void(const CampaignEvent&)>& report) {
  const auto runner = std::make_shared<CampaignRunner>(subject, report);
  return [runner](const RandomJob& job) { runner->run(job); };
}

}  // namespace evalcts::fuzz
