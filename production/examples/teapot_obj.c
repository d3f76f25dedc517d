/* Writes the teapot as an OBJ file: teapot_obj FILE [SEGMENTS]
 * Adjacent patches have the same bits along their common edge, so comparing bits is sufficient to connect
 * them to one surface. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "teapot_mesh.h"

static const teapot_mesh* sorted;

/* Orders vertices by the bits of their positions, and equal positions by the numbers of the vertices. */
static int compare(const void* a, const void* b) {
  const unsigned i = *(const unsigned*)a, j = *(const unsigned*)b;
  const int order = memcmp(sorted->vertices[i].position, sorted->vertices[j].position, 3 * sizeof(float));
  return order ? order : (i > j) - (i < j);
}

/* Computes the number (from 1) of the position of each vertex, and a list of one vertex for each position.
 * Returns the number of positions. */
static unsigned weld(const teapot_mesh* mesh, unsigned* numbers, unsigned* list) {
  unsigned count = 0;
  for (unsigned i = 0; i < mesh->vertex_count; ++i) list[i] = i;
  sorted = mesh;
  qsort(list, mesh->vertex_count, sizeof *list, compare);
  for (size_t i = 0; i < mesh->vertex_count; ++i) {
    const unsigned vertex = list[i];
    if (count == 0 || memcmp(mesh->vertices[vertex].position, mesh->vertices[list[count - 1]].position,
                             3 * sizeof(float)) != 0)
      list[count++] = vertex;
    numbers[vertex] = count;
  }
  return count;
}

static int write_obj(FILE* file, const teapot_mesh* mesh, const unsigned* numbers, const unsigned* list,
                     unsigned count) {
  fprintf(file, "# The teapot of Martin Newell, by glevaluator\n");
  for (unsigned i = 0; i < count; ++i) {
    const float* p = mesh->vertices[list[i]].position;
    fprintf(file, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
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
  unsigned* list = malloc(mesh.vertex_count * sizeof *list);
  FILE* file = fopen(argv[1], "w");
  int written = file && numbers && list && write_obj(file, &mesh, numbers, list, weld(&mesh, numbers, list));
  if (file && fclose(file) != 0) written = 0;
  if (!written) fprintf(stderr, "cannot write %s\n", argv[1]);
  free(numbers);
  free(list);
  teapot_free_mesh(&mesh);
  return !written;
}
