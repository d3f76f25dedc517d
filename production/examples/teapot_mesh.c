/* Computes the vertices and indices of the teapot. */
#include "teapot_mesh.h"

#include <glevaluator.h>
#include <stdlib.h>

#include "teapot_patches.h"

/* Evaluates vertices and normals of all patches in one call, and computes their indices in another. At a
 * pole, a whole edge of a patch is one point, and the normals are limits. Triangles are counterclockwise if
 * the normals point to the viewer. */
static int fill(int segments, teapot_mesh* mesh) {
  float points[TEAPOT_PATCHES][4][4][3];
  for (int patch = 0; patch < TEAPOT_PATCHES; ++patch) teapot_patch(patch, points[patch]);
  const size_t side = (size_t)segments + 1, stride = sizeof(teapot_vertex),
               size = mesh->vertex_count * stride;
  const glev_patches patches = {.size = sizeof patches,
                                .count = TEAPOT_PATCHES,
                                .components = 3,
                                .uorder = 4,
                                .vorder = 4,
                                .type = GLEV_FLOAT,
                                .points = points,
                                .points_size = sizeof points,
                                .u_stride = sizeof points[0][0][0],
                                .v_stride = sizeof points[0][0],
                                .patch_stride = sizeof points[0]};
  const glev_patch_grid grid = {
      .size = sizeof grid, .u_segments = segments, .v_segments = segments, .limit_normals = 1};
  const glev_output position = {.size = sizeof position,
                                .data = mesh->vertices->position,
                                .data_size = size,
                                .stride = stride,
                                .components = 3},
                    normal = {.size = sizeof normal,
                              .data = mesh->vertices->normal,
                              .data_size = size - sizeof mesh->vertices->position,
                              .stride = stride,
                              .components = 3};
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &position},
                                           {GLEV_ATTRIBUTE_NORMAL, &normal}};
  const glev_indices triangles = {.size = sizeof triangles,
                                  .mode = GLEV_FILL,
                                  .columns = side,
                                  .rows = side,
                                  .patches = TEAPOT_PATCHES,
                                  .winding = GLEV_CCW,
                                  .type = GLEV_UNSIGNED_INT,
                                  .data = mesh->indices,
                                  .data_size = mesh->index_count * sizeof *mesh->indices};
  const size_t scratch_size = glevGetPatchScratchSize(&patches, &grid);
  void* const scratch = malloc(scratch_size);
  const int done = scratch != NULL &&
                   glevEvaluatePatches(&patches, &grid, outputs, 2, scratch, scratch_size) == GLEV_SUCCESS &&
                   glevGetIndices(&triangles) == GLEV_SUCCESS;
  free(scratch);
  return done;
}

int teapot_create_mesh(int segments, teapot_mesh* mesh) {
  const size_t n = (size_t)segments;
  mesh->vertex_count = TEAPOT_PATCHES * (n + 1) * (n + 1);
  mesh->index_count = TEAPOT_PATCHES * n * n * 6;
  mesh->vertices = calloc(mesh->vertex_count, sizeof *mesh->vertices);
  mesh->indices = calloc(mesh->index_count, sizeof *mesh->indices);
  const int done = mesh->vertices && mesh->indices && fill(segments, mesh);
  if (!done) teapot_free_mesh(mesh);
  return done;
}

void teapot_free_mesh(teapot_mesh* mesh) {
  free(mesh->vertices);
  free(mesh->indices);
  mesh->vertices = NULL;
  mesh->indices = NULL;
}
