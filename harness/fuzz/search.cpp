// Starts the child processes of a search, collects their findings, and groups them by cause.
#include <evalcts/fuzz/search.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/suite_child.h>
#include "death.h"

namespace evalcts::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLook = 0.02;
constexpr int kMostAttemptsAlone = 400;  // candidates for the reduction of a crash; each needs a process
constexpr int kMostHangs = 60;           // candidates for the reduction of a hang; each takes kShortPatience
constexpr double kSecondsAlone = 30;     // time limit for the reduction of a crash or hang
constexpr std::size_t kMostDeaths = 10;  // deaths of the library during the reduction of one program
constexpr double kShortPatience = 2;     // time limit, in seconds, of a program that has hung before
constexpr double kPatience = 60;         // seconds that a reduction may take after the end of the search
constexpr int kMostEmptyStarts = 3;

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
    for (int k = 0; k < request_.jobs; ++k) start(k, static_cast<std::uint32_t>(k), programs_of(k));
    while (std::ranges::any_of(lanes_, [](const Lane& lane) { return lane.child != nullptr; })) look();
    found_.seconds = seconds_since(begin_);
    std::ranges::sort(found_.causes, {}, [](const Cause& cause) { return number_of(cause.program); });
    fs::remove_all(scratch_);
    return std::move(found_);
  }

 private:
  struct Lane {
    std::unique_ptr<SuiteChild> child;
    std::uint32_t first = 0;
    std::optional<std::uint32_t> programs;
    CampaignProgress totals;          // the latest totals of the child
    std::optional<Finding> smaller;   // the smallest program so far of the current reduction
    std::vector<std::string> deadly;  // programs of this reduction in which the library has died
  };

  // Returns the number of programs of lane k, which are k, k + jobs, k + 2 jobs, ...; none: no limit.
  std::optional<std::uint32_t> programs_of(int k) const {
    if (!request_.programs) return {};
    const auto jobs = static_cast<std::uint32_t>(request_.jobs), own = static_cast<std::uint32_t>(k);
    return *request_.programs / jobs + (own < *request_.programs % jobs ? 1 : 0);
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

  std::vector<std::string> shared_options() const {
    std::vector<std::string> options = {request_.suite_program.string(), "--seed",
                                        std::to_string(request_.seed), "--die-with-parent"};
    const auto add = [&](const char* name, const std::string& value) {
      if (!value.empty()) options.insert(options.end(), {name, value});
    };
    add("--implementation", request_.implementation.name);
    add("--library", request_.implementation.library);
    add("--context", request_.implementation.context);
    return options;
  }

  fs::path scratch(int lane, const char* extension) const {
    return scratch_ / fmt::format("{}.{}", lane + 1, extension);
  }

  void start(int k, std::uint32_t first, std::optional<std::uint32_t> programs,
             std::vector<std::string> deadly = {}) {
    if (lanes_.size() <= static_cast<std::size_t>(k)) lanes_.resize(static_cast<std::size_t>(k) + 1);
    Lane& lane = lanes_[static_cast<std::size_t>(k)];
    lane = {};
    lane.first = first;
    lane.programs = programs;
    lane.deadly = std::move(deadly);
    const double left = request_.seconds > 0 ? request_.seconds - seconds_since(begin_) : 0;
    if (interrupted || (programs && *programs == 0) || (request_.seconds > 0 && left <= 0)) return;
    std::vector<std::string> command = shared_options();
    command.insert(
        command.end(),
        {"--fuzz", "--first", std::to_string(first), "--step", std::to_string(request_.jobs), "--length",
         std::to_string(request_.length), "--records", scratch(k, "jsonl").string(), "--in-flight",
         scratch(k, "in-flight").string(), "--deadly", scratch(k, "deadly").string()});
    if (request_.fresh_contexts) command.push_back("--fresh-contexts");
    if (programs) command.insert(command.end(), {"--programs", std::to_string(*programs)});
    if (left > 0) command.insert(command.end(), {"--seconds", fmt::format("{:.3f}", left)});
    fs::remove(scratch(k, "jsonl"));
    fs::remove(scratch(k, "in-flight"));
    write_atomically(scratch(k, "deadly"), list_as_text(lane.deadly));
    lane.child = std::make_unique<SuiteChild>(command, scratch(k, "jsonl"), scratch(k, "log"),
                                              Limits{request_.seconds_per_program});
  }

  void look() {
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      Lane& lane = lanes_[k];
      if (!lane.child) continue;
      SuiteChild::Deadline deadline;
      if (request_.seconds > 0)
        deadline = begin_ + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(request_.seconds + kPatience));
      const bool ended = lane.child->look(kLook, deadline, [&](const Event& event) {
        if (std::holds_alternative<TestStarted>(event)) lane.smaller.reset();
        const auto* other = std::get_if<OtherEvent>(&event);
        const std::optional<CampaignEvent> of_campaign =
            other ? parse_campaign_event(other->line) : std::nullopt;
        if (of_campaign) take(lane, *of_campaign);
      });
      if (ended) finish(static_cast<int>(k));
    }
    found_.seconds = seconds_since(begin_);
    progress_(found_);
  }

  void take(Lane& lane, const CampaignEvent& event) {
    if (const auto* started = std::get_if<CampaignStarted>(&event)) {
      max_eval_order_ = started->max_eval_order;
    } else if (const auto* smaller = std::get_if<FindingShrank>(&event)) {
      lane.smaller = smaller->finding;
    } else if (const auto* made = std::get_if<FindingMade>(&event)) {
      found(fmt::format("program {}", made->number), made->finding);
    } else if (const auto* now = std::get_if<CampaignProgress>(&event)) {
      found_.programs += now->programs - lane.totals.programs;
      found_.commands += now->commands - lane.totals.commands;
      found_.judged += now->judged - lane.totals.judged;
      found_.in_full += now->in_full - lane.totals.in_full;
      found_.not_repeated += now->not_repeated - lane.totals.not_repeated;
      found_.seconds_of_known += now->seconds_of_known - lane.totals.seconds_of_known;
      lane.totals = *now;
    }
  }

  // Handles the end of a child. If the child has died, which is a finding, another child continues with the
  // next program.
  void finish(int k) {
    Lane& lane = lanes_[static_cast<std::size_t>(k)];
    const ChildRun run = lane.child->run();
    const Lane last = std::exchange(lane, {});
    if (run.complete || interrupted || run.cut_short) return;
    if (!run.cannot_write.empty()) throw CannotWrite(run.cannot_write);
    constexpr int kOwnFault = 3;
    if (!run.ending.signalled && run.ending.value == kOwnFault)
      throw std::runtime_error(fmt::format("{}: {}", run.in_flight, last_line(scratch(k, "log"))));
    if (run.in_flight.empty()) {
      if (++empty_starts_ < kMostEmptyStarts) return start(k, last.first, last.programs);
      found_.cannot_start =
          "it does not start: " + describe(run.ending) + "; " + last_line(scratch(k, "log"));
      return;
    }
    const std::uint32_t number = number_of(run.in_flight);
    const std::uint32_t done = (number - last.first) / static_cast<std::uint32_t>(request_.jobs) + 1;
    const auto left_behind = [&](std::uint32_t behind) {
      return last.programs ? std::optional(*last.programs - behind) : std::nullopt;
    };
    const std::string in_flight = read_file(scratch(k, "in-flight"));
    died(run, number, in_flight);
    if (!in_flight.empty() && last.deadly.size() < kMostDeaths) {
      // The child died during the reduction of another difference, so this reduction is repeated.
      std::vector<std::string> deadly = number == last.first ? last.deadly : std::vector<std::string>();
      deadly.push_back(in_flight);
      found_.programs += done - 1 - last.totals.programs;
      return start(k, number, left_behind(done - 1), std::move(deadly));
    }
    if (last.smaller) found(fmt::format("program {}", number), *last.smaller);
    found_.programs += done - last.totals.programs;
    start(k, number + static_cast<std::uint32_t>(request_.jobs), left_behind(done));
  }

  static std::string last_line(const fs::path& log) {
    std::ifstream stream(log);
    std::string last;
    for (std::string line; std::getline(stream, line);)
      if (!line.empty()) last = line;
    return last;
  }

  // Adds the finding for a death of a child. The program in which it died, or the candidate of a reduction
  // (`in_flight`), is reduced by running smaller candidates in separate processes.
  void died(const ChildRun& run, std::uint32_t number, const std::string& in_flight) {
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
    const std::size_t before = deaths_.size();
    const std::optional<Finding> finding = reduce_death(
        program, death_of(run).value_or(Difference{Difference::kCrash, "", ""}),
        [&](const gl::Case& candidate) {
          return interrupted || seconds_since(begin) > kSecondsAlone ? std::nullopt
                                                                     : run_alone(candidate, patience);
        },
        deaths_, run.hung ? kMostHangs : kMostAttemptsAlone, max_eval_order_);
    if (deaths_.size() == before) found_.seconds_of_known += seconds_since(begin);
    if (finding) return found(fmt::format("program {}", number), *finding);
    Finding of_history;
    of_history.program = program;
    of_history.failure.what = run.hung ? Difference::kHang : Difference::kCrash;
    of_history.failure.message = fmt::format("{}: {}", of_history.failure.what, describe(run.ending));
    of_history.cause = of_history.title = of_history.failure.what + " after what was run before";
    found(fmt::format("program {}", number), of_history);
  }

  // Runs the program in a separate process.
  std::optional<Difference> run_alone(const gl::Case& program, double patience) {
    const fs::path file = scratch_ / "alone.json";
    const fs::path events = scratch_ / fmt::format("alone-{}.jsonl", ++runs_alone_);
    write_atomically(file, gl::to_text(program));
    std::vector<std::string> command = shared_options();
    command.insert(command.end(), {"--replay", file.string(), "--records", events.string()});
    SuiteChild child(command, events, scratch_ / "alone.log", {patience});
    while (!child.look(kLook)) continue;
    fs::remove(events);
    return death_of(child.run());
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
    const fs::path replay = scratch_ / "write.json", events = scratch_ / "write.jsonl";
    write_atomically(replay, gl::to_text(cause.finding.program));
    std::vector<std::string> command = shared_options();
    command.insert(command.end(), {"--replay", replay.string(), "--records", events.string(), "--reproduce",
                                   fs::path(cause.file).replace_extension(".c").string()});
    SuiteChild child(command, events, scratch_ / "write.log", {request_.seconds_per_program});
    while (!child.look(kLook)) continue;
    fs::remove(events);
  }

  const SearchRequest& request_;
  const std::function<void(const SearchResult&)>& progress_;
  const fs::path scratch_;
  const Clock::time_point begin_ = Clock::now();
  std::vector<Lane> lanes_;
  SearchResult found_;
  std::vector<Finding> deaths_;  // minimal programs in which the library died
  int empty_starts_ = 0, runs_alone_ = 0;
  int max_eval_order_ = 8;  // reported by the children
};

}  // namespace

SearchResult search(const SearchRequest& request,
                    const std::function<void(const SearchResult& now)>& progress) {
  return Searcher(request, progress).run();
}

}  // namespace evalcts::fuzz
