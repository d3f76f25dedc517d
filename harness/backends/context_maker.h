// Makes contexts of a GL library, apart from where its entry points come from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// The framebuffer of each context is so wide and so high, in pixels.
inline constexpr int kFramebufferSide = 64;

class ContextMaker {
 public:
  virtual ~ContextMaker() = default;
  // The name of this kind of contexts in CProgram::context.
  virtual std::string kind() const = 0;
  // A fresh context, current. No other exists but where makes_several(). Throws CannotStart.
  virtual void* create() = 0;
  // Whether it can make further contexts beside the first. The next three are for such makers only.
  virtual bool makes_several() const { return false; }
  // The same, sharing objects with another context. Throws CannotStart.
  virtual void* create_sharing(void* /*with*/) { return nullptr; }
  // The same, of a kind named in gl/contexts.h. Throws CannotStart.
  virtual void* create_of_kind(GLuint /*kind*/) {
    throw CannotStart("contexts of other kinds than the usual one are not made here");
  }
  // Throws CannotStart.
  virtual void make_current(void* /*context*/) {}
  // Whether copy() does something: copies what a mask of PushAttrib names from the context that is current to
  // one that is not. Throws CannotStart.
  virtual bool copies() const { return false; }
  virtual void copy(void* /*from*/, void* /*to*/, GLbitfield /*mask*/) {}
  // Whether the next two do something: see gl/requests.h, for the context that is current.
  virtual bool records_requests() const { return false; }
  virtual void record_requests() {}
  virtual std::vector<unsigned char> recorded_requests() { return {}; }
  // No context is current afterwards.
  virtual void destroy(void* context) = 0;
  // A GL command among the symbols of the library, and one that the library is asked for: the latter may make
  // up an address for any name. Null where there is none. Asked while a context is current.
  virtual void* exported(const char* /*command*/) { return nullptr; }
  virtual void* address_of(const char* command) = 0;
  // The file that the commands come from.
  virtual std::string library() const = 0;
};

// Mesa's off-screen library: `library`, or the usual soname where empty. `in_front`: see SharedLibrary.
// Throws CannotStart.
std::unique_ptr<ContextMaker> make_osmesa_contexts(const std::string& library,
                                                   const std::string& in_front = "");

enum class EglPlatform { any, surfaceless, device };
// EGL without a window system: `library`, or libEGL.so.1 where empty. Each context has a complete framebuffer
// object bound, or a pbuffer where EGL cannot do without surfaces. `in_front`: see SharedLibrary. Throws
// CannotStart.
std::unique_ptr<ContextMaker> make_egl_contexts(const std::string& library, EglPlatform platform,
                                                const std::string& in_front = "");

// EGL's OpenGL ES 2, with a pbuffer for each context: for layers of GL over it, which bring the commands.
// Throws CannotStart.
std::unique_ptr<ContextMaker> make_gles2_contexts();

enum class GlxRendering { direct, indirect };
// GLX: `library`, or libGL.so.1 where empty. The X server is that of DISPLAY, or an Xvfb of its own where
// that does not answer. Each context has a pbuffer. `in_front`: see SharedLibrary. Throws CannotStart.
std::unique_ptr<ContextMaker> make_glx_contexts(const std::string& library, GlxRendering rendering,
                                                const std::string& in_front = "");

// A shared library that fills in evalcts_provider.h. Throws CannotStart.
std::unique_ptr<ContextMaker> load_provider(const std::string& path);

// No contexts at all: for a library that needs none, or has one of its own.
std::unique_ptr<ContextMaker> make_no_contexts();

// An implementation of these contexts. `library`: where the commands come from, and from nowhere else; loaded
// once the first context is current. Empty: they come from the maker.
std::unique_ptr<Implementation> make_gl_library(const std::string& name,
                                                std::unique_ptr<ContextMaker> contexts,
                                                const std::string& library);

}  // namespace evalcts
