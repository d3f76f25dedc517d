// Compares the exact method with number types that could replace it: one correctly rounded float from the
// float points of a curve over [0,1] and a random float u, after preparing everything that does not depend on
// u.
#include <benchmark/benchmark.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#ifdef EVALCTS_MPFR
#include <boost/multiprecision/mpfr.hpp>
#endif
#include <cstdint>
#include <random>
#include <vector>

#include <reference/bernstein_form.h>

namespace evalcts::reference {
namespace {

struct Task {
  std::vector<double> points;  // floats
  std::vector<float> arguments;

  explicit Task(int order) {
    std::mt19937 random(1);
    const auto uniform = [&random](double low, double high) {
      return static_cast<float>(low + (high - low) * (static_cast<double>(random()) / 4294967296.0));
    };
    for (int i = 0; i < order; ++i) points.push_back(uniform(-1, 1));
    for (int i = 0; i < 1024; ++i) arguments.push_back(uniform(0, 1));
  }
  Surface curve() const { return {points.data(), {1, static_cast<int>(points.size())}}; }
};

template <typename Evaluate>
void each_argument(benchmark::State& state, const Task& task, Evaluate evaluate) {
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(task.arguments[next]));
    next = (next + 1) % task.arguments.size();
  }
}

void Exact(benchmark::State& state) {
  const Task task(static_cast<int>(state.range(0)));
  const BernsteinForm form(task.curve());
  each_argument(state, task, [&](float u) { return form.to_float(Argument::coordinate(u)); });
}

// Computes value and magnitude as rationals without preparation, as the judge does.
void ExactUnprepared(benchmark::State& state) {
  const Task task(static_cast<int>(state.range(0)));
  each_argument(state, task,
                [&](float u) { return evaluate_with_magnitude(task.curve(), Argument::coordinate(u)); });
}

// Horner's scheme in Bernstein form, as it would be written with any number type.
template <typename Number>
void Horner(benchmark::State& state) {
  const Task task(static_cast<int>(state.range(0)));
  const int n = static_cast<int>(task.points.size()) - 1;
  std::vector<Number> terms;  // C(n,i) * R_i
  std::uint64_t binomial = 1;
  for (int i = 0; i <= n; ++i) {
    terms.push_back(Number(binomial) * Number(task.points[i]));
    binomial = binomial * (n - i) / (i + 1);
  }
  each_argument(state, task, [&](float u) {
    const Number t(u);
    const Number s = 1 - t;
    Number sum = terms[0], power = 1;
    for (int i = 1; i <= n; ++i) {
      power *= t;
      sum = sum * s + power * terms[i];
    }
    return sum.template convert_to<float>();
  });
}

using boost::multiprecision::cpp_bin_float_50;
using boost::multiprecision::cpp_rational;

#define EVALCTS_ORDERS ->Arg(4)->Arg(10)->Arg(30)
BENCHMARK(Exact) EVALCTS_ORDERS;
BENCHMARK(ExactUnprepared) EVALCTS_ORDERS;
BENCHMARK(Horner<cpp_bin_float_50>) EVALCTS_ORDERS;
#ifdef EVALCTS_MPFR
using boost::multiprecision::mpfr_float_50;
using static_mpfr_float_50 = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_on>;
BENCHMARK(Horner<mpfr_float_50>) EVALCTS_ORDERS;
BENCHMARK(Horner<static_mpfr_float_50>) EVALCTS_ORDERS;
#endif
BENCHMARK(Horner<cpp_rational>) EVALCTS_ORDERS;

}  // namespace
}  // namespace evalcts::reference
