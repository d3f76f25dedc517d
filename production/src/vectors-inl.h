// Defines the vectors of the kernels: Vector has kLanes doubles, Half as many floats, and Whole the floats of
// kUnroll vectors of doubles. Kernels evaluate kStep = kUnroll * kLanes arguments at a time, to hide
// latencies.
#if defined(GLEVALUATOR_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_VECTORS_INL_H_
#undef GLEVALUATOR_VECTORS_INL_H_
#else
#define GLEVALUATOR_VECTORS_INL_H_
#endif

#include <cstddef>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;
constexpr Doubles kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
constexpr hn::Rebind<float, Doubles> kHalves;  // vectors of as many floats

using Half = hn::Vec<decltype(kHalves)>;

#if HWY_TARGET == HWY_SCALAR
constexpr std::size_t kUnroll = 1;
constexpr decltype(kHalves) kWhole;
HWY_INLINE Half join(const Half (&parts)[kUnroll]) { return parts[0]; }
#else
constexpr std::size_t kUnroll = 2;
constexpr hn::Twice<decltype(kHalves)> kWhole;
HWY_INLINE hn::Vec<decltype(kWhole)> join(const Half (&parts)[kUnroll]) {
  return hn::Combine(kWhole, parts[1], parts[0]);
}
#endif
constexpr std::size_t kStep = kUnroll * kLanes;
using Whole = hn::Vec<decltype(kWhole)>;

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_VECTORS_INL_H_
