// `evalcts vectors`: writes and checks the shipped vector files, and starts the pipe of vectors_pipe.cpp.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/requirements.h>
#include <evalcts/runner/worker.h>
#include <evalcts/vectors/lint.h>
#include <evalcts/vectors/write.h>
#include "lab.h"
#include "vectors.h"

namespace evalcts::cli {

namespace fs = std::filesystem;

namespace {

// Minimum number of cases in all shipped files together.
constexpr std::size_t kFewestCases = 5000;

// Returns the content of the file. Throws vectors::Malformed.
std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (!stream || fs::is_directory(file) || !(content << stream.rdbuf()))
    throw vectors::Malformed("cannot be read");
  return content.str();
}

// Suites about values, which have files of their own, and about relations between two cases.
constexpr char kSuitesOfValues[] = "Map1Values.*:Map2Values.*:Metamorphic.*:Numeric.*:Map?Accuracy.*";

// Returns the cases of the tests of quick depth, in the order of their names. Only what citable text demands
// is in the vectors, so tests of other levels are left out. Throws std::runtime_error.
std::vector<vectors::SuiteCase> cases_of_suite() {
  std::map<std::string, std::vector<std::string>> requirements;
  std::vector<std::string> names;
  for (const ListedTest& test : list_tests(places().suite_program)) {
    if (test.level != Level::kMust || test.from != Depth::kQuick || is_chosen(test.name, kSuitesOfValues))
      continue;
    names.push_back(test.name);
    for (const RequirementId& each : test.requirements) requirements[test.name].emplace_back(each.id);
  }
  std::vector<vectors::SuiteCase> cases;
  std::string running, failing;
  const bool is_complete = run_on_specification(names, [&](const Event& event) {
    if (const auto* test = std::get_if<JobStarted>(&event)) running = test->name;
    if (const auto* started = std::get_if<CaseStarted>(&event))
      if (!started->is_control && !started->commands.empty())
        cases.push_back({running, requirements[running], gl::parse_case(started->commands)});
    if (const auto* finished = std::get_if<TestFinished>(&event); finished && finished->record.is_bad())
      failing = finished->record.name;
  });
  if (!failing.empty()) throw std::runtime_error(fmt::format("{} fails on the specification", failing));
  if (!is_complete) throw std::runtime_error("the suite does not run to its end on the specification");
  return cases;
}

}  // namespace

int write_vectors(const VectorsOptions& options) {
  const fs::path folder = options.output.empty() ? places().vectors : fs::path(options.output);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK) != 0) {
    return wrong_use(
        fmt::format("cannot write into '{}'; choose another folder with --output", folder.string()));
  }
  std::size_t cases = 0, bytes = 0;
  try {
    vectors::write_all(places().vectors, folder, cases_of_suite, [&](const vectors::WrittenFile& written) {
      std::cout << fmt::format("{:<12} {:>5} cases {:>9} bytes\n", written.kind, written.cases,
                               written.bytes);
      cases += written.cases;
      bytes += written.bytes;
    });
  } catch (const std::runtime_error& problem) {
    return wrong_use(problem.what());
  }
  std::cout << fmt::format("{:<12} {:>5} cases {:>9} bytes\nWritten into {}\n", "all", cases, bytes,
                           folder.string());
  return kNothingUnexpected;
}

int lint_vectors(const VectorsOptions& options) {
  const bool shipped = options.files.empty();
  std::vector<fs::path> files(options.files.begin(), options.files.end());
  if (shipped)
    for (const std::string& kind : vectors::kinds()) files.push_back(places().vectors / (kind + ".json"));

  std::set<std::string> requirements;
  for (const Requirement& requirement : catalogue().requirements) requirements.insert(requirement.id);

  int code = kNothingUnexpected;
  std::size_t cases = 0;
  for (const fs::path& file : files) {
    try {
      const vectors::Report report = vectors::lint(content_of(file), requirements);
      std::cout << fmt::format("{}: {}, {} cases, {} flags\n", file.filename().string(), report.kind,
                               report.cases, report.flags);
      for (const std::string& finding : report.findings)
        std::cout << fmt::format("{}: {}\n", file.string(), finding);
      if (!report.findings.empty()) code = std::max(code, kUnexpected);
      cases += report.cases;
    } catch (const vectors::Malformed& problem) {
      std::cerr << fmt::format("evalcts: {}: {}\n", file.string(), problem.what());
      code = kWrongUse;
    }
  }
  std::cout << fmt::format("{} cases; structure checked by the schema and by hand\n", cases);
  if (shipped && code == kNothingUnexpected && cases < kFewestCases) {
    std::cout << fmt::format("fewer than the expected {} cases\n", kFewestCases);
    code = kUnexpected;
  }
  return code;
}

namespace {

std::function<int()> define_vectors(CLI::App& app, const Call&) {
  const auto options = std::make_shared<VectorsOptions>();
  app.require_subcommand(1);
  CLI::App* const write =
      app.add_subcommand("write", "write the shipped vectors again, with all answers computed");
  write->footer(R"(Examples:
  $ evalcts vectors write
  $ evalcts vectors write --output new)");
  write->add_option("--output", options->output, "folder for the vector files (default: the shipped ones)");
  CLI::App* const lint =
      app.add_subcommand("lint", "check the structure, IDs, requirements and claims of vector files");
  lint->footer(R"(Examples:
  $ evalcts vectors lint
  $ evalcts vectors lint mine.json)");
  lint->add_option("file", options->files, "vector files (default: the shipped ones)");
  CLI::App* const emit = app.add_subcommand(
      "emit",
      "print cases as lines of text for another program to answer: emit | PROGRAM | evalcts vectors check");
  emit->footer(R"(Examples:
  $ evalcts vectors emit | ./mine | evalcts vectors check
  $ evalcts vectors emit --kind grid >cases.txt)");
  CLI::App* const check = app.add_subcommand("check", "judge the answers on standard input");
  check->footer(R"(Examples:
  $ ./mine <cases.txt | evalcts vectors check --kind grid
  $ evalcts vectors emit --seed 7 --count 100000 | ./mine | evalcts vectors check --seed 7 --count 100000)");
  for (CLI::App* command : {emit, check}) {
    command
        ->add_option("--kind", options->kinds,
                     "kind of cases; give the same to emit and check (default: all)")
        ->check(CLI::IsMember({"map1_eval", "map2_eval", "grid", "auto_normal"}));
    CLI::Option* const count =
        command
            ->add_option("--count", options->count,
                         "number of random cases of each kind, which replace the shipped ones")
            ->check(positive_number);
    command->add_option("--seed", options->seed, "seed of the random cases; give the same to emit and check")
        ->needs(count);
  }
  add_allow_unobserved(*check, options->allow_unobserved);
  return [=] {
    return *write  ? write_vectors(*options)
           : *lint ? lint_vectors(*options)
           : *emit ? emit_vectors(*options)
                   : check_vectors(*options);
  };
}

}  // namespace

const Command kVectorsCommand = {
    kVectors.name, kVectors.description,
    R"(  $ evalcts vectors emit --kind grid | ./mine | evalcts vectors check --kind grid
  $ evalcts vectors emit --seed 7 --count 100000 | ./mine | evalcts vectors check --seed 7 --count 100000
  $ evalcts vectors lint mine.json)",
    define_vectors};

}  // namespace evalcts::cli
