// A worker: a process of the suite program, which opens one implementation and runs jobs. Jobs are lines on
// its standard input, events are lines on a pipe of their own.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/serialization.h>
#include <evalcts/runner/child_process.h>

namespace evalcts {

// Time and memory beyond which a library is assumed never to stop. They are far more than any GL needs
// for a test.
struct Limits {
  double seconds_per_test = 45;  // longest time between two events of a process that has a job
  std::uint64_t memory = std::uint64_t{4096} << 20;  // resident memory of a process, in bytes
};

// The option with the command of a worker elsewhere, see Worker.
inline constexpr char kElsewhere[] = "--worker";

// Results and end of a worker.
struct WorkerRun {
  std::vector<std::string> command;  // that started it, without the options that Worker adds
  Limits limits;
  std::map<std::string, TestRecord> records;
  std::vector<std::string> finished;     // names of the jobs, in the order in which they ran
  std::string in_flight;                 // the job that runs, or that the process died in
  std::optional<CaseStarted> last_case;  // latest case of that test, if cases are traced
  std::optional<Crash> crash;  // place of the crash or hang in that job, if the process could report it
  std::map<std::string, std::vector<std::string>> cases;  // identities of cases by test, if they are traced
  bool hung = false;
  bool over_memory = false;  // the process was killed because it exceeded Limits::memory
  bool cut_short = false;    // the process was killed at the deadline
  bool complete = false;     // all jobs have ended
  std::string cannot_start;  // the reason if the implementation does not start, otherwise empty
  std::string printed;       // the first lines that the process printed
  std::string program;       // the latest ProgramWritten; empty: none
  Ending ending;

  // The next two are for processes that have ended.
  bool died_in_job() const { return !in_flight.empty(); }
  bool began_a_job() const { return died_in_job() || !finished.empty(); }
  // True if a worker elsewhere ended in a job, or gave no answer, without a report of its own: perhaps only
  // the connection was lost.
  bool may_be_lost() const { return is_elsewhere() && died_in_job() && !crash && !over_memory; }

  bool is_elsewhere() const { return std::ranges::count(command, kElsewhere) > 0; }
};

// Exit status of the suite program after a fault of its own.
inline constexpr int kOwnFault = 3;

// Returns a description of the end of the process: "no answer within 60 seconds in glEnd(), after 12
// commands", "it used more than 4096 MiB of memory", "the process ended with ... in glEnd(), after 12
// commands, at libGL.so.1 glEnd+0x2c".
std::string describe(const WorkerRun& run);

using Deadline = std::optional<std::chrono::steady_clock::time_point>;
using EachEvent = std::function<void(const Event& event)>;

class Worker {
 public:
  // Starts `command`, the suite program with the options of the implementation. With "--worker", COMMAND
  // among them, a shell starts COMMAND --remote instead, which runs the suite program anywhere: it reads
  // the other options from standard input, and writes events to standard output. All output other than events
  // is appended to `log` (empty: discarded), which keeps kMostPrinted bytes of each test. The process is
  // killed if it reports no event for limits.seconds_per_test while it has a job (it then counts as hung), or
  // if it exceeds limits.memory. Throws CannotSpawn.
  Worker(std::vector<std::string> command, const std::filesystem::path& log, const Limits& limits);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Gives the process another job.
  void give(const Job& job);
  // Lets the process end after its jobs.
  void finish();
  // Returns the jobs that have not been started yet.
  const std::deque<Job>& waiting() const { return waiting_; }
  // True if all jobs have ended, and finish() was not called.
  bool is_idle() const { return waiting_.empty() && run_.in_flight.empty() && input_ >= 0; }

  // Adds the new events to run() and calls `each` with each of them. Kills the process if a signal has
  // interrupted the run, or the deadline has passed. Returns true once the process has ended and all events
  // have been read.
  bool update(const Deadline& deadline = {}, const EachEvent& each = {});
  // Waits until the process has ended.
  const WorkerRun& wait(const Deadline& deadline = {}, const EachEvent& each = {});

  const WorkerRun& run() const { return run_; }

 private:
  friend void wait_for_activity(const std::vector<const Worker*>& workers);
  void take(const Event& event);
  void read_events(const EachEvent& each);
  void write_jobs();
  void close_input();
  void check_limits(const Deadline& deadline);

  int events_ = -1, events_writer_ = -1;  // the pipe of the events; the writer is opened by the process, too
  int input_ = -1;                        // a socket, standard input of the process; -1: closed
  bool is_finishing_ = false;
  std::string unwritten_;  // jobs that the pipe could not take yet
  bool is_elsewhere_ = false;
  std::string foreign_;  // the first lines that are no events
  std::string partial_;  // the beginning of an event whose end has not arrived yet
  std::deque<Job> waiting_;
  std::chrono::steady_clock::time_point latest_event_ = std::chrono::steady_clock::now();
  Deadline report_deadline_;  // time at which a process that hangs is killed; none before it hangs
  WorkerRun run_;
  std::optional<ChildProcess> process_;
};

// Waits until one of the workers has an event or output, can take more input, or ends, or a fraction of a
// second has passed.
void wait_for_activity(const std::vector<const Worker*>& workers);

// Several workers that share a list of jobs. A worker that ends before its time is replaced.
struct Pool {
  std::function<std::vector<std::string>()> command;  // starts a worker; called for each
  std::filesystem::path log;                          // of all workers
  Limits limits;
  std::function<double()> patience = {};  // seconds per test of the next worker; empty: those of `limits`
  std::size_t workers = 1;
  bool is_each_alone = false;  // each job gets a process of its own
  Deadline deadline = {};
  EachEvent each = {};
  std::function<void(const WorkerRun& run)> ended = {};  // called for each worker that has ended

  // Runs the jobs that `next` returns, until it returns none. Returns false if it gave up, because several
  // workers in turn ended before their first job. An interruption (interruption.h) ends it, too.
  bool run(const std::function<std::optional<Job>()>& next) const;
};

// Returns the reason why a process with one job gave no answer.
std::string why_no_answer(const WorkerRun& run, const std::filesystem::path& log);

// Asks for the answer to one job, in a process of its own. Returns the event of type `Answer`; if there
// is none, sets `reason`.
template <class Answer>
std::optional<Answer> ask(const std::vector<std::string>& command, const Job& job, std::string& reason,
                          const std::filesystem::path& log = {}, const Limits& limits = {}) {
  std::optional<Answer> answer;
  Worker worker(command, log, limits);
  worker.give(job);
  worker.finish();
  const WorkerRun& run = worker.wait({}, [&](const Event& event) {
    if (const auto* found = std::get_if<Answer>(&event)) answer = *found;
  });
  if (!answer) reason = why_no_answer(run, log);
  return answer;
}

// Returns all tests of the suite program. Throws std::runtime_error.
std::vector<ListedTest> list_tests(const std::filesystem::path& suite_program);

}  // namespace evalcts
