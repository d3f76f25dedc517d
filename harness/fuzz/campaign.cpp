// Runs random programs one after the other, most of them in the shared context, repeats differences in a
// fresh context, and reduces them to findings.
#include <evalcts/fuzz/campaign.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/finding.h>
#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/case_json.h>
#include "legal.h"
#include "reducer.h"
#include "shared_context.h"

namespace evalcts::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kReportEvery = std::chrono::milliseconds(500);
constexpr double kGrace = 30;              // seconds that a reduction may take after the end of the campaign
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

  CampaignRunner(const Subject& subject, const Campaign& campaign, const Report& report)
      : subject_(subject),
        campaign_(campaign),
        report_(report),
        table_(subject.implementation->create_context()->table()),
        max_order_(subject.info.max_order()),
        knows_limit_(max_order_ == subject.info.max_eval_order),
        shared_(campaign.fresh_contexts ? nullptr : SharedContext::of(subject)),
        reducer_(subject, shared_.get(), campaign.most_attempts,
                 {.alive = [this] { report_progress_now_and_then(); },
                  .is_over = [this] { return is_over(kGrace); },
                  .try_start = [this](const gl::Case& candidate) { return try_start(candidate); },
                  .finish = [this] { finish(); },
                  .smaller = [this](const Finding& finding) { report_(FindingShrank{finding}); }}) {}

  void run() {
    report_(CampaignStarted{max_order_});
    for (std::uint32_t number = campaign_.first; goes_on(); number += campaign_.step) {
      report_(TestStarted{fmt::format("program {}", number)});
      run(number);
      report_progress_now_and_then();
    }
    report_progress();
  }

 private:
  bool goes_on() const { return !is_over(0) && !(campaign_.programs && programs_ >= *campaign_.programs); }
  // Returns true if the time limit was exceeded at least `seconds` ago.
  bool is_over(double seconds) const {
    return campaign_.seconds > 0 &&
           std::chrono::duration<double>(Clock::now() - begin_).count() >= campaign_.seconds + seconds;
  }

  void report_progress_now_and_then() {
    if (Clock::now() - reported_ > kReportEvery) report_progress();
  }

  void report_progress() {
    report_(CampaignProgress{programs_, judged_, in_full_, commands_, not_repeated_, seconds_of_known_});
    reported_ = Clock::now();
  }

  void run(std::uint32_t number) {
    auto [program, specified] = random_specified_program(subject_.seed, number, campaign_.length, max_order_);
    ++programs_;
    gl::Case left = with_what_exists(subject_.info, table_, program);
    if (!knows_limit_) left = without_orders_above(left, max_order_);
    if (left.commands().size() < program.commands().size()) {
      std::optional<Specified> of_left = specify_if_defined(left, max_order_);
      if (!of_left) return;
      program = std::move(left);
      specified = *std::move(of_left);
    }
    const bool shares = shared_ && programs_ % kFreshEvery != 0;
    const Judged outcome =
        shares ? shared_->judge(program, specified) : judge_program(subject_, program, specified);
    judged_ += outcome.judged;
    in_full_ += outcome.in_full;
    commands_ += program.commands().size();
    if (outcome.failures.empty()) return;
    const Clock::time_point begin = Clock::now();
    const std::size_t before = reducer_.new_findings();
    if (const std::optional<Finding> finding = explained(program, outcome.failures.front(), shares))
      report_(FindingMade{number, *finding});
    if (reducer_.new_findings() == before)
      seconds_of_known_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  // Returns the finding that the difference is reduced to, or nothing if a fresh context does not show the
  // difference.
  std::optional<Finding> explained(const gl::Case& program, const Failure& failure, bool shares) {
    if (shares && campaign_.deadly.empty())
      if (std::optional<Finding> known = reducer_.recognise(program, failure.difference)) return known;
    const std::optional<Finding> found =
        shares ? repeated(program, failure.difference) : std::optional(Finding{program, failure});
    return found ? std::optional(reducer_.reduce(*found, !campaign_.deadly.empty())) : std::nullopt;
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
    not_repeated_ += !found;
    shared_->renew();  // its state may differ from a fresh context in a way that no command restores
    return found;
  }

  // Writes the candidate to the in-flight file before it runs. Returns false if the library has died
  // in it before.
  bool try_start(const gl::Case& candidate) const {
    if (campaign_.in_flight.empty()) return true;
    const std::string text = gl::to_text(candidate);
    if (std::ranges::count(campaign_.deadly, text) > 0) return false;
    std::ofstream(campaign_.in_flight) << text;
    return true;
  }
  void finish() const {
    if (!campaign_.in_flight.empty()) std::ofstream(campaign_.in_flight).flush();
  }

  const Subject& subject_;
  const Campaign& campaign_;
  const Report& report_;
  const gl::Table table_;
  const int max_order_;
  const bool knows_limit_;  // true if orders above max_order_ must be rejected
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point reported_ = begin_;
  std::uint64_t programs_ = 0, judged_ = 0, in_full_ = 0, commands_ = 0, not_repeated_ = 0;
  double seconds_of_known_ = 0;
  std::unique_ptr<SharedContext> shared_;  // may be null
  Reducer reducer_;
};

}  // namespace

void run_campaign(const Subject& subject, const Campaign& campaign,
                  const std::function<void(const CampaignEvent&)>& report) {
  CampaignRunner(subject, campaign, report).run();
}

}  // namespace evalcts::fuzz
