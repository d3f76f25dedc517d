// Asks the suite program a question, in a separate process, because the library may crash or hang.
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
  // Starts the suite program with `command`, which contains the question. Its output goes to `log` (empty:
  // discarded). The process is killed if it uses more than `memory` bytes (0: no limit) or takes longer than
  // a minute. Throws std::runtime_error.
  Question(std::vector<std::string> command, const std::filesystem::path& log = {}, std::uint64_t memory = 0);
  ~Question();
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

  // Waits for the answer and returns parse(answer), an optional. If there is no answer, `reason` is set to
  // the reason.
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

// Returns the description of the implementation that the command opens. If the implementation does not start,
// returns none and sets `reason`.
std::optional<Description> describe_implementation(const std::vector<std::string>& suite_command,
                                                   std::string& reason);

// Returns all tests of the suite program. Throws std::runtime_error.
std::vector<ListedTest> list_tests(const std::filesystem::path& suite_program);

}  // namespace evalcts
