// `evalcts reproduce`: writes a failure or a bug of the last run as a stand-alone C program.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <list>
#include <optional>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/gl/c_program.h>
#include <evalcts/results/files.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/worker.h>
#include "recorded.h"
#include "result_files.h"
#include "run_folders.h"
#include "short_program.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

struct ReproduceOptions {
  std::string failure;  // see find_failure()
  std::string run;      // value of --run
  std::string style;    // "short", "full" or "piglit"; empty: short if the program shows the failure
  std::string output;   // the file to write; empty: a file in the folder of the run
  std::string worker;   // see ImplementationOptions
  std::string program;  // evalcts as the user typed it
};

namespace fs = std::filesystem;

// Thrown if no reproducer can be written. The message states the reason.
struct CannotReproduce : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The minimal program of a bug, with a record as if it were a test.
struct BugProgram {
  TestRecord test;
  std::string commands;  // JSON
};

// Returns what is replayed for a failure: the minimal program of a bug, which is stored in `program`, or a
// test.
Candidate replayed_failure(const RecordedFailure& failure, BugProgram& program) {
  if (!failure.bug || failure.bug->commands.empty()) return failure.first();
  const Bug& bug = *failure.bug;
  program.commands = bug.commands;
  program.test.name = bug.id;
  program.test.requirements = bug.requirements;
  program.test.level = bug.level;
  program.test.verdict = bug.verdict;
  const KnownBug* const known = find_known_bug(bug.known);
  program.test.message = known ? known->title : bug.title;
  program.test.failures = {bug.failure};
  return {failure.run, &program.test};
}

// The outcome of the test when the suite program ran it again.
struct Replayed {
  std::optional<TestRecord> record;  // none if the process died or hung in the test
  bool hung = false;
  bool dies = false;  // an example in which the library crashes or hangs
  std::string ending;
  std::string program;  // the C program; empty if none was written
};

// Runs the test again, in a worker elsewhere if that is not empty, and writes the C program in a style.
// `program`: JSON commands that are replayed instead of the test; empty: none. Throws CannotReproduce if the
// test does not start.
Replayed replay(const Candidate& failure, const std::string& worker, const std::string& program,
                const std::string& style) {
  if (failure.run->suite_command.empty())
    throw CannotReproduce("the results come from another version of evalcts; run the test again:\n  " +
                          (failure.test->rerun.empty() ? "evalcts run" : failure.test->rerun));
  const Scratch scratch;
  const fs::path log = scratch.path() / "log";
  std::vector<std::string> command = replay_options(*failure.run);
  command.insert(command.begin(), places().suite_program.string());
  command.insert(command.end(), {"--reproduce", style});
  if (!worker.empty()) command.insert(command.end(), {"--worker", worker});
  Worker process(command, log, {failure.run->timeout.value_or(Limits().seconds_per_test)});
  process.give(program.empty() ? Job{.kind = "test", .name = failure.name()}
                               : Job{.kind = "case", .name = "program", .data = program});
  process.finish();
  const WorkerRun& run = process.wait();
  if (!run.began_a_job())
    throw CannotReproduce(fmt::format("{} no longer starts:\n{}", failure.label(), read_file(log)));
  Replayed result;
  if (!run.records.empty()) result.record = run.records.begin()->second;
  result.hung = run.hung;
  result.ending = describe(run.ending);
  result.program = run.program;
  return result;
}

// Returns the text as lines of a C comment.
std::string comment(const std::string& text) {
  std::string out = " * " + wrapped(text, 96, " * ", 3);
  for (const char* mark : {"*/", "/*"})
    for (std::size_t at; (at = out.find(mark)) != std::string::npos;) out.insert(at + 1, " ");
  return out + "\n";
}

// Returns the rule that the failure violates, or else the first one of the test; null if it is unknown.
const Requirement* violated_rule(const TestRecord& recorded, const TestRecord& replayed) {
  for (const auto* rules : {&replayed.violated, &recorded.violated, &recorded.requirements})
    if (!rules->empty()) return catalogue().find(rules->front());
  return nullptr;
}

constexpr char kExitCodes[] = "Exit code 1: the failure shows; 0: it does not; 2: the program cannot start.";

// Returns the comment at the top of a program. `title`: the failure in one sentence. `compile`: the shell
// line that builds and runs it; empty for a test of piglit.
std::string head(const Candidate& failure, const Replayed& replayed, const std::string& style,
                 const std::string& title, const std::string& compile) {
  const TestRecord& test = replayed.record ? *replayed.record : *failure.test;
  const ImplementationRecord& implementation = failure.run->implementation;
  std::string text = comment(title);
  if (style == "piglit") text += " *\n" + comment("SPDX-License-Identifier: MIT");
  if (style == "full") {
    text += comment(
        fmt::format("({} on {}: {})", failure.name(), failure.label(), text_of(failure.test->verdict).word));
    if (!test.failures.empty()) text += comment("Case: " + test.failures.front().case_identity);
    text += " *\n" + comment(test.message);
  }
  if (const Requirement* const rule = violated_rule(*failure.test, test))
    text += " *\n" + comment(fmt::format("{}: {} [{}]", rule->id, rule->text, rule->source));
  const std::string where = fmt::format("{} ({})", implementation.version, implementation.renderer);
  if (!compile.empty()) text += " *\n *   " + compile + "\n";
  text += " *\n" + comment(fmt::format("Observed with {}.", where));
  if (style == "full")
    text += comment(
        fmt::format("{} The argument, if there is one, is another library to try it on.", kExitCodes));
  text[0] = '/';
  text.insert(text.size() - 1, " */");
  if (style == "full" && (replayed.hung || failure.test->verdict == Verdict::kTimeout))
    text += fmt::format("#define SECONDS {} /* until this counts as a hang */\n",
                        std::clamp(static_cast<int>(failure.run->timeout.value_or(10.0)), 1, 10));
  return text;
}

// Returns `path` relative to the working directory if that is shorter.
std::string from_here(const fs::path& path) {
  const std::string relative = fs::proximate(path).string();
  return relative.size() < path.string().size() ? relative : path.string();
}

// Compiles and runs a short program. Returns an empty text if it shows the failure, otherwise the reason why
// it does not, or could not be tried (`tried` is false then).
struct Trial {
  bool tried = true;
  std::string problem;
};
Trial try_program(const Candidate& failure, const std::string& worker, const Replayed& replayed) {
  if (!worker.empty()) return {false, "its library is elsewhere"};
  const std::vector<std::string> options = replay_options(*failure.run);
  if (!value_of(options, "--mesa-build").empty()) return {false, "it would run on the system's Mesa"};
  const ProgramRun run = build_and_run(options, replayed.program);
  if (!run.not_built.empty()) return {false, run.not_built};
  const bool shows = replayed.dies     ? run.crashes() || run.hangs()
                     : replayed.record ? run.ending && !run.crashes() && run.ending->value == 1
                     : replayed.hung   ? run.hangs()
                                       : run.crashes();
  return {true, shows ? "" : "the short program does not show the failure here"};
}

// Returns the example of a known bug as a program, with a record of the failure; without a program if the
// implementation is not linked by its name or the example does not show the bug here.
Replayed example(const Candidate& failure, const std::string& worker, const KnownBug& known,
                 const std::string& style) {
  Replayed written;
  written.record = *failure.test;
  written.record->message = known.title;
  written.dies = known.fails.empty();
  try {
    written.program = example_program(known, replay_options(*failure.run), style);
  } catch (const gl::NoCProgram&) {
    return {};
  }
  if (style == "short")
    if (const Trial trial = try_program(failure, worker, written); trial.tried && !trial.problem.empty())
      return {};
  return written;
}

int reproduce_or_throw(const ReproduceOptions& options) {
  const fs::path folder = run_folder(options.run);
  const std::list<RunResult> runs = recorded_run(folder);
  BugProgram bug;
  const RecordedFailure recorded = find_failure(runs, options.failure);
  const Candidate failure = replayed_failure(recorded, bug);
  if (options.worker.empty() && std::ranges::count(failure.run->suite_command, "--worker") > 0)
    throw CannotReproduce(
        "these results come from a worker elsewhere; start it with --worker COMMAND, as for the run");
  std::string style = options.style.empty() ? "short" : options.style, note;
  const KnownBug* const known = recorded.bug ? find_known_bug(recorded.bug->known) : nullptr;
  Replayed replayed;
  if (known && !known->example.empty() && style != "full")
    replayed = example(failure, options.worker, *known, style);
  const bool is_example = !replayed.program.empty();
  if (!is_example) replayed = replay(failure, options.worker, bug.commands, style);
  if (options.style.empty() && !is_example) {
    Trial trial;
    if (replayed.program.starts_with("#error "))
      trial.problem = replayed.program.substr(7, replayed.program.find('\n') - 7);
    else if (!replayed.program.empty() && (!replayed.record || replayed.record->verdict == Verdict::kFail))
      trial = try_program(failure, options.worker, replayed);
    if (!trial.tried) note = fmt::format("It was not tried here ({}).\n", trial.problem);
    if (trial.tried && !trial.problem.empty()) {
      note = fmt::format("It has the style 'full', because {}.\n", trial.problem);
      style = "full";
      replayed = replay(failure, options.worker, bug.commands, style);
    }
  }

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
  const bool is_piglit = style == "piglit";
  const auto line = [&](const std::string& source) {
    return compile_line(replay_options(*failure.run), replayed.program, source,
                        source.substr(0, source.size() - file.extension().string().size()));
  };
  try {
    write_atomically(file, head(failure, replayed, style, is_example ? known->title : failure.test->message,
                                is_piglit ? "" : line(file.filename().string())) +
                               replayed.program);
  } catch (const std::runtime_error& error) {
    throw CannotReproduce(fmt::format("{}; choose another file with --output", error.what()));
  }

  const std::string done = fmt::format("{} {}", replaced ? "Replaced" : "Wrote", from_here(file));
  if (is_piglit)
    std::cout << fmt::format(
        "{}, a test of piglit: put it into tests/spec/gl-1.0, and name it in CMakeLists.gl.txt there and in "
        "tests/opengl.py.\n",
        done);
  else
    std::cout << fmt::format("{}; build and start it with\n\n  {}\n\n", done, line(from_here(file)));
  std::cout << note;
  if (!record) {
    std::cout << fmt::format("It makes the calls of the case in which the process {}.\n",
                             replayed.hung ? "hung" : "ended with " + replayed.ending);
    if (!replayed.hung && replayed.ending.starts_with("exit code"))
      std::cout
          << "The library ends the process by itself, so the program ends with that code instead of 1.\n";
  } else {
    std::cout << "It shows: " << record->message << "\n";
  }
  if (!is_piglit) std::cout << kExitCodes << "\n";
  return kNothingUnexpected;
}

int reproduce(const ReproduceOptions& options) {
  try {
    return reproduce_or_throw(options);
  } catch (const CannotReproduce& error) {
    return wrong_use(clean(error.what()));
  }
}

std::function<int()> define_reproduce(CLI::App& app, const Call& call) {
  const auto options = std::make_shared<ReproduceOptions>();
  options->program = call.program;
  app.add_option("failure", options->failure,
                 "name of a failing test, NAME:TEST, or a part of the name that identifies it; or the ID of "
                 "a bug (see 'evalcts bugs')")
      ->required();
  app.add_option(
         "--style", options->style,
         "short: at most a screen or two, linked with EGL and GL, GL and GLX, or OSMesa; full: opens the "
         "library by its "
         "name, catches crashes and guards arrays; piglit: a test of piglit (default: short if such a "
         "program shows the failure here, otherwise full)")
      ->check(CLI::IsMember({"short", "full", "piglit"}));
  app.add_option("--output", options->output, "C file to write");
  add_worker(app, options->worker);
  add_run(app, options->run);
  return [options] { return reproduce(*options); };
}

}  // namespace

const Command kReproduceCommand = {"reproduce",
                                   "write a C program for a failing test or a bug of the last run",
                                   R"(  $ evalcts reproduce IntegersSaturate/MAP1_INDEX
  $ evalcts reproduce osmesa:GetMap.IntegersSaturate/MAP1_INDEX --output saturate.c
  $ evalcts reproduce EV-GETMAP-SATURATE-b20f)",
                                   define_reproduce};

}  // namespace evalcts::cli
