// The kernels, compiled once for each instruction set, and their table. prepared_map.h derives the error
// bounds of values in double.
#include "kernels.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

#include <atomic>
#include <cstddef>
#include <cstring>

#include "instruction_sets.h"
#include "plan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/kernels.cpp"
#include <hwy/foreach_target.h>

#include "centred_mesh-inl.h"
#include "direct-inl.h"
#include "doubles-inl.h"
#include "enclosure-inl.h"
#include "fast_mesh-inl.h"
#include "mesh-inl.h"
#include "normals-inl.h"
#include "point-inl.h"
#include "scattered-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

template <int kComponents>
void evaluate_mesh_of(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
                      double* scratch) {
  if (fast && evaluate_fast_mesh<kComponents>(map, range, to, scratch)) return;
  evaluate_rounded_mesh<kComponents>(map, range, to, scratch);
}

void evaluate_curve(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to) {
  static constexpr decltype(&evaluate_curves<1>) kOf[] = {evaluate_curves<1>, evaluate_curves<2>,
                                                          evaluate_curves<3>, evaluate_curves<4>};
  kOf[map.surface.components - 1](map, {u, u, count}, to);
}

void evaluate_surface(const PreparedMap& map, const Input& u, const Input& v, std::size_t count, bool fast,
                      const Destination& to) {
  static constexpr decltype(&evaluate_surfaces<1>) kOf[] = {evaluate_surfaces<1>, evaluate_surfaces<2>,
                                                            evaluate_surfaces<3>, evaluate_surfaces<4>};
  kOf[map.surface.components - 1](map, {u, v, count}, fast, to);
}

void evaluate_mesh(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
                   std::byte* scratch) {
  static constexpr decltype(&evaluate_mesh_of<1>) kOf[] = {evaluate_mesh_of<1>, evaluate_mesh_of<2>,
                                                           evaluate_mesh_of<3>, evaluate_mesh_of<4>};
  auto* const values = reinterpret_cast<double*>(scratch);
  if (!evaluate_centred_mesh(map, range, fast, to, values))
    kOf[map.surface.components - 1](map, range, fast, to, values);
}

bool evaluate_double_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                          std::byte* scratch) {
  return doubles::evaluate_mesh(map, range, to, reinterpret_cast<double*>(scratch));
}

namespace patches {
// patch_kernels.cpp
void load(const float* const* points, std::size_t count, double* net);
unsigned evaluate(const PatchBlock& block);
}  // namespace patches

constexpr Kernels make_kernels(const char* name) {
  return {.name = name,
          .point = evaluate_point,
          .direct = evaluate_directly,
          .direct_cubic_curve = evaluate_cubic_directly<false>,
          .direct_bicubic = evaluate_cubic_directly<true>,
          .curve = evaluate_curve,
          .surface = evaluate_surface,
          .mesh = evaluate_mesh,
          .normals = normals::evaluate_mesh,
          .encloses = enclosure::enclose_all,
          .double_curve = doubles::evaluate_curve,
          .double_mesh = evaluate_double_mesh,
          .load_patches = patches::load,
          .patches = patches::evaluate};
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glev {

std::size_t mesh_scratch(int degree, std::size_t columns) {
  constexpr std::size_t kWidest = 64;  // a multiple of the step of every instruction set
  const std::size_t padded = (columns + kWidest - 1) / kWidest * kWidest;
  return padded * sizeof(double) * (static_cast<std::size_t>(degree) + 3);
}

namespace {

// The detection of Highway is not used, because it is in a library that needs the C++ run time.
#if HWY_ARCH_X86
// F16C is detected by CPUID, because not every compiler supports its name. The result is cached, because
// CPUID takes microseconds in a virtual machine. Threads may compute it twice with the same result.
bool has_f16c() {
  enum { kUnknown, kNo, kYes };
  static std::atomic<int> known{kUnknown};
  int answer = known.load(std::memory_order_relaxed);
  if (answer == kUnknown) {
    unsigned a = 0, b = 0, c = 0, d = 0;
    answer = __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0 ? kYes : kNo;
    known.store(answer, std::memory_order_relaxed);
  }
  return answer == kYes;
}
[[maybe_unused]] bool has_sse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
         __builtin_cpu_supports("aes");
}
[[maybe_unused]] bool has_avx2() {
  return has_sse4() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && has_f16c();
}
[[maybe_unused]] bool has_avx3() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}
#endif
bool has_baseline() { return true; }

struct Target {
  bool (*is_supported)();
  Kernels kernels;
};

constexpr Target kTargets[] = {
#if (HWY_TARGETS & HWY_AVX3) && HWY_STATIC_TARGET != HWY_AVX3
    {has_avx3, N_AVX3::make_kernels("AVX3")},
#endif
#if (HWY_TARGETS & HWY_AVX2) && HWY_STATIC_TARGET != HWY_AVX2
    {has_avx2, N_AVX2::make_kernels("AVX2")},
#endif
#if (HWY_TARGETS & HWY_SSE4) && HWY_STATIC_TARGET != HWY_SSE4
    {has_sse4, N_SSE4::make_kernels("SSE4")},
#endif
    {has_baseline, HWY_STATIC_DISPATCH(make_kernels)("baseline")},
};

}  // namespace

const Kernels* kernels_of(std::size_t index) {
  for (const auto& [is_supported, kernels] : kTargets) {
    if (is_supported() && index-- == 0) return &kernels;
  }
  return nullptr;
}

const Kernels* find_kernels(const char* name) {
  for (std::size_t i = 0;; ++i) {
    const Kernels* kernels = kernels_of(i);
    if (kernels == nullptr || name == nullptr || std::strcmp(kernels->name, name) == 0) return kernels;
  }
}

}  // namespace glev
#endif  // HWY_ONCE
