/* Writes the teapot as an OBJ file: teapot_obj FILE [SEGMENTS]
 * Adjacent patches have the same bits along their common edge, so glevGetIndices, which compares bits,
 * connects them to one surface. */
#include <glevaluator.h>
#include <stdio.h>
#include <stdlib.h>

#include "teapot_mesh.h"

/* Computes the number (from 1) of the position of each vertex. Returns 0 if a call fails or there is no
 * memory. */
static int number_positions(const teapot_mesh* mesh, unsigned* numbers) {
  glev_indices points = {.size = sizeof points,
                         .mode = GLEV_POINT,
                         .columns = mesh->vertex_count,
                         .rows = 1,
                         .type = GLEV_UNSIGNED_INT,
                         .vertices = mesh->vertices,
                         .vertices_size = mesh->vertex_count * sizeof *mesh->vertices,
                         .vertex_stride = sizeof *mesh->vertices,
                         .vertex_bytes = sizeof mesh->vertices->position,
                         .data = numbers,
                         .data_size = mesh->vertex_count * sizeof *numbers};
  points.scratch_size = glevGetIndexScratchSize(&points);
  points.scratch = malloc(points.scratch_size);
  const int done = points.scratch && glevGetIndices(&points) == GLEV_SUCCESS;
  free(points.scratch);
  /* Here, each number is that of the first vertex with this position. */
  unsigned count = 0;
  for (size_t i = 0; done && i < mesh->vertex_count; ++i)
    numbers[i] = numbers[i] == i ? ++count : numbers[numbers[i]];
  return done;
}

static int write_obj(FILE* file, const teapot_mesh* mesh, const unsigned* numbers) {
  fprintf(file, "# The teapot of Martin Newell, by glevaluator\n");
  unsigned written = 0;
  for (size_t i = 0; i < mesh->vertex_count; ++i) {
    if (numbers[i] <= written) continue;
    const float* p = mesh->vertices[i].position;
    fprintf(file, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
    written = numbers[i];
  }
  for (size_t i = 0; i < mesh->vertex_count; ++i) {
    const float* n = mesh->vertices[i].normal;
    fprintf(file, "vn %.9g %.9g %.9g\n", n[0], n[1], n[2]);
  }
  for (size_t i = 0; i < mesh->index_count; i += 3) {
    const unsigned *t = mesh->indices + i, a = numbers[t[0]], b = numbers[t[1]], c = numbers[t[2]];
    if (a == b || b == c || c == a) continue; /* at a pole */
    fprintf(file, "f %u//%u %u//%u %u//%u\n", a, t[0] + 1, b, t[1] + 1, c, t[2] + 1);
  }
  return !ferror(file);
}

int main(int argc, char** argv) {
  const int segments = argc > 2 ? atoi(argv[2]) : 16;
  if (argc < 2 || segments < 1 || segments > 1000) {
    fprintf(stderr, "usage: %s FILE [SEGMENTS]\n", argv[0]);
    return 2;
  }
  teapot_mesh mesh;
  if (!teapot_create_mesh(segments, &mesh)) return 1;
  unsigned* numbers = malloc(mesh.vertex_count * sizeof *numbers);
  FILE* file = fopen(argv[1], "w");
  int written = file && numbers && number_positions(&mesh, numbers) && write_obj(file, &mesh, numbers);
  if (file && fclose(file) != 0) written = 0;
  if (!written) fprintf(stderr, "cannot write %s\n", argv[1]);
  free(numbers);
  teapot_free_mesh(&mesh);
  return !written;
}
