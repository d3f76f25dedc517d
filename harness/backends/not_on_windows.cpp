// Contexts and commands that a worker on Windows lacks.
#include <evalcts/backends/mesa_build.h>

#include "context_maker.h"
#include "kinds.h"

namespace evalcts {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw CannotStart(std::string(what) +
                    " is not available on Windows; choose wgl, osmesa, production or reference");
}

}  // namespace

std::unique_ptr<ContextMaker> make_egl_contexts(const std::string&, EglPlatform, const std::string&) {
  refuse("EGL");
}
std::unique_ptr<ContextMaker> make_gles2_contexts() { refuse("EGL"); }
std::unique_ptr<ContextMaker> make_glx_contexts(const std::string&, GlxRendering, const std::string&) {
  refuse("GLX");
}
std::unique_ptr<ContextMaker> make_cgl_contexts(const std::string&) { refuse("CGL"); }
std::unique_ptr<Implementation> open_dropin(const std::string&, const std::string&) {
  refuse("the drop-in library");
}

void use_mesa_build(const std::filesystem::path&) { refuse("--mesa-build"); }
bool uses_mesa_build(const std::filesystem::path&) { return false; }
void require_mesa_build(const std::filesystem::path&, const std::vector<std::string>&) {}

}  // namespace evalcts
