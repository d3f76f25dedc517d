// Tests many threads that evaluate different batches through the same plans.
#include <thread>

#include "batches.h"

namespace glev_tests {
namespace {

using EveryBits = std::vector<std::vector<std::uint64_t>>;

// Does the work of one thread, with its own arguments, ranges and memory, and returns the bits of all
// results.
EveryBits work_of(int thread, glev_plan* curve, glev_plan* surface) {
  Chance chance(kSeed + static_cast<unsigned>(thread));
  EveryBits bits;
  for (int round = 0; round < 12; ++round) {
    for (glev_plan* plan : {curve, surface}) glevRetainPlan(plan);
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
    for (glev_plan* plan : {curve, surface}) glevReleasePlan(plan);
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
  glev_plan *curve = nullptr, *surface = nullptr;
  const glev_plan_info one = {sizeof one, 1}, two = {sizeof two, 2};
  ASSERT_EQ(glevCreatePlan(gl, &one, &curve), GLEV_SUCCESS);
  ASSERT_EQ(glevCreatePlan(gl, &two, &surface), GLEV_SUCCESS);
  constexpr int kThreads = 8;
  std::array<EveryBits, kThreads> alone, together;
  for (int k = 0; k < kThreads; ++k) alone[static_cast<std::size_t>(k)] = work_of(k, curve, surface);
  std::vector<std::thread> threads;
  for (int k = 0; k < kThreads; ++k) {
    for (glev_plan* plan : {curve, surface}) glevRetainPlan(plan);
    threads.emplace_back([&, k] {
      together[static_cast<std::size_t>(k)] = work_of(k, curve, surface);
      for (glev_plan* plan : {curve, surface}) glevReleasePlan(plan);
    });
  }
  // The threads still have references to the plans.
  for (glev_plan* plan : {curve, surface}) glevReleasePlan(plan);
  glevDestroyContext(gl);
  gl = nullptr;
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < kThreads; ++k) EXPECT_TRUE(together[k] == alone[k]) << "thread " << k;
}

INSTANTIATE_TEST_SUITE_P(, Threads, ::testing::Values(false, true),
                         [](const auto& test) { return test.param ? "WithAutomaticNormals" : "WithMaps"; });

}  // namespace
}  // namespace glev_tests
