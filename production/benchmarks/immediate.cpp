// Registers the benchmarks of single calls, and checks their results.
#include "immediate.h"

#include <cstring>
#include <utility>

#include "float_horner.h"
#include "side.h"

namespace evalcts::bench {
namespace {

std::size_t stored = 0;  // number of vertices

void store(void*, const glev_vertex* vertex) {
  const std::size_t place = stored++ % called_curve().u.size();
  std::memcpy(results() + 3 * place, vertex->position, 3 * sizeof(float));
}

void add_calls(const std::string& name, std::function<Calls()> prepare, const std::vector<float>& points,
               std::function<void(float* expected)> horner) {
  add(name, [&points, prepare = std::move(prepare), horner = std::move(horner)]() -> Measured {
    const Calls calls = prepare();
    stored = 0;
    calls();
    std::vector<float> expected(3 * called_curve().u.size());
    horner(expected.data());
    check_agreement({results(), expected.size()}, expected, tolerance_for(4, points));
    return {calls, static_cast<std::int64_t>(called_curve().u.size())};
  });
}

Immediate float_horner(const std::vector<float>& points) {
  Immediate context{points.data(), 4, 3, 0, 0, 1, 1, storing_sink(), {}};
  context.vertex.size = sizeof context.vertex;
  return context;
}

[[maybe_unused]] const bool kRegistered = [] {
  add_curve_calls("float_Horner", [] {
    return [context = float_horner(called_curve().points)]() mutable {
      call_curve([&context](float u) { horner_eval_coord1(context, u); });
    };
  });
  add_surface_calls("float_Horner", [] {
    return [context = float_horner(called_surface().points)]() mutable {
      call_surface([&context](float u, float v) { horner_eval_coord2(context, u, v); });
    };
  });
  return true;
}();

}  // namespace

const Curve& called_curve() { return curves()[0]; }
const Mesh& called_surface() { return meshes()[0]; }

glev_sink storing_sink() { return {sizeof(glev_sink), nullptr, nullptr, store, nullptr}; }

void add_curve_calls(const std::string& side, std::function<Calls()> prepare) {
  add_calls("Call/curve/order:4/dim:3/" + side, std::move(prepare), called_curve().points,
            [](float* expected) { horner_points(called_curve(), expected); });
}

void add_surface_calls(const std::string& side, std::function<Calls()> prepare) {
  add_calls("Call/surface/order:4/dim:3/" + side, std::move(prepare), called_surface().points,
            [](float* expected) {
              call_surface([&expected](float u, float v) {
                horner_surface(called_surface().points.data(), 4, 4, 3, u, v, expected);
                expected += 3;
              });
            });
}

}  // namespace evalcts::bench
