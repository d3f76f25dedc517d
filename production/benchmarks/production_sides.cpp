// The evaluator of this project, on each instruction set that it can use here.
#include <glevaluator.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "immediate.h"
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
  require(glevGetError(context.get()) == GLEV_NO_ERROR, "the map is refused");
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
  require(glevGetError(context.get()) == GLEV_NO_ERROR, "the map is refused");
  return context;
}

Plan make_plan(const Context& context, std::size_t dimension) {
  const glev_plan_info info = {sizeof info, dimension};
  glev_plan* plan = nullptr;
  require(glevCreatePlan(context.get(), &info, &plan), "no plan");
  return {plan, glevReleasePlan};
}

glev_output output(float* data, std::size_t points, std::size_t values, std::size_t offset,
                   std::size_t components) {
  return {sizeof(glev_output),
          data + offset,
          (points * values - offset) * sizeof(float),
          values * sizeof(float),
          components,
          GLEV_FLOAT,
          0};
}

CurveSide side(const Curve& curve, const char* target, glev_precision precision) {
  const Plan plan = make_plan(make_context(target, curve), 1);
  return [&curve, plan, precision](float* results) {
    const glev_output vertex = output(results, curve.u.size(), curve.components, 0, curve.components);
    glev_batch batch = {};
    batch.size = sizeof batch;
    batch.count = curve.u.size();
    batch.type = GLEV_FLOAT;
    batch.precision = precision;
    batch.u = {curve.u.data(), curve.u.size() * sizeof(float), sizeof(float)};
    batch.outputs.vertex = &vertex;
    require(glevEvaluate(plan.get(), &batch), "glevEvaluate fails");
  };
}

MeshSide side(const Mesh& mesh, const char* target, glev_precision precision) {
  const Plan plan = make_plan(make_context(target, mesh), 2);
  return [&mesh, plan, precision, scratch = std::vector<unsigned char>()](int row, int rows,
                                                                          float* results) mutable {
    const std::size_t points = static_cast<std::size_t>(mesh.columns) * rows, values = mesh.values();
    const glev_output vertex = output(results, points, values, 0, mesh.components);
    const glev_output normal = output(results, points, values, mesh.components, 3);
    glev_mesh batch = {};
    batch.size = sizeof batch;
    batch.i2 = mesh.columns - 1;
    batch.j1 = row;
    batch.j2 = row + rows - 1;
    batch.precision = precision;
    batch.outputs.vertex = &vertex;
    if (mesh.normals) batch.outputs.normal = &normal;
    if (scratch.empty()) scratch.resize(glevGetMeshScratchSize(plan.get(), &batch) + 1);
    batch.scratch = scratch.data();
    batch.scratch_size = scratch.size();
    require(glevEvaluateMesh(plan.get(), &batch), "glevEvaluateMesh fails");
  };
}

Context between_begin_and_end(const Context& context) {
  const glev_sink sink = storing_sink();
  require(glevSetSink(context.get(), &sink), "the sink is refused");
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
