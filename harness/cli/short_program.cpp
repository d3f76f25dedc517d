#include "short_program.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

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
  const bool uses_osmesa = text.starts_with("#include <GL/osmesa.h>");
  if (uses_osmesa || text.starts_with("#include <EGL/egl.h>")) {
    const bool is_usual = library.empty() || library.filename().string().starts_with(
                                                 "lib" + std::string(uses_osmesa ? "OSMesa" : "EGL") + ".so");
    if (uses_osmesa)
      command.push_back(is_usual ? "-lOSMesa" : library.string());
    else
      command.insert(command.end(), {"-lEGL", "-lGL"});
    if (!library.empty() && is_usual)
      environment = "LD_LIBRARY_PATH=" + shell_line({library.parent_path().string()}) + " ";
  } else if (text.starts_with("#include <GL/glx.h>")) {
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

ProgramRun build_and_run(const std::vector<std::string>& options, const std::string& text) {
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
  ChildProcess program({"/bin/sh", "-c", line.substr(both + 4)}, log.string());
  run.ending = program.wait(kSeconds);
  run.output = read_file(log);
  return run;
}

}  // namespace evalcts::cli
