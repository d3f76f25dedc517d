/* An evaluator that is not a GL, judged by evalcts.
 *
 * It is built into a shared library that exports evalcts_sink_open(): commands under the names that they have
 * in GL, as many as there are, and vertices handed over one by one.
 *
 *   cc -shared -fPIC -I FOLDER_OF_THIS_HEADER -o mine.so mine.c
 *   evalcts run --library ./mine.so
 *   evalcts fuzz --library ./mine.so
 *
 * The sink declares its commands, targets, largest order and attributes. A test that needs anything else is
 * not-observable; everything that is declared is judged. harness/examples/smallest_sink.c has two dozen
 * lines, harness/examples/bezier_sink.c has several targets. */
#ifndef EVALCTS_SINK_H
#define EVALCTS_SINK_H

#ifdef __cplusplus
extern "C" {
#endif

#define EVALCTS_SINK_VERSION 2

/* Where the evaluator hands its primitives over; belongs to evalcts and lives as long as the context. */
typedef struct evalcts_receiver {
  void* user; /* first argument of the functions below */

  /* What Begin and End do; mode: GL_POINTS (0) to GL_POLYGON (9). */
  void (*begin)(void* user, unsigned int mode);
  void (*end)(void* user);

  /* A vertex as EvalCoord or Vertex emits it, between begin() and end(). normal has three components, the
   * others four; texcoord has `units` rows. All are copied. Null for an attribute that
   * evalcts_sink::attributes does not name. */
  void (*vertex)(void* user, const float* position, const float* color, const float* normal,
                 const float (*texcoord)[4], unsigned int units);
} evalcts_receiver;

/* The attributes of a vertex, as a set. */
#define EVALCTS_SINK_POSITION 1u
#define EVALCTS_SINK_COLOR 2u
#define EVALCTS_SINK_NORMAL 4u
#define EVALCTS_SINK_TEXCOORD 8u        /* unit 0 */
#define EVALCTS_SINK_TEXCOORD_OTHER 16u /* units 1 to 7 */
#define EVALCTS_SINK_ALL 31u

/* A GL command by its name ("glMap1f"), with the arguments and types of <GL/gl.h>. */
typedef struct evalcts_sink_command {
  const char* name;
  void (*function)(void);
} evalcts_sink_command;

/* The row of the function Map1f: EVALCTS_SINK_COMMAND(Map1f). */
#define EVALCTS_SINK_COMMAND(function) \
  { "gl" #function, (void (*)(void))function }

typedef struct evalcts_sink {
  /* EVALCTS_SINK_VERSION as it was when the library was built. */
  unsigned int version;

  /* EVALCTS_SINK_POSITION and so on: what vertex() is given. */
  unsigned int attributes;

  /* The commands that exist, ended by a null name. Begin and End, which open and close primitives of the
   * receiver, and GetString are supplied if they are missing. If there are Color4f, Normal3f, TexCoord4f and
   * Vertex4f, evalcts first makes sure that known vertices come through unchanged. Without GetError, errors
   * are not judged. */
  const evalcts_sink_command* commands;

  /* Called at the start of each case, thousands of times in one process: sets the initial state of GL.
   * Vertices go to the receiver until the next call. Returns null, or the reason why it cannot. */
  const char* (*reset)(const evalcts_receiver* receiver);

  /* The maps that commands take (GL_MAP1_VERTEX_3), and GL_AUTO_NORMAL if there are automatic normals; ended
   * by 0. Null: all of them. */
  const unsigned int* targets;

  /* The largest order of a map; 0: the answer to GetIntegerv of GL_MAX_EVAL_ORDER, or 8. */
  int max_order;

  /* For the report; null: unknown. */
  const char* vendor;
  const char* name;

  /* The version of GL whose evaluators these are: commands and rules of later versions are not asked for.
   * Null: "1.1". */
  const char* gl_version;
} evalcts_sink;

/* Called once, from the thread that calls everything else. What it returns stays valid until the process
 * ends. Null: the library cannot be used. */
__attribute__((visibility("default"))) const evalcts_sink* evalcts_sink_open(void);

#ifdef __cplusplus
}
#endif

#endif
