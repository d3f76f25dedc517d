// Benchmarks the filter with the exact method behind it on many arguments. Items are values of one component.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include <reference/filter.h>

namespace evalcts::reference {
namespace {

constexpr std::size_t kArguments = 4096;

std::vector<double> random_floats(std::mt19937& random, std::size_t count, double low, double high) {
  std::vector<double> result(count);
  for (double& x : result) {
    x = static_cast<float>(low + (high - low) * (static_cast<double>(random()) / 4294967296.0));
  }
  return result;
}

void RoundCurve(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  std::mt19937 random(1);
  const std::vector<double> points = random_floats(random, order, -1, 1);
  const std::vector<double> u = random_floats(random, kArguments, 0, 1);
  const CorrectlyRounded rounded(Surface{points.data(), {1, order}});
  std::vector<float> results(kArguments);
  for (auto _ : state) benchmark::DoNotOptimize(rounded.to_float({u}, {}, results));
  state.SetItemsProcessed(state.iterations() * kArguments);
}

void RoundSurface(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  std::mt19937 random(1);
  const std::vector<double> points = random_floats(random, static_cast<std::size_t>(order) * order, -1, 1);
  const std::vector<double> u = random_floats(random, kArguments, 0, 1),
                            v = random_floats(random, kArguments, 0, 1);
  const CorrectlyRounded rounded(Surface{points.data(), {order, order, 0, 1}, {1, order}});
  std::vector<float> results(kArguments);
  for (auto _ : state) benchmark::DoNotOptimize(rounded.to_float({u}, {v}, results));
  state.SetItemsProcessed(state.iterations() * kArguments);
}

// Rounds each value of a curve with the exact method, without the filter.
void RoundCurveExactly(benchmark::State& state) {
  const int order = static_cast<int>(state.range(0));
  std::mt19937 random(1);
  const std::vector<double> points = random_floats(random, order, -1, 1);
  const std::vector<double> u = random_floats(random, kArguments, 0, 1);
  const BernsteinForm form(Surface{points.data(), {1, order}});
  for (auto _ : state) {
    for (const double x : u) benchmark::DoNotOptimize(form.to_float(Argument::coordinate(x)));
  }
  state.SetItemsProcessed(state.iterations() * kArguments);
}

BENCHMARK(RoundCurve)->Arg(4)->Arg(10)->Arg(30);
BENCHMARK(RoundCurveExactly)->Arg(4)->Arg(10)->Arg(30);
BENCHMARK(RoundSurface)->Arg(4)->Arg(8)->Arg(30);

}  // namespace
}  // namespace evalcts::reference
