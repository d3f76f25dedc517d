// Makes plans: selects the maps that have precedence, prepares them, and computes the nets of automatic
// normals.
#include "plan.h"

#include <algorithm>
#include <new>

#include "derivatives.h"
#include "mutation_point.h"

namespace {

using glev::Allocator, glev::Attribute, glev::kAttributes, glev::kCacheLine, glev::kSlots, glev::round_up,
    glev::Map, glev::Derivative, glev::kDerivatives;

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

constexpr std::array<Derivative, 2> kTangents = {kDerivatives[0], kDerivatives[1]};

// The slots that a plan evaluates, -1 for attributes without a map.
struct Winners {
  explicit Winners(const glev_plan::Source& source) {
    for (int a = 0; a < kAttributes; ++a)
      winners[a] = winning_slot(static_cast<Attribute>(a), source.enabled);
    vertex_slot = GLEV_AT(slot_of_vertices, winners[static_cast<std::size_t>(Attribute::kVertex)]);
    automatic_normals = source.automatic_normals && vertex_slot >= 0;
    if (automatic_normals)
      winners[static_cast<std::size_t>(Attribute::kNormal)] = GLEV_AT(slot_of_normals, -1);
    derivatives = source.derivatives && vertex_slot >= 0;
  }

  std::array<int, kAttributes> winners;
  int vertex_slot;
  bool automatic_normals, derivatives;
};

// Returns the number of values of the control points of a tangent.
std::size_t values_of_tangent(const Map& map, int slot, const Derivative& tangent) {
  return values_of({map.order(0) - tangent[0], map.order(1) - tangent[1]}, map.components(slot));
}

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
  if (all.vertex_slot < 0) return bytes;
  const Map& map = source.maps[all.vertex_slot];
  if (all.derivatives)
    bytes += bytes_of(values_of({map.order(0), map.order(1)}, map.components(all.vertex_slot)));
  for (const Derivative& tangent : kTangents)
    bytes += all.automatic_normals ? bytes_of(values_of_tangent(map, all.vertex_slot, tangent)) : 0;
  return bytes;
}

glev_plan* glev_plan::create(const Allocator& allocator, const Source& source) {
  const std::size_t bytes = bytes_for(source);
  void* memory = allocator.allocate(bytes, kCacheLine);
  return memory == nullptr ? nullptr : create_at(memory, bytes, allocator, source);
}

glev_plan* glev_plan::create_at(void* memory, std::size_t bytes, const Allocator& allocator,
                                const Source& source) {
  const auto [winners, vertex_slot, automatic_normals, derivatives] = Winners(source);
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
    const double* points = GLEV_AT(points_of_slot, map.points(slot));
    const std::array<glev::Domain, 2> domain = {map.domain(0), map.domain(1)};
    double *const scaled = take(values_of(order, components)),
                  *const lowest = take(values_of(order, components)),
                  *const centred = take(centred_values_of(map));
    plan->maps_[a] =
        glev::prepare_map(points, order, components, GLEV_AT(domain_of_map, domain), scaled, lowest, centred);
    plan->maps_[a].encloses = source.kernels->encloses;
  }

  plan->automatic_normals_ = automatic_normals;
  plan->has_vertices_only_ = !automatic_normals;
  for (int a = 1; a < kAttributes; ++a) plan->has_vertices_only_ = plan->has_vertices_only_ && winners[a] < 0;
  const glev::PreparedMap& vertices = plan->map(GLEV_AT(map_of_tangents, Attribute::kVertex));
  if (plan->has_vertices_only_ && vertices.is_direct) {
    const auto [n, m] = vertices.surface.degree;
    const auto [inverse_u, inverse_v] = vertices.inverse_width;
    plan->direct_ = source.kernels->direct;
    if (n == 3 && m == 0 && inverse_u != 0) plan->direct_ = source.kernels->direct_cubic_curve;
    if (n == 3 && m == 3 && inverse_u != 0 && inverse_v != 0) plan->direct_ = source.kernels->direct_bicubic;
  }
  if (vertex_slot < 0) return plan;
  const Map& map = source.maps[vertex_slot];
  const std::array<int, 2> order = {map.order(0), map.order(1)};
  const int components = map.components(vertex_slot);
  const double* const points = map.points(vertex_slot);
  if (derivatives) {
    double* const copy = take(values_of(order, components));
    std::copy_n(points, values_of(order, components), copy);
    plan->points_ = copy;
  }
  if (!automatic_normals) return plan;
  glev::NormalMajorants largest{};
  for (const std::size_t d : {0, 1}) {
    const Derivative& tangent = kTangents[d];
    const std::array<int, 2> own = {order[0] - tangent[0], order[1] - tangent[1]};
    if (own[d] < 1) continue;
    double* const net = take(values_of(own, components));
    largest[glev::kTangentU + d] =
        glev::differences_of(points, order, components, tangent, 0, components, net);
    GLEV_AT(scale_tangent, glev::scale_by_binomials(net, own, components, net));
    plan->tangents_[d] = {{own[0] - 1, own[1] - 1}, components, {map.domain(0), map.domain(1)}, net};
  }
  for (std::size_t k = 0; k < 4; ++k) largest[glev::kPoint][k] = vertices.component[k].largest;
  plan->normal_bounds_ = glev::bound_normals(vertices.surface, largest);
  return plan;
}

void glev_plan::release() const {
  if (references_.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const Allocator allocator = allocator_;
  const std::size_t bytes = bytes_;
  this->~glev_plan();
  allocator.release(const_cast<glev_plan*>(this), bytes, kCacheLine);
}
