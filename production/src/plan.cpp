// Makes plans: selects the maps that have precedence, prepares them, and computes the nets of derivatives.
#include "plan.h"

#include <algorithm>
#include <cmath>
#include <new>

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

// Returns the orders of the net of a derivative; 0 or less if the derivative is zero everywhere.
std::array<int, 2> derivative_order(const Map& map, const Derivative& derivative) {
  return {map.order(0) - derivative[0], map.order(1) - derivative[1]};
}

std::size_t values_of_derivative(const Map& map, int slot, const Derivative& derivative) {
  const auto [columns, rows] = derivative_order(map, derivative);
  return columns < 1 || rows < 1 ? 0 : values_of({columns, rows}, map.components(slot));
}

// Computes the control points of a derivative without its factor, and the largest sum of the magnitudes of
// the differences of first order, for each component; NaN counts as infinite.
std::array<double, 4> differences_of(const double* points, std::array<int, 2> order, int components,
                                     const Derivative& derivative, double* result) {
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(order[1]) * components;
  const std::ptrdiff_t first = derivative[0] > 0 ? row : components,
                       second = derivative[1] > 0 ? components : row;
  const bool is_second = derivative[0] + derivative[1] == 2;
  std::array<double, 4> largest{};
  for (int i = 0; i < order[0] - derivative[0]; ++i) {
    for (int j = 0; j < order[1] - derivative[1]; ++j) {
      for (int k = 0; k < components; ++k) {
        const double* const own = points + i * row + j * components + k;
        const double near = own[first] - own[0], far = is_second ? own[first + second] - own[second] : 0;
        const double magnitude = std::fabs(near) + std::fabs(far);
        largest[k] = std::isnan(magnitude) ? HUGE_VAL : std::max(largest[k], magnitude);
        *result++ = is_second ? far - near : near;
      }
    }
  }
  return largest;
}

// Computes the factor and the error bound of a derivative. The rounding errors, in units of 2^-53 times the
// largest sum of differences, are 13 (n + m) + 8 of the evaluation, 3 of the differences, 4 of the binomials,
// and 6 of the factor and its product; see bernstein.h.
void bound_derivative(const std::array<int, 2>& degree, const Derivative& derivative,
                      const std::array<double, 4>& largest, glev::DerivativeMap* map) {
  map->factor = 1;
  bool is_ordinary = true;
  for (const std::size_t d : {0, 1}) {
    const glev::Domain& domain = map->net.domain[d];
    double width = 1;
    int count = 1;
    for (int k = 0; k < derivative[d]; ++k) count *= degree[d] - k, width *= domain.u2 - domain.u1;
    map->factor *= count / width;
    is_ordinary = is_ordinary && (degree[d] == 0 || glev::is_ordinary(domain));
  }
  const double size = std::fabs(map->factor);
  is_ordinary = is_ordinary && size >= 0x1p-300 && size <= 0x1p300;
  const auto [n, m] = map->net.degree;
  for (std::size_t k = 0; k < largest.size(); ++k) {
    const bool has_bound = is_ordinary && largest[k] >= 0x1p-300 && largest[k] <= 0x1p300;
    const double units = (13 * (n + m) + 24) * (1 + 0x1p-20);
    map->error[k] = largest[k] == 0 ? 0 : has_bound ? units * 0x1p-53 * largest[k] * size : HUGE_VAL;
  }
}

// The slots that a plan evaluates, -1 for attributes without a map.
struct Winners {
  explicit Winners(const glev_plan::Source& source) {
    for (int a = 0; a < kAttributes; ++a)
      winners[a] = winning_slot(static_cast<Attribute>(a), source.enabled);
    vertex_slot = winners[static_cast<std::size_t>(Attribute::kVertex)];
    automatic_normals = source.automatic_normals && vertex_slot >= 0;
    if (automatic_normals) winners[static_cast<std::size_t>(Attribute::kNormal)] = -1;
    if (vertex_slot >= 0 && automatic_normals) derivatives = glev::kTangents;
    if (vertex_slot >= 0 && source.derivatives) derivatives = static_cast<int>(glev::kDerivatives.size());
  }

  std::array<int, kAttributes> winners;
  int vertex_slot;
  bool automatic_normals;
  int derivatives = 0;  // number of derivatives
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
  for (int number = 0; number < all.derivatives; ++number)
    bytes +=
        bytes_of(values_of_derivative(source.maps[all.vertex_slot], all.vertex_slot, kDerivatives[number]));
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
  for (int number = 0; number < derivatives; ++number) {
    const Map& map = source.maps[vertex_slot];
    const Derivative& derivative = kDerivatives[number];
    const std::array<int, 2> order = derivative_order(map, derivative);
    if (order[0] < 1 || order[1] < 1) continue;
    const int components = map.components(vertex_slot);
    double* const net = take(values_of(order, components));
    const std::array<double, 4> own =
        differences_of(map.points(vertex_slot), {map.order(0), map.order(1)}, components, derivative, net);
    if (number < glev::kTangents) largest[glev::kTangentU + number] = own;
    glev::scale_by_binomials(net, order, components, net);
    glev::DerivativeMap& result = plan->derivatives_[number];
    result.net = {{order[0] - 1, order[1] - 1}, components, {map.domain(0), map.domain(1)}, net};
    bound_derivative({map.order(0) - 1, map.order(1) - 1}, derivative, own, &result);
  }
  if (automatic_normals) {
    for (std::size_t k = 0; k < 4; ++k) largest[glev::kPoint][k] = vertices.component[k].largest;
    plan->normal_bounds_ = glev::bound_normals(vertices.surface, largest);
  }
  return plan;
}

void glev_plan::release() const {
  if (references_.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  const Allocator allocator = allocator_;
  const std::size_t bytes = bytes_;
  this->~glev_plan();
  allocator.release(const_cast<glev_plan*>(this), bytes, kCacheLine);
}
