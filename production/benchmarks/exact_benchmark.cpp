// Benchmarks exact evaluation in integers. Items are components.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "src/exact.h"
#include "src/reduction.h"

namespace {

using glev::Component, glev::Domain, glev::GridArgument;

constexpr int kArguments = 64;  // used round-robin

GridArgument plain(double u) { return {{u, u, 1}, 0}; }

struct Problem {
  std::vector<double> points;
  Component component;
  std::array<std::vector<GridArgument>, 2> at;
};

// Returns a problem with random floats below 1 in magnitude, whose exponents differ by up to `spread`, at
// floats in [0, 1].
Problem random_floats(std::array<int, 2> order, int spread) {
  std::mt19937_64 random(1);
  const auto unit = [&random] { return static_cast<float>(static_cast<double>(random() >> 11) * 0x1p-53); };
  Problem problem;
  for (int i = 0; i < order[0] * order[1]; ++i) {
    const int exponent = spread == 0 ? 0 : -static_cast<int>(random() % static_cast<unsigned>(spread));
    problem.points.push_back(std::ldexp(random() % 2 == 0 ? unit() : -unit(), exponent));
  }
  problem.component = {problem.points.data(), 1, order, {Domain{0, 1}, Domain{0, 1}}};
  for (auto& at : problem.at) {
    for (int i = 0; i < kArguments; ++i) at.push_back(plain(unit()));
  }
  return problem;
}

void run_benchmark(benchmark::State& state, const Problem& problem) {
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(glev::round_exactly(problem.component, problem.at[0][i], problem.at[1][i]));
    i = (i + 1) % problem.at[0].size();
  }
}

void ExactCurve(benchmark::State& state) {
  run_benchmark(state, random_floats({static_cast<int>(state.range(0)), 1}, 36));
}
BENCHMARK(ExactCurve)->Arg(2)->Arg(4)->Arg(10)->Arg(30)->Arg(64);

// Evaluates at u = 2^-32 x, fractions of a float close to zero.
void ExactCurveNextToTheEnd(benchmark::State& state) {
  Problem problem = random_floats({static_cast<int>(state.range(0)), 1}, 36);
  for (GridArgument& at : problem.at[0]) at = plain(at.grid.u1 * 0x1p-31);
  run_benchmark(state, problem);
}
BENCHMARK(ExactCurveNextToTheEnd)->Arg(4)->Arg(10)->Arg(30);

void ExactPatch(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  run_benchmark(state, random_floats({order, order}, 36));
}
BENCHMARK(ExactPatch)->Arg(4)->Arg(8)->Arg(30)->Arg(64);

// Evaluates integers of at most 3 digits at multiples of 1/1024.
void ExactSmallIntegers(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 0);
  for (double& point : problem.points) point = std::round(999 * point);
  for (auto& at : problem.at) {
    for (GridArgument& u : at) u = plain(std::round(u.grid.u1 * 1022 + 1) / 1024);
  }
  run_benchmark(state, problem);
}
BENCHMARK(ExactSmallIntegers)->Args({2, 1})->Args({4, 1})->Args({10, 1})->Args({4, 4});

// Evaluates at thirds of a domain whose width is not a power of two.
void ExactGrid(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 36);
  for (Domain& domain : problem.component.domain) domain = {0.1, 0.7};
  for (auto& at : problem.at) {
    for (std::size_t i = 0; i < at.size(); ++i)
      at[i] = {{0.1, 0.7, 300}, static_cast<std::int64_t>(4 * i + 1)};
  }
  run_benchmark(state, problem);
}
BENCHMARK(ExactGrid)->Args({4, 1})->Args({10, 1})->Args({4, 4});

// Evaluates doubles over a domain whose width is not a power of two, so every argument needs a division.
void ExactDoubles(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 0);
  for (double& point : problem.points) point /= 3;
  for (Domain& domain : problem.component.domain) domain = {0.1, 0.7};
  run_benchmark(state, problem);
}
BENCHMARK(ExactDoubles)->Args({4, 1})->Args({10, 1})->Args({30, 1})->Args({4, 4})->Args({30, 30});

// Evaluates a tie that needs all digits: a constant over a domain whose width is not a power of two.
void ExactTie(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 0);
  for (double& point : problem.points) point = 0x1.000001p0;
  for (Domain& domain : problem.component.domain) domain = {0.1, 0.7};
  run_benchmark(state, problem);
}
BENCHMARK(ExactTie)->Args({4, 1})->Args({10, 1})->Args({30, 1})->Args({4, 4});

// Evaluates the worst case: domains, grids and arguments across the whole range of double, and a tie, which
// needs the exact denominator as well.
void ExactWorst(benchmark::State& state) {
  constexpr double kHuge = std::numeric_limits<double>::max(), kTiny = 0x1p-1074;
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 0);
  for (double& point : problem.points) point = 0x1.000001p0;
  for (Domain& domain : problem.component.domain) domain = {-kHuge, kHuge};
  for (auto& at : problem.at) {
    for (GridArgument& u : at) u = {{kTiny, -0x1p-1000, 0x7FFFFFFF}, 0x1FFFFFFFFLL};
  }
  run_benchmark(state, problem);
}
BENCHMARK(ExactWorst)
    ->Args({4, 1})
    ->Args({64, 1})
    ->Args({4, 4})
    ->Args({64, 64})
    ->Unit(benchmark::kMicrosecond);

// ---- Degree reduction, when a plan is made

void run_reduce(benchmark::State& state, const Problem& problem) {
  std::vector<double> reduced(problem.points.size());
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(glev::reduce(problem.component, reduced.data()));
  }
}

void ReduceRandom(benchmark::State& state) {
  run_reduce(state, random_floats({static_cast<int>(state.range(0)), static_cast<int>(state.range(1))}, 36));
}
BENCHMARK(ReduceRandom)->Args({4, 1})->Args({64, 1})->Args({4, 4})->Args({64, 64});

// Reduces planes: i + 3 j.
void ReducePlane(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0)), order_v = static_cast<int>(state.range(1));
  Problem problem = random_floats({order, order_v}, 0);
  for (int i = 0, k = 0; i < order; ++i) {
    for (int j = 0; j < order_v; ++j) problem.points[k++] = i + 3.0 * j;
  }
  run_reduce(state, problem);
}
BENCHMARK(ReducePlane)->Args({4, 1})->Args({64, 1})->Args({4, 4})->Args({64, 64});

}  // namespace
