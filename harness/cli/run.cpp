#include <evalcts/reports.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <random>

#include "harness/cli/commands.h"
#include "harness/cli/terminal.h"
#include "harness/results/baseline.h"
#include "harness/results/requirements.h"
#include "harness/results/serialization.h"
#include "harness/runner/child_process.h"
#include "harness/runner/question.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

int exit_code_of(const RunResult& result, bool named, bool strict) {
  if (!result.has_started()) return named ? kWrongUse : kNothingUnexpected;
  int code = kNothingUnexpected;
  for (const TestRecord& test : result.tests) {
    if (test.verdict == Verdict::kInternalError) return kOwnFault;
    if (is_failure(test.verdict) && !test.expected_by_baseline) code = kUnexpected;
    if (strict && test.is_unexpected_pass()) code = kUnexpected;
  }
  if (strict && !result.stale_baseline_entries.empty()) code = kUnexpected;
  return code;
}

// The folder that a value of --baseline names, and the base or overlay in it, or empty for the one that fits.
struct ChosenBaseline {
  fs::path folder;
  std::string name;
};

// `given`: empty for the shipped baselines, "DIR", "DIR/NAME", or the NAME of a shipped one.
ChosenBaseline baseline_of(const std::string& given, const fs::path& shipped) {
  const auto has = [](const fs::path& folder, const std::string& name) {
    return !name.empty() && fs::exists(folder / (name + "-fails.txt"));
  };
  if (given.empty()) return {shipped, ""};
  const fs::path path = given;
  if (fs::is_directory(path)) return {path, ""};
  if (path.has_parent_path() && has(path.parent_path(), path.filename().string()))
    return {path.parent_path(), path.filename().string()};
  if (has(shipped, given)) return {shipped, given};
  return {path, ""};
}

// With all that is put around it, a file's name has at most 255 bytes.
constexpr std::size_t kLongestLabel = 100;

bool is_file_name(const std::string& label) {
  for (const char c : label)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') return false;
  return !label.empty() && label.size() <= kLongestLabel && label[0] != '.' && label[0] != '-';
}

// What is wrong with the first bad one of these, NAME=READING each; empty where all are good.
std::string wrong_reading(const std::vector<std::string>& choices) {
  for (const std::string& choice : choices) {
    const std::size_t equals = choice.find('=');
    if (equals == std::string::npos) return fmt::format("--interpretation '{}' is no NAME=READING", choice);
    const std::string name = choice.substr(0, equals), reading = choice.substr(equals + 1);
    const Ambiguity* const entry = catalogue().find_ambiguity(name);
    if (!entry || entry->readings.empty()) return fmt::format("there is no interpretation '{}'", name);
    if (!entry->readings.contains(reading)) return fmt::format("{} has no reading '{}'", name, reading);
  }
  return {};
}

}  // namespace

int run(const RunOptions& options) {
  const Places where = places();
  const fs::path output = options.output.empty() ? where.output : fs::path(options.output);

  RunRequest request;
  request.suite_program = where.suite_program;
  request.depth = depth_named(options.depth).value_or(Depth::full);
  request.seed = options.seed;
  request.limits = {options.seconds_per_test, options.mebibytes << 20};
  request.retries = options.retries;
  // Which tests a process has behind it when it comes to the next depends on chance, but for a single one.
  request.jobs = options.jobs.value_or(options.shuffle ? 1 : usual_jobs());
  request.output = output;
  request.command = options.command;
  request.program = options.program;
  request.own_output = !options.output.empty();
  // The commands that a failure is shown with work from everywhere.
  const std::string library = options.library.find('/') == std::string::npos
                                  ? options.library
                                  : fs::absolute(options.library).lexically_normal().string();

  std::vector<ImplementationOptions> chosen;
  const bool named = !options.implementations.empty() || !options.library.empty() || !options.context.empty();
  if (named) {
    for (const std::string& name : options.implementations)
      chosen.push_back({name, library, options.context});
    if (options.implementations.empty()) chosen.push_back({"", library, options.context});
    if (!options.library.empty() && chosen.size() != 1) {
      std::cerr << "evalcts: --library replaces the library of one implementation; name only that one\n";
      return kWrongUse;
    }
    if (!options.context.empty() && !options.implementations.empty()) {
      std::cerr << "evalcts: --context takes the place of --implementation; give one of them\n";
      return kWrongUse;
    }
  } else {
    for (const std::string& name : default_implementations()) chosen.push_back({name, "", ""});
  }
  if (!options.label.empty() && chosen.size() != 1) {
    std::cerr << "evalcts: --name labels one implementation; name only that one\n";
    return kWrongUse;
  }
  if (!options.label.empty() && !is_file_name(options.label)) {
    std::cerr
        << "evalcts: --name becomes part of file names: letters, digits, '-', '_' and '.' only, at most "
        << kLongestLabel << "\n";
    return kWrongUse;
  }
  for (const ImplementationOptions& implementation : chosen) {
    bool known = implementation.name.empty();
    for (const ImplementationKind& kind : implementation_kinds())
      known = known || kind.name == implementation.name;
    if (known) continue;
    std::cerr << fmt::format("evalcts: there is no implementation '{}'; see 'evalcts list implementations'\n",
                             implementation.name);
    return kWrongUse;
  }

  if (const std::string wrong = wrong_reading(options.interpretations); !wrong.empty()) {
    std::cerr << "evalcts: " << wrong << "; see 'evalcts list interpretations'\n";
    return kWrongUse;
  }
  request.readings = options.interpretations;

  const FolderLock lock = claim(output, options.command);

  if (options.baseline != "none") {
    const ChosenBaseline wanted = baseline_of(options.baseline, where.baselines);
    if (!options.write_baseline && !fs::is_directory(wanted.folder)) {
      std::cerr << fmt::format(
          "evalcts: --baseline '{}': not a directory, a baseline in a directory "
          "(DIR/NAME, for DIR/NAME-fails.txt), the name of a shipped baseline, or 'none'\n",
          options.baseline);
      return kWrongUse;
    }
    request.baselines = BaselineFiles::read_all(wanted.folder);
    request.baseline = wanted.name;
  }

  const std::vector<ListedTest> all_tests = list_tests(where.suite_program);
  request.tests = matching(all_tests, options.filter);
  if (options.filter.empty())
    std::erase_if(request.tests, [&](const ListedTest& test) { return test.from > request.depth; });
  if (request.tests.empty()) {
    std::cerr << fmt::format("evalcts: no test matches '{}'; see 'evalcts list tests'\n", options.filter);
    return kWrongUse;
  }
  if (!options.shard.empty()) {
    request.shard = Shard::parse(options.shard, "/");
    request.tests = request.shard->part_of(request.tests);
  }
  if (options.shuffle)
    std::shuffle(request.tests.begin(), request.tests.end(), std::mt19937(*options.shuffle));

  stop_when_asked();
  adopt_what_children_leave();
  ProgressLine line(options.quiet);
  std::vector<RunResult> results;
  int code = kNothingUnexpected;
  // Side by side: each implementation has processes of its own. Their summaries come in the order asked for.
  // A second pass follows the first of the same implementation.
  std::vector<std::future<std::vector<RunResult>>> running;
  for (const ImplementationOptions& implementation : chosen) {
    request.implementation = implementation;
    request.name = !options.label.empty()        ? options.label
                   : implementation.name.empty() ? "library"
                                                 : implementation.name;
    running.push_back(std::async(std::launch::async, [request, &line, &options]() mutable {
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
      return passes;
    }));
  }
  for (auto& future : running) {
    std::vector<RunResult> passes;
    try {
      passes = future.get();
    } catch (const CannotWrite& problem) {
      line.print("");
      std::cerr << fmt::format("evalcts: {}\n", problem.what());
      code = std::max(code, kWrongUse);
    }
    for (RunResult& result : passes) {
      const std::string label = result.file_label();
      if (options.baseline != "none" && result.has_started()) {
        Baseline baseline =
            Baseline::best_fit(request.baselines, result.implementation, result.pass, request.baseline);
        // A baseline that was chosen for one pass leaves the other pass alone.
        if (options.write_baseline && (request.baseline.empty() || baseline.has_part(request.baseline))) {
          const BaselineFiles renewed = baseline.renewed(result, request.baseline, label);
          if (!baseline.name().empty() || !renewed.entries.empty())
            renewed.write(baseline_of(options.baseline, where.baselines).folder);
          baseline = baseline.with(renewed);
        }
        baseline.apply(result);
        result.stale_baseline_entries = baseline.stale_entries(all_tests);
        write_atomically(output / fmt::format("results-{}.json", label), to_text(result));
      }
      write_atomically(output / fmt::format("junit-{}.xml", label), reports::junit(result));
      line.print(options.quiet ? reports::terminal_line(result, shows_colour())
                               : reports::terminal_summary(result, catalogue(), shows_colour(),
                                                           options.verbose, screen_of(STDOUT_FILENO).lines) +
                                     "\n");
      code = std::max(code, exit_code_of(result, named, options.strict));
      if (result.status == RunStatus::kInterrupted) code = std::max(code, kWrongUse);
      results.push_back(std::move(result));
    }
  }
  write_pages(output, results, {});
  if (!options.quiet) std::cout << fmt::format("Report: {}\n", (output / "index.html").string());
  if (interrupted) {
    std::cerr << "evalcts: interrupted; what was obtained is in the output folder\n";
    code = std::max(code, kWrongUse);
  }
  return code;
}

}  // namespace evalcts::cli
