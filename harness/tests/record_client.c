/* Programs with evaluators on OSMesa, for the tests of `evalcts record`: record_client NAME [NUMBER] */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* GL/osmesa.h is not always installed. */
void* OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accumulation, void* shared);
GLboolean OSMesaMakeCurrent(void* context, void* buffer, GLenum type, GLsizei width, GLsizei height);
void OSMesaDestroyContext(void* context);

/* Defined in record_next.c. */
int finds_the_next(void);

static const GLfloat kCurve[3][3] = {{0, 0, 0}, {0.5f, 1, 0.1f}, {1, 0, -0.0f}};

static void* new_context(unsigned char* pixels) {
  void* const context = OSMesaCreateContextExt(GL_RGBA, 16, 0, 0, NULL);
  if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, 16, 16)) exit(3);
  return context;
}

static void define_curve(void) {
  glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 3, kCurve[0]);
  glEnable(GL_MAP1_VERTEX_3);
}

static void draw_curve(int points) {
  glBegin(GL_LINE_STRIP);
  for (int i = 0; i < points; ++i) glEvalCoord1f((GLfloat)i / (GLfloat)points);
  glEnd();
}

/* Curves, lists, queries, and all kinds of arguments. */
static void draw(void) {
  define_curve();
  draw_curve(2);
  /* Points with gaps, and with a NaN that has a payload. */
  double net[24];
  memset(net, 0x55, sizeof net);
  for (int i = 0; i < 4; ++i) net[5 * i] = i;
  const unsigned long long payload = 0x7FF8000000001234;
  memcpy(&net[10], &payload, sizeof payload);
  glMap2d(GL_MAP2_INDEX, 0, 1, 10, 2, -1, 1, 5, 2, net);
  glMapGrid2f(2, 0, 1, 3, 0, 1);
  glEvalMesh2(GL_FILL, 0, 2, 0, 3);
  /* Rejected: nothing is read. */
  glMap1f(GL_MAP1_VERTEX_3, 0, 0, 3, 3, kCurve[0]);
  glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 31, (const GLfloat*)16);
  glMap1f(GL_MAP1_VERTEX_3, 0, 1, 2, 3, (const GLfloat*)16);
  glMap1d(GL_MAP2_VERTEX_3, 0, 1, 3, 3, (const GLdouble*)16);
  glCallLists(-1, GL_UNSIGNED_SHORT, (const void*)16);
  glCallLists(1, GL_DOUBLE, (const void*)16);
  while (glGetError() != GL_NO_ERROR) {
  }
  /* Integers. */
  const GLbyte colour[4] = {-128, 127, 0, 1};
  glColor4bv(colour);
  glColor3ub(255, 0, 51);
  glNormal3i(2147483647, -2147483647 - 1, 0);
  glTexCoord2s(-3, 4);
  glMultiTexCoord2iARB(GL_TEXTURE1, 5, 6);
  glMultiTexCoord1fARB(GL_TEXTURE1, 0.25f);
  glActiveTextureARB(GL_TEXTURE0);
  glIndexub(7);
  glEdgeFlag(GL_FALSE);
  const GLuint list = glGenLists(2);
  glNewList(list, GL_COMPILE);
  glBegin(GL_POINTS);
  glEvalCoord1d(0.75);
  glVertex2i(1, -1);
  glEnd();
  glEndList();
  const GLushort names[2] = {(GLushort)list, 0};
  glCallLists(2, GL_UNSIGNED_SHORT, names);
  GLfloat points[9];
  GLint orders[2];
  glGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, points);
  glGetMapiv(GL_MAP2_INDEX, GL_ORDER, orders);
  if (memcmp(points, kCurve, sizeof points) != 0 || orders[0] != 2 || glGetError() != GL_NO_ERROR) exit(4);
  glLoadIdentity();
  glLoadIdentity();
}

static pthread_barrier_t both_have_begun;

static void* draw_in_thread(void* number) {
  static unsigned char pixels[2][16 * 16 * 4];
  const long i = (long)number;
  void* const context = new_context(pixels[i]);
  define_curve();
  pthread_barrier_wait(&both_have_begun);
  /* more than fits into one part of the file */
  for (int k = 0; k < 100000; ++k) glMapGrid1f((GLint)(1 + i), 0, (GLfloat)(k % 1000));
  OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
  OSMesaDestroyContext(context);
  return NULL;
}

int main(int count, char** arguments) {
  static unsigned char pixels[16 * 16 * 4];
  const char* const name = count > 1 ? arguments[1] : "";
  const int number = count > 2 ? atoi(arguments[2]) : 0;
  if (strcmp(name, "nothing") == 0) return finds_the_next() ? 0 : 5;
  if (strcmp(name, "threads") == 0) {
    pthread_t threads[2];
    pthread_barrier_init(&both_have_begun, NULL, 2);
    for (long i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, draw_in_thread, (void*)i);
    for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
    return 0;
  }
  void* const context = new_context(pixels);
  if (strcmp(name, "other") == 0) {
    glBegin(GL_POINTS);
    glVertex3f(0, 0, 0);
    glEnd();
    for (int i = 0; i < 7; ++i) glLoadIdentity();
  } else if (strcmp(name, "draw") == 0) {
    errno = 77;
    draw();
    if (errno != 77) return 6;
  } else if (strcmp(name, "points") == 0 || strcmp(name, "abort") == 0 || strcmp(name, "exit") == 0) {
    define_curve();
    draw_curve(number);
    if (strcmp(name, "abort") == 0) abort();
    if (strcmp(name, "exit") == 0) exit(9);
  } else if (strcmp(name, "surface") == 0 || strcmp(name, "mesh") == 0) { /* for measurements */
    GLfloat net[48];
    for (int i = 0; i < 48; ++i) net[i] = (GLfloat)(i % 7) / 7;
    glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, net);
    glEnable(GL_MAP2_VERTEX_3);
    glMapGrid2f(10, 0, 1, 10, 0, 1);
    for (int i = 0; i < number; ++i) {
      if (name[0] == 'm') {
        glEvalMesh2(GL_POINT, 0, 10, 0, 10);
        continue;
      }
      glBegin(GL_POINTS);
      for (int k = 0; k < 121; ++k) glEvalCoord2f((GLfloat)(k % 11) / 10, (GLfloat)(k / 11) / 10);
      glEnd();
    }
  } else if (strcmp(name, "descriptors") == 0) {
    define_curve();
    for (int i = 3; i < 100; ++i) close(i);
    draw_curve(number);
  } else if (strcmp(name, "fork") == 0) {
    define_curve();
    const pid_t child = fork();
    draw_curve(child == 0 ? 3 : 5);
    if (child == 0) _exit(0); /* the threads of OSMesa are not there to finish the drawing */
    waitpid(child, NULL, 0);
  } else if (strcmp(name, "frames") == 0) {
    for (int i = 0; i < number; ++i) {
      define_curve();
      glColor3f((GLfloat)i, 0, 0);
      draw_curve(1);
      glFinish();
    }
  } else {
    return 2;
  }
  glFinish();
  OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
  OSMesaDestroyContext(context);
  return 0;
}
