/* glevaluator: the evaluators of OpenGL as a library that needs no GL.
 *
 * There are three ways to use it:
 *
 *   1. The GL commands. A glev_context holds evaluator state and current values. The functions are the GL's
 *      with the prefix glev and the context as first argument, and behave as GL 4.6 (compatibility profile)
 *      specifies, errors included. Vertices are passed to a sink, which consists of three callbacks.
 *   2. Batches. A glev_plan is an immutable snapshot of the enabled maps and the grid of a context.
 *      glevEvaluate evaluates it at arrays of arguments, glevEvaluateMesh at points of the grid; both write
 *      to memory of the caller. glevGetIndices connects the points to primitives.
 *   3. Patches. glevEvaluatePatches evaluates an array of Bezier patches or curves in one call, without a
 *      context; glevCreatePlanFromMap makes a plan of one map.
 *
 * Conventions
 *   - The header is C99 and C++. The library has no global state: all state belongs to a context or a plan.
 *   - A context belongs to one thread at a time. A plan may be used by any number of threads at once.
 *   - A null context or plan is undefined behaviour, except that DestroyContext and ReleasePlan ignore it,
 *     Evaluate and EvaluateMesh return INVALID_ARGUMENT, and GetMeshScratchSize returns 0. Any other null
 *     pointer that is not allowed is an error: GL-named functions record INVALID_VALUE (the GL leaves null
 *     undefined), the others return GLEV_ERROR_INVALID_ARGUMENT.
 *   - Infinities and NaN are legal control points, domain ends, grid ends and arguments, and are not errors
 *     by themselves. A component of a result that depends on one is unspecified: any float, infinity or NaN.
 *     A component of a control point does not affect the other components.
 *   - Later versions may extend structures. Programs that were compiled with an earlier header keep working:
 *       - A structure that begins with `size` may get more members at its end. Set `size` to sizeof the
 *         structure, as in `glev_sink sink = {.size = sizeof sink, .vertex = print}`; members that are not
 *         mentioned are zero, which is their default. The library reads `size` bytes and treats the members
 *         beyond as zero, which selects the behaviour of the library before it had them. A structure that is
 *         larger than that of the library is accepted if the bytes beyond are zero. Every function that gets
 *         another size, such as 0 because it was not set, returns GLEV_ERROR_STRUCTURE_SIZE, also for
 *         structures that others point to.
 *       - Such a structure is passed by pointer and is never a member or an array element of another one.
 *       - glev_input and glev_attribute_output have no `size` and never change.
 *       - The `size` of the glev_vertex that a sink gets is that of the library; members beyond do not exist.
 *       - Members keep their offsets, enumerators and tokens their values, and functions their signatures.
 *   - Counts and byte strides are size_t. Parameters that are GLint or GLenum in the GL keep this type.
 *   - Clauses are cited from the OpenGL 4.6 compatibility profile as "GL §"; earlier versions have the same
 *     rules for evaluators in §5.1.
 */
#ifndef GLEVALUATOR_H_
#define GLEVALUATOR_H_

#include <stddef.h>

#if defined(GLEV_STATIC)
#define GLEV_API
#elif defined(_WIN32)
#if defined(GLEV_BUILDING_LIBRARY)
#define GLEV_API __declspec(dllexport)
#else
#define GLEV_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define GLEV_API __attribute__((visibility("default")))
#else
#define GLEV_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Types: the same representation as GLenum, GLbitfield, GLboolean, GLubyte, GLint (and GLsizei), GLuint,
 * GLfloat and GLdouble ---- */

typedef unsigned int glev_enum;
typedef unsigned int glev_bitfield;
typedef unsigned char glev_boolean;
typedef unsigned char glev_ubyte;
typedef int glev_int;
typedef unsigned int glev_uint;
typedef float glev_float;
typedef double glev_double;

typedef struct glev_context glev_context;
typedef struct glev_plan glev_plan;

/* ---- Tokens ----
 * The values are those of the GL, so GL_MAP1_VERTEX_3 and GLEV_MAP1_VERTEX_3 are interchangeable. Programs
 * without a GL header use the tokens below. */

#define GLEV_FALSE 0
#define GLEV_TRUE 1

#define GLEV_NO_ERROR 0
#define GLEV_INVALID_ENUM 0x0500
#define GLEV_INVALID_VALUE 0x0501
#define GLEV_INVALID_OPERATION 0x0502
#define GLEV_STACK_OVERFLOW 0x0503
#define GLEV_STACK_UNDERFLOW 0x0504
#define GLEV_OUT_OF_MEMORY 0x0505

#define GLEV_BYTE 0x1400
#define GLEV_UNSIGNED_BYTE 0x1401
#define GLEV_SHORT 0x1402
#define GLEV_UNSIGNED_SHORT 0x1403
#define GLEV_INT 0x1404
#define GLEV_UNSIGNED_INT 0x1405
#define GLEV_FLOAT 0x1406
#define GLEV_2_BYTES 0x1407
#define GLEV_3_BYTES 0x1408
#define GLEV_4_BYTES 0x1409
#define GLEV_DOUBLE 0x140A

/* Targets: number of values of a control point in brackets (GL table 21.1), the same for both dimensions. */
#define GLEV_MAP1_COLOR_4 0x0D90         /* [4] R, G, B, A */
#define GLEV_MAP1_INDEX 0x0D91           /* [1] colour index */
#define GLEV_MAP1_NORMAL 0x0D92          /* [3] x, y, z */
#define GLEV_MAP1_TEXTURE_COORD_1 0x0D93 /* [1] s */
#define GLEV_MAP1_TEXTURE_COORD_2 0x0D94 /* [2] s, t */
#define GLEV_MAP1_TEXTURE_COORD_3 0x0D95 /* [3] s, t, r */
#define GLEV_MAP1_TEXTURE_COORD_4 0x0D96 /* [4] s, t, r, q */
#define GLEV_MAP1_VERTEX_3 0x0D97        /* [3] x, y, z */
#define GLEV_MAP1_VERTEX_4 0x0D98        /* [4] x, y, z, w */

#define GLEV_MAP2_COLOR_4 0x0DB0
#define GLEV_MAP2_INDEX 0x0DB1
#define GLEV_MAP2_NORMAL 0x0DB2
#define GLEV_MAP2_TEXTURE_COORD_1 0x0DB3
#define GLEV_MAP2_TEXTURE_COORD_2 0x0DB4
#define GLEV_MAP2_TEXTURE_COORD_3 0x0DB5
#define GLEV_MAP2_TEXTURE_COORD_4 0x0DB6
#define GLEV_MAP2_VERTEX_3 0x0DB7
#define GLEV_MAP2_VERTEX_4 0x0DB8

#define GLEV_AUTO_NORMAL 0x0D80

#define GLEV_COEFF 0x0A00
#define GLEV_ORDER 0x0A01
#define GLEV_DOMAIN 0x0A02

#define GLEV_MAX_EVAL_ORDER 0x0D30
#define GLEV_MAP1_GRID_DOMAIN 0x0DD0
#define GLEV_MAP1_GRID_SEGMENTS 0x0DD1
#define GLEV_MAP2_GRID_DOMAIN 0x0DD2
#define GLEV_MAP2_GRID_SEGMENTS 0x0DD3

/* Modes of meshes. */
#define GLEV_POINT 0x1B00
#define GLEV_LINE 0x1B01
#define GLEV_FILL 0x1B02

#define GLEV_CURRENT_COLOR 0x0B00
#define GLEV_CURRENT_INDEX 0x0B01
#define GLEV_CURRENT_NORMAL 0x0B02
#define GLEV_CURRENT_TEXTURE_COORDS 0x0B03
#define GLEV_EDGE_FLAG 0x0B43
#define GLEV_ACTIVE_TEXTURE 0x84E0
#define GLEV_MAX_TEXTURE_UNITS 0x84E2
#define GLEV_MAX_TEXTURE_COORDS 0x8871
#define GLEV_TEXTURE0 0x84C0 /* unit i is GLEV_TEXTURE0 + i */

#define GLEV_LIST_MODE 0x0B30
#define GLEV_MAX_LIST_NESTING 0x0B31
#define GLEV_LIST_BASE 0x0B32
#define GLEV_LIST_INDEX 0x0B33
#define GLEV_ATTRIB_STACK_DEPTH 0x0BB0
#define GLEV_MAX_ATTRIB_STACK_DEPTH 0x0D35

/* Modes of display lists. */
#define GLEV_COMPILE 0x1300
#define GLEV_COMPILE_AND_EXECUTE 0x1301

/* The attribute groups for which this library has state. */
#define GLEV_CURRENT_BIT 0x00000001
#define GLEV_ENABLE_BIT 0x00002000
#define GLEV_EVAL_BIT 0x00010000
#define GLEV_LIST_BIT 0x00020000
#define GLEV_TEXTURE_BIT 0x00040000
#define GLEV_ALL_ATTRIB_BITS 0xFFFFFFFF

#define GLEV_VENDOR 0x1F00
#define GLEV_RENDERER 0x1F01
#define GLEV_VERSION 0x1F02

#define GLEV_POINTS 0x0000
#define GLEV_LINES 0x0001
#define GLEV_LINE_LOOP 0x0002
#define GLEV_LINE_STRIP 0x0003
#define GLEV_TRIANGLES 0x0004
#define GLEV_TRIANGLE_STRIP 0x0005
#define GLEV_TRIANGLE_FAN 0x0006
#define GLEV_QUADS 0x0007
#define GLEV_QUAD_STRIP 0x0008
#define GLEV_POLYGON 0x0009

/* Number of texture units with a current texture coordinate: the value of MAX_TEXTURE_COORDS. */
#define GLEV_TEXTURE_UNITS 8

/* ---- Results of the functions that are not GL commands ---- */

typedef enum glev_result {
  GLEV_SUCCESS = 0,
  GLEV_ERROR_INVALID_ARGUMENT = 1, /* a null pointer, or a wrong token, stride or count */
  GLEV_ERROR_UNSUPPORTED = 2,      /* valid, but not supported by this version */
  GLEV_ERROR_OUT_OF_MEMORY = 3,
  GLEV_ERROR_IN_PRIMITIVE = 4,     /* not allowed between Begin and End */
  GLEV_ERROR_NO_MAP = 5,           /* the plan has no map for a requested attribute */
  GLEV_ERROR_BUFFER_TOO_SMALL = 6, /* `count` elements do not fit into the given bytes */
  GLEV_ERROR_OVERLAP = 7,          /* two outputs, or an output and the input, share bytes */
  GLEV_ERROR_STRUCTURE_SIZE = 8    /* the member `size` of a structure is wrong, such as 0: it was not set */
} glev_result;

/* Returns the name of a result, such as "GLEV_ERROR_STRUCTURE_SIZE", or "unknown result" for any other
 * number. The string has static lifetime. */
GLEV_API const char* glevGetResultString(glev_result result);

/* ---- Memory ---- */

/* Source of memory for a context and its plans. allocate returns null if there is no memory; the alignment is
 * a power of two. release gets the same bytes and alignment as allocate. Any thread that uses a context or
 * releases a plan may call them, so they must be thread-safe. user must outlive every plan. */
typedef struct glev_allocator {
  size_t size;
  void* user;
  void* (*allocate)(void* user, size_t bytes, size_t alignment);
  void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
} glev_allocator;

/* ---- Contexts ---- */

typedef struct glev_context_info {
  size_t size;
  const glev_allocator* allocator; /* copied; null: the heap */
  const char* target;              /* a name from glevGetTargetName; null: the best one */
} glev_context_info;

/* The names of the instruction sets ("AVX2" and the like) that this library can use on this machine, best
 * first; null for an index beyond the last. A context and its plans use one of them. Correctly rounded
 * results do not depend on the choice. */
GLEV_API const char* glevGetTargetName(size_t index);

/* Makes a context in the GL's initial state (GL §21.1 last paragraph, tables 23.4, 23.40): every map
 * disabled, of order 1 over (0,1) with GL's initial control point, AUTO_NORMAL off, grids of one segment over
 * (0,1), current colour (1,1,1,1), index 1, normal (0,0,1), texture coordinates (0,0,0,1), edge flag TRUE.
 * info: null selects the defaults. *context is null on failure.
 * Returns SUCCESS, INVALID_ARGUMENT (also for an unknown target), STRUCTURE_SIZE or OUT_OF_MEMORY. */
GLEV_API glev_result glevCreateContext(const glev_context_info* info, glev_context** context);

/* Frees the context; null is ignored. Its plans remain valid. Must not be called from a callback of its sink.
 */
GLEV_API void glevDestroyContext(glev_context* context);

/* ---- Sink: the destination of vertices ---- */

/* One vertex with its attributes. They are not transformed, lit or clamped. */
typedef struct glev_vertex {
  size_t size;
  glev_float position[4]; /* x, y, z, w */
  glev_float color[4];    /* R, G, B, A */
  glev_float normal[3];
  glev_float texcoord[GLEV_TEXTURE_UNITS][4]; /* s, t, r, q of each unit; maps feed unit 0 */
  glev_float index; /* always the current index, because RGBA mode ignores INDEX maps */
  glev_boolean edge_flag;
} glev_vertex;

/* The callbacks of a sink. A null callback is not called. The vertex is valid only during the call. A
 * callback may call the commands of the context that are legal between Begin and End; EvalCoord, EvalPoint,
 * Vertex and possibly CallList then call the sink recursively. Each primitive of a mesh has its own begin and
 * end; calling End between them is an INVALID_OPERATION. */
typedef struct glev_sink {
  size_t size;
  void* user;
  void (*begin)(void* user, glev_enum mode);
  void (*vertex)(void* user, const glev_vertex* vertex);
  void (*end)(void* user);
} glev_sink;

/* Copies the sink. Null (the initial state) means that there is no sink and vertices are discarded.
 * Returns SUCCESS, STRUCTURE_SIZE, or IN_PRIMITIVE between Begin and End. */
GLEV_API glev_result glevSetSink(glev_context* context, const glev_sink* sink);

/* ---- Errors ---- */

/* Returns and clears the first error since the last call, or returns NO_ERROR (GL §2.3.1). Between Begin and
 * End, returns 0 and records INVALID_OPERATION. A command that records an error has no other effect. Errors
 * that depend on arguments alone have precedence over those that depend on state. */
GLEV_API glev_enum glevGetError(glev_context* context);

/* Returns the name of an error that glevGetError returned, such as "GLEV_INVALID_ENUM", or "unknown error"
 * for any other number. The string has static lifetime. */
GLEV_API const char* glevGetErrorString(glev_enum error);

/* ---- Maps (GL §21.1) ---- */

/* Defines the one-dimensional map `target` over [u1,u2] by `order` control points; control point i begins
 * i*stride values (not bytes) after `points`. Everything is copied before the call returns and kept as
 * double, which is exact for the f form. u1 > u2 is legal.
 * INVALID_ENUM: target is not one of the nine MAP1 names.
 * INVALID_VALUE: order < 1, order > MAX_EVAL_ORDER (64), stride < number of values of a control point,
 *   u1 = u2 (infinities of the same sign are equal, NaN is not equal to any number), points null.
 * INVALID_OPERATION: between Begin and End; ACTIVE_TEXTURE is not TEXTURE0.
 * OUT_OF_MEMORY: nothing changed. */
GLEV_API void glevMap1f(glev_context* context, glev_enum target, glev_float u1, glev_float u2,
                        glev_int stride, glev_int order, const glev_float* points);
GLEV_API void glevMap1d(glev_context* context, glev_enum target, glev_double u1, glev_double u2,
                        glev_int stride, glev_int order, const glev_double* points);

/* Defines the two-dimensional map `target` over [u1,u2] x [v1,v2] by uorder * vorder control points; control
 * point (i,j), i in the direction of u, begins i*ustride + j*vstride values (not bytes) after `points`. The
 * strides are independent: either may be the larger one, and points may share memory. Everything is copied
 * before the call returns and kept as double, which is exact for the f form. u1 > u2 and v1 > v2 are legal.
 * INVALID_ENUM: target is not one of the nine MAP2 names.
 * INVALID_VALUE: an order < 1 or > MAX_EVAL_ORDER (64), a stride < number of values of a control point,
 *   u1 = u2, v1 = v2 (as for Map1), points null.
 * INVALID_OPERATION: between Begin and End; ACTIVE_TEXTURE is not TEXTURE0.
 * OUT_OF_MEMORY: nothing changed. */
GLEV_API void glevMap2f(glev_context* context, glev_enum target, glev_float u1, glev_float u2,
                        glev_int ustride, glev_int uorder, glev_float v1, glev_float v2, glev_int vstride,
                        glev_int vorder, const glev_float* points);
GLEV_API void glevMap2d(glev_context* context, glev_enum target, glev_double u1, glev_double u2,
                        glev_int ustride, glev_int uorder, glev_double v1, glev_double v2, glev_int vstride,
                        glev_int vorder, const glev_double* points);

/* Writes a property of a map to v.
 * query ORDER: one value (MAP2: uorder, vorder).
 * query DOMAIN: u1, u2 (MAP2: u1, u2, v1, v2).
 * query COEFF: the control points without padding, `order` of them (MAP2: uorder * vorder, v fastest).
 * Values are converted as in GL §2.2.2: integers are rounded to nearest (halves away from zero), values out
 * of range become the nearest representable one, NaN becomes 0; colours and normals are rounded as well.
 * Nothing else is written, and nothing at all on error.
 * INVALID_ENUM: target is not one of the 18 map names, query is not one of the three above.
 * INVALID_VALUE: v null.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevGetMapdv(glev_context* context, glev_enum target, glev_enum query, glev_double* v);
GLEV_API void glevGetMapfv(glev_context* context, glev_enum target, glev_enum query, glev_float* v);
GLEV_API void glevGetMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int* v);

/* Same as GetMap, but v has buf_size bytes, and nothing is written if the answer does not fit (GL §21.1.1).
 * INVALID_ENUM, INVALID_VALUE, INVALID_OPERATION: as for GetMap.
 * INVALID_VALUE: buf_size < 0.
 * INVALID_OPERATION: the answer has more than buf_size bytes. */
GLEV_API void glevGetnMapdv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_double* v);
GLEV_API void glevGetnMapfv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_float* v);
GLEV_API void glevGetnMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_int* v);

/* Set and query the 18 map enables and AUTO_NORMAL. IsEnabled returns FALSE on error.
 * INVALID_ENUM: any other name (this library has evaluator state only).
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevEnable(glev_context* context, glev_enum cap);
GLEV_API void glevDisable(glev_context* context, glev_enum cap);
GLEV_API glev_boolean glevIsEnabled(glev_context* context, glev_enum cap);

/* Evaluates the enabled MAP1 maps at u (EvalCoord2: the enabled MAP2 maps at (u,v)) and emits a vertex, as if
 * Color4, Normal3, TexCoord and then Vertex had been issued, but the current values stay as they were.
 * VERTEX_4 has precedence over VERTEX_3, and the TEXTURE_COORD map with the most values over the others.
 * Missing values are those of (0,0,0,1). Attributes without an enabled map have their current values. If no
 * vertex map of that dimension is enabled, the call has no effect. It is also ignored between End and Begin
 * (undefined in the GL). Any argument is legal.
 * Each component is correctly rounded: it is the exact value of the polynomial at the exact argument, rounded
 * once to the nearest float, ties to even, and to infinity beyond the range. The value 0 gives +0; other
 * values that round to zero keep their sign. So the result at an end of the domain is the control point, and
 * along an edge of a MAP2 map it has the bits of the MAP1 map of the control points of that edge.
 * The worst-case time is long: a component whose value is close to the midpoint of two floats is computed in
 * integers, which takes microseconds at ordinary orders, but up to a second for order 64 x 64 and doubles of
 * all magnitudes, so up to four seconds for VERTEX_4.
 * INVALID_VALUE: u null (v forms).
 * OUT_OF_MEMORY: no vertex emitted; only in the first call after a change of maps, enables or the grid.
 *
 * AUTO_NORMAL gives vertices of MAP2 maps the unit normal along q_u x q_v and overrides MAP2_NORMAL. q is the
 * vertex map that has precedence, (x,y,z)/w for VERTEX_4. Derivatives are by the normalised coordinates, so
 * reversing a domain does not turn the normal. If the product is zero (an edge that is one point, order 1 in
 * a direction) or not finite, the normal is (0,0,0). All other normals have unit length, because there is no
 * vertex shader. They are not correctly rounded. Let m be the product, multiplied by w^4 for VERTEX_4, and
 * let its majorant be the same expression of the largest magnitudes of control points and their differences.
 * Inside the domain, each component is within 2^-25 + 2^-30 of the exact one if |m| is at least 2^-50 of its
 * majorant and the magnitudes of control points and differences are zero or between 2^-300 and 2^300. A
 * component that is exactly zero, or cannot be distinguished from zero in double-double arithmetic, is +0; so
 * for smaller |m| the normal may be less accurate, in the extreme case (0,0,0). */
GLEV_API void glevEvalCoord1f(glev_context* context, glev_float u);
GLEV_API void glevEvalCoord1d(glev_context* context, glev_double u);
GLEV_API void glevEvalCoord1fv(glev_context* context, const glev_float* u);
GLEV_API void glevEvalCoord1dv(glev_context* context, const glev_double* u);
GLEV_API void glevEvalCoord2f(glev_context* context, glev_float u, glev_float v);
GLEV_API void glevEvalCoord2d(glev_context* context, glev_double u, glev_double v);
GLEV_API void glevEvalCoord2fv(glev_context* context, const glev_float* u); /* u, v */
GLEV_API void glevEvalCoord2dv(glev_context* context, const glev_double* u);

/* ---- Grids and meshes (GL §21.1) ---- */

/* Sets the grid of EvalPoint1 and EvalMesh1 (MapGrid2: of EvalPoint2 and EvalMesh2): n segments from u1 to
 * u2, kept as double. Grid point i is the real number u1 + i*(u2 - u1)/n, which is not rounded; it is exactly
 * u1 at i = 0 and u2 at i = n. The ends are independent of the domains of maps; equal ends are legal.
 * INVALID_VALUE: a number of segments <= 0.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevMapGrid1f(glev_context* context, glev_int n, glev_float u1, glev_float u2);
GLEV_API void glevMapGrid1d(glev_context* context, glev_int n, glev_double u1, glev_double u2);
GLEV_API void glevMapGrid2f(glev_context* context, glev_int un, glev_float u1, glev_float u2, glev_int vn,
                            glev_float v1, glev_float v2);
GLEV_API void glevMapGrid2d(glev_context* context, glev_int un, glev_double u1, glev_double u2, glev_int vn,
                            glev_double v1, glev_double v2);

/* Same as EvalCoord1 (EvalCoord2) at a grid point, errors included. Indices may lie outside the grid. */
GLEV_API void glevEvalPoint1(glev_context* context, glev_int i);
GLEV_API void glevEvalPoint2(glev_context* context, glev_int i, glev_int j);

/* Draw the grid points i1 to i2 in increasing order, each with the bits of EvalPoint:
 * EvalMesh1: POINT as one Begin(POINTS), LINE as one Begin(LINE_STRIP).
 * EvalMesh2: POINT as one Begin(POINTS), i fastest; LINE as a LINE_STRIP along i for each j, then one along j
 *   for each i; FILL as a QUAD_STRIP (i,j), (i,j+1) for each j from j1 to j2 - 1.
 * The sink gets these primitives, including those without vertices for an empty range. Without an enabled
 * vertex map of that dimension, the calls have no effect. If a callback changes a current value, the change
 * applies from the next vertex on.
 * INVALID_ENUM: mode is not POINT, LINE or, for EvalMesh2, FILL; also if nothing would be drawn.
 * INVALID_OPERATION: between Begin and End.
 * OUT_OF_MEMORY: nothing drawn; as for EvalCoord. */
GLEV_API void glevEvalMesh1(glev_context* context, glev_enum mode, glev_int i1, glev_int i2);
GLEV_API void glevEvalMesh2(glev_context* context, glev_enum mode, glev_int i1, glev_int i2, glev_int j1,
                            glev_int j2);

/* ---- Primitives (GL §10.7) ---- */

/* Begin calls `begin` of the sink, End calls `end`. mode: POINTS to POLYGON, or one of the four modes with
 * adjacency (0x000A to 0x000D).
 * INVALID_ENUM: any other mode.
 * INVALID_OPERATION: Begin after Begin; End without Begin, or within a mesh; mode PATCHES (0x000E), because
 *   there is no tessellation. */
GLEV_API void glevBegin(glev_context* context, glev_enum mode);
GLEV_API void glevEnd(glev_context* context);

/* Emit a vertex with the current values. z = 0 and w = 1 unless given. The d forms round to float. Ignored
 * between End and Begin (undefined in the GL).
 * INVALID_VALUE: v null. There are no other errors. */
GLEV_API void glevVertex2f(glev_context* context, glev_float x, glev_float y);
GLEV_API void glevVertex2d(glev_context* context, glev_double x, glev_double y);
GLEV_API void glevVertex2fv(glev_context* context, const glev_float* v);
GLEV_API void glevVertex2dv(glev_context* context, const glev_double* v);
GLEV_API void glevVertex3f(glev_context* context, glev_float x, glev_float y, glev_float z);
GLEV_API void glevVertex3d(glev_context* context, glev_double x, glev_double y, glev_double z);
GLEV_API void glevVertex3fv(glev_context* context, const glev_float* v);
GLEV_API void glevVertex3dv(glev_context* context, const glev_double* v);
GLEV_API void glevVertex4f(glev_context* context, glev_float x, glev_float y, glev_float z, glev_float w);
GLEV_API void glevVertex4d(glev_context* context, glev_double x, glev_double y, glev_double z, glev_double w);
GLEV_API void glevVertex4fv(glev_context* context, const glev_float* v);
GLEV_API void glevVertex4dv(glev_context* context, const glev_double* v);

/* ---- Current values (GL §10.7.2) ---- */

/* Set the current values. Legal anywhere. The d forms round to float; nothing is clamped.
 * INVALID_VALUE: v null. There are no other errors. */

/* alpha is 1 unless given. */
GLEV_API void glevColor3f(glev_context* context, glev_float red, glev_float green, glev_float blue);
GLEV_API void glevColor3d(glev_context* context, glev_double red, glev_double green, glev_double blue);
GLEV_API void glevColor3fv(glev_context* context, const glev_float* v);
GLEV_API void glevColor3dv(glev_context* context, const glev_double* v);
GLEV_API void glevColor4f(glev_context* context, glev_float red, glev_float green, glev_float blue,
                          glev_float alpha);
GLEV_API void glevColor4d(glev_context* context, glev_double red, glev_double green, glev_double blue,
                          glev_double alpha);
GLEV_API void glevColor4fv(glev_context* context, const glev_float* v);
GLEV_API void glevColor4dv(glev_context* context, const glev_double* v);

GLEV_API void glevNormal3f(glev_context* context, glev_float x, glev_float y, glev_float z);
GLEV_API void glevNormal3d(glev_context* context, glev_double x, glev_double y, glev_double z);
GLEV_API void glevNormal3fv(glev_context* context, const glev_float* v);
GLEV_API void glevNormal3dv(glev_context* context, const glev_double* v);

GLEV_API void glevIndexf(glev_context* context, glev_float index);
GLEV_API void glevIndexd(glev_context* context, glev_double index);
GLEV_API void glevIndexfv(glev_context* context, const glev_float* v);
GLEV_API void glevIndexdv(glev_context* context, const glev_double* v);

GLEV_API void glevEdgeFlag(glev_context* context, glev_boolean flag);
GLEV_API void glevEdgeFlagv(glev_context* context, const glev_boolean* v);

/* Set the coordinates of texture unit 0, whichever unit is active. (t, r, q) = (0, 0, 1) unless given. */
GLEV_API void glevTexCoord1f(glev_context* context, glev_float s);
GLEV_API void glevTexCoord1d(glev_context* context, glev_double s);
GLEV_API void glevTexCoord1fv(glev_context* context, const glev_float* v);
GLEV_API void glevTexCoord1dv(glev_context* context, const glev_double* v);
GLEV_API void glevTexCoord2f(glev_context* context, glev_float s, glev_float t);
GLEV_API void glevTexCoord2d(glev_context* context, glev_double s, glev_double t);
GLEV_API void glevTexCoord2fv(glev_context* context, const glev_float* v);
GLEV_API void glevTexCoord2dv(glev_context* context, const glev_double* v);
GLEV_API void glevTexCoord3f(glev_context* context, glev_float s, glev_float t, glev_float r);
GLEV_API void glevTexCoord3d(glev_context* context, glev_double s, glev_double t, glev_double r);
GLEV_API void glevTexCoord3fv(glev_context* context, const glev_float* v);
GLEV_API void glevTexCoord3dv(glev_context* context, const glev_double* v);
GLEV_API void glevTexCoord4f(glev_context* context, glev_float s, glev_float t, glev_float r, glev_float q);
GLEV_API void glevTexCoord4d(glev_context* context, glev_double s, glev_double t, glev_double r,
                             glev_double q);
GLEV_API void glevTexCoord4fv(glev_context* context, const glev_float* v);
GLEV_API void glevTexCoord4dv(glev_context* context, const glev_double* v);

/* texture: TEXTURE0 to TEXTURE0 + 7. INVALID_ENUM: anything else. */
GLEV_API void glevMultiTexCoord1f(glev_context* context, glev_enum texture, glev_float s);
GLEV_API void glevMultiTexCoord1d(glev_context* context, glev_enum texture, glev_double s);
GLEV_API void glevMultiTexCoord1fv(glev_context* context, glev_enum texture, const glev_float* v);
GLEV_API void glevMultiTexCoord1dv(glev_context* context, glev_enum texture, const glev_double* v);
GLEV_API void glevMultiTexCoord2f(glev_context* context, glev_enum texture, glev_float s, glev_float t);
GLEV_API void glevMultiTexCoord2d(glev_context* context, glev_enum texture, glev_double s, glev_double t);
GLEV_API void glevMultiTexCoord2fv(glev_context* context, glev_enum texture, const glev_float* v);
GLEV_API void glevMultiTexCoord2dv(glev_context* context, glev_enum texture, const glev_double* v);
GLEV_API void glevMultiTexCoord3f(glev_context* context, glev_enum texture, glev_float s, glev_float t,
                                  glev_float r);
GLEV_API void glevMultiTexCoord3d(glev_context* context, glev_enum texture, glev_double s, glev_double t,
                                  glev_double r);
GLEV_API void glevMultiTexCoord3fv(glev_context* context, glev_enum texture, const glev_float* v);
GLEV_API void glevMultiTexCoord3dv(glev_context* context, glev_enum texture, const glev_double* v);
GLEV_API void glevMultiTexCoord4f(glev_context* context, glev_enum texture, glev_float s, glev_float t,
                                  glev_float r, glev_float q);
GLEV_API void glevMultiTexCoord4d(glev_context* context, glev_enum texture, glev_double s, glev_double t,
                                  glev_double r, glev_double q);
GLEV_API void glevMultiTexCoord4fv(glev_context* context, glev_enum texture, const glev_float* v);
GLEV_API void glevMultiTexCoord4dv(glev_context* context, glev_enum texture, const glev_double* v);

/* Selects the unit whose coordinates CURRENT_TEXTURE_COORDS returns. Map1 and Map2 require TEXTURE0.
 * INVALID_ENUM: not TEXTURE0 to TEXTURE0 + 7. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevActiveTexture(glev_context* context, glev_enum texture);

/* ---- Display lists (GL §21.4) ---- */

/* A list is a sequence of commands with a name, a number above 0. Contexts do not share lists.
 *
 * Between NewList and EndList, these commands are compiled into the list: Map, MapGrid, EvalCoord, EvalPoint,
 * EvalMesh, Enable, Disable, Begin, End, Vertex, the commands that set current values, ActiveTexture,
 * PushAttrib, PopAttrib, CallList, CallLists and ListBase. In mode COMPILE_AND_EXECUTE they are executed as
 * well. All other commands, such as queries, are executed at once and are not part of the list. Memory behind
 * pointers is read when the command is compiled and never again. Everything else happens at execution: the
 * command uses the maps, enables, grids, active texture, list base and Begin/End of that time, and records
 * its errors then. A command with an error does not end the list. Executing a list allocates no more memory
 * than executing its commands one by one.
 *   A list may call other lists and itself. At most MAX_LIST_NESTING (64) lists execute at once; further
 * calls have no effect. Begin and End may be in different lists or outside of lists. Callbacks of the sink
 * are part of the command that calls them: their commands are executed, but not compiled into the open list.
 */

/* Opens a list. EndList gives it the name `list`; until then the name keeps its previous meaning.
 * INVALID_VALUE: list is 0.
 * INVALID_ENUM: mode is not COMPILE or COMPILE_AND_EXECUTE.
 * INVALID_OPERATION: a list is open; between Begin and End; from a callback of the sink. */
GLEV_API void glevNewList(glev_context* context, glev_uint list, glev_enum mode);

/* Closes the open list and gives it its name. Replaces an earlier list with this name.
 * INVALID_OPERATION: no list is open; between Begin and End, also if the Begin was executed by this list's
 *   COMPILE_AND_EXECUTE: the list remains open; from a callback of the sink.
 * OUT_OF_MEMORY: there was no memory for a command (which recorded this error, and after which nothing was
 *   compiled), or there is none for the name. The list is closed and discarded, and the name keeps its
 *   previous meaning. */
GLEV_API void glevEndList(glev_context* context);

/* Executes a list; a name without a list is ignored. Legal anywhere. Between Begin and End, commands of the
 * list that are not allowed there record their errors. */
GLEV_API void glevCallList(glev_context* context, glev_uint list);

/* Calls CallList(LIST_BASE + offset) for each of n offsets at `lists`. The sum is modulo 2^32, with the list
 * base at the time of execution. type: BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, INT, UNSIGNED_INT, FLOAT
 * (rounded down), 2_BYTES, 3_BYTES, 4_BYTES (unsigned, most significant byte first). No alignment is
 * required.
 * INVALID_VALUE: n < 0; lists null unless n is 0.
 * INVALID_ENUM: another type. */
GLEV_API void glevCallLists(glev_context* context, glev_int n, glev_enum type, const void* lists);

/* Sets the list base, initially 0. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevListBase(glev_context* context, glev_uint base);

/* Makes empty lists with `range` consecutive unused names and returns the first name. Returns 0 on error, if
 * range is 0, or if there is no such range of names. The name of the open list counts as used.
 * INVALID_VALUE: range < 0.
 * INVALID_OPERATION: between Begin and End; from a callback of the sink.
 * OUT_OF_MEMORY: nothing changed. */
GLEV_API glev_uint glevGenLists(glev_context* context, glev_int range);

/* Returns TRUE if there is a list of that name, even if it is empty. Returns FALSE on error.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API glev_boolean glevIsList(glev_context* context, glev_uint list);

/* Deletes the lists among the `range` names from `list` on; other names are ignored.
 * INVALID_VALUE: range < 0.
 * INVALID_OPERATION: between Begin and End; from a callback of the sink, so that no list is deleted while it
 *   executes.
 * OUT_OF_MEMORY: nothing changed; only if the names lie inside a range of GenLists that has not been filled.
 */
GLEV_API void glevDeleteLists(glev_context* context, glev_uint list, glev_int range);

/* ---- Attribute stack (GL §21.6) ---- */

/* PushAttrib saves groups of state, PopAttrib restores those that the matching PushAttrib saved:
 *   EVAL_BIT: the 18 map enables, AUTO_NORMAL, both grids.
 *   ENABLE_BIT: the 18 map enables and AUTO_NORMAL.
 *   CURRENT_BIT: colour, index, normal, texture coordinates of all units, edge flag.
 *   TEXTURE_BIT: the active texture.
 *   LIST_BIT: the list base.
 * Maps belong to no group. Other bits have no effect and are not an error. Neither command allocates memory.
 * STACK_OVERFLOW: PushAttrib on a stack of MAX_ATTRIB_STACK_DEPTH (16) entries.
 * STACK_UNDERFLOW: PopAttrib on an empty stack.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevPushAttrib(glev_context* context, glev_bitfield mask);
GLEV_API void glevPopAttrib(glev_context* context);

/* ---- Flush and Finish (GL §2.3.2, §2.3.3) ---- */

/* Have no effect, because nothing is ever buffered. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevFlush(glev_context* context);
GLEV_API void glevFinish(glev_context* context);

/* ---- Queries (GL §2.2.2, §22) ---- */

/* Write the value of a state variable to v. pname, with the number of values:
 *   one of the 18 map enables [1], AUTO_NORMAL [1], MAX_EVAL_ORDER [1], MAP1_GRID_DOMAIN [2: u1, u2],
 *   MAP1_GRID_SEGMENTS [1], MAP2_GRID_DOMAIN [4: u1, u2, v1, v2], MAP2_GRID_SEGMENTS [2: un, vn],
 *   CURRENT_COLOR [4], CURRENT_INDEX [1], CURRENT_NORMAL [3], CURRENT_TEXTURE_COORDS [4] of the active unit,
 *   EDGE_FLAG [1], ACTIVE_TEXTURE [1], MAX_TEXTURE_COORDS [1], MAX_TEXTURE_UNITS [1], LIST_BASE [1],
 *   LIST_INDEX [1: name of the open list, or 0], LIST_MODE [1: its mode, or 0], MAX_LIST_NESTING [1],
 *   ATTRIB_STACK_DEPTH [1], MAX_ATTRIB_STACK_DEPTH [1].
 * Conversions: booleans become 0 or 1; numbers become TRUE unless they are zero; reals become the nearest
 *   integer (halves away from zero, saturated, NaN gives 0); colours and normals become integers by
 *   round(clamp(c, -1, 1) * (2^31 - 1)). Nothing is written on error.
 * INVALID_ENUM: any other pname.
 * INVALID_VALUE: v null.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevGetBooleanv(glev_context* context, glev_enum pname, glev_boolean* v);
GLEV_API void glevGetIntegerv(glev_context* context, glev_enum pname, glev_int* v);
GLEV_API void glevGetFloatv(glev_context* context, glev_enum pname, glev_float* v);
GLEV_API void glevGetDoublev(glev_context* context, glev_enum pname, glev_double* v);

/* Returns the string VENDOR, RENDERER or VERSION, which has static lifetime; null on error. VERSION begins
 * with "4.6 ", because the evaluator semantics are those of OpenGL 4.6, compatibility profile.
 * INVALID_ENUM: any other name. INVALID_OPERATION: between Begin and End. */
GLEV_API const glev_ubyte* glevGetString(glev_context* context, glev_enum name);

/* ---- Plans ---- */

/* A plan is an immutable snapshot of the state that evaluation needs: the enabled maps of one dimension that
 * have precedence, AUTO_NORMAL, and the grid. Later changes of the context do not affect it, and it may
 * outlive the context. Plans are reference-counted: each creation and each retain needs one release.
 * Evaluation never allocates memory. All functions of plans may be called from any thread. */

typedef struct glev_plan_info {
  size_t size;
  size_t dimension; /* 1: the MAP1 maps, 2: the MAP2 maps */
} glev_plan_info;

/* Takes a snapshot of the context; legal between Begin and End, too. *plan is null on failure. If the state
 * has not changed since the last call, returns the same plan with one more reference.
 * Returns SUCCESS, INVALID_ARGUMENT, STRUCTURE_SIZE, UNSUPPORTED (dimension is neither 1 nor 2) or
 * OUT_OF_MEMORY. */
GLEV_API glev_result glevCreatePlan(glev_context* context, const glev_plan_info* info, glev_plan** plan);

GLEV_API void glevRetainPlan(glev_plan* plan);
GLEV_API void glevReleasePlan(glev_plan* plan); /* null is ignored */

/* The attributes of a vertex. TANGENT_U and the attributes after it exist in plans of dimension 2 with a
 * vertex map. They are the first and second derivatives of its components with respect to u and v (of the
 * homogeneous coordinates, not of their quotients). They are correctly rounded as floats, and within one ULP
 * of the exact value as doubles, for all finite maps, domains and arguments. Automatic normals as doubles
 * have the values of the floats. */
typedef enum glev_attribute {
  GLEV_ATTRIBUTE_VERTEX = 0,
  GLEV_ATTRIBUTE_COLOR = 1,
  GLEV_ATTRIBUTE_NORMAL = 2, /* from a normal map, or automatic */
  GLEV_ATTRIBUTE_TEXCOORD = 3,
  GLEV_ATTRIBUTE_TANGENT_U = 4,
  GLEV_ATTRIBUTE_TANGENT_V = 5,
  GLEV_ATTRIBUTE_SECOND_UU = 6, /* d2/du2 */
  GLEV_ATTRIBUTE_SECOND_UV = 7, /* d2/du dv */
  GLEV_ATTRIBUTE_SECOND_VV = 8  /* d2/dv2 */
} glev_attribute;

/* Returns the number of values (1 to 4) of an attribute; 0 if the plan has no map for it or there is no such
 * attribute. */
GLEV_API size_t glevGetPlanComponents(const glev_plan* plan, glev_attribute attribute);

/* ---- Batches ---- */

/* Accuracy of results.
 * CORRECTLY_ROUNDED: results have the bits of EvalCoord and EvalPoint.
 * FAST: for arguments inside the domain, each component of a float result of a map differs from the exact
 *   value V by at most (6 (n + m) + 12) * 2^-24 * max|R|, where n and m are the degrees and max|R|, the
 *   largest magnitude of that component of a control point, is between 2^-80 and 2^80. Otherwise, outside the
 *   domain and on its boundary the result is correctly rounded. So patches that share the control points of
 *   an edge meet there without a crack, whatever their orders, directions, domains and numbers of segments.
 *   Float results of derivatives are those of maps, too: their control points are differences of those of the
 *   vertex map, times n / (u2 - u1) or m / (v2 - v1) for each order.
 * Automatic normals and double results are the same in both. */
typedef enum glev_precision { GLEV_CORRECTLY_ROUNDED = 0, GLEV_FAST = 1 } glev_precision;

/* Destination of one attribute: element i is `components` values at data + i*stride bytes; in a mesh of two
 * dimensions, element (i, j) lies at data + i*stride + j*row_stride, counted from (i1, j1).
 * components: at least glevGetPlanComponents, at most 4 (3 for normals). Missing components are those of
 *   (0,0,0,1), or 0 for derivatives.
 * stride: at least the bytes of the components.
 * data_size: bytes at data that may be written.
 * type: GLEV_FLOAT (0 means the same) or GLEV_DOUBLE.
 * row_stride: meshes of two dimensions and patches only. At least the bytes from the first to the end of
 *   the last element of a row; 0: rows are contiguous.
 * patch_stride: glevEvaluatePatches on a grid only, where element (i, j) of patch p lies at data +
 *   p*patch_stride + j*row_stride + i*stride. At least the bytes from the first to the end of the last
 *   element of a patch; 0: patches are contiguous.
 * No alignment is required. Bytes between elements are not written, so attributes may be interleaved.
 * Double results of maps are within one ULP of V, for all finite maps, domains and arguments. */
typedef struct glev_output {
  size_t size;
  void* data;
  size_t data_size;
  size_t stride;
  size_t components;
  glev_enum type;
  size_t row_stride;
  size_t patch_stride;
} glev_output;

/* One output of a batch or a mesh. Attributes without an output are not computed. Two outputs of the same
 * attribute, or a value that is not a glev_attribute, are an INVALID_ARGUMENT. */
typedef struct glev_attribute_output {
  glev_attribute attribute;
  const glev_output* output;
} glev_attribute_output;

/* An array of arguments: argument i is at data + i*stride bytes. Any stride is legal, including 0. data_size:
 * bytes at data that may be read. */
typedef struct glev_input {
  const void* data;
  size_t data_size;
  size_t stride;
} glev_input;

/* A batch of `count` arguments u, or (u, v), of type `type` (GLEV_FLOAT or GLEV_DOUBLE). v: for plans of
 * dimension 2; all members must be zero for dimension 1. */
typedef struct glev_batch {
  size_t size;
  size_t count;
  glev_enum type;
  glev_precision precision;
  glev_input u;
  glev_input v;
  const glev_attribute_output* outputs; /* null if output_count is 0 */
  size_t output_count;
} glev_batch;

/* Evaluates the maps of a plan at each argument. Unlike in the GL, other maps do not need a vertex map. All
 * arguments are checked before anything is written. If count is 0, nothing is read or written, and all data
 * may be null. A batch without outputs is legal, writes nothing, and is checked like any other.
 * Returns SUCCESS or
 * INVALID_ARGUMENT: a null pointer, a wrong type, stride, precision or number of components.
 * STRUCTURE_SIZE: the size of the batch or of an output.
 * NO_MAP: an output for an attribute without a map.
 * BUFFER_TOO_SMALL: a data_size.
 * OVERLAP: bytes of an output belong to another output or to an input as well. Interleaving in one block is
 *   recognised if the strides are equal; with different strides the blocks must not overlap. */
GLEV_API glev_result glevEvaluate(const glev_plan* plan, const glev_batch* batch);

/* The points (i, j) of the grid of a plan, i1 <= i <= i2 and j1 <= j <= j2. For plans of dimension 1, j1 and
 * j2 must be 0. Any index is legal, as in EvalMesh. If i1 > i2 or j1 > j2, there are no points.
 * scratch: scratch_size bytes of the caller, at least glevGetMeshScratchSize. Contents and alignment do not
 *   matter. Concurrent calls need different scratch memory. */
typedef struct glev_mesh {
  size_t size;
  glev_int i1, i2, j1, j2;
  glev_precision precision;
  const glev_attribute_output* outputs; /* null if output_count is 0 */
  size_t output_count;
  void* scratch;
  size_t scratch_size;
} glev_mesh;

/* Returns the bytes of scratch memory that glevEvaluateMesh needs for the columns i1 to i2 of this mesh. The
 * result is positive for every legal mesh, even without points. It is 0 if glevEvaluateMesh would return
 * INVALID_ARGUMENT because the plan or the mesh is null, the precision is wrong, or j1 or j2 is not 0 in one
 * dimension, or STRUCTURE_SIZE because of the mesh. The outputs, output_count, scratch and scratch_size of
 * the mesh are ignored. */
GLEV_API size_t glevGetMeshScratchSize(const glev_plan* plan, const glev_mesh* mesh);

/* Evaluates the maps of a plan at points of its grid. Values, checks and results are those of glevEvaluate;
 * scratch counts as an output. */
GLEV_API glev_result glevEvaluateMesh(const glev_plan* plan, const glev_mesh* mesh);

/* ---- Patches ---- */

/* An array of `count` Bezier patches, tensor products of Bernstein polynomials with uorder * vorder control
 * points of `components` values each. Control point (i, j) of patch p begins p*patch_stride + i*u_stride +
 * j*v_stride bytes after `points`, i in the direction of u. Curves are patches with vorder 1.
 * components: 1 to 4. uorder, vorder: 1 to 64.
 * type: of the control points, GLEV_FLOAT or GLEV_DOUBLE.
 * points_size: bytes at points that may be read. No alignment is required.
 * v_stride, u_stride, patch_stride: any values, so control points may share memory. 0 means control points,
 *   rows and patches without padding, v fastest: float points[count][uorder][vorder][components].
 * u1, u2, v1, v2: the domain of all patches. u1 = u2 = 0 means 0 to 1, and so does v1 = v2 = 0. Other equal
 *   ends are invalid, as in Map2. */
typedef struct glev_patches {
  size_t size;
  size_t count;
  size_t components;
  glev_int uorder, vorder;
  glev_enum type;
  const void* points;
  size_t points_size;
  size_t u_stride, v_stride, patch_stride;
  glev_double u1, u2, v1, v2;
} glev_patches;

/* The kinds of grids.
 * UNIFORM: each patch at (u_segments + 1) * (v_segments + 1) points, those of MapGrid2d(u_segments, u1, u2,
 *   v_segments, v1, v2) with the ends of the domain. A direction of 0 segments has one point, the first end.
 * LISTS: each patch at u_count * v_count points, (u[i], v[j]).
 * SCATTERED: u_count points; point i is the point of patch number patch[i] at (u[i], v[i]). Consecutive
 *   points of the same patch take less time.
 * EDGES: the points of UNIFORM that are not on the boundary, and edges with numbers of segments of their own,
 *   so that patches meet without cracks although they have different u_segments and v_segments. Each patch
 *   has one row of points: first the inner ones, (u_segments - 1) * (v_segments - 1), numbered along u first.
 *   Then once around, in the order of edge_segments and each edge without its last point, the edges v = v1
 *   from u1 to u2, u = u2 from v1 to v2, v = v2 from u2 to u1, and u = u1 from v2 to v1. The points divide an
 *   edge into equal segments. Edges with the same control points and numbers of segments have vertices of
 *   equal bits, whatever the direction of the edge, the order of the patch across the edge, and the position
 *   of the edge in the patch. */
typedef enum glev_grid_kind {
  GLEV_GRID_UNIFORM = 0,
  GLEV_GRID_LISTS = 1,
  GLEV_GRID_SCATTERED = 2,
  GLEV_GRID_EDGES = 3
} glev_grid_kind;

/* The arguments at which patches are evaluated. Members that the kind of grid does not use must be zero.
 * u_segments, v_segments: UNIFORM, 0 or more; EDGES, 2 or more.
 * u_count: LISTS and SCATTERED. v_count: LISTS only.
 * type: LISTS and SCATTERED: type of the arguments u and v, GLEV_FLOAT or GLEV_DOUBLE.
 * v: LISTS and SCATTERED. It has no effect on curves, for which it may be all zero; v_count 0 then means one
 *   row.
 * limit_normals: if not FALSE, normals on edges of the domain that are a single point, such as poles, are
 *   limits instead of (0,0,0). If all control points of the edge are equal, NORMAL is its limit from inside
 *   the patch, computed in double from derivatives of second order; (0,0,0) if these do not determine the
 *   limit. Let Q be the derivative across the edge, multiplied by w^2 for 4 components as in EvalCoord, and
 *   Q' its derivative along the edge. Each component is within 2^-25 + 2^-30 of the exact limit if
 *   |Q' x Q| is at least 2^-12 of the same expression of the largest magnitudes of their control points, for
 *   magnitudes as in EvalCoord. The control points of Q' count as twice those of Q, times the degree.
 * patch: SCATTERED only; patch numbers of type glev_uint.
 * target: a name from glevGetTargetName; null: the best one.
 * edge_segments: EDGES only, 1 or more. */
typedef struct glev_patch_grid {
  size_t size;
  glev_grid_kind kind;
  glev_precision precision;
  glev_int u_segments, v_segments;
  size_t u_count, v_count;
  glev_enum type;
  glev_boolean limit_normals;
  glev_input u, v, patch;
  const char* target;
  glev_int edge_segments[4]; /* of the edges v = v1, u = u2, v = v2, u = u1 */
} glev_patch_grid;

/* Evaluates an array of patches. The attributes are VERTEX, the values of the patches; TANGENT_U to
 * SECOND_VV, their derivatives; and, for 3 or 4 components, NORMAL, the automatic normals. Without
 * limit_normals, a normal is (0,0,0) if a tangent is zero, as for curves.
 * All results have the bits of MAP2 maps of the same control points: for UNIFORM and EDGES those of
 * glevEvaluateMesh, otherwise those of glevEvaluate. Double results of curves in LISTS and SCATTERED are
 * those of MAP1 maps. Results do not depend on strides, other patches and, except for GLEV_FAST, the
 * instruction set.
 * UNIFORM and LISTS: element (i, j) of an output, i along u, lies at data + p*patch_stride + j*row_stride +
 *   i*stride. EDGES: there is one row. SCATTERED: element i lies at data + i*stride.
 * scratch: scratch_size bytes of the caller, at least glevGetPatchScratchSize. Contents and alignment do not
 *   matter. No memory is allocated. Concurrent calls need different scratch memory.
 * All arguments are checked before anything is written. Without patches or points, nothing is read or
 * written, and points, arguments, data and scratch may be null; points of SCATTERED without patches are an
 * INVALID_ARGUMENT.
 * Returns SUCCESS or
 * INVALID_ARGUMENT: a null pointer; a wrong type, order, number of components, stride of an output, domain,
 *   kind, precision, number of segments or target; a member that must be zero; a patch number that is not
 *   below count; two outputs of one attribute.
 * STRUCTURE_SIZE: the size of the patches, the grid or an output.
 * NO_MAP: NORMAL of fewer than 3 components, COLOR and TEXCOORD.
 * BUFFER_TOO_SMALL: points_size, a data_size or scratch_size.
 * OVERLAP: bytes of an output belong to another output, the scratch, the control points or the arguments as
 *   well. Interleaving is recognised as by glevEvaluate. */
GLEV_API glev_result glevEvaluatePatches(const glev_patches* patches, const glev_patch_grid* grid,
                                         const glev_attribute_output* outputs, size_t output_count,
                                         void* scratch, size_t scratch_size);

/* Returns the bytes of scratch memory that glevEvaluatePatches needs for these patches and this grid. They do
 * not depend on the outputs and the number of patches. Returns 0 if glevEvaluatePatches would return
 * INVALID_ARGUMENT or STRUCTURE_SIZE because of `patches` or `grid`; points, data and data_size may still be
 * missing. */
GLEV_API size_t glevGetPatchScratchSize(const glev_patches* patches, const glev_patch_grid* grid);

/* One map for a plan without a context: the state that Map1 or Map2, MapGrid and Enable set.
 * target: one of the 18 map names except MAP1_INDEX and MAP2_INDEX.
 * map: one patch (count 1) with the number of components of the target; vorder 1 for MAP1 names. It is
 *   copied.
 * u_segments, v_segments: segments of the grid, which spans the domain; 0 means 1. v_segments must be 0 for
 *   MAP1 names.
 * auto_normal: if not FALSE, MAP2_VERTEX maps have automatic normals. */
typedef struct glev_map_info {
  size_t size;
  glev_enum target;
  const glev_patches* map;
  glev_int u_segments, v_segments;
  glev_boolean auto_normal;
  const glev_allocator* allocator; /* copied; null: the heap */
  const char* instruction_set;     /* a name from glevGetTargetName; null: the best one */
} glev_map_info;

/* Makes a plan of one map, with one reference. It has the results of a plan of a context with this map. *plan
 * is null on failure.
 * Returns SUCCESS, INVALID_ARGUMENT, STRUCTURE_SIZE (of the info, the map or the allocator), BUFFER_TOO_SMALL
 * (points_size) or OUT_OF_MEMORY. */
GLEV_API glev_result glevCreatePlanFromMap(const glev_map_info* info, glev_plan** plan);

/* ---- Indices ---- */

/* Front faces, as in glFrontFace. */
#define GLEV_CW 0x0900
#define GLEV_CCW 0x0901

/* The primitives of meshes of columns * rows vertices, numbered along u first, for glDrawElements and
 * vkCmdDrawIndexed.
 * mode: the primitives.
 *   POINT: POINTS, in the order of EvalMesh2.
 *   LINE: LINES, first those along u, then those along v, each as EvalMesh draws it.
 *   FILL: TRIANGLES, two for each quadrilateral of the QUAD_STRIPs of EvalMesh2, (i,j) (i,j+1) (i+1,j) and
 *     (i+1,j) (i,j+1) (i+1,j+1), with the same front face.
 *   TRIANGLE_STRIP: the triangles of FILL as TRIANGLE_STRIPs: those of EvalMesh2, or strips along v if
 *     winding is GLEV_CCW. The largest number of the type separates two strips, as
 *     PRIMITIVE_RESTART_FIXED_INDEX and primitiveRestartEnable of Vulkan expect. No vertex may have this
 *     number.
 *   A mesh of dimension 1 has rows = 1, and no FILL or TRIANGLE_STRIP.
 * patches: number of meshes; 0 means 1. Their vertices are contiguous, as glevEvaluatePatches writes them,
 *   and so are their primitives.
 * winding: winding of triangles as seen from the side to which automatic normals point. GLEV_CW (0 means the
 *   same) is that of EvalMesh2; GLEV_CCW swaps the second and third vertex of each triangle.
 * vertices: if not null, vertices with equal bits are shared: each index is that of the first vertex, among
 *   those of all patches, whose vertex_bytes bytes are equal. Vertex number i is at vertices +
 *   i*vertex_stride; vertices_size bytes may be read. Vertices are not moved, even if no index refers to
 *   them.
 * scratch: needed to share vertices: scratch_size bytes, at least glevGetIndexScratchSize. Contents and
 *   alignment do not matter.
 * edge_segments: the member of the same name of glev_patch_grid if the vertices are those of GLEV_GRID_EDGES;
 *   columns and rows are then u_segments + 1 and v_segments + 1, and mode is FILL. The first triangles are
 *   those of the grid of inner vertices. All four are 0 for other grids. */
typedef struct glev_indices {
  size_t size;
  glev_enum mode;
  size_t columns, rows;
  size_t first;   /* number of the first vertex */
  glev_enum type; /* GLEV_UNSIGNED_BYTE, GLEV_UNSIGNED_SHORT or GLEV_UNSIGNED_INT */
  void* data;
  size_t data_size;
  size_t patches;
  glev_enum winding;
  const void* vertices; /* null: no vertices are shared */
  size_t vertices_size, vertex_stride, vertex_bytes;
  void* scratch;
  size_t scratch_size;
  glev_int edge_segments[4];
} glev_indices;

/* Returns the number of indices; 0 if glevGetIndices rejects the arguments. Ignores data and scratch. */
GLEV_API size_t glevGetIndexCount(const glev_indices* indices);

/* Returns the bytes of scratch memory that glevGetIndices needs to share vertices, 8 to 20 for each vertex; 0
 * if vertices is null or glevGetIndexCount returns 0. */
GLEV_API size_t glevGetIndexScratchSize(const glev_indices* indices);

/* Writes the indices without gaps. Data, vertices and scratch must not overlap; this is not checked.
 * Returns SUCCESS or
 * INVALID_ARGUMENT: a null pointer; a wrong mode, type, winding or edge_segments; fewer than 3 columns or
 *   rows with edge_segments; a vertex whose number the type cannot hold; vertex_bytes that are 0 or more
 *   than vertex_stride; 2^32 vertices or more to share.
 * STRUCTURE_SIZE: the size of the structure.
 * BUFFER_TOO_SMALL: data_size, vertices_size or scratch_size. */
GLEV_API glev_result glevGetIndices(const glev_indices* indices);

#ifdef __cplusplus
}
#endif

#endif /* GLEVALUATOR_H_ */
