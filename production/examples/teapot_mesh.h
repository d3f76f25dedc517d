/* The teapot as one vertex buffer and one index buffer for glDrawElements. */
#ifndef TEAPOT_MESH_H_
#define TEAPOT_MESH_H_

#include <stddef.h>

typedef struct teapot_vertex {
  float position[3];
  float normal[3];
} teapot_vertex;

/* The mesh. Each patch has its own vertices; triangles are counterclockwise seen from outside. */
typedef struct teapot_mesh {
  size_t vertex_count, index_count;
  teapot_vertex* vertices;
  unsigned* indices;
} teapot_mesh;

/* Makes the mesh with segments x segments quadrilaterals for each patch. Returns 0, with nothing to free, if
 * a call fails or there is no memory. */
int teapot_create_mesh(int segments, teapot_mesh* mesh);
void teapot_free_mesh(teapot_mesh* mesh);

#endif /* TEAPOT_MESH_H_ */
