// The evaluators' state, and the vertices that come out of them: sent to the GL below as Color4, Normal3,
// TexCoord and Vertex commands, with the current values brought back behind them.
#include <cmath>

#include "production/dropin/context.h"

namespace glev::dropin {
namespace {

// The bits of Context::enabled: nine maps of each dimension, in the order of their tokens, and AUTO_NORMAL.
constexpr int kColorMap = 0, kNormalMap = 2, kFirstTextureMap = 3, kLastTextureMap = 6, kVertex3Map = 7,
              kVertex4Map = 8, kMaps = 9;
constexpr std::uint32_t kAutoNormal = 1u << (2 * kMaps);

constexpr std::uint32_t Bit(int dimension, int map) { return 1u << (map + (dimension - 1) * kMaps); }
constexpr std::uint32_t BothBits(int map) { return Bit(1, map) | Bit(2, map); }

GLenum CapOf(int bit) {
  if (bit == 2 * kMaps) return GL_AUTO_NORMAL;
  return static_cast<GLenum>(bit < kMaps ? GL_MAP1_COLOR_4 + bit : GL_MAP2_COLOR_4 + bit - kMaps);
}

// What the enabled maps of a dimension give: components, 0 for nothing.
struct Given {
  bool color, normal;
  int texture, vertex;
};

Given GivenBy(std::uint32_t enabled, int dimension) {
  Given given = {};
  given.color = (enabled & Bit(dimension, kColorMap)) != 0;
  given.normal =
      (enabled & Bit(dimension, kNormalMap)) != 0 || (dimension == 2 && (enabled & kAutoNormal) != 0);
  for (int map = kFirstTextureMap; map <= kLastTextureMap; ++map)
    if ((enabled & Bit(dimension, map)) != 0) given.texture = map - kFirstTextureMap + 1;
  for (const int map : {kVertex3Map, kVertex4Map})
    if ((enabled & Bit(dimension, map)) != 0) given.vertex = map - kVertex3Map + 3;
  return given;
}

template <auto kCommand>
Setter Keep(const GLfloat (&values)[4]) {
  Setter setter;
  setter.send = [](const void* kept) { (Gl().*kCommand)(static_cast<const GLfloat*>(kept)); };
  std::memcpy(setter.values, values, sizeof values);
  return setter;
}

}  // namespace

// --- State

void Context::UpdateEnabled() {
  enabled = 0;
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(evaluators, CapOf(bit))) enabled |= 1u << bit;
}

bool Context::HasVertexMap() const {
  return (enabled & (BothBits(kVertex3Map) | BothBits(kVertex4Map))) != 0;
}

void Context::SetEnabled(GLenum cap, bool on) {
  if (!IsOutside()) return;
  if (on)
    glevEnable(evaluators, cap);
  else
    glevDisable(evaluators, cap);
  Report();
  UpdateEnabled();
}

// Map wants unit 0 to be the active one.
void Context::SetActiveTexture() {
  const bool is_first = !multitexture || Integer(GL_ACTIVE_TEXTURE, GL_TEXTURE0) == GL_TEXTURE0;
  glevActiveTexture(evaluators, is_first ? GL_TEXTURE0 : GL_TEXTURE1);
}

template <>
void Context::Map1(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap1f(evaluators, target, u1, u2, stride, order, points);
  Report();
}
template <>
void Context::Map1(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap1d(evaluators, target, u1, u2, stride, order, points);
  Report();
}
template <>
void Context::Map2(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap2f(evaluators, target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  Report();
}
template <>
void Context::Map2(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
  if (!IsOutside()) return;
  SetActiveTexture();
  glevMap2d(evaluators, target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  Report();
}

void Context::MapGrid1(GLint n, double u1, double u2) {
  if (!IsOutside()) return;
  glevMapGrid1d(evaluators, n, u1, u2);
  Report();
}
void Context::MapGrid2(GLint un, double u1, double u2, GLint vn, double v1, double v2) {
  if (!IsOutside()) return;
  glevMapGrid2d(evaluators, un, u1, u2, vn, v1, v2);
  Report();
}

// Whether there was room, or anything to pop, the GL below knows.
void Context::PushAttrib(GLbitfield mask) {
  const GLint before = Integer(GL_ATTRIB_STACK_DEPTH, -1);
  Gl().PushAttrib(mask);
  if (before < 0 || before >= 64 || Integer(GL_ATTRIB_STACK_DEPTH, -1) != before + 1) return;
  pushed[before] = (mask & (GL_EVAL_BIT | GL_ENABLE_BIT)) != 0;
  if (!pushed[before]) return;
  glevPushAttrib(evaluators, mask & (GL_EVAL_BIT | GL_ENABLE_BIT));
  pushed[before] = glevGetError(evaluators) == GLEV_NO_ERROR;
}

void Context::PopAttrib() {
  const GLint before = Integer(GL_ATTRIB_STACK_DEPTH, -1);
  if (evaluators_used && before > 0) {
    GLfloat color[4];
    Gl().GetFloatv(GL_CURRENT_COLOR, color);  // Mesa: what is still pending would come after PopAttrib
  }
  Gl().PopAttrib();
  list_base_known = false;
  if (before < 1 || before > 64 || Integer(GL_ATTRIB_STACK_DEPTH, -1) != before - 1) return;
  if (!pushed[before - 1]) return;
  pushed[before - 1] = false;
  glevPopAttrib(evaluators);
  UpdateEnabled();
}

void Context::CopyEvalAttributes(const Context& from, bool grids) {
  for (int bit = 0; bit <= 2 * kMaps; ++bit)
    if (glevIsEnabled(from.evaluators, CapOf(bit)))
      glevEnable(evaluators, CapOf(bit));
    else
      glevDisable(evaluators, CapOf(bit));
  UpdateEnabled();
  if (!grids) return;
  GLint n[2] = {};
  GLdouble ends[4] = {};
  glevGetIntegerv(from.evaluators, GL_MAP1_GRID_SEGMENTS, n);
  glevGetDoublev(from.evaluators, GL_MAP1_GRID_DOMAIN, ends);
  glevMapGrid1d(evaluators, n[0], ends[0], ends[1]);
  glevGetIntegerv(from.evaluators, GL_MAP2_GRID_SEGMENTS, n);
  glevGetDoublev(from.evaluators, GL_MAP2_GRID_DOMAIN, ends);
  glevMapGrid2d(evaluators, n[0], ends[0], ends[1], n[1], ends[2], ends[3]);
}

// --- Current values

// Those that maps stand in for; between Begin and End they cannot be queried.
void Context::Snapshot() {
  GLfloat values[4] = {};
  for (Setter& setter : current) setter.send = nullptr;
  if ((enabled & BothBits(kColorMap)) != 0) {
    Gl().GetFloatv(GL_CURRENT_COLOR, values);
    current[kColor] = Keep<&GlBelow::Color4fv>(values);
  }
  if ((enabled & (BothBits(kNormalMap) | kAutoNormal)) != 0) {
    Gl().GetFloatv(GL_CURRENT_NORMAL, values);
    current[kNormal] = Keep<&GlBelow::Normal3fv>(values);
  }
  std::uint32_t textures = 0;
  for (int map = kFirstTextureMap; map <= kLastTextureMap; ++map) textures |= BothBits(map);
  if ((enabled & textures) != 0) {
    const GLint active = multitexture ? Integer(GL_ACTIVE_TEXTURE, GL_TEXTURE0) : GL_TEXTURE0;
    if (active != GL_TEXTURE0) Gl().ActiveTexture(GL_TEXTURE0);
    Gl().GetFloatv(GL_CURRENT_TEXTURE_COORDS, values);
    if (active != GL_TEXTURE0) Gl().ActiveTexture(static_cast<GLenum>(active));
    current[kTexCoord] = Keep<&GlBelow::TexCoord4fv>(values);
  }
  keeps_length = (enabled & kAutoNormal) != 0 && VertexShaderIsActive();
}

void Context::BeforePrimitive() {
  if (maybe_inside) return;
  if (!list_base_known && list_base_used) list_base = static_cast<GLuint>(Integer(GL_LIST_BASE, 0));
  list_base_known = true;
  if (HasVertexMap()) Snapshot();
}

void Context::Restore(int dimension) {
  const Given given = GivenBy(enabled, dimension);
  if (given.color) current[kColor].Send();
  if (given.normal) current[kNormal].Send();
  if (given.texture > 0) current[kTexCoord].Send();
}

// --- Automatic normals with a vertex shader: m = q_u x q_v as it is (GL 2.0 5.1, ARB_vertex_program issue
// 92)

bool Context::VertexShaderIsActive() {
  if (vertex_programs && Gl().IsEnabled(GL_VERTEX_PROGRAM_ARB)) return true;
  if (version < 20) return false;
  const auto program = static_cast<GLuint>(Integer(GL_CURRENT_PROGRAM, 0));
  if (program == 0) {
    const auto pipeline = static_cast<GLuint>(version >= 41 ? Integer(GL_PROGRAM_PIPELINE_BINDING, 0) : 0);
    GLint shader = 0;
    if (pipeline != 0) Gl().GetProgramPipelineiv(pipeline, GL_VERTEX_SHADER, &shader);
    return shader != 0;
  }
  GLuint shaders[16];
  GLsizei count = 0;
  Gl().GetAttachedShaders(program, 16, &count, shaders);
  for (GLsizei i = 0; i < count; ++i) {
    GLint type = 0;
    Gl().GetShaderiv(shaders[i], GL_SHADER_TYPE, &type);
    if (type == GL_VERTEX_SHADER) return true;
  }
  return count == 0;  // detached after linking
}

// Of one point, whose arguments are in either.
double Context::LengthOfNormal(const glev_batch* batch, const glev_mesh* mesh) {
  const glev_plan_info info = {sizeof info, 2};
  glev_plan* plan = nullptr;
  if (glevCreatePlan(evaluators, &info, &plan) != GLEV_SUCCESS) return 1;
  double p[4] = {0, 0, 0, 1}, p_u[4] = {}, p_v[4] = {};
  const auto output = [](double* values) {
    return glev_output{sizeof(glev_output), values, 4 * sizeof(double), 4 * sizeof(double), 4,
                       GLEV_DOUBLE,         0};
  };
  const glev_output vertex = output(p), tangent_u = output(p_u), tangent_v = output(p_v);
  const glev_outputs outputs = {&vertex, nullptr, nullptr, nullptr, &tangent_u, &tangent_v};
  glev_result result;
  if (batch != nullptr) {
    glev_batch request = *batch;
    request.outputs = outputs;
    result = glevEvaluate(plan, &request);
  } else {
    glev_mesh request = *mesh;
    request.outputs = outputs;
    request.scratch_size = glevGetMeshScratchSize(plan, &request);
    request.scratch = request.scratch_size > 0 ? std::malloc(request.scratch_size) : nullptr;
    result = glevEvaluateMesh(plan, &request);
    std::free(request.scratch);
  }
  glevReleasePlan(plan);
  if (result != GLEV_SUCCESS) return 1;
  // q = p / w. Without w it is 1 and its derivatives are 0.
  double a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = (p_u[k] * p[3] - p[k] * p_u[3]) / (p[3] * p[3]);
    b[k] = (p_v[k] * p[3] - p[k] * p_v[3]) / (p[3] * p[3]);
  }
  return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

// --- Evaluation

void Context::OnBegin(void* user, glev_enum mode) {
  if (static_cast<Context*>(user)->in_mesh) Gl().Begin(mode);
}
void Context::OnEnd(void* user) {
  if (static_cast<Context*>(user)->in_mesh) Gl().End();
}

void Context::OnVertex(void* user, const glev_vertex* vertex) {
  auto& context = *static_cast<Context*>(user);
  const Given given = GivenBy(context.enabled, context.emitting);
  if (given.color) Gl().Color4fv(vertex->color);
  if (given.normal && context.keeps_length && context.emitting == 2) {
    GLfloat normal[3];
    for (int k = 0; k < 3; ++k) normal[k] = static_cast<GLfloat>(vertex->normal[k] * context.normal_length_);
    Gl().Normal3fv(normal);
  } else if (given.normal) {
    Gl().Normal3fv(vertex->normal);
  }
  if (given.texture > 0) Gl().TexCoord4fv(vertex->texcoord[0]);
  if (given.vertex == 4)
    Gl().Vertex4fv(vertex->position);
  else
    Gl().Vertex3fv(vertex->position);
}

// Outside Begin and End evaluation of a point is undefined in the GL: nothing happens.
bool Context::PrepareEvaluation(int dimension) {
  if (!maybe_inside || GivenBy(enabled, dimension).vertex == 0) return false;
  emitting = dimension;
  glevBegin(evaluators, GLEV_POINTS);
  return true;
}

void Context::EvalCoord1(double u) {
  if (!PrepareEvaluation(1)) return;
  glevEvalCoord1d(evaluators, u);
  glevEnd(evaluators);
  Restore(1);
  Report();
}

void Context::EvalCoord2(double u, double v) {
  if (!PrepareEvaluation(2)) return;
  if (keeps_length) {
    const glev_batch batch = {sizeof batch,      1, GLEV_DOUBLE, GLEV_CORRECTLY_ROUNDED, {&u, sizeof u, 0},
                              {&v, sizeof v, 0}, {}};
    normal_length_ = LengthOfNormal(&batch, nullptr);
  }
  glevEvalCoord2d(evaluators, u, v);
  glevEnd(evaluators);
  Restore(2);
  Report();
}

void Context::EvalPoint1(GLint i) {
  if (!PrepareEvaluation(1)) return;
  glevEvalPoint1(evaluators, i);
  glevEnd(evaluators);
  Restore(1);
  Report();
}

void Context::EvaluatePoint2(GLint i, GLint j) {
  if (keeps_length) {
    const glev_mesh mesh = {sizeof mesh, i, i, j, j, GLEV_CORRECTLY_ROUNDED, {}, nullptr, 0};
    normal_length_ = LengthOfNormal(nullptr, &mesh);
  }
  glevEvalPoint2(evaluators, i, j);
}

void Context::EvalPoint2(GLint i, GLint j) {
  if (!PrepareEvaluation(2)) return;
  EvaluatePoint2(i, j);
  glevEnd(evaluators);
  Restore(2);
  Report();
}

void Context::EvalMesh1(GLenum mode, GLint i1, GLint i2) {
  if (!IsOutside()) return;
  const bool draws = GivenBy(enabled, 1).vertex != 0;
  if (draws) Snapshot();
  emitting = 1;
  in_mesh = true;
  glevEvalMesh1(evaluators, mode, i1, i2);
  in_mesh = false;
  if (draws) Restore(1);
  Report();
}

void Context::EvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  if (!IsOutside()) return;
  const bool draws = GivenBy(enabled, 2).vertex != 0;
  if (draws) Snapshot();
  emitting = 2;
  if (draws && keeps_length && (mode == GL_POINT || mode == GL_LINE || mode == GL_FILL)) {
    MeshByPoints(mode, i1, i2, j1, j2);
  } else {
    in_mesh = true;
    glevEvalMesh2(evaluators, mode, i1, i2, j1, j2);
    in_mesh = false;
  }
  if (draws) Restore(2);
  Report();
}

// The loops of GL 2.1 5.1. 64 bits, so that they come to an end.
void Context::MeshByPoints(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  const std::int64_t i_last = i2, j_last = j2;
  const auto point = [this](std::int64_t i, std::int64_t j) {
    EvaluatePoint2(static_cast<GLint>(i), static_cast<GLint>(j));
  };
  const auto primitive = [this](GLenum strip, const auto& body) {
    Gl().Begin(strip);
    glevBegin(evaluators, GLEV_POINTS);
    body();
    glevEnd(evaluators);
    Gl().End();
  };
  if (mode == GL_POINT) {
    primitive(GL_POINTS, [&] {
      for (std::int64_t j = j1; j <= j_last; ++j)
        for (std::int64_t i = i1; i <= i_last; ++i) point(i, j);
    });
  } else if (mode == GL_LINE) {
    for (std::int64_t j = j1; j <= j_last; ++j)
      primitive(GL_LINE_STRIP, [&] {
        for (std::int64_t i = i1; i <= i_last; ++i) point(i, j);
      });
    for (std::int64_t i = i1; i <= i_last; ++i)
      primitive(GL_LINE_STRIP, [&] {
        for (std::int64_t j = j1; j <= j_last; ++j) point(i, j);
      });
  } else {
    for (std::int64_t j = j1; j < j_last; ++j)
      primitive(GL_QUAD_STRIP, [&] {
        for (std::int64_t i = i1; i <= i_last; ++i) {
          point(i, j);
          point(i, j + 1);
        }
      });
  }
}

}  // namespace glev::dropin
