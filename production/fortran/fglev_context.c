/* Contexts of Fortran programs: making, making current, sinks, destruction; names of results. fglev.inc
 * documents the routines. */
#include "fglev_context.h"

#include <stdlib.h>
#include <string.h>

typedef void begin_procedure(const int* mode);
typedef void vertex_procedure(const float* position, const float* color, const float* normal,
                              const float* texcoord);
typedef void end_procedure(void);

/* The object whose address is the handle of a context, an INTEGER*8. */
typedef struct fortran_context {
  glev_context* context;
  begin_procedure* begin;
  vertex_procedure* vertex;
  end_procedure* end;
} fortran_context;

static _Thread_local fortran_context* current;

glev_context* fglev_current(void) { return current ? current->context : NULL; }

/* A CHARACTER function of Fortran: its first arguments are the memory of its value and the length of that. */
void fglevgetresultstring_(char* text, size_t length, const int* code) {
  const char* const name = glevGetResultString((glev_result)*code);
  const size_t size = strlen(name);
  memset(text, ' ', length);
  memcpy(text, name, size < length ? size : length);
}

int fglevcreatecontext_(fortran_context** handle) {
  glev_result result = GLEV_ERROR_OUT_OF_MEMORY;
  fortran_context* made = calloc(1, sizeof *made);
  if (made) result = glevCreateContext(NULL, &made->context);
  if (result != GLEV_SUCCESS) {
    free(made);
    made = NULL;
  }
  *handle = made;
  return result;
}

void fglevmakecurrent_(fortran_context* const* handle) { current = *handle; }

void fglevdestroycontext_(fortran_context** handle) {
  if (!*handle) return;
  if (current == *handle) current = NULL;
  glevDestroyContext((*handle)->context);
  free(*handle);
  *handle = NULL;
}

static void begin(void* user, glev_enum mode) {
  const int value = (int)mode;
  ((fortran_context*)user)->begin(&value);
}

static void vertex(void* user, const glev_vertex* v) {
  ((fortran_context*)user)->vertex(v->position, v->color, v->normal, v->texcoord[0]);
}

static void end(void* user) { ((fortran_context*)user)->end(); }

int fglevsetsink_(begin_procedure* on_begin, vertex_procedure* on_vertex, end_procedure* on_end) {
  if (!current) return GLEV_ERROR_INVALID_ARGUMENT;
  const glev_sink sink = {sizeof(glev_sink), current, begin, vertex, end};
  const glev_result result = glevSetSink(current->context, &sink);
  if (result == GLEV_SUCCESS) {
    current->begin = on_begin;
    current->vertex = on_vertex;
    current->end = on_end;
  }
  return result;
}
