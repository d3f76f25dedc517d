// Implements the header of a result and the shell commands that repeat parts of a run.
#include "request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <system_error>
#include <thread>

#include <evalcts/results/text.h>

namespace evalcts {
namespace {

namespace fs = std::filesystem;

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

std::string host() {
  utsname names{};
  uname(&names);
  return clean(names.nodename);
}

// Returns the time in UTC.
std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

// Returns `path` relative to the working directory if it lies below it, otherwise the absolute path. Used in
// commands that the user is meant to paste.
std::string seen_from_here(const fs::path& path) {
  std::error_code unknown;
  const fs::path near = fs::proximate(path, unknown);
  if (unknown || near.empty() || near.is_absolute() || *near.begin() == "..")
    return fs::absolute(path).string();
  return near.has_parent_path() ? near.string() : (fs::path(".") / near).string();
}

// Options that `evalcts run` and the suite program share.
std::vector<std::string> shared_options(const RunRequest& request) {
  std::vector<std::string> options = {"--depth", name_of(request.depth), "--seed",
                                      std::to_string(request.seed)};
  const std::vector<std::string> chosen = request.implementation.words();
  options.insert(options.end(), chosen.begin(), chosen.end());
  for (const std::string& reading : request.readings)
    options.insert(options.end(), {"--interpretation", reading});
  return options;
}

}  // namespace

RunResult header_of(const RunRequest& request) {
  RunResult header;
  header.evalcts_version = EVALCTS_VERSION;
  header.command = request.command;
  header.started = now();
  header.host = host();
  header.depth = request.depth;
  header.filter = request.filter;
  header.seed = request.seed;
  header.timeout = request.limits.seconds_per_test;
  header.memory = request.limits.memory >> 20;
  header.suite_command = suite_command(request);
  header.pass = request.is_second_pass() ? Pass::kReuseContext : Pass::kFreshContexts;
  header.shard = request.shard;
  header.implementation.name = request.name;
  header.implementation.machine = machine();
  return header;
}

std::vector<std::string> suite_command(const RunRequest& request) {
  std::vector<std::string> command = shared_options(request);
  command.insert(command.begin(), request.suite_program.string());
  command.insert(command.end(), request.more_options.begin(), request.more_options.end());
  return command;
}

std::vector<std::string> captures_option(const ImplementationRecord& implementation) {
  std::vector<std::string> names;
  for (const CaptureRecord& capture : implementation.captures)
    if (capture.available) names.push_back(capture.name);
  return {"--captures", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ","))};
}

std::string why_other_suite(const std::vector<ListedTest>& tests, const Description& description) {
  const std::string own = suite_id(tests);
  if (description.suite == own) return {};
  return fmt::format("the worker is evalcts {}, this is {}; build both from the same sources",
                     description.suite, own);
}

void add_commands(const RunRequest& request, TestRecord& record) {
  // A failure that depends on earlier tests needs them, too.
  std::string filter = record.name;
  for (const std::string& before : record.history.value_or(std::vector<std::string>()))
    filter += ":" + before;
  std::vector<std::string> rerun = shared_options(request);
  const bool is_recorded = !request.recording.empty();
  const auto frame = [](const std::string& test) {  // "Recording.Frame12/3"
    const std::size_t begin = test.rfind("Frame") + 5;
    return test.substr(begin, test.find('/') - begin);
  };
  if (is_recorded) rerun.erase(rerun.begin(), rerun.begin() + 4);  // depth and seed
  rerun.insert(rerun.begin(), {request.program, is_recorded ? "check" : "run"});
  if (is_recorded) rerun.insert(rerun.begin() + 2, request.recording);
  if (request.name != request.implementation.label()) rerun.insert(rerun.end(), {"--name", request.name});
  if (request.is_second_pass()) rerun.push_back("--reuse-context");
  const Limits& limits = request.limits;
  if (limits.seconds_per_test != Limits().seconds_per_test)
    rerun.insert(rerun.end(), {"--timeout", fmt::format("{}", limits.seconds_per_test)});
  if (limits.memory != Limits().memory)
    rerun.insert(rerun.end(), {"--memory", std::to_string(limits.memory >> 20)});
  // Processes that share the tests would separate the test from its history.
  if (record.history && !request.is_second_pass()) rerun.insert(rerun.end(), {"--jobs", "1"});
  if (is_recorded)
    rerun.insert(rerun.end(), {"--frames", frame(record.name)});
  else
    rerun.insert(rerun.end(), {"--filter", filter});
  record.rerun = shell_line(rerun);

  const std::string& worker = request.implementation.worker;
  std::vector<std::string> debug = suite_command(request);
  debug.front() = seen_from_here(debug.front());
  debug.insert(debug.begin(), {"gdb", "--args"});
  if (request.is_second_pass()) debug.push_back("--reuse-context");
  std::replace(filter.begin(), filter.end(), '-', '?');  // in GoogleTest's filters, '-' starts exclusions
  debug.push_back("--gtest_filter=" + filter);
  if (worker.empty()) record.debug = shell_line(debug);

  if (request.is_second_pass()) return;  // a C program contains only one case, without its history
  std::vector<std::string> reproduce = {request.program, "reproduce", request.name + ":" + record.name};
  reproduce.insert(reproduce.end(),
                   {"--run", request.run.empty() ? seen_from_here(request.output) : request.run});
  if (!worker.empty()) reproduce.insert(reproduce.end(), {"--worker", worker});
  record.reproducer = shell_line(reproduce);
}

}  // namespace evalcts
