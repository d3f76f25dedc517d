// The commands of a context: maps, enables, evaluation, meshes, primitives, the attribute stack and queries.
#include "context.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "convert.h"
#include "environment.h"
#include "mutation_point.h"
#include "normal.h"
#include "structures.h"

using glev::Attribute;
using glev::find_target;
using glev::Grid;
using glev::GridArgument;
using glev::Target;

namespace {

constexpr Attribute kOtherAttributes[] = {Attribute::kColor, Attribute::kNormal, Attribute::kTexcoord};

constexpr glev_enum kLinesAdjacency = 0x000A, kTriangleStripAdjacency = 0x000D, kPatches = 0x000E;

bool is_texture_unit(glev_enum texture) { return texture - GLEV_TEXTURE0 < GLEV_TEXTURE_UNITS; }

template <std::size_t kCount>
void copy_to(float (&to)[kCount], const std::array<float, kCount>& from) {
  for (std::size_t k = 0; k < kCount; ++k) to[k] = from[k];
}

template <std::size_t kCount>
glev::StateValues from_floats(const float (&from)[kCount], bool normalized) {
  glev::StateValues state{static_cast<int>(kCount), {}, normalized};
  for (std::size_t k = 0; k < kCount; ++k) state.values[k] = from[k];
  return state;
}

}  // namespace

glev_context::glev_context(const glev::Allocator& allocator, const glev::Kernels* kernels)
    : allocator_(allocator), kernels_(kernels) {
  current_.change().size = sizeof(glev_vertex);
  color({1, 1, 1, 1});
  normal({0, 0, 1});
  for (auto& texcoord : current_.change().texcoord) copy_to(texcoord, {0, 0, 0, 1});
  index(1);
  edge_flag(true);
}

glev_context::~glev_context() {
  for (const int dimension : {1, 2}) drop_plan(dimension);
  for (auto& maps : maps_) {
    for (auto& map : maps) map.free(allocator_);
  }
  open_.list.free(allocator_);
  lists_.free(allocator_);
}

// ---- Errors

glev_enum glev_context::get_error() {
  if (is_rejected_in_primitive()) return 0;
  const glev_enum error = error_;
  error_ = GLEV_NO_ERROR;
  return error;
}

bool glev_context::is_rejected_in_primitive() {
  if (in_primitive_) record_error(GLEV_INVALID_OPERATION);
  return in_primitive_;
}

// ---- Maps

namespace {

// Returns the error of the arguments, independently of state; NO_ERROR if there is none.
glev_enum find_map_error(int dimension, glev_enum name, const std::array<glev::MapDirection, 2>& directions,
                         const void* points) {
  const Target target = find_target(name);
  if (target.dimension != dimension) return GLEV_INVALID_ENUM;
  const int components = glev::kSlotTable[target.slot].components;
  for (int d = 0; d < dimension; ++d) {
    const auto& [u1, u2, stride, order] = directions[d];
    if (order < 1 || order > glev::kMaxOrder || GLEV_AT(short_stride, stride < components) || u1 == u2)
      return GLEV_INVALID_VALUE;
  }
  return points == nullptr ? GLEV_INVALID_VALUE : GLEV_NO_ERROR;
}

}  // namespace

template <class Real>
void glev_context::define_map(int dimension, glev_enum name,
                              const std::array<glev::MapDirection, 2>& directions, const Real* points) {
  const glev::DefaultEnvironment environment;
  const glev_enum error = find_map_error(dimension, name, directions, points);
  if (error != GLEV_NO_ERROR) return record_error(error);
  if (GLEV_AT(rejects_map, is_rejected_in_primitive())) return;
  if (GLEV_AT(unit_rejects_map, active_unit_ != 0)) return record_error(GLEV_INVALID_OPERATION);
  const int slot = find_target(name).slot;
  const auto& [u, v] = directions;
  glev::Map& map = maps_[dimension - 1][slot];
  GLEV_HERE(before_map);
  if (!map.define(allocator_, glev::kSlotTable[slot].components, u, v, points)) {
    return record_error(GLEV_OUT_OF_MEMORY);
  }
  if (GLEV_AT(map_is_drawn, eval_.enabled[dimension - 1][slot])) drop_plan(dimension);
}

template <class Real>
void glev_context::issue_define_map(int dimension, glev_enum name,
                                    const std::array<glev::MapDirection, 2>& directions, const Real* points) {
  const glev::DefaultEnvironment environment;
  if (is_compiling()) {
    const glev_enum error = find_map_error(dimension, name, directions, points);
    if (error != GLEV_NO_ERROR) {
      compile(glev::listed<&glev_context::record_error>(error));
    } else {
      const int components = glev::kSlotTable[find_target(name).slot].components;
      const glev::MapDirection &u = directions[0], &v = directions[1];
      std::array<glev::MapDirection, 2> packed = directions;
      packed[0].stride = GLEV_AT(length_of_row, v.order) * components;
      packed[1].stride = components;
      const std::size_t values = static_cast<std::size_t>(u.order) * v.order * components;
      void* memory = compile(
          [=](glev_context& gl, const void* copy) {
            gl.define_map(dimension, name, packed, static_cast<const double*>(copy));
          },
          values * sizeof(double));
      if (memory != nullptr) glev::copy_points(components, u, v, points, new (memory) double[values]);
    }
    if (GLEV_AT(compiles_map_only, open_.mode == GLEV_COMPILE)) return;
  }
  define_map(dimension, name, directions, points);
}

template void glev_context::define_map(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                       const double*);
template void glev_context::issue_define_map(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                             const float*);
template void glev_context::issue_define_map(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                             const double*);

template <class Number>
void glev_context::get_map(glev_enum name, glev_enum query, std::int64_t bytes, Number* v) {
  const glev::DefaultEnvironment environment;
  if (bytes < 0) return record_error(GLEV_INVALID_VALUE);
  const Target target = find_target(name);
  if (!target || (query != GLEV_COEFF && query != GLEV_ORDER && query != GLEV_DOMAIN)) {
    return record_error(GLEV_INVALID_ENUM);
  }
  if (v == nullptr) return record_error(GLEV_INVALID_VALUE);
  if (is_rejected_in_primitive()) return;

  const glev::Map& map = maps_[target.dimension - 1][target.slot];
  const int points = map.order(0) * map.order(1) * glev::kSlotTable[target.slot].components;
  const int count = query == GLEV_COEFF    ? points
                    : query == GLEV_DOMAIN ? 2 * target.dimension
                                           : target.dimension;
  if (bytes / static_cast<std::int64_t>(sizeof(Number)) < count) return record_error(GLEV_INVALID_OPERATION);
  const auto put = [&v](double value) { glev::convert(value, glev::StateKind::kNumber, v++); };
  if (query == GLEV_COEFF) {
    for (int i = 0; i < count; ++i) put(map.points(target.slot)[i]);
    return;
  }
  for (int direction = 0; direction < target.dimension; ++direction) {
    if (query == GLEV_ORDER) {
      put(map.order(direction));
    } else {
      put(map.domain(direction).u1);
      put(map.domain(direction).u2);
    }
  }
}

template void glev_context::get_map(glev_enum, glev_enum, std::int64_t, glev_double*);
template void glev_context::get_map(glev_enum, glev_enum, std::int64_t, glev_float*);
template void glev_context::get_map(glev_enum, glev_enum, std::int64_t, glev_int*);

// ---- Enables

bool* glev_context::find_flag(glev_enum cap) {
  if (cap == GLEV_AUTO_NORMAL) return &eval_.auto_normal;
  const Target target = find_target(cap);
  return target ? &eval_.enabled[target.dimension - 1][target.slot] : nullptr;
}

void glev_context::set_enabled(glev_enum cap, bool enabled) {
  bool* flag = find_flag(cap);
  if (flag == nullptr) return record_error(GLEV_INVALID_ENUM);
  if (is_rejected_in_primitive()) return;
  if (*flag == enabled) return;
  *flag = enabled;
  GLEV_HERE(before_plan_of_enable_is_dropped);
  drop_plan(find_target(cap).dimension == 1 ? 1 : 2);  // AUTO_NORMAL belongs to dimension 2
}

bool glev_context::is_enabled(glev_enum cap) {
  const bool* flag = find_flag(cap);
  if (flag == nullptr) {
    record_error(GLEV_INVALID_ENUM);
    return false;
  }
  return !is_rejected_in_primitive() && *flag;
}

// ---- Evaluation

glev_plan* glev_context::current_plan(int dimension) {
  glev_plan*& plan = plans_[dimension - 1];
  if (plan == nullptr) {
    const glev::DefaultEnvironment environment;
    plan = glev_plan::create(
        allocator_,
        {dimension, maps_[dimension - 1], eval_.enabled[dimension - 1], eval_.grid[dimension - 1],
         GLEV_AT(has_automatic_normals, dimension == 2 && eval_.auto_normal), dimension == 2, kernels_});
  }
  return plan;
}

void glev_context::drop_plan(int dimension) {
  current_.unstage();
  direct_[dimension - 1] = nullptr;
  glev_plan*& plan = plans_[dimension - 1];
  if (plan != nullptr) plan->release();
  plan = nullptr;
}

const glev_plan* glev_context::plan_to_draw(int dimension) {
  const glev_plan* plan = current_plan(dimension);
  if (plan == nullptr) {
    record_error(GLEV_OUT_OF_MEMORY);
    return nullptr;
  }
  return plan->components(Attribute::kVertex) != 0 ? plan : nullptr;
}

// Sets an attribute of a vertex.
inline void glev_context::put(const float (&values)[4], Attribute attribute, glev_vertex* vertex) const {
  float* const to = attribute == Attribute::kColor    ? vertex->color
                    : attribute == Attribute::kNormal ? vertex->normal
                                                      : vertex->texcoord[GLEV_AT(fed_unit, 0)];
  std::copy_n(values, attribute == Attribute::kNormal ? 3 : 4, to);
}

// Emits the staged vertex, after fill(vertex) has set what the plan evaluates.
template <class Fill>
inline void glev_context::emit_staged(const glev_plan& plan, const Fill& fill) {
  glev_vertex& vertex = current_.staged_for(&plan);
  fill(&vertex);
  GLEV_HERE(before_vertex);
  emit(vertex);
}

// Emits a vertex from within a callback. It does not use the staged vertex, which the callback is reading.
void glev_context::emit_within(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                               const glev::NormalRow* row) {
  glev_vertex vertex = current_.values();
  evaluate_into(plan, u, v, row, &vertex);
  emit(vertex);
}

void glev_context::emit_at(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                           const glev::NormalRow* row) {
  if (callbacks_ > 0) return emit_within(plan, u, v, row);
  emit_staged(plan, [&](glev_vertex* vertex) { evaluate_into(plan, u, v, row, vertex); });
}

inline void glev_context::evaluate_into(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                                        const glev::NormalRow* row, glev_vertex* vertex) const {
  const glev::DefaultEnvironment environment;
  glev::values_at(plan, Attribute::kVertex, u, v, vertex->position);
  if (plan.has_vertices_only()) return;
  for (const Attribute attribute : kOtherAttributes) {
    if (plan.components(attribute) == 0) continue;
    float values[4];
    glev::values_at(plan, attribute, u, v, values);
    put(values, attribute, vertex);
  }
  if (row != nullptr) copy_to(vertex->normal, row->normal_at(u));
}

void glev_context::evaluate_at(int dimension, const GridArgument& u, const GridArgument& v) {
  if (!in_primitive_) return;
  const glev_plan* plan = GLEV_AT(plan_of_coord, plan_to_draw(dimension));
  if (plan == nullptr) return;
  if (plan->automatic_normals()) return evaluate_with_normal(*plan, u, v);
  emit_at(*plan, u, v, nullptr);
  // A callback may have ended the primitive or dropped the plan.
  if (plans_[dimension - 1] == plan && is_direct(*plan)) direct_[dimension - 1] = plan;
}

bool glev_context::is_direct(const glev_plan& plan) const {
  return plan.direct() != nullptr && in_primitive_ && !in_mesh_ && callbacks_ == 0 && open_.mode == 0 &&
         in_default_environment_;
}

// This is a separate function because of its large stack frame.
void glev_context::evaluate_with_normal(const glev_plan& plan, const GridArgument& u, const GridArgument& v) {
  glev::NormalRow row(plan);
  {
    const glev::DefaultEnvironment environment;
    row.move_to(v);
  }
  emit_at(plan, u, v, &row);
}

void glev_context::eval_coord(int dimension, double u, double v) {
  evaluate_at(dimension, glev::argument_at(u), glev::argument_at(v));
}

void glev_context::set_grid(int dimension, const std::array<Grid, 2>& grid) {
  for (const Grid& direction : grid) {
    if (direction.segments <= 0) return record_error(GLEV_INVALID_VALUE);
  }
  if (GLEV_AT(rejects_grid, is_rejected_in_primitive())) return;
  GLEV_HERE(before_grid);
  eval_.grid[dimension - 1] = grid;
  glev_plan* const plan = plans_[dimension - 1];
  if (plan != nullptr && plan->has_one_reference()) return plan->set_grid(grid);
  drop_plan(dimension);
}

void glev_context::eval_point(int dimension, glev_int i, glev_int j) {
  const auto& [u, v] = eval_.grid[dimension - 1];
  evaluate_at(dimension, GridArgument{u, i}, GridArgument{v, j});
}

// ---- Meshes (the loops of GL §21.1). Indices have 64 bits, so that last + 1 does not overflow.

template <class Body>
void glev_context::mesh_primitive(glev_enum mode, const Body& body) {
  in_mesh_ = true;
  in_primitive_ = true;
  call_sink(sink_.begin, mode);
  body();
  call_sink(sink_.end);
  in_primitive_ = false;
  in_mesh_ = false;
}

namespace {

// Values of at most kMost columns and two rows of a mesh, or of one column and at most kMost rows, computed
// by the kernels.
class MeshPart {
 public:
  static constexpr std::int64_t kMost = 64;
  // Automatic normals need twice as much scratch memory.
  static std::int64_t most(const glev_plan& plan) { return plan.automatic_normals() ? kMost / 2 : kMost; }

  MeshPart(const glev_plan& plan, std::int64_t i, std::int64_t j, std::int64_t columns, std::int64_t rows) {
    const glev::DefaultEnvironment environment;
    const glev::MeshRange range = {
        plan.grid(0), plan.grid(1), i, j, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows)};
    const auto destination_of = [&](Attribute attribute) -> glev::Destination {
      float* const values = values_[static_cast<std::size_t>(attribute)][0];
      constexpr std::size_t kStride = sizeof values_[0][0];
      return {reinterpret_cast<std::byte*>(values), kStride, range.columns * kStride, 4};
    };
    const auto evaluate = [&](Attribute attribute) {
      plan.kernels().mesh(plan.map(attribute), range, false, destination_of(attribute), scratch_);
    };
    evaluate(Attribute::kVertex);
    if (plan.has_vertices_only()) return;
    for (const Attribute attribute : kOtherAttributes) {
      if (plan.components(attribute) != 0) evaluate(attribute);
    }
    if (!plan.automatic_normals()) return;
    glev::Destination to = destination_of(Attribute::kNormal);
    to.components = 3;
    plan.kernels().normals(plan, range, to, false, scratch_);
  }
  const float (&values(Attribute attribute, std::int64_t point) const)[4] {
    return values_[static_cast<std::size_t>(attribute)][point];
  }

 private:
  alignas(glev::kCacheLine) std::byte scratch_[kMost * (glev::kMaxOrder + 2) * sizeof(double)];
  float values_[glev::kAttributes][2 * kMost][4];
};

// Calls body(first, count) for parts of the indices from `first` to `last`.
template <class Body>
void for_each_part(const glev_plan& plan, std::int64_t first, std::int64_t last, const Body& body) {
  const std::int64_t most = MeshPart::most(plan);
  for (std::int64_t i = first; i <= last; i += most) body(i, std::min(most, last - i + 1));
}

}  // namespace

void glev_context::eval_mesh1(glev_enum mode, glev_int i1, glev_int i2) {
  if (mode != GLEV_POINT && mode != GLEV_LINE) return record_error(GLEV_INVALID_ENUM);
  draw_mesh(1, mode, i1, i2, 0, 0);
}

void glev_context::eval_mesh2(glev_enum mode, glev_int i1, glev_int i2, glev_int j1, glev_int j2) {
  if (mode != GLEV_POINT && mode != GLEV_LINE && mode != GLEV_FILL) return record_error(GLEV_INVALID_ENUM);
  draw_mesh(2, mode, i1, i2, j1, j2);
}

void glev_context::draw_mesh(int dimension, glev_enum mode, std::int64_t i1, std::int64_t i2, std::int64_t j1,
                             std::int64_t j2) {
  if (is_rejected_in_primitive()) return;
  const glev_plan* const plan = plan_to_draw(dimension);
  if (plan == nullptr) return;
  const bool has_vertices_only = plan->has_vertices_only();
  const auto emit_point = [=, this](const MeshPart& part, std::int64_t point) {
    emit_staged(*plan, [&](glev_vertex* vertex) {
      std::copy_n(part.values(Attribute::kVertex, point), 4, vertex->position);
      if (has_vertices_only) return;
      for (const Attribute attribute : kOtherAttributes) {
        if (plan->components(attribute) != 0 ||
            (attribute == Attribute::kNormal && plan->automatic_normals()))
          put(part.values(attribute, point), attribute, vertex);
      }
    });
  };
  // Emits the points of row j, or those of column i.
  const auto emit_row = [&](std::int64_t j) {
    for_each_part(*plan, i1, i2, [&](std::int64_t i, std::int64_t count) {
      const MeshPart part(*plan, i, j, count, 1);
      for (std::int64_t point = 0; point < count; ++point) emit_point(part, point);
    });
  };
  const auto emit_column = [&](std::int64_t i) {
    for_each_part(*plan, j1, j2, [&](std::int64_t j, std::int64_t count) {
      const MeshPart part(*plan, i, j, 1, count);
      for (std::int64_t point = 0; point < count; ++point) emit_point(part, point);
    });
  };
  if (mode == GLEV_POINT) {
    mesh_primitive(GLEV_POINTS, [&] {
      for (std::int64_t j = j1; j <= j2; ++j) emit_row(j);
    });
  } else if (mode == GLEV_LINE) {
    for (std::int64_t j = j1; j <= j2; ++j) mesh_primitive(GLEV_LINE_STRIP, [&] { emit_row(j); });
    for (std::int64_t i = i1; i <= i2 && dimension == 2; ++i)
      mesh_primitive(GLEV_LINE_STRIP, [&] { emit_column(i); });
  } else {
    for (std::int64_t j = j1; j < j2; ++j) {
      mesh_primitive(GLEV_QUAD_STRIP, [&] {
        for_each_part(*plan, i1, i2, [&](std::int64_t i, std::int64_t count) {
          const MeshPart part(*plan, i, j, count, 2);
          for (std::int64_t point = 0; point < count; ++point) {
            emit_point(part, point);
            emit_point(part, count + point);
          }
        });
      });
    }
  }
}

// ---- Primitives

void glev_context::begin(glev_enum mode) {
  const bool known = mode <= GLEV_POLYGON || (mode >= kLinesAdjacency && mode <= kTriangleStripAdjacency);
  if (!known && mode != kPatches) return record_error(GLEV_INVALID_ENUM);
  if (is_rejected_in_primitive()) return;
  if (mode == kPatches) return record_error(GLEV_INVALID_OPERATION);
  in_primitive_ = true;
  call_sink(sink_.begin, mode);
  in_default_environment_ = glev::in_default_environment();
}

void glev_context::end() {
  if (!in_primitive_ || in_mesh_) return record_error(GLEV_INVALID_OPERATION);
  direct_ = {};
  call_sink(sink_.end);
  in_primitive_ = false;
}

void glev_context::vertex(const std::array<float, 4>& position) {
  if (!in_primitive_) return;
  glev_vertex vertex = current_.values();
  copy_to(vertex.position, position);
  emit(vertex);
}

glev_result glev_context::set_sink(const glev_sink* sink) {
  glev_sink copy{};
  const glev_result result = sink != nullptr ? glev::read_struct(sink, &copy) : GLEV_SUCCESS;
  if (result != GLEV_SUCCESS) return result;
  if (in_primitive_) return GLEV_ERROR_IN_PRIMITIVE;
  sink_ = copy;
  return GLEV_SUCCESS;
}

// ---- Current values

void glev_context::color(const std::array<float, 4>& color) { copy_to(current_.change().color, color); }

void glev_context::normal(const std::array<float, 3>& normal) { copy_to(current_.change().normal, normal); }

void glev_context::multi_tex_coord(glev_enum texture, const std::array<float, 4>& texcoord) {
  if (!is_texture_unit(texture)) return record_error(GLEV_INVALID_ENUM);
  copy_to(current_.change().texcoord[texture - GLEV_TEXTURE0], texcoord);
}

void glev_context::active_texture(glev_enum texture) {
  if (!is_texture_unit(texture)) return record_error(GLEV_INVALID_ENUM);
  if (is_rejected_in_primitive()) return;
  active_unit_ = texture - GLEV_TEXTURE0;
}

// ---- Attribute stack

void glev_context::push_attrib(glev_bitfield mask) {
  if (is_rejected_in_primitive()) return;
  if (attrib_depth_ == glev::kAttribStackDepth) return record_error(GLEV_STACK_OVERFLOW);
  attribs_[attrib_depth_++] = {mask, eval_, current_.values(), active_unit_, list_base_};
}

void glev_context::pop_attrib() {
  const glev::DefaultEnvironment environment;
  if (is_rejected_in_primitive()) return;
  if (attrib_depth_ == 0) return record_error(GLEV_STACK_UNDERFLOW);
  const glev::SavedAttributes& saved = attribs_[--attrib_depth_];
  if ((saved.mask & (GLEV_ENABLE_BIT | GLEV_EVAL_BIT)) != 0) {
    const glev::EvalAttributes before = eval_;
    eval_.enabled = saved.eval.enabled;
    eval_.auto_normal = saved.eval.auto_normal;
    if (GLEV_AT(grid_was_saved, (saved.mask & GLEV_EVAL_BIT) != 0)) eval_.grid = saved.eval.grid;
    // If the state of a dimension is unchanged, its plan is kept.
    const auto changed = [&](int d) {
      return GLEV_AT(pop_changes_maps,
                     eval_.enabled[d] != before.enabled[d] || eval_.grid[d] != before.grid[d]);
    };
    if (changed(0)) drop_plan(1);
    if (changed(1) || GLEV_AT(pop_changes_normals, eval_.auto_normal != before.auto_normal)) drop_plan(2);
  }
  if ((saved.mask & GLEV_CURRENT_BIT) != 0) current_.change() = saved.current;
  if ((saved.mask & GLEV_TEXTURE_BIT) != 0) active_unit_ = saved.active_unit;
  if ((saved.mask & GLEV_LIST_BIT) != 0) list_base_ = saved.list_base;
}

// ---- Queries

glev::StateValues glev_context::find_state(glev_enum pname) {
  const Grid& curve = eval_.grid[0][0];
  const auto& [u, v] = eval_.grid[1];
  switch (pname) {
    case GLEV_MAX_EVAL_ORDER:
      return {1, {glev::kMaxOrder}};
    case GLEV_MAP1_GRID_DOMAIN:
      return {2, {curve.u1, curve.u2}};
    case GLEV_MAP1_GRID_SEGMENTS:
      return {1, {static_cast<double>(curve.segments)}};
    case GLEV_MAP2_GRID_DOMAIN:
      return {4, {u.u1, u.u2, v.u1, v.u2}};
    case GLEV_MAP2_GRID_SEGMENTS:
      return {2, {static_cast<double>(u.segments), static_cast<double>(v.segments)}};
    case GLEV_CURRENT_COLOR:
      return from_floats(current_.values().color, true);
    case GLEV_CURRENT_INDEX:
      return {1, {current_.values().index}};
    case GLEV_CURRENT_NORMAL:
      return from_floats(current_.values().normal, true);
    case GLEV_CURRENT_TEXTURE_COORDS:
      return from_floats(current_.values().texcoord[active_unit_], false);
    case GLEV_EDGE_FLAG:
      return {1, {static_cast<double>(current_.values().edge_flag)}};
    case GLEV_ACTIVE_TEXTURE:
      return {1, {static_cast<double>(GLEV_TEXTURE0 + active_unit_)}};
    case GLEV_MAX_TEXTURE_COORDS:
    case GLEV_MAX_TEXTURE_UNITS:
      return {1, {GLEV_TEXTURE_UNITS}};
    case GLEV_LIST_BASE:
      return {1, {static_cast<double>(list_base_)}};
    case GLEV_LIST_INDEX:
      return {1, {static_cast<double>(open_.name)}};
    case GLEV_LIST_MODE:
      return {1, {static_cast<double>(open_.mode)}};
    case GLEV_MAX_LIST_NESTING:
      return {1, {glev::kMaxListNesting}};
    case GLEV_ATTRIB_STACK_DEPTH:
      return {1, {static_cast<double>(attrib_depth_)}};
    case GLEV_MAX_ATTRIB_STACK_DEPTH:
      return {1, {glev::kAttribStackDepth}};
    default:
      break;
  }
  if (const bool* flag = find_flag(pname)) return {1, {*flag ? 1.0 : 0.0}};
  return {0, {}};
}

template <class Number>
void glev_context::get(glev_enum pname, Number* v) {
  const glev::DefaultEnvironment environment;
  const glev::StateValues state = find_state(pname);
  if (state.count == 0) return record_error(GLEV_INVALID_ENUM);
  if (v == nullptr) return record_error(GLEV_INVALID_VALUE);
  if (is_rejected_in_primitive()) return;
  const auto kind = state.normalized ? glev::StateKind::kNormalized : glev::StateKind::kNumber;
  for (int i = 0; i < state.count; ++i) glev::convert(state.values[i], kind, v + i);
}

template void glev_context::get(glev_enum, glev_boolean*);
template void glev_context::get(glev_enum, glev_int*);
template void glev_context::get(glev_enum, glev_float*);
template void glev_context::get(glev_enum, glev_double*);

const char* glev_context::get_string(glev_enum name) {
  const char* answer = name == GLEV_VENDOR     ? "evalcts"
                       : name == GLEV_RENDERER ? "glevaluator, correctly rounded"
                       : name == GLEV_VERSION  ? "4.6 glevaluator " GLEV_VERSION_STRING
                                               : nullptr;
  if (answer == nullptr) {
    record_error(GLEV_INVALID_ENUM);
    return nullptr;
  }
  return is_rejected_in_primitive() ? nullptr : answer;
}
