/* A C program that uses the library. It draws a curve, evaluates it as a batch, then draws it as the edge of
 * a patch and by a display list, and exits with 0 if all results agree. */
#include <glevaluator.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kCount = 5 };

typedef struct Strip {
  size_t count;
  int begun, ended;
  float positions[kCount][3];
} Strip;

static void on_begin(void* user, glev_enum mode) { ((Strip*)user)->begun += mode == GLEV_LINE_STRIP; }
static void on_end(void* user) { ++((Strip*)user)->ended; }
static void on_vertex(void* user, const glev_vertex* vertex) {
  Strip* s = user;
  if (s->count < kCount) memcpy(s->positions[s->count], vertex->position, sizeof s->positions[0]);
  ++s->count;
}

#define CHECK(condition)                                               \
  do {                                                                 \
    if (!(condition)) {                                                \
      fprintf(stderr, "line %d: %s is false\n", __LINE__, #condition); \
      return EXIT_FAILURE;                                             \
    }                                                                  \
  } while (0)

int main(void) {
  static const float kPoints[4][3] = {{0, 0, 0}, {1, 2, 0}, {3, 2, 0}, {4, 0, 0}};
  static const float kU[kCount] = {0, 0.25f, 0.5f, 0.75f, 1};
  Strip drawn = {0, 0, 0, {{0}}};
  const glev_sink sink = {sizeof(glev_sink), &drawn, on_begin, on_vertex, on_end};
  glev_context* context;
  CHECK(glevCreateContext(NULL, &context) == GLEV_SUCCESS);
  CHECK(glevSetSink(context, &sink) == GLEV_SUCCESS);

  glevMap1f(context, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, &kPoints[0][0]);
  glevEnable(context, GLEV_MAP1_VERTEX_3);
  glevBegin(context, GLEV_LINE_STRIP);
  for (size_t i = 0; i < kCount; ++i) glevEvalCoord1f(context, kU[i]);
  glevEnd(context);
  CHECK(glevGetError(context) == GLEV_NO_ERROR);
  CHECK(drawn.begun == 1 && drawn.ended == 1 && drawn.count == kCount);
  CHECK(drawn.positions[2][0] == 2.0f && drawn.positions[2][1] == 1.5f);
  CHECK(memcmp(drawn.positions[4], kPoints[3], sizeof kPoints[3]) == 0);

  /* a patch whose edge v = 0 is the curve, drawn along that edge */
  static const float kPatch[4][2][3] = {
      {{0, 0, 0}, {0, 0, 1}}, {{1, 2, 0}, {1, 2, 1}}, {{3, 2, 0}, {3, 2, 1}}, {{4, 0, 0}, {4, 0, 1}}};
  Strip edge = {0, 0, 0, {{0}}};
  const glev_sink edge_sink = {sizeof(glev_sink), &edge, on_begin, on_vertex, on_end};
  CHECK(glevSetSink(context, &edge_sink) == GLEV_SUCCESS);
  glevMap2f(context, GLEV_MAP2_VERTEX_3, 0, 1, 6, 4, 0, 1, 3, 2, &kPatch[0][0][0]);
  glevMapGrid2f(context, kCount - 1, 0, 1, 1, 0, 1);
  glevEnable(context, GLEV_MAP2_VERTEX_3);
  glevEnable(context, GLEV_AUTO_NORMAL);
  glevBegin(context, GLEV_LINE_STRIP);
  for (int i = 0; i < kCount; ++i) glevEvalPoint2(context, i, 0);
  glevEnd(context);
  CHECK(edge.count == kCount && memcmp(edge.positions, drawn.positions, sizeof edge.positions) == 0);
  glevEvalMesh2(context, GLEV_LINE, 0, kCount - 1, 0, 1);
  CHECK(glevGetError(context) == GLEV_NO_ERROR);
  CHECK(edge.begun == 1 + 2 + kCount && edge.ended == 1 + 2 + kCount && edge.count == 5 * kCount);

  /* the curve again, by a display list, with its own attributes */
  const glev_uint list = glevGenLists(context, 1);
  glevNewList(context, list, GLEV_COMPILE);
  glevPushAttrib(context, GLEV_EVAL_BIT);
  glevMapGrid1f(context, kCount - 1, 0, 1);
  glevEvalMesh1(context, GLEV_LINE, 0, kCount - 1);
  glevPopAttrib(context);
  glevEndList(context);
  edge.count = 0;
  glevCallList(context, list);
  CHECK(glevGetError(context) == GLEV_NO_ERROR);
  CHECK(edge.count == kCount && memcmp(edge.positions, drawn.positions, sizeof edge.positions) == 0);

  const glev_plan_info info = {.size = sizeof info, .dimension = 1};
  glev_plan* plan;
  CHECK(glevCreatePlan(context, &info, &plan) == GLEV_SUCCESS);
  glevDestroyContext(context);

  float positions[kCount][3];
  const glev_output vertex = {.size = sizeof vertex,
                              .data = positions,
                              .data_size = sizeof positions,
                              .stride = sizeof positions[0],
                              .components = 3};
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &vertex}};
  const glev_batch batch = {.size = sizeof batch,
                            .count = kCount,
                            .type = GLEV_FLOAT,
                            .u = {.data = kU, .data_size = sizeof kU, .stride = sizeof kU[0]},
                            .outputs = outputs,
                            .output_count = 1};
  CHECK(glevEvaluate(plan, &batch) == GLEV_SUCCESS);
  CHECK(memcmp(positions, drawn.positions, sizeof positions) == 0);
  glevReleasePlan(plan);
  return EXIT_SUCCESS;
}
