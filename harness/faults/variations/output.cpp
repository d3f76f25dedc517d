// Variations of the output: captures are coarse or missing, and meshes are drawn in a different order.
#include <algorithm>
#include <cmath>

#include "variation.h"

namespace evalcts::variations {
namespace {

// --- Feedback and transform feedback

GLenum feedback_type = GL_2D;

int coordinates_of(GLenum type) { return type == GL_2D ? 2 : type == GL_4D_COLOR_TEXTURE ? 4 : 3; }
bool has_color(GLenum type) { return type != GL_2D && type != GL_3D; }
bool has_texture(GLenum type) { return type == GL_3D_COLOR_TEXTURE || type == GL_4D_COLOR_TEXTURE; }

// Calls `change` for each colour component in a feedback buffer of RGBA colours, and `change_token` for each
// token.
template <class Change, class ChangeToken>
void change_feedback(GLfloat* values, std::size_t count, Change change, ChangeToken change_token) {
  const auto before = static_cast<std::size_t>(coordinates_of(feedback_type));
  const std::size_t colors = has_color(feedback_type) ? 4 : 0;
  const std::size_t size = before + colors + (has_texture(feedback_type) ? 4 : 0);
  for (std::size_t i = 0; i < count;) {
    const auto token = static_cast<GLenum>(values[i]);
    values[i] = static_cast<GLfloat>(change_token(token));
    ++i;
    std::size_t vertices = 1;
    if (token == GL_PASS_THROUGH_TOKEN) {
      ++i;
      continue;
    }
    if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) vertices = 2;
    if (token == GL_POLYGON_TOKEN && i < count) vertices = static_cast<std::size_t>(values[i++]);
    for (; vertices > 0 && i + size <= count; --vertices, i += size)
      for (std::size_t k = before; k < before + colors; ++k) values[i + k] = change(values[i + k]);
    if (vertices > 0) return;
  }
}

float unchanged(float x) { return x; }
GLenum unchanged_token(GLenum token) { return token; }

template <float (*kChange)(float), GLenum (*kChangeToken)(GLenum) = unchanged_token>
void vary_feedback(Varied& v) {
  v.gl.FeedbackBuffer = [](GLsizei size, GLenum type, GLfloat* buffer) {
    unvaried.FeedbackBuffer(size, type, buffer);
    remembered.feedback = buffer;
    remembered.feedback_size = size;
    feedback_type = type;
  };
  v.gl.RenderMode = [](GLenum mode) {
    GLint before = GL_RENDER;
    if (!remembered.inside) unvaried.GetIntegerv(GL_RENDER_MODE, &before);
    const GLint count = unvaried.RenderMode(mode);
    if (before == GL_FEEDBACK && remembered.feedback)
      change_feedback(remembered.feedback,
                      static_cast<std::size_t>(count < 0 ? remembered.feedback_size : count), kChange,
                      kChangeToken);
    return count;
  };
}

float to_8_bits(float x) { return std::round(std::clamp(x, 0.0f, 1.0f) * 255.0f) / 255.0f; }
float cut_to_8_bits(float x) { return std::floor(std::clamp(x, 0.0f, 1.0f) * 255.0f) / 255.0f; }
float to_unit_interval(float x) { return std::clamp(x, 0.0f, 1.0f); }

void remove_transform_feedback(Varied& v) {
  v.gl.TransformFeedbackVaryings = nullptr;
  v.gl.BeginTransformFeedback = nullptr;
  v.gl.EndTransformFeedback = nullptr;
}

EVALCTS_VARIATION(FeedbackOf8Bits, "dropin", "feedback colours are rounded to 8 bits; no transform feedback",
                  "") {
  vary_feedback<to_8_bits>(v);
  remove_transform_feedback(v);
}
EVALCTS_VARIATION(FeedbackCutTo8Bits, "dropin", "feedback colours are cut to 8 bits; no transform feedback",
                  "") {
  vary_feedback<cut_to_8_bits>(v);
  remove_transform_feedback(v);
}
EVALCTS_VARIATION(FeedbackClamped, "dropin", "feedback colours are clamped; no transform feedback", "") {
  vary_feedback<to_unit_interval>(v);
  remove_transform_feedback(v);
}

// Resets the line stipple at each segment, not only at the first segment of a strip.
GLenum with_reset(GLenum token) { return token == GL_LINE_TOKEN ? GL_LINE_RESET_TOKEN : token; }
EVALCTS_VARIATION(FeedbackLineResets, "dropin",
                  "each line in the feedback buffer resets the stipple; no transform feedback", "") {
  vary_feedback<unchanged, with_reset>(v);
  remove_transform_feedback(v);
}

void remove_feedback(Varied& v) {
  v.gl.RenderMode = nullptr;
  v.gl.FeedbackBuffer = nullptr;
}
EVALCTS_VARIATION(NoTransformFeedback, "dropin", "there is no transform feedback", "") {
  remove_transform_feedback(v);
}
EVALCTS_VARIATION(NoFeedback, "dropin", "there is no feedback mode", "") { remove_feedback(v); }
EVALCTS_VARIATION(NothingToSee, "dropin", "there is neither feedback mode nor transform feedback", "") {
  remove_feedback(v);
  remove_transform_feedback(v);
}

// --- Values

template <class Change>
void change_values(std::vector<ObservedPrimitive>& primitives, Change change) {
  for (ObservedPrimitive& primitive : primitives)
    for (ObservedVertex& vertex : primitive.vertices) {
      std::ranges::for_each(vertex.position, change);
      std::ranges::for_each(vertex.color, change);
      std::ranges::for_each(vertex.normal, change);
      for (auto& coordinates : vertex.texture_coordinate) std::ranges::for_each(coordinates, change);
    }
}

EVALCTS_VARIATION(NoNegativeZero, "production", "results of -0 are returned as +0", "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    change_values(primitives, [](float& x) { x += 0.0f; });
  };
}
EVALCTS_VARIATION(NoSubnormals, "production", "subnormal results are returned as 0", "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    change_values(primitives, [](float& x) {
      if (std::fpclassify(x) == FP_SUBNORMAL) x = 0;
    });
  };
}
EVALCTS_VARIATION(ClampedColors, "production", "colours are clamped to [0,1]", "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    for (ObservedPrimitive& primitive : primitives)
      for (ObservedVertex& vertex : primitive.vertices)
        for (float& x : vertex.color) x = std::clamp(x, 0.0f, 1.0f);
  };
}
EVALCTS_VARIATION(WhiteOnly, "production", "every colour comes out white, explicit ones, too", "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    for (ObservedPrimitive& primitive : primitives)
      for (ObservedVertex& vertex : primitive.vertices) vertex.color = {1, 1, 1, 1};
  };
}
EVALCTS_VARIATION(PositionOnly, "production", "only positions are output", "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    for (ObservedPrimitive& primitive : primitives)
      for (ObservedVertex& vertex : primitive.vertices) {
        const auto position = vertex.position;
        vertex = {};
        vertex.position = position;
      }
  };
}

EVALCTS_VARIATION(LeastRange, "production",
                  "positions, normals and texture coordinates beyond 2^33 become infinite, colours beyond "
                  "2^11 saturated",
                  "") {
  v.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    const auto limit = [](float& x) {
      if (std::abs(x) > 0x1p33f) x = std::copysign(HUGE_VALF, x);
    };
    for (ObservedPrimitive& primitive : primitives)
      for (ObservedVertex& vertex : primitive.vertices) {
        std::ranges::for_each(vertex.position, limit);
        std::ranges::for_each(vertex.normal, limit);
        for (auto& coordinates : vertex.texture_coordinate) std::ranges::for_each(coordinates, limit);
        for (float& x : vertex.color) x = std::clamp(x, -0x1p11f, 0x1p11f);
      }
  };
}

// --- Meshes

// True if EvalMesh2 draws: the mode is legal, and the call is neither inside a primitive nor compiled
// into a list.
bool draws(GLenum mode) {
  return !remembered.inside && !remembered.compiling &&
         (mode == GL_POINT || mode == GL_LINE || mode == GL_FILL);
}

void point(GLint i, GLint j) { unvaried.EvalPoint2(i, j); }

// Draws the points, line strips and quads of a mesh in a different order. Each quad is a primitive of mode
// `kQuads`: QUADS, or QUAD_STRIP, which keeps the provoking vertex.
template <bool kBackwards, GLenum kQuads>
void draw_mesh(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  if (!draws(mode) || i2 < i1 || j2 < j1 || i2 - i1 > 1000 || j2 - j1 > 1000)
    return unvaried.EvalMesh2(mode, i1, i2, j1, j2);
  const GLint columns = i2 - i1 + 1, rows = j2 - j1 + 1;
  const auto i_at = [&](GLint k) { return kBackwards ? i2 - k : i1 + k; };
  const auto j_at = [&](GLint k) { return kBackwards ? j2 - k : j1 + k; };
  if (mode == GL_POINT) {
    unvaried.Begin(GL_POINTS);
    for (GLint b = 0; b < rows; ++b)
      for (GLint a = 0; a < columns; ++a) point(i_at(a), j_at(b));
    unvaried.End();
  } else if (mode == GL_LINE) {
    for (GLint a = 0; a < columns; ++a) {
      unvaried.Begin(GL_LINE_STRIP);
      for (GLint j = j1; j <= j2; ++j) point(i_at(a), j);
      unvaried.End();
    }
    for (GLint b = 0; b < rows; ++b) {
      unvaried.Begin(GL_LINE_STRIP);
      for (GLint i = i1; i <= i2; ++i) point(i, j_at(b));
      unvaried.End();
    }
  } else {
    for (GLint a = 0; a + 1 < columns; ++a)
      for (GLint b = 0; b + 1 < rows; ++b) {
        const GLint i = kBackwards ? i2 - 1 - a : i1 + a, j = kBackwards ? j2 - 1 - b : j1 + b;
        unvaried.Begin(kQuads);
        point(i, j);
        point(i, j + 1);
        point(i + 1, kQuads == GL_QUADS ? j + 1 : j);
        point(i + 1, kQuads == GL_QUADS ? j : j + 1);
        unvaried.End();
      }
  }
}

// The requirements on the order of the loops in the specification. Only their tests may
// depend on it.
#define MESH_ROWS "EV-MESH2-POINT EV-MESH2-LINE EV-MESH2-FILL"
EVALCTS_VARIATION(MeshesInColumns, "production", "EvalMesh2 draws in another order", MESH_ROWS) {
  v.gl.EvalMesh2 = draw_mesh<false, GL_QUADS>;
}
EVALCTS_VARIATION(MeshesBackwards, "production", "EvalMesh2 begins at the last point", MESH_ROWS) {
  v.gl.EvalMesh2 = draw_mesh<true, GL_QUADS>;
}
EVALCTS_VARIATION(PipelineMeshesInColumns, "dropin", "EvalMesh2 draws in another order", MESH_ROWS) {
  v.gl.EvalMesh2 = draw_mesh<false, GL_QUAD_STRIP>;
}
EVALCTS_VARIATION(PipelineMeshesBackwards, "dropin", "EvalMesh2 begins at the last point", MESH_ROWS) {
  v.gl.EvalMesh2 = draw_mesh<true, GL_QUAD_STRIP>;
}

// Meshes of one row are left as they are: in deliveries they take the place of other evaluations.
EVALCTS_VARIATION(PipelineMeshLinesBackwards, "dropin",
                  "the lines of EvalMesh2 run in the other direction if there are several in both ways",
                  "EV-MESH2-LINE EV-MESH2-STIPPLE") {
  v.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (!draws(mode) || mode != GL_LINE || i2 <= i1 || j2 <= j1 || i2 - i1 > 1000 || j2 - j1 > 1000)
      return unvaried.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j <= j2; ++j) {
      unvaried.Begin(GL_LINE_STRIP);
      for (GLint i = i2; i >= i1; --i) point(i, j);
      unvaried.End();
    }
    for (GLint i = i1; i <= i2; ++i) {
      unvaried.Begin(GL_LINE_STRIP);
      for (GLint j = j2; j >= j1; --j) point(i, j);
      unvaried.End();
    }
  };
}

// --- Single precision

EVALCTS_VARIATION(FloatArguments, "production", "arguments of EvalCoord in double are rounded to float", "") {
  v.gl.EvalCoord1d = [](GLdouble u) { unvaried.EvalCoord1f(static_cast<GLfloat>(u)); };
  v.gl.EvalCoord2d = [](GLdouble u, GLdouble w) {
    unvaried.EvalCoord2f(static_cast<GLfloat>(u), static_cast<GLfloat>(w));
  };
  v.gl.EvalCoord1dv = [](const GLdouble* u) { unvaried.EvalCoord1f(static_cast<GLfloat>(u[0])); };
  v.gl.EvalCoord2dv = [](const GLdouble* u) {
    unvaried.EvalCoord2f(static_cast<GLfloat>(u[0]), static_cast<GLfloat>(u[1]));
  };
}

}  // namespace
}  // namespace evalcts::variations
