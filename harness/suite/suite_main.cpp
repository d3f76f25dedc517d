// Implements the suite program: parses its options, opens the implementation, and registers each test with
// GoogleTest.
#include <evalcts/suite/suite_main.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/backends/rejected_queries.h>
#include <evalcts/backends/reused_context.h>
#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/reduction.h>
#include <evalcts/gl/call_in_flight.h>
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/results/event_file.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/hash.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/claims.h>
#include <evalcts/testkit/registration.h>
#include <evalcts/testkit/reproduction.h>
#include <evalcts/testkit/test.h>
#include "crash_report.h"
#include "surroundings.h"

namespace evalcts {
namespace {

// Exit codes, as of `evalcts run` (docs/reading-verdicts.md): 2 for wrong use or an implementation that does
// not start, 3 for an internal error of evalcts.
constexpr int kCannotStart = 2;
constexpr int kOwnFault = 3;

struct Options {
  ImplementationOptions implementation;
  std::vector<std::string> captures, readings;
  bool captures_given = false;
  std::string depth = "full";
  std::uint32_t seed = 1;
  std::string records, tests, claims, answer, prove, reproduce;
  fuzz::Campaign campaign;
  std::string deadly, replay, reduce;
  double reduce_seconds = 0;      // time limit; 0: none
  std::uint64_t renew_above = 0;  // MiB; 0: no limit
  std::vector<std::string> left_out;
  bool fuzz = false, describe = false, list = false, trace_cases = false, crash_control = false,
       die_with_parent = false, reuse_context = false, warm = false;
};

// A test to run, completely or only its first cases.
struct Chosen {
  TestInfo info;
  std::size_t position = 0;  // index in the list of tests
  std::size_t most_cases = std::numeric_limits<std::size_t>::max();
};

struct Program {
  Options options;
  std::unique_ptr<Implementation> implementation;
  std::unique_ptr<Implementation> reused;  // set if all tests share a context
  std::unique_ptr<WarmContext> warm;       // set if tests run in a warm context first
  int replaced_contexts = 0;               // number of warm contexts whose state could not be restored
  std::size_t cases_left = 0;              // number of cases that the running test may still run
  const TestRecord* record = nullptr;      // the record of the running test
  gl::Case latest_case;                    // the latest case of the running test
  std::string failing_case;                // its first failing case as JSON text; empty: none yet
  std::unique_ptr<Captures> captures;
  std::unique_ptr<Reproduction> reproduction;
  Subject subject;
  std::unique_ptr<EventFile> records;
  std::unique_ptr<Claims> claims;  // set if several processes share the list of tests
};

// Keeps the latest case of the running test if it is the first that failed.
void keep_failing_case(Program& program) {
  if (!program.record || !program.failing_case.empty() || program.record->failures.empty() ||
      program.record->failures.front().case_identity != program.latest_case.identity())
    return;
  program.failing_case = gl::to_text_if_possible(program.latest_case);
}

// Adapts a test to GoogleTest: a failure fails, and a test that was not judged is skipped with the reason.
class GoogleTestAdapter : public testing::Test {
 public:
  GoogleTestAdapter(const Chosen& chosen, Program& program) : chosen_(chosen), program_(program) {}

  void TestBody() override {
    const TestInfo& info = chosen_.info;
    if (program_.claims) {
      if (!program_.claims->take(chosen_.position)) return;
      std::cout << "[ RUN      ] " << info.full_name() << std::endl;  // not printed by GoogleTest if brief
    }
    TestRecord record;
    record.name = info.full_name();
    record.requirements = info.requirements;
    record.level = info.level;
    program_.records->write(to_line(TestStarted{record.name}));
    const auto start = std::chrono::steady_clock::now();
    const Surroundings surroundings;
    if (!passes_in_warm_context(record)) run(program_.subject, record);
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::vector<std::string> changed = surroundings.put_back();
    if (!program_.failing_case.empty())
      program_.records->write(to_line(CaseFailed{record.name, program_.failing_case}));
    program_.records->write(to_line(TestFinished{record}));
    report(record);
    if (!changed.empty())
      std::cout << fmt::format("evalcts: the library has changed {}; put back", fmt::join(changed, ", "))
                << std::endl;
    // The remaining tests run in a new process of the runner if this one has little memory left, or if the
    // library has closed files.
    const std::uint64_t most_memory = program_.options.renew_above << 20;
    if (program_.records->was_closed() || (most_memory != 0 && resident_memory(getpid()) > most_memory)) {
      std::cout.flush();
      std::fflush(stdout);
      _exit(0);
    }
  }

 private:
  void run(const Subject& subject, TestRecord& record) {
    program_.cases_left = chosen_.most_cases;
    program_.record = &record;
    program_.latest_case = {};
    program_.failing_case.clear();
    evalcts::Test test(subject, record);
    test.run(chosen_.info.body);
    keep_failing_case(program_);
    program_.record = nullptr;
  }

  // Runs the test in the warm context, if there is one. Returns true, with the result in `record`, if it
  // passes. A sample of the tests runs in fresh contexts anyway.
  bool passes_in_warm_context(TestRecord& record) {
    constexpr std::uint32_t kSample = 16;
    constexpr int kMostReplaced =
        16;  // warm contexts; a library whose answers change by themselves needs more
    if (!program_.warm || (fnv1a<std::uint32_t>(record.name) + program_.subject.seed) % kSample == 0)
      return false;
    Subject subject = program_.subject;
    subject.implementation = &program_.warm->implementation();
    subject.is_warm = true;
    TestRecord warm = record;
    run(subject, warm);
    const bool is_restored = program_.warm->restore();
    if (!is_restored && ++program_.replaced_contexts == kMostReplaced) program_.warm.reset();
    if (!is_restored || warm.verdict != Verdict::kPass) return false;
    record = std::move(warm);
    return true;
  }

  static void report(const TestRecord& record) {
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

  const Chosen& chosen_;
  Program& program_;
};

ListedTest listed(const TestInfo& info) {
  return {info.full_name(), info.requirements, info.level, info.from};
}

std::vector<ListedTest> listed_tests() {
  std::vector<ListedTest> tests;
  for (const TestInfo& info : all_tests()) tests.push_back(listed(info));
  return tests;
}

// Returns a warning if another driver than requested was loaded; otherwise an empty string. Sinks and
// built-in implementations have no driver, and a layer hides the renderer below it.
std::string note_on_driver(const ImplementationInfo& info, const ImplementationOptions& options) {
  const bool is_layer = !options.context.empty() && !options.library.empty();
  if (is_layer || info.name == "sink" || info.name == "production" || info.name == "reference") return {};
  return describe_other_driver(info.renderer);
}

Description description_of(const Subject& subject, const ImplementationOptions& options) {
  const ImplementationInfo& info = subject.info;
  Description description;
  ImplementationRecord& implementation = description.implementation;
  implementation.name = info.name;
  implementation.library = info.library;
  implementation.context_library = subject.implementation->context_library();
  implementation.vendor = info.vendor;
  implementation.renderer = info.renderer;
  implementation.version = info.version;
  implementation.max_eval_order = info.max_eval_order;
  implementation.note = note_on_driver(info, options);
  implementation.files = loaded_gl_files();
  for (const auto& capture : all_captures()) description.captures.push_back(capture->name());
  return description;
}

void answer(const Options& options, const std::string& text) {
  if (options.answer.empty()) {
    std::cout << text;
    return;
  }
  std::ofstream file(options.answer);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write '" + options.answer + "'");
}

CaptureRecord prove_one(Program& program) {
  for (auto& capture : all_captures()) {
    if (capture->name() != program.options.prove) continue;
    CaptureRecord result{capture->name(), true, "", ""};
    try {
      capture->prove(*program.implementation, program.subject.info);
      result.shows = describe(capture->attributes());
    } catch (const NotObservable& exception) {
      result.available = false;
      result.reason = exception.what();
    }
    return result;
  }
  throw std::runtime_error("unknown capture '" + program.options.prove + "'");
}

// Returns the tests in the file at `path`, in its order. If `path` is empty, returns the tests of the depth
// and those whose exact names are in the filter, among which GoogleTest chooses. (GoogleTest keeps the tests
// of a suite together.)
std::vector<Chosen> tests_to_register(const std::string& path, Depth depth, const std::string& filter) {
  std::vector<Chosen> tests;
  if (path.empty()) {
    for (const TestInfo& info : all_tests())
      if (is_selected(listed(info), depth, filter)) tests.push_back({info, tests.size()});
    return tests;
  }
  std::map<std::string, const TestInfo*> by_name;
  for (const TestInfo& info : all_tests()) by_name[info.full_name()] = &info;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read '" + path + "'");
  for (std::string line; std::getline(file, line);) {
    const std::size_t tab = line.find('\t');
    const auto found = by_name.find(line.substr(0, tab));
    if (found == by_name.end()) throw std::runtime_error("unknown test '" + line + "'");
    tests.push_back({*found->second, tests.size()});
    if (tab != std::string::npos) tests.back().most_cases = std::stoul(line.substr(tab + 1));
  }
  return tests;
}

void parse(int argc, char** argv, Options& options) {
  CLI::App app{
      "Judges one implementation of OpenGL evaluators. Options of GoogleTest (--gtest_...) work, too."};
  app.add_option("--implementation", options.implementation.name,
                 "what to judge, see 'evalcts list implementations'");
  app.add_option("--library", options.implementation.library, "shared library instead of the usual one");
  app.add_option("--context", options.implementation.context,
                 "what makes the contexts, instead of an implementation");
  app.add_option("--depth", options.depth, "how many values")
      ->check(CLI::IsMember({"quick", "full", "thorough"}));
  app.add_option("--seed", options.seed, "seed of the random tests");
  auto* captures = app.add_option("--captures", options.captures, "use only these")->delimiter(',');
  app.add_option("--interpretation", options.readings, "NAME=READING, as for evalcts run")
      ->expected(1)
      ->take_all();
  app.add_option("--records", options.records, "append a line of JSON for each event");
  app.add_option("--tests", options.tests,
                 "file with the names of the tests to run, one a line, in this order; after a tab, how many "
                 "of its cases (a test that is cut short decides nothing)");
  app.add_option("--claims", options.claims,
                 "file shared with other processes that have the same list: each test is run by one of them");
  app.add_option("--renew-above", options.renew_above,
                 "end after a test if this process uses more memory than this, in MiB; another continues")
      ->needs("--claims");
  app.add_option("--answer", options.answer,
                 "file for the answer of the next three, instead of standard output");
  app.add_option("--reproduce", options.reproduce,
                 "write the first failure of the test, or the case in flight, to this file as a C program");
  app.add_flag("--describe", options.describe, "say what the implementation is, as JSON, and stop");
  app.add_option("--prove", options.prove, "prove one capture, as JSON, and stop");
  app.add_flag("--list", options.list, "list the tests with their requirements, as JSON, and stop");
  app.add_flag("--fuzz", options.fuzz, "run random programs of the seed instead of tests");
  app.add_option("--first", options.campaign.first, "number of the first program")->needs("--fuzz");
  app.add_option("--step", options.campaign.step, "from a program to the next one")->needs("--fuzz");
  app.add_option("--programs", options.campaign.programs, "how many")->needs("--fuzz");
  app.add_option("--seconds", options.campaign.seconds, "time limit of the search, in seconds")
      ->needs("--fuzz");
  app.add_option("--in-flight", options.campaign.in_flight,
                 "file for each smaller version of a program, before it is run")
      ->needs("--fuzz");
  app.add_option("--deadly", options.deadly, "file of smaller versions that are not to be run (JSON)")
      ->needs("--fuzz");
  app.add_option("--length", options.campaign.length, "commands of a program")->needs("--fuzz");
  app.add_flag("--fresh-contexts", options.campaign.fresh_contexts, "a context for each program")
      ->needs("--fuzz");
  app.add_option("--replay", options.replay, "run the program of this file (JSON) instead of tests");
  app.add_option("--reduce", options.reduce,
                 "reduce the failing cases of this file (JSON) to minimal programs instead of running tests")
      ->needs("--claims");
  app.add_option("--reduce-seconds", options.reduce_seconds, "time limit of the reduction, in seconds")
      ->needs("--reduce");
  app.add_flag("--trace-cases", options.trace_cases, "record the calls of each case before it is run");
  app.add_flag("--crash-control", options.crash_control,
               "run the last case of each test that --tests asks for with explicit vertices instead of "
               "evaluations, and stop the test");
  app.add_option("--leave-out", options.left_out,
                 "a command that crashes, \"glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)\": not run by tests "
                 "that can do without it")
      ->expected(1)
      ->take_all();
  app.add_flag("--reuse-context", options.reuse_context,
               "run all cases on one context, whose state is restored by calls in between");
  app.add_flag("--warm", options.warm,
               "run each test on one context first, and again in fresh contexts if it does not pass");
  app.add_flag("--die-with-parent", options.die_with_parent,
               "end when the process that started this one ends");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : kCannotStart);
  }
  options.captures_given = captures->count() > 0;
  if (options.implementation.name.empty() && options.implementation.library.empty() &&
      options.implementation.context.empty())
    options.implementation.name = "reference";
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

// Runs random programs, reduces failing cases, or runs one program from a file. Returns the exit code, which
// is 1 if the program from the file differs from the specification.
int run_programs(const Program& program) {
  if (!program.options.reduce.empty()) {
    fuzz::reduce(program.subject, fuzz::parse_failing_cases(read_file(program.options.reduce)),
                 *program.claims, program.options.reduce_seconds,
                 [&](const fuzz::ReductionEvent& event) { program.records->write(fuzz::to_line(event)); });
    return 0;
  }
  const auto report = [&](const fuzz::CampaignEvent& event) { program.records->write(fuzz::to_line(event)); };
  if (program.options.fuzz) {
    fuzz::Campaign campaign = program.options.campaign;
    campaign.deadly = fuzz::parse_list(read_file(program.options.deadly));
    fuzz::run_campaign(program.subject, campaign, report);
    return 0;
  }
  const std::string text = read_file(program.options.replay);
  if (text.empty()) throw std::runtime_error("cannot read '" + program.options.replay + "'");
  gl::Case script = fuzz::with_what_exists(
      program.subject.info, program.implementation->create_context()->table(), gl::parse_case(text));
  script.set_identity("program");
  program.records->write(to_line(TestStarted{"program"}));
  const Specified specified = specify(script, program.subject.info.max_order());
  std::vector<Outcomes> all_outcomes = {Outcomes::kAll};
  if (specified.prediction.vertex_count() == 0) all_outcomes.push_back(Outcomes::kVertices);
  if (specified.prediction.has_meshes()) all_outcomes.push_back(Outcomes::kOrder);
  TestRecord record;
  record.name = "program";
  record.verdict = Verdict::kPass;
  for (const Outcomes outcomes : all_outcomes) {
    if (!record.failures.empty()) break;
    record.failures = fuzz::judge_program(program.subject, script, specified, outcomes).failures;
  }
  if (!record.failures.empty()) {
    record.verdict = Verdict::kFail;
    record.message = record.failures.front().message;
  }
  program.records->write(to_line(TestFinished{record}));
  return record.failures.empty() ? 0 : 1;
}

// Returns the queries of grids that raise an error. Their own tests fail; other tests leave these queries out
// when they query all state, because the error would be taken for that of another command.
std::set<std::string> rejected_queries(Implementation& implementation) {
  std::set<std::string> rejected;
  for (const GLenum name :
       {GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS})
    for (const bool doubles : {false, true}) {
      gl::Case c;
      const gl::Ref query =
          doubles ? c.GetDoublev(name, gl::out<GLdouble>(4)) : c.GetIntegerv(name, gl::out<GLint>(4));
      const gl::Ref error = c.GetError();
      const std::unique_ptr<Context> context = implementation.create_context();
      if (context->table().GetError && gl::has(context->table(), c.commands()[0].entry) &&
          context->play(c).error(error) != GL_NO_ERROR)
        rejected.insert(gl::call_text(c.commands()[static_cast<std::size_t>(query.index)]));
    }
  return rejected;
}

// Runs the controls of a case that ends the process: explicit commands replace evaluation, and maps and grids
// are left out. If the case draws no vertices, the first control omits evaluation instead. Throws
// NotObservable if the library survives all controls.
void run_without_evaluators(const Program& program, const gl::Case& script) {
  std::vector<gl::Case> controls = gl::controls_without_evaluators(script);
  if (predict(script, program.subject.info.max_order()).vertex_count() == 0) {
    gl::Case without = script.without_commands();
    for (const gl::Command& command : script.commands())
      if (!gl::name_of(command.entry).starts_with("glEval")) without.add(command);
    controls.front() = gl::with_explicit_vertices(without);
  }
  for (const gl::Case& control : controls) program.subject.implementation->create_context()->play(control);
  throw NotObservable("the library survives the case with explicit vertices");
}

int run(int argc, char** argv, const Wrapping& wrapping) {
  testing::InitGoogleTest(&argc, argv);
  const std::string filter = testing::GTEST_FLAG(filter);
  testing::GTEST_FLAG(filter) = with_names_taken_literally(filter);
  // Never destroyed, because a library that calls exit() inside a test must not run the destructor
  // of its context.
  static Program& program = *new Program;
  parse(argc, argv, program.options);
  const Options& options = program.options;
  if (options.die_with_parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::ofstream("/proc/self/oom_score_adj") << 1000;  // if memory runs out, this process is killed first
  }
  if (options.list) {
    answer(options, to_text(listed_tests()));
    return 0;
  }
  const bool answers = options.describe || !options.prove.empty();
  const bool runs_programs = options.fuzz || !options.replay.empty() || !options.reduce.empty();
  const Depth depth = depth_named(options.depth).value_or(Depth::kFull);
  const std::vector<Chosen> tests =
      answers || runs_programs ? std::vector<Chosen>() : tests_to_register(options.tests, depth, filter);
  program.records = std::make_unique<EventFile>(options.records);
  report_crashes(*program.records);
  if (!options.claims.empty()) program.claims = std::make_unique<Claims>(options.claims);
  const bool only_list = testing::GTEST_FLAG(list_tests);
  if (!only_list) {
    try {
      program.implementation = open_implementation(options.implementation);
      if (wrapping) program.implementation = wrapping(std::move(program.implementation));
      program.subject.info = inquire(*program.implementation);
    } catch (const CannotStart& exception) {
      if (!options.answer.empty()) answer(options, cannot_start_text(exception.what()));
      throw;
    }
    if (!program.subject.info.rejected_queries.empty())
      program.implementation =
          without_queries(std::move(program.implementation), program.subject.info.rejected_queries);
    program.subject.implementation = program.implementation.get();
    program.subject.depth = depth;
    program.subject.seed = options.seed;
    program.subject.crashing_calls = {options.left_out.begin(), options.left_out.end()};
    if (!answers && !runs_programs)
      program.subject.crashing_calls.merge(rejected_queries(*program.implementation));
    for (const std::string& choice : options.readings) {
      const std::size_t equals = choice.find('=');
      if (equals == std::string::npos) throw CannotStart("'" + choice + "' is not NAME=READING");
      program.subject.readings[choice.substr(0, equals)] = choice.substr(equals + 1);
    }
    program.subject.before_case = [](const gl::Case& script) {
      keep_failing_case(program);
      program.latest_case = script;
      if (program.options.crash_control && program.cases_left == 1) run_without_evaluators(program, script);
      if (program.cases_left-- == 0) throw std::runtime_error("no further cases of this test were requested");
      if (program.options.trace_cases)
        program.records->write(to_line(CaseStarted{script.identity(), script.is_control(),
                                                   gl::all_calls(script), gl::to_text_if_possible(script)}));
    };
    if (answers) {
      answer(options, options.describe ? to_text(description_of(program.subject, options.implementation))
                                       : to_text(prove_one(program)));
      return 0;
    }
    const bool shares_state = program.subject.info.shares_state;
    if (shares_state) program.reused = reuse_context(*program.implementation, program.subject.info);
    program.captures = std::make_unique<Captures>(shares_state ? *program.reused : *program.implementation,
                                                  program.subject.info,
                                                  options.captures_given ? &options.captures : nullptr);
    program.subject.captures = program.captures.get();
    if (options.reuse_context && !shares_state) {
      program.captures->prove_all();
      program.reused = reuse_context(*program.implementation, program.subject.info);
    }
    if (program.reused) program.subject.implementation = program.reused.get();
    if (options.warm && !program.reused)
      program.warm = WarmContext::of(*program.implementation, program.subject.info);
    if (!options.reproduce.empty()) {
      program.reproduction =
          std::make_unique<Reproduction>(*program.subject.implementation, options.reproduce);
      program.subject.reproduction = program.reproduction.get();
      program.subject.implementation = &program.reproduction->implementation();
    }
  }
  if (runs_programs) {
    program.subject.before_case = nullptr;
    const int status = run_programs(program);
    program.captures.reset();
    program.records->write(to_line(RunEnded{}));
    return status;
  }
  for (const Chosen& chosen : tests)
    testing::RegisterTest(
        chosen.info.suite.c_str(), chosen.info.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
        [chosen]() -> GoogleTestAdapter* { return new GoogleTestAdapter(*new Chosen(chosen), program); });
  const int status = RUN_ALL_TESTS();
  // Contexts must be destroyed before static destructors run, because Mesa would hang.
  program.warm.reset();
  program.reused.reset();
  program.captures.reset();
  program.records->write(to_line(RunEnded{}));
  return status;
}

}  // namespace

int suite_main(int argc, char** argv, const Wrapping& wrapping) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);  // crashes of the library under test leave no core dumps
  std::signal(SIGXFSZ, SIG_IGN);     // a file that becomes too large must not count as a crash of the library
  try {
    return run(argc, argv, wrapping);
  } catch (const CannotStart& error) {
    std::cerr << "cannot start: " << error.what() << "\n";
    return kCannotStart;
  } catch (const std::exception& error) {
    std::cerr << "evalcts-suite: " << error.what() << "\n";
    return kOwnFault;
  }
}

}  // namespace evalcts
