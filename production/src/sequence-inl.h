// Computes points of a mesh as a sequence of values, without interleaving.
#if defined(GLEVALUATOR_SEQUENCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_SEQUENCE_INL_H_
#undef GLEVALUATOR_SEQUENCE_INL_H_
#else
#define GLEVALUATOR_SEQUENCE_INL_H_
#endif

#include <cstddef>
#include <cstring>
#include <numeric>

#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// Packed points are a sequence of values. Each column is repeated for each component of a point, so values
// are computed in their order and need not be interleaved.
template <class Tag, int kComponents>
class Sequence {
  using Value = hn::TFromD<Tag>;
  using Values = hn::Vec<Tag>;
  static constexpr Tag kTag{};
  static constexpr std::size_t kWidth = hn::MaxLanes(Tag());

 public:
  // The number of vectors after which the order of components repeats, and the number of their values.
  static constexpr std::size_t kPeriod = kComponents / std::gcd(std::size_t{kComponents}, kWidth);
  static constexpr std::size_t kGroup = kPeriod * kWidth;

  // Repeats each of `count` values kComponents times, including those that fill the last vector.
  HWY_INLINE void repeat(const Value* values, std::size_t count, Value* to) const {
    for (std::size_t c = 0; c < count; c += kWidth) {
      const Values value = hn::Load(kTag, values + c);
      for (std::size_t i = 0; i < kComponents * kWidth; i += kWidth) {
        hn::Store(hn::TableLookupLanes(value, hn::SetTableIndices(kTag, kTable.column + i)), kTag,
                  to + c * kComponents + i);
      }
    }
  }

  // Returns the components of a point as vector number `part` of a period. The point must be padded for reads
  // of vectors.
  HWY_INLINE Values values_of(const Value* point, std::size_t part) const {
    if constexpr (kWidth >= 4) {
      return hn::TableLookupLanes(hn::LoadU(kTag, point),
                                  hn::SetTableIndices(kTag, kTable.component + part * kWidth));
    } else {
      HWY_ALIGN Value lanes[kWidth];
      for (std::size_t i = 0; i < kWidth; ++i) lanes[i] = point[kTable.component[part * kWidth + i]];
      return hn::Load(kTag, lanes);
    }
  }

 private:
  using Index = hwy::MakeSigned<Value>;
  struct Table {
    HWY_ALIGN Index column[kComponents * kWidth], component[kComponents * kWidth];
  };
  static constexpr Table kTable = [] {
    Table table{};
    for (std::size_t i = 0; i < kComponents * kWidth; ++i) {
      table.column[i] = static_cast<Index>(i / kComponents);
      table.component[i] = static_cast<Index>(i % kComponents);
    }
    return table;
  }();
};

// Calls evaluate(begin, group), which must write kGroup floats from number `begin` on, until `count` floats
// are written.
template <std::size_t kGroup, class Evaluate>
HWY_INLINE void in_groups(std::size_t count, float* out, const Evaluate& evaluate) {
  std::size_t begin = 0;
  for (; begin + kGroup <= count; begin += kGroup) evaluate(begin, out + begin);
  if (begin < count) {
    float group[kGroup];
    evaluate(begin, group);
    std::memcpy(out + begin, group, (count - begin) * sizeof(float));
  }
}

// Calls evaluate(begin, part, vector), which must write a vector of floats from number `begin` on, until
// `count` floats are written. `part` is the number of the vector in its period.
template <std::size_t kWidth, std::size_t kPeriod, class Evaluate>
HWY_INLINE void in_vectors(std::size_t count, float* out, const Evaluate& evaluate) {
  constexpr std::size_t kGroup = kPeriod * kWidth;
  std::size_t begin = 0;
  for (; begin + kGroup <= count; begin += kGroup) {
    for (std::size_t part = 0; part < kPeriod; ++part)
      evaluate(begin + part * kWidth, part, out + begin + part * kWidth);
  }
  for (std::size_t part = 0; part < kPeriod; ++part, begin += kWidth) {
    if (begin >= count) return;
    if (begin + kWidth <= count) {
      evaluate(begin, part, out + begin);
      continue;
    }
    float vector[kWidth];
    evaluate(begin, part, vector);
    std::memcpy(out + begin, vector, (count - begin) * sizeof(float));
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_SEQUENCE_INL_H_
