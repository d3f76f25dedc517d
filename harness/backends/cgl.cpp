// Contexts of CGL, of macOS, which need no window: each has a framebuffer object. This file is compiled on
// every system but Windows and has never been run on macOS; the types and numbers are those of
// OpenGL/CGLTypes.h.
#include <fmt/format.h>

#include <array>
#include <memory>

#include <evalcts/gl/contexts.h>
#include "context_maker.h"
#include "framebuffer_object.h"
#include "shared_library.h"

namespace evalcts {
namespace {

using PixelFormat = void*;
using CglContext = void*;
using CglError = int;  // 0: none

// Attributes of pixel formats, and the profiles.
constexpr int kColorSize = 8, kAlphaSize = 11, kDepthSize = 12, kStencilSize = 13, kProfile = 99;
constexpr int kLegacy = 0x1000, kCore = 0x3200;

// clang-format off
#define CGL_FUNCTIONS(X)                                                       \
  X(CglError, ChoosePixelFormat, (const int*, PixelFormat*, int*))                \
  X(CglError, DestroyPixelFormat, (PixelFormat))                                  \
  X(CglError, CreateContext, (PixelFormat, CglContext, CglContext*))              \
  X(CglError, DestroyContext, (CglContext)) X(CglError, SetCurrentContext, (CglContext)) \
  X(const char*, ErrorString, (CglError))
// clang-format on

struct CglFunctions {
#define X(result, name, parameters) result(*name) parameters = nullptr;
  CGL_FUNCTIONS(X)
#undef X
};

class CglContexts final : public ContextMaker {
 public:
  explicit CglContexts(const std::string& library) : library_(library) {
#define X(result, name, parameters) find(cgl_.name, "CGL" #name);
    CGL_FUNCTIONS(X)
#undef X
  }

  std::string kind() const override { return "cgl"; }
  void* create() override { return make(nullptr, kLegacy); }
  bool makes_several() const override { return true; }
  void* create_sharing(void* with) override { return make(with, kLegacy); }
  void* create_of_kind(GLuint kind) override {
    if (kind != EVALCTS_CORE_PROFILE) throw CannotStart("CGL has no such kind of contexts");
    return make(nullptr, kCore);
  }
  void make_current(void* context) override {
    require("CGLSetCurrentContext", cgl_.SetCurrentContext(context));
  }
  bool has_threads() const override { return true; }
  void release() override { make_current(nullptr); }
  void destroy(void* context) override {
    cgl_.SetCurrentContext(nullptr);
    cgl_.DestroyContext(context);
  }
  // The framework exports the commands of another library in it; CGL has no query function.
  void* exported(const char* command) override { return library_.find(command); }
  void* address_of(const char*) override { return nullptr; }
  std::string library() const override { return library_.path(); }

 private:
  template <class Function>
  void find(Function& function, const char* symbol) {
    function = library_.find_as<Function>(symbol);
    if (!function) throw CannotStart(fmt::format("{} has no {}: it is not CGL", library_.path(), symbol));
  }

  void require(const char* function, CglError error) const {
    if (error) throw CannotStart(fmt::format("{} fails: {}", function, cgl_.ErrorString(error)));
  }

  CglContext make(CglContext share, int profile) {
    const std::array wanted = {kProfile,   profile, kColorSize,   24, kAlphaSize, 8,
                               kDepthSize, 24,      kStencilSize, 8,  0};
    PixelFormat format = nullptr;
    int count = 0;
    require("CGLChoosePixelFormat", cgl_.ChoosePixelFormat(wanted.data(), &format, &count));
    if (!format) throw CannotStart("CGL has no pixel format with 24 bits of colour, depth and stencil");
    CglContext context = nullptr;
    const CglError error = cgl_.CreateContext(format, share, &context);
    cgl_.DestroyPixelFormat(format);
    require("CGLCreateContext", error);
    try {
      make_current(context);
      framebuffer_.bind([this](const char* name) { return exported(name); });
    } catch (const CannotStart&) {
      destroy(context);
      throw;
    }
    return context;
  }

  SharedLibrary library_;
  CglFunctions cgl_;
  FramebufferObject framebuffer_;
};

}  // namespace

std::unique_ptr<ContextMaker> make_cgl_contexts(const std::string& library) {
  return std::make_unique<CglContexts>(library.empty() ? "/System/Library/Frameworks/OpenGL.framework/OpenGL"
                                                       : library);
}

}  // namespace evalcts
