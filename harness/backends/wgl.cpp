// Contexts of WGL, which need no visible window: each has a pbuffer, or a framebuffer object in a hidden
// window.
#include <fmt/format.h>
#include <windows.h>
// After windows.h.
#include <GL/wglext.h>

#include <array>
#include <memory>
#include <vector>

#include <evalcts/gl/contexts.h>
#include "context_maker.h"
#include "framebuffer_object.h"
#include "shared_library.h"

namespace evalcts {
namespace {

// The functions that a library for WGL exports. Those for pixel formats are not the ones of gdi32.dll, which
// would ask the system's opengl32.dll.
// clang-format off
#define WGL_FUNCTIONS(X)                                                                     \
  X(HGLRC, CreateContext, (HDC)) X(BOOL, DeleteContext, (HGLRC)) X(BOOL, MakeCurrent, (HDC, HGLRC)) \
  X(PROC, GetProcAddress, (LPCSTR)) X(BOOL, ShareLists, (HGLRC, HGLRC))                      \
  X(int, ChoosePixelFormat, (HDC, const PIXELFORMATDESCRIPTOR*))                             \
  X(BOOL, SetPixelFormat, (HDC, int, const PIXELFORMATDESCRIPTOR*))
// clang-format on

struct Functions {
#define X(result, name, parameters) result(WINAPI* name) parameters = nullptr;
  WGL_FUNCTIONS(X)
#undef X
};

Functions functions_of(const SharedLibrary& library) {
  Functions functions;
  const auto find = [&](const char* symbol) {
    void* const address = library.find(symbol);
    if (!address) throw CannotStart(fmt::format("{} has no {}: it is not WGL", library.path(), symbol));
    return address;
  };
#define X(result, name, parameters) \
  functions.name = reinterpret_cast<decltype(functions.name)>(find("wgl" #name));
  WGL_FUNCTIONS(X)
#undef X
  return functions;
}

CannotStart failure(const std::string& step) {
  return CannotStart(fmt::format("{} fails with Windows error {}", step, GetLastError()));
}

HWND make_window() {
  constexpr char kClass[] = "evalcts";
  static const ATOM kRegistered = [] {
    WNDCLASSA window_class{};
    window_class.style = CS_OWNDC;
    window_class.lpfnWndProc = DefWindowProcA;
    window_class.hInstance = GetModuleHandleA(nullptr);
    window_class.lpszClassName = kClass;
    return RegisterClassA(&window_class);
  }();
  HWND const window = kRegistered
                          ? CreateWindowExA(0, kClass, "", WS_POPUP, 0, 0, kFramebufferSide, kFramebufferSide,
                                            nullptr, nullptr, GetModuleHandleA(nullptr), nullptr)
                          : nullptr;
  if (!window) throw failure("to make a hidden window");
  return window;
}

class WglContexts final : public ContextMaker {
 public:
  explicit WglContexts(const std::string& library) : library_(library), wgl_(functions_of(library_)) {
    // The functions of extensions are found while a context is current.
    Made* const first = in_window();
    find_extensions();
    destroy(first);
  }

  std::string kind() const override { return "wgl"; }
  void* create() override { return make(nullptr, {}); }
  bool makes_several() const override { return true; }
  void* create_sharing(void* with) override { return make(static_cast<Made*>(with)->context, {}); }
  void* create_of_kind(GLuint kind) override {
    if (!create_context_attribs_) throw CannotStart("WGL_ARB_create_context is not supported");
    return make(nullptr, attributes_of(kind));
  }

  void make_current(void* context) override {
    const Made& made = *static_cast<Made*>(context);
    if (!wgl_.MakeCurrent(made.device, made.context)) throw failure("wglMakeCurrent");
  }
  bool has_threads() const override { return true; }
  void release() override {
    if (!wgl_.MakeCurrent(nullptr, nullptr)) throw failure("wglMakeCurrent without a context");
  }

  void destroy(void* context) override {
    const std::unique_ptr<Made> made(static_cast<Made*>(context));
    wgl_.MakeCurrent(nullptr, nullptr);
    if (made->context) wgl_.DeleteContext(made->context);
    if (made->pbuffer) {
      release_pbuffer_device_(made->pbuffer, made->device);
      destroy_pbuffer_(made->pbuffer);
    }
    if (made->window) DestroyWindow(made->window);
  }

  void* exported(const char* command) override { return library_.exported(command); }
  void* address_of(const char* command) override {
    const auto address = reinterpret_cast<INT_PTR>(wgl_.GetProcAddress(command));
    return address >= -1 && address <= 3 ? nullptr
                                         : reinterpret_cast<void*>(address);  // some return small numbers
  }
  std::string library() const override { return library_.path(); }

 private:
  struct Made {
    HGLRC context = nullptr;
    HDC device = nullptr;
    HWND window = nullptr;  // null with a pbuffer
    HPBUFFERARB pbuffer = nullptr;
  };

  template <class Function>
  void find_extension(Function& function, const char* name) {
    function = reinterpret_cast<Function>(address_of(name));
  }

  void find_extensions() {
    find_extension(create_context_attribs_, "wglCreateContextAttribsARB");
    find_extension(choose_pixel_format_, "wglChoosePixelFormatARB");
    find_extension(create_pbuffer_, "wglCreatePbufferARB");
    find_extension(pbuffer_device_, "wglGetPbufferDCARB");
    find_extension(release_pbuffer_device_, "wglReleasePbufferDCARB");
    find_extension(destroy_pbuffer_, "wglDestroyPbufferARB");
    if (!choose_pixel_format_ || !create_pbuffer_ || !pbuffer_device_ || !release_pbuffer_device_ ||
        !destroy_pbuffer_)
      return;
    HWND const window = make_window();
    // Two buffers, because Mesa would present a single one at each flush, which Wine cannot do with a
    // pbuffer.
    const std::array wanted = {WGL_DRAW_TO_PBUFFER_ARB,
                               1,
                               WGL_SUPPORT_OPENGL_ARB,
                               1,
                               WGL_DOUBLE_BUFFER_ARB,
                               1,
                               WGL_PIXEL_TYPE_ARB,
                               WGL_TYPE_RGBA_ARB,
                               WGL_RED_BITS_ARB,
                               8,
                               WGL_ALPHA_BITS_ARB,
                               8,
                               WGL_DEPTH_BITS_ARB,
                               24,
                               WGL_STENCIL_BITS_ARB,
                               8,
                               0};
    UINT count = 0;
    if (!choose_pixel_format_(GetDC(window), wanted.data(), nullptr, 1, &pbuffer_format_, &count) ||
        count == 0)
      pbuffer_format_ = 0;
    DestroyWindow(window);
  }

  // Returns a context in a hidden window, whose pixels are undefined.
  Made* in_window() {
    auto made = std::make_unique<Made>();
    made->window = make_window();
    made->device = GetDC(made->window);
    set_format(made->device);
    return with_context(std::move(made), nullptr, {});
  }

  void set_format(HDC device) {
    PIXELFORMATDESCRIPTOR wanted{};
    wanted.nSize = sizeof wanted;
    wanted.nVersion = 1;
    wanted.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
    wanted.iPixelType = PFD_TYPE_RGBA;
    wanted.cColorBits = 24;
    wanted.cAlphaBits = 8;
    wanted.cDepthBits = 24;
    wanted.cStencilBits = 8;
    const int format = wgl_.ChoosePixelFormat(device, &wanted);
    if (format == 0) throw failure("wglChoosePixelFormat");
    if (!wgl_.SetPixelFormat(device, format, &wanted)) throw failure("wglSetPixelFormat");
  }

  Made* make(HGLRC share, const std::vector<int>& attributes) {
    auto made = std::make_unique<Made>();
    if (pbuffer_format_ == 0) {
      made->window = make_window();
      made->device = GetDC(made->window);
      set_format(made->device);
      Made* const in_hidden_window = with_context(std::move(made), share, attributes);
      framebuffer_.bind([this](const char* name) {
        void* const own = exported(name);
        return own ? own : address_of(name);
      });
      return in_hidden_window;
    }
    HWND const window = make_window();
    const int end = 0;
    made->pbuffer = create_pbuffer_(GetDC(window), pbuffer_format_, kFramebufferSide, kFramebufferSide, &end);
    made->device = made->pbuffer ? pbuffer_device_(made->pbuffer) : nullptr;
    DestroyWindow(window);
    if (!made->device) throw failure("wglCreatePbufferARB");
    return with_context(std::move(made), share, attributes);
  }

  Made* with_context(std::unique_ptr<Made> made, HGLRC share, const std::vector<int>& attributes) {
    Made* const unfinished = made.release();
    try {
      if (attributes.empty()) {
        unfinished->context = wgl_.CreateContext(unfinished->device);
        if (unfinished->context && share && !wgl_.ShareLists(share, unfinished->context))
          throw failure("wglShareLists");
      } else {
        unfinished->context = create_context_attribs_(unfinished->device, share, attributes.data());
      }
      if (!unfinished->context) throw failure("to create a context");
      make_current(unfinished);
    } catch (const CannotStart&) {
      destroy(unfinished);
      throw;
    }
    return unfinished;
  }

  static std::vector<int> attributes_of(GLuint kind) {
    constexpr int kNoError = 0x31B3;  // WGL_CONTEXT_OPENGL_NO_ERROR_ARB
    const auto version = [](int minor) {
      return std::vector<int>{WGL_CONTEXT_MAJOR_VERSION_ARB, 3, WGL_CONTEXT_MINOR_VERSION_ARB, minor};
    };
    std::vector<int> attributes = version(2);
    const auto add = [&](int name, int value) { attributes.insert(attributes.end(), {name, value}); };
    if (kind == EVALCTS_CORE_PROFILE) {
      add(WGL_CONTEXT_PROFILE_MASK_ARB, WGL_CONTEXT_CORE_PROFILE_BIT_ARB);
    } else if (kind == EVALCTS_FORWARD_COMPATIBLE) {
      attributes = version(1);
      add(WGL_CONTEXT_FLAGS_ARB, WGL_CONTEXT_FORWARD_COMPATIBLE_BIT_ARB);
    } else {
      add(WGL_CONTEXT_PROFILE_MASK_ARB, WGL_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB);
      if (kind == EVALCTS_DEBUG)
        add(WGL_CONTEXT_FLAGS_ARB, WGL_CONTEXT_DEBUG_BIT_ARB);
      else if (kind == EVALCTS_NO_ERROR)
        add(kNoError, 1);
      else
        throw CannotStart(fmt::format("unknown kind {} of contexts", kind));
    }
    attributes.push_back(0);
    return attributes;
  }

  SharedLibrary library_;
  Functions wgl_;
  FramebufferObject framebuffer_;  // of contexts without a pbuffer
  PFNWGLCREATECONTEXTATTRIBSARBPROC create_context_attribs_ = nullptr;
  PFNWGLCHOOSEPIXELFORMATARBPROC choose_pixel_format_ = nullptr;
  PFNWGLCREATEPBUFFERARBPROC create_pbuffer_ = nullptr;
  PFNWGLGETPBUFFERDCARBPROC pbuffer_device_ = nullptr;
  PFNWGLRELEASEPBUFFERDCARBPROC release_pbuffer_device_ = nullptr;
  PFNWGLDESTROYPBUFFERARBPROC destroy_pbuffer_ = nullptr;
  int pbuffer_format_ = 0;  // 0: there are no pbuffers
};

}  // namespace

std::unique_ptr<ContextMaker> make_wgl_contexts(const std::string& library) {
  return std::make_unique<WglContexts>(library.empty() ? "opengl32.dll" : library);
}

}  // namespace evalcts
