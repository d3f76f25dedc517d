// A libFuzzer target for the parsers of files and lines of unknown origin: for any input, a parser must
// return a result or throw its documented exception. The first byte selects the parser of the rest. Run by
// `./evalcts test --preset fuzz`.
#include <evalcts/reports.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/cli/command_line.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/files.h>
#include <evalcts/results/json.h>
#include <evalcts/results/serialization.h>
#include <evalcts/vectors/lint.h>
#include <evalcts/vectors/pipe.h>
#include "cli/recorded.h"
#include "lab/lab.h"

namespace evalcts {
namespace {

using nlohmann::json;

// Reads a file of vectors. A valid file is emitted, and its own text is judged as answers.
void read_vectors(const std::string& text) {
  try {
    vectors::lint(text, {});
    const json file = parse_json(text);
    std::istringstream answers(vectors::emit(file));
    vectors::Answers none = vectors::read_answers(answers);
    vectors::judge(file, none);
  } catch (const vectors::Malformed&) {
  }
}

// Reads answers to a small file of vectors.
void read_answers(const std::string& text) {
  static const json file = [] {
    const char* path = std::getenv("EVALCTS_VECTORS_SAMPLE");
    if (!path) std::abort();
    return parse_json(read_file(path));
  }();
  std::istringstream lines(text);
  vectors::Answers answers = vectors::read_answers(lines);
  vectors::judge(file, answers);
}

void read_case(const std::string& text) {
  const json commands = parse_json(text);
  if (commands.is_discarded()) return;
  try {
    const gl::Case script = gl::case_from_json(commands);
    if (gl::to_json(gl::case_from_json(gl::to_json(script))) != gl::to_json(script)) std::abort();
  } catch (const std::invalid_argument&) {
  }
}

void read_baseline(const std::string& text) {
  static const std::filesystem::path folder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "evalcts-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return std::filesystem::path(name);
  }();
  // The input is divided into the files of a baseline.
  std::istringstream rest(text);
  std::string part;
  for (const char* kind : {"fails", "signatures", "skips", "flakes"}) {
    std::getline(rest, part, '\f');
    std::ofstream(folder / (std::string("x-") + kind + ".txt"), std::ios::binary) << part;
  }
  try {
    const std::vector<BaselineFiles> all = BaselineFiles::read_all(folder);
    const Baseline baseline({.files = all, .name = "x"}, {});
    baseline.skip("Theme.Test/MAP1_VERTEX_3");
  } catch (const BadBaseline&) {
  }
}

// Reads a result file, and uses it in pages, terminal output, merged shards, a comparison with itself,
// and a replay.
void read_results(const std::string& text) {
  try {
    const RunResult result = parse_run_result(text);
    if (to_text(parse_run_result(to_text(result))) != to_text(result)) std::abort();
    const std::string shown = reports::terminal_summary(result, {}, false, true, 24);
    for (const char c : shown)
      if (c != '\n' && static_cast<unsigned char>(c) < 0x20) std::abort();
    reports::junit(result);
    reports::PageOptions options;
    options.before = {result};
    const auto test_commands = [&] {
      for (const cli::Candidate& test : cli::candidates_of(result)) {
        const std::string file = cli::reproducer_name(test.full_name());
        if (file.find('/') != std::string::npos || file.size() > 255) std::abort();
        for (const std::string& option : cli::replay_options(*test.run))
          if (option.starts_with("--worker") || option.starts_with("--events") ||
              option.starts_with("--gtest"))
            std::abort();
      }
    };
    for (const std::function<void()>& use :
         {std::function<void()>(test_commands), std::function<void()>([&] {
            reports::html(reports::merge_shards({result, result}), {}, options);
          }),
          std::function<void()>([&] { reports::markdown_summary({result}, options.before); }),
          std::function<void()>([&] { reports::changes({result}, options.before); })}) {
      try {
        use();
      } catch (const FormatError&) {
      }
    }
  } catch (const FormatError&) {
  }
}

// Parses a command line with one argument per line. It is accepted, or rejected with a message.
void read_command_line(const std::string& text) {
  static std::ostringstream words;
  static const bool quiet = (std::cout.rdbuf(words.rdbuf()), std::cerr.rdbuf(words.rdbuf()), true);
  words.str("");
  std::vector<std::string> arguments = {"evalcts"};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) arguments.push_back(line.substr(0, line.find('\0')));
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  using namespace cli;
  const int code =
      command_line(static_cast<int>(arguments.size()), pointers.data(),
                   {kRunCommand, kBugsCommand, kListCommand, kCoverageCommand, kExplainCommand,
                    kReproduceCommand, kReportCommand, kWaiveCommand, kCheckCommand, kRecordCommand,
                    kFaultsCommand, kFuzzCommand, kUlpCommand, kVectorsCommand, kConvertCommand},
                   true);
  if (!quiet || (code != 0 && code != 2) || (code == 2 && words.str().empty())) std::abort();
}

}  // namespace
}  // namespace evalcts

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0]) {
    case 'v':
      evalcts::read_vectors(text);
      break;
    case 'a':
      evalcts::read_answers(text);
      break;
    case 'c':
      evalcts::read_case(text);
      break;
    case 'b':
      evalcts::read_baseline(text);
      break;
    case 'r':
      evalcts::read_results(text);
      break;
    case 'l':
      evalcts::read_command_line(text);
      break;
    default:
      return -1;  // tells libFuzzer not to keep the input
  }
  return 0;
}
