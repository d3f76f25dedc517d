// Starts the program as its users do, for tests of the command line.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <evalcts/results/files.h>
#include <evalcts/results/json.h>
#include <evalcts/runner/child_process.h>
#include "contains.h"

namespace evalcts {

struct Outcome {
  int code;
  std::string text;  // standard output and standard error
};

// A test with its own folder for the files of the program.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest()
      : folder_(std::filesystem::path(testing::TempDir()) / ("evalcts-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    setenv("EVALCTS_OUTPUT", (folder_ / "runs").c_str(), 1);
  }
  ~ProgramTest() override {
    unsetenv("EVALCTS_OUTPUT");
    unsetenv("EVALCTS_DRILL");
    std::filesystem::remove_all(folder_);
  }

  Outcome start(const std::vector<std::string>& command) {
    const std::filesystem::path log = folder_ / "command.log";
    std::filesystem::remove(log);
    ChildProcess child(command, log.string());
    const auto ending = child.wait(240);
    return {ending && !ending->signalled ? ending->value : -1, read_file(log)};
  }
  // Runs evalcts. `evalcts run` does not reduce failures to bugs unless reduces_failures_ is true, because
  // the reduction takes most of the time.
  Outcome evalcts(std::vector<std::string> arguments) {
    if (!reduces_failures_ && !arguments.empty() && arguments[0] == "run")
      arguments.emplace_back("--no-bugs");
    arguments.insert(arguments.begin(), EVALCTS_PROGRAM);
    return start(arguments);
  }

  // Runs tests with the suite program, which takes a fraction of the time of `evalcts run`. Returns the
  // verdict of each: "pass", "fail", or why it was not judged ("not-observable").
  std::map<std::string, std::string> verdicts(const std::vector<std::string>& options,
                                              const std::string& filter) {
    std::vector<std::string> command = {EVALCTS_PROGRAM + std::string("-suite"), "--gtest_filter=" + filter};
    command.insert(command.end(), options.begin(), options.end());
    std::istringstream lines(start(command).text);
    std::map<std::string, std::string> all;
    std::string why;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("[") && !line.ends_with(" ms)")) continue;
      const auto name = [&] { return line.substr(13, line.find_first_of(" ,", 13) - 13); };
      if (line.starts_with("[       OK ] ")) all[name()] = "pass";
      if (line.starts_with("[  FAILED  ] ")) all[name()] = "fail";
      if (line.starts_with("[  SKIPPED ] ")) all[name()] = why;
      if (!line.empty()) why = line.substr(0, line.find(':'));
    }
    return all;
  }

  // Return the content of a file in the folder.
  std::string text_of(const std::string& name) const { return read_file(folder_ / name); }
  nlohmann::json json_of(const std::string& name) const { return parse_json(text_of(name)); }
  nlohmann::json results(const std::string& name) const { return json_of("results-" + name + ".json"); }
  static nlohmann::json test_named(const nlohmann::json& result, const std::string& name) {
    for (const nlohmann::json& test : result["tests"])
      if (as_text(test["name"]) == name) return test;
    return nullptr;
  }

  std::filesystem::path folder_;
  bool reduces_failures_ = false;
};

}  // namespace evalcts
