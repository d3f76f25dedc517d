// Makes plans: selects the maps that have precedence, prepares them, and computes the nets of tangents.
#include "plan.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace {

using glev::Allocator, glev::Attribute, glev::kAttributes, glev::kCacheLine, glev::kSlots, glev::round_up,
    glev::Map;

// Returns the enabled slot of the attribute with the highest precedence; -1 if none is enabled.
int winning_slot(Attribute attribute, std::span<const bool, kSlots> enabled) {
  const auto [first, last] = glev::slots_of(attribute);
  for (int slot = last; slot >= first; --slot) {
    if (enabled[slot]) return slot;
  }
  return -1;
}

std::size_t values_of(std::array<int, 2> order, int components) {
  return static_cast<std::size_t>(order[0]) * order[1] * components;
}

std::size_t centred_values_of(const Map& map) {
  if (std::max(map.order(0), map.order(1)) > glev::kMaxCentredDegree + 1) return 0;
  return static_cast<std::size_t>(glev::centred_values(map.order(0) - 1, map.order(1) - 1));
}

// Returns the size of an array of values, with padding that vectors may read.
std::size_t bytes_of(std::size_t values) { return round_up(sizeof(double) * (values + 3)); }

// Returns the orders of the derivative in one direction; the order in that direction is 0 if the derivative
// is zero.
std::array<int, 2> tangent_order(const Map& map, int direction) {
  std::array<int, 2> order = {map.order(0), map.order(1)};
  --order[direction];
  return order;
}

// Computes the control points of the derivative without the factor order - 1: differences of adjacent points.
void differences_of(const double* points, std::array<int, 2> order, int components, int direction,
                    double* result) {
  const auto row = static_cast<std::ptrdiff_t>(order[1]) * components;
  const std::ptrdiff_t next = direction == 0 ? row : components;
  const int rows = direction == 0 ? order[0] - 1 : order[0];
  const std::ptrdiff_t used = direction == 0 ? row : row - components;
  for (int i = 0; i < rows; ++i) {
    for (std::ptrdiff_t k = 0; k < used; ++k) *result++ = points[i * row + k + next] - points[i * row + k];
  }
}

// Returns the largest magnitude of each component; NaN counts as infinite.
std::array<double, 4> largest_of(const double* points, std::ptrdiff_t count, int components) {
  std::array<double, 4> largest{};
  for (std::ptrdiff_t i = 0; i < count * components; ++i) {
    double& own = largest[i % components];
    const double magnitude = std::fabs(points[i]);
    own = std::isnan(magnitude) ? HUGE_VAL : std::max(own, magnitude);
  }
  return largest;
}

// The slots that a plan evaluates, -1 for attributes without a map.
struct Winners {
  explicit Winners(const glev_plan::Source& source) {
    for (int a = 0; a < kAttributes; ++a)
      winners[a] = winning_slot(static_cast<Attribute>(a), source.enabled);
    vertex_slot = winners[static_cast<std::size_t>(Attribute::kVertex)];
    automatic_normals = source.automatic_normals && vertex_slot >= 0;
    if (automatic_normals) winners[static_cast<std::size_t>(Attribute::kNormal)] = -1;
    has_tangents = vertex_slot >= 0 && (source.tangents || automatic_normals);
  }

  std::array<int, kAttributes> winners;
  int vertex_slot;
  bool automatic_normals, has_tangents;
};

}  // namespace

std::size_t glev_plan::bytes_for(const Source& source) {
  const Winners all(source);
  std::size_t bytes = round_up(sizeof(glev_plan));
  for (const int slot : all.winners) {
    if (slot < 0) continue;
    const Map& map = source.maps[slot];
    bytes += 2 * bytes_of(values_of({map.order(0), map.order(1)}, map.components(slot)));
    bytes += bytes_of(centred_values_of(map));
  }
  if (all.has_tangents) {
    for (const int direction : {0, 1}) {
      const std::array<int, 2> order = tangent_order(source.maps[all.vertex_slot], direction);
      bytes += bytes_of(values_of(order, source.maps[all.vertex_slot].components(all.vertex_slot)));
    }
  }
  return bytes;
}

glev_plan* glev_plan::create(const Allocator& allocator, const Source& source) {
  const std::size_t bytes = bytes_for(source);
  void* memory = allocator.allocate(bytes, kCacheLine);
  return memory == nullptr ? nullptr : create_at(memory, bytes, allocator, source);
}

glev_plan* glev_plan::create_at(void* memory, std::size_t bytes, const Allocator& allocator,
                                const Source& source) {
  const auto [winners, vertex_slot, automatic_normals, has_tangents] = Winners(source);
  auto* plan = new (memory) glev_plan(allocator, bytes, source);

  auto* block = static_cast<std::byte*>(memory) + round_up(sizeof(glev_plan));
  const auto take = [&block](std::size_t values) {
    auto* net = reinterpret_cast<double*>(block);
    block += bytes_of(values);
    return net;
  };
  for (int a = 0; a < kAttributes; ++a) {
    const int slot = winners[a];
    if (slot < 0) continue;
    const Map& map = source.maps[slot];
    const int components = map.components(slot);
    const std::array<int, 2> order = {map.order(0), map.order(1)};
    const double* points = map.points(slot);
    const std::array<glev::Domain, 2> domain = {map.domain(0), map.domain(1)};
    double *const scaled = take(values_of(order, components)),
                  *const lowest = take(values_of(order, components)),
                  *const centred = take(centred_values_of(map));
    plan->maps_[a] = glev::prepare_map(points, order, components, domain, scaled, lowest, centred);
    plan->maps_[a].encloses = source.kernels->encloses;
  }

  plan->automatic_normals_ = automatic_normals;
  plan->has_vertices_only_ = !automatic_normals;
  for (int a = 1; a < kAttributes; ++a) plan->has_vertices_only_ = plan->has_vertices_only_ && winners[a] < 0;
  const glev::PreparedMap& vertices = plan->map(Attribute::kVertex);
  if (plan->has_vertices_only_ && vertices.is_direct) {
    plan->direct_ = source.kernels->direct;
    if (glev::has_direct_map(vertices)) {
      plan->direct_map_ = glev::direct_map_of(vertices);
      plan->direct_ = vertices.surface.degree[1] == 0 ? source.kernels->direct_cubic_curve
                                                      : source.kernels->direct_bicubic;
    }
  }
  glev::NormalMajorants largest{};
  for (const int direction : {0, 1}) {
    if (!has_tangents) break;
    const Map& map = source.maps[vertex_slot];
    const std::array<int, 2> order = tangent_order(map, direction);
    if (order[direction] == 0) continue;
    const int components = map.components(vertex_slot);
    double* net = take(values_of(order, components));
    differences_of(map.points(vertex_slot), {map.order(0), map.order(1)}, components, direction, net);
    const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(order[0]) * order[1];
    if (automatic_normals) largest[glev::kTangentU + direction] = largest_of(net, count, components);
    glev::scale_by_binomials(net, order, components, net);
    plan->tangents_[direction] = {
        {order[0] - 1, order[1] - 1}, components, {map.domain(0), map.domain(1)}, net};
  }
  if (automatic_normals) {
    for (std::size_t k = 0; k < 4; ++k) largest[glev::kPoint][k] = vertices.component[k].largest;
    plan->normal_bounds_ = glev::bound_normals(vertices.surface, largest);
  }
  return plan;
}

double glev_plan::tangent_factor(int direction) const {
  const glev::Surface& vertex = surface(Attribute::kVertex);
  const glev::Domain& domain = vertex.domain[direction];
  return vertex.degree[direction] / (domain.u2 - domain.u1);
}

void glev_plan::release() const {
  if (references_.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const Allocator allocator = allocator_;
  const std::size_t bytes = bytes_;
  this->~glev_plan();
  allocator.release(const_cast<glev_plan*>(this), bytes, kCacheLine);
}
