// Implements the suite program: as a worker it runs jobs; otherwise it registers each test with GoogleTest.
#include <evalcts/suite/suite_main.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <evalcts/backends/mesa_build.h>
#include <evalcts/capture/observed_values.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/reduction.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/roles.h>
#include <evalcts/record/programs.h>
#include <evalcts/results/event_file.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/job_reader.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/worker.h>
#include "crash_report.h"
#include "process.h"
#include "session.h"
#include "watchdog.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

constexpr int kCannotStart = 2;  // exit status for wrong use, or an implementation that does not start
constexpr char kStandardOutput[] = "-";

struct Options {
  SessionOptions session;
  std::string depth = "full", events, programs;
  bool is_worker = false;         // runs jobs
  std::uint64_t most_growth = 0;  // MiB; 0: no limit
  double most_seconds = 0;        // between two events of a job; 0: no limit
};

// Adapts a test to GoogleTest: a failure fails, and a test that was not judged is skipped with the reason.
class GoogleTestAdapter : public testing::Test {
 public:
  GoogleTestAdapter(const TestInfo& info, Session& session) : info_(info), session_(session) {}

  void TestBody() override {
    const TestRecord record = session_.run_test(info_);
    switch (record.verdict) {
      case Verdict::kPass:
        return;
      case Verdict::kQualityWarning:
        std::cout << "quality-warning: " << record.message << "\n";
        return;
      case Verdict::kNotSupported:
      case Verdict::kNotObservable:
      case Verdict::kSkipped:
        GTEST_SKIP() << text_of(record.verdict).word << ": " << record.message;
      default:
        break;
    }
    std::string text = fmt::format("{}: {} of {} cases; {}", text_of(record.verdict).word,
                                   record.failed_cases.value_or(0), record.cases.value_or(0), record.message);
    if (!record.failures.empty()) {
      const Failure& failure = record.failures.front();
      text += fmt::format("\n  expected {}\n  captured {}\n  case {}", failure.expected, failure.captured,
                          failure.case_identity);
      for (const std::string& call : failure.calls) text += "\n    " + call;
    }
    ADD_FAILURE() << text;
  }

 private:
  const TestInfo& info_;
  Session& session_;
};

// Makes the programs of a recording the tests of this process. Commands that the implementation does not
// provide are left out of them, and MultiTexCoord of units that it does not have, which is undefined (GL 1.3
// 2.7).
void use_programs(const std::string& file) {
  std::vector<TestInfo> tests;
  for (record::Program& program : record::read_programs(file)) {
    TestInfo info{"Recording", std::move(program.name), {"EV-COORD-ASIF"}, Level::kMust, {}};
    info.body = [commands = std::move(program.commands)](Test& t) {
      const gl::Case recorded = gl::parse_case(commands);
      gl::Case script("recorded commands");
      for (const gl::Command& command : recorded.commands()) {
        const bool has_unit = gl::stem_of(command.entry) != "MultiTexCoord" ||
                              gl::integer_of(command, 0) < GL_TEXTURE0 + t.texture_units();
        if (has_unit && t.can_call(command.entry)) script.add(command);
      }
      t.judge(script);
    };
    tests.push_back(std::move(info));
  }
  replace_tests(std::move(tests));
}

// Starts the program again with the environment for a Mesa that is not the system's, unless that was done. If
// the folder has no Mesa, the session says so later, when events can be written.
void start_with_mesa_build(const std::string& folder, char** argv) {
  if (folder.empty() || uses_mesa_build(folder)) return;
  try {
    use_mesa_build(folder);
  } catch (const CannotStart&) {
    return;
  }
  throw CannotStart("cannot start again for --mesa-build: " + start_again(argv));
}

void parse(int argc, char** argv, Options& options) {
  CLI::App app{
      "Judges one implementation of OpenGL evaluators. Options of GoogleTest (--gtest_...) work, too."};
  SessionOptions& session = options.session;
  std::vector<std::string> captures;
  std::string style;
  app.add_option("--implementation", session.implementation.name,
                 "what to judge, see 'evalcts list implementations'");
  app.add_option("--library", session.implementation.library, "shared library instead of the usual one");
  app.add_option("--context", session.implementation.context,
                 "what makes the contexts, instead of an implementation");
  app.add_option("--mesa-build", session.implementation.mesa_build,
                 "folder of a Mesa that was built or installed there, in place of the system's");
  app.add_option("--depth", options.depth, "how many values")
      ->check(CLI::IsMember({"quick", "full", "thorough"}));
  app.add_option("--seed", session.seed, "seed of the random tests");
  auto* const given = app.add_option("--captures", captures, "use only these")->delimiter(',');
  app.add_option("--interpretation", session.readings, "NAME=READING, as for evalcts run")
      ->expected(1)
      ->take_all();
  app.add_option("--programs", options.programs,
                 "file with the programs of a recording, which take the place of the tests");
  auto* const events = app.add_option(
      "--events", options.events,
      "run the jobs that standard input has, a line of JSON each, and write events to this file or pipe, or "
      "to standard output (\"-\"); end when the process that started this one ends. With the only option "
      "--remote, a worker reads its options from standard input");
  app.add_option("--most-growth", options.most_growth,
                 "end after a job if the memory of this process has grown by more than this since the first "
                 "job, in MiB")
      ->needs(events);
  app.add_option("--most-seconds", options.most_seconds,
                 "end if a job reports no event for so long, with the command in flight")
      ->needs(events);
  app.add_option("--reproduce", style, "report the running case as a C program in this style")
      ->needs(events)
      ->check(CLI::IsMember({"short", "full", "piglit"}));
  app.add_option("--leave-out", session.omitted_calls,
                 "a command that crashes, \"glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)\": not run by tests "
                 "that can do without it")
      ->expected(1)
      ->take_all();
  app.add_flag("--reuse-context", session.reuse_context,
               "run all cases on one context, whose state is restored by calls in between");
  app.add_flag("--warm", session.warm,
               "run each test on one context first, and again in fresh contexts if it does not pass");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : kCannotStart);
  }
  if (given->count() > 0) session.captures = captures;
  session.reproduce = gl::c_style_named(style);
  options.is_worker = events->count() > 0;
  session.depth = depth_named(options.depth).value_or(Depth::kFull);
  const ImplementationOptions& implementation = session.implementation;
  if (implementation.name.empty() && implementation.library.empty() && implementation.context.empty())
    session.implementation.name = "reference";
}

// Returns the filter with each '-' in the name of a test replaced by '?', which matches any
// character. Otherwise GoogleTest would read it as the start of exclusions. Other runners pass such
// names as they are listed.
std::string with_names_taken_literally(const std::string& filter) {
  std::set<std::string> names;
  for (const TestInfo& info : all_tests())
    if (const std::string name = info.full_name(); name.find('-') != std::string::npos) names.insert(name);
  std::string taken;
  std::istringstream patterns(filter);
  for (std::string pattern; std::getline(patterns, pattern, ':');) {
    const std::size_t begin = pattern.starts_with("-") ? 1 : 0;
    if (names.contains(pattern.substr(begin)))
      std::replace(pattern.begin() + static_cast<std::ptrdiff_t>(begin), pattern.end(), '-', '?');
    taken += (taken.empty() ? "" : ":") + pattern;
  }
  return taken;
}

// Runs the tests of the depth, and those whose exact names are in the filter, among which GoogleTest chooses.
int run_google_tests(Session& session, Depth depth) {
  const std::string filter = testing::GTEST_FLAG(filter);
  testing::GTEST_FLAG(filter) = with_names_taken_literally(filter);
  for (const TestInfo& info : all_tests())
    if (is_selected(info.listed(), depth, filter))
      testing::RegisterTest(info.suite.c_str(), info.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [&info, &session] { return new GoogleTestAdapter(info, session); });
  if (!testing::GTEST_FLAG(list_tests)) session.open_for_tests();
  const int status = RUN_ALL_TESTS();
  session.close();
  return status;
}

// --- the worker

constexpr auto kReportEvery = std::chrono::milliseconds(500);

class JobLoop {
 public:
  JobLoop(const Options& options, EventFile& events, Session& session)
      : options_(options), events_(events), session_(session) {}

  // Runs the jobs of standard input. Returns the exit code.
  int run() {
    if (options_.most_seconds > 0) end_if_hanging(events_, options_.most_seconds);
    while (const std::optional<std::string> line = jobs_.next()) {
      const std::optional<Job> job = parse_job(*line);
      if (!job) throw std::runtime_error("not a job: " + line->substr(0, 200));
      set_working(true);
      try {
        run_job(*job);
      } catch (const CannotStart& error) {
        report(CannotOpen{error.what()});
        throw;
      }
      report(JobEnded{});
      set_working(false);
      std::cout.flush();
      // Another process continues if this one has grown much, or if the library has closed files.
      if (events_.was_closed() || has_grown()) {
        std::fflush(stdout);
        _exit(0);
      }
    }
    session_.close();
    report(RunEnded{});
    return 0;
  }

 private:
  void report(const Event& event) { events_.write(to_line(event)); }

  // Called after each job. A library may need much memory for its first context.
  bool has_grown() {
    if (options_.most_growth == 0) return false;
    const std::uint64_t now = own_memory();
    if (memory_after_first_job_ == 0) memory_after_first_job_ = now;
    return now > memory_after_first_job_ + (options_.most_growth << 20);
  }

  // Returns the subject of jobs that run many programs.
  const Subject& subject_of_programs() {
    if (!of_programs_) {
      of_programs_ = session_.subject();
      of_programs_->before_case = [this](const gl::Case&) { report_now_and_then(); };
    }
    return *of_programs_;
  }

  void report_now_and_then() {
    const auto now = std::chrono::steady_clock::now();
    if (now - reported_ < kReportEvery) return;
    reported_ = now;
    report(StillRunning{});
  }

  void run_job(const Job& job) {
    if (job.kind == "test") session_.open_for_tests();
    if (job.kind == "case" || job.kind == "observe") session_.subject();
    if (job.kind == "reduce" || job.kind == "prove-bug" || job.kind == "fuzz") subject_of_programs();
    report(JobStarted{job.name});
    if (job.kind == "list") {
      TestsListed listing;
      for (const TestInfo& info : all_tests()) listing.tests.push_back(info.listed());
      report(listing);
    } else if (job.kind == "describe") {
      report(session_.describe());
    } else if (job.kind == "prove") {
      report(session_.prove(job.name));
    } else if (job.kind == "test") {
      if (tests_.empty())  // most processes run no test
        for (const TestInfo& info : all_tests()) tests_[info.full_name()] = &info;
      const auto found = tests_.find(job.name);
      if (found == tests_.end()) throw std::runtime_error("unknown test '" + job.name + "'");
      std::cout << "[ RUN      ] " << job.name << std::endl;  // the log keeps a limited part of each test
      session_.run_test(*found->second, job);
    } else if (job.kind == "case") {
      session_.run_program(job);
    } else if (job.kind == "observe") {
      session_.observe(parse_values_request(job.data));
    } else if (job.kind == "reduce") {
      if (!reduce_) reduce_ = fuzz::case_reducer(subject_of_programs());
      events_.write(fuzz::to_line(reduce_(fuzz::parse_failing_case(job.data))));
    } else if (job.kind == "prove-bug") {
      if (!prove_bug_) prove_bug_ = fuzz::bug_prover(subject_of_programs());
      events_.write(fuzz::to_line(fuzz::Reduction{job.name, prove_bug_(job.name, std::stod(job.data)), ""}));
    } else if (job.kind == "fuzz") {
      if (!judge_random_)
        judge_random_ = fuzz::campaign(subject_of_programs(), [this](const fuzz::CampaignEvent& event) {
          events_.write(fuzz::to_line(event));
        });
      judge_random_(fuzz::parse_random_job(job.data));
    } else {
      throw std::runtime_error("unknown job '" + job.kind + "'");
    }
  }

  const Options& options_;
  EventFile& events_;
  Session& session_;
  std::map<std::string, const TestInfo*> tests_;
  JobReader jobs_;
  std::optional<Subject> of_programs_;
  std::uint64_t memory_after_first_job_ = 0;  // bytes; 0: no job has ended
  std::chrono::steady_clock::time_point reported_;
  // Each is set by the first job of its kind.
  std::function<fuzz::Reduction(const fuzz::FailingCase&)> reduce_;
  std::function<std::optional<fuzz::Finding>(const std::string&, double)> prove_bug_;
  std::function<void(const fuzz::RandomJob&)> judge_random_;
};

// Reads the options of a worker elsewhere from the first line of standard input, and returns them as the
// arguments of the program. They include --programs with a temporary file.
std::vector<std::string> remote_arguments(const std::string& program) {
  std::string line;
  for (char c; read(STDIN_FILENO, &c, 1) == 1 && c != '\n';) line += c;
  std::optional<WorkerOptions> start = parse_worker_options(line);
  if (!start) throw std::runtime_error("the first line of standard input has no options");
  std::vector<std::string> arguments = {program, "--events", kStandardOutput};
  std::ranges::move(start->options, std::back_inserter(arguments));
  if (start->programs.empty()) return arguments;
  const fs::path file = fs::temp_directory_path() / fmt::format("evalcts-programs-{}", getpid());
  write_atomically(file, start->programs);
  arguments.insert(arguments.end(), {"--programs", file.string()});
  return arguments;
}

int run(std::vector<std::string> words, const Wrapping& wrapping) {
  if (words.back() == kRemote) words = remote_arguments(words.front());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> of_program = arguments;  // without those of GoogleTest
  auto count = static_cast<int>(words.size());
  testing::InitGoogleTest(&count, of_program.data());
  static Options options;
  parse(count, of_program.data(), options);
  start_with_mesa_build(options.session.implementation.mesa_build, arguments.data());
  const bool is_elsewhere = options.events == kStandardOutput;
  if (!options.programs.empty()) {
    use_programs(options.programs);
    if (is_elsewhere) fs::remove(options.programs);
  }
  if (options.is_worker) prepare_worker();
  // Never destroyed, because a library that calls exit() inside a test must not run the destructor
  // of its context.
  static EventFile& events =
      is_elsewhere ? *new EventFile(take_standard_output()) : *new EventFile(options.events);
  report_crashes(events);
  static const std::function<void(const Event&)> report = [](const Event& event) {
    events.write(to_line(event));
  };
  static Session& session = *new Session(options.session, wrapping, report);
  if (!options.is_worker) return run_google_tests(session, options.session.depth);
  static JobLoop& jobs = *new JobLoop(options, events, session);
  return jobs.run();
}

}  // namespace

int suite_main(int argc, char** argv, const Wrapping& wrapping) {
  prepare_process();
  try {
    return run({argv, argv + argc}, wrapping);
  } catch (const CannotStart& error) {
    std::cerr << "cannot start: " << error.what() << "\n";
    return kCannotStart;
  } catch (const std::exception& error) {
    std::cerr << "evalcts-suite: " << error.what() << "\n";
    return kOwnFault;
  }
}

}  // namespace evalcts
