// The C code that makes contexts, for each kind of context: OSMesa, EGL, WGL, a provider, a sink,
// libglevaluator, or none.
#include "c_contexts.h"

#include <fmt/format.h>

#include <evalcts/gl/call_log.h>

namespace evalcts::gl {
namespace {

constexpr char kOpenLibrary[] = R"(static void *library;

static void stop(const char *why) {
  fprintf(stderr, "cannot start: %s\n", why);
  exit(2);
}

static void open_library(const char *path) {
%OPEN_BELOW%  library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!library) stop(dlerror());
}

static void *need(const char *name) {
  void *address = dlsym(library, name);
%FIND_BELOW%  if (!address) fprintf(stderr, "%s is missing\n", name), stop("this is another kind of library");
  return address;
}
)";

// Fragments of open_library() and need() for a library in front of another one. %LIBRARY%: the other one.
constexpr char kOpenBelow[] =
    R"(  /* The library is in front of another one, which it finds by this variable. */
  setenv("GLEVALUATOR_GL", %LIBRARY%, 0);
  below = dlopen(getenv("GLEVALUATOR_GL"), RTLD_NOW | RTLD_LOCAL);
  if (!below) stop(dlerror());
)";
constexpr char kFindBelow[] = R"(  if (!address) address = dlsym(below, name);
)";

constexpr char kOSMesa[] = R"(
/* OSMesa: RGBA, 24 bits of depth, 8 of stencil, 64x64 pixels in memory. */
static unsigned char pixels[64 * 64 * 4];
static void *contexts[MOST_CONTEXTS];

static void *create(void *shared) {
  void *(*create_ext)(GLenum, GLint, GLint, GLint, void *) =
      (void *(*)(GLenum, GLint, GLint, GLint, void *))dlsym(library, "OSMesaCreateContextExt");
  void *(*create_plain)(GLenum, void *) = (void *(*)(GLenum, void *))dlsym(library, "OSMesaCreateContext");
  void *context = create_ext ? create_ext(GL_RGBA, 24, 8, 0, shared) : NULL;
  return context || !create_plain ? context : create_plain(GL_RGBA, shared);
}

static void use_context(GLuint number, int how) {
  GLboolean (*make_current)(void *, void *, GLenum, GLsizei, GLsizei) =
      (GLboolean (*)(void *, void *, GLenum, GLsizei, GLsizei))need("OSMesaMakeCurrent");
  if (!contexts[number] && how < 2) contexts[number] = create(how ? contexts[0] : NULL);
  if (!contexts[number] && how == 2) {
    void *(*create_kind)(const int *, void *) =
        (void *(*)(const int *, void *))need("OSMesaCreateContextAttribs");
    /* OSMESA_FORMAT, DEPTH_BITS, STENCIL_BITS, PROFILE: CORE, CONTEXT_MAJOR_VERSION, MINOR_VERSION */
    const int core[] = {0x22, GL_RGBA, 0x30, 24, 0x31, 8, 0x33, 0x34, 0x36, 3, 0x37, 2, 0};
    contexts[number] = create_kind(core, NULL);
  }
  if (!contexts[number] || !make_current(contexts[number], pixels, GL_UNSIGNED_BYTE, 64, 64))
    stop("OSMesa gives no context");
}

static void make_context(const char *path) {
  open_library(path);
  use_context(0, 0);
}

static void *address_of(const char *name) {
  void *address = dlsym(library, name);
  if (address || !dlsym(library, "glMap1f")) return address;
  void *(*get)(const char *) = (void *(*)(const char *))dlsym(library, "OSMesaGetProcAddress");
  return get ? get(name) : NULL;
}
)";

// The part of make_context() that both uses of EGL share: initializes a surfaceless display, or the default
// display if there is none.
constexpr char kDisplay[] =
    R"(  unsigned (*initialize)(void *, int *, int *) = (unsigned (*)(void *, int *, int *))need("eglInitialize");
  unsigned (*bind_api)(unsigned) = (unsigned (*)(unsigned))need("eglBindAPI");
  unsigned (*choose)(void *, const int *, void **, int, int *) =
      (unsigned (*)(void *, const int *, void **, int, int *))need("eglChooseConfig");
  void *(*get_default)(void *) = (void *(*)(void *))need("eglGetDisplay");
  display = get_display ? get_display(0x31DD /* EGL_PLATFORM_SURFACELESS_MESA */, NULL, NULL) : NULL;
  if (!display || !initialize(display, NULL, NULL)) {
    display = get_default(NULL);
    if (!display || !initialize(display, NULL, NULL)) stop("EGL gives no display, surfaceless or default");
  }
)";

constexpr char kFramebuffer[] = R"(static void bind_framebuffer(void) {
  GLuint framebuffer, color, depth;
#define GL(name) ((__typeof__(name) *)address_of(#name))
  GL(glGenFramebuffers)(1, &framebuffer);
  GL(glBindFramebuffer)(GL_FRAMEBUFFER, framebuffer);
  GL(glGenRenderbuffers)(1, &color);
  GL(glBindRenderbuffer)(GL_RENDERBUFFER, color);
  GL(glRenderbufferStorage)(GL_RENDERBUFFER, GL_RGBA8, 64, 64);
  GL(glFramebufferRenderbuffer)(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  GL(glGenRenderbuffers)(1, &depth);
  GL(glBindRenderbuffer)(GL_RENDERBUFFER, depth);
  GL(glRenderbufferStorage)(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 64, 64);
  GL(glFramebufferRenderbuffer)(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
  GL(glDrawBuffer)(GL_COLOR_ATTACHMENT0);
  GL(glReadBuffer)(GL_COLOR_ATTACHMENT0);
  GL(glViewport)(0, 0, 64, 64);
  GL(glScissor)(0, 0, 64, 64);
  if (GL(glCheckFramebufferStatus)(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    stop("the framebuffer object is not complete");
  while (GL(glGetError)() != GL_NO_ERROR) continue;
#undef GL
}

)";

constexpr char kEgl[] = R"(
/* EGL without a surface: a framebuffer object of 64x64 pixels with colour, depth and stencil. */
static void *display, *config, *contexts[MOST_CONTEXTS];

static void *address_of(const char *name) {
  void *address = dlsym(library, name);
  void *(*get)(const char *) = (void *(*)(const char *))dlsym(library, "eglGetProcAddress");
  return address ? address : get ? get(name) : NULL;
}

%FRAMEBUFFER%static void use_context(GLuint number, int how) {
  void *(*create)(void *, void *, void *, const int *) =
      (void *(*)(void *, void *, void *, const int *))need("eglCreateContext");
  unsigned (*make_current)(void *, void *, void *, void *) =
      (unsigned (*)(void *, void *, void *, void *))need("eglMakeCurrent");
  /* EGL_CONTEXT_MAJOR_VERSION, MINOR_VERSION, and: core profile; forward-compatible; compatibility profile with
     debug, and with no-error */
  const int kinds[][9] = {{0x3038 /* EGL_NONE */},
                          {0x3038},
                          {0x3098, 3, 0x30FB, 2, 0x30FD, 1, 0x3038},
                          {0x3098, 3, 0x30FB, 1, 0x31B1, 1, 0x3038},
                          {0x3098, 3, 0x30FB, 2, 0x30FD, 2, 0x31B0, 1, 0x3038},
                          {0x3098, 3, 0x30FB, 2, 0x30FD, 2, 0x31B3, 1, 0x3038}};
  const int is_new = !contexts[number];
  if (is_new) contexts[number] = create(display, config, how == 1 ? contexts[0] : NULL, kinds[how]);
  if (!contexts[number] || !make_current(display, NULL, NULL, contexts[number])) stop("EGL gives no context");
  if (is_new) bind_framebuffer();
}

static void make_context(const char *path) {
  open_library(path);
  void *(*get_display)(unsigned, void *, const int *) =
      (void *(*)(unsigned, void *, const int *))address_of("eglGetPlatformDisplayEXT");
%DISPLAY%  if (!bind_api(0x30A2 /* EGL_OPENGL_API */)) stop("this EGL has no OpenGL");
  const int wanted[] = {0x3040 /* EGL_RENDERABLE_TYPE */, 8 /* EGL_OPENGL_BIT */, 0x3033 /* EGL_SURFACE_TYPE */, 0,
                        0x3038 /* EGL_NONE */};
  int count = 0;
  if (!choose(display, wanted, &config, 1, &count) || count == 0) stop("EGL has no configuration for OpenGL");
  use_context(0, 0);
}
)";

// Contexts for a layer over OpenGL ES 2, which is loaded once the context is current and looks up its
// commands there.
constexpr char kGles2[] = R"(
/* EGL and OpenGL ES 2, with a pbuffer of 64x64 pixels. */
static void *display, *config, *contexts[MOST_CONTEXTS], *surfaces[MOST_CONTEXTS];

static void use_context(GLuint number, int how) {
  void *(*create)(void *, void *, void *, const int *) =
      (void *(*)(void *, void *, void *, const int *))need("eglCreateContext");
  void *(*create_surface)(void *, void *, const int *) =
      (void *(*)(void *, void *, const int *))need("eglCreatePbufferSurface");
  unsigned (*make_current)(void *, void *, void *, void *) =
      (unsigned (*)(void *, void *, void *, void *))need("eglMakeCurrent");
  const int version[] = {0x3098 /* EGL_CONTEXT_MAJOR_VERSION */, 2, 0x3038 /* EGL_NONE */};
  const int size[] = {0x3057 /* EGL_WIDTH */, 64, 0x3056 /* EGL_HEIGHT */, 64, 0x3038 /* EGL_NONE */};
  if (how > 1) stop("OpenGL ES has no such kinds of contexts");
  if (!contexts[number]) {
    contexts[number] = create(display, config, how == 1 ? contexts[0] : NULL, version);
    surfaces[number] = create_surface(display, config, size);
  }
  if (!contexts[number] || !make_current(display, surfaces[number], surfaces[number], contexts[number]))
    stop("EGL gives no context");
}

static void *address_of(const char *name) { return dlsym(library, name); }

static void make_context(const char *path) {
  open_library(path);
  void *(*get_proc)(const char *) = (void *(*)(const char *))need("eglGetProcAddress");
  void *(*get_display)(unsigned, void *, const int *) =
      (void *(*)(unsigned, void *, const int *))get_proc("eglGetPlatformDisplayEXT");
%DISPLAY%  if (!bind_api(0x30A0 /* EGL_OPENGL_ES_API */)) stop("this EGL has no OpenGL ES");
  /* EGL_RENDERABLE_TYPE: EGL_OPENGL_ES2_BIT, SURFACE_TYPE: PBUFFER_BIT, RED, ALPHA, DEPTH and STENCIL_SIZE */
  const int wanted[] = {0x3040, 4, 0x3033, 1, 0x3024, 8, 0x3021, 8, 0x3025, 24, 0x3026, 8, 0x3038};
  int count = 0;
  if (!choose(display, wanted, &config, 1, &count) || count == 0) stop("EGL has no configuration for OpenGL ES 2");
  use_context(0, 0);
}
)";

constexpr char kWgl[] = R"(
/* WGL: a hidden window, whose pixels are undefined, and a framebuffer object of 64x64 pixels. */
static HGLRC contexts[MOST_CONTEXTS];
static HDC devices[MOST_CONTEXTS];

#define WGL(name) ((__typeof__(name) *)need(#name))
static void *address_of(const char *name) {
  void *address = dlsym(library, name);
  const INT_PTR number = address ? 0 : (INT_PTR)WGL(wglGetProcAddress)(name);
  return number >= -1 && number <= 3 ? address : (void *)number; /* some return small numbers for null */
}

%FRAMEBUFFER%static HGLRC create(HDC device, HGLRC shared, int how) {
  /* WGL_CONTEXT_MAJOR_VERSION_ARB, MINOR_VERSION, and: core profile; forward-compatible; compatibility profile with
     debug, and with no-error */
  const int kinds[][9] = {{0},
                          {0},
                          {0x2091, 3, 0x2092, 2, 0x9126, 1, 0},
                          {0x2091, 3, 0x2092, 1, 0x2094, 2, 0},
                          {0x2091, 3, 0x2092, 2, 0x9126, 2, 0x2094, 1, 0},
                          {0x2091, 3, 0x2092, 2, 0x9126, 2, 0x31B3, 1, 0}};
  if (how > 1) {
    HGLRC (*create_kind)(HDC, HGLRC, const int *) =
        (HGLRC (*)(HDC, HGLRC, const int *))address_of("wglCreateContextAttribsARB");
    return create_kind ? create_kind(device, NULL, kinds[how]) : NULL;
  }
  HGLRC context = WGL(wglCreateContext)(device);
  if (context && how == 1 && !WGL(wglShareLists)(shared, context)) stop("wglShareLists fails");
  return context;
}

static void use_context(GLuint number, int how) {
  /* opengl32.dll has functions for pixel formats as well. Those of gdi32.dll would ask the system's library. */
  int (*choose)(HDC, const PIXELFORMATDESCRIPTOR *) =
      (int (*)(HDC, const PIXELFORMATDESCRIPTOR *))need("wglChoosePixelFormat");
  BOOL (*set)(HDC, int, const PIXELFORMATDESCRIPTOR *) =
      (BOOL (*)(HDC, int, const PIXELFORMATDESCRIPTOR *))need("wglSetPixelFormat");
  const PIXELFORMATDESCRIPTOR wanted = {.nSize = sizeof wanted,
                                        .nVersion = 1,
                                        .dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER,
                                        .iPixelType = PFD_TYPE_RGBA,
                                        .cColorBits = 24,
                                        .cAlphaBits = 8,
                                        .cDepthBits = 24,
                                        .cStencilBits = 8};
  const int is_new = !contexts[number];
  if (is_new) {
    HDC device = devices[number] =
        GetDC(CreateWindowA("STATIC", "", WS_POPUP, 0, 0, 64, 64, NULL, NULL, NULL, NULL));
    if (!set(device, choose(device, &wanted), &wanted)) stop("WGL has no pixel format");
    contexts[number] = create(device, contexts[0], how);
  }
  if (!contexts[number] || !WGL(wglMakeCurrent)(devices[number], contexts[number])) stop("WGL gives no context");
  if (is_new && address_of("glGenFramebuffers")) bind_framebuffer();
}

static void make_context(const char *path) {
  open_library(path);
  use_context(0, 0);
}
)";

constexpr char kProvider[] = R"(
/* A provider of contexts, evalcts_provider.h. */
static const struct provider {
  unsigned version;
  void *(*create)(void);
  void (*destroy)(void *);
  void *(*get_address)(const char *);
  const char *(*error)(void);
  int (*make_current)(void *); /* this and the next: version 2 */
  void *(*create_color_index)(void);
} *provider;
static void *contexts[MOST_CONTEXTS];

/* how: 0, or 6 for a colour-index context */
static void use_context(GLuint number, int how) {
  void *(*create)(void) = provider->create;
  if (number != 0 && (provider->version < 2 || !provider->make_current)) stop("the provider makes one context");
  if (how != 0) create = how == 6 ? provider->create_color_index : NULL;
  if (contexts[number]) {
    if (number != 0 || (provider->version >= 2 && provider->make_current)) provider->make_current(contexts[number]);
    return;
  }
  if (!create) stop("the provider makes no contexts of this kind");
  contexts[number] = create();
  if (!contexts[number]) stop(provider->error ? provider->error() : "no context");
}

static void *address_of(const char *name) { return provider->get_address ? provider->get_address(name) : NULL; }

static void make_context(const char *path) {
  open_library(path);
  provider = ((const struct provider *(*)(void))need("evalcts_provider_open"))();
  if (!provider) stop("the provider cannot be used");
  use_context(0, 0);
}
)";

constexpr char kNone[] = R"(
/* The library needs no context, or has one of its own. */
static void use_context(GLuint number, int how) {
  if (number != 0 || how != 0) stop("there is one context");
}

static void *address_of(const char *name) { return dlsym(library, name); }

static void make_context(const char *path) { open_library(path); }
)";

// Code for commands from another library. It follows a fragment that defines maker_address_of and
// make_maker_context. %MAKER%: the library that makes the contexts.
constexpr char kLayer[] = R"(
/* The commands come from another library than the contexts; it is loaded once a context is current. */
static void *layer;

static void make_context(const char *path) {
  make_maker_context(%MAKER%);
  layer = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!layer) stop(dlerror());
}

static void *address_of(const char *name) { return dlsym(layer, name); }
)";

// Code for evaluators that hand over their vertices. %MOST%: number of vertices that are kept.
constexpr char kEmitted[] = R"(
/* The emitted vertices: position, color, normal, and eight texture coordinates. */
enum { MOST_VERTICES = %MOST%, VALUES = 43 };
static float emitted[MOST_VERTICES * VALUES];
static size_t emitted_vertices;

static void emit(const float *position, const float *color, const float *normal, const float *texcoord, size_t units) {
  const size_t number = emitted_vertices++;
  if (number >= MOST_VERTICES) return;
  float *const values = emitted + VALUES * number;
  if (position) memcpy(values, position, 4 * sizeof(float));
  if (color) memcpy(values + 4, color, 4 * sizeof(float));
  if (normal) memcpy(values + 8, normal, 3 * sizeof(float));
  if (texcoord) memcpy(values + 11, texcoord, 4 * units * sizeof(float));
}
)";

constexpr char kSink[] = R"(
/* A sink, evalcts_sink.h. */
struct receiver {
  void *user;
  void (*begin)(void *, unsigned);
  void (*end)(void *);
  void (*vertex)(void *, const float *, const float *, const float *, const float (*)[4], unsigned);
};
static const struct sink {
  unsigned version, attributes;
  const struct {
    const char *name;
    void (*function)(void);
  } *commands;
  const char *(*reset)(const struct receiver *);
} *sink;

static void on_begin(void *user, unsigned mode) { (void)user, (void)mode; }
static void on_end(void *user) { (void)user; }
static void on_vertex(void *user, const float *position, const float *color, const float *normal,
                      const float (*texcoord)[4], unsigned units) {
  (void)user;
  emit(position, color, normal, texcoord ? texcoord[0] : NULL, units < 8 ? units : 8);
}

/* The commands that a sink may lack. */
static void begin_primitive(GLenum mode) { (void)mode; }
static void end_primitive(void) {}
static GLenum no_error(void) { return GL_NO_ERROR; }

static void use_context(GLuint number, int how) {
  static const struct receiver receiver = {NULL, on_begin, on_end, on_vertex};
  const char *why;
  if (number != 0 || how != 0) stop("there is one context");
  if ((why = sink->reset(&receiver))) stop(why);
}

static void *address_of(const char *name) {
  for (size_t i = 0; sink->commands[i].name; ++i)
    if (strcmp(sink->commands[i].name, name) == 0) return *(void **)&sink->commands[i].function;
  return strcmp(name, "glBegin") == 0      ? (void *)begin_primitive
         : strcmp(name, "glEnd") == 0      ? (void *)end_primitive
         : strcmp(name, "glGetError") == 0 ? (void *)no_error
                                           : NULL;
}

static void make_context(const char *path) {
  open_library(path);
  sink = ((const struct sink *(*)(void))need("evalcts_sink_open"))();
  if (!sink) stop("the sink cannot be used");
  use_context(0, 0);
}
)";

constexpr char kProduction[] = R"(
/* libglevaluator: vertices come through a callback. */
static glev_context *context, *contexts[MOST_CONTEXTS];

static void on_vertex(void *user, const glev_vertex *vertex) {
  (void)user;
  emit(vertex->position, vertex->color, vertex->normal, vertex->texcoord[0], 8);
}

static void use_context(GLuint number, int how) {
  const glev_sink sink = {sizeof sink, NULL, NULL, on_vertex, NULL};
  glev_context **const used = &contexts[number];
  (void)how;
  if (!*used && (glevCreateContext(NULL, used) != GLEV_SUCCESS || glevSetSink(*used, &sink) != GLEV_SUCCESS)) {
    fprintf(stderr, "cannot start: no context\n");
    exit(2);
  }
  context = *used;
}

static void make_context(void) { use_context(0, 0); }
)";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

const char* fragment_of(const std::string& context) {
  if (context == "osmesa") return kOSMesa;
  if (context == "egl") return kEgl;
  if (context == "egl-gles2") return kGles2;
  if (context == "wgl") return kWgl;
  if (context == "provider") return kProvider;
  if (context == "sink") return kSink;
  if (context == "none") return kNone;
  if (context == "reference")
    throw NoCProgram("the reference is C++ inside evalcts: no C program can reach it");
  throw NoCProgram(fmt::format("the context comes from '{}', which only evalcts can open", context));
}

}  // namespace

std::string c_contexts(const CProgram& program) {
  std::string emitted = kEmitted;
  replace_all(emitted, "%MOST%", std::to_string(program.emitted_vertices + 64));
  if (program.context == "production") return emitted + kProduction;
  std::string text = fragment_of(program.context);
  if (program.context == "sink") text = emitted + text;
  replace_all(text, "%DISPLAY%", kDisplay);
  replace_all(text, "%FRAMEBUFFER%", kFramebuffer);
  std::string open_library = kOpenLibrary;
  const bool is_in_front = !program.library_below.empty();
  if (is_in_front) replace_all(open_library, "static void *library;", "static void *library, *below;");
  replace_all(open_library, "%OPEN_BELOW%", is_in_front ? kOpenBelow : "");
  replace_all(open_library, "%FIND_BELOW%", is_in_front ? kFindBelow : "");
  replace_all(open_library, "%LIBRARY%", quoted(program.library_below));
  if (!program.context_library.empty()) {
    replace_all(text, "*address_of(", "*maker_address_of(");
    replace_all(text, " address_of(", " maker_address_of(");
    replace_all(text, "(address_of(", "(maker_address_of(");
    replace_all(text, ")address_of(", ")maker_address_of(");
    replace_all(text, "make_context(", "make_maker_context(");
    text += kLayer;
    replace_all(text, "%MAKER%", fmt::format("\"{}\"", program.context_library));
  }
  return open_library + text;
}

}  // namespace evalcts::gl
