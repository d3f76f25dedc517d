#include "harness/cli/recorded.h"

#include <evalcts/reports.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <string_view>

namespace evalcts::cli {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestName = 200;  // bytes of a file's name
constexpr double kLongestTimeout = 1e6;    // seconds

bool is_word(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

// A member that is null is as good as missing.
void drop_nulls(json& value) {
  if (!value.is_structured()) return;
  for (auto member = value.begin(); member != value.end();) {
    drop_nulls(*member);
    member = value.is_object() && member->is_null() ? value.erase(member) : std::next(member);
  }
}

}  // namespace

bool Candidate::failed() const {
  const std::string verdict = test["verdict"];
  return verdict == "fail" || verdict == "crash" || verdict == "timeout";
}

std::vector<Candidate> candidates_of(json run) {
  try {
    reports::terminal_line(run, false);  // reads all of it
  } catch (const reports::FormatError& problem) {
    throw BadResults(problem.what());
  }
  drop_nulls(run);
  const auto lacks = [](const char* what) { return BadResults(fmt::format("{} is missing", what)); };
  if (run.value("format", "") != "evalcts-results-1") throw lacks("the format 'evalcts-results-1'");
  if (!run.contains("implementation") || !run["implementation"].value("name", json()).is_string())
    throw lacks("implementation.name");
  if (!run.contains("tests") || !run["tests"].is_array()) throw lacks("tests");
  if (run.contains("timeout")) {
    const json& timeout = run["timeout"];
    if (!timeout.is_number() || !(timeout.get<double>() > 0) || timeout.get<double>() > kLongestTimeout)
      throw BadResults("timeout: expected a number of seconds");
  }
  if (run.contains("pass")) return {};
  const json list = std::move(run["tests"]);
  run.erase("tests");
  std::vector<Candidate> tests;
  for (json test : list) {
    if (!test.contains("name") || !test["name"].is_string()) throw lacks("the name of a test");
    if (!test.contains("verdict") || !test["verdict"].is_string()) throw lacks("the verdict of a test");
    tests.push_back({run, std::move(test)});
  }
  return tests;
}

std::vector<std::string> replay_options(const json& run) {
  static const std::set<std::string_view> kHarmless = {"--implementation", "--library", "--context",
                                                       "--depth",          "--seed",    "--interpretation"};
  const json command = run.value("suite_command", json());
  if (!command.is_array() || command.size() % 2 == 0 ||
      !std::ranges::all_of(command, [](const json& word) { return word.is_string(); }))
    throw BadResults("suite_command: expected a program and pairs of options and values");
  std::vector<std::string> options;
  for (std::size_t i = 1; i < command.size(); i += 2) {
    const std::string option = command[i], value = command[i + 1];
    if (!kHarmless.contains(option) || value.starts_with("-"))
      throw BadResults(fmt::format("suite_command: '{} {}' is nothing that judges", option, value));
    options.insert(options.end(), {option, value});
  }
  std::string captures;
  for (const json& capture : run["implementation"].value("captures", json::array())) {
    const std::string name = capture.value("name", "");
    if (!capture.value("available", false)) continue;
    if (!is_word(name)) throw BadResults(fmt::format("implementation.captures: '{}' is no capture", name));
    captures += (captures.empty() ? "" : ",") + name;
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
