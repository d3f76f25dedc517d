// Measures the peak rates of the machine for each instruction set: multiply-adds and stores per second.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>

#include "side.h"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/floors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace evalcts::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kRounds = 1024;

// Runs enough independent chains for two units with a latency of five cycles. Returns the number of
// multiply-adds.
template <typename T>
std::size_t multiply_add(T* result) {
  const hn::ScalableTag<T> tag;
  const auto factor = hn::Set(tag, static_cast<T>(0.5)), summand = hn::Set(tag, *result);
  // The chains have different numbers, so that the compiler does not merge them.
  auto a = summand, b = hn::Add(a, a), c = hn::Add(b, a), d = hn::Add(c, a), e = hn::Add(d, a);
  auto f = hn::Add(e, a), g = hn::Add(f, a), h = hn::Add(g, a), i = hn::Add(h, a), j = hn::Add(i, a);
  for (std::size_t round = 0; round < kRounds; ++round) {
    a = hn::MulAdd(a, factor, summand);
    b = hn::MulAdd(b, factor, summand);
    c = hn::MulAdd(c, factor, summand);
    d = hn::MulAdd(d, factor, summand);
    e = hn::MulAdd(e, factor, summand);
    f = hn::MulAdd(f, factor, summand);
    g = hn::MulAdd(g, factor, summand);
    h = hn::MulAdd(h, factor, summand);
    i = hn::MulAdd(i, factor, summand);
    j = hn::MulAdd(j, factor, summand);
  }
  a = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)),
              hn::Add(hn::Add(e, f), hn::Add(hn::Add(g, h), hn::Add(i, j))));
  *result = hn::GetLane(a);
  return 10 * kRounds * hn::Lanes(tag);
}

std::size_t double_multiply_add() {
  double result = 1;
  const std::size_t count = multiply_add(&result);
  benchmark::DoNotOptimize(result);
  return count;
}

std::size_t float_multiply_add() {
  float result = 1;
  const std::size_t count = multiply_add(&result);
  benchmark::DoNotOptimize(result);
  return count;
}

void store_floats(float* memory, std::size_t floats) {
  const hn::ScalableTag<float> tag;
  const auto value = hn::Set(tag, 1.0F);
  for (std::size_t i = 0; i < floats; i += hn::Lanes(tag)) hn::Store(value, tag, memory + i);
}

void stream_floats(float* memory, std::size_t floats) {
  const hn::ScalableTag<float> tag;
  const auto value = hn::Set(tag, 1.0F);
  for (std::size_t i = 0; i < floats; i += hn::Lanes(tag)) hn::Stream(value, tag, memory + i);
  hwy::FlushStream();
}

}  // namespace evalcts::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace evalcts::bench {
namespace {

HWY_EXPORT(double_multiply_add);
HWY_EXPORT(float_multiply_add);
HWY_EXPORT(store_floats);
HWY_EXPORT(stream_floats);

constexpr std::size_t kRing = 16 * 1024 * 3, kArray = 1024 * 1024 * 3;  // floats, as in the bicubic meshes

void add_multiply_add(const std::string& name, std::size_t (*function)()) {
  add(name, [function]() -> Measured {
    return {[function] { benchmark::DoNotOptimize(function()); }, static_cast<std::int64_t>(function())};
  });
}

// Adds a benchmark of stores. Items are bytes.
void add_stores(const std::string& name, void (*function)(float*, std::size_t), std::size_t floats) {
  add(name, [function, floats]() -> Measured {
    return {[function, floats] { function(results(), floats); },
            static_cast<std::int64_t>(floats * sizeof(float))};
  });
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const std::string name = std::string("/") + hwy::TargetName(target);
    add_multiply_add("Floor/double_FMA" + name, HWY_DYNAMIC_DISPATCH(double_multiply_add));
    add_multiply_add("Floor/float_FMA" + name, HWY_DYNAMIC_DISPATCH(float_multiply_add));
    add_stores("Floor/store_ring" + name, HWY_DYNAMIC_DISPATCH(store_floats), kRing);
    add_stores("Floor/store_array" + name, HWY_DYNAMIC_DISPATCH(store_floats), kArray);
    add_stores("Floor/stream_array" + name, HWY_DYNAMIC_DISPATCH(stream_floats), kArray);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  return true;
}();

}  // namespace
}  // namespace evalcts::bench
#endif  // HWY_ONCE
