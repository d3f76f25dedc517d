// Arrays of patches without a context, and plans of one map. A patch that the patch kernels do not evaluate
// gets a plan in the scratch memory of the caller and is evaluated as a mesh or a batch.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "batch.h"
#include "environment.h"
#include "kernels.h"
#include "limit_normals.h"
#include "map.h"
#include "mutation_point.h"
#include "outputs.h"
#include "plan.h"
#include "structures.h"

namespace {

using glev::Attribute, glev::kAttributes, glev::Output, glev::Outputs, glev::Stream;

// Plans in scratch memory are not destroyed.
static_assert(std::is_trivially_destructible_v<glev_plan>);

constexpr auto kVertex = static_cast<unsigned>(Attribute::kVertex),
               kNormal = static_cast<unsigned>(Attribute::kNormal);

// ---- Control points

std::array<int, 2> order_of(const glev_patches& patches) { return {patches.uorder, patches.vorder}; }

std::array<glev::Domain, 2> domain_of(const glev_patches& patches) {
  return {{{patches.u1, patches.u2}, {patches.v1, patches.v2}}};
}

// Copies the structure, and replaces domains of zeros by 0 to 1. Returns an error if a member is invalid,
// apart from the control points.
glev_result read_patches(const glev_patches* given, glev_patches* patches) {
  const glev_result result = glev::read_struct(given, patches);
  if (result != GLEV_SUCCESS) return result;
  if (patches->components < 1 || patches->components > 4) return GLEV_ERROR_INVALID_ARGUMENT;
  if (patches->type != GLEV_FLOAT && patches->type != GLEV_DOUBLE) return GLEV_ERROR_INVALID_ARGUMENT;
  for (const int order : order_of(*patches)) {
    if (order < 1 || order > glev::kMaxOrder) return GLEV_ERROR_INVALID_ARGUMENT;
  }
  if (patches->u1 == 0 && patches->u2 == 0) patches->u2 = 1;
  if (patches->v1 == 0 && patches->v2 == 0) patches->v2 = 1;
  const bool is_valid = patches->u1 != patches->u2 && patches->v1 != patches->v2;
  return is_valid ? GLEV_SUCCESS : GLEV_ERROR_INVALID_ARGUMENT;
}

// Computes the layout of the control points, with columns along v and rows along u.
glev_result locate_points(const glev_patches& patches, Stream* points) {
  if (patches.count == 0) return GLEV_SUCCESS;
  if (patches.points == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  const std::size_t element =
      patches.components * (patches.type == GLEV_DOUBLE ? sizeof(double) : sizeof(float));
  const auto columns = static_cast<std::size_t>(patches.vorder),
             rows = static_cast<std::size_t>(patches.uorder);
  *points = {static_cast<const std::byte*>(patches.points),
             columns,
             rows,
             patches.v_stride != 0 ? patches.v_stride : element,
             patches.u_stride,
             element,
             patches.count,
             patches.patch_stride};
  // Rows and patches that are larger than the address space are rejected.
  if (points->row_stride == 0 && __builtin_mul_overflow(columns, points->stride, &points->row_stride))
    return GLEV_ERROR_BUFFER_TOO_SMALL;
  if (points->patch_stride == 0 && __builtin_mul_overflow(rows, points->row_stride, &points->patch_stride))
    return GLEV_ERROR_BUFFER_TOO_SMALL;
  return points->fits_into(patches.points_size) ? GLEV_SUCCESS : GLEV_ERROR_BUFFER_TOO_SMALL;
}

template <class Real, std::size_t kComponents>
void read_points_of(const Stream& points, std::size_t patch, std::size_t step, double* to) {
  const std::byte* row = points.begin + patch * points.patch_stride;
  for (std::size_t i = 0; i < points.rows; ++i, row += points.row_stride) {
    const std::byte* point = row;
    for (std::size_t j = 0; j < points.columns; ++j, point += points.stride) {
      std::array<Real, kComponents> values;
      std::memcpy(values.data(), point, sizeof values);
      for (std::size_t k = 0; k < kComponents; ++k, to += step) *to = values[k];
    }
  }
}

// Writes the values of the control points of one patch, `step` doubles apart. Requires the default
// environment.
void read_points(const glev_patches& patches, const Stream& points, std::size_t patch, std::size_t step,
                 double* to) {
  static constexpr decltype(&read_points_of<float, 1>) kOf[2][4] = {
      {read_points_of<float, 1>, read_points_of<float, 2>, read_points_of<float, 3>,
       read_points_of<float, 4>},
      {read_points_of<double, 1>, read_points_of<double, 2>, read_points_of<double, 3>,
       read_points_of<double, 4>}};
  kOf[patches.type == GLEV_DOUBLE ? 1 : 0][patches.components - 1](points, patch, step, to);
}

std::size_t values_of(const glev_patches& patches) {
  return patches.components * static_cast<std::size_t>(patches.uorder * patches.vorder);
}

// ---- Arguments

bool is_absent(const glev_input& input) {
  return input.data == nullptr && input.data_size == 0 && input.stride == 0;
}

// Returns true if the members of the grid are valid, apart from pointers and sizes.
bool is_valid(const glev_patch_grid& grid, const glev_patches& patches) {
  if (!glev::is_precision(grid.precision)) return false;
  const unsigned kind = glev::number_of(grid.kind);
  const bool has_edges = kind == GLEV_GRID_EDGES;
  for (const glev_int segments : grid.edge_segments) {
    if (has_edges ? segments < 1 : segments != 0) return false;
  }
  if (kind == GLEV_GRID_UNIFORM || has_edges) {
    const glev_int least = has_edges ? 2 : 0;
    return grid.u_segments >= least && grid.v_segments >= least && grid.u_count == 0 && grid.v_count == 0 &&
           grid.type == 0 && is_absent(grid.u) && is_absent(grid.v) && is_absent(grid.patch);
  }
  if (grid.u_segments != 0 || grid.v_segments != 0) return false;
  if (grid.type != GLEV_FLOAT && grid.type != GLEV_DOUBLE) return false;
  if (kind == GLEV_GRID_LISTS)
    return is_absent(grid.patch) && (grid.v_count != 0 || is_absent(grid.v) || patches.vorder > 1);
  return kind == GLEV_GRID_SCATTERED && grid.v_count == 0;
}

// Copies the patches and the grid, and finds the kernels. Returns an error if a member is invalid, apart from
// pointers and sizes.
glev_result read_arguments(const glev_patches* given_patches, const glev_patch_grid* given_grid,
                           glev_patches* patches, glev_patch_grid* grid, const glev::Kernels** kernels) {
  glev_result result = read_patches(given_patches, patches);
  if (result == GLEV_SUCCESS) result = glev::read_struct(given_grid, grid);
  if (result != GLEV_SUCCESS) return result;
  *kernels = glev::find_kernels(grid->target);
  return *kernels != nullptr && is_valid(*grid, *patches) ? GLEV_SUCCESS : GLEV_ERROR_INVALID_ARGUMENT;
}

bool is_scattered(const glev_patch_grid& grid) { return grid.kind == GLEV_GRID_SCATTERED; }
bool has_edges(const glev_patch_grid& grid) { return grid.kind == GLEV_GRID_EDGES; }
// Returns true if the points are those of grids, so that the caller gives no arguments.
bool has_segments(const glev_patch_grid& grid) { return grid.kind == GLEV_GRID_UNIFORM || has_edges(grid); }

glev::Grid grid_of(const glev::Domain& domain, glev_int segments) {
  return {domain.u1, domain.u2, std::max(segments, 1)};
}

// Returns the meshes of a patch of GLEV_GRID_EDGES: the inner points, and each edge without its last point.
std::array<glev::MeshRange, 5> ranges_of_edges(const glev_patches& patches, const glev_patch_grid& grid) {
  const auto [u, v] = domain_of(patches);
  const glev::Domain back_u = {u.u2, u.u1}, back_v = {v.u2, v.u1};
  const auto& edges = grid.edge_segments;
  const auto count = [](glev_int segments) { return static_cast<std::size_t>(segments); };
  return {{{grid_of(u, grid.u_segments), grid_of(v, grid.v_segments), 1, 1, count(grid.u_segments) - 1,
            count(grid.v_segments) - 1},
           {grid_of(u, edges[0]), grid_of(v, 1), 0, 0, count(edges[0]), 1},
           {grid_of(u, 1), grid_of(v, edges[1]), 1, 0, 1, count(edges[1])},
           {grid_of(back_u, edges[2]), grid_of(v, 1), 0, 1, count(edges[2]), 1},
           {grid_of(u, 1), grid_of(GLEV_AT(last_edge, back_v), edges[3]), 0, 0, 1, count(edges[3])}}};
}

// Returns true if the arguments v are read. Curves do not need v.
bool has_v(const glev_patches& patches, const glev_patch_grid& grid) {
  if (has_segments(grid)) return false;
  return patches.vorder > 1 || (is_scattered(grid) ? !is_absent(grid.v) : grid.v_count != 0);
}

glev::Shape shape_of(const glev_patches& patches, const glev_patch_grid& grid) {
  if (is_scattered(grid)) return {grid.u_count};
  if (has_edges(grid)) {
    std::size_t points = 0;
    for (const glev::MeshRange& range : ranges_of_edges(patches, grid)) points += range.columns * range.rows;
    return {points, 1, patches.count, true, true};
  }
  if (grid.kind == GLEV_GRID_LISTS)
    return {grid.u_count, has_v(patches, grid) ? grid.v_count : 1, patches.count, true, true};
  return {static_cast<std::size_t>(grid.u_segments) + 1, static_cast<std::size_t>(grid.v_segments) + 1,
          patches.count, true, true};
}

glev_result locate_input(const glev_input& input, std::size_t count, std::size_t element, Stream* stream) {
  if (input.data == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  *stream = {static_cast<const std::byte*>(input.data), count, 1, input.stride, 0, element, 1, 0};
  return stream->fits_into(input.data_size) ? GLEV_SUCCESS : GLEV_ERROR_BUFFER_TOO_SMALL;
}

// The layouts of all memory that is read.
struct Inputs {
  Stream points{}, u{}, v{}, patch{};

  std::size_t patch_of(std::size_t i) const {
    glev_uint number;
    std::memcpy(&number, patch.begin + i * patch.stride, sizeof number);
    return number;
  }
};

glev_result locate_inputs(const glev_patches& patches, const glev_patch_grid& grid, Inputs* inputs) {
  glev_result result = locate_points(patches, &inputs->points);
  const std::size_t element = grid.type == GLEV_DOUBLE ? sizeof(double) : sizeof(float);
  if (result == GLEV_SUCCESS && !has_segments(grid))
    result = locate_input(grid.u, grid.u_count, element, &inputs->u);
  if (result == GLEV_SUCCESS && has_v(patches, grid))
    result = locate_input(grid.v, is_scattered(grid) ? grid.u_count : grid.v_count, element, &inputs->v);
  if (result == GLEV_SUCCESS && is_scattered(grid))
    result = locate_input(grid.patch, grid.u_count, sizeof(glev_uint), &inputs->patch);
  for (std::size_t i = 0; result == GLEV_SUCCESS && i < inputs->patch.columns; ++i) {
    if (inputs->patch_of(i) >= patches.count) result = GLEV_ERROR_INVALID_ARGUMENT;
  }
  return result;
}

// ---- Evaluation

std::size_t components_of(const glev_patches& patches, unsigned attribute) {
  if (attribute == kNormal) return patches.components >= 3 ? 3 : 0;
  return attribute == kVertex || attribute >= glev::kFirstDerivative ? patches.components : 0;
}

// Makes plans of patches, one at a time, in memory of the caller.
class PatchPlans {
 public:
  PatchPlans(const glev_patches& patches, bool normals, bool derivatives, const glev::Kernels* kernels)
      : patches_(patches), normals_(normals), derivatives_(derivatives), kernels_(kernels) {
    slot_ = patches.components == 4 ? glev::slots_of(Attribute::kVertex).last
                                    : glev::slots_of(Attribute::kVertex).first;
    enabled_[static_cast<std::size_t>(slot_)] = true;
    refer_to(nullptr);
  }

  // Returns the bytes for one plan, sufficient for any alignment.
  std::size_t bytes() const { return glev::kCacheLine + bytes_of_points() + glev_plan::bytes_for(source()); }
  void use(std::byte* memory) { memory_ = glev::align(memory); }
  // Returns the control points of the last plan.
  const double* net() const { return reinterpret_cast<const double*>(memory_); }
  // Returns the scratch memory for meshes, which follows the plan.
  std::byte* scratch() const { return memory_ + bytes_of_points() + glev_plan::bytes_for(source()); }

  const glev_plan& make(const Stream& points, std::size_t patch) {
    auto* const net = reinterpret_cast<double*>(memory_);
    read_points(patches_, points, patch, 1, net);
    refer_to(net);
    return *glev_plan::create_at(memory_ + bytes_of_points(), source());
  }

 private:
  std::size_t bytes_of_points() const { return glev::round_up(values_of(patches_) * sizeof(double)); }
  void refer_to(const double* net) {
    maps_[static_cast<std::size_t>(slot_)].refer_to(net, static_cast<int>(patches_.components),
                                                    order_of(patches_), domain_of(patches_));
  }
  glev_plan::Source source() const { return {2, maps_, enabled_, {}, normals_, derivatives_, kernels_}; }

  const glev_patches& patches_;
  bool normals_, derivatives_;
  const glev::Kernels* kernels_;
  int slot_;
  std::byte* memory_ = nullptr;
  std::array<glev::Map, glev::kSlots> maps_;
  std::array<bool, glev::kSlots> enabled_{};
};

// Returns the number of positions of columns and rows, which are computed once for all patches.
std::size_t places_of(const glev_patches& patches, const glev_patch_grid& grid) {
  const glev::Shape shape = shape_of(patches, grid);
  return std::min(shape.columns, glev::kMostPatchPoints) + std::min(shape.rows, glev::kMostPatchPoints);
}

// Evaluates vertices of patches of low degree in vectors, one patch in each lane.
class SideBySide {
 public:
  static std::size_t bytes_for(const glev_patches& patches, const glev_patch_grid& grid) {
    if (is_scattered(grid) || has_edges(grid) || !has_low_degree(patches)) return 0;
    return sizeof(double) * (values_of(patches) * glev::kPatchLanes + places_of(patches, grid));
  }

  // `range`: columns and rows, and the grids of a uniform grid.
  SideBySide(const glev_patches& patches, const glev_patch_grid& grid, const Inputs& inputs,
             const glev::MeshRange& range, const glev::Kernels* kernels, const Outputs& outputs,
             std::byte* memory)
      : patches_(patches), inputs_(inputs), kernels_(kernels), vertex_(outputs[kVertex]) {
    if (has_edges(grid) || !has_low_degree(patches)) return;
    if (!outputs.wanted.is_only(kVertex) || vertex_.is_double) return;
    if (range.columns > glev::kMostPatchPoints / range.rows || !has_ordinary_domain(patches)) return;
    net_ = reinterpret_cast<double*>(memory);
    double* const x = net_ + values_of(patches) * glev::kPatchLanes;
    double* const y = x + range.columns;
    const auto [domain_u, domain_v] = domain_of(patches);
    const bool is_uniform = grid.kind == GLEV_GRID_UNIFORM, is_double = grid.type == GLEV_DOUBLE;
    const glev::Input u = {inputs.u.begin, inputs.u.stride, is_double},
                      v = {inputs.v.begin, inputs.v.stride, is_double};
    is_used_ = true;
    can_have_lines_ = is_uniform;
    for (std::size_t i = 0; i < range.columns; ++i) {
      if (is_uniform) x[i] = glev::place_on(range.u_of(i));
      is_used_ = is_used_ && (is_uniform || place(domain_u, u[i], x + i));
    }
    for (std::size_t j = 0; j < range.rows; ++j) {
      const bool has_place = patches.vorder > 1;
      y[j] = 0;
      if (is_uniform) y[j] = glev::place_on(range.v_of(j));
      is_used_ = is_used_ && (is_uniform || !has_place || place(domain_v, v[j], y + j));
    }
    const int n = patches.uorder - 1, m = patches.vorder - 1;
    const int bits = !is_uniform ? glev::kManyBits
                                 : n * glev::bits_of_places(domain_u, range.u) +
                                       (m == 0 ? 0 : m * glev::bits_of_places(domain_v, range.v));
    const glev::Surface surface = {
        {n, m}, static_cast<int>(patches.components), {domain_u, domain_v}, nullptr};
    block_ = {{n, m},
              static_cast<int>(patches.components),
              0,
              net_,
              x,
              y,
              range.columns,
              range.rows,
              bits,
              is_uniform && patches.count <= kFewPatches,
              grid.precision == GLEV_FAST && is_uniform && !glev::has_few_segments(surface, range),
              {vertex_.data, vertex_.stream.stride, vertex_.stream.row_stride, vertex_.components},
              vertex_.stream.patch_stride,
              is_uniform ? &range : nullptr,
              {domain_u, domain_v}};
  }

  // Evaluates `count` <= kPatchLanes patches from `first` on. Returns the patches that are not evaluated, as
  // bits.
  unsigned evaluate(std::size_t first, std::size_t count) {
    const unsigned all = (1U << count) - 1;
    if (!is_used_ || 2 * count < glev::kPatchLanes) return all;
    // After data with many undecided patches, the next blocks are evaluated patch by patch, which is then
    // faster.
    if (pause_ > 0) {
      --pause_;
      return all;
    }
    load(first, count);
    prefetch(first + count);
    block_.patches = count;
    block_.to.data = vertex_.data + first * block_.patch_stride;
    unsigned left = kernels_->patches(block_);
    // If tests along lines decide patches of one block, they do so in others, too.
    if (left != 0 && can_have_lines_ && !block_.has_lines) {
      block_.has_lines = true;
      const unsigned still_left = kernels_->patches(block_);
      block_.has_lines = still_left != left;
      left = still_left;
    }
    pause_ = 2 * static_cast<std::size_t>(std::popcount(left)) > count ? 15 : 0;
    return left;
  }

 private:
  // Few patches have tests along lines from the first block on, because a second evaluation takes longer.
  static constexpr std::size_t kFewPatches = 8 * glev::kPatchLanes;

  static bool has_low_degree(const glev_patches& patches) {
    return patches.uorder > 1 && patches.uorder <= glev::kMaxCentredDegree + 1 &&
           patches.vorder <= glev::kMaxCentredDegree + 1;
  }
  static bool has_ordinary_domain(const glev_patches& patches) {
    const auto domain = domain_of(patches);
    return glev::is_ordinary(domain[0]) && (patches.vorder == 1 || glev::is_ordinary(domain[1]));
  }

  // Computes x = t - s of a real argument. Returns false outside the domain.
  static bool place(const glev::Domain& domain, double argument, double* x) {
    const glev::Parameter at = locate(domain, argument);
    *x = at.t - at.s;
    return at.t >= 0 && at.s >= 0;
  }

  // Requests the control points of the next patches, which arrive during the evaluation.
  void prefetch(std::size_t first) const {
    const std::size_t element = patches_.type == GLEV_DOUBLE ? sizeof(double) : sizeof(float),
                      bytes = values_of(patches_) * element;
    for (std::size_t p = first; p < std::min(first + glev::kPatchLanes, patches_.count); ++p) {
      const std::byte* const points = inputs_.points.begin + p * inputs_.points.patch_stride;
      for (std::size_t at = 0; at < bytes; at += glev::kCacheLine) __builtin_prefetch(points + at);
    }
  }

  // Loads the control points of `count` patches. The first one takes the place of those that are missing.
  void load(std::size_t first, std::size_t count) {
    const Stream& points = inputs_.points;
    const auto patch_of = [&](std::size_t lane) { return lane < count ? first + lane : first; };
    const bool is_packed = patches_.type == GLEV_FLOAT && points.stride == points.element &&
                           points.row_stride == points.columns * points.element;
    std::array<const float*, glev::kPatchLanes> data;
    for (std::size_t lane = 0; lane < glev::kPatchLanes; ++lane) {
      const std::size_t patch = patch_of(lane);
      data[lane] = reinterpret_cast<const float*>(points.begin + patch * points.patch_stride);
      if (!is_packed) read_points(patches_, points, patch, glev::kPatchLanes, net_ + lane);
    }
    if (is_packed) kernels_->load_patches(data.data(), values_of(patches_), net_);
  }

  const glev_patches& patches_;
  const Inputs& inputs_;
  const glev::Kernels* kernels_;
  const Output& vertex_;
  bool is_used_ = false, can_have_lines_ = false;
  std::size_t pause_ = 0;
  double* net_ = nullptr;
  glev::PatchBlock block_{};
};

// Returns the bytes of scratch memory, sufficient for all outputs.
std::size_t scratch_for(const glev_patches& patches, const glev_patch_grid& grid,
                        const glev::Kernels* kernels) {
  const bool has_normals = patches.components >= 3;
  const PatchPlans plans(patches, has_normals, true, kernels);
  const std::size_t bytes = plans.bytes() + glev::round_up(SideBySide::bytes_for(patches, grid));
  if (!has_segments(grid)) return bytes;
  const int degree = patches.uorder - 1;
  std::size_t columns = has_edges(grid) ? 1 : shape_of(patches, grid).columns;
  for (std::size_t k = 0; has_edges(grid) && k < 5; ++k)
    columns = std::max(columns, ranges_of_edges(patches, grid)[k].columns);
  return bytes + glev::kCacheLine +
         (has_normals ? glev::normal_mesh_scratch(degree, columns) : glev::mesh_scratch(degree, columns));
}

template <class Part>
Outputs parts_of(const Outputs& outputs, const Part& part) {
  Outputs parts;
  parts.wanted = outputs.wanted;
  for (const unsigned o : outputs.wanted) parts.all[o] = part(outputs[o]);
  return parts;
}

// Replaces normals on edges that are a single point by their limits. u(i) and v(i, j) return the arguments.
template <class U, class V>
void write_limit_normals(const glev_patches& patches, const glev_patch_grid& grid, const PatchPlans& plans,
                         const Outputs& outputs, std::size_t columns, std::size_t rows, const U& u,
                         const V& v) {
  if (grid.limit_normals == GLEV_FALSE || !outputs.wanted.contains(kNormal)) return;
  const Output& normal = outputs[kNormal];
  const glev::LimitNormals limits(plans.net(), static_cast<int>(patches.components), order_of(patches),
                                  domain_of(patches));
  if (!limits.has_edges()) return;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::array<float, 3> limit = limits.normal_at(u(i), v(i, j));
      if (limit == std::array<float, 3>{}) continue;
      const std::array<double, 3> wide = {limit[0], limit[1], limit[2]};
      std::memcpy(normal.address_of(i, j),
                  normal.is_double ? static_cast<const void*>(wide.data()) : limit.data(),
                  normal.stream.element);
    }
  }
}

// Evaluates the points of one mesh of a patch.
void evaluate_mesh(const glev_patches& patches, const glev_patch_grid& grid, const glev_plan& plan,
                   const PatchPlans& plans, const glev::MeshRange& range, const Outputs& outputs) {
  glev::evaluate_range(plan, range, grid.precision == GLEV_FAST, outputs, plans.scratch());
  write_limit_normals(
      patches, grid, plans, outputs, range.columns, range.rows, [&](std::size_t i) { return range.u_of(i); },
      [&](std::size_t, std::size_t j) { return range.v_of(j); });
}

void evaluate_edges(const glev_patches& patches, const glev_patch_grid& grid, const glev_plan& plan,
                    const PatchPlans& plans, const Outputs& outputs) {
  std::size_t first = 0;
  for (const glev::MeshRange& range : ranges_of_edges(patches, grid)) {
    evaluate_mesh(patches, grid, plan, plans, range, parts_of(outputs, [&](const Output& output) {
                    return output.mesh(first, range.columns, range.rows);
                  }));
    first += range.columns * range.rows;
  }
}

void evaluate_grids(const glev_patches& patches, const glev_patch_grid& grid, const Inputs& inputs,
                    const glev::Kernels* kernels, PatchPlans& plans, const Outputs& outputs,
                    std::byte* memory) {
  const glev::Shape shape = shape_of(patches, grid);
  const bool is_uniform = grid.kind == GLEV_GRID_UNIFORM, is_double = grid.type == GLEV_DOUBLE;
  const auto [domain_u, domain_v] = domain_of(patches);
  const glev::MeshRange range = {grid_of(domain_u, grid.u_segments),
                                 grid_of(domain_v, grid.v_segments),
                                 0,
                                 0,
                                 shape.columns,
                                 shape.rows};
  const glev::Input u = {inputs.u.begin, inputs.u.stride, is_double};
  const glev::Input all_v = {inputs.v.begin, inputs.v.stride, is_double};
  SideBySide side_by_side(patches, grid, inputs, range, kernels, outputs, memory);
  for (std::size_t first = 0; first < patches.count; first += glev::kPatchLanes) {
    const std::size_t count = std::min(glev::kPatchLanes, patches.count - first);
    const unsigned left = side_by_side.evaluate(first, count);
    for (std::size_t p = 0; p < count; ++p) {
      if ((left >> p & 1) == 0) continue;
      const glev_plan& plan = plans.make(inputs.points, first + p);
      const Outputs own = parts_of(outputs, [&](const Output& output) { return output.patch(first + p); });
      if (has_segments(grid)) {
        is_uniform ? evaluate_mesh(patches, grid, plan, plans, range, own)
                   : evaluate_edges(patches, grid, plan, plans, own);
        continue;
      }
      for (std::size_t j = 0; j < shape.rows; ++j) {
        const glev::Input v = {inputs.v.begin + j * inputs.v.stride, 0, is_double};
        glev::evaluate_arguments(plan, u, patches.vorder > 1 ? &v : nullptr, shape.columns, false,
                                 parts_of(own, [&](const Output& output) { return output.row(j); }));
      }
      write_limit_normals(
          patches, grid, plans, own, shape.columns, shape.rows,
          [&](std::size_t i) { return glev::argument_at(u[i]); },
          [&](std::size_t, std::size_t j) { return glev::argument_at(all_v[j]); });
    }
  }
}

void evaluate_scattered(const glev_patches& patches, const glev_patch_grid& grid, const Inputs& inputs,
                        PatchPlans& plans, const Outputs& outputs) {
  const bool is_double = grid.type == GLEV_DOUBLE;
  for (std::size_t begin = 0, end = 0; begin < grid.u_count; begin = end) {
    const std::size_t p = inputs.patch_of(begin);
    while (end < grid.u_count && inputs.patch_of(end) == p) ++end;
    const glev_plan& plan = plans.make(inputs.points, p);
    const glev::Input u = {inputs.u.begin + begin * inputs.u.stride, inputs.u.stride, is_double},
                      v = {inputs.v.begin + begin * inputs.v.stride, inputs.v.stride, is_double};
    const Outputs own =
        parts_of(outputs, [&](const Output& output) { return output.columns(begin, end - begin); });
    glev::evaluate_arguments(plan, u, patches.vorder > 1 ? &v : nullptr, end - begin, false, own);
    write_limit_normals(
        patches, grid, plans, own, end - begin, 1, [&](std::size_t i) { return glev::argument_at(u[i]); },
        [&](std::size_t i, std::size_t) { return glev::argument_at(v[i]); });
  }
}

}  // namespace

size_t glevGetPatchScratchSize(const glev_patches* given_patches, const glev_patch_grid* given_grid) {
  glev_patches patches;
  glev_patch_grid grid;
  const glev::Kernels* kernels;
  if (read_arguments(given_patches, given_grid, &patches, &grid, &kernels) != GLEV_SUCCESS) return 0;
  return scratch_for(patches, grid, kernels);
}

glev_result glevEvaluatePatches(const glev_patches* given_patches, const glev_patch_grid* given_grid,
                                const glev_attribute_output* given_outputs, size_t output_count,
                                void* scratch, size_t scratch_size) {
  glev_patches patches;
  glev_patch_grid grid;
  const glev::Kernels* kernels;
  glev_result result = read_arguments(given_patches, given_grid, &patches, &grid, &kernels);
  if (result != GLEV_SUCCESS) return result;
  if (scratch == nullptr && scratch_size != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  const glev::Shape shape = shape_of(patches, grid);
  Outputs outputs;
  result = glev::read_outputs([&](unsigned o) { return components_of(patches, o); }, given_outputs,
                              output_count, shape, &outputs);
  if (result != GLEV_SUCCESS || shape.is_empty()) return result;

  Inputs inputs;
  result = locate_inputs(patches, grid, &inputs);
  if (result != GLEV_SUCCESS) return result;
  if (scratch_size < scratch_for(patches, grid, kernels)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  const std::array<Stream, 5> others = {inputs.points, inputs.u, inputs.v, inputs.patch,
                                        glev::claim(scratch, scratch_size)};
  result = glev::check_memory(outputs, others);
  if (result != GLEV_SUCCESS) return result;

  const glev::DefaultEnvironment environment;
  PatchPlans plans(patches, outputs.wanted.contains(kNormal), outputs.wanted.has_derivatives(), kernels);
  // The aligned memory of SideBySide is first, followed by the plan with its scratch memory.
  std::byte* const memory = glev::align(static_cast<std::byte*>(scratch));
  plans.use(memory + glev::round_up(SideBySide::bytes_for(patches, grid)));
  if (is_scattered(grid)) {
    evaluate_scattered(patches, grid, inputs, plans, outputs);
  } else {
    evaluate_grids(patches, grid, inputs, kernels, plans, outputs, memory);
  }
  return GLEV_SUCCESS;
}

// ---- Plans of one map

glev_result glevCreatePlanFromMap(const glev_map_info* given, glev_plan** plan) {
  if (plan == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  *plan = nullptr;
  glev_map_info info;
  glev_patches patches;
  glev_result result = glev::read_struct(given, &info);
  if (result == GLEV_SUCCESS) result = read_patches(info.map, &patches);
  if (result != GLEV_SUCCESS) return result;
  if (patches.count != 1) return GLEV_ERROR_INVALID_ARGUMENT;
  const glev::Target target = glev::find_target(info.target);
  if (!target || info.target == GLEV_MAP1_INDEX || info.target == GLEV_MAP2_INDEX)
    return GLEV_ERROR_INVALID_ARGUMENT;
  const auto slot = static_cast<std::size_t>(target.slot);
  if (patches.components != static_cast<std::size_t>(glev::kSlotTable[slot].components))
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (info.u_segments < 0 || info.v_segments < 0) return GLEV_ERROR_INVALID_ARGUMENT;
  if (target.dimension == 1 && (patches.vorder != 1 || info.v_segments != 0))
    return GLEV_ERROR_INVALID_ARGUMENT;
  glev::Allocator allocator;
  const glev::Kernels* kernels = glev::find_kernels(info.instruction_set);
  if (kernels == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  Stream points{};
  result = glev::read_allocator(info.allocator, &allocator);
  if (result == GLEV_SUCCESS) result = locate_points(patches, &points);
  if (result != GLEV_SUCCESS) return result;

  const glev::DefaultEnvironment environment;
  glev::DoubleBuffer net;
  if (!net.reserve(allocator, values_of(patches))) return GLEV_ERROR_OUT_OF_MEMORY;
  read_points(patches, points, 0, 1, net.data());
  std::array<glev::Domain, 2> domain = domain_of(patches);
  if (target.dimension == 1) domain[1] = {};
  std::array<glev::Map, glev::kSlots> maps;
  std::array<bool, glev::kSlots> enabled{};
  maps[slot].refer_to(net.data(), static_cast<int>(patches.components), order_of(patches), domain);
  enabled[slot] = true;
  std::array<glev::Grid, 2> grid;
  for (std::size_t d : {0, 1}) {
    const glev_int segments = d == 0 ? info.u_segments : info.v_segments;
    grid[d] = {domain[d].u1, domain[d].u2, segments > 0 ? segments : 1};
  }
  const bool has_rows = target.dimension == 2;
  *plan = glev_plan::create(allocator, {target.dimension, maps, enabled, grid,
                                        has_rows && info.auto_normal != 0, has_rows, kernels});
  net.free(allocator);
  return *plan != nullptr ? GLEV_SUCCESS : GLEV_ERROR_OUT_OF_MEMORY;
}
