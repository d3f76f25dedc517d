// Opens implementations by name or by library, and queries the properties of a GL that tests depend on.
#include <evalcts/backends/implementation.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <functional>
#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <evalcts/backends/rejected_queries.h>
#include <evalcts/gl/errors.h>
#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/gl/player.h>
#include <evalcts/gl/tokens.h>
#include "context_maker.h"
#include "kinds.h"
#include "shared_library.h"

namespace evalcts {

namespace {

// An interface that makes contexts, and functions of which a library that has it exports one.
struct Interface {
  const char* name;
  std::vector<const char*> functions;
};
const Interface kOSMesa = {"osmesa", {"OSMesaCreateContextExt", "OSMesaCreateContext"}};
const Interface kEgl = {"egl", {"eglGetDisplay"}};
const Interface kGlx = {"glx", {"glXCreateNewContext"}};
const Interface kWgl = {"wgl", {"wglCreateContext"}};
const Interface kCgl = {"cgl", {"CGLCreateContext"}};

bool has_interface(const SharedLibrary& library, const Interface& interface) {
  return std::ranges::any_of(interface.functions,
                             [&](const char* function) { return library.exported(function) != nullptr; });
}

// Contexts that --context names. `interface`: the interface that makes them; null if the library under test
// is never asked for it. `make`: makes them with the library; empty: with the system's.
struct NamedContexts {
  std::string name;
  const Interface* interface;
  std::function<std::unique_ptr<ContextMaker>(const std::string& library)> make;
};

const std::vector<NamedContexts>& named_contexts() {
  using Library = const std::string&;
  static const std::vector<NamedContexts> kAll = {
      {"osmesa", &kOSMesa, [](Library library) { return make_osmesa_contexts(library); }},
      {"egl-surfaceless", &kEgl,
       [](Library library) { return make_egl_contexts(library, EglPlatform::kSurfaceless); }},
      {"egl-device", &kEgl, [](Library library) { return make_egl_contexts(library, EglPlatform::kDevice); }},
      {"egl-gles2", nullptr, [](Library) { return make_gles2_contexts(); }},
      {"glx", &kGlx, [](Library library) { return make_glx_contexts(library, GlxRendering::kDirect); }},
      {"glx-indirect", &kGlx,
       [](Library library) { return make_glx_contexts(library, GlxRendering::kIndirect); }},
      {"wgl", &kWgl, [](Library library) { return make_wgl_contexts(library); }},
      {"cgl", &kCgl, [](Library library) { return make_cgl_contexts(library); }},
      {"none", nullptr, [](Library) { return make_no_contexts(); }},
  };
  return kAll;
}

std::string guessed_kind(const std::string& path) {
  const SharedLibrary library(path);
  if (library.exported("evalcts_sink_open")) return "sink";
  for (const Interface* interface : {&kOSMesa, &kEgl, &kGlx, &kWgl, &kCgl})
    if (has_interface(library, *interface)) return interface->name;
  if (library.exported("evalcts_provider_open"))
    throw CannotStart(fmt::format("{0} is a provider of contexts: pass it with --context", path));
  throw CannotStart(fmt::format(
      "{}: choose the interface that creates its contexts with --context ({}, or the path of a provider, see "
      "evalcts_provider.h)",
      fmt::format("{} exports none of OSMesaCreateContext, eglGetDisplay, glXCreateNewContext, "
                  "wglCreateContext, CGLCreateContext and evalcts_sink_open",
                  path),
      fmt::join(context_names(), ", ")));
}

// Returns true if the library makes contexts of this kind itself. Where there is fork(), it is loaded in
// another process, because a layer may have to be loaded once the context below it is current.
bool makes_its_contexts(const std::string& path, const NamedContexts& contexts) {
  if (path.empty() || !contexts.interface) return false;
#ifdef _WIN32
  return has_interface(SharedLibrary(path), *contexts.interface);
#else
  const pid_t child = fork();
  if (child < 0) throw CannotStart(fmt::format("fork: {}", std::strerror(errno)));
  if (child == 0) {
    bool has = false;
    try {
      has = has_interface(SharedLibrary(path), *contexts.interface);
    } catch (const CannotStart&) {  // reported when this process loads the library
    }
    _exit(has ? EXIT_SUCCESS : EXIT_FAILURE);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
#endif
}

std::unique_ptr<Implementation> open_with_context(const ImplementationOptions& options) {
  if (!options.name.empty()) throw CannotStart("--context replaces --implementation: give only one of them");
  if ((options.context == "none" || options.context == "egl-gles2") && options.library.empty())
    throw CannotStart(
        fmt::format("--context {} needs --library, which provides the commands", options.context));
  const auto found = std::find_if(named_contexts().begin(), named_contexts().end(),
                                  [&](const NamedContexts& named) { return named.name == options.context; });
  if (found != named_contexts().end()) {
    const bool own = makes_its_contexts(options.library, *found);
    return make_gl_library("library", found->make(own ? options.library : ""), own ? "" : options.library);
  }
  try {
    return make_gl_library("library", load_provider(options.context), options.library);
  } catch (const CannotStart& error) {
    if (options.context.find('/') != std::string::npos) throw;
    throw CannotStart(fmt::format("--context '{}' is neither one of {} nor a provider: {}", options.context,
                                  fmt::join(context_names(), ", "), error.what()));
  }
}

}  // namespace

std::vector<std::string> ImplementationOptions::words() const {
  std::vector<std::string> words;
  for (const auto& [option, value] : {std::pair{"--implementation", name},
                                      {"--library", library},
                                      {"--context", context},
                                      {"--mesa-build", mesa_build},
                                      {"--worker", worker}})
    if (!value.empty()) words.insert(words.end(), {option, value});
  return words;
}

const std::vector<ImplementationKind>& implementation_kinds() {
  static const std::vector<ImplementationKind> kKinds = {
      {"osmesa", "Mesa's off-screen library, libOSMesa", "libosmesa6", true},
      {"production", "libglevaluator, the evaluator of this project", "", true},
      {"reference", "the executable specification, in exact arithmetic", "", true},
      {"egl", "the GL of libEGL, without a window system", "libegl1", false},
      {"glx", "the GL of libGL, rendering directly, under an X server (without one: Xvfb)", "xvfb", false},
      {"glx-indirect", "the same, rendering indirectly: the GL of the X server", "xvfb", false},
      {"dropin", "libglevaluator_dropin, the drop-in library of this project, in front of libOSMesa",
       "libosmesa6", false},
      {"dropin-egl", "the same in front of libEGL, without a window system", "libegl1", false},
      {"dropin-glx", "the same in front of libGL, rendering directly, under an X server", "xvfb", false},
      {"wgl", "the GL of opengl32.dll on Windows, where a worker judges it (--worker)", "", false},
      {"cgl", "the GL of macOS (never tried), where a worker judges it (--worker)", "", false},
      {"sink", "an evaluator that is not a GL, given with --library", "", false},
  };
  return kKinds;
}

const std::vector<std::string>& context_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> all;
    for (const NamedContexts& named : named_contexts()) all.push_back(named.name);
    return all;
  }();
  return kNames;
}

std::unique_ptr<Implementation> open_implementation(const ImplementationOptions& options) {
  if (!options.context.empty()) return open_with_context(options);
  const std::string name = options.name.empty() ? guessed_kind(options.library) : options.name;
  if (name == "osmesa") return make_gl_library(name, make_osmesa_contexts(options.library), "");
  if (name == "egl") return make_gl_library(name, make_egl_contexts(options.library, EglPlatform::kAny), "");
  if (name == "glx" || name == "glx-indirect") {
    const GlxRendering rendering = name == "glx" ? GlxRendering::kDirect : GlxRendering::kIndirect;
    return make_gl_library(name, make_glx_contexts(options.library, rendering), "");
  }
  if (name == "wgl") return make_gl_library(name, make_wgl_contexts(options.library), "");
  if (name == "cgl") return make_gl_library(name, make_cgl_contexts(options.library), "");
  if (name == "dropin" || name == "dropin-egl" || name == "dropin-glx")
    return open_dropin(name, options.library);
  if (name == "sink") return open_sink(options.library);
  if (name == "reference" || name == "production") {
    if (!options.library.empty())
      throw CannotStart(fmt::format("{} is built in; --library does not go with it", name));
    return name == "reference" ? open_reference() : open_production();
  }
  std::vector<std::string> known;
  for (const ImplementationKind& kind : implementation_kinds()) known.push_back(kind.name);
  throw CannotStart(fmt::format("unknown implementation '{}'; known are: {}", name, fmt::join(known, ", ")));
}

#ifndef _WIN32
std::unique_ptr<ContextMaker> make_wgl_contexts(const std::string&) {
  throw CannotStart("WGL needs a worker on Windows, which --worker starts");
}
#endif

namespace {

// Returns true if the evaluator hands its vertices over and evaluates.
bool emits_vertices(Context& context) {
  if (!context.has_sink()) return false;
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_4, 0.0f, 1.0f, 4, 1, std::vector<float>(256, 0.75f));
  c.Enable(GL_MAP1_VERTEX_4);
  c.Begin(GL_POINTS);
  if (context.table().EvalCoord1f) c.EvalCoord1f(0.5f);
  if (context.table().EvalCoord1d) c.EvalCoord1d(0.5);
  c.End();
  c.Disable(GL_MAP1_VERTEX_4);
  context.play(c);
  return std::ranges::any_of(context.take_emitted(),
                             [](const ObservedPrimitive& primitive) { return !primitive.vertices.empty(); });
}

void require_an_effect(Context& context, const std::string& library, const ImplementationInfo& info) {
  const gl::Table& table = context.table();
  int missing = 0;
  const gl::EntryPoint essential[] = {gl::EntryPoint::Map1f, gl::EntryPoint::Map1d,
                                      gl::EntryPoint::EvalCoord1f, gl::EntryPoint::GetMapfv};
  for (const gl::EntryPoint entry : essential) missing += !gl::has(table, entry);
  if (missing == static_cast<int>(std::size(essential)))
    throw CannotStart(fmt::format(
        "{} has no evaluators: glMap1f, glMap1d, glEvalCoord1f and glGetMapfv are missing (GL_VERSION is "
        "'{}'). "
        "OpenGL ES has none; choose a desktop GL, or the library of a layer that adds them, with --library",
        library, info.version));
  if (missing > 0 || !table.GetError) return;  // an incomplete implementation is judged without a probe

  // Any answer is enough here, because the tests judge whether it is right. The memory is larger than the
  // map, so that a library that reads too much can be judged as well.
  gl::Case probe;
  probe.Map1f(GL_MAP1_VERTEX_4, 0.0f, 1.0f, 4, 2, std::vector<float>(256, 0.75f));
  const gl::Ref error = probe.GetError();
  const gl::Ref coefficients = probe.GetMapfv(GL_MAP1_VERTEX_4, GL_COEFF, gl::out<GLfloat>(8));
  const gl::Trace trace = gl::play(probe, table);
  if (trace.written(coefficients) == 0 && !emits_vertices(context))
    throw CannotStart(fmt::format(
        "evaluators have no effect in this context ({}): glMap1f gave {} and glGetMapfv writes nothing. {}",
        info.version, gl::error_name(trace.error(error)),
        info.at_least(3, 1)
            ? "A core profile has no evaluators; a compatibility context is needed."
            : "The library exports the commands, but they may be empty. If its evaluators work and only "
              "glGetMapfv is empty, plug them in as a sink (docs/test-your-gl.md)."));
}

// Returns true if state survives its context, as in a layer with one state for all contexts, or without
// contexts.
bool state_survives_context(Implementation& implementation) {
  constexpr GLint kSegments = 7;
  constexpr GLenum kMap = GL_MAP1_NORMAL;
  const auto has_commands = [](const gl::Table& gl) {
    return gl.MapGrid1f && gl.GetIntegerv && gl.Enable && gl.Disable && gl.IsEnabled;
  };
  {
    const std::unique_ptr<Context> first = implementation.create_context();
    if (!has_commands(first->table())) return false;
    first->table().MapGrid1f(kSegments, 0.25f, 0.75f);
    first->table().Enable(kMap);
  }
  const std::unique_ptr<Context> second = implementation.create_context();
  const gl::Table& gl = second->table();
  GLint segments = 0;
  gl.GetIntegerv(GL_MAP1_GRID_SEGMENTS, &segments);
  const bool survives = segments == kSegments || gl.IsEnabled(kMap) == GL_TRUE;
  gl.MapGrid1f(1, 0, 1);
  gl.Disable(kMap);
  gl::take_errors(second->table());
  return survives;
}

}  // namespace

std::string undeclared_part(const Declaration& declaration, const gl::Command& command) {
  if (declaration.max_order > 0 && gl::largest_order(command) > declaration.max_order)
    return fmt::format("order {}", gl::largest_order(command));
  if (declaration.targets.empty()) return {};
  const std::string_view kinds = gl::parameter_kinds(command.entry);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const auto* number = std::get_if<std::int64_t>(&command.arguments[i]);
    if (!number || kinds[i] != 'e') continue;
    const auto token = static_cast<GLenum>(*number);
    const bool is_declarable = gl::components_of(token) > 0 || token == GL_AUTO_NORMAL;
    if (is_declarable && !declaration.targets.contains(token)) return gl::token_name(token);
  }
  return {};
}

gl::Trace Context::play(const gl::Case& script) {
  return gl::play(script, table(), {}, [this](bool is_current) {
    try {
      is_current ? make_current() : release();
    } catch (const CannotStart& error) {
      throw NotObservable(std::string("pipeline: a context does not move between threads: ") + error.what());
    }
  });
}

bool ImplementationInfo::answers(GLenum queried) const {
  using enum gl::EntryPoint;
  return std::ranges::any_of(std::array{GetBooleanv, GetIntegerv, GetFloatv, GetDoublev}, [&](auto get) {
    return has(get) && !rejected_queries.contains({get, queried});
  });
}

ImplementationInfo inquire(Implementation& implementation) {
  ImplementationInfo info;
  if (const Declaration* declaration = implementation.declaration()) info.declaration = *declaration;
  info.name = implementation.name();
  info.library = implementation.library();
  std::unique_ptr<Context> context = implementation.create_context();
  const gl::Table& table = context->table();

  const auto string_of = [&](GLenum name) -> std::string {
    if (!table.GetString) return {};
    const GLubyte* text = table.GetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
  };
  info.vendor = string_of(GL_VENDOR);
  info.renderer = string_of(GL_RENDERER);
  info.version = string_of(GL_VERSION);
  if (info.version.empty())
    throw CannotStart(
        "glGetString(GL_VERSION) returns no string: the context is not current, or the library is broken");
  const gl::Advertised advertised = gl::parse_advertised(info.version, string_of(GL_EXTENSIONS));
  info.major = advertised.version / 10;
  info.minor = advertised.version % 10;
  info.extensions.insert(advertised.extensions.begin(), advertised.extensions.end());

  const auto integer_of = [&](GLenum name, GLint otherwise) {
    GLint value = otherwise;
    if (table.GetIntegerv) table.GetIntegerv(name, &value);
    return value;
  };
  info.max_eval_order = integer_of(GL_MAX_EVAL_ORDER, info.declaration ? info.declaration->max_order : 0);
  if (GLfloat order = 0; info.max_eval_order == 0 && table.GetFloatv) {
    table.GetFloatv(GL_MAX_EVAL_ORDER, &order);
    if (order >= 1 && order < 0x1p31f) info.max_eval_order = static_cast<GLint>(order);
  }
  info.texture_units = integer_of(info.at_least(2, 0) ? GL_MAX_TEXTURE_COORDS : GL_MAX_TEXTURE_UNITS, 1);
  info.active_units = info.texture_units;
  if (info.at_least(2, 0))
    info.active_units = std::max(info.active_units, integer_of(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 1));

  info.no_error = (info.at_least(4, 6) || info.extensions.contains("GL_KHR_no_error")) &&
                  (integer_of(GL_CONTEXT_FLAGS, 0) & GL_CONTEXT_FLAG_NO_ERROR_BIT) != 0;
  gl::take_errors(table);

  for (std::size_t i = 0; i < gl::kEntryPointCount; ++i)
    if (const auto command = static_cast<gl::EntryPoint>(i); !gl::has(table, command))
      info.missing.insert(command);
  info.idle_capability = gl::find_idle_capability(table);
  info.is_in_front = !implementation.library_below().empty() || !implementation.context_library().empty();
  require_an_effect(*context, info.library.empty() ? "the library" : info.library, info);
  context.reset();
  info.shares_state = state_survives_context(implementation);
  info.rejected_queries = find_rejected_queries(implementation, kOtherQueries);
  info.rejected_grid_queries = find_unanswered_grid_queries(implementation);
  return info;
}

}  // namespace evalcts
