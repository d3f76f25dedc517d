// The function enclose() with several control points at a time. Its error bound is that of enclosure.h: sums
// take the same steps in another order or, along a curve, a quarter of the steps in the fourth power of the
// ratio, whose error is at most that of four ratios and three products.
#if defined(GLEVALUATOR_ENCLOSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_ENCLOSURE_INL_H_
#undef GLEVALUATOR_ENCLOSURE_INL_H_
#else
#define GLEVALUATOR_ENCLOSURE_INL_H_
#endif

#include <cstddef>
#include <cstring>

#include "enclosure.h"
#include "mutation_point.h"
#include "point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {
namespace enclosure {

constexpr std::size_t kWidth = kFourLanes;

// Vectors of double-doubles. The operations have the errors of those in double_double.h.
template <class V>
struct Pairs {
  V high, low;
};
using FourPairs = Pairs<FourVector>;

HWY_INLINE FourPairs pairs_of(const DoubleDouble& x) {
  return {hn::Set(kFour, x.high), hn::Set(kFour, x.low)};
}

template <class V>
HWY_INLINE Pairs<V> fast_two_sums(V x, V y) {
  const V sum = hn::Add(x, y);
  return {sum, hn::Sub(y, hn::Sub(sum, x))};
}

template <class V>
HWY_INLINE Pairs<V> two_sums(V x, V y) {
  const V sum = hn::Add(x, y), part = hn::Sub(sum, x);
  return {sum, hn::Add(hn::Sub(x, hn::Sub(sum, part)), hn::Sub(y, part))};
}

template <class V>
HWY_INLINE Pairs<V> two_products(V x, V y) {
  const V product = hn::Mul(x, y);
#if HWY_NATIVE_FMA
  return {product, hn::MulSub(x, y, product)};
#else
  const auto split = [](V z) -> Pairs<V> {
    const V shifted = hn::Mul(z, hn::Set(hn::DFromV<V>(), 0x1p27 + 1)),
            high = hn::Sub(shifted, hn::Sub(shifted, z));
    return {high, hn::Sub(z, high)};
  };
  const Pairs<V> a = split(x), b = split(y);
  const V rest = hn::Add(hn::Add(hn::Sub(hn::Mul(a.high, b.high), product), hn::Mul(a.high, b.low)),
                         hn::Mul(a.low, b.high));
  return {product, hn::Add(rest, hn::Mul(a.low, b.low))};
#endif
}

template <class V>
HWY_INLINE Pairs<V> add_pairs(const Pairs<V>& x, const Pairs<V>& y) {
  const Pairs<V> sum = two_sums(x.high, y.high);
  return two_sums(sum.high, hn::Add(sum.low, hn::Add(x.low, y.low)));
}

template <class V>
HWY_INLINE Pairs<V> multiply_pairs(const Pairs<V>& x, const Pairs<V>& y) {
  const Pairs<V> product = two_products(x.high, y.high);
  const V cross = hn::Add(hn::Mul(x.high, y.low), hn::Mul(x.low, y.high));
  return fast_two_sums(product.high, hn::Add(product.low, cross));
}

// At most 64 double-doubles, padded with zeros to a multiple of four.
struct Row {
  alignas(32) double high[kMaxOrder], low[kMaxOrder];

  HWY_INLINE FourPairs load(std::size_t i) const {
    return {hn::Load(kFour, high + i), hn::Load(kFour, low + i)};
  }
  HWY_INLINE void put(std::size_t i, const FourPairs& pairs) {
    hn::Store(pairs.high, kFour, high + i);
    hn::Store(pairs.low, kFour, low + i);
  }
  DoubleDouble operator[](std::size_t i) const { return {high[i], low[i]}; }
};

constexpr std::size_t round_up(int order) { return (static_cast<std::size_t>(order) + 3) / 4 * 4; }

// Returns the sum of terms[i] * ratio^i.
inline DoubleDouble sum_of(const Row& terms, int degree, const DoubleDouble& ratio) {
  const DoubleDouble square = ratio * ratio, third = square * ratio;
  const FourPairs fourth = pairs_of(GLEV_AT(fourth_power, square * square));
  Row last;  // lane i: sum of terms[i + 4 k] * ratio^(4 k)
  const std::size_t end = round_up(degree + 1);
  for (std::size_t lane = 0; lane < 4; lane += kWidth) {
    FourPairs sum = terms.load(end - 4 + lane);
    for (std::size_t i = end - 4; i != 0; i -= 4)
      sum = add_pairs(multiply_pairs(sum, fourth), terms.load(i - 4 + lane));
    last.put(lane, sum);
  }
  return (last[0] + last[1] * ratio) + (last[2] * square + last[3] * third);
}

inline Enclosure enclose_all(const Component& component, double largest, const GridArgument& u,
                             const GridArgument& v) {
  const int order_v = component.order[1], n = component.order[0] - 1, m = order_v - 1;
  const PreparedDirection in_u = prepare_direction(component.domain[0], u, n),
                          in_v = prepare_direction(component.domain[1], v, m);
  if (!is_claimed(in_u, in_v, largest)) return {{}, HUGE_VAL};
  // The terms S_j of a curve in v are control points, or sums over i. A curve in u is treated like a curve in
  // v.
  const bool is_curve = m == 0;
  const PreparedDirection& along = is_curve ? in_u : in_v;
  const int degree = is_curve ? n : m;
  Row points;
  const std::size_t padded = round_up(degree + 1);
  if (is_curve || n == 0) {
    std::memcpy(points.high, component.points, (static_cast<std::size_t>(degree) + 1) * sizeof(double));
    std::memset(points.low, 0, padded * sizeof(double));
  } else {
    // Horner's rule over i for several j at once.
    Row binomials;
    for (int i = 0; i <= n; ++i) {
      const DoubleDouble binomial = exact_binomial(n, i);
      binomials.high[i] = binomial.high;
      binomials.low[i] = binomial.low;
    }
    const FourPairs ratio = pairs_of(in_u.ratio);
    const int last = in_u.from_last ? n : 0, step = in_u.from_last ? -1 : 1;
    for (std::size_t j = 0; j < padded; j += kWidth) {
      const auto term = [&](int i) {
        const FourVector point =
            hn::LoadU(kFour, component.points + static_cast<std::ptrdiff_t>(i) * order_v + j);
        return multiply_pairs(FourPairs{point, hn::Zero(kFour)},
                              pairs_of(binomials[static_cast<std::size_t>(i)]));
      };
      FourPairs sum = term(last);
      for (int k = 1; k <= n; ++k) sum = add_pairs(multiply_pairs(sum, ratio), term(last + k * step));
      points.put(j, sum);
    }
  }
  // Sorts the terms by their powers.
  Row terms, binomials;
  for (std::size_t j = 0; j < padded; ++j) {
    const int i = static_cast<int>(j);
    const auto from = static_cast<std::size_t>(along.from_last ? i : degree - i);
    const bool is_there = i <= degree;
    terms.high[j] = is_there ? points.high[from] : 0;
    terms.low[j] = is_there ? points.low[from] : 0;
    const DoubleDouble binomial = is_there ? exact_binomial(degree, i) : DoubleDouble{};
    binomials.high[j] = binomial.high;
    binomials.low[j] = binomial.low;
  }
  for (std::size_t j = 0; j < padded; j += kWidth)
    terms.put(j, multiply_pairs(terms.load(j), binomials.load(j)));
  return enclosure_of(sum_of(terms, degree, along.ratio), {n, m}, in_u, in_v, largest);
}

}  // namespace enclosure
}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_ENCLOSURE_INL_H_
