// Evaluation: vertices are sent to the GL below as Color4, Normal3, TexCoord4 and Vertex commands, after
// which the current values are restored.
#include "context.h"
#include "enables.h"

namespace glev::dropin {
namespace {

template <auto kCommand>
Setter keep(const GLfloat (&values)[4]) {
  Setter setter;
  setter.send = [](const void* kept) { (gl_below().*kCommand)(static_cast<const GLfloat*>(kept)); };
  std::memcpy(setter.values, values, sizeof values);
  return setter;
}

}  // namespace

// --- Current values

// Saves the current values that maps replace. They cannot be queried between Begin and End.
void Context::take_snapshot() {
  GLfloat values[4] = {};
  for (Setter& setter : current) setter.send = nullptr;
  if ((enabled & both_enable_bits(kColorMap)) != 0) {
    gl_below().GetFloatv(GL_CURRENT_COLOR, values);
    current[kColor] = keep<&GlBelow::Color4fv>(values);
  }
  if ((enabled & (both_enable_bits(kNormalMap) | kAutoNormal)) != 0) {
    gl_below().GetFloatv(GL_CURRENT_NORMAL, values);
    current[kNormal] = keep<&GlBelow::Normal3fv>(values);
  }
  std::uint32_t textures = 0;
  for (int map = kFirstTextureMap; map <= kLastTextureMap; ++map) textures |= both_enable_bits(map);
  if ((enabled & textures) != 0) {
    const GLint active = multitexture ? get_integer(GL_ACTIVE_TEXTURE, GL_TEXTURE0) : GL_TEXTURE0;
    if (active != GL_TEXTURE0) gl_below().ActiveTexture(GL_TEXTURE0);
    gl_below().GetFloatv(GL_CURRENT_TEXTURE_COORDS, values);
    if (active != GL_TEXTURE0) gl_below().ActiveTexture(static_cast<GLenum>(active));
    current[kTexCoord] = keep<&GlBelow::TexCoord4fv>(values);
  }
  keeps_length = (enabled & kAutoNormal) != 0 && is_vertex_shader_active();
}

void Context::before_primitive() {
  if (maybe_inside) return;
  if (!list_base_known && list_base_used) list_base = static_cast<GLuint>(get_integer(GL_LIST_BASE, 0));
  list_base_known = true;
  if (has_vertex_map()) take_snapshot();
}

void Context::restore(int dimension) {
  const GeneratedAttributes generated = generated_by(enabled, dimension);
  if (generated.color) current[kColor].apply();
  if (generated.normal) current[kNormal].apply();
  if (generated.texture > 0) current[kTexCoord].apply();
}

// --- Evaluation

void Context::on_begin(void* user, glev_enum mode) {
  if (static_cast<Context*>(user)->in_mesh) gl_below().Begin(mode);
}
void Context::on_end(void* user) {
  if (static_cast<Context*>(user)->in_mesh) gl_below().End();
}

void Context::on_vertex(void* user, const glev_vertex* vertex) {
  auto& context = *static_cast<Context*>(user);
  const GeneratedAttributes generated = generated_by(context.enabled, context.emitting);
  if (generated.color) gl_below().Color4fv(vertex->color);
  if (generated.normal && context.keeps_length && context.emitting == 2) {
    GLfloat normal[3];
    for (int k = 0; k < 3; ++k) normal[k] = static_cast<GLfloat>(vertex->normal[k] * context.normal_length_);
    gl_below().Normal3fv(normal);
  } else if (generated.normal) {
    gl_below().Normal3fv(vertex->normal);
  }
  if (generated.texture > 0) gl_below().TexCoord4fv(vertex->texcoord[0]);
  if (generated.vertex == 4)
    gl_below().Vertex4fv(vertex->position);
  else
    gl_below().Vertex3fv(vertex->position);
}

// Returns false if nothing must be evaluated: without a vertex map, and outside Begin/End, where the GL
// leaves evaluation of a point undefined.
bool Context::prepare_evaluation(int dimension) {
  if (!maybe_inside || generated_by(enabled, dimension).vertex == 0) return false;
  emitting = dimension;
  glevBegin(evaluators, GLEV_POINTS);
  return true;
}

void Context::finish_evaluation(int dimension) {
  glevEnd(evaluators);
  restore(dimension);
  report();
}

void Context::eval_coord(int dimension, double u, double v) {
  if (!prepare_evaluation(dimension)) return;
  if (dimension == 2 && keeps_length) {
    const glev_batch batch = {
        sizeof batch, 1, GLEV_DOUBLE, GLEV_CORRECTLY_ROUNDED, {&u, sizeof u, 0}, {&v, sizeof v, 0},
        nullptr,      0};
    normal_length_ = length_of_normal(&batch, nullptr);
  }
  if (dimension == 1)
    glevEvalCoord1d(evaluators, u);
  else
    glevEvalCoord2d(evaluators, u, v);
  finish_evaluation(dimension);
}

void Context::evaluate_point2(GLint i, GLint j) {
  if (keeps_length) {
    const glev_mesh mesh = {sizeof mesh, i, i, j, j, GLEV_CORRECTLY_ROUNDED, nullptr, 0, nullptr, 0};
    normal_length_ = length_of_normal(nullptr, &mesh);
  }
  glevEvalPoint2(evaluators, i, j);
}

void Context::eval_point(int dimension, GLint i, GLint j) {
  if (!prepare_evaluation(dimension)) return;
  if (dimension == 1)
    glevEvalPoint1(evaluators, i);
  else
    evaluate_point2(i, j);
  finish_evaluation(dimension);
}

// `draw` draws in primitives of its own, or the evaluators draw a mesh; see in_mesh.
template <class Draw>
void Context::draw_mesh(int dimension, const Draw& draw) {
  if (!is_outside()) return;
  const bool draws = generated_by(enabled, dimension).vertex != 0;
  if (draws) take_snapshot();
  emitting = dimension;
  draw(draws);
  in_mesh = false;
  if (draws) restore(dimension);
  report();
}

void Context::eval_mesh1(GLenum mode, GLint i1, GLint i2) {
  draw_mesh(1, [&](bool) {
    in_mesh = true;
    glevEvalMesh1(evaluators, mode, i1, i2);
  });
}

void Context::eval_mesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  draw_mesh(2, [&](bool draws) {
    if (draws && keeps_length && (mode == GL_POINT || mode == GL_LINE || mode == GL_FILL))
      return mesh_by_points(mode, i1, i2, j1, j2);
    in_mesh = true;
    glevEvalMesh2(evaluators, mode, i1, i2, j1, j2);
  });
}

// The loops of GL 2.1 section 5.1. Indices have 64 bits, so that the loops end for i2 = INT_MAX.
void Context::mesh_by_points(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  const std::int64_t i_last = i2, j_last = j2;
  const auto point = [this](std::int64_t i, std::int64_t j) {
    evaluate_point2(static_cast<GLint>(i), static_cast<GLint>(j));
  };
  const auto primitive = [this](GLenum strip, const auto& body) {
    gl_below().Begin(strip);
    glevBegin(evaluators, GLEV_POINTS);
    body();
    glevEnd(evaluators);
    gl_below().End();
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
