// The kinds of evaluator maps, their initial values and their components.
#include <reference/acceptance.h>
#include <reference/map.h>

#include <array>

namespace evalcts::reference {
namespace {

// One row of GL 2.1 table 5.1 with the initial control point of section 5.1.
struct Kind {
  int components;
  std::array<double, 4> initial_point;
};

// The rows of the table in the order of the tokens (EV-INIT-COEFF-*).
constexpr std::array<Kind, kMapKinds> kKinds{{
    {4, {1, 1, 1, 1}},  // COLOR_4
    {1, {1}},           // INDEX
    {3, {0, 0, 1}},     // NORMAL
    {1, {0}},           // TEXTURE_COORD_1: the first of (0,0,0,1)
    {2, {0, 0}},        // TEXTURE_COORD_2
    {3, {0, 0, 0}},     // TEXTURE_COORD_3
    {4, {0, 0, 0, 1}},  // TEXTURE_COORD_4
    {3, {0, 0, 0}},     // VERTEX_3
    {4, {0, 0, 0, 1}},  // VERTEX_4
}};

// Returns the row of a target of either dimension; null for other values.
const Kind* kind(GLenum target) {
  if (is_map1_target(target)) return &kKinds[target - GL_MAP1_COLOR_4];
  if (is_map2_target(target)) return &kKinds[target - GL_MAP2_COLOR_4];
  return nullptr;
}

}  // namespace

bool is_map1_target(GLenum target) { return target >= GL_MAP1_COLOR_4 && target <= GL_MAP1_VERTEX_4; }
bool is_map2_target(GLenum target) { return target >= GL_MAP2_COLOR_4 && target <= GL_MAP2_VERTEX_4; }

int values_per_point(GLenum target) {
  const Kind* row = kind(target);
  return row == nullptr ? 0 : row->components;
}

int guaranteed_range(GLenum target, int version) {
  switch (target) {
    case GL_MAP1_COLOR_4:
    case GL_MAP2_COLOR_4:
      return kReducedRange;
    case GL_MAP1_TEXTURE_COORD_1:
    case GL_MAP1_TEXTURE_COORD_2:
    case GL_MAP1_TEXTURE_COORD_3:
    case GL_MAP1_TEXTURE_COORD_4:
    case GL_MAP2_TEXTURE_COORD_1:
    case GL_MAP2_TEXTURE_COORD_2:
    case GL_MAP2_TEXTURE_COORD_3:
    case GL_MAP2_TEXTURE_COORD_4:
      return version < 20 ? kReducedRange : kFullRange;
    default:
      return kFullRange;
  }
}

Surface Map::surface(int component) const {
  const std::ptrdiff_t k = components();
  return {points.data() + component, {k * v.order, u.order, u.first, u.last}, {k, v.order, v.first, v.last}};
}

std::vector<Surface> Map::surfaces() const {
  std::vector<Surface> all;
  for (int component = 0; component < components(); ++component) all.push_back(surface(component));
  return all;
}

Map initial_map(GLenum target) {
  const Kind& row = *kind(target);
  return {target, {}, {}, {row.initial_point.begin(), row.initial_point.begin() + row.components}, true};
}

}  // namespace evalcts::reference
