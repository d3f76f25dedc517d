/* A client of evaluators: the NURBS of GLU in render mode. It writes the texture coordinates of the vertices
 * of a curve and of a surface, which are their positions, to standard output, and a picture of both to a PPM
 * file.
 *
 * nurbs PICTURE */
#include <GL/gl.h>
#include <GL/glu.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "feedback.h"

void* OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accumulation, void* shared);
GLboolean OSMesaMakeCurrent(void* context, void* buffer, GLenum type, GLsizei width, GLsizei height);
void OSMesaDestroyContext(void* context);

enum { kSide = 256, kControl = 6, kRoom = 1 << 20 };

static unsigned char pixels[kSide * kSide * 4];
static GLfloat knots[kControl + 4] = {0, 0, 0, 0, 0.4f, 0.7f, 1, 1, 1, 1};

static void curve(GLUnurbs* nurbs) {
  GLfloat points[kControl][3];
  int i;
  for (i = 0; i < kControl; ++i) {
    points[i][0] = -0.9f + 1.8f * (float)i / (kControl - 1);
    points[i][1] = 0.7f + (i % 2 ? 0.25f : -0.15f);
    points[i][2] = 0.125f;
  }
  gluBeginCurve(nurbs);
  gluNurbsCurve(nurbs, kControl + 4, knots, 3, &points[0][0], 4, GL_MAP1_VERTEX_3);
  gluNurbsCurve(nurbs, kControl + 4, knots, 3, &points[0][0], 4, GL_MAP1_TEXTURE_COORD_3);
  gluEndCurve(nurbs);
}

static void surface(GLUnurbs* nurbs) {
  GLfloat points[kControl][kControl][3];
  int i, j;
  for (i = 0; i < kControl; ++i)
    for (j = 0; j < kControl; ++j) {
      points[i][j][0] = -0.8f + 1.6f * (float)i / (kControl - 1);
      points[i][j][1] = -0.9f + 1.2f * (float)j / (kControl - 1);
      points[i][j][2] = (float)sin(1.7 * i) * (float)cos(1.1 * j) / 2;
    }
  gluBeginSurface(nurbs);
  gluNurbsSurface(nurbs, kControl + 4, knots, kControl + 4, knots, 3 * kControl, 3, &points[0][0][0], 4, 4,
                  GL_MAP2_VERTEX_3);
  gluNurbsSurface(nurbs, kControl + 4, knots, kControl + 4, knots, 3 * kControl, 3, &points[0][0][0], 4, 4,
                  GL_MAP2_TEXTURE_COORD_3);
  gluEndSurface(nurbs);
}

static void draw_to_feedback(const char* title, GLUnurbs* nurbs, void (*drawing)(GLUnurbs*)) {
  GLfloat* const buffer = malloc(kRoom * sizeof *buffer);
  GLint count;
  glFeedbackBuffer(kRoom, GL_4D_COLOR_TEXTURE, buffer);
  glRenderMode(GL_FEEDBACK);
  drawing(nurbs);
  count = glRenderMode(GL_RENDER);
  print_feedback(title, buffer, count);
  free(buffer);
}

static int write_picture(const char* path) {
  int i;
  FILE* const file = fopen(path, "wb");
  if (!file) return 2;
  fprintf(file, "P6\n%d %d\n255\n", kSide, kSide);
  for (i = 0; i < kSide * kSide; ++i) fwrite(&pixels[4 * i], 1, 3, file);
  return fclose(file) == 0 ? 0 : 2;
}

int main(int argc, char** argv) {
  static const GLfloat kMaterial[4] = {0.2f, 0.6f, 0.9f, 1};
  static const unsigned char kWhite[4] = {255, 255, 255, 255};
  GLUnurbs* nurbs;
  void* const context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
  if (argc != 2 || !context || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, kSide, kSide)) return 2;
  nurbs = gluNewNurbsRenderer();
  gluNurbsProperty(nurbs, GLU_SAMPLING_METHOD, GLU_DOMAIN_DISTANCE);
  gluNurbsProperty(nurbs, GLU_U_STEP, 40);
  gluNurbsProperty(nurbs, GLU_V_STEP, 30);

  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kWhite);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glEnable(GL_TEXTURE_2D);
  draw_to_feedback("curve", nurbs, curve);
  draw_to_feedback("surface", nurbs, surface);
  glDisable(GL_TEXTURE_2D);

  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glColor3f(1, 1, 0);
  curve(nurbs);
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glEnable(GL_AUTO_NORMAL);
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
  glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, kMaterial);
  surface(nurbs);
  glFinish();
  printf("error\n%d\n", glGetError());
  gluDeleteNurbsRenderer(nurbs);
  OSMesaDestroyContext(context);
  return write_picture(argv[1]);
}
