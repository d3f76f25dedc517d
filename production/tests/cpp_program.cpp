// Uses glevaluator.hpp in a program without exceptions and run-time type information.
#include <glevaluator.hpp>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#define CHECK(condition)                                                    \
  do {                                                                      \
    if (!(condition)) {                                                     \
      std::fprintf(stderr, "line %d: %s is false\n", __LINE__, #condition); \
      std::exit(EXIT_FAILURE);                                              \
    }                                                                       \
  } while (false)

namespace {

namespace glv = glevaluator;

struct Vertex {
  float position[3];
  float normal[3];
};

// Returns two bicubic patches that share an edge, u = 1 of the first one.
std::vector<float> two_patches() {
  std::vector<float> points;
  for (int p = 0; p < 2; ++p) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const int x = 3 * p + i;
        for (int value : {x, j, x * x - j * x}) points.push_back(static_cast<float>(value));
      }
    }
  }
  return points;
}

void check_patches() {
  const std::vector<float> points = two_patches();
  const glev_patches patches = glv::make_patches<float>(points, 3, 4, 4);
  CHECK(patches.count == 2);
  std::vector<Vertex> vertices(2 * 9 * 5);
  glv::Outputs outputs;
  outputs.add(GLEV_ATTRIBUTE_VERTEX, std::span(vertices), &Vertex::position)
      .add(GLEV_ATTRIBUTE_NORMAL, std::span(vertices), &Vertex::normal);
  glv::Scratch scratch;
  CHECK(glv::evaluate(patches, glv::make_uniform_grid(8, 4), outputs, scratch) == GLEV_SUCCESS);
  CHECK(vertices.back().position[0] == 6 && vertices.back().position[1] == 3);
  CHECK(vertices.back().normal[2] != 0);

  // Vertices on the common edge have equal bits, but different normals.
  glev_indices indices = glv::make_indices(9, 5, 2);
  std::vector<std::uint16_t> all(glevGetIndexCount(&indices)), shared(all.size());
  CHECK(all.size() == 2u * 8 * 4 * 6);
  CHECK(glv::get_indices<std::uint16_t>(indices, all, scratch) == GLEV_SUCCESS);
  glv::share_vertices<Vertex>(indices, vertices);
  indices.vertex_bytes = sizeof(Vertex::position);
  CHECK(glv::get_indices<std::uint16_t>(indices, shared, scratch) == GLEV_SUCCESS);
  std::size_t differ = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK(std::memcmp(vertices[all[k]].position, vertices[shared[k]].position, sizeof(Vertex::position)) ==
          0);
    differ += all[k] != shared[k];
  }
  CHECK(differ != 0);
  CHECK(glv::get_indices<std::uint16_t>(indices, std::span(shared).first(1), scratch) ==
        GLEV_ERROR_BUFFER_TOO_SMALL);

  // Edges with other numbers of segments, and all derivatives.
  const glev_patch_grid edges = glv::make_edge_grid(4, 3, {1, 2, 3, 5});
  const std::size_t of_patch = 3 * 2 + 11;
  std::vector<float> values(9 * 2 * of_patch * 3);
  glv::Outputs of_edges;
  for (int attribute = GLEV_ATTRIBUTE_VERTEX; attribute <= GLEV_ATTRIBUTE_SECOND_VV; ++attribute) {
    if (attribute == GLEV_ATTRIBUTE_COLOR || attribute == GLEV_ATTRIBUTE_TEXCOORD) continue;
    const auto own = static_cast<std::size_t>(attribute) * 2 * of_patch * 3;
    of_edges.add(static_cast<glev_attribute>(attribute), std::span(values).subspan(own, 2 * of_patch * 3), 3);
  }
  CHECK(glv::evaluate(patches, edges, of_edges, scratch) == GLEV_SUCCESS);
  CHECK(std::memcmp(&values[6 * 3], vertices[0].position, 12) == 0);  // the first point of the boundary
  glev_indices of_grid = glv::make_indices(edges, 2);
  std::vector<std::uint16_t> around(glevGetIndexCount(&of_grid));
  CHECK(around.size() == 2u * 3 * (2 * (3 * 2 - 1) + 11));
  CHECK(glv::get_indices<std::uint16_t>(of_grid, around, scratch) == GLEV_SUCCESS);

  // Evaluates the same points with lists of arguments and scattered.
  const std::vector<double> u = {0, 0.5, 1}, v = {0, 1};
  std::vector<float> by_lists(2 * 6 * 3), scattered(6 * 3);
  glv::Outputs to_lists;
  to_lists.add(GLEV_ATTRIBUTE_VERTEX, std::span(by_lists), 3);
  CHECK(glv::evaluate(patches, glv::make_list_grid<double>(u, v), to_lists, scratch) == GLEV_SUCCESS);
  CHECK(std::memcmp(&by_lists[3], vertices[4].position, 12) == 0);
  const std::vector<glev_uint> numbers(6, 1);
  const std::vector<double> all_u = {0, 0.5, 1, 0, 0.5, 1}, all_v = {0, 0, 0, 1, 1, 1};
  glv::Outputs to_scattered;
  to_scattered.add(GLEV_ATTRIBUTE_VERTEX, std::span(scattered), 3);
  CHECK(glv::evaluate(patches, glv::make_scattered_grid<double>(numbers, all_u, all_v), to_scattered,
                      scratch) == GLEV_SUCCESS);
  CHECK(std::memcmp(scattered.data(), &by_lists[18], 18 * sizeof(float)) == 0);
  CHECK(glv::evaluate(patches, glv::make_scattered_grid<double>(numbers, v, all_v), to_scattered, scratch) ==
        GLEV_ERROR_BUFFER_TOO_SMALL);
}

void check_plans() {
  static const float kPoints[] = {0, 0, 0, 1, 2, 0, 3, 2, 0, 4, 0, 0};
  const glev_patches curve = glv::make_patches<float>(kPoints, 3, 4, 1);
  glev_map_info info{};
  info.size = sizeof info;
  info.target = GLEV_MAP1_VERTEX_3;
  info.map = &curve;
  info.u_segments = 2;
  glv::Plan plan;
  CHECK(!plan && plan.result() == GLEV_ERROR_INVALID_ARGUMENT);
  {
    const glv::Plan first(info);
    CHECK(first && first.result() == GLEV_SUCCESS);
    plan = first;
  }
  CHECK(plan.components(GLEV_ATTRIBUTE_VERTEX) == 3);
  const std::vector<float> u = {0, 0.5F, 1};
  std::vector<float> results(9), mesh_results(9);
  glv::Outputs outputs, mesh_outputs;
  outputs.add(GLEV_ATTRIBUTE_VERTEX, std::span(results), 3);
  mesh_outputs.add(GLEV_ATTRIBUTE_VERTEX, std::span(mesh_results), 3);
  CHECK(glv::evaluate<float>(plan, u, {}, outputs) == GLEV_SUCCESS);
  CHECK(results[3] == 2 && results[4] == 1.5F);
  glv::Scratch scratch;
  glev_mesh mesh{};
  mesh.i2 = 2;
  CHECK(glv::evaluate_mesh(plan, mesh, mesh_outputs, scratch) == GLEV_SUCCESS);
  CHECK(results == mesh_results);
  CHECK(glv::evaluate<float>(plan, u, std::span(u).first(1), outputs) == GLEV_ERROR_INVALID_ARGUMENT);
  CHECK(glv::evaluate<float>(glv::Plan(), u, {}, outputs) == GLEV_ERROR_INVALID_ARGUMENT);
  outputs.add(GLEV_ATTRIBUTE_VERTEX, std::span(mesh_results), 3);
  CHECK(glv::evaluate<float>(plan, u, {}, outputs) == GLEV_ERROR_INVALID_ARGUMENT);
  for (int k = 0; k < 20; ++k) outputs.add(GLEV_ATTRIBUTE_VERTEX, std::span(results), 3);
  CHECK(glv::evaluate<float>(plan, u, {}, outputs) == GLEV_ERROR_INVALID_ARGUMENT);

  const glv::Context context;
  CHECK(context && context.result() == GLEV_SUCCESS);
  glevMap1f(context.get(), GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, kPoints);
  glevEnable(context.get(), GLEV_MAP1_VERTEX_3);
  glv::Plan of_context(context, 1), moved(std::move(of_context));
  CHECK(moved && moved.result() == GLEV_SUCCESS && !of_context && of_context.result() != GLEV_SUCCESS);
  glv::Outputs again;
  again.add(GLEV_ATTRIBUTE_VERTEX, std::span(mesh_results), 3);
  mesh_results.assign(9, 0);
  CHECK(glv::evaluate<float>(moved, u, {}, again) == GLEV_SUCCESS);
  CHECK(results == mesh_results);
  glev_context_info wrong{};
  wrong.size = sizeof wrong;
  wrong.target = "no such machine";
  const glv::Context none(&wrong);
  CHECK(!none && none.result() == GLEV_ERROR_INVALID_ARGUMENT);
  CHECK(!glv::Plan(none, 1));
}

}  // namespace

int main() {
  check_patches();
  check_plans();
}
