// Loads the arguments of curves and surfaces, and maps them to the domain.
#if defined(GLEVALUATOR_ARGUMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_ARGUMENTS_INL_H_
#undef GLEVALUATOR_ARGUMENTS_INL_H_
#else
#define GLEVALUATOR_ARGUMENTS_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <limits>

#include "kernels.h"
#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// Computes t, s and x = t - s of arguments in one direction.
struct Place {
  Place(const PreparedMap& map, int direction)
      : u1(hn::Set(kDoubles, map.surface.domain[direction].u1)),
        u2(hn::Set(kDoubles, map.surface.domain[direction].u2)),
        width(hn::Sub(u2, u1)),
        inverse(hn::Set(kDoubles, map.inverse_width[direction])),
        scale(hn::Set(kDoubles, map.place[direction].scale)),
        middle(hn::Set(kDoubles, map.place[direction].middle)),
        has_inverse(map.inverse_width[direction] != 0) {}
  HWY_INLINE Vector divide_by_width(Vector x) const {
    return has_inverse ? hn::Mul(x, inverse) : hn::Div(x, width);
  }
  HWY_INLINE Vector t_of(Vector u) const { return divide_by_width(hn::Sub(u, u1)); }
  HWY_INLINE Vector s_of(Vector u) const { return divide_by_width(hn::Sub(u2, u)); }

  // Returns t - s. An inverse is a power of two, so with it the result is rounded only once.
  HWY_INLINE Vector x_of(Vector u) const {
    return has_inverse ? hn::MulSub(u, scale, middle) : hn::Sub(t_of(u), s_of(u));
  }

  // Returns the number of roundings of t and s.
  int roundings() const { return has_inverse ? 1 : 3; }

  Vector u1, u2, width, inverse, scale, middle;
  bool has_inverse;  // the inverse of the width is exact
};

// The `count` arguments of a call in one direction.
class Arguments {
 public:
  Arguments(const Input& input, std::size_t count)
      : input_(input), count_(count), is_packed_(!input.is_double && input.stride == sizeof(float)) {}

  // Loads kStep arguments from `begin` on. After the end, the last one is repeated.
  HWY_INLINE void load(std::size_t begin, Vector (&arguments)[kUnroll]) const {
    if (HWY_LIKELY(is_packed_ && begin + kStep <= count_)) {
      for (std::size_t part = 0; part < kUnroll; ++part) arguments[part] = packed(begin + part * kLanes);
    } else {
      for (std::size_t part = 0; part < kUnroll; ++part) arguments[part] = part_at(begin + part * kLanes);
    }
  }

 private:
  HWY_INLINE Vector packed(std::size_t begin) const {
    const auto* const floats = reinterpret_cast<const float*>(input_.data) + begin;
    return hn::PromoteTo(kDoubles, hn::LoadU(kHalves, floats));
  }
  HWY_INLINE Vector part_at(std::size_t begin) const {
    if (is_packed_ && begin + kLanes <= count_) return packed(begin);
    if (begin >= count_) return hn::Set(kDoubles, input_[count_ - 1]);
    alignas(64) double arguments[kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) arguments[i] = input_[std::min(begin + i, count_ - 1)];
    return hn::Load(kDoubles, arguments);
  }

  Input input_;
  std::size_t count_;
  bool is_packed_;
};

// Returns t inside the domain, otherwise NaN.
HWY_INLINE Vector nan_outside(Vector t, Vector s) {
  const Vector nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  return hn::IfThenElse(hn::Ge(hn::Min(t, s), hn::Zero(kDoubles)), t, nan);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_ARGUMENTS_INL_H_
