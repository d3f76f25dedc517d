// Gives random programs to workers, collects their findings, and groups them by cause.
#include <evalcts/fuzz/search.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>
#include "death.h"

namespace evalcts::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMostAttemptsAlone = 400;  // candidates for the reduction of a crash; each needs a process
constexpr int kMostHangs = 60;           // candidates for the reduction of a hang; each takes kShortPatience
constexpr double kSecondsAlone = 30;     // time limit for the reduction of a crash or hang
constexpr std::size_t kMostDeaths = 10;  // deaths of the library during the reduction of one program
constexpr double kShortPatience = 2;     // time limit, in seconds, of a program that has hung before
constexpr double kPatience = 60;         // seconds that a reduction may take after the end of the search
constexpr double kGrace = 30;  // seconds that a worker gives a reduction after the end of the search

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::uint32_t number_of(const std::string& program) {
  return static_cast<std::uint32_t>(std::stoul(program.substr(program.find(' ') + 1)));
}

class Searcher {
 public:
  Searcher(const SearchRequest& request, const std::function<void(const SearchResult&)>& progress)
      : request_(request), progress_(progress), scratch_(request.output / ("scratch-fuzz-" + request.name)) {}

  SearchResult run() {
    remove_stale_files();
    fs::create_directory(scratch_);
    Pool pool{.command = [this] { return suite_command(); },
              .log = scratch_ / "log",
              .limits = {request_.seconds_per_program},
              .workers = static_cast<std::size_t>(request_.jobs),
              .each = [this](const Event& event) { take(event); },
              .ended = [this](const WorkerRun& run) { finish(run); }};
    if (request_.seconds > 0) pool.deadline = begin_ + seconds(request_.seconds + kPatience);
    const bool started = pool.run([this] { return next(); });
    if (!started && found_.programs == 0 && !interrupted)
      found_.cannot_start = "it does not start: " + latest_end_ + "; " + last_line(scratch_ / "log");
    found_.seconds = seconds_since(begin_);
    std::ranges::sort(found_.causes, {}, [](const Cause& cause) { return number_of(cause.program); });
    fs::remove_all(scratch_);
    return std::move(found_);
  }

 private:
  static Clock::duration seconds(double count) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(count));
  }

  // Returns the next program to judge.
  std::optional<Job> next() {
    const double left = request_.seconds > 0 ? request_.seconds - seconds_since(begin_) : 0;
    std::uint32_t number = 0;
    if (!again_.empty()) {
      number = again_.front();
      again_.pop_front();
    } else if (request_.seconds > 0 && left <= 0) {
      return std::nullopt;
    } else if (request_.programs && next_ >= *request_.programs) {
      return std::nullopt;
    } else {
      number = next_++;
    }
    const RandomJob job = {.number = number,
                           .length = request_.length,
                           .seconds = request_.seconds > 0 ? std::max(left, 0.0) + kGrace : 0,
                           .in_fresh_context = request_.fresh_contexts,
                           .deadly = deadly_[number]};
    return Job{.kind = "fuzz", .name = fmt::format("program {}", number), .data = to_text(job)};
  }

  // Removes the files of an earlier campaign.
  void remove_stale_files() const {
    fs::remove_all(scratch_);
    const std::string stem = fmt::format("fuzz-{}-", request_.name);
    std::vector<fs::path> stale;
    for (const fs::directory_entry& entry : fs::directory_iterator(request_.output)) {
      const std::string name = entry.path().stem().string();
      if (name.starts_with(stem) && name.find_first_not_of("0123456789", stem.size()) == std::string::npos)
        stale.push_back(entry.path());
    }
    for (const fs::path& path : stale) fs::remove(path);
  }

  std::vector<std::string> suite_command() const {
    std::vector<std::string> command = {request_.suite_program.string(), "--seed",
                                        std::to_string(request_.seed)};
    std::ranges::copy(request_.implementation.words(), std::back_inserter(command));
    return command;
  }

  void take(const Event& event) {
    const auto* const other = std::get_if<OtherEvent>(&event);
    const std::optional<CampaignEvent> of_campaign = other ? parse_campaign_event(other->line) : std::nullopt;
    if (!of_campaign) return;
    if (const auto* started = std::get_if<CampaignStarted>(&*of_campaign)) {
      max_eval_order_ = started->max_eval_order;
    } else if (const auto* candidate = std::get_if<CandidateStarted>(&*of_campaign)) {
      in_flight_[candidate->number] = candidate->program;
    } else if (const auto* smaller = std::get_if<FindingShrank>(&*of_campaign)) {
      smaller_[smaller->number] = smaller->finding;
    } else if (const auto* made = std::get_if<FindingMade>(&*of_campaign)) {
      smaller_.erase(made->number);
      in_flight_.erase(made->number);
      found(fmt::format("program {}", made->number), made->finding);
    } else if (const auto* result = std::get_if<ProgramJudged>(&*of_campaign)) {
      ++found_.programs;
      found_.commands += result->commands;
      found_.judged += result->judged;
      found_.in_full += result->in_full;
      found_.not_repeated += result->not_repeated;
      found_.seconds_of_known += result->seconds_of_known;
      found_.seconds = seconds_since(begin_);
      progress_(found_);
    }
  }

  // Handles the end of a worker. If the library has died, this is a finding.
  void finish(const WorkerRun& run) {
    latest_end_ = run.cannot_start.empty() ? describe(run.ending) : run.cannot_start;
    if (run.complete || interrupted || run.cut_short) return;
    if (!run.ending.signalled && run.ending.value == kOwnFault)
      throw std::runtime_error(fmt::format("{}: {}", run.in_flight, last_line(scratch_ / "log")));
    if (!run.died_in_job()) return;
    const std::uint32_t number = number_of(run.in_flight);
    const std::string in_flight = std::exchange(in_flight_[number], {});
    died(run, number, in_flight);
    const auto smaller = smaller_.extract(number);
    if (!in_flight.empty() && deadly_[number].size() < kMostDeaths) {
      // The library died during the reduction of another difference, so this reduction is repeated.
      deadly_[number].push_back(in_flight);
      again_.push_back(number);
      return;
    }
    if (!smaller.empty()) found(fmt::format("program {}", number), smaller.mapped());
    ++found_.programs;
  }

  static std::string last_line(const fs::path& log) {
    std::ifstream stream(log);
    std::string last;
    for (std::string line; std::getline(stream, line);)
      if (!line.empty()) last = line;
    return last;
  }

  // Adds the finding for a death of a worker. The program in which it died, or the candidate of a reduction
  // (`in_flight`), is reduced by running smaller candidates in separate processes.
  void died(const WorkerRun& run, std::uint32_t number, const std::string& in_flight) {
    const gl::Case program = in_flight.empty()
                                 ? random_program(request_.seed, number, request_.length, max_eval_order_)
                                 : gl::parse_case(in_flight);
    // On a busy machine, any program may exceed the time limit occasionally.
    if (run.hung && !run_alone(program, request_.seconds_per_program)) {
      ++found_.slow;
      return;
    }
    const double patience =
        run.hung ? std::min(kShortPatience, request_.seconds_per_program) : request_.seconds_per_program;
    const Clock::time_point begin = Clock::now();
    const auto is_over = [&] { return interrupted || seconds_since(begin) > kSecondsAlone; };
    const std::size_t before = deaths_.size();
    const std::optional<Finding> finding = reduce_death(
        program, death_of(run).value_or(Difference{Difference::kCrash, "", ""}),
        [&](const gl::Case& candidate) { return is_over() ? std::nullopt : run_alone(candidate, patience); },
        deaths_, run.hung ? kMostHangs : kMostAttemptsAlone, max_eval_order_);
    if (deaths_.size() == before) found_.seconds_of_known += seconds_since(begin);
    if (finding) return found(fmt::format("program {}", number), *finding);
    Finding whole;
    whole.program = program;
    whole.failure.what = run.hung ? Difference::kHang : Difference::kCrash;
    whole.failure.difference = {whole.failure.what, "", ""};
    whole.failure.message = fmt::format("{}: {}", whole.failure.what, describe(run.ending));
    whole.cause = whole.title = whole.failure.what + (is_over() ? " in a program that was not reduced"
                                                                : " after what was run before");
    found(fmt::format("program {}", number), whole);
  }

  // Runs the program in a separate process.
  std::optional<Difference> run_alone(const gl::Case& program, double patience) const {
    return death_of(run_program(suite_command(), program, scratch_ / "alone.log", {patience}));
  }

  void found(const std::string& program, const Finding& finding) {
    const std::string& cause = finding.known.empty() ? finding.cause : finding.known;
    auto known = std::ranges::find(found_.causes, cause, &Cause::cause);
    if (known == found_.causes.end()) {
      Cause fresh;
      fresh.cause = cause;
      fresh.program = program;
      fresh.finding = finding;
      fresh.known_as = finding.known;
      if (finding.outside_evaluators) fresh.known_as = "a bug outside the evaluators";
      fresh.file = (request_.output / fmt::format("fuzz-{}-{}.json", request_.name, found_.causes.size() + 1))
                       .string();
      found_.causes.push_back(std::move(fresh));
      known = found_.causes.end() - 1;
      write(*known);
    }
    ++known->times;
  }

  void write(const Cause& cause) const {
    write_atomically(cause.file, to_text(cause.finding));
    const Failure& failure = cause.finding.failure;
    std::string text =
        fmt::format("{}\n{}\nexpected {}\ncaptured {}\nrequirement {}\n", cause.finding.title,
                    failure.message, failure.expected, failure.captured, cause.finding.requirement);
    text += fmt::format("{}\n", fmt::join(gl::all_calls(cause.finding.program, 1000, 0), "\n"));
    write_atomically(fs::path(cause.file).replace_extension(".txt"), text);
    // Writes the C program, if the implementation supports it.
    std::vector<std::string> command = suite_command();
    command.insert(command.end(), {"--reproduce", "full"});
    const WorkerRun run =
        run_program(command, cause.finding.program, scratch_ / "write.log", {request_.seconds_per_program});
    if (!run.program.empty()) write_atomically(fs::path(cause.file).replace_extension(".c"), run.program);
  }

  const SearchRequest& request_;
  const std::function<void(const SearchResult&)>& progress_;
  const fs::path scratch_;
  const Clock::time_point begin_ = Clock::now();
  SearchResult found_;
  std::vector<Finding> deaths_;                               // minimal programs in which the library died
  std::uint32_t next_ = 0;                                    // number of the next program
  std::deque<std::uint32_t> again_;                           // programs whose reduction is repeated
  std::map<std::uint32_t, std::string> in_flight_;            // candidates of reductions (JSON), by program
  std::map<std::uint32_t, Finding> smaller_;                  // smallest programs of reductions, by program
  std::map<std::uint32_t, std::vector<std::string>> deadly_;  // see RandomJob, by program
  std::string latest_end_;                                    // of a worker, in words
  int max_eval_order_ = 8;                                    // reported by the workers
};

}  // namespace

SearchResult search(const SearchRequest& request,
                    const std::function<void(const SearchResult& now)>& progress) {
  return Searcher(request, progress).run();
}

}  // namespace evalcts::fuzz
