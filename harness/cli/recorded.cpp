// Selects the tests to replay, and reads the options of the suite program from the results. Unexpected
// options are rejected.
#include "recorded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

namespace evalcts::cli {
namespace {

constexpr std::size_t kLongestName = 200;  // bytes of a test's name in a file name
constexpr double kLongestTimeout = 1e6;    // seconds

bool is_word(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

}  // namespace

std::vector<Candidate> candidates_of(const RunResult& run) {
  if (run.implementation.name.empty()) throw FormatError("implementation.name is missing");
  if (run.timeout && !(*run.timeout > 0 && *run.timeout <= kLongestTimeout))
    throw FormatError("timeout: expected a number of seconds");
  std::vector<Candidate> tests;
  if (run.pass == Pass::kFreshContexts)
    for (const TestRecord& test : run.tests) tests.push_back({&run, &test});
  return tests;
}

std::vector<std::string> replay_options(const RunResult& run) {
  static const std::set<std::string_view> kHarmless = {"--implementation", "--library", "--context",
                                                       "--depth",          "--seed",    "--interpretation"};
  const std::vector<std::string>& command = run.suite_command;
  if (command.size() % 2 == 0)
    throw FormatError("suite_command: expected a program and pairs of options and values");
  std::vector<std::string> options;
  for (std::size_t i = 1; i < command.size(); i += 2) {
    const std::string &option = command[i], &value = command[i + 1];
    if (!kHarmless.contains(option) || value.starts_with("-"))
      throw FormatError(fmt::format("suite_command: '{} {}' is not a command that judges", option, value));
    options.insert(options.end(), {option, value});
  }
  std::string captures;
  for (const CaptureRecord& capture : run.implementation.captures) {
    if (!capture.available) continue;
    if (!is_word(capture.name))
      throw FormatError(fmt::format("implementation.captures: '{}' is not a capture", capture.name));
    captures += (captures.empty() ? "" : ",") + capture.name;
  }
  options.insert(options.end(), {"--captures", captures.empty() ? "none" : captures});
  return options;
}

std::string reproducer_name(const std::string& test) {
  std::string name = test.substr(0, kLongestName);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '-';
  return "reproduce-" + name + ".c";
}

}  // namespace evalcts::cli
