// Contexts of EGL without a window system.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <sstream>
#include <vector>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/gl/contexts.h>
#include "context_maker.h"
#include "framebuffer_object.h"
#include "shared_library.h"

namespace evalcts {
namespace {

// The functions of EGL 1.4 that are used. Only the types of the header's declarations are used.
// (clang-format 14 does not terminate on such lists.)
// clang-format off
#define EGL_FUNCTIONS(X)                                                           \
  X(GetError) X(QueryString) X(GetDisplay) X(Initialize) X(Terminate) X(BindAPI)   \
  X(ChooseConfig) X(CreateContext) X(DestroyContext) X(MakeCurrent)                \
  X(CreatePbufferSurface) X(DestroySurface) X(GetProcAddress)
// clang-format on

struct Functions {
#define X(name) decltype(&::egl##name) name = nullptr;
  EGL_FUNCTIONS(X)
#undef X
};

Functions functions_of(const SharedLibrary& library) {
  Functions functions;
  const auto find = [&](const char* symbol) {
    void* address = library.find(symbol);
    if (!address) throw CannotStart(fmt::format("{} has no {}: it is not EGL", library.path(), symbol));
    return address;
  };
#define X(name) functions.name = reinterpret_cast<decltype(functions.name)>(find("egl" #name));
  EGL_FUNCTIONS(X)
#undef X
  return functions;
}

std::string error_name(EGLint error) {
  switch (error) {
#define NAME(token) \
  case token:       \
    return #token;
    NAME(EGL_SUCCESS)
    NAME(EGL_NOT_INITIALIZED)
    NAME(EGL_BAD_ACCESS)
    NAME(EGL_BAD_ALLOC)
    NAME(EGL_BAD_ATTRIBUTE)
    NAME(EGL_BAD_CONFIG)
    NAME(EGL_BAD_CONTEXT)
    NAME(EGL_BAD_CURRENT_SURFACE)
    NAME(EGL_BAD_DISPLAY)
    NAME(EGL_BAD_MATCH)
    NAME(EGL_BAD_NATIVE_PIXMAP)
    NAME(EGL_BAD_NATIVE_WINDOW)
    NAME(EGL_BAD_PARAMETER)
    NAME(EGL_BAD_SURFACE)
    NAME(EGL_CONTEXT_LOST)
    NAME(EGL_BAD_DEVICE_EXT)
#undef NAME
    default:
      return fmt::format("error 0x{:04X}", error);
  }
}

bool has_word(const char* words, const std::string& wanted) {
  std::istringstream stream(words ? words : "");
  for (std::string word; stream >> word;)
    if (word == wanted) return true;
  return false;
}

// A display that may give a context.
struct Candidate {
  std::string name;
  EGLenum platform;  // EGL_NONE: opened by eglGetDisplay
  void* native;
};

enum class Api { kOpengl, kGles2 };

class EglContexts final : public ContextMaker {
 public:
  EglContexts(const std::string& library, EglPlatform platform, Api api, const std::string& in_front = "")
      : library_(library, in_front), egl_(functions_of(library_)), api_(api) {
    const char* extensions = egl_.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    client_extensions_ = extensions ? extensions : "";
    if (!extensions) egl_.GetError();
    std::vector<std::string> reasons;
    for (const Candidate& candidate : candidates(platform, reasons)) {
      try {
        open(candidate);
        return;
      } catch (const CannotStart& error) {
        reasons.push_back(candidate.name + ": " + error.what());
        if (display_ != EGL_NO_DISPLAY) egl_.Terminate(display_);
        display_ = EGL_NO_DISPLAY;
      }
    }
    throw CannotStart(
        fmt::format("no display of {} gives an {} context ({}); a driver for it may be missing (Mesa's are "
                    "in the packages libegl-mesa0 and libgl1-mesa-dri){}{}",
                    library_.path(), opengl() ? "OpenGL" : "OpenGL ES 2", fmt::join(reasons, "; "),
                    opengl() ? ", or name another EGL with --library" : "",
                    describe_egl_vendors() + describe_gl_environment()));
  }

  std::string kind() const override { return opengl() ? "egl" : "egl-gles2"; }
  // There is only one context for a layer over OpenGL ES, because a layer keeps the names of its objects and
  // does not notice another context.
  void* create() override {
    if (opengl()) return make(EGL_NO_CONTEXT, attributes_);
    if (!only_) only_.reset(make(EGL_NO_CONTEXT, attributes_));
    make_current(only_.get());
    return only_.get();
  }
  bool makes_several() const override { return opengl(); }
  void* create_sharing(void* with) override { return make(static_cast<Made*>(with)->context, attributes_); }
  void* create_of_kind(GLuint kind) override { return make(EGL_NO_CONTEXT, attributes_of(kind)); }

  void make_current(void* context) override {
    Made& made = *static_cast<Made*>(context);
    bind_api();
    if (egl_.MakeCurrent(display_, made.surface, made.surface, made.context)) return;
    const CannotStart error = failure("eglMakeCurrent");
    if (context != only_.get() || !initialize_again()) throw CannotStart(error);
    const std::unique_ptr<Made> again(make(EGL_NO_CONTEXT, attributes_));
    made = *again;
  }

  bool has_threads() const override { return opengl(); }
  void release() override {
    if (!egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT))
      throw failure("eglMakeCurrent without a context");
  }

  void destroy(void* context) override {
    egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context == only_.get()) return;
    const std::unique_ptr<Made> made(static_cast<Made*>(context));
    egl_.DestroyContext(display_, made->context);
    if (made->surface != EGL_NO_SURFACE) egl_.DestroySurface(display_, made->surface);
  }

  void* exported(const char* command) override { return library_.exported(command); }

  // Commands of other libraries are the last resort, because they may not belong to this EGL's contexts. They
  // are needed if eglGetProcAddress does not return the commands of GL 1.x.
  void* address_of(const char* command) override {
    if (!knows_all_commands_)
      for (const char* name : {"libOpenGL.so.0", "libGL.so.1"}) {
        try {
          if (void* address = SharedLibrary(name).find(command)) return address;
        } catch (const CannotStart&) {
          continue;
        }
      }
    return reinterpret_cast<void*>(egl_.GetProcAddress(command));
  }

  std::string library() const override { return library_.path(); }

 private:
  struct Made {
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;
  };

  // Returns context attributes of EGL 1.5, or of EGL_KHR_create_context and EGL_KHR_create_context_no_error,
  // which have the same values.
  std::vector<EGLint> attributes_of(GLuint kind) const {
    if (!opengl()) throw CannotStart("OpenGL ES has no such kinds of contexts");
    std::vector<EGLint> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,       3,
        EGL_CONTEXT_MINOR_VERSION,       2,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT};
    switch (kind) {
      case EVALCTS_CORE_PROFILE:
        attributes = {EGL_CONTEXT_MAJOR_VERSION,       3,
                      EGL_CONTEXT_MINOR_VERSION,       2,
                      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
        break;
      case EVALCTS_FORWARD_COMPATIBLE:
        attributes = {EGL_CONTEXT_MAJOR_VERSION,
                      3,
                      EGL_CONTEXT_MINOR_VERSION,
                      1,
                      EGL_CONTEXT_OPENGL_FORWARD_COMPATIBLE,
                      EGL_TRUE};
        break;
      case EVALCTS_DEBUG:
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
        break;
      case EVALCTS_NO_ERROR:
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_NO_ERROR_KHR, EGL_TRUE});
        break;
      default:
        throw CannotStart(fmt::format("unknown kind {} of contexts", kind));
    }
    attributes.push_back(EGL_NONE);
    return attributes;
  }

  Made* make(EGLContext share, const std::vector<EGLint>& attributes) {
    auto made = std::make_unique<Made>();
    bind_api();
    made->context = egl_.CreateContext(display_, config_, share, attributes.data());
    if (made->context == EGL_NO_CONTEXT) {
      const CannotStart error = failure("eglCreateContext");
      if (!initialize_again()) throw CannotStart(error);
      made->context = egl_.CreateContext(display_, config_, share, attributes.data());
      if (made->context == EGL_NO_CONTEXT) throw failure("eglCreateContext");
    }
    try {
      if (!surfaceless_) {
        const EGLint size[] = {EGL_WIDTH, kFramebufferSide, EGL_HEIGHT, kFramebufferSide, EGL_NONE};
        made->surface = egl_.CreatePbufferSurface(display_, config_, size);
        if (made->surface == EGL_NO_SURFACE) throw failure("eglCreatePbufferSurface");
      }
      make_current(made.get());
      if (surfaceless_)
        framebuffer_.bind([this](const char* name) {
          void* const own = exported(name);
          return own ? own : address_of(name);
        });
    } catch (const CannotStart&) {
      destroy(made.release());
      throw;
    }
    return made.release();
  }

  // Chooses the API of the contexts that the calling thread creates and releases. Each thread has its own.
  bool bind_api() const { return egl_.BindAPI(opengl() ? EGL_OPENGL_API : EGL_OPENGL_ES_API); }

  // Initialises the display again after the library under test has terminated it, as a layer may do when it
  // is loaded.
  bool initialize_again() {
    return egl_.Initialize(display_, nullptr, nullptr) && bind_api() && choose_config();
  }

  CannotStart failure(const std::string& step) const {
    return CannotStart(fmt::format("{} gives {}", step, error_name(egl_.GetError())));
  }

  bool client_has(const std::string& extension) const {
    return has_word(client_extensions_.c_str(), extension);
  }

  template <class Function>
  Function extension(const char* name) const {
    void* exported = library_.find(name);
    return exported ? reinterpret_cast<Function>(exported)
                    : reinterpret_cast<Function>(egl_.GetProcAddress(name));
  }

  std::vector<Candidate> candidates(EglPlatform platform, std::vector<std::string>& reasons) const {
    std::vector<Candidate> found;
    if (platform != EglPlatform::kDevice) {
      if (client_has("EGL_MESA_platform_surfaceless")) {
        found.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
      } else {
        reasons.push_back("surfaceless: EGL_MESA_platform_surfaceless is not supported");
      }
    }
    if (platform != EglPlatform::kSurfaceless) {
      std::vector<EGLDeviceEXT> devices;
      if (client_has("EGL_EXT_platform_device") || client_has("EGL_EXT_platform_base"))
        devices = all_devices();
      for (std::size_t i = 0; i < devices.size(); ++i)
        found.push_back({fmt::format("device {}", i), EGL_PLATFORM_DEVICE_EXT, devices[i]});
      if (devices.empty()) reasons.push_back("device: EGL_EXT_platform_device offers no device");
    }
    if (platform == EglPlatform::kAny) {
      const Candidate usual{"default display", EGL_NONE, nullptr};
      // EGL_PLATFORM selects the default display, which is then tried first.
      found.insert(std::getenv("EGL_PLATFORM") ? found.begin() : found.end(), usual);
    }
    return found;
  }

  std::vector<EGLDeviceEXT> all_devices() const {
    const auto query = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query || !query(0, nullptr, &count) || count <= 0) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!query(count, devices.data(), &count)) return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
  }

  EGLDisplay display_of(const Candidate& candidate) const {
    if (candidate.platform == EGL_NONE) return egl_.GetDisplay(EGL_DEFAULT_DISPLAY);
    if (const auto get = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT"))
      return get(candidate.platform, candidate.native, nullptr);
    const auto get = extension<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay");
    return get ? get(candidate.platform, candidate.native, nullptr) : EGL_NO_DISPLAY;
  }

  // Chooses a configuration. Returns false if there is none.
  bool choose_config() {
    // clang-format off
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, opengl() ? EGL_OPENGL_BIT : EGL_OPENGL_ES2_BIT,
                             EGL_SURFACE_TYPE, surfaceless_ ? 0 : EGL_PBUFFER_BIT,
                             EGL_RED_SIZE, surfaceless_ ? 0 : 8, EGL_ALPHA_SIZE, surfaceless_ ? 0 : 8,
                             EGL_DEPTH_SIZE, surfaceless_ ? 0 : 24, EGL_STENCIL_SIZE, surfaceless_ ? 0 : 8,
                             EGL_NONE};
    // clang-format on
    EGLint count = 0;
    if (!egl_.ChooseConfig(display_, wanted, &config_, 1, &count)) throw failure("eglChooseConfig");
    if (count == 0) config_ = nullptr;
    return count > 0;
  }

  // Opens the display, and makes and destroys one context.
  void open(const Candidate& candidate) {
    display_ = display_of(candidate);
    if (display_ == EGL_NO_DISPLAY) throw failure("the display");
    EGLint major = 0, minor = 0;
    if (!egl_.Initialize(display_, &major, &minor)) throw failure("eglInitialize");
    const char* apis = egl_.QueryString(display_, EGL_CLIENT_APIS);
    if (!has_word(apis, opengl() ? "OpenGL" : "OpenGL_ES") || !bind_api())
      throw CannotStart(fmt::format("it has no {}, only {}", opengl() ? "desktop OpenGL" : "OpenGL ES",
                                    apis ? apis : "nothing"));

    const bool is_1_5 = major > 1 || (major == 1 && minor >= 5);
    const char* extensions = egl_.QueryString(display_, EGL_EXTENSIONS);
    knows_all_commands_ = is_1_5 || has_word(extensions, "EGL_KHR_get_all_proc_addresses") ||
                          client_has("EGL_KHR_client_get_all_proc_addresses");
    // A framebuffer object is used only if there are no surfaces: NVIDIA's driver (580) loses the framebuffer
    // object of a context without a surface after other contexts have been current. Contexts of OpenGL ES for
    // another library need not support framebuffer objects.
    surfaceless_ = false;
    if (!choose_config() && opengl() && has_word(extensions, "EGL_KHR_surfaceless_context")) {
      surfaceless_ = true;
      choose_config();
    }
    if (!config_) throw CannotStart("no EGL configuration supports OpenGL");

    // Without attributes, EGL creates the highest version that includes GL 1.0, and so evaluators.
    attributes_ = {EGL_NONE};
    if (!opengl()) attributes_ = {EGL_CONTEXT_MAJOR_VERSION, 2, EGL_NONE};
    try {
      destroy(make(EGL_NO_CONTEXT, attributes_));
    } catch (const CannotStart&) {
      if (!opengl() || (!is_1_5 && !has_word(extensions, "EGL_KHR_create_context"))) throw;
      attributes_ = {EGL_CONTEXT_MAJOR_VERSION,
                     3,
                     EGL_CONTEXT_MINOR_VERSION,
                     2,
                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                     EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                     EGL_NONE};
      destroy(make(EGL_NO_CONTEXT, attributes_));
    }
  }

  bool opengl() const { return api_ == Api::kOpengl; }

  SharedLibrary library_;
  Functions egl_;
  Api api_;
  FramebufferObject framebuffer_;  // of contexts without a surface
  std::string client_extensions_;
  // Stays initialized until the process ends: drivers have exit handlers of their own.
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  std::vector<EGLint> attributes_;
  std::unique_ptr<Made> only_;  // the context of OpenGL ES, which stays until the process ends
  bool surfaceless_ = false;
  bool knows_all_commands_ = false;
};

std::string usual_library() {
  try {
    return SharedLibrary("libEGL.so.1").path();
  } catch (const CannotStart& error) {
    throw CannotStart(
        fmt::format("{}; Debian's package is libegl1; another EGL is chosen with --library", error.what()));
  }
}

}  // namespace

std::unique_ptr<ContextMaker> make_egl_contexts(const std::string& library, EglPlatform platform,
                                                const std::string& in_front) {
  return std::make_unique<EglContexts>(library.empty() ? usual_library() : library, platform, Api::kOpengl,
                                       in_front);
}

std::unique_ptr<ContextMaker> make_gles2_contexts() {
  return std::make_unique<EglContexts>(usual_library(), EglPlatform::kAny, Api::kGles2);
}

}  // namespace evalcts
