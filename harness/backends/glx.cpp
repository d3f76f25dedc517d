// Contexts of GLX under an X server: that of DISPLAY, or one that this process starts.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/gl/contexts.h>
#include "context_maker.h"
#include "shared_library.h"
#include "x_recorder.h"
#include "x_server.h"

// Included last, because Xlib defines common words as macros. Only the types of the declarations are used.
#include <GL/glx.h>
#undef DefaultScreen

namespace evalcts {
namespace {

// The functions of Xlib and GLX 1.3 that are used.
// (clang-format 14 does not terminate on such lists.)
// clang-format off
#define XLIB_FUNCTIONS(X)                                                               \
  X(OpenDisplay) X(CloseDisplay) X(DisplayName) X(DefaultScreen) X(Sync) X(Free)        \
  X(QueryExtension) X(SetErrorHandler) X(SetIOErrorHandler) X(GetErrorText) X(InitThreads)
#define GLX_FUNCTIONS(X)                                                                \
  X(QueryVersion) X(QueryExtensionsString) X(ChooseFBConfig) X(CreateNewContext)        \
  X(CreatePbuffer) X(DestroyPbuffer) X(MakeContextCurrent) X(IsDirect)                  \
  X(DestroyContext) X(CopyContext) X(GetProcAddressARB)
// clang-format on

struct Xlib {
#define X(name) decltype(&::X##name) name = nullptr;
  XLIB_FUNCTIONS(X)
#undef X
};

struct Glx {
#define X(name) decltype(&::glX##name) name = nullptr;
  GLX_FUNCTIONS(X)
#undef X
};

void* required(const SharedLibrary& library, const char* symbol, const char* what) {
  void* address = library.find(symbol);
  if (!address) throw CannotStart(fmt::format("{} has no {}: it is not {}", library.path(), symbol, what));
  return address;
}

Xlib xlib_of(const SharedLibrary& library) {
  Xlib xlib;
#define X(name) xlib.name = reinterpret_cast<decltype(xlib.name)>(required(library, "X" #name, "Xlib"));
  XLIB_FUNCTIONS(X)
#undef X
  return xlib;
}

Glx glx_of(const SharedLibrary& library) {
  Glx glx;
#define X(name) glx.name = reinterpret_cast<decltype(glx.name)>(required(library, "glX" #name, "GLX"));
  GLX_FUNCTIONS(X)
#undef X
  return glx;
}

SharedLibrary usual(const char* name, const char* package, const std::string& in_front = "") {
  try {
    return SharedLibrary(name, in_front);
  } catch (const CannotStart& error) {
    throw CannotStart(fmt::format("{}; Debian's package is {}", error.what(), package));
  }
}

// Handlers of X protocol errors, which are global to the process. The default handlers end the process.
namespace errors {

decltype(Xlib::GetErrorText) get_text = nullptr;
bool expected = false;
std::string latest;

int take(Display* display, XErrorEvent* event) {
  std::array<char, 128> text{};
  get_text(display, event->error_code, text.data(), text.size());
  latest = fmt::format("{} (request {}, {})", text.data(), event->request_code, event->minor_code);
  if (!expected) std::fprintf(stderr, "X error: %s\n", latest.c_str());
  return 0;
}

int end(Display*) {
  std::fputs("the X server has ended, or cut the connection\n", stderr);
  _exit(1);
}

}  // namespace errors

class GlxContexts final : public ContextMaker {
 public:
  GlxContexts(const std::string& library, GlxRendering rendering, const std::string& in_front)
      : library_(library.empty() ? usual("libGL.so.1", "libgl1", in_front)
                                 : SharedLibrary(library, in_front)),
        xlib_library_(usual("libX11.so.6", "libx11-6")),
        xlib_(xlib_of(xlib_library_)),
        glx_(glx_of(library_)),
        direct_(rendering == GlxRendering::kDirect) {
    xlib_.InitThreads();  // the first call of Xlib; unnecessary since libX11 1.8
    errors::get_text = xlib_.GetErrorText;
    xlib_.SetErrorHandler(&errors::take);
    xlib_.SetIOErrorHandler(&errors::end);
    try {
      open();
    } catch (const CannotStart& error) {
      const bool has_server = server_ || display_;
      disconnect();
      throw CannotStart(error.what() + (has_server ? describe_gl_environment() : ""));
    }
  }
  ~GlxContexts() override { disconnect(); }
  GlxContexts(const GlxContexts&) = delete;
  GlxContexts& operator=(const GlxContexts&) = delete;

  std::string kind() const override { return "glx"; }
  void* create() override { return create_sharing(nullptr); }
  bool makes_several() const override { return true; }

  void* create_sharing(void* with) override {
    return make([&] {
      return glx_.CreateNewContext(display_, configuration_, GLX_RGBA_TYPE,
                                   with ? static_cast<Made*>(with)->context : nullptr, direct_);
    });
  }

  void* create_of_kind(GLuint kind) override {
    const auto create =
        reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(address_of("glXCreateContextAttribsARB"));
    std::istringstream extensions(glx_.QueryExtensionsString(display_, xlib_.DefaultScreen(display_)));
    const std::string wanted =
        kind == EVALCTS_NO_ERROR ? "GLX_ARB_create_context_no_error" : "GLX_ARB_create_context_profile";
    bool has = false;
    for (std::string extension; extensions >> extension;) has = has || extension == wanted;
    if (!create || !has) throw CannotStart(fmt::format("{} is missing", wanted));
    const std::vector<int> attributes = attributes_of(kind);
    return make([&] { return create(display_, configuration_, nullptr, direct_, attributes.data()); });
  }

  void make_current(void* context) override {
    const Made& made = *static_cast<Made*>(context);
    if (!glx_.MakeContextCurrent(display_, made.surface, made.surface, made.context))
      throw CannotStart("glXMakeContextCurrent rejects the context");
  }

  bool has_threads() const override { return true; }
  void release() override {
    if (!glx_.MakeContextCurrent(display_, None, None, nullptr))
      throw CannotStart("glXMakeContextCurrent does not release the context");
  }

  bool copies() const override { return true; }
  void copy(void* from, void* to, GLbitfield mask) override {
    errors::expected = true;
    errors::latest.clear();
    glx_.CopyContext(display_, static_cast<Made*>(from)->context, static_cast<Made*>(to)->context, mask);
    xlib_.Sync(display_, False);
    errors::expected = false;
    if (!errors::latest.empty()) throw CannotStart("glXCopyContext: " + errors::latest);
  }

  bool records_requests() const override { return recorder_.has_value(); }
  void record_requests() override {
    synchronize();
    recorder_->record();
  }
  std::vector<unsigned char> recorded_requests() override {
    synchronize();
    int opcode = 0, event = 0, error = 0;
    xlib_.QueryExtension(display_, "GLX", &opcode, &event, &error);
    return recorder_->take(static_cast<unsigned char>(opcode));
  }

  void destroy(void* context) override {
    const std::unique_ptr<Made> made(static_cast<Made*>(context));
    glx_.MakeContextCurrent(display_, None, None, nullptr);
    glx_.DestroyContext(display_, made->context);
    if (made->surface != None) glx_.DestroyPbuffer(display_, made->surface);
  }

  // glXGetProcAddressARB returns all commands. The exports of libGL prove less, because libglvnd also exports
  // commands that the driver does not provide.
  void* address_of(const char* command) override {
    return reinterpret_cast<void*>(glx_.GetProcAddressARB(reinterpret_cast<const GLubyte*>(command)));
  }
  std::string library() const override { return library_.path(); }

 private:
  struct Made {
    GLXContext context = nullptr;
    GLXPbuffer surface = None;
  };

  static std::vector<int> attributes_of(GLuint kind) {
    int minor = 2, profile = GLX_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB, flags = 0, no_error = False;
    switch (kind) {
      case EVALCTS_CORE_PROFILE:
        profile = GLX_CONTEXT_CORE_PROFILE_BIT_ARB;
        break;
      case EVALCTS_FORWARD_COMPATIBLE:
        minor = 1;  // this version has no profiles
        flags = GLX_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB;
        break;
      case EVALCTS_DEBUG:
        flags = GLX_CONTEXT_DEBUG_BIT_ARB;
        break;
      case EVALCTS_NO_ERROR:
        no_error = True;
        break;
      default:
        throw CannotStart(fmt::format("unknown kind {} of contexts", kind));
    }
    std::vector<int> attributes = {GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, minor};
    if (minor >= 2) attributes.insert(attributes.end(), {GLX_CONTEXT_PROFILE_MASK_ARB, profile});
    if (flags) attributes.insert(attributes.end(), {GLX_CONTEXT_FLAGS_ARB, flags});
    if (no_error) attributes.insert(attributes.end(), {GLX_CONTEXT_OPENGL_NO_ERROR_ARB, True});
    attributes.push_back(None);
    return attributes;
  }

  // Connects to a server, and makes and destroys one context that must answer queries.
  void open() {
    const char* given = std::getenv("DISPLAY");
    if (given && *given) connect(given);
    if (display_) return prove();
    if (direct_) {
      start_server("");
      return prove();
    }
    // The GL commands of an Xvfb that is linked to libglvnd have no effect, because its contexts are Mesa's
    // and are not known to libglvnd. The commands of libOSMesa reach Mesa's contexts.
    start_server("libOSMesa.so.8");
    try {
      prove();
    } catch (const CannotStart&) {
      disconnect();
      start_server("");
      prove();
    }
  }

  void start_server(const std::string& preload) {
    server_.emplace(preload);
    connect(server_->display());
    if (!display_)
      throw CannotStart(fmt::format("Xvfb, display {}, rejects connections", server_->display()));
  }

  // Connects to a server, through a recorder if rendering is indirect and the server is on this machine.
  void connect(const std::string& server) {
    if (!direct_) {
      try {
        recorder_.emplace(server);
        display_ = xlib_.OpenDisplay(recorder_->display().c_str());
      } catch (const CannotStart&) {
        // The connection is made without a recorder.
      }
      if (display_) return;
      recorder_.reset();
    }
    display_ = xlib_.OpenDisplay(server.c_str());
  }

  void disconnect() {
    if (display_) xlib_.CloseDisplay(display_);
    display_ = nullptr;
    recorder_.reset();
    server_.reset();
  }

  void prove() {
    const std::string where = server_ ? "Xvfb" : fmt::format("display {}", xlib_.DisplayName(nullptr));
    int major = 0, minor = 0;
    if (!glx_.QueryVersion(display_, &major, &minor) || major != 1 || minor < 3)
      throw CannotStart(fmt::format("{} has GLX {}.{}; 1.3 is needed{}", where, major, minor,
                                    server_ ? " (an Xvfb whose GL driver does not load has no GLX)" : ""));
    choose_configuration(where);
    Made* context = nullptr;
    try {
      context = static_cast<Made*>(create());
    } catch (const CannotStart& error) {
      throw CannotStart(fmt::format("{} cannot create {} contexts: {}{}", where,
                                    direct_ ? "direct" : "indirect", error.what(),
                                    server_ || direct_ ? "" : kHint));
    }
    const bool is_direct = glx_.IsDirect(display_, context->context);
    const std::string silence = direct_ ? "" : silence_of_context();
    destroy(context);
    if (is_direct != direct_)
      throw CannotStart(fmt::format(
          "{} creates only {} contexts{}", where, is_direct ? "direct" : "indirect",
          direct_ ? ": libGL renders indirectly if it cannot load a driver or if LIBGL_ALWAYS_INDIRECT is set"
                  : ""));
    if (!silence.empty())
      throw CannotStart(fmt::format("indirect rendering has no effect on {}: {}{}", where, silence,
                                    server_ ? "; libOSMesa.so.8 (package libosmesa6) can mend that" : kHint));
  }

  void choose_configuration(const std::string& where) {
    // Mesa would present a single-buffered surface at each flush, which fails with BadMatch for a pbuffer.
    // clang-format off
    const int wanted[] = {GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT,
                          GLX_DOUBLEBUFFER, True, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8,
                          GLX_ALPHA_SIZE, 8, GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8, None};
    // clang-format on
    int count = 0;
    GLXFBConfig* found = glx_.ChooseFBConfig(display_, xlib_.DefaultScreen(display_), wanted, &count);
    if (found && count > 0) configuration_ = found[0];
    if (found) xlib_.Free(found);
    if (count <= 0)
      throw CannotStart(
          fmt::format("{} has no configuration for pbuffers of two buffers of RGBA8, depth 24 and stencil 8; "
                      "a driver may be "
                      "missing (Mesa's are in the packages libglx-mesa0 and libgl1-mesa-dri)",
                      where));
  }

  // Returns the first basic query that the context does not answer; empty if it answers all.
  std::string silence_of_context() {
    const GLubyte* version =
        reinterpret_cast<decltype(&::glGetString)>(address_of("glGetString"))(GL_VERSION);
    if (!version || !*version) return "glGetString(GL_VERSION) answers nothing";
    GLint order = 0;
    reinterpret_cast<decltype(&::glGetIntegerv)>(address_of("glGetIntegerv"))(GL_MAX_EVAL_ORDER, &order);
    if (order < 8) return fmt::format("GL_MAX_EVAL_ORDER is {}", order);
    const std::array<GLfloat, 8> points = {1, 2, 3, 4, 5, 6, 7, 8};
    std::array<GLfloat, 8> answer{};
    reinterpret_cast<decltype(&::glMap1f)>(address_of("glMap1f"))(GL_MAP1_VERTEX_4, 0, 1, 4, 2,
                                                                  points.data());
    reinterpret_cast<decltype(&::glGetMapfv)>(address_of("glGetMapfv"))(GL_MAP1_VERTEX_4, GL_COEFF,
                                                                        answer.data());
    return answer == points ? "" : "glGetMapfv does not give back what glMap1f was given";
  }

  // Waits until all requests of the client have been sent and answered.
  void synchronize() {
    reinterpret_cast<decltype(&::glFinish)>(address_of("glFinish"))();
    xlib_.Sync(display_, False);
  }

  template <class Create>
  Made* make(const Create& create) {
    auto made = std::make_unique<Made>();
    errors::expected = true;
    errors::latest.clear();
    made->context = create();
    const int size[] = {GLX_PBUFFER_WIDTH, kFramebufferSide, GLX_PBUFFER_HEIGHT, kFramebufferSide, None};
    if (made->context) made->surface = glx_.CreatePbuffer(display_, configuration_, size);
    xlib_.Sync(display_, False);
    const bool current = made->context && made->surface != None && errors::latest.empty() &&
                         glx_.MakeContextCurrent(display_, made->surface, made->surface, made->context);
    if (!current && made->context) {
      destroy(made.release());
      xlib_.Sync(display_, False);
    }
    errors::expected = false;
    if (!current)
      throw CannotStart(errors::latest.empty() ? "glXCreateNewContext or glXMakeContextCurrent fails"
                                               : errors::latest);
    return made.release();
  }

  static constexpr const char* kHint =
      "; an Xorg makes indirect contexts with the option +iglx, and without DISPLAY an Xvfb is started";

  SharedLibrary library_, xlib_library_;
  Xlib xlib_;
  Glx glx_;
  bool direct_;
  std::optional<XServer> server_;
  std::optional<XRecorder> recorder_;
  Display* display_ = nullptr;
  GLXFBConfig configuration_ = nullptr;
};

}  // namespace

std::unique_ptr<ContextMaker> make_glx_contexts(const std::string& library, GlxRendering rendering,
                                                const std::string& in_front) {
  return std::make_unique<GlxContexts>(library, rendering, in_front);
}

}  // namespace evalcts
