// What is evaluated goes to the GL below as Color4, Normal3, TexCoord4 and Vertex commands, with the current
// values brought back behind them.
#include "context.h"
#include "enables.h"

namespace glev::dropin {
namespace {

template <auto kCommand>
Setter Keep(const GLfloat (&values)[4]) {
  Setter setter;
  setter.send = [](const void* kept) { (Gl().*kCommand)(static_cast<const GLfloat*>(kept)); };
  std::memcpy(setter.values, values, sizeof values);
  return setter;
}

}  // namespace

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
