/* An evaluator that is no GL, plugged into evalcts: de Casteljau's algorithm for curves of floats.
 *
 *   cc -shared -fPIC -I harness/backends/plugin -o bezier.so harness/examples/bezier_sink.c
 *   evalcts run --library ./bezier.so
 *
 * It knows two targets, VERTEX_3 and VERTEX_4, and hands over positions only. It has no queries, no errors,
 * no double precision and no explicit vertices: tests that need them are not-observable. */
#include <evalcts_sink.h>
#include <stdlib.h>
#include <string.h>

enum { kMap1Vertex3 = 0x0D97, kMap1Vertex4 = 0x0D98, kMaxOrder = 8 };

typedef struct Curve {
  int enabled;
  int order;
  float u1, u2;
  float points[kMaxOrder][4];
} Curve;

typedef struct Context {
  const evalcts_receiver* receiver;
  Curve curves[2]; /* VERTEX_3, VERTEX_4 */
} Context;

static Context* current;

static Curve* curve_of(unsigned target) {
  if (target != kMap1Vertex3 && target != kMap1Vertex4) return NULL;
  return &current->curves[target - kMap1Vertex3];
}

static void Map1f(unsigned target, float u1, float u2, int stride, int order, const float* points) {
  const int components = target == kMap1Vertex3 ? 3 : 4;
  Curve* curve = curve_of(target);
  int i, k;
  if (!curve || u1 == u2 || order < 1 || order > kMaxOrder || stride < components) return;
  curve->order = order;
  curve->u1 = u1;
  curve->u2 = u2;
  for (i = 0; i < order; ++i)
    for (k = 0; k < 4; ++k) curve->points[i][k] = k < components ? points[i * stride + k] : 1.0f;
}

static void Enable(unsigned target) {
  Curve* curve = curve_of(target);
  if (curve) curve->enabled = 1;
}

static void Disable(unsigned target) {
  Curve* curve = curve_of(target);
  if (curve) curve->enabled = 0;
}

static void Begin(unsigned mode) { current->receiver->begin(current->receiver->user, mode); }
static void End(void) { current->receiver->end(current->receiver->user); }

static void EvalCoord1f(float u) {
  const Curve* curve = &current->curves[current->curves[1].enabled ? 1 : 0];
  float points[kMaxOrder][4];
  float t;
  int degree, i, k;
  if (!curve->enabled) return;
  t = (u - curve->u1) / (curve->u2 - curve->u1);
  memcpy(points, curve->points, sizeof points);
  for (degree = curve->order - 1; degree > 0; --degree)
    for (i = 0; i < degree; ++i)
      for (k = 0; k < 4; ++k) points[i][k] = (1.0f - t) * points[i][k] + t * points[i + 1][k];
  current->receiver->vertex(current->receiver->user, points[0], NULL, NULL, NULL, 0);
}

static void EvalCoord1fv(const float* u) { EvalCoord1f(*u); }

static void* create(const evalcts_receiver* receiver) {
  int i;
  current = calloc(1, sizeof *current);
  if (!current) return NULL;
  current->receiver = receiver;
  for (i = 0; i < 2; ++i) { /* GL: order 1, domain 0 to 1, point (0, 0, 0, 1) */
    current->curves[i].order = 1;
    current->curves[i].u2 = 1.0f;
    current->curves[i].points[0][3] = 1.0f;
  }
  return current;
}

static void destroy(void* context) {
  free(context);
  current = NULL;
}

static void* command(const char* name) {
  static const struct {
    const char* name;
    void (*function)(void);
  } all[] = {
      {"glMap1f", (void (*)(void))Map1f},
      {"glEnable", (void (*)(void))Enable},
      {"glDisable", (void (*)(void))Disable},
      {"glBegin", (void (*)(void))Begin},
      {"glEnd", (void (*)(void))End},
      {"glEvalCoord1f", (void (*)(void))EvalCoord1f},
      {"glEvalCoord1fv", (void (*)(void))EvalCoord1fv},
  };
  size_t i;
  for (i = 0; i < sizeof all / sizeof *all; ++i)
    if (strcmp(name, all[i].name) == 0) return (void*)all[i].function;
  return NULL;
}

static const char* error(void) { return "out of memory"; }

const evalcts_sink* evalcts_sink_open(void) {
  static const evalcts_sink sink = {EVALCTS_SINK_VERSION,
                                    EVALCTS_SINK_POSITION,
                                    "evalcts",
                                    "Bezier example",
                                    "1.1",
                                    create,
                                    destroy,
                                    command,
                                    error};
  return &sink;
}
