// Implements SuiteChild: reads the events of the suite program, and kills it if it exceeds a limit.
#include <evalcts/runner/suite_child.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include <evalcts/results/event_file.h>
#include <evalcts/runner/interruption.h>

namespace evalcts {

namespace {
using Clock = std::chrono::steady_clock;
constexpr double kMostToEnd = 2;  // seconds that the process may take to exit after its last test
// Time that a process that hangs may take to report its command in flight.
constexpr std::chrono::seconds kMostToReport(1);
}  // namespace

std::string describe(const ChildRun& run, const Limits& limits) {
  if (run.over_memory) return fmt::format("it used more than {} MiB of memory", limits.memory >> 20);
  std::string text = run.hung ? fmt::format("no answer within {} seconds", limits.seconds_per_test)
                              : "the process ended with " + describe(run.ending);
  if (!run.crash) return text;
  if (!run.crash->call.empty())
    text += fmt::format(" in {}, after {} commands", run.crash->call, run.crash->commands_before);
  if (!run.crash->frames.empty()) text += ", at " + run.crash->frames.front();
  return text;
}

SuiteChild::SuiteChild(const std::vector<std::string>& command, const std::filesystem::path& events,
                       const std::filesystem::path& log, const Limits& limits)
    : events_(events), limits_(limits), process_(command, log.string(), ChildProcess::Prints::kLimited) {}

bool SuiteChild::look(double seconds, const Deadline& deadline,
                      const std::function<void(const Event& event)>& each) {
  const std::optional<Ending> ending = process_.wait(seconds);
  std::ifstream file(events_, std::ios::binary);
  file.seekg(read_);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::optional<Event> event = parse_event(text.substr(begin, end - begin));
    if (!event) continue;
    take(*event);
    if (each) each(*event);
    latest_event_ = Clock::now();
  }
  read_ += static_cast<std::streamoff>(begin);
  if (ending) {
    run_.ending = *ending;
    if (!ending->signalled && ending->value == kExitCannotWrite &&
        process_.own_words().starts_with(kCannotWriteEvent))
      run_.cannot_write = process_.own_words();
    return true;
  }
  const double patience =
      run_.complete ? std::min(limits_.seconds_per_test, kMostToEnd) : limits_.seconds_per_test;
  if (interrupted || (report_deadline_ && Clock::now() > *report_deadline_)) {
    process_.kill();
  } else if (deadline && Clock::now() > *deadline) {
    run_.cut_short = true;
    process_.kill();
  } else if (process_.memory() > limits_.memory) {
    run_.over_memory = true;
    process_.kill();
  } else if (std::chrono::duration<double>(Clock::now() - latest_event_).count() > patience) {
    if (run_.complete) {
      process_.kill();
    } else if (!report_deadline_) {
      run_.hung = true;
      report_deadline_ = Clock::now() + kMostToReport;
      process_.abort();  // the signal handler reports the command in flight
    }
  }
  return false;
}

void SuiteChild::take(const Event& event) {
  if (const auto* start = std::get_if<TestStarted>(&event)) {
    run_.in_flight = start->name;
    run_.last_case.reset();
    run_.crash.reset();
  } else if (const auto* of_case = std::get_if<CaseStarted>(&event)) {
    run_.last_case = *of_case;
    run_.cases[run_.in_flight].push_back(of_case->identity);
  } else if (const auto* result = std::get_if<TestFinished>(&event)) {
    run_.finished.push_back(result->record.name);
    run_.records[result->record.name] = result->record;
    run_.in_flight.clear();
  } else if (const auto* crashed = std::get_if<Crashed>(&event)) {
    run_.crash = crashed->crash;
  } else if (std::holds_alternative<RunEnded>(event)) {
    run_.complete = true;
  }
}

}  // namespace evalcts
