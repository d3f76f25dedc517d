// The kernels, compiled once for each instruction set, and the table of them. prepared_map.h derives the
// bounds of what is computed in double; everything else follows from results being correctly rounded.
#include "kernels.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

#include <cstddef>
#include <cstring>

#include "plan.h"

// Assertions of Highway need its library, of which only the headers are used.
#define HWY_IS_DEBUG_BUILD 0
// Without fused operations these would be one more way to do the same; scalable vectors cannot be in arrays.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/kernels.cpp"
#include <hwy/foreach_target.h>

#include "centred_mesh-inl.h"
#include "curves-inl.h"
#include "direct-inl.h"
#include "enclosure-inl.h"
#include "fast_mesh-inl.h"
#include "mesh-inl.h"
#include "normals-inl.h"
#include "point-inl.h"
#include "surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

template <int kComponents>
void MeshOf(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
            std::byte* scratch) {
  auto* const doubles = reinterpret_cast<double*>(scratch);
  if (fast && FastMesh<kComponents>(map, range, to, doubles)) return;
  if (CentredMesh<kComponents>(map, range, to, doubles)) return;
  RoundedMesh<kComponents>(map, range, to, doubles);
}

void Curve(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to) {
  constexpr decltype(&CurvesOf<1>) kOf[] = {CurvesOf<1>, CurvesOf<2>, CurvesOf<3>, CurvesOf<4>};
  kOf[map.surface.components - 1](map, u, count, to);
}

void SurfaceAt(const PreparedMap& map, const Input& u, const Input& v, std::size_t count,
               const Destination& to) {
  constexpr decltype(&Surfaces<1>) kOf[] = {Surfaces<1>, Surfaces<2>, Surfaces<3>, Surfaces<4>};
  kOf[map.surface.components - 1](map, u, v, count, to);
}

void Mesh(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
          std::byte* scratch) {
  constexpr decltype(&MeshOf<1>) kOf[] = {MeshOf<1>, MeshOf<2>, MeshOf<3>, MeshOf<4>};
  kOf[map.surface.components - 1](map, range, fast, to, scratch);
}

constexpr Kernels MakeKernels(const char* name) {
  return {.name = name,
          .point = Point,
          .direct = Direct,
          .direct_cubic_curve = DirectCubic<false>,
          .direct_bicubic = DirectCubic<true>,
          .curve = Curve,
          .surface = SurfaceAt,
          .mesh = Mesh,
          .normals = normals::Mesh,
          .encloses = enclosure::EncloseAll};
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glev {

double Input::operator[](std::size_t i) const {
  if (is_double) {
    double argument;
    std::memcpy(&argument, data + i * stride, sizeof argument);
    return argument;
  }
  float argument;
  std::memcpy(&argument, data + i * stride, sizeof argument);
  return argument;
}

std::size_t MeshScratch(int degree, std::size_t columns) {
  constexpr std::size_t kWidest = 64;  // the step of any instruction set divides it
  const std::size_t padded = (columns + kWidest - 1) / kWidest * kWidest;
  return padded * sizeof(double) * (static_cast<std::size_t>(degree) + 3);
}

namespace {

// Highway's own detection is in a library that needs the C++ run time.
#if HWY_ARCH_X86
// Not every compiler knows its name.
bool HasF16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
bool HasSse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
         __builtin_cpu_supports("aes");
}
bool HasAvx2() {
  return HasSse4() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && HasF16c();
}
bool HasAvx3() {
  return HasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}
#endif
bool HasBaseline() { return true; }

struct Target {
  bool (*is_supported)();
  Kernels kernels;
};

constexpr Target kTargets[] = {
#if (HWY_TARGETS & HWY_AVX3) && HWY_STATIC_TARGET != HWY_AVX3
    {HasAvx3, N_AVX3::MakeKernels("AVX3")},
#endif
#if (HWY_TARGETS & HWY_AVX2) && HWY_STATIC_TARGET != HWY_AVX2
    {HasAvx2, N_AVX2::MakeKernels("AVX2")},
#endif
#if (HWY_TARGETS & HWY_SSE4) && HWY_STATIC_TARGET != HWY_SSE4
    {HasSse4, N_SSE4::MakeKernels("SSE4")},
#endif
    {HasBaseline, HWY_STATIC_DISPATCH(MakeKernels)("baseline")},
};

}  // namespace

const Kernels* KernelsOf(std::size_t index) {
  for (const auto& [is_supported, kernels] : kTargets) {
    if (is_supported() && index-- == 0) return &kernels;
  }
  return nullptr;
}

}  // namespace glev
#endif  // HWY_ONCE
