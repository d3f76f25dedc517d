// Declares the commands of evalcts, such as `evalcts fuzz`, and helpers for them. Each command has its own
// file with a definition
//   const Command kFuzzCommand = {"fuzz", "random programs ...", R"(  $ evalcts fuzz ...)", define_fuzz};
// A new command is also declared below and added to the list in main.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>

// CLI/App.hpp is not included here, because CLI11 takes seconds to compile.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace evalcts::cli {

// Exit codes.
inline constexpr int kNothingUnexpected = 0;
inline constexpr int kUnexpected = 1;  // a fail, crash or timeout
inline constexpr int kWrongUse = 2;    // wrong use, or something cannot be started, read, written or observed
inline constexpr int kOwnFault = 3;    // an internal error of evalcts

// A call of evalcts.
struct Call {
  std::string program;  // "./evalcts"
  std::string command;  // the typed command: "evalcts run --depth quick"
  std::string shard;    // "K/N" if GoogleTest's variables select a part of the tests; unset in define()
};

struct Command {
  const char* name;
  const char* description;
  const char* examples;  // for the help, one per line; may be empty
  // Adds the options of the command to `app`. Returns the action of the command, which is called after the
  // options have been parsed and returns an exit code. `call` lives until the action ends. Null: the program
  // evalcts-lab has the command.
  std::function<int()> (*define)(CLI::App& app, const Call& call);
};

extern const Command kRunCommand, kBugsCommand, kListCommand, kCoverageCommand, kExplainCommand,
    kReproduceCommand, kReportCommand, kWaiveCommand, kCheckCommand, kRecordCommand, kFaultsCommand,
    kFuzzCommand;

// Commands of evalcts-lab, a program of its own because most users do not need it. In evalcts they have no
// definition.
inline constexpr Command kUlp = {
    "ulp", "measure the errors of implementations in ULP, and relative to the condition of the problem", "",
    nullptr};
inline constexpr Command kVectors = {
    "vectors", "write and check golden vectors, and judge the answers of other programs by them", "",
    nullptr};
inline constexpr Command kConvert = {
    "convert", "make a recording of a trace of apitrace; vectors, C programs or meshes of a recording", "",
    nullptr};

// Options of several commands.

// Adds an option that may be repeated, with one value each time.
CLI::Option* add_repeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                            const std::string& description);
// Adds --implementation, --library, --context and --mesa-build, which choose one implementation.
void add_implementation(CLI::App& app, ImplementationOptions& implementation);
// Adds --worker, which is one of these options.
CLI::Option* add_worker(CLI::App& app, std::string& worker);
// Adds the same options for several implementations: --implementation may be repeated.
void add_implementations(CLI::App& app, std::vector<std::string>& names, ImplementationOptions& common);
// Returns the options with absolute paths, which work in any directory; the name of a library without '/',
// which the dynamic linker looks up, stays as it is. With --mesa-build alone, the implementation is egl.
ImplementationOptions completed(ImplementationOptions implementation);
// Returns the implementations that the options of add_implementations() choose, with absolute paths; none if
// no option was given.
std::vector<ImplementationOptions> completed(const std::vector<std::string>& names,
                                             const ImplementationOptions& common);
// Adds --shard K/N.
CLI::Option* add_shard(CLI::App& app, std::string& shard, const std::string& description);
// Adds --allow-unobserved.
CLI::Option* add_allow_unobserved(CLI::App& app, bool& allow);

// Check the value of an option, which must be positive, or 0 or more. Return an error message, or an empty
// string. They are needed because the parser reads -1 as 2^64 - 1.
std::string positive_number(const std::string& text);
std::string number_from_zero(const std::string& text);

// Prints "evalcts: " and the message to standard error, and returns kWrongUse.
int wrong_use(const std::string& message);

// If fewer than half of the `asked` things ("tests") could be observed on the implementation, prints a
// warning to standard error and returns true.
bool warn_if_mostly_unobserved(const std::string& implementation, std::uint64_t observed, std::uint64_t asked,
                               const char* things);

}  // namespace evalcts::cli
