// Tests many threads that evaluate different batches through the same plans.
#include <thread>

#include "batches.h"

namespace glev_tests {
namespace {

using EveryBits = std::vector<std::vector<std::uint64_t>>;

// Does the work of one thread, with its own arguments, ranges and memory, and returns the bits of all
// results.
EveryBits work_of(int thread, const glev_plan* curve, const glev_plan* surface) {
  Chance chance(kSeed + static_cast<unsigned>(thread));
  EveryBits bits;
  for (int round = 0; round < 12; ++round) {
    std::vector<float> u, v;
    for (int i = 0; i < 50 + thread; ++i) {
      u.push_back(chance.one_of({chance.next_float(), 0.5F, chance.between(-1, 2)}));
      v.push_back(chance.next_float());
    }
    for (glev_attribute attribute : kEveryAttribute) {
      for (glev_precision precision : {GLEV_CORRECTLY_ROUNDED, GLEV_FAST}) {
        bits.push_back(bits_of(evaluate_scattered(curve, attribute, u, {}, precision)));
        bits.push_back(bits_of(evaluate_scattered(surface, attribute, u, v, precision)));
        bits.push_back(bits_of(evaluate_grid(curve, attribute, {-thread, 30}, precision)));
        bits.push_back(bits_of(evaluate_grid(surface, attribute, {thread, 20, 0, 8}, precision)));
      }
      bits.push_back(bits_of(evaluate_scattered<double>(surface, attribute, u, v)));
    }
  }
  return bits;
}

class Threads : public ContextTest, public ::testing::WithParamInterface<bool> {};

TEST_P(Threads, GetTheBitsThatTheyGetAlone) {
  Chance chance;
  define_maps(gl, chance, 7);
  enable_maps(gl, chance);
  if (GetParam()) glevEnable(gl, GLEV_AUTO_NORMAL);
  glevMapGrid1f(gl, 30, 0, 1);
  glevMapGrid2f(gl, 20, 0.1F, 0.9F, 8, 0, 1);
  const Plan curve(gl, 1), surface(gl, 2);
  constexpr int kThreads = 8;
  std::array<EveryBits, kThreads> together;
  std::vector<std::thread> threads;
  for (int k = 0; k < kThreads; ++k) {
    threads.emplace_back([&, k] { together[static_cast<std::size_t>(k)] = work_of(k, curve, surface); });
  }
  for (std::thread& thread : threads) thread.join();
  for (int k = 0; k < kThreads; ++k)
    EXPECT_TRUE(together[static_cast<std::size_t>(k)] == work_of(k, curve, surface)) << "thread " << k;
}

INSTANTIATE_TEST_SUITE_P(, Threads, ::testing::Values(false, true),
                         [](const auto& test) { return test.param ? "WithAutomaticNormals" : "WithMaps"; });

}  // namespace
}  // namespace glev_tests
