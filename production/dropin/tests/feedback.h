/* Prints the vertices of feedback mode for the test: the texture coordinates of each vertex. */
#ifndef GLEVALUATOR_DROPIN_FEEDBACK_H_
#define GLEVALUATOR_DROPIN_FEEDBACK_H_

#include <GL/gl.h>
#include <stdio.h>

/* Prints `count` values of a buffer of type GL_4D_COLOR_TEXTURE. */
static inline void print_feedback(const char* title, const GLfloat* buffer, GLint count) {
  GLint i = 0;
  printf("%s\n", title);
  while (i + 1 < count) {
    int vertices = 1;
    const GLenum token = (GLenum)buffer[i++];
    if (token == GL_LINE_TOKEN || token == GL_LINE_RESET_TOKEN) vertices = 2;
    if (token == GL_POLYGON_TOKEN) vertices = (int)buffer[i++];
    for (; vertices > 0; --vertices, i += 12)
      printf("%a %a %a %a\n", buffer[i + 8], buffer[i + 9], buffer[i + 10], buffer[i + 11]);
  }
}

#endif
