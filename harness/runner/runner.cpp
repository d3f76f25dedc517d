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
#include <optional>
#include <thread>

#include "harness/runner/child_process.h"

namespace evalcts {

std::atomic<bool> interrupted = false;

namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLook = 0.02;           // seconds between two looks at a child
constexpr double kStartTimeout = 60;     // for the questions that each library is asked first
constexpr double kBisectionBudget = 30;  // seconds spent on finding what a crash depends on
constexpr int kMostEmptyStarts = 2;      // children that end without having begun a test

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

// The growing file of events of one child: each complete line once.
class EventReader {
 public:
  explicit EventReader(fs::path path) : path_(std::move(path)) {}

  std::vector<json> next() {
    std::vector<json> events;
    std::ifstream file(path_, std::ios::binary);
    if (!file) return events;
    file.seekg(offset_);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
      json event = json::parse(text.substr(begin, end - begin), nullptr, false);
      if (event.is_object()) events.push_back(std::move(event));
    }
    offset_ += static_cast<std::streamoff>(begin);
    return events;
  }

 private:
  fs::path path_;
  std::streamoff offset_ = 0;
};

// What one child made of a list of tests.
struct ChildRun {
  std::map<std::string, json> records;
  std::vector<std::string> finished;  // in the order in which they ran
  std::string in_flight;              // the test that the child died in
  json last_case;                     // of that test, where cases were traced
  bool hung = false;
  bool complete = false;
  Ending ending;
};

class Run {
 public:
  Run(const RunRequest& request, const std::function<void(const Progress&)>& progress)
      : request_(request), progress_(progress) {}

  json run() {
    remove_stale_files();
    json result = header();
    progress_({"starting", 0, request_.tests.size(), ""});
    if (!start(result)) return finish(result, "not-started");
    run_tests();
    return finish(result, interrupted ? "interrupted" : "complete");
  }

 private:
  fs::path file(const std::string& kind, const std::string& extension) const {
    return request_.output / fmt::format("{}-{}.{}", kind, request_.name, extension);
  }

  void remove_stale_files() const {
    for (const auto& [kind, extension] : {std::pair{"results", "json"},
                                          {"records", "jsonl"},
                                          {"junit", "xml"},
                                          {"log", "txt"},
                                          {"scratch", "jsonl"},
                                          {"scratch", "txt"},
                                          {"scratch", "json"}})
      fs::remove(file(kind, extension));
  }

  json header() const {
    return {{"format", "evalcts-results-1"},
            {"evalcts_version", EVALCTS_VERSION},
            {"command", request_.command},
            {"depth", request_.depth},
            {"seed", request_.seed},
            {"timeout", request_.seconds_per_test},
            {"suite_command", suite_command()},
            {"reason", ""},
            {"implementation", {{"name", request_.name}, {"machine", machine()}}}};
  }

  // What is judged and how, in options that `evalcts run` and the suite program share.
  std::vector<std::string> shared_options() const {
    std::vector<std::string> options = {"--depth", request_.depth, "--seed", std::to_string(request_.seed)};
    if (!request_.implementation.name.empty())
      options.insert(options.end(), {"--implementation", request_.implementation.name});
    if (!request_.implementation.library.empty())
      options.insert(options.end(), {"--library", request_.implementation.library});
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
    const std::string usual_name =
        request_.implementation.name.empty() ? "library" : request_.implementation.name;
    std::vector<std::string> rerun = shared_options();
    rerun.insert(rerun.begin(), {request_.program, "run"});
    if (request_.name != usual_name) rerun.insert(rerun.end(), {"--name", request_.name});
    rerun.insert(rerun.end(), {"--filter", name});
    record["rerun"] = shell_line(rerun);

    std::vector<std::string> debug = suite_command();
    debug.insert(debug.begin(), {"gdb", "--args"});
    std::string filter = name;
    std::replace(filter.begin(), filter.end(), '-', '?');  // GoogleTest takes what follows '-' as negative
    debug.push_back("--gtest_filter=" + filter);
    record["debug"] = shell_line(debug);

    std::vector<std::string> reproduce = {request_.program, "reproduce", request_.name + ":" + name};
    if (request_.own_output)
      reproduce.insert(reproduce.end(), {"--results", fs::absolute(request_.output).string()});
    record["reproducer"] = shell_line(reproduce);
  }

  // Asks a child of its own one question. An empty answer comes with a reason.
  json ask(const std::vector<std::string>& question, std::string& reason) const {
    const fs::path answer_file = file("scratch", "json");
    fs::remove(answer_file);
    std::vector<std::string> command = suite_command();
    command.push_back("--die-with-parent");
    command.insert(command.end(), question.begin(), question.end());
    command.insert(command.end(), {"--answer", answer_file.string()});
    ChildProcess child(command, file("log", "txt").string());
    std::optional<Ending> ending;
    const auto begin = Clock::now();
    while (!(ending = child.wait(kLook)) && !interrupted && seconds_since(begin) < kStartTimeout) continue;
    if (!ending) {
      child.kill();
      reason = interrupted ? "interrupted" : fmt::format("no answer within {} seconds", kStartTimeout);
      return nullptr;
    }
    std::ifstream stream(answer_file);
    json answer = json::parse(stream, nullptr, false);
    stream.close();
    fs::remove(answer_file);
    if (answer.is_object() && answer.contains("cannot_start")) {
      reason = answer["cannot_start"];
      return nullptr;
    }
    if (ending->signalled || ending->value != 0 || !answer.is_object()) {
      reason =
          fmt::format("it ended with {}; see {}", describe(*ending), file("log", "txt").filename().string());
      return nullptr;
    }
    return answer;
  }

  bool start(json& result) {
    std::string reason;
    const json description = ask({"--describe"}, reason);
    if (description.is_null()) {
      result["reason"] = reason;
      return false;
    }
    json& implementation = result["implementation"];
    for (const char* member : {"library", "vendor", "renderer", "version", "max_eval_order"})
      implementation[member] = description[member];
    implementation["captures"] = json::array();
    for (const std::string name : description["all_captures"]) {
      std::string why;
      json capture = ask({"--prove", name}, why);
      if (capture.is_null()) capture = {{"name", name}, {"available", false}, {"reason", why}};
      if (capture["available"].get<bool>()) captures_.push_back(name);
      implementation["captures"].push_back(capture);
    }
    return !interrupted || (result["reason"] = "interrupted", false);
  }

  // --- running tests -------------------------------------------------------------------------------------

  ChildRun run_child(const std::vector<std::string>& tests, const fs::path& events, bool trace_cases,
                     bool report_progress) {
    const fs::path list = file("scratch", "txt");
    {
      std::ofstream stream(list);
      for (const std::string& test : tests) stream << test << '\n';
      if (!stream.flush()) throw std::runtime_error(fmt::format("cannot write {}", list.string()));
    }
    std::vector<std::string> command = suite_command();
    command.insert(command.end(),
                   {"--die-with-parent", "--tests", list.string(), "--records", events.string(), "--captures",
                    captures_.empty() ? "none" : fmt::format("{}", fmt::join(captures_, ","))});
    if (trace_cases) command.push_back("--trace-cases");

    ChildRun result;
    EventReader reader(events);
    if (&events == &records_file_) reader = std::move(*main_reader_);
    ChildProcess child(command, file("log", "txt").string());
    auto begun = Clock::now();
    std::optional<Ending> ending;
    while (true) {
      ending = child.wait(kLook);
      for (const json& event : reader.next()) {
        take(event, result, report_progress);
        begun = Clock::now();
      }
      if (ending) break;
      if (interrupted) {
        child.kill();
        continue;
      }
      if (seconds_since(begun) > request_.seconds_per_test) {
        result.hung = true;
        child.kill();
      }
    }
    result.ending = *ending;
    if (&events == &records_file_) main_reader_ = std::move(reader);
    return result;
  }

  void take(const json& event, ChildRun& result, bool report_progress) {
    const std::string kind = event.value("event", "");
    if (kind == "start") {
      result.in_flight = event.value("name", "");
      result.last_case = nullptr;
      if (report_progress)
        progress_({"test", records_.size() + result.records.size(), request_.tests.size(), result.in_flight});
    } else if (kind == "case") {
      result.last_case = event;
    } else if (kind == "result") {
      const json& record = event["record"];
      result.finished.push_back(record["name"]);
      result.records[record["name"]] = record;
      result.in_flight.clear();
    } else if (kind == "end") {
      result.complete = true;
    }
  }

  void run_tests() {
    records_file_ = file("records", "jsonl");
    main_reader_.emplace(records_file_);
    int empty_starts = 0;
    while (!interrupted) {
      std::vector<std::string> remaining;
      for (const json& test : request_.tests)
        if (!records_.count(test["name"])) remaining.push_back(test["name"]);
      if (remaining.empty()) return;
      ChildRun child = run_child(remaining, records_file_, false, true);
      records_.merge(child.records);
      if (interrupted) return;
      if (!child.in_flight.empty()) {
        record_death(child);
      } else if (!child.complete && child.finished.empty() && ++empty_starts >= kMostEmptyStarts) {
        for (const std::string& name : remaining)
          add_record(name, child.hung ? "timeout" : "crash",
                     fmt::format("the process ended with {} before its first test", describe(child.ending)),
                     nullptr);
        return;
      }
    }
  }

  const json& test(const std::string& name) const {
    for (const json& test : request_.tests)
      if (test["name"] == name) return test;
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
    std::ofstream(records_file_, std::ios::app)
        << json{{"event", "result"}, {"record", record}}.dump(-1, ' ', false, json::error_handler_t::replace)
        << '\n';
    main_reader_->next();
    records_[name] = std::move(record);
  }

  // The child died in a test. Alone in a new child, with its cases traced, it shows the calls; where it
  // passes alone, the tests before it are cut down to those that matter.
  void record_death(const ChildRun& child) {
    const std::string name = child.in_flight;
    progress_({"confirming", records_.size(), request_.tests.size(), name});
    const std::string verdict = child.hung ? "timeout" : "crash";
    const std::string how = child.hung ? fmt::format("no answer within {} seconds", request_.seconds_per_test)
                                       : "the process ended with " + describe(child.ending);
    const ChildRun alone = run_scratch({name}, true);
    if (interrupted) return;
    if (!alone.in_flight.empty()) {
      add_record(name, verdict, how + "; confirmed alone in a new process", alone.last_case);
      return;
    }
    add_record(name, verdict, how + "; " + what_it_depends_on(child.finished, name), nullptr);
  }

  ChildRun run_scratch(const std::vector<std::string>& tests, bool trace_cases) {
    const fs::path events = file("scratch", "jsonl");
    fs::remove(events);
    ChildRun result = run_child(tests, events, trace_cases, false);
    fs::remove(events);
    return result;
  }

  std::string what_it_depends_on(const std::vector<std::string>& predecessors, const std::string& name) {
    const auto begin = Clock::now();
    const auto dies_after = [&](std::size_t count) {
      std::vector<std::string> tests(predecessors.end() - static_cast<std::ptrdiff_t>(count),
                                     predecessors.end());
      tests.push_back(name);
      return run_scratch(tests, false).in_flight == name;
    };
    // The shortest run of predecessors that still shows it: doubled until it does, then halved.
    std::size_t fails = 0;  // too short
    std::size_t count = 1;
    while (true) {
      if (interrupted || seconds_since(begin) > kBisectionBudget || predecessors.empty())
        return "passes alone, and what it depends on was not found";
      count = std::min(count, predecessors.size());
      if (dies_after(count)) break;
      if (count == predecessors.size())
        return "passes alone and after the same tests: it does not always happen";
      fails = count;
      count *= 2;
    }
    while (count - fails > 1 && !interrupted && seconds_since(begin) <= kBisectionBudget) {
      const std::size_t middle = fails + (count - fails) / 2;
      (dies_after(middle) ? count : fails) = middle;
    }
    const std::vector<std::string> needed(predecessors.end() - static_cast<std::ptrdiff_t>(count),
                                          predecessors.end());
    if (needed.size() <= 3) return fmt::format("passes alone, dies after {}", fmt::join(needed, ", "));
    return fmt::format("passes alone, dies after the {} tests from {} to {}", needed.size(), needed.front(),
                       needed.back());
  }

  // --- the end -------------------------------------------------------------------------------------------

  json finish(json& result, const std::string& status) {
    result["status"] = status;
    json summary = json::object();
    result["tests"] = json::array();
    for (const json& test : request_.tests) {
      const auto found = records_.find(test["name"]);
      if (found == records_.end()) continue;
      const std::string verdict = found->second["verdict"];
      summary[verdict] = summary.value(verdict, 0) + 1;
      if (verdict == "fail" || verdict == "crash" || verdict == "timeout") add_commands(found->second);
      result["tests"].push_back(found->second);
    }
    result["summary"] = summary;
    for (const auto& [kind, extension] :
         {std::pair{"scratch", "jsonl"}, {"scratch", "txt"}, {"scratch", "json"}})
      fs::remove(file(kind, extension));
    write_atomically(file("results", "json"), to_text(result));
    return result;
  }

  const RunRequest& request_;
  const std::function<void(const Progress&)>& progress_;
  std::vector<std::string> captures_;
  std::map<std::string, json> records_;
  fs::path records_file_;
  std::optional<EventReader> main_reader_;
};

}  // namespace

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
    throw std::runtime_error(fmt::format("cannot {} '{}': {}", what, path.string(), std::strerror(error)));
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
