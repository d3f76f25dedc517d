#include "teapot_mesh.h"

#include <glevaluator.h>
#include <stdlib.h>

#include "teapot_patches.h"

/* The layout of a patch's vertices: interleaved, position and normal. */
static glev_output output(float* first, size_t count) {
  const glev_output result = {.size = sizeof result,
                              .data = first,
                              .data_size = (count - 1) * sizeof(teapot_vertex) + 3 * sizeof(float),
                              .stride = sizeof(teapot_vertex),
                              .components = 3};
  return result;
}

/* At a pole a whole edge of a patch is one point, so that p_u x p_v and the automatic normal are zero. The
 * normal a millionth of the patch beside it is that of the pole for every purpose. */
static int fill_poles(const glev_plan* plan, int segments, teapot_vertex* vertices) {
  for (int j = 0; j <= segments; j += segments)
    for (int i = 0; i <= segments; ++i) {
      teapot_vertex* vertex = &vertices[j * (segments + 1) + i];
      if (vertex->normal[0] != 0 || vertex->normal[1] != 0 || vertex->normal[2] != 0) continue;
      const float u = (float)i / (float)segments, v = j == 0 ? 1e-6f : 1 - 1e-6f;
      const glev_output normal = output(vertex->normal, 1);
      const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_NORMAL, &normal}};
      const glev_batch beside = {.size = sizeof beside,
                                 .count = 1,
                                 .type = GLEV_FLOAT,
                                 .u = {.data = &u, .data_size = sizeof u},
                                 .v = {.data = &v, .data_size = sizeof v},
                                 .outputs = outputs,
                                 .output_count = 1};
      if (glevEvaluate(plan, &beside) != GLEV_SUCCESS) return 0;
    }
  return 1;
}

static int evaluate(const glev_plan* plan, int segments, teapot_vertex* vertices) {
  const size_t count = (size_t)(segments + 1) * (size_t)(segments + 1);
  const glev_output position = output(vertices->position, count), normal = output(vertices->normal, count);
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &position},
                                           {GLEV_ATTRIBUTE_NORMAL, &normal}};
  glev_mesh mesh = {
      .size = sizeof mesh, .i2 = segments, .j2 = segments, .outputs = outputs, .output_count = 2};
  mesh.scratch_size = glevGetMeshScratchSize(plan, &mesh);
  mesh.scratch = malloc(mesh.scratch_size);
  const int done = (mesh.scratch || mesh.scratch_size == 0) && glevEvaluateMesh(plan, &mesh) == GLEV_SUCCESS;
  free(mesh.scratch);
  return done && fill_poles(plan, segments, vertices);
}

/* The GL's meshes are clockwise where p_u x p_v points to the viewer: the last two of each three change
 * places. */
static int index_triangles(int segments, size_t first, size_t count, unsigned* indices) {
  const glev_indices triangles = {.size = sizeof triangles,
                                  .mode = GLEV_FILL,
                                  .columns = (size_t)segments + 1,
                                  .rows = (size_t)segments + 1,
                                  .first = first,
                                  .type = GLEV_UNSIGNED_INT,
                                  .data = indices,
                                  .data_size = count * sizeof *indices};
  if (glevGetIndices(&triangles) != GLEV_SUCCESS) return 0;
  for (size_t i = 0; i < count; i += 3) {
    const unsigned second = indices[i + 1];
    indices[i + 1] = indices[i + 2];
    indices[i + 2] = second;
  }
  return 1;
}

static int fill(glev_context* gl, int segments, teapot_mesh* mesh) {
  const size_t vertices = mesh->vertex_count / TEAPOT_PATCHES, indices = mesh->index_count / TEAPOT_PATCHES;
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glevMapGrid2f(gl, segments, 0, 1, segments, 0, 1);
  for (size_t patch = 0; patch < TEAPOT_PATCHES; ++patch) {
    float points[4][4][3];
    teapot_patch((int)patch, points);
    glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, &points[0][0][0]);

    glev_plan* plan;
    const glev_plan_info info = {.size = sizeof info, .dimension = 2};
    if (glevCreatePlan(gl, &info, &plan) != GLEV_SUCCESS) return 0;
    const int done = evaluate(plan, segments, mesh->vertices + patch * vertices);
    glevReleasePlan(plan);
    if (!done || !index_triangles(segments, patch * vertices, indices, mesh->indices + patch * indices))
      return 0;
  }
  return glevGetError(gl) == GLEV_NO_ERROR;
}

int teapot_create_mesh(int segments, teapot_mesh* mesh) {
  const size_t n = (size_t)segments;
  mesh->vertex_count = TEAPOT_PATCHES * (n + 1) * (n + 1);
  mesh->index_count = TEAPOT_PATCHES * n * n * 6;
  mesh->vertices = calloc(mesh->vertex_count, sizeof *mesh->vertices);
  mesh->indices = calloc(mesh->index_count, sizeof *mesh->indices);
  glev_context* gl = NULL;
  const int done = mesh->vertices && mesh->indices && glevCreateContext(NULL, &gl) == GLEV_SUCCESS &&
                   fill(gl, segments, mesh);
  glevDestroyContext(gl);
  if (!done) teapot_free_mesh(mesh);
  return done;
}

void teapot_free_mesh(teapot_mesh* mesh) {
  free(mesh->vertices);
  free(mesh->indices);
  mesh->vertices = NULL;
  mesh->indices = NULL;
}
