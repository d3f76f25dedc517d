// Context makers: they create contexts of a GL library. The entry points may come from another library.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts {

// Width and height of the framebuffer of each context, in pixels.
inline constexpr int kFramebufferSide = 64;

class ContextMaker {
 public:
  virtual ~ContextMaker() = default;
  // Returns the name of this kind of context in CProgram::context.
  virtual std::string kind() const = 0;
  // Creates a context and makes it current. No other context exists at that time, unless makes_several().
  // Throws CannotStart.
  virtual void* create() = 0;
  // True if several contexts can exist at a time. If false, the next three functions are not called.
  virtual bool makes_several() const { return false; }
  // Creates a context that shares objects with another one. Throws CannotStart.
  virtual void* create_sharing(void* /*with*/) { return nullptr; }
  // Creates a context of a kind that gl/contexts.h names. Throws CannotStart.
  virtual void* create_of_kind(GLuint /*kind*/) {
    throw CannotStart("this implementation creates contexts of the default kind only");
  }
  // Makes a context current. Throws CannotStart.
  virtual void make_current(void* /*context*/) {}
  // True if contexts can be used in any thread and release() is supported, which leaves no context current in
  // the calling thread. release() throws CannotStart.
  virtual bool has_threads() const { return false; }
  virtual void release() {}
  // True if copy() is supported, which copies the state groups of a PushAttrib mask from the current context
  // to another context. copy() throws CannotStart.
  virtual bool copies() const { return false; }
  virtual void copy(void* /*from*/, void* /*to*/, GLbitfield /*mask*/) {}
  // True if the next two functions are supported; they record the requests of the current context as
  // gl/requests.h describes.
  virtual bool records_requests() const { return false; }
  virtual void record_requests() {}
  virtual std::vector<unsigned char> recorded_requests() { return {}; }
  // Destroys a context. No context is current afterwards.
  virtual void destroy(void* context) = 0;
  // Return the address of a GL command, or null: exported() from the symbols of the library, address_of()
  // from its query function, which may return an address for any name. Called while a context is current.
  virtual void* exported(const char* /*command*/) { return nullptr; }
  virtual void* address_of(const char* command) = 0;
  // Returns the file that the commands come from.
  virtual std::string library() const = 0;
};

// Makes contexts of OSMesa, Mesa's off-screen library. `library`: a path or a soname; empty: the usual
// soname. `in_front`: see SharedLibrary. Throws CannotStart.
std::unique_ptr<ContextMaker> make_osmesa_contexts(const std::string& library,
                                                   const std::string& in_front = "");

enum class EglPlatform { kAny, kSurfaceless, kDevice };
// Makes contexts of EGL without a window system. `library`: a path or a soname; empty: libEGL.so.1. Each
// context has a pbuffer, or a complete framebuffer object if there are no surfaces. `in_front`: see
// SharedLibrary. Throws CannotStart.
std::unique_ptr<ContextMaker> make_egl_contexts(const std::string& library, EglPlatform platform,
                                                const std::string& in_front = "");

// Makes contexts of EGL's OpenGL ES 2, each with a pbuffer, for layers that implement GL on top of it. Throws
// CannotStart.
std::unique_ptr<ContextMaker> make_gles2_contexts();

enum class GlxRendering { kDirect, kIndirect };
// Makes contexts of GLX. `library`: a path or a soname; empty: libGL.so.1. The X server is that of DISPLAY,
// or an Xvfb that this process starts if DISPLAY does not answer. Each context has a pbuffer. `in_front`: see
// SharedLibrary. Throws CannotStart.
std::unique_ptr<ContextMaker> make_glx_contexts(const std::string& library, GlxRendering rendering,
                                                const std::string& in_front = "");

// Makes contexts of WGL, of Windows. `library`: a path or a name; empty: opengl32.dll. Throws CannotStart.
std::unique_ptr<ContextMaker> make_wgl_contexts(const std::string& library);

// Makes contexts of CGL, of macOS. `library`: a path; empty: the framework OpenGL. Throws CannotStart.
std::unique_ptr<ContextMaker> make_cgl_contexts(const std::string& library);

// Loads a provider, a shared library that implements evalcts_provider.h. Throws CannotStart.
std::unique_ptr<ContextMaker> load_provider(const std::string& path);

// Makes no contexts, for a library that needs none or has its own.
std::unique_ptr<ContextMaker> make_no_contexts();

// Makes an implementation with these contexts. `library`: the only source of its commands, loaded once the
// first context is current; empty: the commands come from the maker.
std::unique_ptr<Implementation> make_gl_library(const std::string& name,
                                                std::unique_ptr<ContextMaker> contexts,
                                                const std::string& library);

}  // namespace evalcts
