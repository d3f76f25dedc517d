// A question to the suite program, answered by a process of its own, which may crash or hang in the library.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/serialization.h>
#include <evalcts/runner/child_process.h>

namespace evalcts {

class Question {
 public:
  // Starts the suite program: `command` with what is asked. Its output goes to `log` (empty: thrown away). It
  // is killed if it takes more than `memory` bytes (0: no limit). Throws std::runtime_error.
  Question(std::vector<std::string> command, const std::filesystem::path& log = {}, std::uint64_t memory = 0);
  ~Question();
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

  // Waits for the answer, as `parse` reads it, which returns an optional. If there is none, `reason` says
  // why.
  template <class Parse>
  auto answer(Parse parse, std::string& reason) -> decltype(parse(std::string())) {
    const std::optional<std::string> text = wait(reason);
    if (!text) return std::nullopt;
    auto value = parse(*text);
    if (!value) reason = how_it_ended();
    return value;
  }

 private:
  std::optional<std::string> wait(std::string& reason);
  std::string how_it_ended() const;
  std::string quote_output() const;

  std::filesystem::path answer_file_, log_;
  std::uint64_t memory_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::optional<ChildProcess> child_;
  Ending ending_;
};

// Describes the implementation that the command opens; if it does not start, `reason` says why.
std::optional<Description> describe_implementation(const std::vector<std::string>& suite_command,
                                                   std::string& reason);

// All tests of the suite program. Throws std::runtime_error.
std::vector<ListedTest> list_tests(const std::filesystem::path& suite_program);

}  // namespace evalcts
