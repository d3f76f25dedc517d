// A command of evalcts: its options, and what it does. Each stands in a file of its own, with a definition
//   const Command kFuzzCommand = {"fuzz", "random programs ...", R"(  $ evalcts fuzz ...)", define_fuzz};
// and is named below and in kCommands of command_line.cpp.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace evalcts::cli {

// Exit codes.
inline constexpr int kNothingUnexpected = 0;
inline constexpr int kUnexpected = 1;  // a fail, crash or timeout
inline constexpr int kWrongUse = 2;    // or what was asked for cannot be started, read, written or observed
inline constexpr int kOwnFault = 3;    // a fault of evalcts itself

// A call of evalcts.
struct Call {
  std::string program;  // "./evalcts"
  std::string command;  // as typed: "evalcts run --depth quick"
  std::string shard;    // "K/N" if GoogleTest's variables ask for a part of the tests; known to actions only
};

struct Command {
  const char* name;
  const char* description;
  const char* examples;  // for the help, a line each; may be empty
  // Adds the options of the command to its part of the command line, and returns what carries the command out
  // once they are parsed. That returns an exit code. `call` lives until then.
  std::function<int()> (*define)(CLI::App& app, const Call& call);
};

extern const Command kRunCommand, kBugsCommand, kListCommand, kCoverageCommand, kExplainCommand,
    kReproduceCommand, kReportCommand, kFaultsCommand, kFuzzCommand, kRoundingCommand, kUlpCommand,
    kVectorsCommand;

// Options that several commands have.

// An option that may be repeated, with one value each time.
CLI::Option* add_repeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                            const std::string& description);
// --shard K/N
CLI::Option* add_shard(CLI::App& app, std::string& shard, const std::string& description);
// --allow-unobserved
CLI::Option* add_allow_unobserved(CLI::App& app, bool& allow);

// Checks of options: a number above 0, and one from 0 on. By itself the parser takes -1 for 2^64 - 1.
std::string positive_number(const std::string& text);
std::string number_from_zero(const std::string& text);

// Prints "evalcts: " and the message to standard error, and returns kWrongUse.
int wrong_use(const std::string& message);

// Prints to standard error, and returns true, if less than half of the `asked` things ("tests") could be
// observed on the implementation.
bool warn_if_mostly_unobserved(const std::string& implementation, std::uint64_t observed, std::uint64_t asked,
                               const char* things);

}  // namespace evalcts::cli
