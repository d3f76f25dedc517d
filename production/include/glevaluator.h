/* glevaluator: the evaluators of OpenGL as a library that needs no GL.
 *
 * Three ways to use it:
 *
 *   1. The GL commands. A glev_context holds evaluator state and current values; the calls are the GL's
 *      with the prefix glev and the context as first argument, and behave as GL 4.6 (compatibility
 *      profile) says, errors included. Vertices come out through a sink: three callbacks.
 *   2. Batches. A glev_plan is an immutable snapshot of what the enabled maps of a context evaluate to;
 *      glevEvaluate runs arrays of arguments, glevEvaluateMesh points of the grid through it into memory of
 *      the caller, glevGetIndices says how these make primitives.
 *   3. Patches. glevEvaluatePatches evaluates an array of Bezier patches or curves in one call, without a
 *      context; glevCreatePlanFromMap makes a plan of one map.
 *
 * Conventions
 *   - C99 and C++. No globals: everything hangs on a context or a plan.
 *   - A context belongs to one thread at a time. A plan may be used by any number of threads at once.
 *   - A null context or plan is undefined behaviour, as in any call of a method, except that DestroyContext
 *     and ReleasePlan ignore it, Evaluate and EvaluateMesh return INVALID_ARGUMENT, and GetMeshScratchSize
 *     returns 0. Any other pointer that is null where this is not allowed is an error: GL-named calls record
 *     INVALID_VALUE (the GL leaves null undefined), the others return GLEV_ERROR_INVALID_ARGUMENT.
 *   - Infinities and NaN are legal control points, domain ends, grid ends and arguments, and no error by
 *     themselves. A component of a result that depends on one is unspecified: any float, infinity or NaN. A
 *     component of a control point has no influence on the other components.
 *   - Structures grow, and programs that were compiled with an earlier header keep working:
 *       - A structure that begins with `size` may get more members at its end. Set `size` to sizeof of the
 *         structure. The library reads `size` bytes and takes members beyond as zero, which means what the
 *         library did before it had them. A structure larger than the library knows is accepted if the
 *         unknown rest is zero, and INVALID_ARGUMENT otherwise.
 *       - Such a structure is passed by pointer and is never a member or an array element of another one.
 *       - glev_input and glev_attribute_output have no `size` and never change.
 *       - A sink gets a glev_vertex whose `size` is the library's: members beyond it do not exist.
 *       - Members keep their offsets, enumerators and tokens their values, and functions their signatures.
 *   - Counts and byte strides are size_t; what GL types as GLint or GLenum keeps GL's type.
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
 * The values are the GL's own, so GL_MAP1_VERTEX_3 and GLEV_MAP1_VERTEX_3 are interchangeable. They are
 * here for programs that have no GL header. */

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

/* Attribute groups: those of which this library has state. */
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

/* Texture units with a current texture coordinate: what MAX_TEXTURE_COORDS answers. */
#define GLEV_TEXTURE_UNITS 8

/* ---- Results of the calls that are not the GL's ---- */

typedef enum glev_result {
  GLEV_SUCCESS = 0,
  GLEV_ERROR_INVALID_ARGUMENT = 1, /* null where that is not allowed, bad size, token, stride or count */
  GLEV_ERROR_UNSUPPORTED = 2,      /* well formed, but not in this version of the library */
  GLEV_ERROR_OUT_OF_MEMORY = 3,
  GLEV_ERROR_IN_PRIMITIVE = 4,     /* not between Begin and End */
  GLEV_ERROR_NO_MAP = 5,           /* the plan has no map for an attribute that was asked for */
  GLEV_ERROR_BUFFER_TOO_SMALL = 6, /* count elements do not fit into the bytes given */
  GLEV_ERROR_OVERLAP = 7           /* two outputs, or an output and the input, share bytes */
} glev_result;

/* ---- Memory ---- */

/* Source of memory for a context and its plans. allocate returns null when there is none; the alignment is a
 * power of two. release gets the bytes and alignment that allocate got. Both may be called by any thread that
 * releases a plan, so they must be safe for that; user must outlive every plan. */
typedef struct glev_allocator {
  size_t size;
  void* user;
  void* (*allocate)(void* user, size_t bytes, size_t alignment);
  void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
} glev_allocator;

/* ---- Contexts ---- */

typedef struct glev_context_info {
  size_t size;
  const glev_allocator* allocator; /* copied; null for the heap */
  const char* target;              /* one of glevGetTargetName; null for the best */
} glev_context_info;

/* The names of the instruction sets ("AVX2" and the like) that this library can use on this machine, best
 * first; null for an index beyond the last. A context and its plans use one of them. Correctly rounded
 * results do not depend on which. */
GLEV_API const char* glevGetTargetName(size_t index);

/* Makes a context in the GL's initial state (GL §21.1 last paragraph, tables 23.4, 23.40): every map
 * disabled, of order 1 over (0,1) with GL's initial control point, AUTO_NORMAL off, grids of one segment over
 * (0,1), current colour (1,1,1,1), index 1, normal (0,0,1), texture coordinates (0,0,0,1), edge flag TRUE.
 * info: null for the defaults. *context is null on failure.
 * Returns SUCCESS, INVALID_ARGUMENT (also for an unknown target) or OUT_OF_MEMORY. */
GLEV_API glev_result glevCreateContext(const glev_context_info* info, glev_context** context);

/* Frees the context; null is ignored. Its plans live on. Not from within a callback of its sink. */
GLEV_API void glevDestroyContext(glev_context* context);

/* ---- Sink: where vertices go ---- */

/* One vertex with everything current at it. Not transformed, not lit, not clamped. */
typedef struct glev_vertex {
  size_t size;
  glev_float position[4]; /* x, y, z, w */
  glev_float color[4];    /* R, G, B, A */
  glev_float normal[3];
  glev_float texcoord[GLEV_TEXTURE_UNITS][4]; /* s, t, r, q of each unit; maps feed unit 0 */
  glev_float index; /* colour index: always the current one, since RGBA mode ignores INDEX maps */
  glev_boolean edge_flag;
} glev_vertex;

/* A callback that is null is not called. The vertex is valid during the call only. A callback may call the
 * context's commands that are legal between Begin and End, but EvalCoord, EvalPoint and Vertex call the sink
 * again, as CallList may. Each primitive of a mesh has its own begin and end; End from within them is an
 * INVALID_OPERATION. */
typedef struct glev_sink {
  size_t size;
  void* user;
  void (*begin)(void* user, glev_enum mode);
  void (*vertex)(void* user, const glev_vertex* vertex);
  void (*end)(void* user);
} glev_sink;

/* Sets the sink, by copy; null for none (the initial state), vertices are then lost.
 * Returns SUCCESS, INVALID_ARGUMENT, or IN_PRIMITIVE between Begin and End. */
GLEV_API glev_result glevSetSink(glev_context* context, const glev_sink* sink);

/* ---- Errors ---- */

/* The first error since the last call, which it clears, or NO_ERROR (GL §2.3.1). Between Begin and End it
 * returns 0 and records INVALID_OPERATION. A command that records an error has no other effect. Errors that
 * depend on arguments alone come before those that depend on state. */
GLEV_API glev_enum glevGetError(glev_context* context);

/* ---- Maps (GL §21.1) ---- */

/* Defines the one-dimensional map `target` over [u1,u2] by `order` control points; control point i begins
 * i*stride values (not bytes) after `points`. Everything is copied before the call returns and kept as
 * double, values of the f form exactly as given. u1 > u2 is legal.
 * INVALID_ENUM: target is not one of the nine MAP1 names.
 * INVALID_VALUE: order < 1, order > MAX_EVAL_ORDER (64), stride < number of values of a control point,
 *   u1 = u2 (infinities of one sign are equal, NaN is equal to nothing), points null.
 * INVALID_OPERATION: between Begin and End; ACTIVE_TEXTURE is not TEXTURE0.
 * OUT_OF_MEMORY: nothing changed. */
GLEV_API void glevMap1f(glev_context* context, glev_enum target, glev_float u1, glev_float u2,
                        glev_int stride, glev_int order, const glev_float* points);
GLEV_API void glevMap1d(glev_context* context, glev_enum target, glev_double u1, glev_double u2,
                        glev_int stride, glev_int order, const glev_double* points);

/* Defines the two-dimensional map `target` over [u1,u2] x [v1,v2] by uorder * vorder control points; control
 * point (i,j), i in the direction of u, begins i*ustride + j*vstride values (not bytes) after `points`. The
 * strides are independent: either may be the larger one, and points may share memory. Everything is copied
 * before the call returns and kept as double, values of the f form exactly as given. u1 > u2 and v1 > v2 are
 * legal.
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

/* query ORDER: one value (MAP2: uorder, vorder).
 * query DOMAIN: u1, u2 (MAP2: u1, u2, v1, v2).
 * query COEFF: the control points without padding, `order` of them (MAP2: uorder * vorder, v fastest).
 * Converted as GL §2.2.2 says: integers are rounded to nearest (halves away from zero), too large values
 * become the nearest representable, NaN becomes 0; colours and normals are rounded as well. Nothing else is
 * written, and nothing at all on error.
 * INVALID_ENUM: target is not one of the 18 names, query is not one of the three.
 * INVALID_VALUE: v null.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevGetMapdv(glev_context* context, glev_enum target, glev_enum query, glev_double* v);
GLEV_API void glevGetMapfv(glev_context* context, glev_enum target, glev_enum query, glev_float* v);
GLEV_API void glevGetMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int* v);

/* GetMap for an array of buf_size bytes at v: what does not fit is an error, and nothing is written (GL
 * §21.1.1). INVALID_ENUM, INVALID_VALUE, INVALID_OPERATION: as for GetMap, and INVALID_VALUE: buf_size < 0.
 * INVALID_OPERATION: the answer has more than buf_size bytes. */
GLEV_API void glevGetnMapdv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_double* v);
GLEV_API void glevGetnMapfv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_float* v);
GLEV_API void glevGetnMapiv(glev_context* context, glev_enum target, glev_enum query, glev_int buf_size,
                            glev_int* v);

/* The 18 map enables and AUTO_NORMAL. INVALID_ENUM: any other name (this library has evaluator state only).
 * INVALID_OPERATION: between Begin and End; IsEnabled returns FALSE on error. */
GLEV_API void glevEnable(glev_context* context, glev_enum cap);
GLEV_API void glevDisable(glev_context* context, glev_enum cap);
GLEV_API glev_boolean glevIsEnabled(glev_context* context, glev_enum cap);

/* Evaluates the enabled MAP1 maps at u (EvalCoord2: the enabled MAP2 maps at (u,v)) and emits a vertex, as if
 * Color4, Normal3, TexCoord and then Vertex had been issued, but the current values stay as they were.
 * VERTEX_4 wins over VERTEX_3, and the TEXTURE_COORD map with most values over the others; missing values are
 * (0,0,0,1)'s. What has no enabled map comes from the current values. With no vertex map of that dimension
 * enabled nothing at all happens.
 * Each component is correctly rounded: the exact value of the polynomial at the exact argument, rounded once
 * to float, to nearest, ties to even, beyond the range to infinity; the value 0 gives +0, another value that
 * rounds to zero keeps its sign. So it is the control point at an end of the domain, and along an edge of a
 * MAP2 map it has the bits of the MAP1 map of the control points along that edge. Any argument is legal.
 * That takes time without a bound that is small: a component whose value is next to the midpoint of two
 * floats is decided by integers, in microseconds at ordinary orders, but in up to a second for order 64 x 64
 * and doubles of all magnitudes; so in up to four seconds for VERTEX_4. AUTO_NORMAL below is not correctly
 * rounded. Ignored between End and Begin (undefined in the GL).
 * INVALID_VALUE: u null (v forms).
 * OUT_OF_MEMORY: no vertex emitted; only in the first call after a change of maps, enables or the grid.
 *
 * AUTO_NORMAL gives vertices of MAP2 maps the unit normal along q_u x q_v, whatever MAP2_NORMAL says, where q
 * is the winning vertex map (for VERTEX_4 (x,y,z)/w) and the derivatives are by the normalised coordinates:
 * reversing a domain does not turn the normal. Where the product is zero (an edge that is one point, order 1
 * in a direction) or not finite the normal is (0,0,0). There is no vertex shader here, so all others are of
 * unit length. With m the product, multiplied by w^4 for VERTEX_4, and majorants of products of the largest
 * differences of control points (and control points), each component is within 2^-25 + 2^-30 of the exact one
 * inside the domain wherever |m| is at least 2^-50 of its majorant, for magnitudes of control points and
 * differences between 2^-300 and 2^300 or zero; a component that is exactly zero, or cannot be told from zero
 * in double-double, is +0, so below that the normal may be less exact, up to (0,0,0). */
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
 * u2, kept as double. Grid point i stands for the real number u1 + i*(u2 - u1)/n, which is not rounded, and
 * for exactly u1 and u2 at i = 0 and i = n. The ends have nothing to do with the domains of maps; equal ends
 * are legal.
 * INVALID_VALUE: a number of segments <= 0.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevMapGrid1f(glev_context* context, glev_int n, glev_float u1, glev_float u2);
GLEV_API void glevMapGrid1d(glev_context* context, glev_int n, glev_double u1, glev_double u2);
GLEV_API void glevMapGrid2f(glev_context* context, glev_int un, glev_float u1, glev_float u2, glev_int vn,
                            glev_float v1, glev_float v2);
GLEV_API void glevMapGrid2d(glev_context* context, glev_int un, glev_double u1, glev_double u2, glev_int vn,
                            glev_double v1, glev_double v2);

/* EvalCoord1 (EvalCoord2) at a grid point. Indices may be any, also outside the grid. Errors: as there. */
GLEV_API void glevEvalPoint1(glev_context* context, glev_int i);
GLEV_API void glevEvalPoint2(glev_context* context, glev_int i, glev_int j);

/* Draws the grid points i1 to i2 in rising order, each with the bits that EvalPoint gives it:
 * EvalMesh1: POINT as one Begin(POINTS), LINE as one Begin(LINE_STRIP).
 * EvalMesh2: POINT as one Begin(POINTS), i fastest; LINE as a LINE_STRIP along i for each j, then one along j
 *   for each i; FILL as a QUAD_STRIP (i,j), (i,j+1) for each j from j1 to j2 - 1.
 * The sink sees these primitives, also those that an empty range leaves without vertices. Without an enabled
 * vertex map of that dimension nothing happens. Current values that a callback changes count from the next
 * vertex on.
 * INVALID_ENUM: mode is not POINT or LINE, or for EvalMesh2 FILL; also if nothing would be drawn.
 * INVALID_OPERATION: between Begin and End.
 * OUT_OF_MEMORY: nothing drawn; as for EvalCoord. */
GLEV_API void glevEvalMesh1(glev_context* context, glev_enum mode, glev_int i1, glev_int i2);
GLEV_API void glevEvalMesh2(glev_context* context, glev_enum mode, glev_int i1, glev_int i2, glev_int j1,
                            glev_int j2);

/* ---- Primitives (GL §10.7) ---- */

/* Begin calls the sink's begin, End its end. mode: POINTS to POLYGON, or one of the four with adjacency
 * (0x000A to 0x000D).
 * INVALID_ENUM: mode is something else.
 * INVALID_OPERATION: Begin after Begin; End without Begin, or within a mesh; mode PATCHES (0x000E), as there
 * is no tessellation. */
GLEV_API void glevBegin(glev_context* context, glev_enum mode);
GLEV_API void glevEnd(glev_context* context);

/* Emits a vertex with the current values. z = 0 and w = 1 unless given. The d forms round to float. Ignored
 * between End and Begin (undefined in the GL). No errors, but INVALID_VALUE: v null. */
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

/* Legal anywhere. The d forms round to float, nothing is clamped. No errors, but INVALID_VALUE: v null. */

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

/* Texture unit 0, whatever unit is active. (t, r, q) = (0, 0, 1) unless given. */
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

/* Selects the unit that CURRENT_TEXTURE_COORDS answers for; Map1 and Map2 want TEXTURE0.
 * INVALID_ENUM: not TEXTURE0 to TEXTURE0 + 7. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevActiveTexture(glev_context* context, glev_enum texture);

/* ---- Display lists (GL §21.4) ---- */

/* A list is a sequence of commands with a name, a number above 0. Each context has its own: lists are not
 * shared.
 *
 * From NewList to EndList commands go into the list: Map, MapGrid, EvalCoord, EvalPoint, EvalMesh, Enable,
 * Disable, Begin, End, Vertex, all that sets current values, ActiveTexture, PushAttrib, PopAttrib, CallList,
 * CallLists and ListBase; in mode COMPILE_AND_EXECUTE they are executed as well. Everything else, queries
 * above all, is executed at once and not part of the list. What pointers point to is read when the command is
 * given, and never again. Everything else happens at execution: maps, enables, grids, the active texture, the
 * list base and Begin/End count as they are then, and errors are recorded then. A command with an error does
 * not end the list. Executing a list allocates nothing that its commands given one by one would not allocate.
 *   A list calls others, itself too, up to MAX_LIST_NESTING (64) executing at once; a call beyond does
 * nothing. Begin and End may stand in different lists or outside. Callbacks of the sink count as part of the
 * command that calls them: what they issue is executed, but does not go into the open list. */

/* Opens the list: `list` becomes its name at EndList. Until then the name stands for what it stood for
 * before, or nothing. INVALID_VALUE: list is 0. INVALID_ENUM: mode is not COMPILE or COMPILE_AND_EXECUTE.
 * INVALID_OPERATION: a list is open; between Begin and End; from a callback of the sink. */
GLEV_API void glevNewList(glev_context* context, glev_uint list, glev_enum mode);

/* Closes the list and gives it its name, replacing the list that had it.
 * INVALID_OPERATION: no list is open; between Begin and End, also if the Begin was executed by this list's
 *   COMPILE_AND_EXECUTE: the list remains open; from a callback of the sink.
 * OUT_OF_MEMORY: a command found no memory (which it has recorded then, and nothing was compiled since), or
 * there is none for the name: the list is closed and thrown away, the name stands for what it stood for
 * before. */
GLEV_API void glevEndList(glev_context* context);

/* Executes a list; a name that is no list is ignored. Legal anywhere, but inside Begin/End the commands of
 * the list have the errors that they have there. */
GLEV_API void glevCallList(glev_context* context, glev_uint list);

/* CallList(LIST_BASE + offset) for each of n offsets at `lists`, the sum modulo 2^32 with the list base of
 * that moment. type: BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, INT, UNSIGNED_INT, FLOAT (rounded down),
 * 2_BYTES, 3_BYTES, 4_BYTES (unsigned, most significant byte first). No alignment is required. INVALID_VALUE:
 * n < 0; lists null unless n is 0. INVALID_ENUM: another type. */
GLEV_API void glevCallLists(glev_context* context, glev_int n, glev_enum type, const void* lists);

/* Sets the list base, initially 0. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevListBase(glev_context* context, glev_uint base);

/* Makes empty lists with `range` successive unused names and returns the first one. 0 on error, if range is
 * 0, or if there is no such range of names. The name of the open list counts as used. INVALID_VALUE: range <
 * 0. INVALID_OPERATION: between Begin and End; from a callback of the sink. OUT_OF_MEMORY: nothing changed.
 */
GLEV_API glev_uint glevGenLists(glev_context* context, glev_int range);

/* TRUE if there is a list of that name, be it an empty one. INVALID_OPERATION: between Begin and End (FALSE).
 */
GLEV_API glev_boolean glevIsList(glev_context* context, glev_uint list);

/* Deletes the lists among the `range` names from `list` on; other names are ignored.
 * INVALID_VALUE: range < 0.
 * INVALID_OPERATION: between Begin and End; from a callback of the sink: so no list vanishes while it
 * executes. OUT_OF_MEMORY: nothing changed; only if the names lie inside a range of GenLists that has not
 * been filled. */
GLEV_API void glevDeleteLists(glev_context* context, glev_uint list, glev_int range);

/* ---- Attribute stack (GL §21.6) ---- */

/* PushAttrib saves groups of state, PopAttrib brings back those that the matching PushAttrib saved:
 *   EVAL_BIT: the 18 map enables, AUTO_NORMAL, both grids.
 *   ENABLE_BIT: the 18 map enables and AUTO_NORMAL.
 *   CURRENT_BIT: colour, index, normal, texture coordinates of all units, edge flag.
 *   TEXTURE_BIT: the active texture.
 *   LIST_BIT: the list base.
 * Maps are in no group. Other bits save nothing and are no error. Neither command allocates.
 * STACK_OVERFLOW: PushAttrib, MAX_ATTRIB_STACK_DEPTH (16) are waiting for their PopAttrib.
 * STACK_UNDERFLOW: PopAttrib, none is.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevPushAttrib(glev_context* context, glev_bitfield mask);
GLEV_API void glevPopAttrib(glev_context* context);

/* ---- Flush and Finish (GL §2.3.2, §2.3.3) ---- */

/* Nothing is ever buffered, so they do nothing. INVALID_OPERATION: between Begin and End. */
GLEV_API void glevFlush(glev_context* context);
GLEV_API void glevFinish(glev_context* context);

/* ---- Queries (GL §2.2.2, §22) ---- */

/* pname, with the number of values:
 *   one of the 18 map enables [1], AUTO_NORMAL [1], MAX_EVAL_ORDER [1], MAP1_GRID_DOMAIN [2: u1, u2],
 *   MAP1_GRID_SEGMENTS [1], MAP2_GRID_DOMAIN [4: u1, u2, v1, v2], MAP2_GRID_SEGMENTS [2: un, vn],
 *   CURRENT_COLOR [4], CURRENT_INDEX [1], CURRENT_NORMAL [3], CURRENT_TEXTURE_COORDS [4] of the active unit,
 *   EDGE_FLAG [1], ACTIVE_TEXTURE [1], MAX_TEXTURE_COORDS [1], MAX_TEXTURE_UNITS [1], LIST_BASE [1],
 *   LIST_INDEX [1: name of the open list, or 0], LIST_MODE [1: its mode, or 0], MAX_LIST_NESTING [1],
 *   ATTRIB_STACK_DEPTH [1], MAX_ATTRIB_STACK_DEPTH [1].
 * Conversions: booleans are 0 or 1; as a boolean a number is TRUE unless zero; reals become the nearest
 *   integer (halves away from zero, saturated, NaN gives 0); colours and normals become integers by
 *   round(clamp(c, -1, 1) * (2^31 - 1)). Nothing is written on error.
 * INVALID_ENUM: any other pname.
 * INVALID_VALUE: v null.
 * INVALID_OPERATION: between Begin and End. */
GLEV_API void glevGetBooleanv(glev_context* context, glev_enum pname, glev_boolean* v);
GLEV_API void glevGetIntegerv(glev_context* context, glev_enum pname, glev_int* v);
GLEV_API void glevGetFloatv(glev_context* context, glev_enum pname, glev_float* v);
GLEV_API void glevGetDoublev(glev_context* context, glev_enum pname, glev_double* v);

/* VENDOR, RENDERER, VERSION: a string that lives as long as the program. VERSION begins with "4.6 ": the
 * evaluator semantics are those of OpenGL 4.6, compatibility profile. Null on error.
 * INVALID_ENUM: any other name. INVALID_OPERATION: between Begin and End. */
GLEV_API const glev_ubyte* glevGetString(glev_context* context, glev_enum name);

/* ---- Plans ---- */

/* An immutable snapshot of what evaluation needs: the maps of one dimension that are enabled and not
 * outranked, AUTO_NORMAL, and the grid. It is reference-counted: who creates or retains it releases it. Later
 * changes of the context do not reach it, and it may outlive the context. Evaluation never allocates. All
 * calls on plans are safe from any thread. */

typedef struct glev_plan_info {
  size_t size;
  size_t dimension; /* 1: the MAP1 maps, 2: the MAP2 maps */
} glev_plan_info;

/* Takes a snapshot of the context; legal between Begin and End, too. *plan is null on failure. Two calls
 * without a change of state between them return the same plan with one more reference.
 * Returns SUCCESS, INVALID_ARGUMENT, UNSUPPORTED (dimension is neither 1 nor 2) or OUT_OF_MEMORY. */
GLEV_API glev_result glevCreatePlan(glev_context* context, const glev_plan_info* info, glev_plan** plan);

GLEV_API void glevRetainPlan(glev_plan* plan);
GLEV_API void glevReleasePlan(glev_plan* plan); /* null is ignored */

/* TANGENT_U and TANGENT_V, of plans of dimension 2 with a vertex map: the derivatives of its components by u
 * and v (of homogeneous coordinates, not of their quotient). With V the exact value and D the largest
 * difference of neighbours among the control points in that direction, times the degree over the width of the
 * domain, inside the domain float results are within 2^-24 |V| + (13 (n + m) + 4) 2^-53 D and double results
 * within 2^-53 |V| + 2^-80 D, n and m the degrees, for finite maps of magnitudes from 2^-300 to 2^300 or zero
 * and grids of at most 2^10 times the domain. Automatic normals as doubles are the floats' values. */
typedef enum glev_attribute {
  GLEV_ATTRIBUTE_VERTEX = 0,
  GLEV_ATTRIBUTE_COLOR = 1,
  GLEV_ATTRIBUTE_NORMAL = 2, /* of a normal map, or automatic */
  GLEV_ATTRIBUTE_TEXCOORD = 3,
  GLEV_ATTRIBUTE_TANGENT_U = 4,
  GLEV_ATTRIBUTE_TANGENT_V = 5
} glev_attribute;

/* Number of values (1 to 4) a plan gives for an attribute, 0 if it has no map for it or there is no such
 * attribute. */
GLEV_API size_t glevGetPlanComponents(const glev_plan* plan, glev_attribute attribute);

/* ---- Batches ---- */

/* Accuracy of results.
 * CORRECTLY_ROUNDED: those of EvalCoord and EvalPoint, bit for bit.
 * FAST: of what a map gives, each component of a float result differs from the exact value V by at most
 *   (6 (n + m) + 12) * 2^-24 * max|R| for arguments inside the domain, n and m the degrees, max|R| the
 * largest magnitude of that component of a control point, as long as that is between 2^-80 and 2^80;
 * otherwise, and outside the domain, it is the correctly rounded one. So are the values on the boundary of
 * the domain: patches that share the control points of an edge meet there without a crack, whatever their
 * orders, directions, domains and numbers of segments. Automatic normals, tangents and double results are the
 * same in both. */
typedef enum glev_precision { GLEV_CORRECTLY_ROUNDED = 0, GLEV_FAST = 1 } glev_precision;

/* Destination of one attribute: element i is `components` values at data + i*stride bytes; in a mesh of two
 * dimensions, element (i, j) lies at data + i*stride + j*row_stride, counted from (i1, j1).
 * components: at least what glevGetPlanComponents says, at most 4 (3 for normals); the missing ones are
 *   (0,0,0,1)'s, for tangents 0.
 * stride: at least the bytes of the components.
 * data_size: bytes at data that may be written.
 * type: GLEV_FLOAT, also 0, or GLEV_DOUBLE.
 * row_stride: meshes of two dimensions and patches only. At least the bytes from the first to the end of
 *   the last element of a row; 0: rows follow one another.
 * patch_stride: glevEvaluatePatches on a grid only, where element (i, j) of patch p lies at data +
 *   p*patch_stride + j*row_stride + i*stride. At least the bytes from the first to the end of the last
 *   element of a patch; 0: patches follow one another.
 * No alignment is required. Bytes between elements are not touched, so attributes may be interleaved.
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

/* One output of a batch or a mesh. An attribute that is not among the outputs is not computed. An attribute
 * that is there twice, or is none of glev_attribute, is INVALID_ARGUMENT. */
typedef struct glev_attribute_output {
  glev_attribute attribute;
  const glev_output* output;
} glev_attribute_output;

/* An array of arguments: number i lies at data + i*stride bytes. stride: any, 0 included. data_size: bytes at
 * data that may be read. */
typedef struct glev_input {
  const void* data;
  size_t data_size;
  size_t stride;
} glev_input;

/* `count` arguments u, or (u, v), of type `type` (GLEV_FLOAT or GLEV_DOUBLE). v: for plans of dimension 2
 * only, all zero else. */
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

/* Evaluates the maps of a plan at each argument. Unlike in the GL, no vertex map is needed for the others to
 * be evaluated. Everything is checked before anything is written. With count 0 nothing is read or written,
 * and all data may be null. A batch without outputs is legal, writes nothing, and is checked like any
 * other. Returns SUCCESS or INVALID_ARGUMENT: a null pointer, a wrong size, type, stride,
 * precision or number of components. NO_MAP: an output for an attribute without a map. BUFFER_TOO_SMALL: a
 * data_size. OVERLAP: bytes of an output belong to another output or to an input as well. Interleaving in one
 * block is recognised if the strides are equal; with different strides the blocks must be apart. */
GLEV_API glev_result glevEvaluate(const glev_plan* plan, const glev_batch* batch);

/* The points i1..i2 of the plan's grid, for plans of dimension 2 i1..i2 times j1..j2; j1 = j2 = 0 else. Any
 * index is legal, as in EvalMesh. i1 > i2 or j1 > j2: no point.
 * scratch: scratch_size bytes of the caller's, at least what glevGetMeshScratchSize says; contents do not
 * matter, nor does alignment. Concurrent calls need scratch of their own. */
typedef struct glev_mesh {
  size_t size;
  glev_int i1, i2, j1, j2;
  glev_precision precision;
  const glev_attribute_output* outputs; /* null if output_count is 0 */
  size_t output_count;
  void* scratch;
  size_t scratch_size;
} glev_mesh;

/* The bytes of scratch memory that glevEvaluateMesh needs for the columns, i1 to i2, of this mesh: evaluation
 * never allocates. More than 0 for every legal mesh, one without points included. 0 if the plan or the mesh
 * is null, its size is wrong, precision is none of the two, or j1 or j2 is not 0 in one dimension:
 * glevEvaluateMesh returns INVALID_ARGUMENT then. The outputs, output_count, scratch and scratch_size of the
 * mesh are not looked at. */
GLEV_API size_t glevGetMeshScratchSize(const glev_plan* plan, const glev_mesh* mesh);

/* Evaluates the maps of a plan at points of its grid. Values, checks and results as glevEvaluate; scratch
 * counts as an output. */
GLEV_API glev_result glevEvaluateMesh(const glev_plan* plan, const glev_mesh* mesh);

/* ---- Patches ---- */

/* An array of `count` Bezier patches, tensor products of Bernstein polynomials with uorder * vorder control
 * points of `components` values each. Control point (i, j) of patch p begins p*patch_stride + i*u_stride +
 * j*v_stride bytes after `points`, i in the direction of u. Curves are patches with vorder 1.
 * components: 1 to 4. uorder, vorder: 1 to 64.
 * type: of the control points, GLEV_FLOAT or GLEV_DOUBLE.
 * points_size: bytes at points that may be read. No alignment is required.
 * v_stride, u_stride, patch_stride: any, so that control points may share memory. 0 stands for control
 *   points, rows and patches without padding, v fastest: float points[count][uorder][vorder][components].
 * u1, u2, v1, v2: the domain of all patches, where u1 = u2 and v1 = v2 are wrong as in Map2; but u1 = u2 =
 *   0 stands for 0 to 1, as does v1 = v2 = 0. */
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

/* UNIFORM: each patch at (u_segments + 1) * (v_segments + 1) points, those of MapGrid2d(u_segments, u1, u2,
 *   v_segments, v1, v2) with the ends of the domain. In a direction of 0 segments there is one point, the
 *   first end.
 * LISTS: each patch at u_count * v_count points, (u[i], v[j]).
 * SCATTERED: u_count points; point i is that of patch number patch[i] at (u[i], v[i]). Neighbours of the
 *   same patch cost less. */
typedef enum glev_grid_kind {
  GLEV_GRID_UNIFORM = 0,
  GLEV_GRID_LISTS = 1,
  GLEV_GRID_SCATTERED = 2
} glev_grid_kind;

/* The arguments at which patches are evaluated. Members that the kind of grid does not use must be zero.
 * u_segments, v_segments: UNIFORM only, 0 or more.
 * u_count: LISTS and SCATTERED. v_count: LISTS only.
 * type: LISTS and SCATTERED: of the arguments u and v, GLEV_FLOAT or GLEV_DOUBLE.
 * v: in LISTS and SCATTERED; of curves it has no influence. It may be all zero for curves, with v_count 0,
 *   which is one row then.
 * limit_normals: not FALSE for limits in place of (0,0,0) on edges of the domain that are a single point,
 *   such as poles: if all control points of the edge are equal, NORMAL is what it tends to from inside the
 *   patch, computed in double from derivatives of second order, and (0,0,0) if these do not determine it.
 * patch: SCATTERED only; numbers of type glev_uint.
 * target: one of glevGetTargetName; null for the best. */
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
} glev_patch_grid;

/* Evaluates an array of patches. The attributes are VERTEX, the values of the patches; TANGENT_U and
 * TANGENT_V; and of 3 or 4 components NORMAL, the automatic normals, which are (0,0,0) if a tangent is
 * zero, as of curves, but for limit_normals.
 * All results have the bits that MAP2 maps of the same control points give, in UNIFORM by glevEvaluateMesh,
 * else by glevEvaluate; double results of curves in LISTS and SCATTERED those of MAP1 maps. They do not
 * depend on strides, other patches and, but for GLEV_FAST, on the instruction set.
 * UNIFORM and LISTS: element (i, j) of an output, i along u, lies at data + p*patch_stride + j*row_stride +
 *   i*stride. SCATTERED: element i lies at data + i*stride.
 * scratch: scratch_size bytes of the caller's, at least what glevGetPatchScratchSize says; contents and
 *   alignment do not matter. Nothing is allocated. Concurrent calls need scratch of their own.
 * Everything is checked before anything is written. Without patches or points nothing is read or written,
 * and points, arguments, data and scratch may be null; a point of SCATTERED without patches has a wrong
 * number. Returns SUCCESS or
 * INVALID_ARGUMENT: a null pointer; a wrong size, type, order, number of components, stride of an output,
 *   domain, kind, precision, number of segments or target; a member that must be zero; a patch number that
 *   is not below count; an attribute that is there twice.
 * NO_MAP: NORMAL of fewer than 3 components, COLOR and TEXCOORD.
 * BUFFER_TOO_SMALL: points_size, a data_size or scratch_size.
 * OVERLAP: bytes of an output belong to another output, the scratch, the control points or the arguments as
 *   well. Interleaving is recognised as by glevEvaluate. */
GLEV_API glev_result glevEvaluatePatches(const glev_patches* patches, const glev_patch_grid* grid,
                                         const glev_attribute_output* outputs, size_t output_count,
                                         void* scratch, size_t scratch_size);

/* Returns the bytes of scratch memory that glevEvaluatePatches needs for these patches and this grid,
 * whatever the outputs and the number of patches. 0 if glevEvaluatePatches returns INVALID_ARGUMENT because
 * of `patches` or `grid`, where points, data and data_size that are missing do not matter. */
GLEV_API size_t glevGetPatchScratchSize(const glev_patches* patches, const glev_patch_grid* grid);

/* One map for a plan without a context: what Map1 or Map2, MapGrid and Enable set.
 * target: one of the 18 names but MAP1_INDEX and MAP2_INDEX.
 * map: one patch (count 1) with the number of components of the target; vorder 1 for MAP1 names. It is
 *   copied.
 * u_segments, v_segments: of the grid, which spans the domain; 0 stands for 1. v_segments is 0 for MAP1
 *   names.
 * auto_normal: not FALSE for automatic normals of MAP2_VERTEX maps. */
typedef struct glev_map_info {
  size_t size;
  glev_enum target;
  const glev_patches* map;
  glev_int u_segments, v_segments;
  glev_boolean auto_normal;
  const glev_allocator* allocator; /* copied; null for the heap */
  const char* instruction_set;     /* one of glevGetTargetName; null for the best */
} glev_map_info;

/* Makes a plan of one map, with one reference. It gives what a plan of a context with this map gives. *plan
 * is null on failure.
 * Returns SUCCESS, INVALID_ARGUMENT, BUFFER_TOO_SMALL (points_size) or OUT_OF_MEMORY. */
GLEV_API glev_result glevCreatePlanFromMap(const glev_map_info* info, glev_plan** plan);

/* ---- Indices ---- */

/* Front faces, as of glFrontFace. */
#define GLEV_CW 0x0900
#define GLEV_CCW 0x0901

/* Primitives of the vertices of meshes of columns * rows points, numbered along u first, for
 * glDrawElements:
 * POINT: POINTS, in the order of EvalMesh2. LINE: LINES, first those along u, then those along v, each as
 *   EvalMesh draws it. FILL: TRIANGLES, two for each quadrilateral of EvalMesh2's QUAD_STRIPs, (i,j)
 *   (i,j+1) (i+1,j) and (i+1,j) (i,j+1) (i+1,j+1): the same side in front. A mesh of dimension 1 has rows =
 *   1, and no FILL.
 * patches: the number of meshes, whose primitives and vertices follow one another, as glevEvaluatePatches
 *   writes the latter; 0 stands for 1.
 * winding: of FILL, as seen from where automatic normals point to: GLEV_CW, also 0, is that of EvalMesh2;
 *   GLEV_CCW swaps the second and third index of each triangle.
 * vertices: if not null, vertices of equal bits are shared: each index is that of the first vertex, among
 *   those of all patches, whose vertex_bytes bytes are equal. Vertex number i lies at vertices +
 *   i*vertex_stride; vertices_size bytes may be read. Vertices that no index names any more stay where they
 *   are.
 * scratch: to share vertices: scratch_size bytes, at least what glevGetIndexScratchSize says; contents and
 *   alignment do not matter. */
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
  const void* vertices; /* null: none are shared */
  size_t vertices_size, vertex_stride, vertex_bytes;
  void* scratch;
  size_t scratch_size;
} glev_indices;

/* Returns the number of indices; 0 if glevGetIndices rejects the arguments, whatever data and scratch are. */
GLEV_API size_t glevGetIndexCount(const glev_indices* indices);

/* Returns the bytes of scratch memory that glevGetIndices needs to share vertices, 8 to 20 for each; 0 if
 * vertices is null, and if glevGetIndexCount returns 0. */
GLEV_API size_t glevGetIndexScratchSize(const glev_indices* indices);

/* Writes them, without gaps. Data, vertices and scratch must not overlap; that is not checked.
 * Returns SUCCESS or
 * INVALID_ARGUMENT: a null pointer; a wrong size, mode, type or winding; a vertex whose number the type
 *   cannot hold; vertex_bytes that are 0 or more than vertex_stride; 2^32 vertices or more to share.
 * BUFFER_TOO_SMALL: data_size, vertices_size or scratch_size. */
GLEV_API glev_result glevGetIndices(const glev_indices* indices);

#ifdef __cplusplus
}
#endif

#endif /* GLEVALUATOR_H_ */
