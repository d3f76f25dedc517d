// Registers the evaluators of OSMesa with the benchmarks (side.h). A vertex shader writes the vertices to a
// transform feedback buffer, and nothing is rasterized.
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>

#include <array>
#include <stdexcept>
#include <string>

#include "side.h"

namespace evalcts::bench {
namespace {

// Types of Mesa's osmesa.h.
using CreateContext = void* (*)(GLenum format, void* share);
using MakeCurrent = GLboolean (*)(void* context, void* buffer, GLenum type, GLsizei width, GLsizei height);

#define EVALCTS_GL(name) decltype(&::name) name = find<decltype(&::name)>(#name)
#define EVALCTS_GL_EXT(type, name) type name = find<type>(#name)
// One current context for all benchmarks, with a buffer that takes the positions.
struct OSMesa {
  // The library is opened at run time, so that the benchmarks are not linked to a GL. It is never closed.
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  EVALCTS_GL(glBegin);
  EVALCTS_GL(glEnd);
  EVALCTS_GL(glEnable);
  EVALCTS_GL(glDisable);
  EVALCTS_GL(glMap1f);
  EVALCTS_GL(glMap2f);
  EVALCTS_GL(glMapGrid2f);
  EVALCTS_GL(glEvalCoord1f);
  EVALCTS_GL(glEvalMesh2);
  EVALCTS_GL(glGetError);
  EVALCTS_GL_EXT(PFNGLCREATESHADERPROC, glCreateShader);
  EVALCTS_GL_EXT(PFNGLSHADERSOURCEPROC, glShaderSource);
  EVALCTS_GL_EXT(PFNGLCOMPILESHADERPROC, glCompileShader);
  EVALCTS_GL_EXT(PFNGLCREATEPROGRAMPROC, glCreateProgram);
  EVALCTS_GL_EXT(PFNGLATTACHSHADERPROC, glAttachShader);
  EVALCTS_GL_EXT(PFNGLTRANSFORMFEEDBACKVARYINGSPROC, glTransformFeedbackVaryings);
  EVALCTS_GL_EXT(PFNGLLINKPROGRAMPROC, glLinkProgram);
  EVALCTS_GL_EXT(PFNGLUSEPROGRAMPROC, glUseProgram);
  EVALCTS_GL_EXT(PFNGLGENBUFFERSPROC, glGenBuffers);
  EVALCTS_GL_EXT(PFNGLBINDBUFFERBASEPROC, glBindBufferBase);
  EVALCTS_GL_EXT(PFNGLBUFFERDATAPROC, glBufferData);
  EVALCTS_GL_EXT(PFNGLGETBUFFERSUBDATAPROC, glGetBufferSubData);
  EVALCTS_GL_EXT(PFNGLBEGINTRANSFORMFEEDBACKPROC, glBeginTransformFeedback);
  EVALCTS_GL_EXT(PFNGLENDTRANSFORMFEEDBACKPROC, glEndTransformFeedback);

  // Throws std::runtime_error with the message of the loader.
  template <class Function>
  Function find(const char* symbol) const {
    void* const address = library ? dlsym(library, symbol) : nullptr;
    if (!address) throw std::runtime_error(dlerror());
    return reinterpret_cast<Function>(address);
  }

  OSMesa() {
    void* const context = find<CreateContext>("OSMesaCreateContext")(GL_RGBA, nullptr);
    if (!context || !find<MakeCurrent>("OSMesaMakeCurrent")(context, pixels.data(), GL_UNSIGNED_BYTE, 16, 16))
      throw std::runtime_error("OSMesa gives no context");
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glEnable(GL_RASTERIZER_DISCARD);
    for (const int components : {3, 4}) programs[components] = program(components);
  }

  GLuint program(int components) {
    const std::string type = "vec" + std::to_string(components), swizzle = components == 3 ? "xyz" : "xyzw";
    const std::string text = "#version 130\nout " + type + " position;\nvoid main() { position = gl_Vertex." +
                             swizzle + "; gl_Position = gl_Vertex; }\n";
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER), result = glCreateProgram();
    const GLchar* const source = text.c_str();
    const GLchar* const varying = "position";
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(result, shader);
    glTransformFeedbackVaryings(result, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(result);
    return result;
  }

  // Enables only this vertex map, and makes room for `points` positions.
  void select(GLenum map, int components, std::size_t points) {
    for (const GLenum other : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
      if (other == map) {
        glEnable(other);
      } else {
        glDisable(other);
      }
    }
    glUseProgram(programs[components]);
    const auto bytes = static_cast<GLsizeiptr>(points * components * sizeof(float));
    if (bytes == room) return;
    room = bytes;
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
  }

  template <class Draw>
  void record(float* positions, const Draw& draw) {
    glBeginTransformFeedback(GL_POINTS);
    draw();
    glEndTransformFeedback();
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, room, positions);
    if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OSMesa reports an error");
  }

  std::array<GLuint, 5> programs{};
  GLsizeiptr room = 0;  // size of the buffer in bytes
  std::array<unsigned char, 16 * 16 * 4> pixels{};
};
#undef EVALCTS_GL
#undef EVALCTS_GL_EXT

OSMesa& gl() {
  static OSMesa osmesa;
  return osmesa;
}

CurveSide side(const Curve& curve) {
  const GLenum target = curve.components == 3 ? GL_MAP1_VERTEX_3 : GL_MAP1_VERTEX_4;
  return [&curve, target](float* results) {
    gl().select(target, curve.components, curve.u.size());
    gl().glMap1f(target, 0, 1, curve.components, curve.order, curve.points.data());
    gl().record(results, [&curve] {
      gl().glBegin(GL_POINTS);
      for (const float u : curve.u) gl().glEvalCoord1f(u);
      gl().glEnd();
    });
  };
}

MeshSide side(const Mesh& mesh) {
  const GLenum target = mesh.components == 3 ? GL_MAP2_VERTEX_3 : GL_MAP2_VERTEX_4;
  return [&mesh, target](int row, int rows, float* results) {
    gl().select(target, mesh.components, static_cast<std::size_t>(mesh.columns) * rows);
    gl().glMap2f(target, 0, 1, mesh.components, mesh.order, 0, 1, mesh.order * mesh.components, mesh.order,
                 mesh.points.data());
    gl().glMapGrid2f(mesh.columns - 1, 0, 1, mesh.rows - 1, 0, 1);
    gl().record(results,
                [&mesh, row, rows] { gl().glEvalMesh2(GL_POINT, 0, mesh.columns - 1, row, row + rows - 1); });
  };
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Curve& curve : curves()) add(curve, "OSMesa", [&curve] { return side(curve); });
  for (const Mesh& mesh : meshes()) {
    if (mesh.ring != mesh.rows && !mesh.normals)
      add(mesh, "OSMesa", Unit::kStrip, [&mesh] { return side(mesh); });
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
