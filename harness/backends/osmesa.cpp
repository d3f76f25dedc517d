// Makes contexts with OSMesa, Mesa's interface for drawing into memory without a window system.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include <evalcts/backends/gl_environment.h>
#include <evalcts/gl/contexts.h>
#include "context_maker.h"
#include "shared_library.h"

namespace evalcts {
namespace {

// Declarations of Mesa's osmesa.h, repeated so that the header is not needed to build.
using OSMesaContext = void*;
using CreateContext = OSMesaContext (*)(GLenum format, OSMesaContext share);
using CreateContextExt = OSMesaContext (*)(GLenum format, GLint depth, GLint stencil, GLint accumulation,
                                           OSMesaContext share);
using CreateContextAttribs = OSMesaContext (*)(const int* attributes, OSMesaContext share);
using MakeCurrent = GLboolean (*)(OSMesaContext, void* buffer, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void (*)(OSMesaContext);
using FindCommand = void* (*)(const char* name);

#ifdef _WIN32
constexpr char kUsualLibrary[] = "osmesa.dll";
#else
constexpr char kUsualLibrary[] = "libOSMesa.so.8";
#endif

class OSMesaContexts final : public ContextMaker {
 public:
  OSMesaContexts(const std::string& library, const std::string& in_front)
      : library_(library, in_front),
        create_(library_.find_as<CreateContext>("OSMesaCreateContext")),
        create_ext_(library_.find_as<CreateContextExt>("OSMesaCreateContextExt")),
        get_proc_address_(library_.find_as<FindCommand>("OSMesaGetProcAddress")) {
    const auto required = [&](const char* symbol) {
      void* address = library_.find(symbol);
      if (!address) throw CannotStart(fmt::format("{} has no {}: it is not OSMesa", library_.path(), symbol));
      return address;
    };
    if (!create_) create_ext_ = reinterpret_cast<CreateContextExt>(required("OSMesaCreateContextExt"));
    make_current_ = reinterpret_cast<MakeCurrent>(required("OSMesaMakeCurrent"));
    destroy_ = reinterpret_cast<DestroyContext>(required("OSMesaDestroyContext"));
    exports_commands_ = library_.find("glMap1f") != nullptr;
  }

  std::string kind() const override { return "osmesa"; }
  void* create() override { return create_sharing(nullptr); }
  bool makes_several() const override { return true; }

  void* create_sharing(void* with) override {
    // A drop-in library may export the extended form although the library below it lacks that form.
    OSMesaContext const other = with ? static_cast<Made*>(with)->context : nullptr;
    OSMesaContext context = create_ext_ ? create_ext_(GL_RGBA, 24, 8, 0, other) : nullptr;
    if (!context && create_) context = create_(GL_RGBA, other);
    return current(context);
  }

  void* create_of_kind(GLuint kind) override {
    const auto create = library_.find_as<CreateContextAttribs>("OSMesaCreateContextAttribs");
    if (!create || kind != EVALCTS_CORE_PROFILE) return ContextMaker::create_of_kind(kind);
    // Attributes with the values of GL/osmesa.h, which is not installed everywhere.
    // clang-format off
    const int attributes[] = {0x22 /* FORMAT */, GL_RGBA, 0x30 /* DEPTH_BITS */, 24, 0x31 /* STENCIL_BITS */, 8,
                              0x33 /* PROFILE */, 0x34 /* CORE_PROFILE */,
                              0x36 /* CONTEXT_MAJOR_VERSION */, 3, 0x37 /* CONTEXT_MINOR_VERSION */, 2, 0};
    // clang-format on
    return current(create(attributes, nullptr));
  }
  void make_current(void* context) override {
    Made& made = *static_cast<Made*>(context);
    if (!make_current_(made.context, made.pixels.data(), GL_UNSIGNED_BYTE, kFramebufferSide,
                       kFramebufferSide))
      throw CannotStart("OSMesaMakeCurrent rejects the context");
  }
  bool has_threads() const override { return true; }
  void release() override {
    if (!make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0))
      throw CannotStart("OSMesaMakeCurrent does not release the context");
  }

  void destroy(void* context) override {
    const std::unique_ptr<Made> made(static_cast<Made*>(context));
    make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    destroy_(made->context);
  }

  void* exported(const char* command) override { return library_.find(command); }
  void* address_of(const char* command) override {
    return get_proc_address_ && exports_commands_ ? get_proc_address_(command) : nullptr;
  }
  std::string library() const override { return library_.path(); }

 private:
  struct Made {
    OSMesaContext context;
    std::vector<unsigned char> pixels = std::vector<unsigned char>(kFramebufferSide * kFramebufferSide * 4);
  };

  Made* current(OSMesaContext context) {
    if (!context) throw CannotStart("OSMesaCreateContext returns no context" + describe_gl_environment());
    auto made = std::make_unique<Made>(Made{context});
    try {
      make_current(made.get());
    } catch (const CannotStart&) {
      destroy_(context);
      throw;
    }
    return made.release();
  }

  SharedLibrary library_;
  CreateContext create_;
  CreateContextExt create_ext_;
  FindCommand get_proc_address_;
  MakeCurrent make_current_ = nullptr;
  DestroyContext destroy_ = nullptr;
  bool exports_commands_ = false;
};

}  // namespace

std::unique_ptr<ContextMaker> make_osmesa_contexts(const std::string& library, const std::string& in_front) {
  if (!library.empty()) return std::make_unique<OSMesaContexts>(library, in_front);
  try {
    return std::make_unique<OSMesaContexts>(kUsualLibrary, in_front);
  } catch (const CannotStart& error) {
    try {
      return std::make_unique<OSMesaContexts>("libOSMesa.so", in_front);
    } catch (const CannotStart&) {
      throw CannotStart(fmt::format(
          "{}; OSMesa is part of Mesa up to 25.0 (Debian's package is libosmesa6); another library is "
          "chosen with --library",
          error.what()));
    }
  }
}

}  // namespace evalcts
