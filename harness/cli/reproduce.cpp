// `evalcts reproduce`: writes a failure or a bug of the last run as a stand-alone C program.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <list>
#include <optional>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/results/files.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/worker.h>
#include "recorded.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

struct ReproduceOptions {
  // The name of a test, NAME:test, or a part of a name that occurs in only one failing test; the ID of a bug,
  // or NAME:ID. NAME is the name of an implementation.
  std::string failure;
  std::string results;  // folder of the run; empty: the default folder
  std::string output;   // the file to write; empty: a file in the folder of the run
  std::string program;  // evalcts as the user typed it
};

namespace fs = std::filesystem;

constexpr std::size_t kMostSuggested = 10;

// Thrown if no reproducer can be written. The message states the reason.
struct CannotReproduce : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the tests of all result files in the folder. They point to results, which are added to `runs`.
std::vector<Candidate> recorded_tests(const fs::path& folder, std::list<RunResult>& runs) {
  std::vector<Candidate> tests;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with("results-") || entry.path().extension() != ".json") continue;
    try {
      const std::vector<Candidate> found =
          candidates_of(runs.emplace_back(parse_run_result(read_file(entry.path()))));
      tests.insert(tests.end(), found.begin(), found.end());
    } catch (const FormatError& problem) {
      std::cerr << fmt::format("evalcts: {} holds no results; left out ({})\n", entry.path().string(),
                               clean(problem.what()));
    }
  }
  if (tests.empty())
    throw CannotReproduce(
        fmt::format("'{}' contains no results; 'evalcts run' first, or name the folder with "
                    "--results",
                    folder.string()));
  std::sort(tests.begin(), tests.end(),
            [](const Candidate& a, const Candidate& b) { return a.full_name() < b.full_name(); });
  return tests;
}

std::string suggestions(const std::vector<Candidate>& tests) {
  std::string text;
  for (std::size_t i = 0; i < tests.size() && i < kMostSuggested; ++i) text += "\n  " + tests[i].full_name();
  if (tests.size() > kMostSuggested) text += fmt::format("\n  and {} more", tests.size() - kMostSuggested);
  return text;
}

// Returns the only failing test with the wanted name, or the only one whose name contains
// it. Throws CannotReproduce.
Candidate find(const std::vector<Candidate>& tests, const std::string& wanted) {
  std::vector<Candidate> failing, exact, part;
  bool exists = false;
  for (const Candidate& test : tests) {
    const bool same = wanted == test.name() || wanted == test.full_name();
    exists = exists || same;
    if (!test.failed()) continue;
    failing.push_back(test);
    if (same) exact.push_back(test);
    if (test.full_name().find(wanted) != std::string::npos) part.push_back(test);
  }
  const std::vector<Candidate>& matching = exact.empty() ? part : exact;
  if (matching.size() == 1) return matching.front();
  if (matching.size() > 1)
    throw CannotReproduce(fmt::format("'{}' names {} failures; name one of them:{}", wanted, matching.size(),
                                      suggestions(matching)));
  if (exists) throw CannotReproduce(fmt::format("{} did not fail in that run", wanted));
  throw CannotReproduce(failing.empty() ? "nothing failed in that run"
                                        : fmt::format("no failing test is called '{}'; these failed:{}",
                                                      wanted, suggestions(failing)));
}

// The minimal program of a bug, with a record as if it were a test.
struct BugProgram {
  TestRecord test;
  std::string commands;  // JSON
};

// Returns the bug with the wanted ID; none if there is none. For a bug that was not reduced, returns its
// first test; otherwise sets `program`. Throws CannotReproduce if several implementations have the bug.
std::optional<Candidate> find_bug(const std::list<RunResult>& runs, const std::string& wanted,
                                  BugProgram& program) {
  std::vector<std::pair<const RunResult*, const Bug*>> found;
  for (const RunResult& run : runs)
    for (const Bug& bug : run.bugs)
      if (run.pass == Pass::kFreshContexts &&
          (wanted == bug.id || wanted == run.implementation.name + ":" + bug.id ||
           (!bug.known.empty() && wanted == bug.known)))
        found.emplace_back(&run, &bug);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) {
    std::string names;
    for (const auto& [run, bug] : found) names += fmt::format("\n  {}:{}", run->implementation.name, bug->id);
    throw CannotReproduce(
        fmt::format("{} implementations have the bug {}; name one of them:{}", found.size(), wanted, names));
  }
  const auto [run, bug] = found.front();
  if (bug->commands.empty()) {
    const auto test = std::ranges::find(run->tests, bug->tests.at(0), &TestRecord::name);
    if (test == run->tests.end()) throw CannotReproduce(fmt::format("{} names no test of its run", wanted));
    return Candidate{run, &*test};
  }
  program.commands = bug->commands;
  program.test.name = bug->id;
  program.test.requirements = bug->requirements;
  program.test.level = bug->level;
  program.test.verdict = bug->verdict;
  program.test.message = bug->title;
  program.test.failures = {bug->failure};
  return Candidate{run, &program.test};
}

// The outcome of the test when the suite program ran it again.
struct Replayed {
  std::optional<TestRecord> record;  // none if the process died or hung in the test
  bool hung = false;
  std::string ending;
  std::string program;  // the C program; empty if none was written
};

// Runs the test again and writes the C program. `program`: JSON commands that are replayed instead of the
// test; empty: none. Throws CannotReproduce if the test does not start.
Replayed replay(const Candidate& failure, const std::string& program) {
  if (failure.run->suite_command.empty())
    throw CannotReproduce("the results come from another version of evalcts; run the test again:\n  " +
                          (failure.test->rerun.empty() ? "evalcts run" : failure.test->rerun));
  const Scratch scratch;
  const fs::path log = scratch.path() / "log", program_file = scratch.path() / "program.c";
  std::vector<std::string> command = replay_options(*failure.run);
  command.insert(command.begin(), places().suite_program.string());
  command.insert(command.end(), {"--die-with-parent", "--reproduce", program_file.string()});
  Worker worker(command, log, {failure.run->timeout.value_or(Limits().seconds_per_test)});
  worker.give(program.empty() ? Job{.kind = "test", .name = failure.name()}
                              : Job{.kind = "case", .name = "program", .data = program});
  worker.finish();
  const WorkerRun& run = worker.wait();
  if (run.finished.empty() && run.in_flight.empty())
    throw CannotReproduce(fmt::format("{} no longer starts:\n{}", failure.label(), read_file(log)));
  Replayed result;
  if (!run.records.empty()) result.record = run.records.begin()->second;
  result.hung = run.hung;
  result.ending = describe(run.ending);
  result.program = read_file(program_file);
  return result;
}

// Returns the text as lines of a C comment.
std::string comment(const std::string& text) {
  std::string out = " * " + wrapped(text, 96, " * ", 3);
  for (const char* mark : {"*/", "/*"})
    for (std::size_t at; (at = out.find(mark)) != std::string::npos;) out.insert(at + 1, " ");
  return out + "\n";
}

std::string head(const Candidate& failure, const Replayed& replayed, const std::string& compile) {
  const TestRecord& test = replayed.record ? *replayed.record : *failure.test;
  std::string text = "/*\n" + comment(fmt::format("{} on {}: {}", failure.name(), failure.label(),
                                                  text_of(failure.test->verdict).word));
  if (!test.failures.empty()) text += comment("Case: " + test.failures.front().case_identity);
  text += " *\n" + comment(test.message);
  for (const RequirementId& id : failure.test->requirements)
    if (const Requirement* const requirement = catalogue().find(id))
      text += " *\n" + comment(fmt::format("{}: {} [{}]", id.text(), requirement->text, requirement->source));
  text += " *\n *   " + compile + "\n *\n" +
          comment(
              "Exit code 1: the failure shows; 0: it does not; 2: the program cannot start. The argument, if "
              "there is one, is another library to try it on.") +
          " */\n";
  if (replayed.hung || failure.test->verdict == Verdict::kTimeout)
    text += fmt::format("#define SECONDS {} /* until this counts as a hang */\n",
                        std::clamp(static_cast<int>(failure.run->timeout.value_or(10.0)), 1, 10));
  return text;
}

// Returns `path` relative to the working directory if that is shorter.
std::string from_here(const fs::path& path) {
  const std::string relative = fs::proximate(path).string();
  return relative.size() < path.string().size() ? relative : path.string();
}

// Returns a shell line that compiles the C file `source` to a program of the same name without extension and
// runs it.
std::string compile_line(const Candidate& failure, const std::string& source) {
  const std::string program = source.substr(0, source.size() - fs::path(source).extension().string().size());
  std::vector<std::string> command = {"cc", "-o", program, source};
  const std::vector<std::string> options = replay_options(*failure.run);
  if (std::find(options.begin(), options.end(), "production") != options.end()) {
    const Places where = places();
    if (where.production_library.empty()) {
      command.push_back("-lglevaluator");
    } else {
      command.insert(command.end(), {"-DGLEV_STATIC", "-I" + where.production_headers.string(),
                                     where.production_library.string(), "-lm"});
    }
  } else {
    command.push_back("-ldl");
  }
  return shell_line(command) + " && " +
         shell_line({program.find('/') == std::string::npos ? "./" + program : program});
}

int reproduce_or_throw(const ReproduceOptions& options) {
  const fs::path folder = options.results.empty() ? places().output : fs::path(options.results);
  std::list<RunResult> runs;
  const std::vector<Candidate> tests = recorded_tests(folder, runs);
  BugProgram bug;
  const std::optional<Candidate> found = find_bug(runs, options.failure, bug);
  const Candidate failure = found ? *found : find(tests, options.failure);
  const Replayed replayed = replay(failure, bug.commands);

  if (replayed.program.empty() || replayed.program.starts_with("#error ")) {
    std::string calls;
    if (!failure.test->failures.empty())
      for (const std::string& call : failure.test->failures.front().calls) calls += "  " + call + "\n";
    throw CannotReproduce(fmt::format("{}.\nThe calls of the case:\n{}",
                                      replayed.program.empty()
                                          ? "the test died before its first case"
                                          : replayed.program.substr(7, replayed.program.find('\n') - 7),
                                      calls));
  }

  const TestRecord* const record = replayed.record ? &*replayed.record : nullptr;
  if (record && record->verdict == Verdict::kPass)
    throw CannotReproduce(
        fmt::format("{} passes now, alone in a new process: {}", failure.name(),
                    failure.test->verdict == Verdict::kFail
                        ? "the library has changed, or it depends on chance"
                        : "its message says what it needs to fail:\n  " + failure.test->message));
  if (record && record->verdict != Verdict::kFail)
    throw CannotReproduce(
        fmt::format("{} is {} now: {}", failure.name(), text_of(record->verdict).word, record->message));
  const fs::path file = fs::absolute(options.output.empty() ? folder / reproducer_name(failure.name())
                                                            : fs::path(options.output))
                            .lexically_normal();
  const bool replaced = fs::exists(file);
  try {
    write_atomically(
        file, head(failure, replayed, compile_line(failure, file.filename().string())) + replayed.program);
  } catch (const std::runtime_error& error) {
    throw CannotReproduce(fmt::format("{}; choose another file with --output", error.what()));
  }

  std::cout << fmt::format("{} {}; build and start it with\n\n  {}\n\n", replaced ? "Replaced" : "Wrote",
                           from_here(file), compile_line(failure, from_here(file)));
  if (!record) {
    std::cout << fmt::format("It makes the calls of the case in which the process {}.\n",
                             replayed.hung ? "hung" : "ended with " + replayed.ending);
    if (!replayed.hung && replayed.ending.starts_with("exit code"))
      std::cout
          << "The library ends the process by itself, so the program ends with that code instead of 1.\n";
  } else {
    std::cout << "It shows: " << record->message << "\n";
  }
  std::cout << "Exit code 1: the failure shows; 0: it does not; 2: it cannot start.\n";
  return kNothingUnexpected;
}

int reproduce(const ReproduceOptions& options) {
  try {
    return reproduce_or_throw(options);
  } catch (const CannotReproduce& error) {
    return wrong_use(clean(error.what()));
  } catch (const FormatError& error) {
    return wrong_use("the result file does not follow its schema: " + clean(error.what()));
  }
}

std::function<int()> define_reproduce(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<ReproduceOptions>();
  options->program = call.program;
  app.add_option("failure", options->failure,
                 "name of a failing test, NAME:TEST, or a part of the name that identifies it; or the ID of "
                 "a bug (see 'evalcts bugs')")
      ->required();
  app.add_option("--output", options->output, "C file to write");
  app.add_option("--results", options->results, "folder with the results of the run (default: the last run)");
  return [options] { return reproduce(*options); };
}

}  // namespace

const Command kReproduceCommand = {
    "reproduce", "write a stand-alone C program for a failing test or a bug of the last run",
    R"(  $ evalcts reproduce IntegersSaturate/MAP1_INDEX
  $ evalcts reproduce osmesa:GetMap.IntegersSaturate/MAP1_INDEX --output saturate.c
  $ evalcts reproduce EV-GETMAP-SATURATE-b20f)",
    define_reproduce};

}  // namespace evalcts::cli
