/* An evaluator that is no GL, judged by evalcts.
 *
 * It is built into a shared library that exports evalcts_sink_open(): commands under the names that they have
 * in GL, as many as there are, and vertices handed over one by one.
 *
 *   cc -shared -fPIC -I FOLDER_OF_THIS_HEADER -o mine.so mine.c
 *   evalcts run --library ./mine.so
 *
 * A test that needs a command which is not there is not-observable, the tests of Api.EntryPoint apart, which
 * ask for just that; everything else is judged. harness/examples/bezier_sink.c is a whole one. */
#ifndef EVALCTS_SINK_H
#define EVALCTS_SINK_H

#ifdef __cplusplus
extern "C" {
#endif

#define EVALCTS_SINK_VERSION 1

/* Where the evaluator hands its primitives over; belongs to evalcts and lives as long as the context. */
typedef struct evalcts_receiver {
  void* user; /* first argument of the functions below */

  /* What Begin and End do; mode: GL_POINTS (0) to GL_POLYGON (9). */
  void (*begin)(void* user, unsigned int mode);
  void (*end)(void* user);

  /* A vertex as EvalCoord or Vertex emits it, between begin() and end(). normal has three components, the
   * others four; texcoord has `units` rows. All are copied. Null where evalcts_sink::attributes leaves it
   * out. */
  void (*vertex)(void* user, const float* position, const float* color, const float* normal,
                 const float (*texcoord)[4], unsigned int units);
} evalcts_receiver;

/* What vertex() gets to see, as a set. */
#define EVALCTS_SINK_POSITION 1u
#define EVALCTS_SINK_COLOR 2u
#define EVALCTS_SINK_NORMAL 4u
#define EVALCTS_SINK_TEXCOORD 8u        /* unit 0 */
#define EVALCTS_SINK_TEXCOORD_OTHER 16u /* units 1 to 7 */
#define EVALCTS_SINK_ALL 31u

typedef struct evalcts_sink {
  /* EVALCTS_SINK_VERSION as it was when the library was built. */
  unsigned int version;

  /* Values of what is left out are not judged. */
  unsigned int attributes;

  /* For the report. */
  const char* vendor;
  const char* name;

  /* The version of GL whose evaluators these are, "1.1" or "2.1" say: what came later is not asked for. */
  const char* gl_version;

  /* A context in its initial state; commands act on it until destroy(). Never called while another context
   * exists, but thousands of times in one process. Null where it failed; error() then says why. */
  void* (*create)(const evalcts_receiver* receiver);

  void (*destroy)(void* context);

  /* The function for a GL command ("glMap1f"), with the arguments and types of <GL/gl.h>; null where there is
   * none. Nothing is emulated, but GetString where it is missing. With Begin, End, Color4f, Normal3f,
   * TexCoord4f and Vertex4f evalcts first makes sure that known vertices come through unchanged, and can
   * judge lines and polygons as well as points. Without GetError errors are not judged. */
  void* (*command)(const char* name);

  /* Why the last create() failed. May be null. */
  const char* (*error)(void);
} evalcts_sink;

/* Called once, from the thread that calls everything else. What it returns stays valid until the process
 * ends. Null: the library cannot be used. */
__attribute__((visibility("default"))) const evalcts_sink* evalcts_sink_open(void);

#ifdef __cplusplus
}
#endif

#endif
