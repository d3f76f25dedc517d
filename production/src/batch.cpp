// Batches: arrays of arguments, or points of a grid, through a plan into memory of the caller.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "environment.h"
#include "kernels.h"
#include "normal.h"
#include "plan.h"
#include "resolve.h"
#include "structures.h"

namespace {

using glev::Attribute, glev::GridArgument, glev::kAttributes, glev::kCacheLine;

// rows * columns > 0 elements of `element` bytes, `stride` bytes from one to the next, `row_stride` from row
// to row.
struct Stream {
  const std::byte* begin = nullptr;
  std::size_t columns = 0, rows = 1, stride = 0, row_stride = 0, element = 0;

  // In so many bytes, and in the address space, whatever the caller claims.
  bool fits_into(std::size_t bytes) const {
    const std::size_t room = std::min<std::size_t>(bytes, UINTPTR_MAX - first_byte());
    if (element > room) return false;
    const std::size_t left = room - element;
    if (stride != 0 && columns - 1 > left / stride) return false;
    return row_stride == 0 || rows - 1 <= (left - (columns - 1) * stride) / row_stride;
  }
  // Only after fits_into: nothing overflows then.
  std::uintptr_t first_byte() const { return reinterpret_cast<std::uintptr_t>(begin); }
  std::uintptr_t past_last_byte() const {
    return first_byte() + (rows - 1) * row_stride + (columns - 1) * stride + element;
  }
};

// Rows of the strides and columns of `first`, `offset` bytes apart.
bool rows_share_bytes(const Stream& first, const Stream& second, std::size_t offset) {
  if (offset >= (first.columns - 1) * first.stride + first.element) return false;
  if (first.columns == 1) return true;
  const std::size_t column = offset / first.stride, rest = offset % first.stride;
  return rest < first.element || (rest + second.element > first.stride && column + 1 < first.columns);
}

// b is an output, so its stride is positive. With different strides any overlap of the extents counts.
bool share_bytes(const Stream& a, const Stream& b) {
  if (a.past_last_byte() <= b.first_byte() || b.past_last_byte() <= a.first_byte()) return false;
  if (a.stride != b.stride || a.columns != b.columns || a.rows != b.rows || a.row_stride != b.row_stride)
    return true;
  const Stream& low = a.first_byte() <= b.first_byte() ? a : b;
  const Stream& high = &low == &a ? b : a;
  const std::size_t offset = high.first_byte() - low.first_byte();
  if (a.rows == 1) return rows_share_bytes(low, high, offset);
  // A row of `high` begins in a row of `low`, or in the padding after it, and may reach into the next one.
  const std::size_t row = offset / a.row_stride, rest = offset % a.row_stride;
  return rows_share_bytes(low, high, rest) ||
         (row + 1 < a.rows && rows_share_bytes(high, low, a.row_stride - rest));
}

// ---- Outputs

constexpr int kTangentU = kAttributes, kOutputs = kAttributes + 2;
static_assert(kTangentU == GLEV_ATTRIBUTE_TANGENT_U && kOutputs == GLEV_ATTRIBUTE_TANGENT_V + 1);

struct Output {
  bool is_wanted = false, is_double = false;
  int components = 0;
  std::byte* data = nullptr;
  std::size_t bytes = 0;
  Stream stream;

  std::byte* address_of(std::size_t column, std::size_t row) const {
    return data + column * stream.stride + row * stream.row_stride;
  }
};

using Outputs = std::array<Output, kOutputs>;

glev_result read_output(const glev_output* given, std::size_t columns, std::size_t rows, bool has_rows,
                        std::size_t map_components, std::size_t most_components, Output* output) {
  glev_output copy;
  if (!glev::read_struct(given, &copy)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (map_components == 0) return GLEV_ERROR_NO_MAP;
  if (copy.components < map_components || copy.components > most_components)
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (copy.type != 0 && copy.type != GLEV_FLOAT && copy.type != GLEV_DOUBLE)
    return GLEV_ERROR_INVALID_ARGUMENT;
  const bool is_double = copy.type == GLEV_DOUBLE;
  const std::size_t element = copy.components * (is_double ? sizeof(double) : sizeof(float));
  const bool is_empty = columns == 0 || rows == 0;
  if (copy.stride < element || (copy.data == nullptr && !is_empty)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (!has_rows && copy.row_stride != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  std::size_t row_stride = 0;
  if (has_rows && !is_empty) {
    // No row is larger than the address space.
    if (columns > SIZE_MAX / copy.stride) return GLEV_ERROR_BUFFER_TOO_SMALL;
    row_stride = copy.row_stride != 0 ? copy.row_stride : columns * copy.stride;
    if (row_stride < (columns - 1) * copy.stride + element) return GLEV_ERROR_INVALID_ARGUMENT;
  }
  auto* const data = static_cast<std::byte*>(copy.data);
  *output = {true, is_double,      static_cast<int>(copy.components),
             data, copy.data_size, {data, columns, rows, copy.stride, row_stride, element}};
  return GLEV_SUCCESS;
}

// C programs may have put any number there, which C++ must not read as an enumerator.
template <class Enum>
unsigned number_of(const Enum& enumerator) {
  unsigned number;
  static_assert(sizeof number == sizeof enumerator);
  std::memcpy(&number, &enumerator, sizeof number);
  return number;
}

bool is_precision(const glev_precision& precision) {
  return number_of(precision) == GLEV_CORRECTLY_ROUNDED || number_of(precision) == GLEV_FAST;
}

glev_result read_outputs(const glev_plan& plan, const glev_attribute_output* given, std::size_t count,
                         std::size_t columns, std::size_t rows, bool has_rows, Outputs* outputs) {
  if (given == nullptr && count != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned o = number_of(given[i].attribute);
    // An attribute is there once at most, so `count` is at most kOutputs.
    if (o >= kOutputs || (*outputs)[o].is_wanted) return GLEV_ERROR_INVALID_ARGUMENT;
    const bool is_normal = o == static_cast<unsigned>(Attribute::kNormal);
    const glev_result result = read_output(given[i].output, columns, rows, has_rows,
                                           glevGetPlanComponents(&plan, static_cast<glev_attribute>(o)),
                                           is_normal ? 3 : 4, &(*outputs)[o]);
    if (result != GLEV_SUCCESS) return result;
  }
  return GLEV_SUCCESS;
}

// Sizes and overlaps, with what else is read or written.
template <std::size_t kOthers>
glev_result check_memory(const Outputs& outputs, const std::array<Stream, kOthers>& others) {
  for (const Output& output : outputs) {
    if (output.is_wanted && !output.stream.fits_into(output.bytes)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  for (int a = 0; a < kOutputs; ++a) {
    if (!outputs[a].is_wanted) continue;
    for (const Stream& other : others) {
      if (other.columns != 0 && share_bytes(other, outputs[a].stream)) return GLEV_ERROR_OVERLAP;
    }
    for (int b = 0; b < a; ++b) {
      if (outputs[b].is_wanted && share_bytes(outputs[b].stream, outputs[a].stream))
        return GLEV_ERROR_OVERLAP;
    }
  }
  return GLEV_SUCCESS;
}

// ---- What has no kernel

void put(const Output& output, std::byte* to, const std::array<double, 4>& values) {
  std::array<float, 4> floats;
  if (output.is_double) {
    std::memcpy(to, values.data(), output.stream.element);
    return;
  }
  for (std::size_t k = 0; k < 4; ++k) floats[k] = static_cast<float>(values[k]);
  std::memcpy(to, floats.data(), output.stream.element);
}

// u(i) and v(j) of the columns and rows: one of both is constant in a batch of scattered arguments.
template <class U, class V, class Function>
void for_each(const Output& output, const U& u, const V& v, const Function& function) {
  for (std::size_t j = 0; j < output.stream.rows; ++j) {
    for (std::size_t i = 0; i < output.stream.columns; ++i)
      put(output, output.address_of(i, j), function(u(i), v(i, j)));
  }
}

template <class U, class V>
void evaluate_in_double(const glev::PreparedMap& map, const Output& output, const U& u, const V& v) {
  for_each(output, u, v, [&](const GridArgument& at_u, const GridArgument& at_v) {
    std::array<double, 4> values = {0, 0, 0, 1};
    for (int k = 0; k < map.surface.components; ++k) values[k] = glev::resolve_in_double(map, k, at_u, at_v);
    return values;
  });
}

template <class U, class V>
void evaluate_normals(const glev_plan& plan, const Output& output, const U& u, const V& v) {
  glev::NormalRow row(plan);
  for_each(output, u, v, [&](const GridArgument& at_u, const GridArgument& at_v) {
    row.move_to(at_v);
    const std::array<float, 3> normal = row.normal_at(at_u);
    return std::array<double, 4>{normal[0], normal[1], normal[2], 0};
  });
}

template <class U, class V>
void evaluate_tangents(const glev_plan& plan, int direction, const Output& output, const U& u, const V& v) {
  const glev::Surface& tangent = plan.tangent(direction);
  const double factor = plan.tangent_factor(direction);
  std::array<double, glev::kMaxOrder * 4> room;
  for_each(output, u, v, [&](const GridArgument& at_u, const GridArgument& at_v) {
    std::array<double, 4> values{};
    if (tangent.components == 0) return values;
    const glev::Curve curve = curve_at(tangent, locate(tangent.domain[1], at_v), room.data());
    evaluate(curve, locate(tangent.domain[0], at_u), values.data());
    for (double& value : values) value *= factor;
    for (int k = 0; k < tangent.components && output.is_double; ++k)
      glev::resolve_derivative_in_double(plan.map(Attribute::kVertex), direction, k, at_u, at_v, &values[k]);
    return values;
  });
}

// // Point by point. v: null for curves.
void evaluate_points(const glev_plan& plan, const glev::PreparedMap& map, const glev::Input& u,
                     const glev::Input* v, std::size_t count, const glev::Destination& to) {
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 4> values;
    const GridArgument at_v = glev::argument_at(v == nullptr ? 0 : (*v)[i]);
    plan.kernels().point(map, glev::argument_at(u[i]), at_v, values.data());
    for (std::size_t k = static_cast<std::size_t>(map.surface.components); k < 4; ++k)
      values[k] = k == 3 ? 1 : 0;
    std::memcpy(to.data + i * to.stride, values.data(),
                static_cast<std::size_t>(to.components) * sizeof(float));
  }
}

// All outputs: `evaluate` those of maps that have a kernel, `normals` automatic ones of floats and `doubles`
// those of maps if they can.
template <class U, class V, class Evaluate, class Normals, class Doubles>
void evaluate_all(const glev_plan& plan, const Outputs& outputs, const U& u, const V& v,
                  const Evaluate& evaluate, const Normals& normals, const Doubles& doubles) {
  const glev::DefaultEnvironment environment;
  for (int o = 0; o < kOutputs; ++o) {
    const Output& output = outputs[o];
    if (!output.is_wanted) continue;
    const glev::Destination to = {output.data, output.stream.stride, output.stream.row_stride,
                                  output.components};
    if (o >= kTangentU) {
      evaluate_tangents(plan, o - kTangentU, output, u, v);
    } else if (o == static_cast<int>(Attribute::kNormal) && plan.automatic_normals()) {
      if (output.is_double || !normals(to)) evaluate_normals(plan, output, u, v);
    } else if (output.is_double) {
      const glev::PreparedMap& map = plan.map(static_cast<Attribute>(o));
      if (!doubles(map, to)) evaluate_in_double(map, output, u, v);
    } else {
      evaluate(plan.map(static_cast<Attribute>(o)), to);
    }
  }
}

// ---- Meshes

// Count of i1..i2; an int's range always fits.
std::size_t count_of(glev_int i1, glev_int i2) {
  return i1 > i2 ? 0 : static_cast<std::size_t>(static_cast<std::int64_t>(i2) - i1 + 1);
}

// Well formed, but for its outputs and scratch.
bool read_mesh(const glev_plan* plan, const glev_mesh* given, glev_mesh* mesh) {
  if (plan == nullptr || !glev::read_struct(given, mesh) || !is_precision(mesh->precision)) return false;
  return plan->dimension() == 2 || (mesh->j1 == 0 && mesh->j2 == 0);
}

// Returns true if each normal follows its vertex, in floats, three components each.
bool are_records(const glev_plan& plan, const Output& vertex, const Output& normal) {
  const auto are_triples = [](const Output& output) {
    return output.is_wanted && !output.is_double && output.components == 3;
  };
  return are_triples(vertex) && are_triples(normal) && plan.components(Attribute::kVertex) == 3 &&
         normal.data == vertex.data + 3 * sizeof(float) && normal.stream.stride == vertex.stream.stride &&
         normal.stream.row_stride == vertex.stream.row_stride;
}

std::size_t scratch_of(const glev_plan& plan, std::size_t columns) {
  std::size_t bytes = 0;
  for (int a = 0; a < kAttributes; ++a) {
    const glev::Surface& surface = plan.surface(static_cast<Attribute>(a));
    if (surface.components != 0) bytes = std::max(bytes, glev::mesh_scratch(surface.degree[0], columns));
  }
  if (plan.automatic_normals()) {
    const glev::Surface& vertex = plan.surface(Attribute::kVertex);
    bytes = std::max(bytes, glev::normal_mesh_scratch(vertex.degree[0], columns));
  }
  return bytes + kCacheLine;
}

}  // namespace

glev_result glevEvaluate(const glev_plan* plan, const glev_batch* given) {
  glev_batch batch;
  if (plan == nullptr || !glev::read_struct(given, &batch)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (batch.type != GLEV_FLOAT && batch.type != GLEV_DOUBLE) return GLEV_ERROR_INVALID_ARGUMENT;
  if (!is_precision(batch.precision)) return GLEV_ERROR_INVALID_ARGUMENT;
  const bool has_v = plan->dimension() == 2, is_double = batch.type == GLEV_DOUBLE;
  if (batch.count != 0 && (batch.u.data == nullptr || (has_v && batch.v.data == nullptr)))
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (!has_v && (batch.v.data != nullptr || batch.v.data_size != 0 || batch.v.stride != 0))
    return GLEV_ERROR_INVALID_ARGUMENT;
  Outputs outputs;
  const glev_result result =
      read_outputs(*plan, batch.outputs, batch.output_count, batch.count, 1, false, &outputs);
  if (result != GLEV_SUCCESS || batch.count == 0) return result;

  const auto stream_of = [&](const glev_input& input) {
    const std::size_t element = is_double ? sizeof(double) : sizeof(float);
    return Stream{static_cast<const std::byte*>(input.data), batch.count, 1, input.stride, 0, element};
  };
  std::array<Stream, 2> inputs = {stream_of(batch.u)};
  if (!inputs[0].fits_into(batch.u.data_size)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  if (has_v) {
    inputs[1] = stream_of(batch.v);
    if (!inputs[1].fits_into(batch.v.data_size)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  const glev_result memory = check_memory(outputs, inputs);
  if (memory != GLEV_SUCCESS) return memory;

  const glev::Input u = {inputs[0].begin, inputs[0].stride, is_double},
                    v = {inputs[1].begin, inputs[1].stride, is_double};
  evaluate_all(
      *plan, outputs, [&](std::size_t i) { return glev::argument_at(u[i]); },
      [&](std::size_t i, std::size_t) { return has_v ? glev::argument_at(v[i]) : GridArgument{}; },
      [&](const glev::PreparedMap& map, const glev::Destination& to) {
        constexpr std::size_t kFew = 2;  // for which vectors are not worth their preparation
        if (batch.count <= kFew) {
          evaluate_points(*plan, map, u, has_v ? &v : nullptr, batch.count, to);
        } else if (has_v) {
          plan->kernels().surface(map, u, v, batch.count, to);
        } else {
          plan->kernels().curve(map, u, batch.count, to);
        }
      },
      [](const glev::Destination&) { return false; },
      [&](const glev::PreparedMap& map, const glev::Destination& to) {
        return !has_v && plan->kernels().double_curve(map, u, batch.count, to);
      });
  return GLEV_SUCCESS;
}

size_t glevGetMeshScratchSize(const glev_plan* plan, const glev_mesh* given) {
  glev_mesh mesh;
  return read_mesh(plan, given, &mesh) ? scratch_of(*plan, count_of(mesh.i1, mesh.i2)) : 0;
}

glev_result glevEvaluateMesh(const glev_plan* plan, const glev_mesh* given) {
  glev_mesh mesh;
  if (!read_mesh(plan, given, &mesh)) return GLEV_ERROR_INVALID_ARGUMENT;
  const bool has_rows = plan->dimension() == 2;
  const std::size_t columns = count_of(mesh.i1, mesh.i2), rows = count_of(mesh.j1, mesh.j2);
  if (mesh.scratch == nullptr && mesh.scratch_size != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  Outputs outputs;
  const glev_result result =
      read_outputs(*plan, mesh.outputs, mesh.output_count, columns, rows, has_rows, &outputs);
  if (result != GLEV_SUCCESS || columns == 0 || rows == 0) return result;

  if (mesh.scratch_size < scratch_of(*plan, columns)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  auto* const scratch = static_cast<std::byte*>(mesh.scratch);
  Stream claimed = {scratch, 1, 1, 1, 0, mesh.scratch_size};
  if (!claimed.fits_into(SIZE_MAX)) claimed.element = UINTPTR_MAX - claimed.first_byte();
  const std::array<Stream, 1> others = {claimed};
  const glev_result memory = check_memory(outputs, others);
  if (memory != GLEV_SUCCESS) return memory;

  const std::size_t unaligned = reinterpret_cast<std::uintptr_t>(scratch) % kCacheLine;
  std::byte* const aligned = scratch + (unaligned == 0 ? 0 : kCacheLine - unaligned);
  const glev::MeshRange range = {plan->grid(0), plan->grid(1), mesh.i1, mesh.j1, columns, rows};
  const auto normals = plan->kernels().normals;
  Output &vertex = outputs[static_cast<int>(Attribute::kVertex)],
         &normal = outputs[static_cast<int>(Attribute::kNormal)];
  if (plan->automatic_normals() && are_records(*plan, vertex, normal)) {
    const glev::DefaultEnvironment environment;
    normals(*plan, range, {normal.data, normal.stream.stride, normal.stream.row_stride, 3}, true, aligned);
    vertex.is_wanted = normal.is_wanted = false;
  }
  evaluate_all(
      *plan, outputs,
      [&](std::size_t i) {
        return GridArgument{range.u, range.i1 + static_cast<std::int64_t>(i)};
      },
      [&](std::size_t, std::size_t j) {
        return GridArgument{range.v, range.j1 + static_cast<std::int64_t>(j)};
      },
      [&](const glev::PreparedMap& map, const glev::Destination& to) {
        plan->kernels().mesh(map, range, mesh.precision == GLEV_FAST, to, aligned);
      },
      [&](const glev::Destination& to) {
        normals(*plan, range, to, false, aligned);
        return true;
      },
      [&](const glev::PreparedMap& map, const glev::Destination& to) {
        return plan->kernels().double_mesh(map, range, to, aligned);
      });
  return GLEV_SUCCESS;
}
