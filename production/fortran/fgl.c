/* The Fortran binding: the functions that `CALL fglMap1f(...)` of a Fortran program calls. All arguments are
 * passed by reference. Names are those of gfortran for external procedures: lower case with an underscore.
 * fgl.inc documents the commands.
 *
 * This file is compiled twice: for libfglev, which uses the current context of fglev_context.c, and, with
 * FGL_GL, for libfgl, which calls the GL that the program is linked to.
 *
 * A command with an array has two names. fglmap1f_ gets the address of the array, which Fortran passes
 * without a declaration. fglmap1fp_ gets the address of eight bytes that hold the address of the array: a
 * CHARACTER*8, an INTEGER*8 or a TYPE(C_PTR) by reference, or the descriptor of an assumed-rank array of a
 * BIND(C) procedure, whose first member is the address (Fortran 2018, 18.5.3). fgl.inc chooses between the
 * two by the type of the argument. */
#include <string.h>

#ifdef FGL_GL
#include <GL/gl.h>
#define READY 1
#define GL(command, ...) gl##command(__VA_ARGS__)
#else
#include "fglev_context.h"
#define READY fglev_current() /* without a context, commands have no effect */
#define GL(command, ...) glev##command(fglev_current(), ##__VA_ARGS__)
#endif
#define CALL(...) \
  if (READY) GL(__VA_ARGS__)

typedef int integer; /* INTEGER*4, with the bits of a GLenum */
_Static_assert(sizeof(void*) == 8 && sizeof(integer) == 4, "CHARACTER*8 holds an address");

/* Returns the address in a holder, which need not be aligned. */
static void* held(const void* holder) {
  void* address;
  memcpy(&address, holder, sizeof address);
  return address;
}

/* Defines both functions of a command with an array argument: by its address, and by a holder of the address.
 * `declared` and `passed` are the preceding arguments. */
#define UNWRAP(...) __VA_ARGS__
#define ARRAY_COMMAND(symbol, command, type, declared, passed)                          \
  void symbol##_(UNWRAP declared, type* array) { CALL(command, UNWRAP passed, array); } \
  void symbol##p_(UNWRAP declared, const void* holder) { CALL(command, UNWRAP passed, held(holder)); }
#define VECTOR_COMMAND(symbol, command, type)                 \
  void symbol##_(const type* array) { CALL(command, array); } \
  void symbol##p_(const void* holder) { CALL(command, held(holder)); }

/* Commands for REAL*8 and for REAL*4. */
#define COMMANDS(f, real)                                                                                    \
  ARRAY_COMMAND(                                                                                             \
      fglmap1##f, Map1##f, const real,                                                                       \
      (const integer* target, const real* u1, const real* u2, const integer* stride, const integer* order),  \
      (*target, *u1, *u2, *stride, *order))                                                                  \
  ARRAY_COMMAND(                                                                                             \
      fglmap2##f, Map2##f, const real,                                                                       \
      (const integer* target, const real* u1, const real* u2, const integer* ustride, const integer* uorder, \
       const real* v1, const real* v2, const integer* vstride, const integer* vorder),                       \
      (*target, *u1, *u2, *ustride, *uorder, *v1, *v2, *vstride, *vorder))                                   \
  void fglmapgrid1##f##_(const integer* n, const real* u1, const real* u2) {                                 \
    CALL(MapGrid1##f, *n, *u1, *u2);                                                                         \
  }                                                                                                          \
  void fglmapgrid2##f##_(const integer* un, const real* u1, const real* u2, const integer* vn,               \
                         const real* v1, const real* v2) {                                                   \
    CALL(MapGrid2##f, *un, *u1, *u2, *vn, *v1, *v2);                                                         \
  }                                                                                                          \
  void fglevalcoord1##f##_(const real* u) { CALL(EvalCoord1##f, *u); }                                       \
  void fglevalcoord2##f##_(const real* u, const real* v) { CALL(EvalCoord2##f, *u, *v); }                    \
  VECTOR_COMMAND(fglevalcoord1##f##v, EvalCoord1##f##v, real)                                                \
  VECTOR_COMMAND(fglevalcoord2##f##v, EvalCoord2##f##v, real)                                                \
  void fglvertex2##f##_(const real* x, const real* y) { CALL(Vertex2##f, *x, *y); }                          \
  void fglvertex3##f##_(const real* x, const real* y, const real* z) { CALL(Vertex3##f, *x, *y, *z); }       \
  void fglvertex4##f##_(const real* x, const real* y, const real* z, const real* w) {                        \
    CALL(Vertex4##f, *x, *y, *z, *w);                                                                        \
  }                                                                                                          \
  void fglcolor3##f##_(const real* red, const real* green, const real* blue) {                               \
    CALL(Color3##f, *red, *green, *blue);                                                                    \
  }                                                                                                          \
  void fglcolor4##f##_(const real* red, const real* green, const real* blue, const real* alpha) {            \
    CALL(Color4##f, *red, *green, *blue, *alpha);                                                            \
  }                                                                                                          \
  void fglnormal3##f##_(const real* x, const real* y, const real* z) { CALL(Normal3##f, *x, *y, *z); }       \
  void fgltexcoord1##f##_(const real* s) { CALL(TexCoord1##f, *s); }                                         \
  void fgltexcoord2##f##_(const real* s, const real* t) { CALL(TexCoord2##f, *s, *t); }                      \
  void fgltexcoord3##f##_(const real* s, const real* t, const real* r) { CALL(TexCoord3##f, *s, *t, *r); }   \
  void fgltexcoord4##f##_(const real* s, const real* t, const real* r, const real* q) {                      \
    CALL(TexCoord4##f, *s, *t, *r, *q);                                                                      \
  }
COMMANDS(d, double)
COMMANDS(f, float)

ARRAY_COMMAND(fglgetmapdv, GetMapdv, double, (const integer* target, const integer* query), (*target, *query))
ARRAY_COMMAND(fglgetmapfv, GetMapfv, float, (const integer* target, const integer* query), (*target, *query))
ARRAY_COMMAND(fglgetmapiv, GetMapiv, integer, (const integer* target, const integer* query),
              (*target, *query))
ARRAY_COMMAND(fglgetdoublev, GetDoublev, double, (const integer* pname), (*pname))
ARRAY_COMMAND(fglgetfloatv, GetFloatv, float, (const integer* pname), (*pname))
ARRAY_COMMAND(fglgetintegerv, GetIntegerv, integer, (const integer* pname), (*pname))

void fglevalpoint1_(const integer* i) { CALL(EvalPoint1, *i); }
void fglevalpoint2_(const integer* i, const integer* j) { CALL(EvalPoint2, *i, *j); }
void fglevalmesh1_(const integer* mode, const integer* i1, const integer* i2) {
  CALL(EvalMesh1, *mode, *i1, *i2);
}
void fglevalmesh2_(const integer* mode, const integer* i1, const integer* i2, const integer* j1,
                   const integer* j2) {
  CALL(EvalMesh2, *mode, *i1, *i2, *j1, *j2);
}

void fglenable_(const integer* cap) { CALL(Enable, *cap); }
void fgldisable_(const integer* cap) { CALL(Disable, *cap); }
signed char fglisenabled_(const integer* cap) { return READY && GL(IsEnabled, *cap); } /* LOGICAL*1 */
void fglbegin_(const integer* mode) { CALL(Begin, *mode); }
void fglend_(void) { CALL(End); }
integer fglgeterror_(void) { return READY ? (integer)GL(GetError) : 0; }
