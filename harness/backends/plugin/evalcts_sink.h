/* A sink: an evaluator that is not a GL and is judged by evalcts.
 *
 * It is a shared library that exports evalcts_sink_open(). It provides any number of commands under their GL
 * names and hands its vertices over one by one.
 *
 *   cc -shared -fPIC -I FOLDER_OF_THIS_HEADER -o mine.so mine.c
 *   evalcts run --library ./mine.so
 *   evalcts fuzz --library ./mine.so
 *
 * The sink declares its commands, targets, largest order and attributes. A test that needs anything else is
 * not-supported; everything that is declared is judged. harness/examples/smallest_sink.c is a complete sink
 * of two dozen lines, harness/examples/bezier_sink.c has several targets. */
#ifndef EVALCTS_SINK_H
#define EVALCTS_SINK_H

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define EVALCTS_SINK_VERSION 2

/* The receiver of the evaluator's primitives. It belongs to evalcts and lives as long as the context. */
typedef struct evalcts_receiver {
  void* user; /* the first argument of the functions below */

  /* Opens a primitive, as Begin does. mode: GL_POINTS (0) to GL_POLYGON (9). */
  void (*begin)(void* user, unsigned int mode);
  /* Closes the primitive, as End does. */
  void (*end)(void* user);

  /* Receives a vertex that EvalCoord or Vertex emits, between begin() and end(). normal has three components,
   * the others have four; texcoord has `units` rows. The arrays are copied. An attribute that
   * evalcts_sink::attributes does not name is null. */
  void (*vertex)(void* user, const float* position, const float* color, const float* normal,
                 const float (*texcoord)[4], unsigned int units);
} evalcts_receiver;

/* Attributes of a vertex; a set is their sum. */
#define EVALCTS_SINK_POSITION 1u
#define EVALCTS_SINK_COLOR 2u
#define EVALCTS_SINK_NORMAL 4u
#define EVALCTS_SINK_TEXCOORD 8u        /* unit 0 */
#define EVALCTS_SINK_TEXCOORD_OTHER 16u /* units 1 to 7 */
#define EVALCTS_SINK_ALL 31u

/* A GL command by its name ("glMap1f"), with the arguments and types of <GL/gl.h>. */
typedef struct evalcts_sink_command {
  const char* name;       /* such as "glMap1f" */
  void (*function)(void); /* the command, cast to this type */
} evalcts_sink_command;

/* Row of the table for a function with the name of its command: EVALCTS_SINK_COMMAND(Map1f). */
#define EVALCTS_SINK_COMMAND(function) \
  { "gl" #function, (void (*)(void))function }

/* The description of a sink, which evalcts_sink_open() returns. */
typedef struct evalcts_sink {
  /* The EVALCTS_SINK_VERSION that the library was built with. */
  unsigned int version;

  /* The attributes that vertex() receives, a sum of EVALCTS_SINK_POSITION and so on. */
  unsigned int attributes;

  /* The supported commands, terminated by a null name. If Begin, End (which open and close primitives of the
   * receiver) or GetString is missing, evalcts supplies it. If Color4f, Normal3f, TexCoord4f and Vertex4f
   * exist, evalcts first checks that known vertices come through unchanged. Without GetError, errors are not
   * judged. */
  const evalcts_sink_command* commands;

  /* Sets the initial state of GL. Called at the start of each case, thousands of times in one process.
   * Vertices go to the receiver until the next call. Returns null, or the reason for a failure. */
  const char* (*reset)(const evalcts_receiver* receiver);

  /* The supported map targets (GL_MAP1_VERTEX_3), and GL_AUTO_NORMAL if automatic normals are supported;
   * terminated by 0. Null: all of them. */
  const unsigned int* targets;

  /* The largest supported order of a map. 0: the answer of GetIntegerv to GL_MAX_EVAL_ORDER, or 8. */
  int max_order;

  const char* vendor; /* vendor of the evaluator in the report; null: unknown */
  const char* name;   /* name of the evaluator in the report; null: unknown */

  /* The GL version of these evaluators. Commands and rules of later versions are not tested. Null: "1.1". */
  const char* gl_version;
} evalcts_sink;

/* Returns the sink, which must stay valid until the process ends, or null if the library cannot be used.
 * Called once, from the thread that calls everything else. */
__attribute__((visibility("default"))) const evalcts_sink* evalcts_sink_open(void);

#ifdef __cplusplus
}
#endif

#endif
