/* An evaluator that is not a GL, plugged into evalcts: de Casteljau's algorithm for curves of floats.
 *
 *   cc -shared -fPIC -I harness/backends/plugin -o bezier.so harness/examples/bezier_sink.c
 *   evalcts run --library ./bezier.so
 *
 * It declares two targets, VERTEX_3 and VERTEX_4, and emits only positions. It has no queries, no errors, no
 * double precision and no explicit vertices, so tests that need them are not-supported. */
#include <evalcts_sink.h>
#include <string.h>

enum { kMap1Vertex3 = 0x0D97, kMap1Vertex4 = 0x0D98, kMaxOrder = 8 };

typedef struct Curve {
  int enabled;
  int order;
  float u1, u2;
  float points[kMaxOrder][4];
} Curve;

static const evalcts_receiver* receiver;
static Curve curves[2]; /* VERTEX_3, VERTEX_4 */

static Curve* curve_of(unsigned target) {
  if (target != kMap1Vertex3 && target != kMap1Vertex4) return NULL;
  return &curves[target - kMap1Vertex3];
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

static void EvalCoord1f(float u) {
  const Curve* curve = &curves[curves[1].enabled ? 1 : 0];
  float points[kMaxOrder][4];
  float t;
  int degree, i, k;
  if (!curve->enabled) return;
  t = (u - curve->u1) / (curve->u2 - curve->u1);
  memcpy(points, curve->points, sizeof points);
  for (degree = curve->order - 1; degree > 0; --degree)
    for (i = 0; i < degree; ++i)
      for (k = 0; k < 4; ++k) points[i][k] = (1.0f - t) * points[i][k] + t * points[i + 1][k];
  receiver->vertex(receiver->user, points[0], NULL, NULL, NULL, 0);
}

static void EvalCoord1fv(const float* u) { EvalCoord1f(*u); }

/* Sets the initial state of GL: maps of order 1, with domain 0 to 1 and the point (0, 0, 0, 1). */
static const char* reset(const evalcts_receiver* new_receiver) {
  int i;
  receiver = new_receiver;
  memset(curves, 0, sizeof curves);
  for (i = 0; i < 2; ++i) {
    curves[i].order = 1;
    curves[i].u2 = 1.0f;
    curves[i].points[0][3] = 1.0f;
  }
  return NULL;
}

static const evalcts_sink_command kCommands[] = {
    EVALCTS_SINK_COMMAND(Map1f),       EVALCTS_SINK_COMMAND(Enable),       EVALCTS_SINK_COMMAND(Disable),
    EVALCTS_SINK_COMMAND(EvalCoord1f), EVALCTS_SINK_COMMAND(EvalCoord1fv), {NULL, NULL}};
static const unsigned kTargets[] = {kMap1Vertex3, kMap1Vertex4, 0};

const evalcts_sink* evalcts_sink_open(void) {
  static const evalcts_sink kSink = {.version = EVALCTS_SINK_VERSION,
                                     .attributes = EVALCTS_SINK_POSITION,
                                     .commands = kCommands,
                                     .reset = reset,
                                     .targets = kTargets,
                                     .max_order = kMaxOrder,
                                     .vendor = "evalcts",
                                     .name = "Bezier example",
                                     .gl_version = "1.1"};
  return &kSink;
}
