#include "short_program.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <evalcts/backends/implementation.h>
#include <evalcts/backends/mesa_build.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/gl/c_program.h>
#include <evalcts/gl/contexts.h>
#include <evalcts/results/files.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 10;  // time limit for the compilation of a program and for its run

// Returns the libraries that a program loaded, from the files of the dynamic linker in `folder`.
std::vector<std::string> loaded_libraries(const fs::path& folder) {
  constexpr std::string_view kMark = "calling init: ";
  std::vector<std::string> libraries;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    if (file.path().stem() != "loaded") continue;
    std::ifstream lines(file.path());
    for (std::string line; std::getline(lines, line);)
      if (const std::size_t mark = line.find(kMark); mark != std::string::npos)
        libraries.push_back(line.substr(mark + kMark.size()));
  }
  return libraries;
}

}  // namespace

std::string value_of(const std::vector<std::string>& options, const std::string& option) {
  const auto found = std::ranges::find(options, option);
  return found == options.end() ? std::string() : *std::next(found);
}

std::string example_program(const KnownBug& bug, const std::vector<std::string>& options,
                            const std::string& style) {
  const std::string implementation = value_of(options, "--implementation"),
                    library = value_of(options, "--library");
  const bool is_indirect = bug.context == KnownBug::kIndirectGlx;
  if (is_indirect && implementation != "glx-indirect") throw gl::NoCProgram("the bug needs indirect GLX");
  return gl::to_c({.style = gl::c_style_named(style).value_or(gl::CStyle::kShort),
                   .context = implementation == "osmesa" || is_indirect ? implementation : "egl",
                   .library = library.empty() && implementation == "egl" ? "libEGL.so.1" : library},
                  bug.example, bug.fails, bug.context == KnownBug::kCoreProfile ? EVALCTS_CORE_PROFILE : 0);
}

std::string compile_line(const std::vector<std::string>& options, const std::string& text,
                         const std::string& source, const std::string& program) {
  std::vector<std::string> command = {"cc", "-o", program, source};
  std::string environment;
  const fs::path library = value_of(options, "--library");
  const auto includes = [&](const std::string& header) {
    return text.find("#include <" + header + ">") != std::string::npos;
  };
  const bool uses_osmesa = includes("GL/osmesa.h");
  if (uses_osmesa || includes("EGL/egl.h")) {
    const bool is_usual = library.empty() || library.filename().string().starts_with(
                                                 "lib" + std::string(uses_osmesa ? "OSMesa" : "EGL") + ".so");
    if (uses_osmesa)
      command.push_back(is_usual ? "-lOSMesa" : library.string());
    else
      command.insert(command.end(), {"-lEGL", "-lGL"});
    if (!library.empty() && is_usual)
      environment = "LD_LIBRARY_PATH=" + shell_line({library.parent_path().string()}) + " ";
  } else if (includes("windows.h")) {
    command = {"x86_64-w64-mingw32-gcc", "-o", program + ".exe", source, "-lgdi32"};
    return shell_line(command) + " && " + shell_line({program + ".exe"});
  } else if (includes("GL/glx.h")) {
    command.insert(command.end(), {"-lGL", "-lX11"});
  } else if (value_of(options, "--implementation") == "production") {
    const Places where = places();
    if (where.production_library.empty()) {
      command.push_back("-lglevaluator");
    } else {
      command.insert(command.end(), {"-DGLEV_STATIC", "-I" + where.production_headers.string(),
                                     where.production_library.string(), "-lm"});
    }
  } else {
    command.push_back("-ldl");
  }
  return shell_line(command) + " && " + environment +
         shell_line({program.find('/') == std::string::npos ? "./" + program : program});
}

bool ProgramRun::crashes() const { return ending && (ending->signalled || ending->value >= 128); }

ProgramRun build_and_run(const std::vector<std::string>& options, const std::string& text) try {
  const std::string mesa_build = value_of(options, "--mesa-build");
  if (!mesa_build.empty()) use_mesa_build(mesa_build);
  const Scratch scratch;
  const fs::path source = scratch.path() / "program.c", log = scratch.path() / "log";
  write_atomically(source, text);
  const std::string line =
      compile_line(options, text, source.string(), (scratch.path() / "program").string());
  const std::size_t both = line.find(" && ");
  ChildProcess compiler({"/bin/sh", "-c", "exec " + line.substr(0, both)}, log.string());
  const std::optional<Ending> compiled = compiler.wait(kSeconds);
  ProgramRun run;
  if (!compiled || compiled->signalled || compiled->value != 0) {
    std::string why = read_file(log);
    const std::size_t error = why.find("error: ");
    if (error != std::string::npos) why = why.substr(error + 7);
    run.not_built = "cc: " + clean(why.substr(0, why.find('\n')));
    return run;
  }
  fs::remove(log);
  const std::string variables =
      mesa_build.empty() ? "" : "LD_DEBUG=libs LD_DEBUG_OUTPUT=" + (scratch.path() / "loaded").string() + " ";
  ChildProcess program({"/bin/sh", "-c", variables + line.substr(both + 4)}, log.string());
  run.ending = program.wait(kSeconds);
  run.output = read_file(log);
  if (!mesa_build.empty()) require_mesa_build(mesa_build, loaded_libraries(scratch.path()));
  return run;
} catch (const CannotStart& error) {
  return {.not_built = error.what(), .ending = {}, .output = {}};
}

}  // namespace evalcts::cli
