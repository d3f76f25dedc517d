/* A program with the structures of this version, linked to the library of this version, or to one whose
 * structures have more members (LIBRARY_IS_LATER). It checks that everything works, also from C, and that
 * nothing beyond the structures of this version is read or written. */
#include <glevaluator.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                               \
  do {                                                                 \
    if (!(condition)) {                                                \
      fprintf(stderr, "line %d: %s is false\n", __LINE__, #condition); \
      exit(EXIT_FAILURE);                                              \
    }                                                                  \
  } while (0)

/* Members must keep their offsets, which are given for 64-bit machines. */
#define AT(structure, member, offset)                                           \
  _Static_assert(sizeof(void*) != 8 || offsetof(structure, member) == (offset), \
                 #structure "." #member " has moved")
AT(glev_allocator, user, 8);
AT(glev_allocator, allocate, 16);
AT(glev_allocator, release, 24);
AT(glev_context_info, allocator, 8);
AT(glev_context_info, target, 16);
AT(glev_vertex, position, 8);
AT(glev_vertex, color, 24);
AT(glev_vertex, normal, 40);
AT(glev_vertex, texcoord, 52);
AT(glev_vertex, index, 180);
AT(glev_vertex, edge_flag, 184);
AT(glev_sink, user, 8);
AT(glev_sink, begin, 16);
AT(glev_sink, vertex, 24);
AT(glev_sink, end, 32);
AT(glev_plan_info, dimension, 8);
AT(glev_output, data, 8);
AT(glev_output, data_size, 16);
AT(glev_output, stride, 24);
AT(glev_output, components, 32);
AT(glev_output, type, 40);
AT(glev_output, row_stride, 48);
AT(glev_output, patch_stride, 56);
AT(glev_batch, count, 8);
AT(glev_batch, type, 16);
AT(glev_batch, precision, 20);
AT(glev_batch, u, 24);
AT(glev_batch, v, 48);
AT(glev_batch, outputs, 72);
AT(glev_batch, output_count, 80);
AT(glev_mesh, i1, 8);
AT(glev_mesh, j2, 20);
AT(glev_mesh, precision, 24);
AT(glev_mesh, outputs, 32);
AT(glev_mesh, output_count, 40);
AT(glev_mesh, scratch, 48);
AT(glev_mesh, scratch_size, 56);
AT(glev_indices, mode, 8);
AT(glev_indices, columns, 16);
AT(glev_indices, rows, 24);
AT(glev_indices, first, 32);
AT(glev_indices, type, 40);
AT(glev_indices, data, 48);
AT(glev_indices, data_size, 56);
AT(glev_indices, patches, 64);
AT(glev_indices, winding, 72);
AT(glev_indices, vertices, 80);
AT(glev_indices, vertices_size, 88);
AT(glev_indices, vertex_stride, 96);
AT(glev_indices, vertex_bytes, 104);
AT(glev_indices, scratch, 112);
AT(glev_indices, scratch_size, 120);
AT(glev_indices, edge_segments, 128);
AT(glev_patches, count, 8);
AT(glev_patches, components, 16);
AT(glev_patches, uorder, 24);
AT(glev_patches, vorder, 28);
AT(glev_patches, type, 32);
AT(glev_patches, points, 40);
AT(glev_patches, points_size, 48);
AT(glev_patches, u_stride, 56);
AT(glev_patches, v_stride, 64);
AT(glev_patches, patch_stride, 72);
AT(glev_patches, u1, 80);
AT(glev_patches, v2, 104);
AT(glev_patch_grid, kind, 8);
AT(glev_patch_grid, precision, 12);
AT(glev_patch_grid, u_segments, 16);
AT(glev_patch_grid, v_segments, 20);
AT(glev_patch_grid, u_count, 24);
AT(glev_patch_grid, v_count, 32);
AT(glev_patch_grid, type, 40);
AT(glev_patch_grid, limit_normals, 44);
AT(glev_patch_grid, u, 48);
AT(glev_patch_grid, v, 72);
AT(glev_patch_grid, patch, 96);
AT(glev_patch_grid, target, 120);
AT(glev_patch_grid, edge_segments, 128);
AT(glev_map_info, target, 8);
AT(glev_map_info, map, 16);
AT(glev_map_info, u_segments, 24);
AT(glev_map_info, v_segments, 28);
AT(glev_map_info, auto_normal, 32);
AT(glev_map_info, allocator, 40);
AT(glev_map_info, instruction_set, 48);
_Static_assert(sizeof(glev_input) == 3 * sizeof(size_t), "glev_input has changed");
_Static_assert(sizeof(glev_attribute_output) == 2 * sizeof(void*), "glev_attribute_output has changed");

/* A structure followed by bytes that do not belong to it, where a later version may have members. */
#define FOLLOWED(structure) \
  struct {                  \
    structure it;           \
    unsigned char rest[64]; \
  }
#define MAKE(structure, name)          \
  FOLLOWED(structure) name;            \
  memset(&name, 0xAB, sizeof name);    \
  memset(&name.it, 0, sizeof name.it); \
  name.it.size = sizeof name.it

static int allocations, vertices;

static void* allocate(void* user, size_t bytes, size_t alignment) {
  CHECK(user == &allocations);
  ++allocations;
  return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
static void release(void* user, void* memory, size_t bytes, size_t alignment) {
  (void)bytes, (void)alignment;
  CHECK(user == &allocations);
  free(memory);
}
static void on_vertex(void* user, const glev_vertex* vertex) {
  CHECK(user == &vertices);
#ifdef LIBRARY_IS_LATER
  CHECK(vertex->size > sizeof *vertex);
#else
  CHECK(vertex->size == sizeof *vertex);
#endif
  CHECK(vertex->position[0] == 2 && vertex->position[1] == 1.5f && vertex->position[3] == 1);
  ++vertices;
}

/* Longer than 100 lines, because it is one program that uses each structure of the header. */
int main(void) {
  static const float kPoints[4][3] = {{0, 0, 0}, {1, 2, 0}, {3, 2, 0}, {4, 0, 0}};
  static const float kU[3] = {0, 0.5f, 1};

  MAKE(glev_allocator, allocator);
  allocator.it.user = &allocations;
  allocator.it.allocate = allocate;
  allocator.it.release = release;
  MAKE(glev_context_info, context_info);
  context_info.it.allocator = &allocator.it;
  glev_context* gl;
  CHECK(glevCreateContext(&context_info.it, &gl) == GLEV_SUCCESS);
  CHECK(allocations > 0);

  MAKE(glev_sink, sink);
  sink.it.user = &vertices;
  sink.it.vertex = on_vertex;
  CHECK(glevSetSink(gl, &sink.it) == GLEV_SUCCESS);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, &kPoints[0][0]);
  glevMapGrid1f(gl, 2, 0, 1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord1f(gl, 0.5f);
  glevEnd(gl);
  CHECK(vertices == 1);

  /* The curve is the edge v = 0 of a surface, which is drawn by a display list. */
  static const float kPatch[4][2][3] = {
      {{0, 0, 0}, {0, 0, 1}}, {{1, 2, 0}, {1, 2, 1}}, {{3, 2, 0}, {3, 2, 1}}, {{4, 0, 0}, {4, 0, 1}}};
  const glev_uint list = glevGenLists(gl, 1);
  glevNewList(gl, list, GLEV_COMPILE);
  glevPushAttrib(gl, GLEV_EVAL_BIT);
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 6, 4, 0, 1, 3, 2, &kPatch[0][0][0]);
  glevMapGrid2f(gl, 2, 0, 1, 1, 0, 1);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glevEvalMesh2(gl, GLEV_LINE, 1, 1, 0, 0);
  glevPopAttrib(gl);
  glevEndList(gl);
  glevCallList(gl, list);
  CHECK(vertices == 3); /* a line along u, a line along v, of one vertex each */
  CHECK(glevIsEnabled(gl, GLEV_AUTO_NORMAL) == GLEV_FALSE && glevGetError(gl) == GLEV_NO_ERROR);

  MAKE(glev_plan_info, plan_info);
  plan_info.it.dimension = 1;
  glev_plan* plan;
  CHECK(glevCreatePlan(gl, &plan_info.it, &plan) == GLEV_SUCCESS);

  float results[3][3] = {{0}}, again[3][3] = {{0}};
  MAKE(glev_output, output);
  output.it.data = results;
  output.it.data_size = sizeof results;
  output.it.stride = sizeof results[0];
  output.it.components = 3;
  const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &output.it}};
  MAKE(glev_batch, batch);
  batch.it.count = 3;
  batch.it.type = GLEV_FLOAT;
  batch.it.u.data = kU;
  batch.it.u.data_size = sizeof kU;
  batch.it.u.stride = sizeof kU[0];
  batch.it.outputs = outputs;
  batch.it.output_count = 1;
  CHECK(glevEvaluate(plan, &batch.it) == GLEV_SUCCESS);
  CHECK(results[1][0] == 2 && results[1][1] == 1.5f && results[2][0] == 4);

  output.it.data = again;
  MAKE(glev_mesh, mesh);
  mesh.it.i2 = 2;
  mesh.it.outputs = outputs;
  mesh.it.output_count = 1;
  mesh.it.scratch_size = glevGetMeshScratchSize(plan, &mesh.it);
  mesh.it.scratch = malloc(mesh.it.scratch_size);
  CHECK(glevEvaluateMesh(plan, &mesh.it) == GLEV_SUCCESS);
  CHECK(memcmp(results, again, sizeof results) == 0);

  unsigned short numbers[6];
  MAKE(glev_indices, indices);
  indices.it.mode = GLEV_FILL;
  indices.it.columns = indices.it.rows = 2;
  indices.it.type = GLEV_UNSIGNED_SHORT;
  indices.it.data = numbers;
  indices.it.data_size = sizeof numbers;
  CHECK(glevGetIndexCount(&indices.it) == 6);
  CHECK(glevGetIndices(&indices.it) == GLEV_SUCCESS);
  CHECK(numbers[5] == 3);

  /* A program of a version before patches. */
  output.it.size = offsetof(glev_output, patch_stride);
  indices.it.size = offsetof(glev_indices, patches);
  CHECK(glevEvaluateMesh(plan, &mesh.it) == GLEV_SUCCESS);
  CHECK(glevGetIndices(&indices.it) == GLEV_SUCCESS);
  output.it.size = sizeof output.it;
  free(mesh.it.scratch);

  MAKE(glev_patches, patches);
  patches.it.count = 1;
  patches.it.components = 3;
  patches.it.uorder = 4;
  patches.it.vorder = 1;
  patches.it.type = GLEV_FLOAT;
  patches.it.points = kPoints;
  patches.it.points_size = sizeof kPoints;
  MAKE(glev_patch_grid, grid);
  grid.it.u_segments = 2;
  memset(again, 0, sizeof again);
  mesh.it.scratch_size = glevGetPatchScratchSize(&patches.it, &grid.it);
  mesh.it.scratch = malloc(mesh.it.scratch_size);
  CHECK(glevEvaluatePatches(&patches.it, &grid.it, outputs, 1, mesh.it.scratch, mesh.it.scratch_size) ==
        GLEV_SUCCESS);
  free(mesh.it.scratch);
  CHECK(memcmp(results, again, sizeof results) == 0);
  MAKE(glev_map_info, map);
  map.it.target = GLEV_MAP1_VERTEX_3;
  map.it.map = &patches.it;
  glev_plan* of_map;
  CHECK(glevCreatePlanFromMap(&map.it, &of_map) == GLEV_SUCCESS);
  memset(again, 0, sizeof again);
  CHECK(glevEvaluate(of_map, &batch.it) == GLEV_SUCCESS);
  CHECK(memcmp(results, again, sizeof results) == 0);
  glevReleasePlan(of_map);

  /* A structure that is smaller than in any version is rejected. */
  --batch.it.size;
  CHECK(glevEvaluate(plan, &batch.it) == GLEV_ERROR_STRUCTURE_SIZE);
  glevReleasePlan(plan);
  glevDestroyContext(gl);
  return EXIT_SUCCESS;
}
