/* A program as of 1997, which uses GL 1.1 evaluators and nothing of this project. It prints the texture
 * coordinates of feedback mode, one vertex per line, and the current values afterwards.
 *
 * client [lookup]    lookup: gets the commands from OSMesaGetProcAddress */
#include <GL/gl.h>
#include <stdio.h>
#include <string.h>

#include "client.h"
#include "feedback.h"

/* GL/osmesa.h is not always installed. */
void* OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accumulation, void* shared);
GLboolean OSMesaMakeCurrent(void* context, void* buffer, GLenum type, GLsizei width, GLsizei height);
void OSMesaDestroyContext(void* context);
void (*OSMesaGetProcAddress(const char* name))(void);

static unsigned char pixels[64 * 64 * 4];

static void (*map1f)(GLenum, GLfloat, GLfloat, GLint, GLint, const GLfloat*) = glMap1f;
static void (*map2f)(GLenum, GLfloat, GLfloat, GLint, GLint, GLfloat, GLfloat, GLint, GLint,
                     const GLfloat*) = glMap2f;
static void (*eval_coord1f)(GLfloat) = glEvalCoord1f;
static void (*eval_mesh2)(GLenum, GLint, GLint, GLint, GLint) = glEvalMesh2;
static void (*enable)(GLenum) = glEnable;

static void look_up(void* command, const char* name) {
  void (*const address)(void) = OSMesaGetProcAddress(name);
  memcpy(command, &address, sizeof address);
}

static void state(void) {
  static const unsigned char kWhite[4] = {255, 255, 255, 255};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kWhite);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  enable(GL_TEXTURE_2D);
  glTexCoord2f(0.25f, 0.5f);
  glColor3f(0.5f, 0.75f, 1.0f);
}

static void maps(void) {
  float points[4 * kUOrder * kVOrder];
  int i;
  for (i = 0; i < 4 * kOrder; ++i) points[i] = client_point(i);
  map1f(GL_MAP1_TEXTURE_COORD_4, kDomain[0], kDomain[1], 4, kOrder, points);
  for (i = 0; i < 3 * kOrder; ++i) points[i] = client_position(i);
  map1f(GL_MAP1_VERTEX_3, kDomain[0], kDomain[1], 3, kOrder, points);
  for (i = 0; i < 4 * kUOrder * kVOrder; ++i) points[i] = client_point(i);
  map2f(GL_MAP2_TEXTURE_COORD_4, kDomain[0], kDomain[1], 4 * kVOrder, kUOrder, kDomain[2], kDomain[3], 4,
        kVOrder, points);
  for (i = 0; i < 3 * kUOrder * kVOrder; ++i) points[i] = client_position(i);
  map2f(GL_MAP2_VERTEX_3, kDomain[0], kDomain[1], 3 * kVOrder, kUOrder, kDomain[2], kDomain[3], 3, kVOrder,
        points);
  enable(GL_MAP1_TEXTURE_COORD_4);
  enable(GL_MAP1_VERTEX_3);
  enable(GL_MAP2_TEXTURE_COORD_4);
  enable(GL_MAP2_VERTEX_3);
  glMapGrid2f(kSegments, kDomain[0], kDomain[1], 2, kDomain[2], kDomain[3]);
}

static void curve(void) {
  int i;
  glBegin(GL_POINTS);
  for (i = 0; i < kArguments; ++i) eval_coord1f(client_argument(i));
  glEnd();
}

static void surface(void) { eval_mesh2(GL_POINT, 0, kSegments, 0, 2); }

static void listed_curve(void) {
  glNewList(5, GL_COMPILE);
  curve();
  glEndList();
  glCallList(5);
}

static void draw(const char* title, void (*drawing)(void)) {
  static GLfloat buffer[4096];
  glFeedbackBuffer(4096, GL_4D_COLOR_TEXTURE, buffer);
  glRenderMode(GL_FEEDBACK);
  drawing();
  print_feedback(title, buffer, glRenderMode(GL_RENDER));
}

int main(int argc, char** argv) {
  GLfloat v[4] = {0, 0, 0, 0};
  void* const other = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
  void* const context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 0, NULL);
  if (!context || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, 64, 64)) return 2;
  if (argc > 1 && strcmp(argv[1], "lookup") == 0) {
    look_up(&map1f, "glMap1f");
    look_up(&map2f, "glMap2f");
    look_up(&eval_coord1f, "glEvalCoord1f");
    look_up(&eval_mesh2, "glEvalMesh2");
    look_up(&enable, "glEnable");
  }
  state();
  maps();
  draw("curve", curve);
  /* Each context has its own evaluators. */
  OSMesaMakeCurrent(other, pixels, GL_UNSIGNED_BYTE, 64, 64);
  map1f(GL_MAP1_TEXTURE_COORD_4, 0, 1, 4, 1, v);
  OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, 64, 64);
  draw("surface", surface);
  draw("listed curve", listed_curve);
  glGetFloatv(GL_CURRENT_TEXTURE_COORDS, v);
  printf("current\n%g %g %g %g\n", v[0], v[1], v[2], v[3]);
  glGetFloatv(GL_CURRENT_COLOR, v);
  printf("%g %g %g %g\n", v[0], v[1], v[2], v[3]);
  printf("error\n%d\n", glGetError());
  OSMesaDestroyContext(other);
  OSMesaDestroyContext(context);
  return 0;
}
