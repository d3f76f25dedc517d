#include "context.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "command.h"
#include "convert.h"
#include "environment.h"

using glev::Attribute;
using glev::FindTarget;
using glev::Grid;
using glev::GridArgument;
using glev::Target;

namespace {

constexpr glev_enum kLinesAdjacency = 0x000A, kTriangleStripAdjacency = 0x000D, kPatches = 0x000E;

bool IsTextureUnit(glev_enum texture) { return texture - GLEV_TEXTURE0 < GLEV_TEXTURE_UNITS; }

template <std::size_t kCount>
void CopyTo(float (&to)[kCount], const std::array<float, kCount>& from) {
  for (std::size_t k = 0; k < kCount; ++k) to[k] = from[k];
}

template <std::size_t kCount>
glev::StateValues FromFloats(const float (&from)[kCount], bool normalized) {
  glev::StateValues state{static_cast<int>(kCount), {}, normalized};
  for (std::size_t k = 0; k < kCount; ++k) state.values[k] = from[k];
  return state;
}

}  // namespace

glev_context::glev_context(const glev::Allocator& allocator, const glev::Kernels* kernels)
    : allocator_(allocator), kernels_(kernels) {
  current_.Change().size = sizeof(glev_vertex);
  Color({1, 1, 1, 1});
  Normal({0, 0, 1});
  for (auto& texcoord : current_.Change().texcoord) CopyTo(texcoord, {0, 0, 0, 1});
  Index(1);
  EdgeFlag(true);
}

glev_context::~glev_context() {
  for (const int dimension : {1, 2}) DropPlan(dimension);
  for (auto& maps : maps_) {
    for (auto& map : maps) map.Free(allocator_);
  }
  open_.list.Free(allocator_);
  lists_.Free(allocator_);
}

// ---- Errors

glev_enum glev_context::GetError() {
  if (RefusedInPrimitive()) return 0;
  const glev_enum error = error_;
  error_ = GLEV_NO_ERROR;
  return error;
}

bool glev_context::RefusedInPrimitive() {
  if (in_primitive_) RecordError(GLEV_INVALID_OPERATION);
  return in_primitive_;
}

// ---- Maps

namespace {

// The error of the arguments alone, NO_ERROR if there is none.
glev_enum FindMapError(int dimension, glev_enum name, const std::array<glev::MapDirection, 2>& directions,
                       const void* points) {
  const Target target = FindTarget(name);
  if (target.dimension != dimension) return GLEV_INVALID_ENUM;
  const int components = glev::kSlotTable[target.slot].components;
  for (int d = 0; d < dimension; ++d) {
    const auto& [u1, u2, stride, order] = directions[d];
    if (order < 1 || order > glev::kMaxOrder || stride < components || u1 == u2) return GLEV_INVALID_VALUE;
  }
  return points == nullptr ? GLEV_INVALID_VALUE : GLEV_NO_ERROR;
}

}  // namespace

template <class Real>
void glev_context::DefineMap(int dimension, glev_enum name,
                             const std::array<glev::MapDirection, 2>& directions, const Real* points) {
  const glev::DefaultEnvironment environment;
  const glev_enum error = FindMapError(dimension, name, directions, points);
  if (error != GLEV_NO_ERROR) return RecordError(error);
  if (RefusedInPrimitive()) return;
  if (active_unit_ != 0) return RecordError(GLEV_INVALID_OPERATION);
  const int slot = FindTarget(name).slot;
  const auto& [u, v] = directions;
  glev::Map& map = maps_[dimension - 1][slot];
  if (!map.Define(allocator_, glev::kSlotTable[slot].components, u, v, points)) {
    return RecordError(GLEV_OUT_OF_MEMORY);
  }
  if (eval_.enabled[dimension - 1][slot]) DropPlan(dimension);
}

template <class Real>
void glev_context::IssueDefineMap(int dimension, glev_enum name,
                                  const std::array<glev::MapDirection, 2>& directions, const Real* points) {
  const glev::DefaultEnvironment environment;
  if (IsCompiling()) {
    const glev_enum error = FindMapError(dimension, name, directions, points);
    if (error != GLEV_NO_ERROR) {
      Compile(glev::ErrorCommand{error});
    } else {
      const int components = glev::kSlotTable[FindTarget(name).slot].components;
      const auto& [u, v] = directions;
      glev::DefineMapCommand packed{dimension, name, directions};
      packed.directions[0].stride = v.order * components;
      packed.directions[1].stride = components;
      const std::size_t values = static_cast<std::size_t>(u.order) * v.order * components;
      void* memory = Compile(packed, values * sizeof(double));
      if (memory != nullptr) glev::CopyPoints(components, u, v, points, new (memory) double[values]);
    }
    if (open_.mode == GLEV_COMPILE) return;
  }
  DefineMap(dimension, name, directions, points);
}

template void glev_context::DefineMap(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                      const double*);
template void glev_context::IssueDefineMap(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                           const float*);
template void glev_context::IssueDefineMap(int, glev_enum, const std::array<glev::MapDirection, 2>&,
                                           const double*);

template <class Number>
void glev_context::GetnMap(glev_enum name, glev_enum query, glev_int bytes, Number* v) {
  if (bytes < 0) return RecordError(GLEV_INVALID_VALUE);
  GetMap(name, query, static_cast<std::uint64_t>(bytes), v);
}

template void glev_context::GetnMap(glev_enum, glev_enum, glev_int, glev_double*);
template void glev_context::GetnMap(glev_enum, glev_enum, glev_int, glev_float*);
template void glev_context::GetnMap(glev_enum, glev_enum, glev_int, glev_int*);

template <class Number>
void glev_context::GetMap(glev_enum name, glev_enum query, std::uint64_t bytes, Number* v) {
  const glev::DefaultEnvironment environment;
  const Target target = FindTarget(name);
  if (!target || (query != GLEV_COEFF && query != GLEV_ORDER && query != GLEV_DOMAIN)) {
    return RecordError(GLEV_INVALID_ENUM);
  }
  if (v == nullptr) return RecordError(GLEV_INVALID_VALUE);
  if (RefusedInPrimitive()) return;

  const glev::Map& map = maps_[target.dimension - 1][target.slot];
  const int points = map.order(0) * map.order(1) * glev::kSlotTable[target.slot].components;
  const int count = query == GLEV_COEFF    ? points
                    : query == GLEV_DOMAIN ? 2 * target.dimension
                                           : target.dimension;
  if (bytes < count * sizeof(Number)) return RecordError(GLEV_INVALID_OPERATION);
  const auto put = [&v](double value) { glev::Convert(value, glev::StateKind::kNumber, v++); };
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

template void glev_context::GetMap(glev_enum, glev_enum, std::uint64_t, glev_double*);
template void glev_context::GetMap(glev_enum, glev_enum, std::uint64_t, glev_float*);
template void glev_context::GetMap(glev_enum, glev_enum, std::uint64_t, glev_int*);

// ---- Enables

bool* glev_context::FindFlag(glev_enum cap) {
  if (cap == GLEV_AUTO_NORMAL) return &eval_.auto_normal;
  const Target target = FindTarget(cap);
  return target ? &eval_.enabled[target.dimension - 1][target.slot] : nullptr;
}

void glev_context::SetEnabled(glev_enum cap, bool enabled) {
  bool* flag = FindFlag(cap);
  if (flag == nullptr) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedInPrimitive()) return;
  if (*flag == enabled) return;
  *flag = enabled;
  DropPlan(FindTarget(cap).dimension == 1 ? 1 : 2);  // AUTO_NORMAL belongs to 2
}

bool glev_context::IsEnabled(glev_enum cap) {
  const bool* flag = FindFlag(cap);
  if (flag == nullptr) {
    RecordError(GLEV_INVALID_ENUM);
    return false;
  }
  return !RefusedInPrimitive() && *flag;
}

// ---- Evaluation

glev_plan* glev_context::CurrentPlan(int dimension) {
  glev_plan*& plan = plans_[dimension - 1];
  if (plan == nullptr) {
    const glev::DefaultEnvironment environment;
    plan = glev_plan::Create(
        allocator_, {dimension, maps_[dimension - 1], eval_.enabled[dimension - 1], eval_.grid[dimension - 1],
                     dimension == 2 && eval_.auto_normal, kernels_});
  }
  return plan;
}

void glev_context::DropPlan(int dimension) {
  current_.Unstage();
  direct_[dimension - 1] = nullptr;
  glev_plan*& plan = plans_[dimension - 1];
  if (plan != nullptr) plan->Release();
  plan = nullptr;
}

const glev_plan* glev_context::PlanToDraw(int dimension) {
  const glev_plan* plan = CurrentPlan(dimension);
  if (plan == nullptr) {
    RecordError(GLEV_OUT_OF_MEMORY);
    return nullptr;
  }
  return plan->components(Attribute::kVertex) != 0 ? plan : nullptr;
}

// Vertices within a callback: it has the staged one in its hands.
void glev_context::EmitWithin(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                              const glev::NormalRow* row) {
  glev_vertex vertex = current_.values();
  EvaluateInto(plan, u, v, row, &vertex);
  Emit(vertex);
}

void glev_context::EmitAt(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                          const glev::NormalRow* row) {
  if (callbacks_ > 0) return EmitWithin(plan, u, v, row);
  glev_vertex& vertex = current_.StagedFor(&plan);
  EvaluateInto(plan, u, v, row, &vertex);
  Emit(vertex);
}

inline void glev_context::EvaluateInto(const glev_plan& plan, const GridArgument& u, const GridArgument& v,
                                       const glev::NormalRow* row, glev_vertex* vertex) const {
  const glev::DefaultEnvironment environment;
  const auto evaluate = [&](Attribute attribute, float* values) {
    glev::ValuesAt(plan, attribute, u, v, values);
  };
  evaluate(Attribute::kVertex, vertex->position);
  if (plan.has_vertices_only()) return;
  if (plan.components(Attribute::kColor) != 0) evaluate(Attribute::kColor, vertex->color);
  if (plan.components(Attribute::kTexcoord) != 0) evaluate(Attribute::kTexcoord, vertex->texcoord[0]);
  if (plan.automatic_normals()) {
    CopyTo(vertex->normal, row->At(u));
  } else if (plan.components(Attribute::kNormal) != 0) {
    float values[4];
    evaluate(Attribute::kNormal, values);
    CopyTo(vertex->normal, {values[0], values[1], values[2]});
  }
}

void glev_context::EmitRow(const glev::NormalRow& row, const GridArgument& u) {
  EmitAt(row.plan(), u, row.v(), &row);
}

void glev_context::MoveTo(const GridArgument& v, glev::NormalRow* row) {
  const glev::DefaultEnvironment environment;
  row->MoveTo(v);
}

void glev_context::EvaluateAt(int dimension, const GridArgument& u, const GridArgument& v) {
  if (!in_primitive_) return;
  const glev_plan* plan = PlanToDraw(dimension);
  if (plan == nullptr) return;
  if (plan->automatic_normals()) return EvaluateWithRow(*plan, u, v);
  EmitAt(*plan, u, v, nullptr);
  // A callback may have ended the primitive, and the plan.
  if (plans_[dimension - 1] == plan && IsDirect(*plan)) direct_[dimension - 1] = plan;
}

bool glev_context::IsDirect(const glev_plan& plan) const {
  return plan.direct() != nullptr && in_primitive_ && !in_mesh_ && callbacks_ == 0 && open_.mode == 0 &&
         in_default_environment_;
}

// Apart, for its large frame.
void glev_context::EvaluateWithRow(const glev_plan& plan, const GridArgument& u, const GridArgument& v) {
  glev::NormalRow row(plan);
  MoveTo(v, &row);
  EmitRow(row, u);
}

void glev_context::EvalCoord(int dimension, double u, double v) {
  EvaluateAt(dimension, glev::At(u), glev::At(v));
}

void glev_context::SetGrid(int dimension, const std::array<Grid, 2>& grid) {
  for (const Grid& direction : grid) {
    if (direction.segments <= 0) return RecordError(GLEV_INVALID_VALUE);
  }
  if (RefusedInPrimitive()) return;
  eval_.grid[dimension - 1] = grid;
  DropPlan(dimension);
}

void glev_context::EvalPoint(int dimension, glev_int i, glev_int j) {
  const auto& [u, v] = eval_.grid[dimension - 1];
  EvaluateAt(dimension, GridArgument{u, i}, GridArgument{v, j});
}

// ---- Meshes (the loops of GL §21.1). Indices are 64 bits wide: one past the last int is no problem then.

template <class Body>
void glev_context::MeshPrimitive(glev_enum mode, const Body& body) {
  in_mesh_ = true;
  in_primitive_ = true;
  CallSink(sink_.begin, mode);
  body();
  CallSink(sink_.end);
  in_primitive_ = false;
  in_mesh_ = false;
}

void glev_context::EvalMesh1(glev_enum mode, glev_int i1, glev_int i2) {
  if (mode != GLEV_POINT && mode != GLEV_LINE) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedInPrimitive()) return;
  const glev_plan* plan = PlanToDraw(1);
  if (plan == nullptr) return;

  glev::NormalRow row(*plan);
  MoveTo({}, &row);
  MeshPrimitive(mode == GLEV_POINT ? GLEV_POINTS : GLEV_LINE_STRIP, [&] {
    for (std::int64_t i = i1; i <= i2; ++i) EmitRow(row, GridArgument{plan->grid(0), i});
  });
}

void glev_context::EvalMesh2(glev_enum mode, glev_int i1, glev_int i2, glev_int j1, glev_int j2) {
  if (mode != GLEV_POINT && mode != GLEV_LINE && mode != GLEV_FILL) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedInPrimitive()) return;
  const glev_plan* plan = PlanToDraw(2);
  if (plan == nullptr) return;

  const auto u = [&](std::int64_t i) { return GridArgument{plan->grid(0), i}; };
  const auto v = [&](std::int64_t j) { return GridArgument{plan->grid(1), j}; };
  glev::NormalRow row(*plan);
  if (mode == GLEV_POINT) {
    MeshPrimitive(GLEV_POINTS, [&] {
      for (std::int64_t j = j1; j <= j2; ++j) {
        MoveTo(v(j), &row);
        for (std::int64_t i = i1; i <= i2; ++i) EmitRow(row, u(i));
      }
    });
  } else if (mode == GLEV_LINE) {
    for (std::int64_t j = j1; j <= j2; ++j) {
      MoveTo(v(j), &row);
      MeshPrimitive(GLEV_LINE_STRIP, [&] {
        for (std::int64_t i = i1; i <= i2; ++i) EmitRow(row, u(i));
      });
    }
    for (std::int64_t i = i1; i <= i2; ++i) {
      MeshPrimitive(GLEV_LINE_STRIP, [&] {
        for (std::int64_t j = j1; j <= j2; ++j) {
          MoveTo(v(j), &row);
          EmitRow(row, u(i));
        }
      });
    }
  } else {
    glev::NormalRow next(*plan);
    glev::NormalRow *lower = &row, *upper = &next;
    MoveTo(v(j1), lower);
    for (std::int64_t j = j1; j < j2; ++j) {
      MoveTo(v(j + 1), upper);
      MeshPrimitive(GLEV_QUAD_STRIP, [&] {
        for (std::int64_t i = i1; i <= i2; ++i) {
          EmitRow(*lower, u(i));
          EmitRow(*upper, u(i));
        }
      });
      std::swap(lower, upper);
    }
  }
}

// ---- Primitives

void glev_context::Begin(glev_enum mode) {
  const bool known = mode <= GLEV_POLYGON || (mode >= kLinesAdjacency && mode <= kTriangleStripAdjacency);
  if (!known && mode != kPatches) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedInPrimitive()) return;
  if (mode == kPatches) return RecordError(GLEV_INVALID_OPERATION);
  in_primitive_ = true;
  CallSink(sink_.begin, mode);
  in_default_environment_ = glev::InDefaultEnvironment();
}

void glev_context::End() {
  if (!in_primitive_ || in_mesh_) return RecordError(GLEV_INVALID_OPERATION);
  direct_ = {};
  CallSink(sink_.end);
  in_primitive_ = false;
}

void glev_context::Vertex(const std::array<float, 4>& position) {
  if (!in_primitive_) return;
  glev_vertex vertex = current_.values();
  CopyTo(vertex.position, position);
  Emit(vertex);
}

glev_result glev_context::SetSink(const glev_sink* sink) {
  glev_sink copy{};
  if (sink != nullptr && !glev::ReadStruct(sink, &copy)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (in_primitive_) return GLEV_ERROR_IN_PRIMITIVE;
  sink_ = copy;
  return GLEV_SUCCESS;
}

// ---- Current values

void glev_context::Color(const std::array<float, 4>& color) { CopyTo(current_.Change().color, color); }

void glev_context::Normal(const std::array<float, 3>& normal) { CopyTo(current_.Change().normal, normal); }

void glev_context::MultiTexCoord(glev_enum texture, const std::array<float, 4>& texcoord) {
  if (!IsTextureUnit(texture)) return RecordError(GLEV_INVALID_ENUM);
  CopyTo(current_.Change().texcoord[texture - GLEV_TEXTURE0], texcoord);
}

void glev_context::ActiveTexture(glev_enum texture) {
  if (!IsTextureUnit(texture)) return RecordError(GLEV_INVALID_ENUM);
  if (RefusedInPrimitive()) return;
  active_unit_ = texture - GLEV_TEXTURE0;
}

// ---- Attribute stack

void glev_context::PushAttrib(glev_bitfield mask) {
  if (RefusedInPrimitive()) return;
  if (attrib_depth_ == glev::kAttribStackDepth) return RecordError(GLEV_STACK_OVERFLOW);
  attribs_[attrib_depth_++] = {mask, eval_, current_.values(), active_unit_, list_base_};
}

void glev_context::PopAttrib() {
  const glev::DefaultEnvironment environment;
  if (RefusedInPrimitive()) return;
  if (attrib_depth_ == 0) return RecordError(GLEV_STACK_UNDERFLOW);
  const glev::SavedAttributes& saved = attribs_[--attrib_depth_];
  if ((saved.mask & (GLEV_ENABLE_BIT | GLEV_EVAL_BIT)) != 0) {
    const glev::EvalAttributes before = eval_;
    eval_.enabled = saved.eval.enabled;
    eval_.auto_normal = saved.eval.auto_normal;
    if ((saved.mask & GLEV_EVAL_BIT) != 0) eval_.grid = saved.eval.grid;
    // What is as before keeps its plan.
    const auto changed = [&](int d) {
      return eval_.enabled[d] != before.enabled[d] || eval_.grid[d] != before.grid[d];
    };
    if (changed(0)) DropPlan(1);
    if (changed(1) || eval_.auto_normal != before.auto_normal) DropPlan(2);
  }
  if ((saved.mask & GLEV_CURRENT_BIT) != 0) current_.Change() = saved.current;
  if ((saved.mask & GLEV_TEXTURE_BIT) != 0) active_unit_ = saved.active_unit;
  if ((saved.mask & GLEV_LIST_BIT) != 0) list_base_ = saved.list_base;
}

// ---- Queries

glev::StateValues glev_context::FindState(glev_enum pname) {
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
      return FromFloats(current_.values().color, true);
    case GLEV_CURRENT_INDEX:
      return {1, {current_.values().index}};
    case GLEV_CURRENT_NORMAL:
      return FromFloats(current_.values().normal, true);
    case GLEV_CURRENT_TEXTURE_COORDS:
      return FromFloats(current_.values().texcoord[active_unit_], false);
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
  if (const bool* flag = FindFlag(pname)) return {1, {*flag ? 1.0 : 0.0}};
  return {0, {}};
}

template <class Number>
void glev_context::Get(glev_enum pname, Number* v) {
  const glev::DefaultEnvironment environment;
  const glev::StateValues state = FindState(pname);
  if (state.count == 0) return RecordError(GLEV_INVALID_ENUM);
  if (v == nullptr) return RecordError(GLEV_INVALID_VALUE);
  if (RefusedInPrimitive()) return;
  const auto kind = state.normalized ? glev::StateKind::kNormalized : glev::StateKind::kNumber;
  for (int i = 0; i < state.count; ++i) glev::Convert(state.values[i], kind, v + i);
}

template void glev_context::Get(glev_enum, glev_boolean*);
template void glev_context::Get(glev_enum, glev_int*);
template void glev_context::Get(glev_enum, glev_float*);
template void glev_context::Get(glev_enum, glev_double*);

const char* glev_context::GetString(glev_enum name) {
  const char* answer = name == GLEV_VENDOR     ? "evalcts"
                       : name == GLEV_RENDERER ? "glevaluator, correctly rounded"
                       : name == GLEV_VERSION  ? "4.6 glevaluator " GLEV_VERSION_STRING
                                               : nullptr;
  if (answer == nullptr) {
    RecordError(GLEV_INVALID_ENUM);
    return nullptr;
  }
  return RefusedInPrimitive() ? nullptr : answer;
}
