/* The smallest useful sink: curves of three coordinates. evalcts calls only the functions declared below. */
#include <evalcts_sink.h>
static const evalcts_receiver* receiver;
static float points[8][3], u1, u2;
static int order, enabled;
static void Enable(unsigned target) { enabled |= target == 0x0D97; }
static void Map1f(unsigned target, float a, float b, int stride, int n, const float* p) {
  if (target != 0x0D97 || a == b || n < 1 || stride < 3) return;
  for (int i = 0; i < 3 * n; ++i) points[i / 3][i % 3] = p[i / 3 * stride + i % 3];
  order = n, u1 = a, u2 = b;
}
static float value(int i, int degree, int k, float t) { /* de Casteljau's algorithm */
  return degree ? (1 - t) * value(i, degree - 1, k, t) + t * value(i + 1, degree - 1, k, t) : points[i][k];
}
static void EvalCoord1f(float u) {
  float position[4] = {0, 0, 0, 1};
  for (int k = 0; k < 3; ++k) position[k] = value(0, order - 1, k, (u - u1) / (u2 - u1));
  if (enabled) receiver->vertex(receiver->user, position, 0, 0, 0, 0);
}
static const char* reset(const evalcts_receiver* new_receiver) {
  Map1f(0x0D97, 0, 1, 3, 1, (float[]){0, 0, 0}); /* GL_MAP1_VERTEX_3, initial map */
  return receiver = new_receiver, enabled = 0, (const char*)0;
}
static const evalcts_sink_command kCommands[] = {
    EVALCTS_SINK_COMMAND(Enable), EVALCTS_SINK_COMMAND(Map1f), EVALCTS_SINK_COMMAND(EvalCoord1f), {0, 0}};
static const unsigned kTargets[] = {0x0D97, 0};
static const evalcts_sink kSink = {.version = EVALCTS_SINK_VERSION,
                                   .attributes = EVALCTS_SINK_POSITION,
                                   .commands = kCommands,
                                   .reset = reset,
                                   .targets = kTargets,
                                   .max_order = 8};
const evalcts_sink* evalcts_sink_open(void) { return &kSink; }
