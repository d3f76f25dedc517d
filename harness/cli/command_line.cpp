// Parses the command line of evalcts and runs the chosen command.
#include <evalcts/cli/command_line.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/conclusion.h>
#include <evalcts/results/files.h>
#include <evalcts/results/text.h>
#include "environment.h"
#include "help.h"
#include "recorded.h"
#include "result_files.h"

namespace evalcts::cli {

namespace {

Call call_of(int argc, char** argv) {
  // If the launcher script started this program, messages must show the launcher's name.
  const char* const launcher = std::getenv("EVALCTS_LAUNCHER");
  Call call = {launcher && *launcher ? launcher : argc > 0 ? argv[0] : "evalcts", "evalcts", ""};
  for (int i = 1; i < argc; ++i) call.command += std::string(" ") + argv[i];
  return call;
}

// Carries out the command. Exceptions become messages and exit codes.
int carry_out(const std::function<int()>& command, Call& call) {
  const auto complain = [](const std::exception& error, int code, const char* advice = "") {
    std::cerr << "evalcts: " << error.what() << advice << "\n";
    return code;
  };
  try {
    call.shard = shard_of_environment();
    forget_googletest();
    allocate_in_huge_pages();
    return command();
  } catch (const CannotStart& error) {
    return complain(error, kWrongUse);
  } catch (const BadEnvironment& error) {
    return complain(error, kWrongUse);
  } catch (const BadBaseline& error) {
    return complain(error, kWrongUse);
  } catch (const NotRecorded& error) {
    return wrong_use(clean(error.what()));
  } catch (const CannotReadResults& error) {
    return wrong_use(clean(error.what()));
  } catch (const FormatError& error) {
    return wrong_use("the result file does not follow its schema: " + clean(error.what()));
  } catch (const CannotWrite& error) {
    return complain(error, kWrongUse, "; free some space, or choose another folder with --output");
  } catch (const std::exception& error) {
    return complain(error, kOwnFault);
  }
}

}  // namespace

CLI::Option* add_repeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                            const std::string& description) {
  return app.add_option(name, values, description)->expected(1)->take_all();
}

CLI::Option* add_shard(CLI::App& app, std::string& shard, const std::string& description) {
  return app.add_option("--shard", shard, description)->check([](const std::string& text) {
    return Shard::parse(text, "/") ? std::string() : "'" + text + "' is not K/N with 1 <= K <= N";
  });
}

CLI::Option* add_worker(CLI::App& app, std::string& worker) {
  return app.add_option("--worker", worker,
                        "shell command that starts evalcts-suite elsewhere, where the implementation is: "
                        "\"ssh host evalcts-suite\", \"wine evalcts-worker.exe\"");
}

namespace {
void add_common_options(CLI::App& app, ImplementationOptions& implementation) {
  app.add_option("--library", implementation.library, "shared library to judge instead of the system's");
  app.add_option(
      "--context", implementation.context,
      fmt::format("interface that creates the contexts, instead of that of an implementation: {}, "
                  "or the path of a provider; the library itself creates them if it has the interface",
                  fmt::join(evalcts::context_names(), ", ")));
  app.add_option("--mesa-build", implementation.mesa_build,
                 "folder that meson built or installed a Mesa into, which is judged instead of the system's");
  add_worker(app, implementation.worker);
}

constexpr char kImplementation[] = "implementation to judge (see 'evalcts list implementations')";
}  // namespace

void add_implementation(CLI::App& app, ImplementationOptions& implementation) {
  app.add_option("--implementation", implementation.name, kImplementation);
  add_common_options(app, implementation);
}

void add_implementations(CLI::App& app, std::vector<std::string>& names, ImplementationOptions& common) {
  add_repeatable(app, "--implementation", names, std::string(kImplementation) + "; may be repeated");
  add_common_options(app, common);
}

ImplementationOptions completed(ImplementationOptions implementation) {
  const auto make_absolute = [](std::string& path) {
    path = std::filesystem::absolute(path).lexically_normal().string();
  };
  const bool is_here = implementation.worker.empty();
  if (is_here && implementation.library.find('/') != std::string::npos) make_absolute(implementation.library);
  if (implementation.mesa_build.empty()) return implementation;
  if (is_here) make_absolute(implementation.mesa_build);
  if (implementation.name.empty() && implementation.library.empty() && implementation.context.empty())
    implementation.name = "egl";
  return implementation;
}

std::vector<ImplementationOptions> completed(const std::vector<std::string>& names,
                                             const ImplementationOptions& common) {
  const ImplementationOptions whole = completed(common);
  std::vector<ImplementationOptions> all;
  for (const std::string& name : names) {
    all.push_back(whole);
    all.back().name = name;
    if (name == "production" || name == "reference") all.back().mesa_build.clear();
  }
  if (all.empty() && !(whole.library + whole.context + whole.mesa_build).empty()) all.push_back(whole);
  if (all.empty() && !whole.worker.empty())
    throw CannotStart("--worker needs --implementation or --library, which say what to open there");
  return all;
}

CLI::Option* add_allow_unobserved(CLI::App& app, bool& allow) {
  return app.add_flag("--allow-unobserved", allow,
                      "exit code 0 even if most of the requested work cannot be observed");
}

namespace {
// Returns the number in the text, or NaN if the text is not a number.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? number : std::numeric_limits<double>::quiet_NaN();
}
}  // namespace

std::string positive_number(const std::string& text) {
  return number_in(text) > 0 ? std::string() : fmt::format("'{}' is not a number above 0", text);
}

std::string number_from_zero(const std::string& text) {
  return number_in(text) >= 0 ? std::string() : fmt::format("'{}' is not a number of 0 or more", text);
}

int wrong_use(const std::string& message) {
  std::cerr << "evalcts: " << message << "\n";
  return kWrongUse;
}

bool warn_if_mostly_unobserved(const std::string& implementation, std::uint64_t observed, std::uint64_t asked,
                               const char* things) {
  if (!is_mostly_unobserved(observed, asked)) return false;
  std::cerr << fmt::format(
      "evalcts: {}: only {} of {} {} could be observed, which is not a pass; --allow-unobserved accepts "
      "this with exit code 0\n",
      implementation, observed, asked, things);
  return true;
}

int command_line(int argc, char** argv, const std::vector<Command>& commands, bool only_parse) {
  const auto named = std::ranges::find(commands, std::string_view(argc > 1 ? argv[1] : ""),
                                       [](const Command& command) { return std::string_view(command.name); });
  if (named != commands.end() && !named->define) {
    become("evalcts-lab");
    return wrong_use(
        fmt::format("'{}' needs the program evalcts-lab, which is not beside this one", named->name));
  }
  CLI::App app{"evalcts: conformance test suite and reference oracle for OpenGL evaluators", "evalcts"};
  app.formatter(help_formatter());
  app.footer(
      "'evalcts COMMAND --help' shows the options of a command with examples.\n"
      "Exit codes: 0 nothing unexpected; 1 an unexpected fail, crash or timeout; 2 wrong usage, or\n"
      "something could not be started, read, written or observed; 3 an internal error of evalcts.");
  app.set_version_flag("--version", "evalcts " EVALCTS_VERSION, "print the version and exit");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.require_subcommand(1);
  Call call = call_of(argc, argv);
  std::function<int()> chosen;
  for (const Command& command : commands) {
    CLI::App* const part = app.add_subcommand(command.name, command.description);
    if (!command.define) continue;
    part->footer(std::string("Examples:\n") + command.examples);
    part->parse_complete_callback([&chosen, action = command.define(*part, call)] { chosen = action; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string words = suggestion(app, {argv + std::min(argc, 1), argv + argc});
    // For a mistyped command, the suggestion replaces CLI11's message that a subcommand is required.
    const bool is_replaced =
        !words.empty() && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError);
    if (!is_replaced && app.exit(error) == 0) return kNothingUnexpected;
    if (!words.empty()) std::cerr << words << "\n";
    return kWrongUse;
  }
  return only_parse ? kNothingUnexpected : carry_out(chosen, call);
}

}  // namespace evalcts::cli
