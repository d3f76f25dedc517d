/* Records the evaluator commands that GLU's NURBS renderer issues for a curve and for a trimmed surface, as
 * cases in JSON for the tests RealPrograms.*. The GL functions below take precedence over those of the
 * library that GLU is linked with, because this program exports them.
 *
 * record_glu curve|surface > FILE */
#include <GL/glu.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kControl = 6, kSide = 64 };

static GLfloat knots[kControl + 4] = {0, 0, 0, 0, 0.4f, 0.7f, 1, 1, 1, 1};

/* --- The GL functions that GLU calls ---------------------------------------------------------------------
 */

static const char* separator = "";

static void begin_command(const char* name) {
  printf("%s\n  [\"%s\"", separator, name);
  separator = ",";
}
static void put_number(double value) { printf(", %.9g", value); }
static void put_name(const char* name) { printf(", \"%s\"", name); }
static void end_command(void) { printf("]"); }

static void unknown(const char* what, unsigned value) {
  fprintf(stderr, "record_glu: GLU uses %s 0x%04X, which is not recorded\n", what, value);
  exit(1);
}

struct Token {
  GLenum value;
  const char* name;
};
#define TOKEN(name) \
  { name, #name }

/* Returns the name of a token in the table, whose last name is null. */
static const char* name_of(const struct Token* tokens, GLenum value) {
  for (; tokens->name; ++tokens)
    if (tokens->value == value) return tokens->name;
  unknown("token", value);
  return NULL;
}

static const struct Token kCapabilities[] = {TOKEN(GL_MAP1_VERTEX_3), TOKEN(GL_MAP1_VERTEX_4),
                                             TOKEN(GL_MAP2_VERTEX_3), TOKEN(GL_MAP2_VERTEX_4),
                                             TOKEN(GL_AUTO_NORMAL),   {0, NULL}};
static const struct Token kPrimitives[] = {
    TOKEN(GL_LINES),      TOKEN(GL_LINE_STRIP),     TOKEN(GL_LINE_LOOP),
    TOKEN(GL_TRIANGLES),  TOKEN(GL_TRIANGLE_STRIP), TOKEN(GL_TRIANGLE_FAN),
    TOKEN(GL_QUAD_STRIP), TOKEN(GL_POINTS),         {~0u, NULL}};
static const struct Token kMeshModes[] = {TOKEN(GL_POINT), TOKEN(GL_LINE), TOKEN(GL_FILL), {0, NULL}};

static int components_of(GLenum target) {
  return target == GL_MAP1_VERTEX_4 || target == GL_MAP2_VERTEX_4 ? 4 : 3;
}

static void put_points(const GLfloat* points, int count) {
  int i;
  printf(", {\"f32\": [");
  for (i = 0; i < count; ++i) printf("%s%.9g", i ? ", " : "", points[i]);
  printf("]}");
}

void glBegin(GLenum mode) {
  begin_command("Begin");
  put_name(name_of(kPrimitives, mode));
  end_command();
}

void glEnd(void) {
  begin_command("End");
  end_command();
}

void glEnable(GLenum capability) {
  begin_command("Enable");
  put_name(name_of(kCapabilities, capability));
  end_command();
}

void glDisable(GLenum capability) {
  begin_command("Disable");
  put_name(name_of(kCapabilities, capability));
  end_command();
}

void glPushAttrib(GLbitfield mask) {
  if (mask != GL_EVAL_BIT) unknown("PushAttrib", mask);
  begin_command("PushAttrib");
  put_number(mask);
  end_command();
}

void glPopAttrib(void) {
  begin_command("PopAttrib");
  end_command();
}

void glMap1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  begin_command("Map1f");
  put_name(name_of(kCapabilities, target));
  put_number(u1);
  put_number(u2);
  put_number(stride);
  put_number(order);
  put_points(points, (order - 1) * stride + components_of(target));
  end_command();
}

void glMap2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
             GLint vstride, GLint vorder, const GLfloat* points) {
  begin_command("Map2f");
  put_name(name_of(kCapabilities, target));
  put_number(u1);
  put_number(u2);
  put_number(ustride);
  put_number(uorder);
  put_number(v1);
  put_number(v2);
  put_number(vstride);
  put_number(vorder);
  put_points(points, (uorder - 1) * ustride + (vorder - 1) * vstride + components_of(target));
  end_command();
}

void glMapGrid1f(GLint un, GLfloat u1, GLfloat u2) {
  begin_command("MapGrid1f");
  put_number(un);
  put_number(u1);
  put_number(u2);
  end_command();
}

static void put_grid(GLint un, double u1, double u2, GLint vn, double v1, double v2) {
  put_number(un);
  put_number(u1);
  put_number(u2);
  put_number(vn);
  put_number(v1);
  put_number(v2);
  end_command();
}

void glMapGrid2f(GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
  begin_command("MapGrid2f");
  put_grid(un, u1, u2, vn, v1, v2);
}

void glMapGrid2d(GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
  begin_command("MapGrid2d");
  put_grid(un, u1, u2, vn, v1, v2);
}

void glEvalCoord1f(GLfloat u) {
  begin_command("EvalCoord1f");
  put_number(u);
  end_command();
}

void glEvalCoord2f(GLfloat u, GLfloat v) {
  begin_command("EvalCoord2f");
  put_number(u);
  put_number(v);
  end_command();
}

void glEvalPoint1(GLint i) {
  begin_command("EvalPoint1");
  put_number(i);
  end_command();
}

void glEvalPoint2(GLint i, GLint j) {
  begin_command("EvalPoint2");
  put_number(i);
  put_number(j);
  end_command();
}

void glEvalMesh1(GLenum mode, GLint i1, GLint i2) {
  begin_command("EvalMesh1");
  put_name(name_of(kMeshModes, mode));
  put_number(i1);
  put_number(i2);
  end_command();
}

void glEvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  begin_command("EvalMesh2");
  put_name(name_of(kMeshModes, mode));
  put_number(i1);
  put_number(i2);
  put_number(j1);
  put_number(j2);
  end_command();
}

void glGetFloatv(GLenum name, GLfloat* values) {
  int i;
  if (name != GL_MODELVIEW_MATRIX && name != GL_PROJECTION_MATRIX) unknown("GetFloatv", name);
  for (i = 0; i < 16; ++i) values[i] = i % 5 == 0;
}

void glGetIntegerv(GLenum name, GLint* values) {
  static const GLint kViewport[] = {0, 0, kSide, kSide};
  if (name == GL_POLYGON_MODE) {
    values[0] = values[1] = GL_FILL;
  } else if (name == GL_VIEWPORT) {
    memcpy(values, kViewport, sizeof kViewport);
  } else {
    unknown("GetIntegerv", name);
  }
}

/* --- The drawings ----------------------------------------------------------------------------------------
 */

static void draw_curve(GLUnurbs* nurbs) {
  GLfloat points[kControl][3];
  int i;
  for (i = 0; i < kControl; ++i) {
    points[i][0] = -0.9f + 1.8f * (float)i / (kControl - 1);
    points[i][1] = i % 2 ? 0.75f : -0.65f;
    points[i][2] = 0.125f * (float)i - 0.25f;
  }
  gluBeginCurve(nurbs);
  gluNurbsCurve(nurbs, kControl + 4, knots, 3, &points[0][0], 4, GL_MAP1_VERTEX_3);
  gluEndCurve(nurbs);
}

/* Draws a hill with a hole that is bounded by a curve and by a polygon. */
static void draw_surface(GLUnurbs* nurbs) {
  static GLfloat border[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  static GLfloat curve[4][2] = {{0.25f, 0.5f}, {0.25f, 0.8f}, {0.75f, 0.8f}, {0.75f, 0.5f}};
  static GLfloat curve_knots[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  static GLfloat polygon[4][2] = {{0.75f, 0.5f}, {0.6f, 0.3f}, {0.4f, 0.3f}, {0.25f, 0.5f}};
  GLfloat points[kControl][kControl][3];
  int i, j;
  for (i = 0; i < kControl; ++i)
    for (j = 0; j < kControl; ++j) {
      const float u = (float)i / (kControl - 1), v = (float)j / (kControl - 1);
      points[i][j][0] = -0.8f + 1.6f * u;
      points[i][j][1] = -0.8f + 1.6f * v;
      points[i][j][2] = 4 * u * (1 - u) * v * (1 - v) * 2 - 0.25f;
    }
  gluBeginSurface(nurbs);
  gluNurbsSurface(nurbs, kControl + 4, knots, kControl + 4, knots, 3 * kControl, 3, &points[0][0][0], 4, 4,
                  GL_MAP2_VERTEX_3);
  gluBeginTrim(nurbs);
  gluPwlCurve(nurbs, 5, &border[0][0], 2, GLU_MAP1_TRIM_2);
  gluEndTrim(nurbs);
  gluBeginTrim(nurbs);
  gluNurbsCurve(nurbs, 8, curve_knots, 2, &curve[0][0], 4, GLU_MAP1_TRIM_2);
  gluPwlCurve(nurbs, 4, &polygon[0][0], 2, GLU_MAP1_TRIM_2);
  gluEndTrim(nurbs);
  gluEndSurface(nurbs);
}

int main(int argc, char** argv) {
  GLUnurbs* const nurbs = gluNewNurbsRenderer();
  if (argc != 2 || !nurbs) return 2;
  gluNurbsProperty(nurbs, GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE);
  gluNurbsProperty(nurbs, GLU_U_STEP, 8);
  gluNurbsProperty(nurbs, GLU_V_STEP, 6);
  printf("[");
  strcmp(argv[1], "curve") == 0 ? draw_curve(nurbs) : draw_surface(nurbs);
  printf("\n]\n");
  gluDeleteNurbsRenderer(nurbs);
  return 0;
}
