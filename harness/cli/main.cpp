// The command line of evalcts.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "harness/cli/command_line.h"
#include "harness/cli/commands.h"
#include "harness/cli/environment.h"
#include "harness/cli/help.h"
#include "harness/implementations/implementation.h"
#include "harness/results/baseline.h"
#include "harness/results/files.h"

int evalcts::cli::command_line(int argc, char** argv, bool only_parse) {
  CLI::App app{"evalcts: conformance test suite and reference oracle for OpenGL evaluators", "evalcts"};
  app.formatter(help_formatter());
  app.footer(
      "'evalcts COMMAND --help' shows the options of a command with examples.\n"
      "Exit codes: 0 nothing unexpected; 1 an unexpected fail, crash or timeout; 2 wrong use, or something\n"
      "could not be started, read or written; 3 a fault of evalcts.");
  app.set_version_flag("--version", "evalcts " EVALCTS_VERSION);
  app.require_subcommand(1);

  // The launcher says how it was called itself.
  const char* const launcher = std::getenv("EVALCTS_LAUNCHER");
  const std::string program = launcher && *launcher ? launcher : argc > 0 ? argv[0] : "evalcts";

  RunOptions run_options;
  run_options.program = program;
  run_options.command = "evalcts";
  for (int i = 1; i < argc; ++i) run_options.command += std::string(" ") + argv[i];
  CLI::App* run_command = app.add_subcommand(
      "run", "judge implementations (default: osmesa, or egl without it, production and reference)");
  run_command->add_option("--implementation", run_options.implementations, "what to judge; may be repeated")
      ->expected(1)
      ->take_all();
  run_command->add_option("--library", run_options.library, "shared library instead of the usual one");
  run_command->add_option(
      "--context", run_options.context,
      fmt::format("what makes the contexts, instead of an implementation: {}, or the path "
                  "of a provider",
                  fmt::join(evalcts::context_names(), ", ")));
  run_command->add_option("--name", run_options.label,
                          "label of the output, instead of the implementation's name");
  run_command->add_option("--filter", run_options.filter,
                          "tests to run: patterns as in GoogleTest, 'Map1*:-*Copy*'");
  run_command->add_option("--depth", run_options.depth, "how many values")
      ->check(CLI::IsMember({"quick", "full", "thorough"}));
  run_command->add_option("--seed", run_options.seed, "seed of the random tests");
  run_command->add_option("--timeout", run_options.seconds_per_test, "seconds for each test")
      ->check(CLI::PositiveNumber);
  run_command->add_option("--memory", run_options.mebibytes, "MiB of memory for a process that plays tests")
      ->check(CLI::Range(64.0, 1e9));
  run_command->add_option("--retry", run_options.retries, "how often an unexpected fail is played again")
      ->check(CLI::Range(0, 100));
  run_command
      ->add_option("--jobs", run_options.jobs,
                   "processes that share the tests of an implementation (default: one for each core, at most "
                   "8; one with --shuffle)")
      ->check(CLI::Range(1, 256));
  run_command->add_option("--output", run_options.output, "folder for results and report");
  run_command->add_option("--baseline", run_options.baseline,
                          "known failures: DIR with baselines, DIR/NAME or NAME for a certain one, or 'none' "
                          "(default: the shipped one "
                          "that fits the implementation)");
  run_command->add_flag("--write-baseline", run_options.write_baseline, "write what fails as the baseline");
  run_command->add_flag("--strict", run_options.strict,
                        "an unexpected pass and a stale baseline entry count, too");
  run_command
      ->add_option("--interpretation", run_options.interpretations,
                   "NAME=READING: the reading of an ambiguous text that is wanted, see 'evalcts list "
                   "interpretations'; may be repeated")
      ->expected(1)
      ->take_all();
  run_command->add_flag("--reuse-context", run_options.reuse_context,
                        "a second pass over one shared context, for defects that depend on history");
  run_command
      ->add_option("--shard", run_options.shard,
                   "K/N: every N-th of the tests, from the K-th on; N machines play them all")
      ->check([](const std::string& text) {
        return evalcts::Shard::parse(text, "/") ? std::string() : "'" + text + "' is no K/N with 1 <= K <= N";
      });
  run_command->add_option("--shuffle", run_options.shuffle,
                          "run the tests in a random order (GoogleTest keeps those of a suite together): its "
                          "seed");
  CLI::Option* verbose =
      run_command->add_flag("--verbose", run_options.verbose, "all failing tests and what was not judged");
  run_command->add_flag("--quiet", run_options.quiet, "one line for each implementation")->excludes(verbose);

  std::string what;
  bool as_json = false;
  CLI::App* list_command = app.add_subcommand(
      "list", "implementations, requirements, interpretations, tests, faults or baselines");
  list_command->add_option("what", what)
      ->required()
      ->check(CLI::IsMember(
          {"implementations", "requirements", "interpretations", "tests", "faults", "baselines"}));
  list_command->add_flag("--json", as_json, "as JSON");

  CLI::App* coverage_command =
      app.add_subcommand("coverage", "requirement by requirement: the tests that decide it, or why none can");
  coverage_command->add_flag("--json", as_json, "as JSON");
  bool complete = false;
  coverage_command->add_flag(
      "--complete", complete,
      "exit code 1 where a requirement is neither decided nor known to be undecidable");

  std::string name;
  CLI::App* explain_command =
      app.add_subcommand("explain", "a requirement, interpretation, test or verdict in words");
  explain_command->add_option("name", name)->required();

  ReproduceOptions reproduce_options;
  reproduce_options.program = program;
  CLI::App* reproduce_command =
      app.add_subcommand("reproduce", "a stand-alone C program for a failure of the last run");
  reproduce_command
      ->add_option("failure", reproduce_options.failure,
                   "the test's name, NAME:test, or a part of it that no other failing test has")
      ->required();
  reproduce_command->add_option("--output", reproduce_options.output, "the C file to write");
  reproduce_command->add_option("--results", reproduce_options.results, "folder with the results of the run");

  ReportOptions report_options;
  CLI::App* report_command = app.add_subcommand(
      "report", "pages from one or more results, side by side, and compared with earlier ones");
  report_command->add_option(
      "results", report_options.results,
      "result files, and folders with results (default: those of the last run); shards are put together");
  report_command
      ->add_option("--before", report_options.before,
                   "earlier results to compare with, a file or folder; may be repeated. Exit code 1 where "
                   "something has become worse")
      ->expected(1)
      ->take_all();
  report_command->add_option("--output", report_options.output, "folder for index.html and summary.md");

  FaultsOptions faults_options;
  CLI::App* faults_command = app.add_subcommand(
      "faults", "break one rule at a time on purpose: does the suite catch it? (the tests of the tests)");
  faults_command->add_option("--filter", faults_options.filter, "faults to try: patterns as for run");
  faults_command->add_option("--shard", faults_options.shard, "K/N: every N-th fault, from the K-th on")
      ->check([](const std::string& text) {
        return evalcts::Shard::parse(text, "/") ? std::string() : "'" + text + "' is no K/N with 1 <= K <= N";
      });
  faults_command
      ->add_flag("--complete", faults_options.complete,
                 "exit code 1 where a requirement that tests decide has no fault that was tried, too")
      ->excludes("--filter")
      ->excludes("--shard");
  faults_command->add_option("--timeout", faults_options.seconds_per_test, "seconds for each test")
      ->check(CLI::PositiveNumber);
  faults_command
      ->add_option("--jobs", faults_options.jobs, "faults side by side (default: one for each core)")
      ->check(CLI::Range(1, 256));
  faults_command->add_option("--output", faults_options.output, "folder for faults.json and faults.md");

  FuzzOptions fuzz_options;
  CLI::App* fuzz_command = app.add_subcommand(
      "fuzz", "random programs side by side with the executable specification; differences are made small");
  fuzz_command->add_option("--implementation", fuzz_options.implementation, "what to judge");
  fuzz_command->add_option("--library", fuzz_options.library, "shared library instead of the usual one");
  fuzz_command->add_option("--context", fuzz_options.context, "what makes the contexts, as for run");
  fuzz_command->add_option("--seed", fuzz_options.seed,
                           "the same seed gives the same programs on every machine");
  fuzz_command->add_option("--programs", fuzz_options.programs, "how many");
  fuzz_command
      ->add_option("--seconds", fuzz_options.seconds, "for how long (default: 60, without --programs)")
      ->check(CLI::PositiveNumber);
  fuzz_command->add_option("--length", fuzz_options.length, "commands of a program, about")
      ->check(CLI::Range(1, 100000));
  fuzz_command->add_flag("--fresh-contexts", fuzz_options.fresh_contexts,
                         "a context for each program; without, most share one where that is faster");
  fuzz_command->add_option("--jobs", fuzz_options.jobs, "processes side by side (default: one for each core)")
      ->check(CLI::Range(1, 256));
  fuzz_command->add_option("--output", fuzz_options.output, "folder for what is found");

  RoundingOptions rounding_options;
  CLI::App* rounding_command = app.add_subcommand(
      "rounding",
      "is production correctly rounded? random maps and arguments beside the oracle, bit for bit");
  const CLI::Range counts(0.0, 1e15);  // by itself the parser takes -1 for 2^64 - 1
  rounding_command
      ->add_option("--samples", rounding_options.samples,
                   "values of each class of maps, against the filter and the exact route behind it")
      ->check(counts);
  rounding_command
      ->add_option("--exact", rounding_options.exact, "values of each class, against the exact route alone")
      ->check(counts);
  rounding_command->add_flag("--sweep", rounding_options.sweep,
                             "every float from 0 to 1 instead, for one map of each class of curves");
  rounding_command->add_option("--filter", rounding_options.filter,
                               "classes: patterns as in GoogleTest, 'curve/4/*'");
  rounding_command
      ->add_option(
          "--target", rounding_options.targets,
          "instruction set; may be repeated (default: all that this machine has; for --sweep the best)")
      ->expected(1)
      ->take_all();
  rounding_command->add_option("--seed", rounding_options.seed, "of maps and arguments");
  rounding_command->add_option("--jobs", rounding_options.jobs, "threads (default: one for each core)")
      ->check(CLI::Range(1, 256));

  UlpOptions ulp_options;
  ulp_options.program = program;
  ulp_options.command = run_options.command;
  CLI::App* ulp_command = app.add_subcommand(
      "ulp", "how far from the exact values? errors of implementations in ULP and beside their condition");
  ulp_command
      ->add_option(
          "--implementation", ulp_options.implementations,
          fmt::format("what to measure, also {}; may be repeated (default: osmesa, or egl without it, "
                      "and all that need no library)",
                      fmt::join(own_subject_names(), ", ")))
      ->expected(1)
      ->take_all();
  ulp_command->add_option("--library", ulp_options.library, "shared library instead of the usual one");
  ulp_command->add_option("--context", ulp_options.context, "what makes the contexts, as for run");
  ulp_command->add_option("--name", ulp_options.label,
                          "label in the output, instead of the implementation's name");
  ulp_command->add_option("--target", ulp_options.targets, "kind of map; may be repeated (default: vertex_3)")
      ->expected(1)
      ->take_all()
      ->check(CLI::IsMember(ulp_targets()));
  ulp_command->add_option("--filter", ulp_options.filter,
                          "classes of maps: patterns as in GoogleTest, 'curve/4/*'");
  ulp_command
      ->add_option("--values", ulp_options.values,
                   "of each row of the table (default: 20000), or of the digest (default: 10000000)")
      ->check(CLI::Range(1.0, 1e15));
  ulp_command
      ->add_option("--climb", ulp_options.climb,
                   "results of each row that the search for worse inputs takes, from the worst of these on "
                   "(default: as many)")
      ->check(counts);
  ulp_command->add_option("--seed", ulp_options.seed, "of maps and arguments");
  ulp_command
      ->add_option("--jobs", ulp_options.jobs, "implementations side by side (default: one for each core)")
      ->check(CLI::Range(1, 256));
  ulp_command->add_option("--output", ulp_options.output, "folder for ulp.json and ulp.csv");
  ulp_command->add_flag("--verbose", ulp_options.verbose, "the worst inputs of every row");
  ulp_command->add_option("--orders", ulp_options.orders, "one input instead: its order, or its two orders")
      ->delimiter(',')
      ->expected(1, 2);
  ulp_command->add_option("--points", ulp_options.points, "its control points, v fastest")->delimiter(',');
  ulp_command->add_option("--at", ulp_options.at, "its argument, or its two arguments")
      ->delimiter(',')
      ->expected(1, 2);
  ulp_command->add_flag("--sweep", ulp_options.sweep,
                        "every float of an interval as argument of one map: --orders and --points");
  ulp_command->add_option("--u", ulp_options.fixed_u, "of a surface that is swept along v: its u");
  ulp_command->add_option("--v", ulp_options.fixed_v, "of a surface that is swept along u: its v");
  ulp_command->add_flag(
      "--digest", ulp_options.digest,
      "one line for many results of production, or of another implementation, on random maps");
  ulp_command->add_option("--merge", ulp_options.merge,
                          "files of all shards of a sweep: makes one of them, as of a sweep without shards");
  ulp_command->add_option("--page", ulp_options.page,
                          "an earlier ulp.json: writes its page again, with the sweeps in the output folder");
  ulp_command->add_option("--from", ulp_options.from, "where the interval begins (default: 0)");
  ulp_command->add_option("--to", ulp_options.to, "where it ends (default: 1)");
  ulp_command
      ->add_option("--shard", ulp_options.shard, "K/N: every N-th block of the sweep, from the K-th on")
      ->check([](const std::string& text) {
        return evalcts::Shard::parse(text, "/") ? std::string() : "'" + text + "' is no K/N with 1 <= K <= N";
      });
  ulp_command->add_option(
      "--checkpoint", ulp_options.checkpoint,
      "the file from which a sweep goes on, and its result (default: in the output folder)");
  ulp_command->add_option("--rows", ulp_options.rows)->group("");

  VectorsOptions vectors_options;
  CLI::App* vectors_command = app.add_subcommand("vectors", "golden vectors: right answers as data");
  vectors_command->require_subcommand(1);
  CLI::App* write_command =
      vectors_command->add_subcommand("write", "make them all anew, byte for byte as they are shipped");
  write_command->add_option("--output", vectors_options.output,
                            "folder to write into (default: the shipped one)");
  CLI::App* lint_command = vectors_command->add_subcommand(
      "lint", "look over files of vectors: structure, ids, requirements, flags");
  lint_command->add_option("file", vectors_options.files, "the files (default: those that are shipped)");
  CLI::App* emit_command = vectors_command->add_subcommand(
      "emit", "as lines of text, to be answered: emit | PROGRAM | evalcts vectors check");
  CLI::App* check_command = vectors_command->add_subcommand("check", "judge the answers on standard input");
  for (CLI::App* command : {emit_command, check_command})
    command->add_option("--kind", vectors_options.kinds, "only these (the same for emit and check)")
        ->check(CLI::IsMember({"map1_eval", "map2_eval", "grid", "auto_normal"}));

  add_examples(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) == 0) return kNothingUnexpected;
    const std::string words = suggestion(app, {argv + std::min(argc, 1), argv + argc});
    if (!words.empty()) std::cerr << words << "\n";
    return kWrongUse;
  }
  if (only_parse) return kNothingUnexpected;
  try {
    if (run_options.shard.empty()) run_options.shard = shard_of_environment();
    forget_googletest();
    if (*run_command) return run(run_options);
    if (*list_command) return list(what, as_json);
    if (*coverage_command) return coverage(as_json, complete);
    if (*reproduce_command) return reproduce(reproduce_options);
    if (*report_command) return report(report_options);
    if (*faults_command) return faults(faults_options);
    if (*fuzz_command) return fuzz(fuzz_options);
    if (*rounding_command) return rounding(rounding_options);
    if (*ulp_command) return ulp(ulp_options);
    if (*write_command) return write_vectors(vectors_options);
    if (*lint_command) return lint_vectors(vectors_options);
    if (*emit_command) return emit_vectors(vectors_options);
    if (*check_command) return check_vectors(vectors_options);
    return explain(name);
  } catch (const evalcts::CannotStart& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kWrongUse;
  } catch (const BadEnvironment& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kWrongUse;
  } catch (const evalcts::BadBaseline& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kWrongUse;
  } catch (const evalcts::CannotWrite& error) {
    std::cerr << "evalcts: " << error.what() << "; free some space, or choose another folder with --output\n";
    return kWrongUse;
  } catch (const std::exception& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kOwnFault;
  }
}
