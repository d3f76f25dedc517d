// production/dropin: the evaluators of this project before those of a GL.
#include <cstdlib>
#include <filesystem>

#include "context_maker.h"
#include "kinds.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

// Beside this program's libraries where it is installed, in its own folder in a build.
std::string built_library() {
  const char* const name = "libglevaluator_dropin.so.0";
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* const place : {"../../production/dropin", EVALCTS_LIBRARIES_FROM_PROGRAMS})
    if (const fs::path file = folder / place / name; fs::exists(file)) return fs::canonical(file).string();
  return name;
}

}  // namespace

std::unique_ptr<Implementation> open_dropin(const std::string& name, const std::string& library) {
  const std::string in_front = library.empty() ? built_library() : library;
  // It is opened here, not loaded before the GL: it has to be told what that is.
  const auto in_front_of = [&](const char* gl, std::unique_ptr<ContextMaker> (*make)(const std::string&)) {
    setenv("GLEVALUATOR_GL", gl, 0);
    return make_gl_library(name, make(in_front), "");
  };
  if (name == "dropin-egl")
    return in_front_of("libEGL.so.1", [](const std::string& front) {
      return make_egl_contexts("", EglPlatform::any, front);
    });
  if (name == "dropin-glx")
    return in_front_of("libGL.so.1", [](const std::string& front) {
      return make_glx_contexts("", GlxRendering::direct, front);
    });
  return in_front_of("libOSMesa.so.8",
                     [](const std::string& front) { return make_osmesa_contexts("", front); });
}

}  // namespace evalcts
