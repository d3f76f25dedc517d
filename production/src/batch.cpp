// Batches and meshes: evaluate a plan at arrays of arguments, or at points of its grid, and write to memory
// of the caller.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "batch.h"
#include "derivatives.h"
#include "environment.h"
#include "kernels.h"
#include "normal.h"
#include "plan.h"
#include "resolve.h"

namespace {

using glev::Attribute, glev::GridArgument, glev::kAttributes, glev::kCacheLine, glev::kFirstDerivative,
    glev::Output, glev::Outputs, glev::Stream;

// ---- Evaluation without kernels

void put(const Output& output, std::byte* to, const std::array<double, 4>& values) {
  std::array<float, 4> floats;
  if (output.is_double) {
    std::memcpy(to, values.data(), output.stream.element);
    return;
  }
  for (std::size_t k = 0; k < 4; ++k) floats[k] = static_cast<float>(values[k]);
  std::memcpy(to, floats.data(), output.stream.element);
}

// Writes function(u(i), v(i, j)) to each element (i, j) of the output.
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

// Evaluates a derivative without kernels.
template <class Real, class U, class V>
void evaluate_derivative(const glev_plan& plan, const glev::Derivative& derivative, const Output& output,
                         const U& u, const V& v) {
  for_each(output, u, v, [](const GridArgument&, const GridArgument&) { return std::array<double, 4>{}; });
  const glev::Surface& surface = plan.surface(Attribute::kVertex);
  if (glev::is_zero(surface, derivative)) return;
  glev::DerivativeNet net(plan, derivative);
  for (int first = 0, count = 0; first < surface.components; first += count) {
    count = net.load(first);
    for (std::size_t j = 0; j < output.stream.rows; ++j) {
      for (std::size_t i = 0; i < output.stream.columns; ++i) {
        std::array<Real, 4> values;
        net.move_to(v(i, j));
        net.evaluate_at(u(i), values.data());
        std::memcpy(output.address_of(i, j) + static_cast<std::size_t>(first) * sizeof(Real), values.data(),
                    static_cast<std::size_t>(count) * sizeof(Real));
      }
    }
  }
}

// Replaces the component that maps do not have, which is 1 in other attributes, by that of derivatives.
void clear_last_component(const Output& output) {
  const std::size_t size = output.stream.element / 4;
  for (std::size_t j = 0; j < output.stream.rows; ++j) {
    for (std::size_t i = 0; i < output.stream.columns; ++i)
      std::memset(output.address_of(i, j) + 3 * size, 0, size);
  }
}

// Evaluates point by point. `v` is null for curves.
void evaluate_points(const glev_plan& plan, const glev::PreparedMap& map, const glev::Input& u,
                     const glev::Input* v, std::size_t count, const glev::Destination& to) {
  const bool is_vertex = &map == &plan.map(Attribute::kVertex);
  const glev::EvaluatesDirectly direct = is_vertex ? plan.direct() : nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 4> values;
    const double at_u = u[i], at_v = v == nullptr ? 0 : (*v)[i];
    if (direct == nullptr || !direct(plan, at_u, at_v, values.data()))
      plan.kernels().point(map, glev::argument_at(at_u), glev::argument_at(at_v), values.data());
    for (std::size_t k = static_cast<std::size_t>(map.surface.components); k < 4; ++k)
      values[k] = k == 3 ? 1 : 0;
    // One at a time, as they were written: to load several at once would have to wait for the stores.
    for (std::size_t k = 0; k < static_cast<std::size_t>(to.components); ++k)
      std::memcpy(to.data + i * to.stride + k * sizeof(float), &values[k], sizeof(float));
  }
}

// Computes all outputs that are left. `evaluate` computes float results of maps; `normals` and `doubles`
// compute automatic normals as floats and double results of maps if they support these, and otherwise return
// false.
template <class IsLeft, class U, class V, class Evaluate, class Normals, class Doubles>
void evaluate_all(const glev_plan& plan, const Outputs& outputs, const IsLeft& is_left, const U& u,
                  const V& v, const Evaluate& evaluate, const Normals& normals, const Doubles& doubles) {
  const glev::DefaultEnvironment environment;
  for (const unsigned o : outputs.wanted) {
    const Output& output = outputs[o];
    if (!is_left(output)) continue;
    const glev::Destination to = {output.data, output.stream.stride, output.stream.row_stride,
                                  output.components};
    const auto evaluate_map = [&](const glev::PreparedMap& map) {
      if (!output.is_double) {
        evaluate(map, to);
      } else if (!doubles(map, to)) {
        evaluate_in_double(map, output, u, v);
      }
    };
    if (o >= kFirstDerivative) {
      const glev::Derivative& derivative = glev::kDerivatives[o - kFirstDerivative];
      if (const glev::DerivativeMap own(plan, derivative); own.map() != nullptr) {
        evaluate_map(*own.map());
        if (output.components == 4 && own.map()->surface.components < 4) clear_last_component(output);
      } else if (output.is_double) {
        evaluate_derivative<double>(plan, derivative, output, u, v);
      } else {
        evaluate_derivative<float>(plan, derivative, output, u, v);
      }
    } else if (o == static_cast<unsigned>(Attribute::kNormal) && plan.automatic_normals()) {
      if (output.is_double || !normals(to)) evaluate_normals(plan, output, u, v);
    } else {
      evaluate_map(plan.map(static_cast<Attribute>(o)));
    }
  }
}

// Returns a function that returns the number of components of an attribute of the plan.
auto components_of(const glev_plan& plan) {
  return [&plan](unsigned o) { return glevGetPlanComponents(&plan, static_cast<glev_attribute>(o)); };
}

// ---- Meshes

// Returns the number of indices i1..i2, which fits for all ints.
std::size_t count_of(glev_int i1, glev_int i2) {
  return i1 > i2 ? 0 : static_cast<std::size_t>(static_cast<std::int64_t>(i2) - i1 + 1);
}

// Views the mesh, in `room` if it has another size. Returns an error if it is invalid, apart from its outputs
// and scratch memory.
glev_result view_mesh(const glev_plan* plan, const glev_mesh* given, glev_mesh* room,
                      const glev_mesh** mesh) {
  if (plan == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  const glev_result result = glev::view_struct(given, room, mesh);
  if (result != GLEV_SUCCESS) return result;
  // The members are not compared with 0 at once: one load of both would wait for the two stores of the
  // caller.
  const bool is_row_0 = (*mesh)->j1 == 0 && count_of((*mesh)->j1, (*mesh)->j2) == 1;
  const bool is_valid = glev::is_precision((*mesh)->precision) && (plan->dimension() == 2 || is_row_0);
  return is_valid ? GLEV_SUCCESS : GLEV_ERROR_INVALID_ARGUMENT;
}

// Returns true if both are wanted, and each normal directly follows its vertex, both as three floats.
bool are_records(const glev_plan& plan, const Outputs& outputs) {
  constexpr auto kVertex = static_cast<unsigned>(Attribute::kVertex),
                 kNormal = static_cast<unsigned>(Attribute::kNormal);
  if (!outputs.wanted.contains(kVertex) || !outputs.wanted.contains(kNormal)) return false;
  const Output &vertex = outputs[kVertex], &normal = outputs[kNormal];
  const auto are_triples = [](const Output& output) { return !output.is_double && output.components == 3; };
  return are_triples(vertex) && are_triples(normal) && plan.components(Attribute::kVertex) == 3 &&
         normal.data == vertex.data + 3 * sizeof(float) && normal.stream.stride == vertex.stream.stride &&
         normal.stream.row_stride == vertex.stream.row_stride;
}

}  // namespace

namespace glev {

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

void evaluate_arguments(const glev_plan& plan, const Input& u, const Input* v, std::size_t count, bool fast,
                        const Outputs& outputs) {
  evaluate_all(
      plan, outputs, [](const Output&) { return true; }, [&](std::size_t i) { return argument_at(u[i]); },
      [&](std::size_t i, std::size_t) { return v != nullptr ? argument_at((*v)[i]) : GridArgument{}; },
      [&](const PreparedMap& map, const Destination& to) {
        constexpr std::size_t kFew = 2;  // too few points for the set-up of vectors
        if (count <= kFew) {
          evaluate_points(plan, map, u, v, count, to);
        } else if (v != nullptr) {
          plan.kernels().surface(map, u, *v, count, fast, to);
        } else {
          plan.kernels().curve(map, u, count, to);
        }
      },
      [](const Destination&) { return false; },
      [&](const PreparedMap& map, const Destination& to) {
        return v == nullptr && plan.kernels().double_curve(map, u, count, to);
      });
}

void evaluate_range(const glev_plan& plan, const MeshRange& range, bool fast, const Outputs& outputs,
                    std::byte* scratch) {
  std::byte* const aligned = align(scratch);
  const auto normals = plan.kernels().normals;
  const Output &vertex = outputs[static_cast<unsigned>(Attribute::kVertex)],
               &normal = outputs[static_cast<unsigned>(Attribute::kNormal)];
  const bool has_records = plan.automatic_normals() && are_records(plan, outputs);
  if (has_records) {
    const DefaultEnvironment environment;
    normals(plan, range, {normal.data, normal.stream.stride, normal.stream.row_stride, 3}, true, aligned);
  }
  const auto is_left = [&](const Output& output) {
    return !has_records || (&output != &vertex && &output != &normal);
  };
  evaluate_all(
      plan, outputs, is_left, [&](std::size_t i) { return range.u_of(i); },
      [&](std::size_t, std::size_t j) { return range.v_of(j); },
      [&](const PreparedMap& map, const Destination& to) {
        plan.kernels().mesh(map, range, fast, to, aligned);
      },
      [&](const Destination& to) {
        normals(plan, range, to, false, aligned);
        return true;
      },
      [&](const PreparedMap& map, const Destination& to) {
        return plan.kernels().double_mesh(map, range, to, aligned);
      });
}

}  // namespace glev

glev_result glevEvaluate(const glev_plan* plan, const glev_batch* given) {
  glev_batch room;
  const glev_batch* view;
  if (plan == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  glev_result result = glev::view_struct(given, &room, &view);
  if (result != GLEV_SUCCESS) return result;
  const glev_batch& batch = *view;
  if (batch.type != GLEV_FLOAT && batch.type != GLEV_DOUBLE) return GLEV_ERROR_INVALID_ARGUMENT;
  if (!glev::is_precision(batch.precision)) return GLEV_ERROR_INVALID_ARGUMENT;
  const bool has_v = plan->dimension() == 2, is_double = batch.type == GLEV_DOUBLE;
  if (batch.count != 0 && (batch.u.data == nullptr || (has_v && batch.v.data == nullptr)))
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (!has_v && (batch.v.data != nullptr || batch.v.data_size != 0 || batch.v.stride != 0))
    return GLEV_ERROR_INVALID_ARGUMENT;
  Outputs outputs;
  result =
      glev::read_outputs(components_of(*plan), batch.outputs, batch.output_count, {batch.count}, &outputs);
  if (result != GLEV_SUCCESS || batch.count == 0) return result;

  const auto stream_of = [&](const glev_input& input) {
    const std::size_t element = is_double ? sizeof(double) : sizeof(float);
    return Stream{static_cast<const std::byte*>(input.data), batch.count, 1, input.stride, 0, element, 1, 0};
  };
  std::array<Stream, 2> inputs;
  inputs[0] = stream_of(batch.u);
  inputs[1].columns = 0;
  if (!inputs[0].fits_into(batch.u.data_size)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  if (has_v) {
    inputs[1] = stream_of(batch.v);
    if (!inputs[1].fits_into(batch.v.data_size)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  result = glev::check_memory(outputs, inputs);
  if (result != GLEV_SUCCESS) return result;

  const auto input_of = [&](const Stream& stream) {
    return glev::Input{stream.begin, stream.stride, is_double};
  };
  const glev::Input u = input_of(inputs[0]), v = has_v ? input_of(inputs[1]) : glev::Input{};
  glev::evaluate_arguments(*plan, u, has_v ? &v : nullptr, batch.count, batch.precision == GLEV_FAST,
                           outputs);
  return GLEV_SUCCESS;
}

size_t glevGetMeshScratchSize(const glev_plan* plan, const glev_mesh* given) {
  glev_mesh room;
  const glev_mesh* mesh;
  if (view_mesh(plan, given, &room, &mesh) != GLEV_SUCCESS) return 0;
  return glev::scratch_of(*plan, count_of(mesh->i1, mesh->i2));
}

glev_result glevEvaluateMesh(const glev_plan* plan, const glev_mesh* given) {
  glev_mesh room;
  const glev_mesh* view;
  glev_result result = view_mesh(plan, given, &room, &view);
  if (result != GLEV_SUCCESS) return result;
  const glev_mesh& mesh = *view;
  const bool has_rows = plan->dimension() == 2;
  const std::size_t columns = count_of(mesh.i1, mesh.i2), rows = count_of(mesh.j1, mesh.j2);
  if (mesh.scratch == nullptr && mesh.scratch_size != 0) return GLEV_ERROR_INVALID_ARGUMENT;
  Outputs outputs;
  result = glev::read_outputs(components_of(*plan), mesh.outputs, mesh.output_count,
                              {columns, rows, 1, has_rows}, &outputs);
  if (result != GLEV_SUCCESS || columns == 0 || rows == 0) return result;

  if (mesh.scratch_size < glev::scratch_of(*plan, columns)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  auto* const scratch = static_cast<std::byte*>(mesh.scratch);
  const std::array<Stream, 1> others = {glev::claim(mesh.scratch, mesh.scratch_size)};
  result = glev::check_memory(outputs, others);
  if (result != GLEV_SUCCESS) return result;

  const glev::MeshRange range = {plan->grid(0), plan->grid(1), mesh.i1, mesh.j1, columns, rows};
  glev::evaluate_range(*plan, range, mesh.precision == GLEV_FAST, outputs, scratch);
  return GLEV_SUCCESS;
}
