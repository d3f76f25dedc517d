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
#include "result_files.h"
#include "run_folders.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

struct ReproduceOptions {
  std::string failure;  // see find_failure()
  std::string run;      // value of --run
  std::string output;   // the file to write; empty: a file in the folder of the run
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
  program.test.message = bug.title;
  program.test.failures = {bug.failure};
  return {failure.run, &program.test};
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
  const fs::path folder = run_folder(options.run);
  const std::list<RunResult> runs = recorded_run(folder);
  BugProgram bug;
  const Candidate failure = replayed_failure(find_failure(runs, options.failure), bug);
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
  } catch (const NotRecorded& error) {
    return wrong_use(clean(error.what()));
  } catch (const CannotReadResults& error) {
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
  add_run(app, options->run);
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
