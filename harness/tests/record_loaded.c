/* A program that opens OSMesa and looks up its commands, for the tests of `evalcts record`. */
#define _GNU_SOURCE
#include <GL/gl.h>
#include <dlfcn.h>
#include <stddef.h>

typedef void (*Map1f)(GLenum, GLfloat, GLfloat, GLint, GLint, const GLfloat*);
typedef void (*EvalCoord1f)(GLfloat);
typedef void (*Command)(void);

int main(void) {
  static unsigned char pixels[16 * 16 * 4];
  static const GLfloat points[2] = {0.25f, 0.75f};
  /* Without a GL there are no commands. */
  if (dlsym(RTLD_DEFAULT, "glMap1f") != NULL) return 3;
  for (int i = 0; i < 2; ++i) { /* the library is closed and opened again */
    void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) return 77;
    void* (*const create)(GLenum, void*) = (void* (*)(GLenum, void*))dlsym(library, "OSMesaCreateContext");
    GLboolean (*const make_current)(void*, void*, GLenum, GLsizei, GLsizei) =
        (GLboolean(*)(void*, void*, GLenum, GLsizei, GLsizei))dlsym(library, "OSMesaMakeCurrent");
    void (*const destroy)(void*) = (void (*)(void*))dlsym(library, "OSMesaDestroyContext");
    Command (*const look_up)(const char*) = (Command(*)(const char*))dlsym(library, "OSMesaGetProcAddress");
    if (dlsym(library, "glNotThere") != NULL) return 4;
    void* const context = create(GL_RGBA, NULL);
    if (context == NULL || !make_current(context, pixels, GL_UNSIGNED_BYTE, 16, 16)) return 5;
    ((Map1f)dlsym(library, "glMap1f"))(GL_MAP1_INDEX, 0, 1, 1, 2, points);
    ((EvalCoord1f)look_up("glEvalCoord1f"))(0.5f);
    ((Command)look_up("glFinish"))();
    ((Command)dlsym(library, "glFinish"))();
    destroy(context);
    dlclose(library);
  }
  return 0;
}
