// `evalcts run`: judges implementations with the tests of the suite, reduces their failures to distinct bugs,
// and writes results and pages.
#include <evalcts/reports.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <future>
#include <iostream>
#include <random>

#include <evalcts/cli/command.h>
#include <evalcts/cli/default_implementations.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/conclusion.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/runner.h>
#include <evalcts/runner/worker.h>
#include "chosen_baseline.h"
#include "distinct_bugs.h"
#include "environment.h"
#include "pages.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

struct RunOptions {
  std::vector<std::string> implementations;  // empty: the default implementations
  ImplementationOptions common;              // the other options that choose implementations
  std::string label;
  std::string filter;  // selects among the tests of the depth; empty: all of them
  std::string depth = "full";
  std::uint32_t seed = 1;
  double seconds_per_test = Limits().seconds_per_test;
  std::uint64_t mebibytes = 4096;  // memory limit of each process
  int retries = 1;
  std::optional<int> jobs;  // processes for each implementation
  std::string output;       // empty: a new folder
  std::string baseline;     // "DIR", "DIR/NAME" or "none"; empty: the known bugs only
  bool write_baseline = false;
  bool strict = false;
  bool no_bugs = false;
  double bug_seconds = 60;  // time limit for the reduction of failing tests to minimal programs
  bool reuse_context = false;
  bool fresh = false;
  bool allow_unobserved = false;
  std::vector<std::string> interpretations;  // NAME=READING
  std::string shard;                         // "K/N"; empty: all
  std::optional<std::uint32_t> shuffle;      // seed of the order in which the tests run
  bool quiet = false, verbose = false;
  std::string annotations;  // "github" or "gitlab"; empty: none
  std::string command;      // the typed command
  std::string program;      // evalcts as the user typed it

  bool names_implementations() const { return !completed(implementations, common).empty(); }
};

namespace fs = std::filesystem;

int exit_code_of(const RunResult& result, const RunOptions& options) {
  // The defaults are tried; only a named implementation has to start.
  if (!result.has_started()) return options.names_implementations() ? kWrongUse : kNothingUnexpected;
  const Conclusion conclusion = conclusion_of(result);
  if (conclusion.internal_errors) return kOwnFault;
  if (!conclusion.problems.empty()) return kUnexpected;
  if (!options.allow_unobserved && warn_if_mostly_unobserved(result.implementation.name, conclusion.observed,
                                                             conclusion.supported, "tests")) {
    std::cerr << "evalcts: 'evalcts run --verbose' prints the reasons\n";
    return kWrongUse;
  }
  return kNothingUnexpected;
}

// The names of output files contain the label, and may have at most 255 bytes.
constexpr std::size_t kLongestLabel = 100;

bool is_file_name(const std::string& label) {
  for (const char c : label)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') return false;
  return !label.empty() && label.size() <= kLongestLabel && label[0] != '.' && label[0] != '-';
}

// Returns the error in the first invalid choice (NAME=READING); empty if all are valid.
std::string wrong_reading(const std::vector<std::string>& choices) {
  for (const std::string& choice : choices) {
    const std::size_t equals = choice.find('=');
    if (equals == std::string::npos) return fmt::format("--interpretation '{}' is not NAME=READING", choice);
    const std::string name = choice.substr(0, equals), reading = choice.substr(equals + 1);
    const Ambiguity* const entry = catalogue().find_ambiguity(name);
    if (!entry || entry->readings.empty()) return fmt::format("unknown interpretation '{}'", name);
    if (!entry->readings.contains(reading)) return fmt::format("{} has no reading '{}'", name, reading);
  }
  return {};
}

// Returns the error in the options as far as they do not depend on the machine; empty if there is none.
std::string wrong_options(const RunOptions& options) {
  const std::size_t named = std::max<std::size_t>(options.implementations.size(), 1);
  const bool is_one = named == 1 && options.names_implementations();
  if (!options.common.library.empty() && named != 1)
    return "--library replaces the library of one implementation; name only that one";
  if (!options.common.context.empty() && !options.implementations.empty())
    return "--context takes the place of --implementation; give one of them";
  if (!options.label.empty() && !is_one) return "--name labels one implementation; name only that one";
  if (!options.label.empty() && !is_file_name(options.label))
    return fmt::format(
        "--name is used in file names: it may contain letters, digits, '-', '_' and '.', at most {}",
        kLongestLabel);
  for (const std::string& name : options.implementations)
    if (!std::ranges::any_of(implementation_kinds(),
                             [&](const ImplementationKind& kind) { return kind.name == name; }))
      return fmt::format("unknown implementation '{}'; see 'evalcts list implementations'", name);
  if (const std::string wrong = wrong_reading(options.interpretations); !wrong.empty())
    return wrong + "; see 'evalcts list interpretations'";
  if (options.write_baseline && (options.baseline.empty() || options.baseline == "none"))
    return "--write-baseline needs the folder to write into: --baseline DIR";
  return {};
}

// Returns the name of the result files of an implementation.
std::string result_name(const RunOptions& options, const ImplementationOptions& implementation) {
  return options.label.empty() ? implementation.label() : options.label;
}

// Returns the part of the name of the run's folder that names the implementations.
std::string label_of(const RunOptions& options, const std::vector<ImplementationOptions>& implementations) {
  std::vector<std::string> names;
  for (const ImplementationOptions& each : implementations) names.push_back(result_name(options, each));
  return fmt::format("{}", fmt::join(names, "-")).substr(0, kLongestLabel);
}

std::vector<ImplementationOptions> chosen_implementations(const RunOptions& options) {
  std::vector<ImplementationOptions> chosen = completed(options.implementations, options.common);
  if (chosen.empty())
    for (const std::string& name : default_implementations()) chosen.push_back({name});
  return chosen;
}

// Returns the tests to run, in their order.
std::vector<ListedTest> chosen_tests(const RunOptions& options, const std::vector<ListedTest>& all,
                                     const RunRequest& request) {
  std::vector<ListedTest> tests = matching(all, options.filter);
  std::erase_if(tests,
                [&](const ListedTest& test) { return !is_selected(test, request.depth, options.filter); });
  if (request.shard) tests = request.shard->part_of(tests);
  if (options.shuffle) std::shuffle(tests.begin(), tests.end(), std::mt19937(*options.shuffle));
  return tests;
}

// Returns the reason why the filter selects no test; empty if it selects any.
std::string wrong_filter(const RunOptions& options, const std::vector<ListedTest>& all, Depth depth) {
  const std::vector<ListedTest> matched = matching(all, options.filter);
  if (matched.empty()) return fmt::format("no test matches '{}'; see 'evalcts list tests'", options.filter);
  if (std::ranges::any_of(matched,
                          [&](const ListedTest& test) { return is_selected(test, depth, options.filter); }))
    return {};
  const Depth needed = std::ranges::min(matched, {}, &ListedTest::from).from;
  return fmt::format(
      "'{}' matches {} tests, but none of depth {}; add --depth {}, or give the exact name of a test",
      options.filter, matched.size(), name_of(depth), name_of(needed));
}

RunRequest request_of(const RunOptions& options, const std::string& shard) {
  RunRequest request;
  request.suite_program = places().suite_program;
  request.depth = depth_named(options.depth).value_or(Depth::kFull);
  request.seed = options.seed;
  request.limits = {options.seconds_per_test, options.mebibytes << 20};
  request.retries = options.retries;
  // With several processes, the order of tests within a process is not deterministic, so --shuffle uses one.
  request.jobs = options.jobs.value_or(options.shuffle ? 1 : usual_jobs());
  request.command = options.command;
  request.program = options.program;
  request.filter = options.filter;
  request.readings = options.interpretations;
  request.only_fresh_contexts = options.fresh;
  if (!shard.empty()) request.shard = Shard::parse(shard, "/");
  return request;
}

// Runs the passes over one implementation and returns their results. The second pass, over one shared
// context, is optional.
std::vector<RunResult> passes_over(RunRequest request, const RunOptions& options, ProgressLine& line) {
  Pace pace;
  const auto show = [&](const Progress& progress) {
    line.show(request.name,
              progress.phase == "test" ? pace.at(progress.done, progress.total) : progress.phase);
  };
  std::vector<RunResult> passes = {run_implementation(request, show)};
  if (options.reuse_context && passes[0].is_complete()) {
    const RunResult first = passes[0];
    pace = {};
    request.first_pass = &first;
    passes.push_back(run_implementation(request, show));
  }
  for (RunResult& result : passes) {
    const auto start = std::chrono::steady_clock::now();
    find_distinct_bugs(result, request, options.no_bugs ? 0 : options.bug_seconds, line);
    const std::chrono::duration<double> reducing = std::chrono::steady_clock::now() - start;
    result.seconds = result.seconds.value_or(0) + reducing.count();
  }
  return passes;
}

struct AppliedBaseline {
  std::string problem;  // the reason why the baseline cannot be updated; empty if there is none
  std::string written;  // the line that names the updated file; empty if there is none
  std::string files;    // name of the user's files; empty if there are none
  std::vector<std::string> unused_signatures;
};

// Returns a line about signatures without an entry.
std::string note_on(const std::vector<std::string>& unused, const std::string& files) {
  return fmt::format(
      "evalcts: {} a signature but no entry in {}-fails.txt; the signature{} ignored{}\n",
      unused.size() == 1 ? unused.front() + " has" : fmt::format("{} tests have", unused.size()), files,
      unused.size() == 1 ? " is" : "s are", unused.size() == 1 ? "" : ": " + first_of(unused));
}

// Compares the result with its baseline. If --write-baseline is given, the baseline is updated first.
AppliedBaseline apply_baseline(RunResult& result, const RunOptions& options, const RunRequest& request,
                               const std::vector<ListedTest>& all_tests) {
  AppliedBaseline applied;
  BaselineChoice choice = request.baseline;
  Baseline baseline(choice, result.implementation, result.pass);
  // If the chosen files are for one pass, the other pass must not write them.
  const bool is_chosen = choice.name.empty() || (baseline.files() && baseline.files()->name == choice.name);
  if (options.write_baseline && is_chosen) {
    try {
      const BaselineFiles renewed = baseline.renewed(result, choice, result.file_label());
      if (baseline.files() || !renewed.entries.empty() || result.pass == Pass::kFreshContexts)
        applied.written = write_baseline(chosen_files(options.baseline).folder, baseline.files(), renewed);
      std::erase_if(choice.files, [&](const BaselineFiles& files) { return files.name == renewed.name; });
      choice.files.push_back(renewed);
      baseline = Baseline(choice, result.implementation, result.pass);
    } catch (const BadBaseline& error) {
      applied.problem = error.what();
    }
  }
  baseline.apply(result, all_tests);
  result.stale_baseline_entries = baseline.stale_entries(all_tests);
  if (baseline.files()) applied.files = baseline.files()->name;
  applied.unused_signatures = baseline.unused_signatures();
  return applied;
}

// Returns the file of the repository to which annotations belong: the baseline of the user, or else the
// library.
std::string file_of_annotations(const RunOptions& options) {
  if (!options.baseline.empty() && options.baseline != "none") {
    const ChosenFiles files = chosen_files(options.baseline);
    return (files.name.empty() ? files.folder : files.folder / (files.name + "-fails.txt")).string();
  }
  return options.common.library.empty() ? "evalcts" : options.common.library;
}

int run(const RunOptions& options, const std::string& shard) {
  if (const std::string wrong = wrong_options(options); !wrong.empty()) return wrong_use(wrong);
  RunRequest request = request_of(options, shard);
  const std::vector<ImplementationOptions> chosen = chosen_implementations(options);
  if (options.baseline == "none")
    request.baseline.known_bugs = false;
  else
    request.baseline = choice_of(options.baseline, !options.write_baseline);
  const std::vector<ListedTest> all_tests = list_tests(request.suite_program);
  request.tests = chosen_tests(options, all_tests, request);
  if (const std::string wrong = wrong_filter(options, all_tests, request.depth); !wrong.empty())
    return wrong_use(wrong);
  const fs::path output =
      options.output.empty() ? create_run_folder(label_of(options, chosen)) : fs::path(options.output);
  const FolderLock lock = claim(output, options.command);
  request.output = output;
  if (options.output.empty()) request.run = output.filename().string();

  stop_when_asked();
  adopt_orphans();
  ProgressLine line(options.quiet);
  // Implementations run in parallel, each in its own processes. Summaries are printed in the requested order.
  std::vector<std::future<std::vector<RunResult>>> running;
  for (const ImplementationOptions& implementation : chosen) {
    request.implementation = implementation;
    request.name = result_name(options, implementation);
    running.push_back(
        std::async(std::launch::async, passes_over, request, std::cref(options), std::ref(line)));
  }
  std::vector<RunResult> results;
  int code = kNothingUnexpected;
  for (auto& future : running) {
    std::vector<RunResult> passes;
    try {
      passes = future.get();
    } catch (const CannotWrite& problem) {
      line.print("");
      code = std::max(code, wrong_use(problem.what()));
    }
    for (RunResult& result : passes) {
      const std::string label = result.file_label();
      result.strict = options.strict;
      AppliedBaseline applied;
      if (request.baseline.known_bugs && result.has_started())
        applied = apply_baseline(result, options, request, all_tests);
      // The runner has written the results without bugs and baseline, in case this process is killed.
      write_atomically(output / fmt::format("results-{}.json", label), to_text(result));
      write_atomically(output / fmt::format("junit-{}.xml", label), reports::junit(result));
      const ScreenSize screen = screen_of(STDOUT_FILENO);
      line.print(options.quiet ? reports::terminal_line(result, shows_colour())
                               : reports::terminal_summary(result, catalogue(), shows_colour(),
                                                           options.verbose, screen.lines, screen.columns) +
                                     "\n");
      if (!applied.unused_signatures.empty()) std::cerr << note_on(applied.unused_signatures, applied.files);
      if (!options.quiet) std::cout << applied.written;
      code = std::max(code, exit_code_of(result, options));
      if (!applied.problem.empty()) code = std::max(code, wrong_use(applied.problem));
      if (result.status == RunStatus::kInterrupted) code = std::max(code, kWrongUse);
      results.push_back(std::move(result));
    }
  }
  write_pages(output, results, {});
  if (options.output.empty()) set_latest(output);
  if (options.annotations == "github") std::cout << reports::github_annotations(results);
  if (options.annotations == "gitlab")
    write_atomically(output / "code-quality.json",
                     reports::gitlab_code_quality(results, file_of_annotations(options)));
  if (!options.quiet) std::cout << fmt::format("Report: {}\n", (output / "index.html").string());
  if (interrupted)
    code = std::max(code, wrong_use("interrupted; the results so far are in the output folder"));
  return code;
}

std::function<int()> define_run(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<RunOptions>();
  options->program = call.program;
  options->command = call.command;
  add_implementations(app, options->implementations, options->common);
  app.add_option(
      "--name", options->label,
      "name of the result files and of the column in the report (default: the implementation's name)");
  app.add_option("--filter", options->filter,
                 "run only the tests of the chosen depth that match GoogleTest patterns, such as "
                 "'Map1*:-*Copy*'; a test given by its exact name runs at any depth");
  app.add_option("--depth", options->depth,
                 "number of values and variants that each test tries (default: full)")
      ->check(CLI::IsMember({"quick", "full", "thorough"}));
  app.add_option("--seed", options->seed, "seed of the random tests (default: 1)")->check(number_from_zero);
  app.add_option("--timeout", options->seconds_per_test, "time limit for each test, in seconds (default: 45)")
      ->check(positive_number);
  app.add_option("--memory", options->mebibytes,
                 "memory limit for each process that runs tests, in MiB (default: 4096)")
      ->check(CLI::Range(64.0, 1e9));
  app.add_option("--retry", options->retries,
                 "number of times an unexpected failure is run again (default: 1)")
      ->check(CLI::Range(0, 100));
  app.add_option("--jobs", options->jobs,
                 "number of processes that share the tests of an implementation (default: one per core, at "
                 "most 8; one with --shuffle)")
      ->check(CLI::Range(1, 256));
  app.add_option(
      "--output", options->output,
      "folder for results and report (default: a new one, NAME-DATE, in reports/out of a checkout, or "
      "else in evalcts-results or the folder that $EVALCTS_OUTPUT names)");
  app.add_option("--baseline", options->baseline,
                 "failures that are expected beside those of the known bugs: a folder DIR with baselines, of "
                 "which the best fit is used, or one of them as DIR/NAME; 'none': no failure is expected");
  app.add_flag("--write-baseline", options->write_baseline,
               "record the unexpected failures of this run in the baseline that --baseline names");
  app.add_flag("--strict", options->strict,
               "unexpected passes and stale baseline entries change the exit code, too");
  add_repeatable(app, "--interpretation", options->interpretations,
                 "NAME=READING: fail an implementation that follows another reading of an ambiguous text "
                 "(see 'evalcts list interpretations'); may be repeated");
  app.add_flag("--no-bugs", options->no_bugs, "do not reduce the failing tests to distinct bugs");
  app.add_option("--bug-seconds", options->bug_seconds,
                 "time limit for reducing the failing tests to distinct bugs, in seconds (default: 60)")
      ->check(positive_number);
  app.add_flag(
      "--reuse-context", options->reuse_context,
      "add a second pass that runs all tests in one context, which finds bugs that depend on history");
  app.add_flag("--fresh", options->fresh,
               "run all tests in fresh contexts; by default, tests run in a context that they share first, "
               "and again in "
               "fresh ones if they do not pass");
  add_allow_unobserved(app, options->allow_unobserved);
  add_shard(app, options->shard,
            "K/N: run only every N-th test, starting with the K-th, so that N machines share the tests");
  app.add_option(
      "--shuffle", options->shuffle,
      "run the tests in a random order with this seed; GoogleTest keeps the tests of a suite together");
  app.add_option(
         "--annotations", options->annotations,
         "also report new failures in the form of a CI service: github prints annotations, gitlab writes "
         "code-quality.json")
      ->check(CLI::IsMember({"github", "gitlab"}));
  CLI::Option* verbose = app.add_flag("--verbose", options->verbose,
                                      "list all failing tests and everything that was not judged");
  app.add_flag("--quiet", options->quiet, "print one line per implementation")->excludes(verbose);
  return [options, &call] { return run(*options, options->shard.empty() ? call.shard : options->shard); };
}

}  // namespace

const Command kRunCommand = {
    "run", "judge implementations (default: osmesa or, without OSMesa, egl; production; reference)",
    R"(  $ evalcts run                                         # the three defaults
  $ evalcts run --library ./libOSMesa.so.8              # a library that you built
  $ evalcts run --filter 'Map1Errors.*:-*ActiveTexture*' --depth quick
  $ evalcts run --library ./libEGL.so.1 --baseline mine --write-baseline    # once
  $ evalcts run --library ./libEGL.so.1 --baseline mine/library --strict    # in CI
  $ evalcts run --shard 2/4 --output part-2             # the second of four machines)",
    define_run};

}  // namespace evalcts::cli
