/* A circle. No polynomial curve is a circle, but rational curves (GL_MAP1_VERTEX_4) are exact: four quarters
 * with integer control points (x, y, z, w). Prints points, and the distance of the vertices from the circle
 * for float and double results. */
#include <glevaluator.h>
#include <math.h>
#include <stdio.h>

enum { QUARTERS = 4, STEPS = 1000 };

static float u[STEPS + 1];
static float floats[STEPS + 1][4];
static double doubles[STEPS + 1][4];

/* Defines the curve ((1 - u^2) / (1 + u^2), 2u / (1 + u^2)), a quarter of the circle, rotated by `quarter`
 * quarters. */
static void define_quarter(glev_context* gl, int quarter) {
  float points[3][4] = {{1, 0, 0, 1}, {1, 1, 0, 1}, {0, 2, 0, 2}};
  for (int turn = 0; turn < quarter; ++turn)
    for (int i = 0; i < 3; ++i) {
      const float x = points[i][0];
      points[i][0] = -points[i][1];
      points[i][1] = x;
    }
  glevMap1f(gl, GLEV_MAP1_VERTEX_4, 0, 1, 4, 3, &points[0][0]);
}

static int evaluate(glev_context* gl, const glev_output* vertex) {
  const glev_plan_info info = {.size = sizeof info, .dimension = 1};
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, vertex}};
  const glev_batch batch = {.size = sizeof batch,
                            .count = STEPS + 1,
                            .type = GLEV_FLOAT,
                            .u = {.data = u, .data_size = sizeof u, .stride = sizeof u[0]},
                            .outputs = outputs,
                            .output_count = 1};
  glev_plan* plan;
  if (glevCreatePlan(gl, &info, &plan) != GLEV_SUCCESS) return 0;
  const glev_result result = glevEvaluate(plan, &batch);
  glevReleasePlan(plan);
  return result == GLEV_SUCCESS;
}

static double distance(double x, double y, double w) { return fabs(hypot(x / w, y / w) - 1); }

int main(void) {
  const glev_output single = {.size = sizeof single,
                              .data = floats,
                              .data_size = sizeof floats,
                              .stride = sizeof floats[0],
                              .components = 4};
  const glev_output twice = {.size = sizeof twice,
                             .data = doubles,
                             .data_size = sizeof doubles,
                             .stride = sizeof doubles[0],
                             .components = 4,
                             .type = GLEV_DOUBLE};
  glev_context* gl;
  if (glevCreateContext(NULL, &gl) != GLEV_SUCCESS) return 1;
  glevEnable(gl, GLEV_MAP1_VERTEX_4);
  for (int i = 0; i <= STEPS; ++i) u[i] = (float)i / STEPS;

  double of_floats = 0, of_doubles = 0;
  for (int quarter = 0; quarter < QUARTERS; ++quarter) {
    define_quarter(gl, quarter);
    if (!evaluate(gl, &single) || !evaluate(gl, &twice)) return 1;
    for (int i = 0; i <= STEPS; ++i) {
      const float* f = floats[i];
      const double* d = doubles[i];
      of_floats = fmax(of_floats, distance(f[0], f[1], f[3]));
      of_doubles = fmax(of_doubles, distance(d[0], d[1], d[3]));
      if (i % (STEPS / 4) == 0 && i < STEPS) printf("%9.6f %9.6f\n", d[0] / d[3], d[1] / d[3]);
    }
  }
  printf("%d points, at most %.1e from the circle as floats and %.1e as doubles\n", QUARTERS * STEPS,
         of_floats, of_doubles);
  glevDestroyContext(gl);
  return 0;
}
