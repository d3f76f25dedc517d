/* A curve, point by point: the GL commands with a context as first argument, and a sink that gets the
 * vertices. It prints as numbers what an old program draws with glMap1f and glEvalMesh1. curve.f does the
 * same in Fortran. */
#include <glevaluator.h>
#include <stdio.h>

static void print(void* user, const glev_vertex* vertex) {
  (void)user;
  printf("%12.6f%12.6f%12.6f\n", vertex->position[0], vertex->position[1], vertex->position[2]);
}

int main(void) {
  static const float points[4][3] = {{0, 0, 0}, {1, 2, 0.5f}, {3, 2, 1}, {4, 0, 2}};
  const glev_sink sink = {.size = sizeof sink, .vertex = print};
  glev_context* gl;
  if (glevCreateContext(NULL, &gl) != GLEV_SUCCESS) return 1;
  if (glevSetSink(gl, &sink) != GLEV_SUCCESS) return 1;

  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, &points[0][0]);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevMapGrid1f(gl, 10, 0, 1);
  glevEvalMesh1(gl, GLEV_LINE, 0, 10);

  const glev_enum error = glevGetError(gl);
  if (error != GLEV_NO_ERROR) fprintf(stderr, "error 0x%04X\n", error);
  glevDestroyContext(gl);
  return error != GLEV_NO_ERROR;
}
