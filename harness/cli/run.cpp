#include <evalcts/reports.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <cstdlib>
#include <future>
#include <iostream>
#include <map>
#include <mutex>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/runner/baseline.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

void stop_when_asked() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

// One line that is written over, on terminals only, with the progress of all that run side by side.
class ProgressLine {
 public:
  void show(const std::string& name, const Progress& progress) {
    if (!terminal_) return;
    const std::lock_guard lock(mutex_);
    state_[name] =
        progress.phase == "test" ? fmt::format("{} of {}", progress.done, progress.total) : progress.phase;
    std::string line;
    for (const auto& [implementation, state] : state_)
      line += fmt::format("{}{}: {}", line.empty() ? "" : "   ", implementation, state);
    if (line.size() > 99) line.resize(99);
    std::cerr << "\r\033[K" << line << std::flush;
  }
  // Prints whole lines without the progress line getting in between.
  void print(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (terminal_) std::cerr << "\r\033[K" << std::flush;
    std::cout << text << std::flush;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::mutex mutex_;
  std::map<std::string, std::string> state_;
};

int exit_code_of(const json& result, bool named, bool strict) {
  if (result["status"] == "not-started") return named ? kWrongUse : kNothingUnexpected;
  int code = kNothingUnexpected;
  for (const json& test : result["tests"]) {
    const std::string verdict = test["verdict"];
    if (verdict == "internal-error") return kOwnFault;
    const bool failed = verdict == "fail" || verdict == "crash" || verdict == "timeout";
    if (failed && !test["expected_by_baseline"].get<bool>()) code = kUnexpected;
    if (strict && verdict == "pass" && !test["baseline_reason"].get<std::string>().empty())
      code = kUnexpected;
  }
  return code;
}

bool is_file_name(const std::string& label) {
  for (const char c : label)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') return false;
  return !label.empty() && label[0] != '.' && label[0] != '-';
}

}  // namespace

int run(const RunOptions& options) {
  const Places where = places();
  const fs::path output = options.output.empty() ? where.output : fs::path(options.output);

  RunRequest request;
  request.suite_program = where.suite_program;
  request.depth = options.depth;
  request.seed = options.seed;
  request.seconds_per_test = options.seconds_per_test;
  request.output = output;
  request.command = options.command;
  request.program = options.program;
  request.own_output = !options.output.empty();
  // The commands that a failure is shown with work from everywhere.
  const std::string library = options.library.find('/') == std::string::npos
                                  ? options.library
                                  : fs::absolute(options.library).lexically_normal().string();

  std::vector<ImplementationOptions> chosen;
  const bool named = !options.implementations.empty() || !options.library.empty();
  if (named) {
    for (const std::string& name : options.implementations) chosen.push_back({name, library});
    if (options.implementations.empty()) chosen.push_back({"", library});
    if (!options.library.empty() && chosen.size() != 1) {
      std::cerr << "evalcts: --library replaces the library of one implementation; name only that one\n";
      return kWrongUse;
    }
  } else {
    for (const ImplementationKind& kind : implementation_kinds()) chosen.push_back({kind.name, ""});
  }
  if (!options.label.empty() && chosen.size() != 1) {
    std::cerr << "evalcts: --name labels one implementation; name only that one\n";
    return kWrongUse;
  }
  if (!options.label.empty() && !is_file_name(options.label)) {
    std::cerr << "evalcts: --name becomes part of file names: letters, digits, '-', '_' and '.' only\n";
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

  std::error_code error;
  fs::create_directories(output, error);
  if (error || access(output.c_str(), W_OK) != 0) {
    std::cerr << fmt::format("evalcts: cannot write into '{}'; choose another folder with --output\n",
                             output.string());
    return kWrongUse;
  }

  // A library of the user's own has no shipped baseline.
  const bool shipped = options.baseline.empty();
  const fs::path baselines = shipped ? where.baselines : fs::path(options.baseline);
  const bool with_baseline = options.baseline != "none" && !(shipped && !options.library.empty());
  if (!shipped && with_baseline && !options.write_baseline && !fs::is_directory(baselines)) {
    std::cerr << fmt::format("evalcts: --baseline '{}' is no folder\n", options.baseline);
    return kWrongUse;
  }

  const json all_tests = list_tests(where.suite_program);
  request.tests = matching(all_tests, options.filter);
  if (request.tests.empty()) {
    std::cerr << fmt::format("evalcts: no test matches '{}'; see 'evalcts list tests'\n", options.filter);
    return kWrongUse;
  }

  stop_when_asked();
  const bool color = isatty(STDOUT_FILENO) && !std::getenv("NO_COLOR");
  ProgressLine line;
  std::vector<json> results;
  int code = kNothingUnexpected;
  // Side by side: each implementation has processes of its own. Their summaries come in the order asked for.
  std::vector<std::future<json>> running;
  for (const ImplementationOptions& implementation : chosen) {
    request.implementation = implementation;
    request.name = !options.label.empty()        ? options.label
                   : implementation.name.empty() ? "library"
                                                 : implementation.name;
    running.push_back(std::async(std::launch::async, [request, &line] {
      return run_implementation(request,
                                [&](const Progress& progress) { line.show(request.name, progress); });
    }));
  }
  for (std::future<json>& future : running) {
    json result = future.get();
    const std::string name = result["implementation"]["name"];
    if (with_baseline && result["status"] != "not-started") {
      Baseline baseline = Baseline::find(baselines, result["implementation"]);
      if (options.write_baseline) {
        baseline = baseline.renewed(result, name);
        if (!baseline.entries().empty() || !baseline.name().empty()) baseline.write(baselines);
      }
      baseline.apply(result);
      for (const std::string& stale : baseline.stale_entries(all_tests)) {
        line.print(fmt::format("baseline {}: there is no test {} any more\n", baseline.name(), stale));
        if (options.strict) code = std::max(code, kUnexpected);
      }
      write_atomically(output / fmt::format("results-{}.json", name), to_text(result));
    }
    write_atomically(output / fmt::format("junit-{}.xml", name), reports::junit(result));
    line.print(reports::terminal_summary(result, catalogue(), color, options.verbose) + "\n");
    code = std::max(code, exit_code_of(result, named, options.strict));
    results.push_back(result);
  }
  write_atomically(output / "index.html", reports::html(results, catalogue()));
  std::cout << fmt::format("Report: {}\n", (output / "index.html").string());
  if (interrupted) {
    std::cerr << "evalcts: interrupted; what was obtained is in the output folder\n";
    code = std::max(code, kWrongUse);
  }
  return code;
}

}  // namespace evalcts::cli
