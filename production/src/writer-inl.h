// Rounds values in double with known error bounds, and stores them as points.
#if defined(GLEVALUATOR_WRITER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_WRITER_INL_H_
#undef GLEVALUATOR_WRITER_INL_H_
#else
#define GLEVALUATOR_WRITER_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernels.h"
#include "mutation_point.h"
#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// Returns true if points can be stored contiguously. Single floats must be aligned for this.
HWY_INLINE bool is_packed(std::size_t components, const Destination& to) {
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(to.data) % alignof(float) == 0 && to.row_stride % alignof(float) == 0;
  return to.components == static_cast<int>(components) && to.stride == components * sizeof(float) &&
         (kLanes > 1 || is_aligned);
}

// Copies `count` elements of three floats, a multiple of 4, to `to`, where they are `stride` bytes apart.
// Each element is read in two parts, neither of which crosses a block of 16 bytes, because processors cannot
// forward two stores to one load.
inline void copy_triples(const float* from, std::size_t count, std::size_t stride, std::byte* to) {
  constexpr std::size_t kOne = sizeof(float), kTwo = 2 * sizeof(float);
  for (std::size_t i = 0; i < count; i += 4, from += 12, to += 4 * stride) {
    std::memcpy(to, from, kTwo);
    std::memcpy(to + kTwo, from + 2, kOne);
    std::memcpy(to + stride, from + 3, kOne);
    std::memcpy(to + stride + kOne, from + 4, kTwo);
    std::memcpy(to + 2 * stride, from + 6, kTwo);
    std::memcpy(to + 2 * stride + kTwo, from + 8, kOne);
    std::memcpy(to + 3 * stride, from + 9, kOne);
    std::memcpy(to + 3 * stride + kOne, from + 10, kTwo);
  }
}

// Copies packed points, which vectors have written, to their destination.
template <int kComponents>
HWY_NOINLINE void scatter(const float* values, std::size_t count, const Destination& to, std::byte* data) {
  if constexpr (kComponents == 3) {
    if (count % 4 == 0 && to.components == 3) return copy_triples(values, count, to.stride, data);
  }
  for (std::size_t i = 0; i < count; ++i, data += to.stride) {
    std::memcpy(data, values + i * kComponents, kComponents * sizeof(float));
    for (int k = kComponents; k < to.components; ++k) {
      const float missing = k == 3 ? 1 : 0;
      std::memcpy(data + k * sizeof(float), &missing, sizeof missing);
    }
  }
}

// Same for a number of components that is no constant.
inline void scatter(std::size_t components, const float* values, std::size_t count, const Destination& to,
                    std::byte* data) {
  static constexpr decltype(&scatter<1>) kOf[] = {scatter<1>, scatter<2>, scatter<3>, scatter<4>};
  kOf[components - 1](values, count, to, data);
}

// Stores kStep points without padding.
template <int kComponents>
HWY_INLINE void interleave(const Whole (&value)[kComponents], float* to) {
#if HWY_TARGET == HWY_SCALAR
  for (int k = 0; k < kComponents; ++k) to[k] = hn::GetLane(value[k]);
#else
  if constexpr (kComponents == 1) hn::StoreU(value[0], kWhole, to);
  if constexpr (kComponents == 2) hn::StoreInterleaved2(value[0], value[1], kWhole, to);
  if constexpr (kComponents == 3) hn::StoreInterleaved3(value[0], value[1], value[2], kWhole, to);
  if constexpr (kComponents == 4) hn::StoreInterleaved4(value[0], value[1], value[2], value[3], kWhole, to);
#endif
}

// Stores `count` <= kStep points at `data`. `packed`: is_packed() for the destination.
template <int kComponents>
HWY_INLINE void store_points(const Whole (&value)[kComponents], std::size_t count, bool packed,
                             const Destination& to, std::byte* data) {
  if (HWY_LIKELY(packed && count == kStep))
    return interleave<kComponents>(value, reinterpret_cast<float*>(data));
  alignas(64) float values[kStep * kComponents];
  interleave<kComponents>(value, values);
  scatter<kComponents>(values, count, to, data);
}

// Rounds and writes the results of a map. NaN is undecided.
template <int kComponents>
class Writer {
 public:
  Writer(const PreparedMap::Test& test, const Destination& to, std::byte* data) : to_(to), data_(data) {
    for (int k = 0; k < kComponents; ++k) error_[k] = hn::Set(kDoubles, test.error[k]);
    is_packed_ = is_packed(kComponents, to);
  }

  // Rounds the values of `count` <= kStep elements from `begin` on, and writes them. Calls resolve(element,
  // component) for undecided values.
  template <class Resolver>
  HWY_INLINE void write(const Vector (&value)[kUnroll][kComponents], std::size_t begin, std::size_t count,
                        const Resolver& resolve) const {
    Whole rounded[kComponents];
    hn::Mask<decltype(kWhole)> settled[kComponents];
    for (int k = 0; k < kComponents; ++k) {
      Half low[kUnroll], high[kUnroll];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        low[part] = hn::DemoteTo(kHalves, GLEV_AT(lower_ends, hn::Sub(value[part][k], error_[k])));
        high[part] = hn::DemoteTo(kHalves, hn::Add(value[part][k], error_[k]));
      }
      rounded[k] = join(high);
      settled[k] = hn::Eq(join(low), rounded[k]);
    }
    store_points<kComponents>(rounded, count, is_packed_, to_, data_ + begin * to_.stride);
    auto all_settled = settled[0];
    for (int k = 1; k < kComponents; ++k)
      all_settled = hn::And(all_settled, GLEV_AT(settled_component, settled[k]));
    if (HWY_UNLIKELY(!hn::AllTrue(kWhole, all_settled))) {
      std::uint8_t bits[kComponents][8];
      for (int k = 0; k < kComponents; ++k) hn::StoreMaskBits(kWhole, settled[k], bits[k]);
      repair(bits, begin, count, resolve);
    }
  }

 private:
  template <class Resolver>
  HWY_NOINLINE void repair(const std::uint8_t (&settled)[kComponents][8], std::size_t begin,
                           std::size_t count, const Resolver& resolve) const {
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < kComponents; ++k) {
        if ((settled[k][i / 8] >> (i % 8) & 1) != 0) continue;
        const float result = resolve(begin + i, k);
        std::memcpy(data_ + (begin + i) * to_.stride + k * sizeof(float), &result, sizeof result);
      }
    }
  }

  const Destination& to_;
  std::byte* data_;
  bool is_packed_;
  Vector error_[kComponents];
};

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_WRITER_INL_H_
