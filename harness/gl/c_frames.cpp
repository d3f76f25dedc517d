// The frames of short C programs, for EGL, OSMesa, indirect GLX and piglit.
#include "c_frames.h"

#include <fmt/format.h>

#include <algorithm>

#include <evalcts/gl/contexts.h>

namespace evalcts::gl {
namespace {

// Returns the headers with these names, for a program with commands that are newer than GL 1.1. The macro
// stands first because each of the headers may include GL/gl.h.
std::string headers(std::initializer_list<const char*> names) {
  std::string text = "#define GL_GLEXT_PROTOTYPES\n";
  for (const char* const name : names) text += fmt::format("#include <{}>\n", name);
  return text + "#include <stdio.h>\n";
}

constexpr char kPrintVersion[] =
    R"(  printf("%s, %s\n", (const char *)glGetString(GL_VERSION), (const char *)glGetString(GL_RENDERER));
)";

// Returns the attributes of EGL for a kind of context.
std::string egl_attributes(GLuint kind) {
  const std::string version = fmt::format("EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, {}, ",
                                          kind == EVALCTS_FORWARD_COMPATIBLE ? 1 : 2);
  const std::string compatibility =
      version + "EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT, ";
  switch (kind) {
    case EVALCTS_CORE_PROFILE:
      return version + "EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE";
    case EVALCTS_FORWARD_COMPATIBLE:
      return version + "EGL_CONTEXT_OPENGL_FORWARD_COMPATIBLE, EGL_TRUE, EGL_NONE";
    case EVALCTS_DEBUG:
      return compatibility + "EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE, EGL_NONE";
    case EVALCTS_NO_ERROR:
      return compatibility + "EGL_CONTEXT_OPENGL_NO_ERROR_KHR, EGL_TRUE, EGL_NONE";
    default:
      throw NoCProgram("EGL makes no contexts of this kind");
  }
}

CFrame egl(GLuint kind) {
  return {.headers = headers({"EGL/egl.h", "EGL/eglext.h", "GL/gl.h"}),
          .main = fmt::format(
              R"(
int main(void) {{
{}  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  if (!eglInitialize(display, NULL, NULL)) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  eglInitialize(display, NULL, NULL);
  EGLint count, kind[] = {{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE}};
  EGLConfig config;
  if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, kind, &config, 1, &count)) return 2;
  EGLSurface surface = eglCreatePbufferSurface(display, config, (EGLint[]){{EGL_WIDTH, 64, EGL_HEIGHT, 64, EGL_NONE}});
  if (!eglMakeCurrent(display, surface, surface, eglCreateContext(display, config, NULL, {}))) return 2;
{})",
              kind == 0 ? "" : fmt::format("  const EGLint attributes[] = {{{}}};\n", egl_attributes(kind)),
              kind == 0 ? "NULL" : "attributes", kPrintVersion)};
}

CFrame osmesa(GLuint kind) {
  if (kind > EVALCTS_CORE_PROFILE) throw NoCProgram("OSMesa makes no contexts of this kind");
  return {
      .headers = headers({"GL/osmesa.h"}),
      .main = fmt::format(
          R"(
int main(void) {{
  static GLubyte pixels[64 * 64 * 4];
{}  if (!OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, 64, 64)) return 2;
{})",
          kind == 0
              ? "  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, NULL);\n"
              : R"(  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 2, 0};
  OSMesaContext context = OSMesaCreateContextAttribs(attributes, NULL);
)",
          kPrintVersion)};
}

CFrame indirect_glx(GLuint kind) {
  if (kind != 0) throw NoCProgram("short programs make no indirect contexts of this kind");
  return {.headers = headers({"GL/glx.h"}),
          .main = fmt::format(
              R"(
int main(void) {{
  Display *display = XOpenDisplay(NULL); /* a server with indirect contexts: Xvfb +iglx */
  XVisualInfo *visual = display ? glXChooseVisual(display, DefaultScreen(display), (int[]){{GLX_RGBA, None}}) : NULL;
  if (!visual) return 2;
  GLXContext context = glXCreateContext(display, visual, NULL, False);
  Pixmap pixmap = XCreatePixmap(display, DefaultRootWindow(display), 64, 64, visual->depth);
  if (!glXMakeCurrent(display, glXCreateGLXPixmap(display, visual, pixmap), context)) return 2;
{})",
              kPrintVersion)};
}

// Returns the version of the GL, as piglit writes it, whose commands the case uses.
int version_of(const Case& script) {
  int version = 10;
  for (const Command& command : script.commands()) {
    if (command.entry == EntryPoint::CreateProgram) version = std::max(version, 20);
    if (command.entry == EntryPoint::BeginTransformFeedback) version = 30;
  }
  return version;
}

CFrame piglit(const CProgram& program, GLuint kind, bool has_errors) {
  if (kind > EVALCTS_FORWARD_COMPATIBLE) throw NoCProgram("piglit makes no contexts of this kind");
  const std::string version =
      kind == EVALCTS_CORE_PROFILE ? "core_version = 32"
      : kind == EVALCTS_FORWARD_COMPATIBLE
          ? "core_version = 31"
          : fmt::format("compat_version = {}", program.script ? version_of(*program.script) : 20);
  return {.headers = fmt::format(R"(#include "piglit-util-gl.h"

PIGLIT_GL_TEST_CONFIG_BEGIN
	config.supports_gl_{};
	config.window_visual = PIGLIT_GL_VISUAL_RGBA | PIGLIT_GL_VISUAL_DOUBLE;
	config.khr_no_error_support = {};
PIGLIT_GL_TEST_CONFIG_END
)",
                                 version, has_errors ? "PIGLIT_HAS_ERRORS" : "PIGLIT_NO_ERRORS"),
          .main = R"(
void
piglit_init(int argc, char **argv)
{
}

enum piglit_result
piglit_display(void)
{
)"};
}

}  // namespace

CFrame c_frame(const CProgram& program, GLuint kind, bool has_errors) {
  if (program.style == CStyle::kPiglit) return piglit(program, kind, has_errors);
  if (!program.context_library.empty() || !program.library_below.empty())
    throw NoCProgram("the commands come from another library than the contexts");
  if (program.context == "osmesa") return osmesa(kind);
  if (program.context == "egl") {
    const std::string& library = program.library;
    if (library.substr(library.rfind('/') + 1) != "libEGL.so.1")
      throw NoCProgram("the library has another name than the one that programs are linked with");
    return egl(kind);
  }
  if (program.context == "glx-indirect") return indirect_glx(kind);
  throw NoCProgram("only EGL, indirect GLX and OSMesa are linked");
}

}  // namespace evalcts::gl
