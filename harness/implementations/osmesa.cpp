#include <fmt/format.h>

#include <vector>

#include "harness/implementations/kinds.h"
#include "harness/implementations/shared_library.h"

namespace evalcts {
namespace {

// From Mesa's osmesa.h, which the suite does not need to build.
using OSMesaContext = void*;
using CreateContextExt = OSMesaContext (*)(GLenum format, GLint depth, GLint stencil, GLint accumulation,
                                           OSMesaContext share);
using MakeCurrent = GLboolean (*)(OSMesaContext, void* buffer, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void (*)(OSMesaContext);
using GetProcAddress = void* (*)(const char* name);

constexpr GLsizei kSide = 64;  // pixels

struct Entry {
  CreateContextExt create;
  MakeCurrent make_current;
  DestroyContext destroy;
  gl::Table table;
};

class OSMesaContextOwner final : public Context {
 public:
  explicit OSMesaContextOwner(const Entry& entry)
      : entry_(entry), pixels_(kSide * kSide * 4), context_(entry.create(GL_RGBA, 24, 8, 0, nullptr)) {
    if (!context_) throw CannotStart("OSMesaCreateContextExt gives no context");
    if (!entry_.make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      entry_.destroy(context_);
      throw CannotStart("OSMesaMakeCurrent refuses the context");
    }
  }
  ~OSMesaContextOwner() override {
    entry_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    entry_.destroy(context_);
  }
  OSMesaContextOwner(const OSMesaContextOwner&) = delete;
  OSMesaContextOwner& operator=(const OSMesaContextOwner&) = delete;

  const gl::Table& table() const override { return entry_.table; }

 private:
  const Entry& entry_;
  std::vector<unsigned char> pixels_;
  OSMesaContext context_;
};

class OSMesa final : public Implementation {
 public:
  explicit OSMesa(const std::string& library) : library_(library) {
    const auto required = [&](const char* symbol) {
      void* address = library_.find(symbol);
      if (!address) throw CannotStart(fmt::format("{} has no {}: it is not OSMesa", library_.path(), symbol));
      return address;
    };
    entry_.create = reinterpret_cast<CreateContextExt>(required("OSMesaCreateContextExt"));
    entry_.make_current = reinterpret_cast<MakeCurrent>(required("OSMesaMakeCurrent"));
    entry_.destroy = reinterpret_cast<DestroyContext>(required("OSMesaDestroyContext"));
    const auto get = library_.find_as<GetProcAddress>("OSMesaGetProcAddress");
    entry_.table = gl::load_table(
        {[&](const char* name) { return library_.find(name); },
         [&](const char* name) { return get && library_.find("glMap1f") ? get(name) : nullptr; }});
  }

  std::string name() const override { return "osmesa"; }
  std::string library() const override { return library_.path(); }
  std::unique_ptr<Context> create_context() override { return std::make_unique<OSMesaContextOwner>(entry_); }

 private:
  SharedLibrary library_;
  Entry entry_{};
};

}  // namespace

std::unique_ptr<Implementation> open_osmesa(const std::string& library) {
  if (!library.empty()) return std::make_unique<OSMesa>(library);
  try {
    return std::make_unique<OSMesa>("libOSMesa.so.8");
  } catch (const CannotStart&) {
    try {
      return std::make_unique<OSMesa>("libOSMesa.so");
    } catch (const CannotStart&) {
      throw CannotStart(
          "libOSMesa.so.8 is not installed (package libosmesa6), or name a library with --library");
    }
  }
}

}  // namespace evalcts
