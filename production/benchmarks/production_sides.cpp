// Benchmarks libglevaluator, on each instruction set that the machine supports.
#include <glevaluator.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>

#include "immediate.h"
#include "models.h"
#include "side.h"

namespace evalcts::bench {
namespace {

using Context = std::shared_ptr<glev_context>;
using Plan = std::shared_ptr<glev_plan>;

void require(bool good, const char* words) {
  if (!good) throw std::runtime_error(words);
}

void require(glev_result result, const char* words) { require(result == GLEV_SUCCESS, words); }

Context make_context(const char* target) {
  const glev_context_info info = {sizeof info, nullptr, target};
  glev_context* context = nullptr;
  require(glevCreateContext(&info, &context), "no context");
  return {context, glevDestroyContext};
}

Context make_context(const char* target, const Curve& curve) {
  Context context = make_context(target);
  const glev_enum map = curve.components == 3 ? GLEV_MAP1_VERTEX_3 : GLEV_MAP1_VERTEX_4;
  glevMap1f(context.get(), map, 0, 1, curve.components, curve.order, curve.points.data());
  glevEnable(context.get(), map);
  require(glevGetError(context.get()) == GLEV_NO_ERROR, "the map is rejected");
  return context;
}

Context make_context(const char* target, const Mesh& mesh) {
  Context context = make_context(target);
  const glev_enum map = mesh.components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
  glevMap2f(context.get(), map, 0, 1, mesh.components, mesh.order, 0, 1, mesh.order * mesh.components,
            mesh.order, mesh.points.data());
  glevMapGrid2f(context.get(), mesh.columns - 1, 0, 1, mesh.rows - 1, 0, 1);
  glevEnable(context.get(), map);
  if (mesh.normals) glevEnable(context.get(), GLEV_AUTO_NORMAL);
  require(glevGetError(context.get()) == GLEV_NO_ERROR, "the map is rejected");
  return context;
}

Plan make_plan(const Context& context, std::size_t dimension) {
  const glev_plan_info info = {sizeof info, dimension};
  glev_plan* plan = nullptr;
  require(glevCreatePlan(context.get(), &info, &plan), "no plan");
  return {plan, glevReleasePlan};
}

// Returns an output of `points` points, `values` values apart, for their values from `offset` on.
template <class Real>
glev_output output(Real* data, std::size_t points, std::size_t values, std::size_t offset,
                   std::size_t components) {
  return {.size = sizeof(glev_output),
          .data = data + offset,
          .data_size = (points * values - offset) * sizeof(Real),
          .stride = values * sizeof(Real),
          .components = components,
          .type = sizeof(Real) == sizeof(float) ? GLEV_FLOAT : GLEV_DOUBLE,
          .row_stride = 0,
          .patch_stride = 0};
}

// Evaluates vertices at `count` arguments. `v` is null for curves.
void evaluate_at(const Plan& plan, const float* u, const float* v, std::size_t count,
                 glev_precision precision, const glev_output& vertex) {
  const auto input = [count](const float* data) {
    return data == nullptr ? glev_input{} : glev_input{data, count * sizeof(float), sizeof(float)};
  };
  const glev_attribute_output outputs = {GLEV_ATTRIBUTE_VERTEX, &vertex};
  const glev_batch batch = {.size = sizeof batch,
                            .count = count,
                            .type = GLEV_FLOAT,
                            .precision = precision,
                            .u = input(u),
                            .v = input(v),
                            .outputs = &outputs,
                            .output_count = 1};
  require(glevEvaluate(plan.get(), &batch), "glevEvaluate fails");
}

using Scratch = std::vector<unsigned char>;

// Evaluates rows of a mesh from `row` on.
void evaluate_rows(const Plan& plan, int columns, int row, int rows, glev_precision precision,
                   std::initializer_list<glev_attribute_output> outputs, Scratch& scratch) {
  glev_mesh mesh = {};
  mesh.size = sizeof mesh;
  mesh.i2 = columns - 1;
  mesh.j1 = row;
  mesh.j2 = row + rows - 1;
  mesh.precision = precision;
  mesh.outputs = outputs.begin();
  mesh.output_count = outputs.size();
  if (scratch.empty()) scratch.resize(glevGetMeshScratchSize(plan.get(), &mesh));
  mesh.scratch = scratch.data();
  mesh.scratch_size = scratch.size();
  require(glevEvaluateMesh(plan.get(), &mesh), "glevEvaluateMesh fails");
}

CurveSide side(const Curve& curve, const char* target, glev_precision precision) {
  const Plan plan = make_plan(make_context(target, curve), 1);
  return [&curve, plan, precision](float* results) {
    evaluate_at(plan, curve.u.data(), nullptr, curve.u.size(), precision,
                output(results, curve.u.size(), curve.components, 0, curve.components));
  };
}

MeshSide side(const Mesh& mesh, const char* target, glev_precision precision) {
  const Plan plan = make_plan(make_context(target, mesh), 2);
  return [&mesh, plan, precision, scratch = Scratch()](int row, int rows, float* results) mutable {
    const std::size_t points = static_cast<std::size_t>(mesh.columns) * rows, values = mesh.values();
    const glev_output vertex = output(results, points, values, 0, mesh.components);
    if (!mesh.normals)
      return evaluate_rows(plan, mesh.columns, row, rows, precision, {{GLEV_ATTRIBUTE_VERTEX, &vertex}},
                           scratch);
    const glev_output normal = output(results, points, values, mesh.components, 3);
    evaluate_rows(plan, mesh.columns, row, rows, precision,
                  {{GLEV_ATTRIBUTE_VERTEX, &vertex}, {GLEV_ATTRIBUTE_NORMAL, &normal}}, scratch);
  };
}

// ---- Models

void define(const Context& context, const Model& model, std::size_t patch) {
  const glev_int order = model.order;
  glevMap2f(context.get(), GLEV_MAP2_VERTEX_3, 0, 1, 3, order, 0, 1, 3 * order, order,
            model.patches[patch].data());
}

Context make_context(const char* target, const Model& model) {
  Context context = make_context(target);
  glevMapGrid2f(context.get(), model.segments, 0, 1, model.segments, 0, 1);
  glevEnable(context.get(), GLEV_MAP2_VERTEX_3);
  require(glevGetError(context.get()) == GLEV_NO_ERROR, "the grid is rejected");
  return context;
}

void evaluate(const Plan& plan, const Model& model, glev_precision precision, Scratch& scratch,
              float* results) {
  const glev_output vertex = output(results, model.points_of_patch(), 3, 0, 3);
  evaluate_rows(plan, model.segments + 1, 0, model.segments + 1, precision,
                {{GLEV_ATTRIBUTE_VERTEX, &vertex}}, scratch);
}

PatchSide side(const Model& model, const char* target, glev_precision precision) {
  std::vector<Plan> plans;
  const Context context = make_context(target, model);
  for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
    define(context, model, patch);
    plans.push_back(make_plan(context, 2));
  }
  return [&model, precision, plans, scratch = Scratch()](std::size_t patch, float* results) mutable {
    evaluate(plans[patch], model, precision, scratch, results);
  };
}

PatchSide side_with_map(const Model& model, const char* target) {
  return [&model, context = make_context(target, model), scratch = Scratch()](std::size_t patch,
                                                                              float* results) mutable {
    define(context, model, patch);
    evaluate(make_plan(context, 2), model, GLEV_CORRECTLY_ROUNDED, scratch, results);
  };
}

// ---- Arrays of patches, without contexts

glev_patch_grid uniform_grid(const char* target, int segments) {
  glev_patch_grid grid = {};
  grid.size = sizeof grid;
  grid.u_segments = grid.v_segments = segments;
  grid.target = target;
  return grid;
}

glev_patches bicubic(const float* points, std::size_t count) {
  glev_patches patches = {};
  patches.size = sizeof patches;
  patches.count = count;
  patches.components = 3;
  patches.uorder = patches.vorder = 4;
  patches.type = GLEV_FLOAT;
  patches.points = points;
  patches.points_size = count * 48 * sizeof(float);
  return patches;
}

void evaluate(const glev_patches& patches, const glev_patch_grid& grid, Scratch& scratch, float* to) {
  const auto side = static_cast<std::size_t>(grid.u_segments) + 1;
  const glev_output vertex = output(to, patches.count * side * side, 3, 0, 3);
  const glev_attribute_output outputs = {GLEV_ATTRIBUTE_VERTEX, &vertex};
  if (scratch.empty()) scratch.resize(glevGetPatchScratchSize(&patches, &grid));
  require(glevEvaluatePatches(&patches, &grid, &outputs, 1, scratch.data(), scratch.size()),
          "glevEvaluatePatches fails");
}

std::function<void(const float*, float*)> many_patches_side(const char* target) {
  return [target, scratch = Scratch()](const float* points, float* to) mutable {
    evaluate(bicubic(points, ManyPatches::kBlock), uniform_grid(target, ManyPatches::kSegments), scratch, to);
  };
}

// Evaluates all patches of a bicubic model in one call, after a check that results have the bits of plans.
Measured model_by_patches(const Model& model, const char* target) {
  require(model.order == 4, "not bicubic");
  // The number of patches is limited, so that their points fit into the memory for results.
  const std::size_t count = std::min(model.patches.size(), std::size_t{32}),
                    own = 3 * model.points_of_patch();
  std::vector<float> points, expected(count * own);
  const PatchSide plans = side(model, target, GLEV_CORRECTLY_ROUNDED);
  for (std::size_t p = 0; p < count; ++p) {
    // In models, u is fastest.
    points.insert(points.end(), model.patches[p].begin(), model.patches[p].end());
    plans(p, expected.data() + p * own);
  }
  glev_patches patches = bicubic(nullptr, count);
  patches.u_stride = 3 * sizeof(float);
  patches.v_stride = 12 * sizeof(float);
  patches.patch_stride = 48 * sizeof(float);
  const auto run = [patches, points, grid = uniform_grid(target, model.segments),
                    scratch = Scratch()]() mutable {
    patches.points = points.data();
    evaluate(patches, grid, scratch, results());
  };
  std::function<void()> made = run;
  made();
  require(std::equal(expected.begin(), expected.end(), results()), "other bits than those of plans");
  return {made, static_cast<std::int64_t>(count * model.points_of_patch())};
}

// ---- Maps and plans, without evaluation. Items are plans.

Measured plans(const char* target, int order, bool grid_alone) {
  std::vector<float> points;
  for (int i = 0; i < order * order * 3; ++i)
    points.push_back(static_cast<float>((i * 7919) % 1000003) / 1000003.0F - 0.5F);
  const Context context = make_context(target);
  glevEnable(context.get(), GLEV_MAP2_VERTEX_3);
  const auto define_map = [context, order, points] {
    glevMap2f(context.get(), GLEV_MAP2_VERTEX_3, 0, 1, 3, order, 0, 1, 3 * order, order, points.data());
  };
  define_map();
  return {[context, define_map, grid_alone, segments = 0]() mutable {
            segments = segments % 64 + 1;
            if (!grid_alone) define_map();
            if (grid_alone) glevMapGrid2f(context.get(), segments, 0, 1, segments, 0, 1);
            const glev_plan_info info = {sizeof info, 2};
            glev_plan* plan = nullptr;
            require(glevCreatePlan(context.get(), &info, &plan), "no plan");
            glevReleasePlan(plan);
          },
          1};
}

// ---- Doubles and tangents

// Evaluates vertices, or both tangents, of rows of a bicubic mesh. Real is the type of the results.
template <class Real>
Measured mesh_of(const char* target, bool has_tangents, glev_precision precision) {
  const Mesh& mesh = *std::ranges::find_if(
      meshes(), [](const Mesh& m) { return m.order == 4 && m.ring != m.rows && !m.normals; });
  constexpr int kFirstRow = 100, kRows = 4;
  const Plan plan = make_plan(make_context(target, mesh), 2);
  const std::size_t points = static_cast<std::size_t>(mesh.columns) * kRows;
  const auto memory = std::make_shared<std::vector<Real>>(6 * points);
  return {[&mesh, plan, has_tangents, precision, memory, points, scratch = Scratch()]() mutable {
            const glev_output first = output(memory->data(), points, 3, 0, 3),
                              second = output(memory->data() + 3 * points, points, 3, 0, 3);
            if (has_tangents) {
              evaluate_rows(plan, mesh.columns, kFirstRow, kRows, precision,
                            {{GLEV_ATTRIBUTE_TANGENT_U, &first}, {GLEV_ATTRIBUTE_TANGENT_V, &second}},
                            scratch);
            } else {
              evaluate_rows(plan, mesh.columns, kFirstRow, kRows, precision,
                            {{GLEV_ATTRIBUTE_VERTEX, &first}}, scratch);
            }
          },
          static_cast<std::int64_t>(points)};
}

// Evaluates batches of `count` arguments of a curve of order 4. Real is the type of the results.
template <class Real>
Measured batches_of(const char* target, std::size_t count) {
  const Curve& curve = curves().front();
  const Plan plan = make_plan(make_context(target, curve), 1);
  const auto memory = std::make_shared<std::vector<Real>>(3 * count);
  return {[&curve, plan, count, memory, first = std::size_t{0}]() mutable {
            evaluate_at(plan, curve.u.data() + first, nullptr, count, GLEV_CORRECTLY_ROUNDED,
                        output(memory->data(), count, 3, 0, 3));
            first = (first + count) % (curve.u.size() - count + 1);
          },
          static_cast<std::int64_t>(count)};
}

// Evaluates scattered points of a bicubic surface.
Measured scattered(const char* target, glev_precision precision) {
  const std::vector<float>& u = called_curve().u;
  const Plan plan = make_plan(make_context(target, called_surface()), 2);
  const std::size_t count = u.size() / 2;
  return {[&u, plan, precision, count] {
            evaluate_at(plan, u.data(), u.data() + count, count, precision,
                        output(results(), count, 3, 0, 3));
          },
          static_cast<std::int64_t>(count)};
}

// Calls EvalMesh2 of a bicubic patch with 64 segments, with a sink.
Measured mesh_to_sink(const char* target) {
  const Context context = make_context(target, called_surface());
  const glev_sink sink = storing_sink();
  require(glevSetSink(context.get(), &sink), "the sink is rejected");
  glevMapGrid2f(context.get(), 63, 0, 1, 63, 0, 1);
  return {[context] { glevEvalMesh2(context.get(), GLEV_POINT, 0, 63, 0, 63); }, 64 * 64};
}

Context between_begin_and_end(const Context& context) {
  const glev_sink sink = storing_sink();
  require(glevSetSink(context.get(), &sink), "the sink is rejected");
  glevBegin(context.get(), GLEV_POINTS);
  return context;
}

void add_target(const char* target) {
  const std::string name = std::string("production/") + target;
  const auto add_curve = [&](const Curve& curve, const std::string& as, glev_precision precision) {
    add(curve, as, [&curve, target, precision] { return side(curve, target, precision); });
  };
  const auto add_mesh = [&](const Mesh& mesh, const std::string& as, glev_precision precision) {
    add(mesh, as, Unit::kMesh, [&mesh, target, precision] { return side(mesh, target, precision); });
  };
  for (const Curve& curve : curves()) add_curve(curve, name, GLEV_CORRECTLY_ROUNDED);
  for (const Curve& curve : hard_curves()) add_curve(curve, name, GLEV_CORRECTLY_ROUNDED);
  for (const Mesh& mesh : meshes()) {
    add_mesh(mesh, name, GLEV_CORRECTLY_ROUNDED);
    if (mesh.ring != mesh.rows && !mesh.normals)
      add_mesh(mesh, std::string("production_fast/") + target, GLEV_FAST);
  }
  for (const Model& model : models()) {
    add(model, name, [&model, target] { return side(model, target, GLEV_CORRECTLY_ROUNDED); });
    add(model, std::string("production_fast/") + target,
        [&model, target] { return side(model, target, GLEV_FAST); });
    add(model, std::string("production_with_map/") + target,
        [&model, target] { return side_with_map(model, target); });
    if (model.order == 4)
      add(model.name + "/production_patches/" + target,
          [&model, target] { return model_by_patches(model, target); });
  }
  add_many_patches(name, [target] { return many_patches_side(target); });
  const auto add_work = [&](const std::string& work, const auto& prepare) {
    add(work + "/" + name, prepare);
  };
  add_work("Plan/bicubic", [target] { return plans(target, 4, false); });
  add_work("Plan/order:64", [target] { return plans(target, 64, false); });
  add_work("Plan/grid_alone", [target] { return plans(target, 4, true); });
  add_work("Double/mesh", [target] { return mesh_of<double>(target, false, GLEV_CORRECTLY_ROUNDED); });
  add_work("Double/curve", [target] { return batches_of<double>(target, 1024); });
  add_work("Tangents/float", [target] { return mesh_of<float>(target, true, GLEV_CORRECTLY_ROUNDED); });
  add_work("Tangents/fast", [target] { return mesh_of<float>(target, true, GLEV_FAST); });
  add_work("Tangents/double", [target] { return mesh_of<double>(target, true, GLEV_CORRECTLY_ROUNDED); });
  add_work("Batch/count:1", [target] { return batches_of<float>(target, 1); });
  add_work("Batch/count:8", [target] { return batches_of<float>(target, 8); });
  add_work("Scattered/bicubic", [target] { return scattered(target, GLEV_CORRECTLY_ROUNDED); });
  add_work("Scattered/fast", [target] { return scattered(target, GLEV_FAST); });
  add_work("Sink/mesh", [target] { return mesh_to_sink(target); });
  add_curve_calls(name, [target] {
    const Context context = between_begin_and_end(make_context(target, called_curve()));
    return [context] { call_curve([&context](float u) { glevEvalCoord1f(context.get(), u); }); };
  });
  add_surface_calls(name, [target] {
    const Context context = between_begin_and_end(make_context(target, called_surface()));
    return
        [context] { call_surface([&context](float u, float v) { glevEvalCoord2f(context.get(), u, v); }); };
  });
}

[[maybe_unused]] const bool kRegistered = [] {
  for (std::size_t i = 0; const char* const target = glevGetTargetName(i); ++i) add_target(target);
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
