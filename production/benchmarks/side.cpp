// Checks the results of sides against float Horner, and registers benchmarks.
#include "side.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>

#include "float_horner.h"

namespace evalcts::bench {
namespace {

constexpr int kStrip = 16;  // number of rows

// The tolerance of unit normals, which have large errors in float if the tangents are nearly parallel.
constexpr double kNormalTolerance = 1e-2;

void check(const Mesh& mesh, const MeshSide& side, Unit unit) {
  const int values = mesh.values();
  const bool at_once = unit == Unit::kMesh && mesh.ring == mesh.rows;
  if (at_once) side(0, mesh.rows, results());
  std::vector<float> expected(static_cast<std::size_t>(kStrip) * mesh.columns * values);
  for (const int row : {0, mesh.rows / 2, mesh.rows - kStrip}) {
    const float* got = results();
    if (at_once) {
      got += static_cast<std::size_t>(row) * mesh.columns * values;
    } else {
      side(row, kStrip, results());
    }
    horner_rows(mesh, row, kStrip, expected.data());
    std::vector<float> parts[2][2];  // positions, normals; got, expected
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const bool normal = static_cast<int>(i % values) >= mesh.components;
      parts[normal][0].push_back(got[i]);
      parts[normal][1].push_back(expected[i]);
    }
    check_agreement(parts[0][0], parts[0][1], tolerance_for(mesh.order, mesh.points));
    check_agreement(parts[1][0], parts[1][1], kNormalTolerance);
  }
}

// Returns the memory for results, aligned to pages.
std::span<float> memory() {
  static const std::span<float> kFloats = [] {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes())
      count = std::max(count, static_cast<std::size_t>(mesh.ring) * mesh.columns * mesh.values());
    const std::size_t page = 4096, bytes = (count * sizeof(float) + page - 1) / page * page;
    return std::span(static_cast<float*>(std::aligned_alloc(page, bytes)), count);
  }();
  return kFloats;
}

[[maybe_unused]] const bool kDescribed = [] {
  benchmark::AddCustomContext("compiler", EVALCTS_COMPILER);
  return true;
}();

}  // namespace

float* results() { return memory().data(); }

double tolerance_for(int order, std::span<const float> points) {
  double largest = 0;
  for (const float p : points) largest = std::max(largest, std::abs(static_cast<double>(p)));
  return 2e-5 * order * largest;
}

void check_agreement(std::span<const float> results, std::span<const float> expected, double tolerance) {
  if (results.size() != expected.size()) throw std::runtime_error("another number of results");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double distance = std::abs(static_cast<double>(results[i]) - expected[i]);
    if (!(distance <= tolerance))
      throw std::runtime_error("differs from float Horner by " + std::to_string(distance));
  }
}

void add(const std::string& name, std::function<Measured()> prepare) {
  struct Benchmark {
    std::function<Measured()> prepare;
    Measured measured;
    std::string error;
  };
  const auto shared = std::make_shared<Benchmark>(Benchmark{std::move(prepare), {}, {}});
  benchmark::RegisterBenchmark(name.c_str(), [shared](benchmark::State& state) {
    try {
      if (const auto first = std::exchange(shared->prepare, nullptr)) {
        // Results of the previous side must not pass the check.
        std::ranges::fill(memory(), NAN);
        shared->measured = first();
      }
      if (!shared->error.empty()) throw std::runtime_error(shared->error);
      for (auto _ : state) {
        shared->measured.run();
        benchmark::ClobberMemory();
      }
    } catch (const std::exception& error) {
      shared->error = error.what();
      state.SkipWithError(shared->error.c_str());
    }
    state.SetItemsProcessed(state.iterations() * shared->measured.points);
  });
}

void add(const Curve& curve, const std::string& side, std::function<CurveSide()> prepare) {
  add(curve.name + "/" + side, [&curve, prepare = std::move(prepare)] {
    const CurveSide made = prepare();
    made(results());
    std::vector<float> expected(curve.u.size() * curve.components);
    horner_points(curve, expected.data());
    check_agreement({results(), expected.size()}, expected, tolerance_for(curve.order, curve.points));
    return Measured{[made] { made(results()); }, static_cast<std::int64_t>(curve.u.size())};
  });
}

void add(const Mesh& mesh, const std::string& side, Unit unit, std::function<MeshSide()> prepare) {
  add(mesh.name + "/" + side, [&mesh, unit, prepare = std::move(prepare)]() -> Measured {
    const MeshSide made = prepare();
    check(mesh, made, unit);
    if (unit == Unit::kMesh) {
      const auto all = [&mesh, made] {
        for (int row = 0; row < mesh.rows; row += mesh.ring) made(row, mesh.ring, results());
      };
      return {all, static_cast<std::int64_t>(mesh.columns) * mesh.rows};
    }
    const auto strip = [&mesh, made, row = 0]() mutable {
      const int place = row % mesh.ring;
      made(row, kStrip, results() + static_cast<std::size_t>(place) * mesh.columns * mesh.values());
      row = (row + kStrip) % mesh.rows;
    };
    return {strip, static_cast<std::int64_t>(mesh.columns) * kStrip};
  });
}

}  // namespace evalcts::bench
