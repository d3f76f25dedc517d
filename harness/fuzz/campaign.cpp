// Runs random programs one after the other, most of them in the shared context, repeats differences in a
// fresh context, and reduces them to findings.
#include <evalcts/fuzz/campaign.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>
#include <stdexcept>

#include <evalcts/fuzz/events.h>
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

}  // namespace

Judged judge_program(const Subject& subject, const gl::Case& program, const Specified& specified,
                     Outcomes outcomes) {
  TestRecord record;
  // The name determines if other captures check the first one (Schedule::is_cross_checked), which repetitions
  // do not need.
  record.name = outcomes == Outcomes::kAll ? program.identity() : "a smaller version";
  Test test(subject, record);
  test.run([&](Test& t) { t.judge(program, specified, outcomes); });
  if (record.verdict == Verdict::kInternalError)
    throw std::logic_error(fmt::format("{}: {}", program.identity(), record.message));
  const bool passed = record.verdict == Verdict::kPass;
  if (record.verdict != Verdict::kFail) return {{}, passed, passed && record.unobserved.empty()};
  Failure failure = record.failures.front();
  if (outcomes == Outcomes::kOrder && !failure.what.starts_with("gl") && kind_of(failure.what) != kPrimitives)
    failure.what = kOrder;
  return {Finding{program, failure, cause_of(program, failure.what), requirement_of(program, failure.what)}};
}

namespace {

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
        reducer_(subject, shared_.get(), campaign.known, campaign.most_attempts,
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
    if (!outcome.finding) return;
    const Clock::time_point begin = Clock::now();
    const std::size_t causes = reducer_.causes();
    if (const std::optional<Finding> finding = explained(program, specified, *outcome.finding, shares))
      report_(FindingMade{number, *finding});
    if (reducer_.causes() == causes)
      seconds_of_known_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  // Returns the difference with its cause, or nothing if a fresh context does not show the difference.
  std::optional<Finding> explained(const gl::Case& program, const Specified& specified,
                                   const Finding& difference, bool shares) {
    const bool tries = shares && campaign_.deadly.empty();
    if (tries)
      if (std::optional<Finding> known = reducer_.recognise(program, difference)) {
        if (confirmed_.contains(known->cause)) return known;
        if (std::optional<Finding> minimal = minimal_of(known->cause)) return minimal;
      }
    const std::optional<Finding> found = shares ? repeated(program, specified) : difference;
    if (!found) return {};
    const bool tried = tries && found->program.commands().size() == program.commands().size();
    Finding finding = reducer_.explain(found->program, *found, !campaign_.deadly.empty(), tried);
    if (!confirmed_.contains(finding.cause))
      if (std::optional<Finding> minimal = minimal_of(finding.cause)) return minimal;
    confirmed_.insert(finding.cause);
    return finding;
  }

  // Runs the minimal program of the known finding with this cause in a fresh context and returns its
  // difference. Returns nothing if there is no such finding or its program shows no such difference.
  std::optional<Finding> minimal_of(const std::string& cause) {
    const KnownFinding* const known = known_finding(cause);
    if (!known || !exists(known->program) || !try_start(known->program)) return {};
    std::optional<Finding> minimal =
        judge_program(subject_, known->program, specify(known->program, max_order_)).finding;
    finish();
    if (!minimal || minimal->cause != cause) return {};
    confirmed_.insert(cause);
    return minimal;
  }

  bool exists(const gl::Case& program) const {
    return with_what_exists(subject_.info, table_, program).commands().size() == program.commands().size();
  }

  // Reproduces a difference of the shared context in a fresh context, with the program alone or after some of
  // the programs that preceded it. Returns none if the difference does not occur.
  std::optional<Finding> repeated(const gl::Case& program, const Specified& specified) {
    if (std::optional<Finding> alone = judge_program(subject_, program, specified).finding) return alone;
    std::optional<Finding> found;
    for (std::size_t count = 1; count <= kMostHistory && !found; count *= 2) {
      const gl::Case joint = shared_->behind(count);
      const std::optional<Specified> of_joint = specify_if_defined(joint, max_order_);
      if (of_joint && !joint.commands().empty() && try_start(joint))
        found = judge_program(subject_, joint, *of_joint).finding;
    }
    finish();
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
  std::set<std::string> confirmed_;        // causes that were seen in a fresh context
  std::unique_ptr<SharedContext> shared_;  // may be null
  Reducer reducer_;
};

}  // namespace

void run_campaign(const Subject& subject, const Campaign& campaign,
                  const std::function<void(const CampaignEvent&)>& report) {
  CampaignRunner(subject, campaign, report).run();
}

}  // namespace evalcts::fuzz
