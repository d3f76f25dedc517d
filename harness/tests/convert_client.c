/* A program with evaluators on EGL, which can be recorded and traced. Exit code 77: there is no context. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stddef.h>

static const GLfloat kNet[2][3][4] = {{{0, 0, 0, 1}, {0.1f, 1, 0, 1}, {1.0f / 3, 2, 0, 2}},
                                      {{1, 0, 1e-30f, 1}, {1, 1, -0.0f, 1}, {1, 2, 3.14159274f, 1}}};

static void draw(int frame) {
  glMap2f(GL_MAP2_VERTEX_4, 0, 1, 12, 2, 0.1f, 1, 4, 3, &kNet[0][0][0]);
  const GLdouble colours[8] = {1.0 / 3, 0, 0, 1, frame, 1, 0.5, 0.25};
  glMap1d(GL_MAP1_COLOR_4, -1, 1.0 / 3, 4, 2, colours);
  const GLfloat points[6] = {0, 0, 0, 1, 2, 3};
  glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, points);
  glEnable(GL_MAP2_VERTEX_4);
  glEnable(GL_MAP1_VERTEX_3);
  glEnable(GL_MAP1_COLOR_4);
  glEnable(GL_AUTO_NORMAL);
  glEnable(GL_LIGHTING); /* another part of the GL, as the next one */
  glLoadIdentity();
  glMapGrid2d(4, 0, 1.0 / 3, 3, 0.1, 1);
  glEvalMesh2(GL_FILL, 0, 4, 0, 3);
  glColor3ub(255, 0, 51);
  glColor4sv((const GLshort[]){1, 2, 3, -4});
  glNormal3b(-128, 127, 0);
  glMultiTexCoord2iARB(GL_TEXTURE1, 5, -6);
  glTexCoord3s(1, 2, 3);
  glIndexub(7);
  glEdgeFlag(GL_FALSE);
  glBegin(GL_TRIANGLES);
  glEvalCoord2f(0.3f, 0.7f);
  glEvalCoord2dv((const GLdouble[]){0.1, 1.0 / 3});
  glEvalPoint2(1, 2);
  glVertex3i(1, 2, 3);
  glEvalCoord1f(0.5f);
  glVertex4dv((const GLdouble[]){1, 2, 3, 0.5});
  glEnd();
  glNewList(3, GL_COMPILE);
  glMapGrid1f(3, 0, 1);
  glEvalMesh1(GL_LINE, 0, 3);
  glEndList();
  glCallLists(2, GL_UNSIGNED_BYTE, (const GLubyte[]){3, 4});
  glPushAttrib(GL_EVAL_BIT | GL_CURRENT_BIT);
  glPopAttrib();
  GLfloat coefficients[24];
  GLint order[2];
  glGetMapfv(GL_MAP2_VERTEX_4, GL_COEFF, coefficients);
  glGetMapiv(GL_MAP2_VERTEX_4, GL_ORDER, order);
  glGetError();
}

int main(void) {
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  EGLConfig config;
  EGLint count = 0;
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
    return 77;
  const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
  if (!eglMakeCurrent(display, surface, surface, context)) return 77;
  for (int frame = 0; frame < 2; ++frame) {
    draw(frame);
    eglSwapBuffers(display, surface);
  }
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
  eglTerminate(display);
  return 0;
}
