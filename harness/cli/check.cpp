// `evalcts check`: whether an implementation has one bug, fails one test, breaks one requirement or draws a
// recorded program wrong, as an exit code for `git bisect run`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <set>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/gl/c_program.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/runner.h>
#include <evalcts/runner/worker.h>
#include "check_recording.h"
#include "short_program.h"

namespace evalcts::cli {
namespace {

constexpr int kGood = static_cast<int>(CheckOutcome::kGood), kBad = static_cast<int>(CheckOutcome::kBad),
              kCannotBeJudged = static_cast<int>(CheckOutcome::kCannotBeJudged);

struct CheckOptions {
  std::string name, command, program;
  std::vector<std::string> implementations;
  ImplementationOptions common;  // the other options that choose implementations
  double seconds_per_test = Limits().seconds_per_test;
  std::string frames, output;  // of a recording
};

// The tests that decide a check, in the order in which they are tried.
struct Question {
  std::vector<std::vector<ListedTest>> groups;
  std::optional<RequirementId> requirement;  // if set, only failures that violate it count
};

// Returns the tests of quick depth, and those of full depth, which run if the first ones decide nothing.
template <class Predicate>
std::vector<std::vector<ListedTest>> by_depth(const std::vector<ListedTest>& all, const Predicate& is_meant) {
  std::vector<std::vector<ListedTest>> groups(2);
  for (const ListedTest& test : all)
    if (test.from <= Depth::kFull && is_meant(test)) groups[test.from != Depth::kQuick].push_back(test);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

// Returns the tests of the named programs of a known bug or, without such programs, tests that it makes fail.
std::vector<std::vector<ListedTest>> tests_of(const KnownBug& bug, const std::vector<ListedTest>& all) {
  constexpr std::size_t kMostTests = 8;
  std::set<std::string> programs;
  for (const BugProgram& program : bug.programs)
    if (!program.name.empty()) programs.insert("Findings." + program.name);
  if (!programs.empty())
    return by_depth(all, [&](const ListedTest& test) { return programs.contains(test.name); });
  auto groups = by_depth(all, [&](const ListedTest& test) {
    return std::ranges::any_of(bug.tests, [&](const FailingTests& failing) {
      return failing.status != "Flaky" && failing.status != "Skip" &&
             std::ranges::any_of(failing.tests,
                                 [&](const std::string& name) { return stands_for(name, test.name); });
    });
  });
  for (std::vector<ListedTest>& group : groups)
    if (group.size() > kMostTests) group.resize(kMostTests);
  return groups;
}

Question question_of(const std::string& name, const std::vector<ListedTest>& all) {
  if (const KnownBug* const bug = find_known_bug(name)) return {tests_of(*bug, all), {}};
  if (catalogue().find(name)) {
    const RequirementId asked(name);
    return {by_depth(all,
                     [&](const ListedTest& test) {
                       return std::ranges::any_of(test.requirements,
                                                  [&](const RequirementId& id) { return id.decides(asked); });
                     }),
            asked};
  }
  std::vector<ListedTest> named = matching(all, name);
  if (named.empty())
    return {by_depth(all, [&](const ListedTest& test) { return test.name.starts_with(name + "/"); }), {}};
  return {{named}, {}};
}

// A failure that does not happen again decides nothing.
bool violates(const TestRecord& test, const std::optional<RequirementId>& requirement) {
  if (!is_failure(test.verdict) || test.flake) return false;
  return !requirement || std::ranges::any_of(test.blamed(), [&](const RequirementId& id) {
    return id.decides(*requirement);
  });
}

int cannot_judge(const std::string& why) {
  std::cout << "cannot be judged: " << clean(why) << "\n";
  return kCannotBeJudged;
}

// Runs the example of a known bug, which may be outside the evaluators. Returns no exit code if it cannot be
// built or started with this implementation, or if the GL is another one than that of the bug.
std::optional<int> check_example(const KnownBug& bug, const ImplementationOptions& implementation) {
  if (bug.example.empty() || !implementation.context.empty() || !implementation.worker.empty()) return {};
  const bool is_osmesa = implementation.library.find("libOSMesa.so") != std::string::npos;
  ImplementationOptions named = implementation;
  if (named.name.empty()) named.name = is_osmesa ? "osmesa" : "egl";
  const std::vector<std::string> options = named.words();
  ProgramRun run;
  try {
    run = build_and_run(options, example_program(bug, options, "short"));
  } catch (const gl::NoCProgram&) {
    return {};
  }
  const std::string version = run.output.substr(0, run.output.find('\n'));
  if (!run.not_built.empty() || version.find(bug.affects.product) == std::string::npos ||
      version.find(bug.affects.renderer) == std::string::npos)
    return {};
  const bool is_bad = run.hangs() || run.ending->signalled || run.ending->value != 0;
  std::cout << fmt::format("{}: the example of {} with {}\n", is_bad ? "bad" : "good", bug.id, version);
  return is_bad ? kBad : kGood;
}

int check(const CheckOptions& options) {
  const std::vector<ImplementationOptions> chosen = completed(options.implementations, options.common);
  if (chosen.empty())
    return cannot_judge("check needs --implementation, --library, --context or --mesa-build");
  if (record::is_recording(options.name)) {
    const auto frames = options.frames.empty() ? record::Frames() : record::parse_frames(options.frames);
    if (!frames) return cannot_judge(fmt::format("--frames '{}' is not A..B or A", options.frames));
    return static_cast<int>(check_recording({options.name, chosen, *frames, options.output,
                                             options.seconds_per_test, options.command, options.program}));
  }
  if (!options.frames.empty() || !options.output.empty())
    return cannot_judge(
        fmt::format("--frames and --output are for recordings, which '{}' is not", options.name));
  if (chosen.size() > 1) return cannot_judge("only a recording is judged on several implementations");
  const ImplementationOptions& implementation = chosen.front();
  if (const KnownBug* const bug = find_known_bug(options.name))
    if (const std::optional<int> code = check_example(*bug, implementation)) return *code;
  const Question question = question_of(options.name, list_tests(places().suite_program));
  if (question.groups.empty())
    return cannot_judge(
        fmt::format("'{}' is not a known bug, a requirement or a test that can be run; see 'evalcts list'",
                    options.name));
  const Scratch scratch;
  RunRequest request;
  request.suite_program = places().suite_program;
  request.implementation = implementation;
  request.name = implementation.label();
  request.limits.seconds_per_test = options.seconds_per_test;
  request.jobs = usual_jobs();
  request.output = scratch.path();
  request.program = options.program;
  request.baseline.known_bugs = false;
  stop_when_asked();
  adopt_orphans();
  std::string why = "no test was run";
  for (const std::vector<ListedTest>& tests : question.groups) {
    request.tests = tests;
    request.depth = std::ranges::max(tests, {}, &ListedTest::from).from;
    const RunResult result = run_implementation(request, [](const Progress&) {});
    if (!result.has_started()) return cannot_judge(result.reason);
    if (interrupted) return cannot_judge("interrupted");
    for (const TestRecord& test : result.tests) {
      why = fmt::format("{}: {}: {}", test.name, text_of(test.verdict).label, test.message);
      if (!violates(test, question.requirement)) continue;
      std::cout << "bad: " << clean(why) << "\n";
      return kBad;
    }
    if (const auto passed = std::ranges::count(result.tests, Verdict::kPass, &TestRecord::verdict)) {
      std::cout << fmt::format("good: {} of {} tests passed, and none failed\n", passed, result.tests.size());
      return kGood;
    }
  }
  return cannot_judge(why);
}

std::function<int()> define_check(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<CheckOptions>();
  options->program = call.program;
  app.add_option(
         "name", options->name,
         "ID of a known bug or requirement, name of a test or of a test function, or file of a recording")
      ->required();
  add_implementations(app, options->implementations, options->common);
  app.add_option("--timeout", options->seconds_per_test, "time limit for each test, in seconds (default: 45)")
      ->check(positive_number);
  app.add_option("--frames", options->frames, "of a recording: only these frames, as A..B or A, from 0");
  app.add_option("--output", options->output,
                 "of a recording: folder for results and report (default: a new one, as of run)");
  return [options, &call] {
    options->command = call.command;
    // Any other exit code would mean that the revision is bad, or end the bisection.
    try {
      return check(*options);
    } catch (const std::exception& error) {
      return cannot_judge(error.what());
    }
  };
}

}  // namespace

const Command kCheckCommand = {"check",
                               "say by the exit code whether an implementation has a bug, or draws a "
                               "recorded program wrong: 0 no, 1 yes, "
                               "125 unknown",
                               R"(  $ evalcts check mesa-point-end --library ./build/libOSMesa.so.8
  $ git bisect run evalcts check Points.LastIsExact/1-D_U --library ./build/libOSMesa.so.8
  $ evalcts check viewer.evalrec --implementation egl --implementation dropin-egl)",
                               define_check};

}  // namespace evalcts::cli
