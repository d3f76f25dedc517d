// Variations of the commands that a library provides, of its answers to queries, and of the
// state of contexts.
#include <cstdio>
#include <ctime>
#include <iterator>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "variation.h"

namespace evalcts::variations {
namespace {

// --- Errors of the variation itself ------------------------------------------------------------------------

// Makes GetError return the variation's own pending error first, except between Begin and End, where GetError
// is itself an error.
void keep_own_errors(Varied& v) {
  v.gl.GetError = [] {
    if (remembered.inside || remembered.error == GL_NO_ERROR) return unvaried.GetError();
    return std::exchange(remembered.error, static_cast<GLenum>(GL_NO_ERROR));
  };
}

void raise_own(GLenum error) {
  if (remembered.error == GL_NO_ERROR) remembered.error = error;
}

// A distributed GL has several error flags, and GetError returns any of those that are set (GL 1.0 2.5). Here
// it returns the largest, not the first.
std::set<GLenum> error_flags;

void collect_errors() {
  for (int i = 0; i < 16; ++i) {
    const GLenum error = unvaried.GetError();
    if (error == GL_NO_ERROR) return;
    error_flags.insert(error);
  }
}

// Wraps a command that is an error between Begin and End, so that GetError may follow it.
template <auto kCommand, class Signature>
struct Collecting;
template <auto kCommand, class... A>
struct Collecting<kCommand, void (*)(A...)> {
  static void run(A... arguments) {
    (unvaried.*kCommand)(arguments...);
    collect_errors();
  }
};

EVALCTS_VARIATION(SeveralErrorFlags, "dropin", "there are several error flags; GetError answers the largest",
                  "") {
  error_flags.clear();
  v.gl.GetError = []() -> GLenum {
    collect_errors();
    if (error_flags.empty()) return GL_NO_ERROR;
    return error_flags.extract(std::prev(error_flags.end())).value();
  };
#define COLLECT(name) v.gl.name = Collecting<&gl::Table::name, std::remove_cvref_t<decltype(v.gl.name)>>::run
  COLLECT(Map1f);
  COLLECT(Map1d);
  COLLECT(Map2f);
  COLLECT(Map2d);
  COLLECT(MapGrid1f);
  COLLECT(MapGrid1d);
  COLLECT(MapGrid2f);
  COLLECT(MapGrid2d);
  COLLECT(EvalMesh1);
  COLLECT(EvalMesh2);
  COLLECT(GetMapfv);
  COLLECT(GetMapdv);
  COLLECT(GetMapiv);
  COLLECT(GetFloatv);
  COLLECT(Enable);
  COLLECT(Disable);
  COLLECT(PopAttrib);
#undef COLLECT
}

// --- Queries -----------------------------------------------------------------------------------------------

// Sets the four Get commands to lambdas that answer some names themselves: Answer::answer(GLenum pname, T*
// values) returns true if it has answered.
template <class Answer>
void vary_queries(Varied& v) {
  v.gl.GetBooleanv = [](GLenum name, GLboolean* values) {
    if (remembered.inside || !Answer::answer(name, values)) unvaried.GetBooleanv(name, values);
  };
  v.gl.GetIntegerv = [](GLenum name, GLint* values) {
    if (remembered.inside || !Answer::answer(name, values)) unvaried.GetIntegerv(name, values);
  };
  v.gl.GetFloatv = [](GLenum name, GLfloat* values) {
    if (remembered.inside || !Answer::answer(name, values)) unvaried.GetFloatv(name, values);
  };
  v.gl.GetDoublev = [](GLenum name, GLdouble* values) {
    if (remembered.inside || !Answer::answer(name, values)) unvaried.GetDoublev(name, values);
  };
}

struct RejectMaxOrder {
  template <class T>
  static bool answer(GLenum name, T*) {
    if (name != GL_MAX_EVAL_ORDER) return false;
    raise_own(GL_INVALID_ENUM);
    return true;
  }
};
EVALCTS_VARIATION(MaxOrderUnanswered, "dropin", "the query of MAX_EVAL_ORDER is rejected",
                  "EV-INIT-MAXORDER EV-GET-MAXORDER") {
  keep_own_errors(v);
  vary_queries<RejectMaxOrder>(v);
}

constexpr GLint kSmallestMaxOrder = 8;

struct AnswerEight {
  template <class T>
  static bool answer(GLenum name, T* values) {
    if (name != GL_MAX_EVAL_ORDER) return false;
    if constexpr (std::is_same_v<T, GLboolean>)
      *values = GL_TRUE;
    else
      *values = static_cast<T>(kSmallestMaxOrder);
    return true;
  }
};
// Replaces an order above the limit by 0, which is rejected with the same error.
GLint limited(GLint order) { return order > kSmallestMaxOrder ? 0 : order; }

EVALCTS_VARIATION(MaxOrderEight, "production", "MAX_EVAL_ORDER is 8, as small as it may be", "") {
  vary_queries<AnswerEight>(v);
  v.gl.Map1f = [](GLenum t, GLfloat u1, GLfloat u2, GLint s, GLint o, const GLfloat* p) {
    unvaried.Map1f(t, u1, u2, s, limited(o), p);
  };
  v.gl.Map1d = [](GLenum t, GLdouble u1, GLdouble u2, GLint s, GLint o, const GLdouble* p) {
    unvaried.Map1d(t, u1, u2, s, limited(o), p);
  };
  v.gl.Map2f = [](GLenum t, GLfloat u1, GLfloat u2, GLint us, GLint uo, GLfloat v1, GLfloat v2, GLint vs,
                  GLint vo, const GLfloat* p) {
    unvaried.Map2f(t, u1, u2, us, limited(uo), v1, v2, vs, limited(vo), p);
  };
  v.gl.Map2d = [](GLenum t, GLdouble u1, GLdouble u2, GLint us, GLint uo, GLdouble v1, GLdouble v2, GLint vs,
                  GLint vo, const GLdouble* p) {
    unvaried.Map2d(t, u1, u2, us, limited(uo), v1, v2, vs, limited(vo), p);
  };
}

struct RejectOthers {
  template <class T>
  static bool answer(GLenum name, T*) {
    switch (name) {
      case GL_CURRENT_RASTER_POSITION:
      case GL_CURRENT_RASTER_COLOR:
      case GL_CURRENT_INDEX:
      case GL_EDGE_FLAG:
      case GL_LIST_BASE:
      case GL_LIST_INDEX:
      case GL_LIST_MODE:
      case GL_MATRIX_MODE:
      case GL_LINE_WIDTH:
      case GL_POINT_SIZE:
      case GL_SHADE_MODEL:
        raise_own(GL_INVALID_ENUM);
        return true;
      default:
        return false;
    }
  }
};
EVALCTS_VARIATION(QueriesRefused, "dropin", "queries of state that is not about evaluators are rejected",
                  "") {
  keep_own_errors(v);
  vary_queries<RejectOthers>(v);
}

EVALCTS_VARIATION(OneTextureUnit, "dropin", "there is one texture unit, and no multitexture", "") {
  struct One {
    static bool is_limit(GLenum name) {
      return name == GL_MAX_TEXTURE_UNITS || name == GL_MAX_TEXTURE_COORDS;
    }
  };
  v.gl.GetIntegerv = [](GLenum name, GLint* values) {
    if (!remembered.inside && One::is_limit(name))
      *values = 1;
    else
      unvaried.GetIntegerv(name, values);
  };
}

// True for capabilities that a layer over OpenGL ES does not support.
bool is_rejected(GLenum capability) {
  return capability == GL_INDEX_LOGIC_OP || capability == GL_COLOR_LOGIC_OP;
}

EVALCTS_VARIATION(CapabilitiesRefused, "dropin", "the capabilities of logical operations are rejected", "") {
  keep_own_errors(v);
  v.gl.Enable = [](GLenum capability) {
    is_rejected(capability) ? raise_own(GL_INVALID_ENUM) : unvaried.Enable(capability);
  };
  v.gl.Disable = [](GLenum capability) {
    is_rejected(capability) ? raise_own(GL_INVALID_ENUM) : unvaried.Disable(capability);
  };
  v.gl.IsEnabled = [](GLenum capability) -> GLboolean {
    if (!is_rejected(capability)) return unvaried.IsEnabled(capability);
    raise_own(GL_INVALID_ENUM);
    return GL_FALSE;
  };
}

EVALCTS_VARIATION(AnswersInsidePrimitives, "dropin",
                  "IsEnabled answers between Begin and End, without an error, of all capabilities", "") {
  v.gl.IsEnabled = [](GLenum capability) -> GLboolean {
    return remembered.inside ? GL_TRUE : unvaried.IsEnabled(capability);
  };
}

// --- Versions and missing commands -------------------------------------------------------------------------

void remove_since_1_2(gl::Table& table) {
#define REMOVE(name) table.name = nullptr
  REMOVE(ActiveTexture);
  REMOVE(MultiTexCoord1f);
  REMOVE(MultiTexCoord2f);
  REMOVE(MultiTexCoord3f);
  REMOVE(MultiTexCoord4f);
  REMOVE(MultiTexCoord1d);
  REMOVE(MultiTexCoord2d);
  REMOVE(MultiTexCoord3d);
  REMOVE(MultiTexCoord4d);
  REMOVE(MultiTexCoord1fv);
  REMOVE(MultiTexCoord2fv);
  REMOVE(MultiTexCoord3fv);
  REMOVE(MultiTexCoord4fv);
  REMOVE(MultiTexCoord1dv);
  REMOVE(MultiTexCoord2dv);
  REMOVE(MultiTexCoord3dv);
  REMOVE(MultiTexCoord4dv);
  REMOVE(SecondaryColor3f);
  REMOVE(FogCoordf);
  REMOVE(VertexAttrib4f);
  REMOVE(GetVertexAttribfv);
  REMOVE(GetStringi);
  REMOVE(GetnMapfv);
  REMOVE(GetnMapdv);
  REMOVE(GetnMapiv);
  REMOVE(ClampColor);
  REMOVE(CreateShader);
  REMOVE(ShaderSource);
  REMOVE(CompileShader);
  REMOVE(CreateProgram);
  REMOVE(LinkProgram);
  REMOVE(UseProgram);
  REMOVE(TransformFeedbackVaryings);
  REMOVE(BeginTransformFeedback);
  REMOVE(EndTransformFeedback);
  REMOVE(GenBuffers);
  REMOVE(BindBuffer);
  REMOVE(BufferData);
  REMOVE(BindBufferBase);
  REMOVE(GenQueries);
  REMOVE(BeginQuery);
  REMOVE(EndQuery);
  REMOVE(BeginConditionalRender);
  REMOVE(EndConditionalRender);
  REMOVE(PrimitiveRestartIndex);
  REMOVE(PatchParameteri);
  REMOVE(ProvokingVertex);
  REMOVE(GenFramebuffers);
  REMOVE(BindFramebuffer);
  REMOVE(CheckFramebufferStatus);
  REMOVE(BindProgramARB);
  REMOVE(ProgramStringARB);
  REMOVE(BindProgramNV);
  REMOVE(LoadProgramNV);
  REMOVE(GetDebugMessageLog);
#undef REMOVE
}

template <int kTenths>
void set_version(Varied& v) {
  v.gl.GetString = [](GLenum name) -> const GLubyte* {
    static constexpr char kVersion[] = {'0' + kTenths / 10, '.', '0' + kTenths % 10, '\0'};
    if (name == GL_VERSION) return reinterpret_cast<const GLubyte*>(kVersion);
    if (name == GL_EXTENSIONS) return reinterpret_cast<const GLubyte*>("");
    return unvaried.GetString(name);
  };
}

EVALCTS_VARIATION(Version11, "dropin", "the GL is 1.1, without any extension", "") {
  set_version<11>(v);
  remove_since_1_2(v.gl);
}
EVALCTS_VARIATION(Version15, "dropin", "the GL is 1.5, without any extension", "") { set_version<15>(v); }

EVALCTS_VARIATION(NoLists, "dropin", "there are no display lists", "") {
  v.gl.NewList = nullptr;
  v.gl.EndList = nullptr;
  v.gl.CallList = nullptr;
  v.gl.CallLists = nullptr;
  v.gl.ListBase = nullptr;
  v.gl.GenLists = nullptr;
  v.gl.IsList = nullptr;
  v.gl.DeleteLists = nullptr;
}

EVALCTS_VARIATION(NoAttributeStack, "dropin", "there is no attribute stack", "") {
  v.gl.PushAttrib = nullptr;
  v.gl.PopAttrib = nullptr;
}

EVALCTS_VARIATION(NoDoubles, "dropin", "the commands with doubles are missing", "EV-API-ENTRY") {
  v.gl.Map1d = nullptr;
  v.gl.Map2d = nullptr;
  v.gl.MapGrid1d = nullptr;
  v.gl.MapGrid2d = nullptr;
  v.gl.EvalCoord1d = nullptr;
  v.gl.EvalCoord2d = nullptr;
  v.gl.EvalCoord1dv = nullptr;
  v.gl.EvalCoord2dv = nullptr;
  v.gl.GetMapdv = nullptr;
}

EVALCTS_VARIATION(NoGetnMap, "dropin", "there is no GetnMap", "") {
  v.gl.GetnMapfv = nullptr;
  v.gl.GetnMapdv = nullptr;
  v.gl.GetnMapiv = nullptr;
}
EVALCTS_VARIATION(NoGetDouble, "dropin", "GetDoublev and GetMapdv are missing", "EV-API-ENTRY") {
  v.gl.GetDoublev = nullptr;
  v.gl.GetMapdv = nullptr;
}
EVALCTS_VARIATION(NoGetMapiv, "dropin", "GetMapiv is missing", "EV-API-ENTRY") { v.gl.GetMapiv = nullptr; }
EVALCTS_VARIATION(NoGetMapfv, "dropin", "GetMapfv is missing", "EV-API-ENTRY") { v.gl.GetMapfv = nullptr; }
EVALCTS_VARIATION(NoColorIndex, "dropin", "the commands of colour-index mode are missing", "") {
  v.gl.Indexf = nullptr;
  v.gl.Indexd = nullptr;
  v.gl.Indexfv = nullptr;
  v.gl.Indexdv = nullptr;
}
EVALCTS_VARIATION(NoPixels, "dropin", "pixels cannot be read", "") { v.gl.ReadPixels = nullptr; }
EVALCTS_VARIATION(NoShaders, "dropin", "there are no shaders", "") {
  v.gl.CreateShader = nullptr;
  v.gl.CreateProgram = nullptr;
}
EVALCTS_VARIATION(NoTextures, "dropin", "there are no textures", "") {
  v.gl.BindTexture = nullptr;
  v.gl.TexImage2D = nullptr;
  v.gl.TexParameteri = nullptr;
}

EVALCTS_VARIATION(WordyVersion, "dropin",
                  "words and more numbers follow the version, and 64 KiB of extensions are "
                  "advertised",
                  "") {
  v.gl.GetString = [](GLenum name) -> const GLubyte* {
    static std::string version, extensions;
    const GLubyte* const inner = unvaried.GetString(name);
    if (!inner) return inner;
    const auto* const text = reinterpret_cast<const char*>(inner);
    if (name == GL_VERSION) {
      version =
          std::string(text).substr(0, 3) + ".0 - Build 31.0.101.2115 (\"Vendor's\", \xc2\xae) 9.9 ES 3.2";
      return reinterpret_cast<const GLubyte*>(version.c_str());
    }
    if (name == GL_EXTENSIONS) {
      extensions = text;
      while (extensions.size() < 65536)
        extensions += " GL_VENDOR_extension_" + std::to_string(extensions.size());
      return reinterpret_cast<const GLubyte*>(extensions.c_str());
    }
    return inner;
  };
}

EVALCTS_VARIATION(StringsUnanswered, "dropin", "VENDOR, RENDERER and EXTENSIONS are not answered", "") {
  v.gl.GetStringi = nullptr;
  v.gl.GetString = [](GLenum name) -> const GLubyte* {
    return name == GL_VERSION ? unvaried.GetString(name) : nullptr;
  };
}

// --- Contexts ----------------------------------------------------------------------------------------------

EVALCTS_VARIATION(OneContext, "dropin", "there can be one context at a time", "") {
  v.gl.OtherContextEVALCTS = nullptr;
  v.gl.SharingContextEVALCTS = nullptr;
  v.gl.ContextOfKindEVALCTS = nullptr;
  v.gl.CopyContextEVALCTS = nullptr;
}
EVALCTS_VARIATION(OneStateInProcess, "production", "all contexts have one state", "") { v.one_state = true; }
EVALCTS_VARIATION(OneState, "dropin", "all contexts have one state", "") { v.one_state = true; }

// --- State outside of evaluators

EVALCTS_VARIATION(NoisyOutput, "production", "each EvalCoord writes to standard output and standard error",
                  "") {
  v.gl.EvalCoord1f = [](GLfloat u) {
    std::printf("EvalCoord1f %g\n", static_cast<double>(u));
    std::fprintf(stderr, "{\"event\": \"EvalCoord1f\"}\n");
    unvaried.EvalCoord1f(u);
  };
}

EVALCTS_VARIATION(Slow, "dropin", "each GetError takes a millisecond", "") {
  v.gl.GetError = [] {
    const timespec millisecond{0, 1000000};
    nanosleep(&millisecond, nullptr);
    return unvaried.GetError();
  };
}

}  // namespace
}  // namespace evalcts::variations
