// Implements Worker and Pool: writes jobs to the standard input of processes, and reads their events.
#include <evalcts/runner/worker.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/results/files.h>
#include <evalcts/results/job_reader.h>
#include <evalcts/runner/interruption.h>

namespace evalcts {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr int kMostMilliseconds = 20;  // longest time between two checks of the limits
constexpr double kMostToEnd = 2;       // seconds that the process may take to exit after its last job
constexpr int kMostEmptyStarts = 2;    // workers in turn that may end before their first job
constexpr double kMostToArrive = 5;    // seconds that the report of a worker elsewhere may need
constexpr std::size_t kMostQuotedLines = 3;
constexpr std::size_t kMostForeign = 4096;             // bytes of lines that are no events
constexpr char kCannotStartLine[] = "cannot start: ";  // suite_main prints the reason in such a line, too
// Time that a process that hangs may take to report its command in flight.
constexpr std::chrono::seconds kMostToReport(1);

// Two connected descriptors, which it closes unless they are taken away.
struct Ends {
  int reader = -1, writer = -1;
  // `make` is pipe2(), or makes a pair of sockets.
  explicit Ends(const std::function<int(int*)>& make) {
    std::array<int, 2> ends{};
    if (make(ends.data()) != 0)
      throw CannotSpawn(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    reader = ends[0];
    writer = ends[1];
  }
  ~Ends() {
    for (const int end : {reader, writer})
      if (end >= 0) close(end);
  }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
};

// Returns a clause with the first different lines that a library printed before it failed to start, and the
// name of the log with all of them; empty if it printed none. `who`: what printed them.
std::string quoted(const std::string& who, const std::string& printed, const fs::path& log) {
  std::vector<std::string> lines;
  std::istringstream stream(printed);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && !line.starts_with(kCannotStartLine) && std::ranges::count(lines, line) == 0)
      lines.push_back(line);
  if (lines.empty() || log.empty()) return {};
  if (lines.size() > kMostQuotedLines) lines.resize(kMostQuotedLines);
  return fmt::format("; {} printed \"{}\" (all of its output is in {})", who, fmt::join(lines, " | "),
                     log.string());
}

// Returns what a worker elsewhere gets instead of the arguments in `command`.
WorkerOptions options_elsewhere(std::vector<std::string> command, const Limits& limits) {
  WorkerOptions start;
  const auto programs = std::ranges::find(command, "--programs");
  if (programs != command.end()) {
    start.programs = read_file(*std::next(programs));
    command.erase(programs, programs + 2);
  }
  start.options.assign(command.begin() + 1, command.end());
  if (std::isfinite(limits.seconds_per_test))
    start.options.insert(start.options.end(), {"--most-seconds", fmt::format("{}", limits.seconds_per_test)});
  return start;
}

}  // namespace

std::string describe(const WorkerRun& run) {
  if (run.over_memory) return fmt::format("it used more than {} MiB of memory", run.limits.memory >> 20);
  std::string text = run.hung ? fmt::format("no answer within {:.3g} seconds", run.limits.seconds_per_test)
                              : "the process ended with " + describe(run.ending);
  if (!run.crash) return text;
  if (!run.crash->call.empty())
    text += fmt::format(" in {}, after {} commands", run.crash->call, run.crash->commands_before);
  if (!run.crash->frames.empty()) text += ", at " + run.crash->frames.front();
  return text;
}

Worker::Worker(std::vector<std::string> command, const fs::path& log, const Limits& limits) {
  run_.command = command;
  run_.limits = limits;
  const auto elsewhere = std::ranges::find(command, kElsewhere);
  is_elsewhere_ = elsewhere != command.end();
  Ends events([](int* ends) { return pipe2(ends, O_CLOEXEC); });
  // A socket can be written without SIGPIPE when the process has ended.
  Ends jobs([](int* ends) { return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends); });
  fcntl(events.reader, F_SETFL, O_NONBLOCK);
  if (is_elsewhere_) {
    // Shells on the way would take the options apart.
    const std::string start = fmt::format("{} {}", *std::next(elsewhere), kRemote);
    command.erase(elsewhere, elsewhere + 2);
    unwritten_ = to_line(options_elsewhere(std::move(command), limits));
    process_.emplace(std::vector<std::string>{"/bin/sh", "-c", start}, log.string(),
                     ChildProcess::Prints::kLimited, jobs.reader, events.writer);
  } else {
    // The process opens the pipe by this name, so that it can open it again if the library closes it.
    command.insert(command.end(), {"--events", fmt::format("/proc/{}/fd/{}", getpid(), events.writer)});
    process_.emplace(command, log.string(), ChildProcess::Prints::kLimited, jobs.reader);
    events_writer_ = std::exchange(events.writer, -1);
  }
  events_ = std::exchange(events.reader, -1);
  input_ = std::exchange(jobs.writer, -1);
}

Worker::~Worker() {
  close_input();
  process_.reset();
  for (const int descriptor : {events_, events_writer_})
    if (descriptor >= 0) close(descriptor);
}

void Worker::give(const Job& job) {
  if (is_idle()) latest_event_ = Clock::now();
  waiting_.push_back(job);
  unwritten_ += to_line(job);
  write_jobs();
}

void Worker::finish() {
  is_finishing_ = true;
  latest_event_ = Clock::now();
  write_jobs();
}

void Worker::close_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

void Worker::write_jobs() {
  while (input_ >= 0 && !unwritten_.empty()) {
    const ssize_t count = send(input_, unwritten_.data(), unwritten_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count < 0) return close_input();  // the process has ended
    unwritten_.erase(0, static_cast<std::size_t>(count));
  }
  if (is_finishing_) close_input();
}

void Worker::read_events(const EachEvent& each) {
  std::array<char, 65536> bytes{};
  for (ssize_t count; (count = read(events_, bytes.data(), bytes.size())) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    partial_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  std::size_t begin = 0;
  for (std::size_t end; (end = partial_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = partial_.substr(begin, end - begin);
    const std::optional<Event> event = parse_event(line);
    if (!event) {
      if (foreign_.size() < kMostForeign) foreign_ += line + "\n";
      continue;
    }
    take(*event);
    if (each) each(*event);
    latest_event_ = Clock::now();
  }
  partial_.erase(0, begin);
}

bool Worker::update(const Deadline& deadline, const EachEvent& each) {
  write_jobs();
  const std::optional<Ending> ending = process_->wait(0);
  read_events(each);
  if (!ending) {
    check_limits(deadline);
    return false;
  }
  run_.ending = *ending;
  run_.printed = foreign_ + process_->printed();
  return true;
}

void Worker::check_limits(const Deadline& deadline) {
  const bool is_working = !waiting_.empty() || !run_.in_flight.empty() || is_finishing_;
  // A worker elsewhere ends by itself if it hangs, and reports where.
  const double limit = run_.limits.seconds_per_test + (is_elsewhere_ ? kMostToArrive : 0);
  const double patience = run_.complete ? std::min(limit, kMostToEnd) : limit;
  if (interrupted || (report_deadline_ && Clock::now() > *report_deadline_)) {
    process_->kill();
  } else if (deadline && Clock::now() > *deadline) {
    run_.cut_short = true;
    process_->kill();
  } else if (process_->memory() > run_.limits.memory) {
    run_.over_memory = true;
    process_->kill();
  } else if (is_working && std::chrono::duration<double>(Clock::now() - latest_event_).count() > patience) {
    if (run_.complete) {
      process_->kill();
    } else if (!report_deadline_) {
      run_.hung = true;
      report_deadline_ = Clock::now() + kMostToReport;
      if (!is_elsewhere_) process_->abort();  // the signal handler reports the command in flight
    }
  }
}

const WorkerRun& Worker::wait(const Deadline& deadline, const EachEvent& each) {
  while (!update(deadline, each)) wait_for_activity({this});
  return run_;
}

void Worker::take(const Event& event) {
  if (const auto* start = std::get_if<JobStarted>(&event)) {
    if (!waiting_.empty()) waiting_.pop_front();
    run_.in_flight = start->name;
    run_.last_case.reset();
    run_.crash.reset();
  } else if (const auto* of_case = std::get_if<CaseStarted>(&event)) {
    run_.last_case = *of_case;
    run_.cases[run_.in_flight].push_back(of_case->identity);
  } else if (const auto* result = std::get_if<TestFinished>(&event)) {
    run_.records[result->record.name] = result->record;
  } else if (std::holds_alternative<JobEnded>(event)) {
    run_.finished.push_back(std::exchange(run_.in_flight, {}));
  } else if (const auto* written = std::get_if<ProgramWritten>(&event)) {
    run_.program = written->text;
  } else if (std::holds_alternative<Hung>(event)) {
    run_.hung = true;
  } else if (const auto* crashed = std::get_if<Crashed>(&event)) {
    run_.crash = crashed->crash;
  } else if (const auto* why = std::get_if<CannotOpen>(&event)) {
    run_.cannot_start = why->reason;
  } else if (std::holds_alternative<RunEnded>(event)) {
    run_.complete = true;
  }
}

void wait_for_activity(const std::vector<const Worker*>& workers) {
  std::vector<pollfd> news;
  for (const Worker* worker : workers) {
    news.push_back({worker->events_, POLLIN, 0});
    if (!worker->unwritten_.empty()) news.push_back({worker->input_, POLLOUT, 0});
    for (const int descriptor : worker->process_->readable_descriptors())
      news.push_back({descriptor, POLLIN, 0});
  }
  poll(news.data(), news.size(), kMostMilliseconds);
}

bool Pool::run(const std::function<std::optional<Job>()>& next) const {
  std::vector<std::unique_ptr<Worker>> running;
  std::deque<Job> returned;  // jobs that a worker has not started before its end
  int empty_starts = 0;
  const auto next_job = [&]() -> std::optional<Job> {
    if (interrupted) return std::nullopt;
    if (returned.empty()) return next();
    Job job = std::move(returned.front());
    returned.pop_front();
    return job;
  };
  const auto supply = [&](Worker& worker, const std::optional<Job>& job) {
    if (job) worker.give(*job);
    if (!job || is_each_alone) worker.finish();
  };
  const auto start = [&] {
    if (empty_starts >= kMostEmptyStarts) return false;
    const std::optional<Job> job = next_job();
    if (!job) return false;
    Limits of_this = limits;
    if (patience) of_this.seconds_per_test = patience();
    running.push_back(std::make_unique<Worker>(command(), log, of_this));
    supply(*running.back(), job);
    return true;
  };
  while (running.size() < workers && start()) continue;
  while (!running.empty()) {
    std::vector<const Worker*> all;
    for (const auto& worker : running) all.push_back(worker.get());
    wait_for_activity(all);
    for (std::size_t i = 0; i < running.size();) {
      Worker& worker = *running[i];
      if (!worker.update(deadline, each)) {
        if (worker.is_idle()) supply(worker, next_job());
        ++i;
        continue;
      }
      const std::unique_ptr<Worker> done = std::move(running[i]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      const WorkerRun& run = done->run();
      returned.insert(returned.begin(), done->waiting().begin(), done->waiting().end());
      if (ended) ended(run);
      // Workers that are started from now on may have a better command.
      if (run.began_a_job())
        empty_starts = 0;
      else if (run.command == command())
        ++empty_starts;
      while (running.size() < workers && start()) continue;
    }
  }
  return returned.empty();
}

std::string why_no_answer(const WorkerRun& run, const fs::path& log) {
  if (interrupted) return "interrupted";
  const std::string printed = quoted(run.is_elsewhere() ? "the worker" : "the library", run.printed, log);
  if (!run.cannot_start.empty()) return run.cannot_start + printed;
  if (run.hung || run.over_memory) return describe(run);
  return fmt::format("{} ended with {}{}{}{}",
                     run.is_elsewhere() ? "the command of --worker" : "the process that loads the library",
                     describe(run.ending), run.is_elsewhere() ? "" : describe_gl_environment(),
                     log.empty() ? "" : "; see " + log.string(), printed);
}

std::vector<ListedTest> list_tests(const fs::path& suite_program) {
  std::string reason;
  const std::optional<TestsListed> listed =
      ask<TestsListed>({suite_program.string()}, {"list", "list"}, reason);
  if (!listed)
    throw std::runtime_error(fmt::format("{} does not list its tests ({})", suite_program.string(), reason));
  return listed->tests;
}

}  // namespace evalcts
