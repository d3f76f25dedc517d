#include "harness/runner/runner.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "harness/implementations/gl_environment.h"
#include "harness/runner/child_process.h"
#include "harness/runner/claims.h"
#include "harness/runner/control_case.h"
#include "harness/runner/history.h"
#include "harness/runner/suite_child.h"

namespace evalcts {

std::atomic<bool> interrupted = false;

namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLook = 0.02;           // seconds between two looks at a child
constexpr double kStartTimeout = 60;     // for the questions that each library is asked first
constexpr double kSearchBudget = 30;     // seconds spent on finding what one failure depends on
constexpr double kSearchesBudget = 120;  // ... and all of them
constexpr std::size_t kMostQuotedLines = 3;
constexpr char kCannotStartLine[] = "cannot start: ";  // the reason itself, as suite_main prints it
constexpr int kMostEmptyStarts = 2;                    // children that end without having begun a test

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string machine() {
  utsname names{};
  uname(&names);
  std::string model = "unknown processor";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.starts_with("model name")) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  return fmt::format("{} {}, {}, {} threads", names.sysname, names.machine, model,
                     std::thread::hardware_concurrency());
}

// In a command that people type where this one was typed: what lies below by its short name, anything else by
// its whole.
std::string seen_from_here(const fs::path& path) {
  std::error_code unknown;
  const fs::path near = fs::proximate(path, unknown);
  if (unknown || near.empty() || near.is_absolute() || *near.begin() == "..")
    return fs::absolute(path).string();
  return near.has_parent_path() ? near.string() : (fs::path(".") / near).string();
}

class Run {
 public:
  Run(const RunRequest& request, const std::function<void(const Progress&)>& progress)
      : request_(request),
        progress_(progress),
        scratch_(request.output / ("scratch-" + file_label(request.name, request.shard, pass()))) {}
  ~Run() {
    std::error_code error;
    fs::remove_all(scratch_, error);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  json run() {
    remove_stale_files();
    json result = header();
    progress_({"starting", 0, request_.tests.size(), ""});
    try {
      if (!start(result)) return finish(result, "not-started");
      run_tests();
      if (second_pass())
        explain_by_history();
      else
        play_failures_again(result);
    } catch (const CannotWrite& error) {
      result["reason"] =
          error.what() + std::string("; free some space, or choose another folder with --output");
      return finish(result, "interrupted");
    }
    return finish(result, interrupted ? "interrupted" : "complete");
  }

 private:
  bool second_pass() const { return request_.first_pass != nullptr; }
  std::string pass() const { return second_pass() ? kReuseContext : ""; }

  fs::path file(const std::string& kind, const std::string& extension) const {
    return request_.output /
           fmt::format("{}-{}.{}", kind, file_label(request_.name, request_.shard, pass()), extension);
  }

  void remove_stale_files() const {
    for (const auto& [kind, extension] :
         {std::pair{"results", "json"}, {"records", "jsonl"}, {"junit", "xml"}, {"log", "txt"}})
      fs::remove(file(kind, extension));
    fs::remove_all(scratch_);
    fs::create_directory(scratch_);
  }

  json header() const {
    json header = {{"format", "evalcts-results-1"},
                   {"evalcts_version", EVALCTS_VERSION},
                   {"command", request_.command},
                   {"depth", request_.depth},
                   {"seed", request_.seed},
                   {"timeout", request_.limits.seconds_per_test},
                   {"memory", request_.limits.memory >> 20},
                   {"suite_command", suite_command()},
                   {"reason", ""},
                   {"implementation", {{"name", request_.name}, {"machine", machine()}}}};
    if (second_pass()) header["pass"] = pass();
    if (!request_.shard.empty()) header["shard"] = request_.shard;
    return header;
  }

  // What is judged and how, in options that `evalcts run` and the suite program share.
  std::vector<std::string> shared_options() const {
    std::vector<std::string> options = {"--depth", request_.depth, "--seed", std::to_string(request_.seed)};
    if (!request_.implementation.name.empty())
      options.insert(options.end(), {"--implementation", request_.implementation.name});
    if (!request_.implementation.library.empty())
      options.insert(options.end(), {"--library", request_.implementation.library});
    if (!request_.implementation.context.empty())
      options.insert(options.end(), {"--context", request_.implementation.context});
    for (const std::string& reading : request_.readings)
      options.insert(options.end(), {"--interpretation", reading});
    return options;
  }

  std::vector<std::string> suite_command() const {
    std::vector<std::string> command = shared_options();
    command.insert(command.begin(), request_.suite_program.string());
    return command;
  }

  // What to do next about a failure: judge this test alone, open it in a debugger, make a C program of it.
  void add_commands(json& record) const {
    const std::string name = record["name"];
    // Over a shared context, with the tests that have to come before.
    std::string filter = name;
    if (record.contains("history"))
      for (const std::string before : record["history"]) filter += ":" + before;
    const std::string usual_name =
        request_.implementation.name.empty() ? "library" : request_.implementation.name;
    std::vector<std::string> rerun = shared_options();
    rerun.insert(rerun.begin(), {request_.program, "run"});
    if (request_.name != usual_name) rerun.insert(rerun.end(), {"--name", request_.name});
    if (second_pass()) rerun.push_back("--reuse-context");
    const Limits& limits = request_.limits;
    if (limits.seconds_per_test != Limits().seconds_per_test)
      rerun.insert(rerun.end(), {"--timeout", fmt::format("{}", limits.seconds_per_test)});
    if (limits.memory != Limits().memory)
      rerun.insert(rerun.end(), {"--memory", std::to_string(limits.memory >> 20)});
    rerun.insert(rerun.end(), {"--filter", filter});
    record["rerun"] = shell_line(rerun);

    std::vector<std::string> debug = suite_command();
    debug.front() = seen_from_here(debug.front());
    debug.insert(debug.begin(), {"gdb", "--args"});
    if (second_pass()) debug.push_back("--reuse-context");
    std::replace(filter.begin(), filter.end(), '-', '?');  // GoogleTest takes what follows '-' as negative
    debug.push_back("--gtest_filter=" + filter);
    record["debug"] = shell_line(debug);

    if (second_pass()) return;  // a C program holds one case, not its history
    std::vector<std::string> reproduce = {request_.program, "reproduce", request_.name + ":" + name};
    if (request_.own_output)
      reproduce.insert(reproduce.end(), {"--results", seen_from_here(request_.output)});
    record["reproducer"] = shell_line(reproduce);
  }

  // A question to a child of its own, which is at work on it from the beginning.
  struct Question {
    fs::path answer_file;
    ChildProcess child;
    Clock::time_point begin = Clock::now();
  };
  // `name`: unlike that of any other question at the same time.
  std::unique_ptr<Question> ask(const std::string& name, const std::vector<std::string>& question) const {
    const fs::path answer_file = scratch_ / ("answer-" + name + ".json");
    fs::remove(answer_file);
    std::vector<std::string> command = suite_command();
    command.push_back("--die-with-parent");
    command.insert(command.end(), question.begin(), question.end());
    command.insert(command.end(), {"--answer", answer_file.string()});
    return std::unique_ptr<Question>(new Question{
        answer_file, ChildProcess(command, file("log", "txt").string(), ChildProcess::Prints::limited)});
  }

  // Waits for it. An empty answer comes with a reason.
  json answer(Question& question, std::string& reason) const {
    auto& [answer_file, child, begin] = question;
    std::optional<Ending> ending;
    bool swelled = false;
    while (!(ending = child.wait(kLook)) && !interrupted && !swelled && seconds_since(begin) < kStartTimeout)
      swelled = child.memory() > request_.limits.memory;
    if (!ending) {
      child.kill();
      reason = interrupted ? "interrupted"
               : swelled   ? fmt::format("it took more than {} MiB of memory", request_.limits.memory >> 20)
                           : fmt::format("no answer within {} seconds", kStartTimeout);
      return nullptr;
    }
    std::ifstream stream(answer_file);
    json answer = json::parse(stream, nullptr, false);
    stream.close();
    fs::remove(answer_file);
    if (answer.is_object() && answer.contains("cannot_start")) {
      reason = answer["cannot_start"].get<std::string>() + quote_output(child.printed());
      return nullptr;
    }
    if (ending->signalled || ending->value != 0 || !answer.is_object()) {
      reason =
          fmt::format("the process that loads the library ended with {}{}; see {}{}", describe(*ending),
                      describe_gl_environment(), file("log", "txt").string(), quote_output(child.printed()));
      return nullptr;
    }
    return answer;
  }

  // Returns a clause with the first different lines that a library printed before it failed to start, and the
  // name of the log with all of them; empty if it printed none.
  std::string quote_output(const std::string& printed) const {
    std::vector<std::string> lines;
    std::istringstream stream(printed);
    for (std::string line; std::getline(stream, line);)
      if (!line.empty() && !line.starts_with(kCannotStartLine) &&
          std::find(lines.begin(), lines.end(), line) == lines.end())
        lines.push_back(line);
    if (lines.empty()) return {};
    if (lines.size() > kMostQuotedLines) lines.resize(kMostQuotedLines);
    return fmt::format("; the library printed \"{}\" (all of its output is in {})", fmt::join(lines, " | "),
                       file("log", "txt").string());
  }

  bool start(json& result) {
    std::string reason;
    const json description = answer(*ask("description", {"--describe"}), reason);
    if (description.is_null()) {
      result["reason"] = reason;
      return false;
    }
    json& implementation = result["implementation"];
    for (const char* member : {"library", "vendor", "renderer", "version", "max_eval_order"})
      implementation[member] = description[member];
    implementation["kind"] = description["name"];
    if (!description["files"].empty()) implementation["files"] = description["files"];
    if (const std::string note = description.value("note", ""); !note.empty()) implementation["note"] = note;
    baseline_ = Baseline::best_fit(request_.baselines, implementation, pass(), request_.baseline);
    implementation["captures"] = json::array();
    const std::vector<std::string> names = description["all_captures"];
    std::vector<std::unique_ptr<Question>> proofs;
    for (const std::string& name : names) proofs.push_back(ask(name, {"--prove", name}));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      std::string why;
      json capture = answer(*proofs[i], why);
      if (capture.is_null()) capture = {{"name", name}, {"available", false}, {"reason", why}};
      if (capture["available"].get<bool>()) captures_.push_back(name);
      implementation["captures"].push_back(capture);
    }
    return !interrupted || (result["reason"] = "interrupted", false);
  }

  // --- running tests -------------------------------------------------------------------------------------

  // `tests`: lines of the file that --tests takes.
  std::vector<std::string> command_for(const std::vector<std::string>& tests, const fs::path& list,
                                       const fs::path& events) const {
    std::ofstream stream(list);
    for (const std::string& test : tests) stream << test << '\n';
    if (!stream.flush()) throw CannotWrite(fmt::format("cannot write '{}'", list.string()));
    fs::remove(events);
    std::vector<std::string> command = suite_command();
    command.insert(command.end(),
                   {"--die-with-parent", "--tests", list.string(), "--records", events.string(), "--captures",
                    captures_.empty() ? "none" : fmt::format("{}", fmt::join(captures_, ","))});
    if (second_pass()) command.push_back("--reuse-context");
    return command;
  }

  // Some tests once more, one process after the other: what they do is not a result.
  ChildRun run_scratch(const std::vector<std::string>& tests, bool trace_cases) const {
    const fs::path events = scratch_ / "again.jsonl";
    std::vector<std::string> command = command_for(tests, scratch_ / "again.txt", events);
    if (trace_cases) command.push_back("--trace-cases");
    SuiteChild child(command, events, file("log", "txt"), request_.limits);
    while (!child.look(kLook, deadline_)) continue;
    throw_if_it_cannot_write(child.run());
    return child.run();
  }

  // Each of the tests in a process of its own, side by side: not results either.
  std::vector<ChildRun> run_alone(const std::vector<std::string>& tests, bool trace_cases) const {
    std::vector<std::unique_ptr<SuiteChild>> children;
    const auto of_test = [this](std::size_t i, const char* extension) {
      return scratch_ / fmt::format("alone-{}.{}", i + 1, extension);
    };
    for (std::size_t i = 0; i < tests.size(); ++i) {
      std::vector<std::string> command = command_for({tests[i]}, of_test(i, "txt"), of_test(i, "jsonl"));
      if (trace_cases) command.push_back("--trace-cases");
      children.push_back(
          std::make_unique<SuiteChild>(command, of_test(i, "jsonl"), of_test(i, "log"), request_.limits));
    }
    std::vector<bool> has_ended(children.size());
    while (std::ranges::count(has_ended, false) > 0)
      for (std::size_t i = 0; i < children.size(); ++i)
        has_ended[i] =
            has_ended[i] || children[i]->look(kLook / static_cast<double>(children.size()), deadline_);
    std::vector<ChildRun> runs;
    for (std::size_t i = 0; i < children.size(); ++i) {
      runs.push_back(children[i]->run());
      append_to_log(of_test(i, "log"));
      throw_if_it_cannot_write(runs.back());
    }
    return runs;
  }

  // Where the disk is full, how a child ends says nothing of the library.
  void throw_if_it_cannot_write(const ChildRun& run) const {
    if (!run.cannot_write.empty())
      throw CannotWrite(fmt::format("cannot write into '{}': {}", request_.output.string(),
                                    run.cannot_write.substr(run.cannot_write.rfind(": ") + 2)));
  }

  void run_tests() {
    records_file_ = file("records", "jsonl");
    for (const json& test : request_.tests)
      if (const Baseline::Pattern* skip = baseline_.skip(test["name"])) {
        add_record(test["name"], "skipped", skip->reason, nullptr);
        records_[test["name"]]["baseline_reason"] = skip->reason;
      }
    int fruitless = 0;
    while (!interrupted) {
      std::vector<std::string> remaining;
      for (const json& test : request_.tests)
        if (!records_.count(test["name"])) remaining.push_back(test["name"]);
      if (remaining.empty()) return;
      const std::size_t before = records_.size();
      const std::vector<ChildRun> ended = run_side_by_side(remaining);
      record_deaths(ended);
      if (interrupted || records_.size() > before || ++fruitless < kMostEmptyStarts) continue;
      const ChildRun& last = ended.back();
      for (const std::string& name : remaining)
        add_record(name, last.hung ? "timeout" : "crash",
                   describe(last, request_.limits) + " before its first test", nullptr);
    }
  }

  // Plays the tests in several processes, each of which takes the next one that none has taken. A process
  // that dies is replaced. Their results are in records_; the return value is how each of them ended, but for
  // those that an interruption killed in a test.
  std::vector<ChildRun> run_side_by_side(const std::vector<std::string>& tests) {
    Claims::create(scratch_ / "claims", tests.size());
    const Claims claims(scratch_ / "claims");
    std::vector<std::unique_ptr<SuiteChild>> jobs(
        std::min(static_cast<std::size_t>(second_pass() ? 1 : request_.jobs), tests.size()));
    const auto of_job = [this](std::size_t job, const char* extension) {
      return scratch_ / fmt::format("job-{}.{}", job + 1, extension);
    };
    const auto start = [&](std::size_t job) {
      std::vector<std::string> command = command_for(tests, of_job(job, "txt"), of_job(job, "jsonl"));
      command.insert(command.end(), {"--claims", (scratch_ / "claims").string(), "--gtest_brief=1"});
      jobs[job] =
          std::make_unique<SuiteChild>(command, of_job(job, "jsonl"), of_job(job, "log"), request_.limits);
    };
    for (std::size_t job = 0; job < jobs.size(); ++job) start(job);
    std::vector<ChildRun> ended;
    for (std::size_t running = jobs.size(); running > 0;) {
      for (std::size_t job = 0; job < jobs.size(); ++job) {
        if (!jobs[job]) continue;
        if (!jobs[job]->look(kLook / static_cast<double>(running), {},
                             [this](const json& event) { note(event); }))
          continue;
        ChildRun run = jobs[job]->run();
        jobs[job].reset();
        --running;
        append_to_log(of_job(job, "log"));
        throw_if_it_cannot_write(run);
        sequences_.push_back(run.finished);
        if (interrupted) {
          run.in_flight.clear();
        } else if (!run.complete && (!run.finished.empty() || !run.in_flight.empty()) &&
                   !claims.all_taken()) {
          start(job);
          ++running;
        }
        ended.push_back(std::move(run));
      }
    }
    return ended;
  }

  // Takes in what a process of run_side_by_side reports.
  void note(const json& event) {
    const std::string kind = event.value("event", "");
    if (kind == "start") {
      progress_({"test", records_.size(), request_.tests.size(), event.value("name", "")});
    } else if (kind == "result") {
      records_[event["record"]["name"]] = event["record"];
    }
    if (kind != "end") append_to_records(event);
  }

  void append_to_records(const json& event) const {
    std::ofstream file(records_file_, std::ios::app);
    file << event.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
    if (!file.flush())
      throw CannotWrite(fmt::format("cannot write '{}': {}", records_file_.string(), std::strerror(errno)));
  }

  void append_to_log(const fs::path& part) const {
    std::ifstream from(part, std::ios::binary);
    if (from && from.peek() != std::ifstream::traits_type::eof())
      std::ofstream(file("log", "txt"), std::ios::app | std::ios::binary) << from.rdbuf();
    fs::remove(part);
  }

  const json& test(const std::string& name) const {
    for (const json& test : request_.tests)
      if (as_text(test["name"]) == name) return test;
    throw std::logic_error("unknown test " + name);
  }

  void add_record(const std::string& name, const std::string& verdict, const std::string& message,
                  const json& last_case) {
    json record = {{"name", name},
                   {"requirements", test(name)["requirements"]},
                   {"level", test(name)["level"]},
                   {"verdict", verdict},
                   {"message", message},
                   {"expected_by_baseline", false},
                   {"baseline_reason", ""},
                   {"failures", json::array()}};
    if (last_case.is_object()) {
      record["calls"] = last_case["calls"];
      record["failures"].push_back(
          {{"case", last_case["case"]}, {"message", message}, {"calls", last_case["calls"]}});
    }
    // The file of records is complete without the result file: append what the child could not.
    append_to_records({{"event", "result"}, {"record", record}});
    records_[name] = std::move(record);
  }

  // Those children that died in a test. Alone in a new child, with its cases traced, it shows the calls;
  // where it passes alone, the tests before it are cut down to those that matter.
  void record_deaths(const std::vector<ChildRun>& ended) {
    std::vector<const ChildRun*> dead;
    for (const ChildRun& child : ended)
      if (!child.in_flight.empty()) dead.push_back(&child);
    const auto jobs = static_cast<std::size_t>(request_.jobs);
    for (std::size_t begin = 0; begin < dead.size(); begin += jobs) {
      const std::size_t end = std::min(begin + jobs, dead.size());
      std::vector<std::string> names;
      for (std::size_t i = begin; i < end; ++i) names.push_back(dead[i]->in_flight);
      progress_({"confirming", records_.size(), request_.tests.size(), names.front()});
      const std::vector<ChildRun> alone =
          interrupted ? std::vector<ChildRun>(names.size()) : run_alone(names, true);
      for (std::size_t i = begin; i < end; ++i) record_death(*dead[i], alone[i - begin]);
    }
  }

  void record_death(const ChildRun& child, const ChildRun& alone) {
    const std::string name = child.in_flight;
    const std::string verdict = child.hung ? "timeout" : "crash";
    const std::string how = describe(child, request_.limits);
    if (interrupted) {
      add_record(name, verdict, how + "; not confirmed, the run was interrupted", nullptr);
      return;
    }
    const std::string last_case = alone.last_case.is_object() ? alone.last_case.value("case", "") : "";
    if (!alone.in_flight.empty() && is_control(last_case)) {
      add_record(name, "not-observable", fmt::format("pipeline: {} in '{}'", how, last_case), nullptr);
      return;
    }
    if (!alone.in_flight.empty()) {
      add_record(name, verdict, how + "; confirmed alone in a new process", alone.last_case);
      return;
    }
    const auto result = alone.records.find(name);
    const std::string again = result == alone.records.end() ? "" : result->second.value("verdict", "");
    add_record(name, verdict, how + (again == "fail" ? "; fails alone" : "; passes alone"), nullptr);
    add_history(records_[name], child.finished);
    if (records_[name].contains("flake") && !again.empty())
      records_[name]["again"] = {{"verdict", again}, {"message", result->second.value("message", "")}};
  }

  // --- what does not come out the same ---------------------------------------------------------------------

  // What a process made of the test alone, where that is not what the record says: its verdict and message.
  // Null where it is the same, or where nothing came of it.
  json other_outcome(const json& record, const ChildRun& again) const {
    const std::string name = record["name"];
    if (again.in_flight == name)
      return {{"verdict", again.hung ? "timeout" : "crash"}, {"message", describe(again, request_.limits)}};
    const auto found = again.records.find(name);
    if (found == again.records.end()) return nullptr;
    const json& other = found->second;
    if (other["verdict"] == record["verdict"] && mismatches_of(other) == mismatches_of(record))
      return nullptr;
    return {{"verdict", other["verdict"]}, {"message", other.value("message", "")}};
  }

  // Fails that the baseline does not know, once more. (Deaths have been.)
  void play_failures_again(json& result) {
    std::vector<std::string> names;
    for (const json& test : request_.tests) {
      const auto found = records_.find(test["name"]);
      if (found != records_.end() && as_text(found->second["verdict"]) == "fail" &&
          !baseline_.knows(found->second, request_.depth, request_.seed))
        names.push_back(test["name"]);
    }
    if (request_.retries > 0 && names.size() > kMostPlayedAgain) {
      result["not_played_again"] = names.size() - kMostPlayedAgain;
      names.resize(kMostPlayedAgain);
    }
    for (int round = 0; round < request_.retries; ++round) {
      std::vector<std::string> same;
      const auto jobs = static_cast<std::size_t>(request_.jobs);
      for (std::size_t begin = 0; begin < names.size() && !interrupted; begin += jobs) {
        const std::vector<std::string> some(
            names.begin() + static_cast<std::ptrdiff_t>(begin),
            names.begin() + static_cast<std::ptrdiff_t>(std::min(begin + jobs, names.size())));
        progress_({"playing again", begin, names.size(), some.front()});
        const std::vector<ChildRun> runs = run_alone(some, false);
        for (std::size_t i = 0; i < some.size() && !interrupted; ++i) {
          const json other = other_outcome(records_[some[i]], runs[i]);
          if (other.is_null())
            same.push_back(some[i]);
          else
            explain_difference(records_[some[i]], other);
        }
      }
      names = std::move(same);
    }
  }

  // A failure that did not come out the same alone: it needs other tests before it, or it is a flake.
  void explain_difference(json& record, const json& again) {
    const json before = record;
    progress_({"searching a history", records_.size(), request_.tests.size(), record["name"]});
    add_history(record, predecessors_of(record["name"]));
    if (record.contains("history") && !record["history"].empty()) return;
    record = before;
    record["flake"] = true;
    record["again"] = again;
    record["message"] =
        fmt::format("{}; a flake: played again, alone in a new process, its verdict is {}",
                    record["message"].get<std::string>(), again["verdict"].get<std::string>());
  }

  // --- what a failure depends on -------------------------------------------------------------------------

  static bool is_death(const json& record) {
    return as_text(record["verdict"]) == "crash" || as_text(record["verdict"]) == "timeout";
  }
  static bool is_bad(const json& record) { return as_text(record["verdict"]) == "fail" || is_death(record); }

  // Sorted (as the suite program writes them), each as often as it occurred.
  static std::vector<std::string> mismatches_of(const json& record) {
    return record.value("mismatches", std::vector<std::string>());
  }

  // Whether the test failed in the same way in the pass with fresh contexts, with all that is wrong here.
  bool is_no_news(const json& record) const {
    if (!second_pass()) return false;
    for (const json& fresh : (*request_.first_pass)["tests"]) {
      if (fresh["name"] != record["name"]) continue;
      const std::vector<std::string> before = mismatches_of(fresh), now = mismatches_of(record);
      return fresh["verdict"] == record["verdict"] &&
             std::includes(before.begin(), before.end(), now.begin(), now.end());
    }
    return false;
  }

  // Second pass: marks what fails with fresh contexts as well, and looks for the history of the rest.
  void explain_by_history() {
    for (const json& test : request_.tests) {
      const auto found = records_.find(test["name"]);
      if (interrupted || found == records_.end()) continue;
      json& record = found->second;
      if (!is_bad(record) || searched_.count(record["name"])) continue;
      if (is_no_news(record)) {
        record["also_in_fresh_context"] = true;
        record["expected_by_baseline"] = true;
        record["baseline_reason"] = "fails in a fresh context as well";
        continue;
      }
      if (baseline_.knows(record, request_.depth, request_.seed)) continue;
      progress_({"searching a history", records_.size(), request_.tests.size(), record["name"]});
      add_history(record, predecessors_of(record["name"]));
    }
  }

  // The tests that ran before it in the same process.
  std::vector<std::string> predecessors_of(const std::string& name) const {
    for (const std::vector<std::string>& sequence : sequences_) {
      const auto position = std::find(sequence.begin(), sequence.end(), name);
      if (position != sequence.end()) return {sequence.begin(), position};
    }
    return {};
  }

  // Whether the same happens to the test when it comes after these; empty where time runs out first.
  std::optional<bool> happens_again(const json& record, std::vector<std::string> tests) {
    const std::string name = record["name"];
    tests.push_back(name);
    const ChildRun child = run_scratch(tests, false);
    if (child.cut_short || interrupted) return std::nullopt;
    if (is_death(record)) return child.in_flight == name;
    const auto again = child.records.find(name);
    return again != child.records.end() && is_bad(again->second) && !is_no_news(again->second);
  }

  // Finds the shortest history in new processes and puts it into the record.
  void add_history(json& record, const std::vector<std::string>& predecessors) {
    const auto begin = Clock::now();
    searched_.insert(record["name"]);
    double seconds = std::min(kSearchBudget, searches_left_);
    if (as_text(record["verdict"]) == "timeout")
      seconds += 4 * request_.limits.seconds_per_test;  // to see it hang again
    deadline_ = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::optional<bool> alone = happens_again(record, {});
    History history;
    if (alone && *alone) {
      history.found = History::Found::shortest;
    } else if (alone) {
      const bool guess_applies = std::all_of(guess_.begin(), guess_.end(), [&](const std::string& test) {
        return std::find(predecessors.begin(), predecessors.end(), test) != predecessors.end();
      });
      history = shortest_history(
          predecessors, guess_applies ? guess_ : std::vector<std::string>(),
          [&](const std::vector<std::string>& tests) { return happens_again(record, tests); });
    }
    std::string only_case;
    if (history.tests.size() == 1) only_case = case_of_history(record, history.tests[0]);
    deadline_.reset();
    searches_left_ = std::max(searches_left_ - seconds_since(begin), 0.0);
    if (!history.tests.empty()) guess_ = history.tests;
    record["message"] = words_for(history, only_case, predecessors.size(), record["message"]);
    if (history.found == History::Found::shortest || history.found == History::Found::shortened)
      record["history"] = history.tests;
    else
      record["flake"] = true;
    if (!only_case.empty()) record["history_case"] = only_case;
  }

  // Of the one test that has to come before: the case without which (and those after it) it does not happen.
  std::string case_of_history(const json& record, const std::string& test) {
    const ChildRun traced = run_scratch({test, record["name"]}, true);
    const auto cases = traced.cases.find(test);
    if (traced.cut_short || interrupted || cases == traced.cases.end()) return {};
    const auto enough = least(cases->second.size(), [&](std::size_t count) {
      return happens_again(record, {fmt::format("{}\t{}", test, count)});
    });
    return enough ? cases->second[*enough - 1] : std::string();
  }

  static std::string words_for(const History& history, const std::string& only_case, std::size_t predecessors,
                               const std::string& message) {
    switch (history.found) {
      case History::Found::not_reproduced:
        return fmt::format(
            "{}; not reproduced, neither alone nor after the same {} tests: it does not always happen",
            message, predecessors);
      case History::Found::out_of_time:
        return message + "; what it depends on was not found in the time given";
      case History::Found::shortest:
      case History::Found::shortened:
        break;
    }
    std::string after = "its own earlier cases";
    if (history.tests.size() > 3) {
      after = fmt::format("{} tests, {} to {}", history.tests.size(), history.tests.front(),
                          history.tests.back());
    } else if (!history.tests.empty()) {
      after = fmt::format("{}", fmt::join(history.tests, ", "));
    }
    if (!only_case.empty()) after += fmt::format(" up to its case '{}'", only_case);
    if (history.found == History::Found::shortened) after += " (perhaps fewer: time ran out)";
    return fmt::format("after {}: {}", after, message);
  }

  // --- the end -------------------------------------------------------------------------------------------

  json finish(json& result, const std::string& status) {
    result["status"] = status;
    json summary = json::object();
    std::map<std::string, std::set<std::string>> readings;
    result["tests"] = json::array();
    for (const json& test : request_.tests) {
      const auto found = records_.find(test["name"]);
      if (found == records_.end()) continue;
      const std::string verdict = found->second["verdict"];
      summary[verdict] = summary.value(verdict, 0) + 1;
      if (verdict == "fail" || verdict == "crash" || verdict == "timeout") add_commands(found->second);
      const json followed = found->second.value("readings", json::object());
      for (const auto& [text, reading] : followed.items()) readings[text].insert(reading.get<std::string>());
      result["tests"].push_back(found->second);
    }
    result["summary"] = summary;
    if (!readings.empty()) result["readings"] = readings;
    fs::remove_all(scratch_);
    try {
      write_atomically(file("results", "json"), to_text(result));
    } catch (const CannotWrite& error) {
      if (records_.empty()) throw;
      throw CannotWrite(fmt::format("{}; what {} has shown until then is in {}", error.what(), request_.name,
                                    file("records", "jsonl").filename().string()));
    }
    return result;
  }

  const RunRequest& request_;
  const std::function<void(const Progress&)>& progress_;
  const fs::path scratch_;  // folder for what goes between the runner and its children
  std::vector<std::string> captures_;
  std::map<std::string, json> records_;
  fs::path records_file_;
  Baseline baseline_;
  std::vector<std::vector<std::string>> sequences_;  // the tests that each child finished, in order
  SuiteChild::Deadline deadline_;                    // of the search in progress
  double searches_left_ = kSearchesBudget;
  std::set<std::string> searched_;  // tests whose history was looked for
  std::vector<std::string> guess_;  // the latest history: what one test does to the next, it does to others
};

}  // namespace

std::string file_label(const std::string& name, const std::string& shard, const std::string& pass) {
  std::string label = name;
  for (const std::string& part : {shard, pass})
    if (!part.empty()) label += "." + part;
  return label;
}

json run_implementation(const RunRequest& request, const std::function<void(const Progress&)>& progress) {
  return Run(request, progress).run();
}

json list_tests(const fs::path& suite_program) {
  char name[] = "/tmp/evalcts-tests-XXXXXX";
  const int descriptor = mkstemp(name);
  if (descriptor < 0) throw std::runtime_error("cannot make a temporary file");
  close(descriptor);
  std::optional<Ending> ending;
  {
    ChildProcess child({suite_program.string(), "--list", "--answer", name}, "");
    for (int i = 0; i < 600 && !ending; ++i) ending = child.wait(0.1);
  }
  std::ifstream stream(name);
  json tests = json::parse(stream, nullptr, false);
  fs::remove(name);
  if (!ending || ending->signalled || ending->value != 0 || !tests.is_object())
    throw std::runtime_error(fmt::format("{} does not list its tests ({})", suite_program.string(),
                                         ending ? describe(*ending) : "no answer"));
  return tests;
}

std::string to_text(const json& result) {
  return result.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

void write_atomically(const fs::path& path, const std::string& content) {
  const fs::path temporary = path.string() + ".new";
  const auto fail = [&](const char* what) {
    const int error = errno;
    fs::remove(temporary);
    throw CannotWrite(fmt::format("cannot {} '{}': {}", what, path.string(), std::strerror(error)));
  };
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail("create");
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written < 0) {
      if (errno == EINTR) continue;
      close(descriptor);
      fail("write");
    }
    done += static_cast<std::size_t>(written);
  }
  if (fsync(descriptor) != 0 || close(descriptor) != 0) fail("write");
  if (rename(temporary.c_str(), path.c_str()) != 0) fail("replace");
}

}  // namespace evalcts
