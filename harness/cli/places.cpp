// Finds the programs and data of evalcts relative to the running program, and locks the output folder.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/places.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {

namespace fs = std::filesystem;

namespace {

// Returns the folder that $EVALCTS_OUTPUT names, or else the usual one.
fs::path output_folder(const fs::path& usual) {
  const char* const chosen = std::getenv("EVALCTS_OUTPUT");
  return chosen && *chosen ? fs::path(chosen) : usual;
}

}  // namespace

Places places() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  // In a checkout, the program is in build/PRESET/harness/cli.
  const fs::path top = fs::weakly_canonical(folder / "../../../..");
  if (fs::exists(top / "reports/schema") && fs::exists(top / "suites/requirements.json"))
    return {.suite_program = folder / "evalcts-suite",
            .faulty_suite_program = folder / "evalcts-faulty-suite",
            .output = output_folder(top / "reports/out"),
            .vectors = top / "vectors",
            .production_headers = top / "production/include",
            .production_library = fs::weakly_canonical(folder / "../../production/libglevaluator.a"),
            .recorder = fs::weakly_canonical(folder / "../record/preload/libevalcts_record.so")};
  const fs::path data = fs::weakly_canonical(folder / EVALCTS_DATA_FROM_PROGRAMS);
  return {.suite_program = folder / "evalcts-suite",
          .faulty_suite_program = folder / "evalcts-faulty-suite",
          .output = output_folder(fs::current_path() / "evalcts-results"),
          .vectors = data / "vectors",
          .production_headers = {},
          .production_library = {},
          .recorder =
              fs::weakly_canonical(folder / EVALCTS_LIBRARIES_FROM_PROGRAMS "/evalcts/libevalcts_record.so")};
}

void become(const std::string& program) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv((fs::read_symlink("/proc/self/exe").parent_path() / program).c_str(), pointers.data());
}

FolderLock claim(const fs::path& output, const std::string& command) {
  std::error_code error;
  fs::create_directories(output, error);
  if (error || access(output.c_str(), W_OK) != 0)
    throw CannotStart(
        fmt::format("cannot write into '{}'; choose another folder with --output", output.string()));
  try {
    return {output, fmt::format("process {}: {}", getpid(), command)};
  } catch (const FolderInUse& problem) {
    throw CannotStart(
        fmt::format("{}; wait for it, or choose another folder with --output", clean(problem.what())));
  }
}

}  // namespace evalcts::cli
