// Opens the drop-in library (production/dropin), the evaluators of this project in front of a GL,
// as an implementation.
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "context_maker.h"
#include "kinds.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

// Returns the drop-in library: installed, in the folder of libraries; in a build, in its own folder.
std::string built_library() {
  const char* const name = "libglevaluator_dropin.so.0";
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* const place : {"../../production/dropin", EVALCTS_LIBRARIES_FROM_PROGRAMS})
    if (const fs::path file = folder / place / name; fs::exists(file)) return fs::canonical(file).string();
  return name;
}

class DropIn final : public ImplementationInFront {
 public:
  DropIn(std::unique_ptr<Implementation> gl_library, std::string library_below)
      : ImplementationInFront(std::move(gl_library)), library_below_(std::move(library_below)) {}
  std::unique_ptr<Context> create_context() override { return inner().create_context(); }
  std::string library_below() const override { return library_below_; }

 private:
  std::string library_below_;
};

}  // namespace

std::unique_ptr<Implementation> open_dropin(const std::string& name, const std::string& library) {
  const std::string in_front = library.empty() ? built_library() : library;
  // The drop-in library is opened with dlopen, not preloaded, so it finds the GL by an environment variable.
  const auto in_front_of = [&](const char* gl, std::unique_ptr<ContextMaker> (*make)(const std::string&)) {
    setenv("GLEVALUATOR_GL", gl, 0);
    return std::make_unique<DropIn>(make_gl_library(name, make(in_front), ""), std::getenv("GLEVALUATOR_GL"));
  };
  if (name == "dropin-egl")
    return in_front_of("libEGL.so.1", [](const std::string& front) {
      return make_egl_contexts("", EglPlatform::kAny, front);
    });
  if (name == "dropin-glx")
    return in_front_of("libGL.so.1", [](const std::string& front) {
      return make_glx_contexts("", GlxRendering::kDirect, front);
    });
  return in_front_of("libOSMesa.so.8",
                     [](const std::string& front) { return make_osmesa_contexts("", front); });
}

}  // namespace evalcts
