// The kernels of the filter, compiled once for each instruction set. PROOF.md defines the quantities and
// proves the bounds.
#include "kernels.h"

#include <reference/filter.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bound.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace evalcts::reference::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kLanes>;
using Vector = hn::Vec<Tag>;

constexpr Tag kTag;

// A vector of double-doubles.
struct Pair {
  Vector high, low;
};

HWY_INLINE Pair two_sum(Vector x, Vector y) {
  const Vector sum = hn::Add(x, y);
  const Vector part = hn::Sub(sum, x);
  return {sum, hn::Add(hn::Sub(x, hn::Sub(sum, part)), hn::Sub(y, part))};
}

HWY_INLINE Pair fast_two_sum(Vector x, Vector y) {
  const Vector sum = hn::Add(x, y);
  return {sum, hn::Sub(y, hn::Sub(sum, x))};
}

HWY_INLINE Pair two_product(Vector x, Vector y) {
  const Vector product = hn::Mul(x, y);
#if HWY_NATIVE_FMA
  return {product, hn::MulSub(x, y, product)};
#else
  // Error-free product by Dekker's algorithm (1971) with Veltkamp's splitting.
  const auto split = [](Vector z) {
    const Vector shifted = hn::Mul(z, hn::Set(kTag, 0x1p27 + 1));
    const Vector high = hn::Sub(shifted, hn::Sub(shifted, z));
    return Pair{high, hn::Sub(z, high)};
  };
  const Pair a = split(x), b = split(y);
  Vector rest = hn::Sub(hn::Mul(a.high, b.high), product);
  rest = hn::Add(rest, hn::Mul(a.high, b.low));
  rest = hn::Add(rest, hn::Mul(a.low, b.high));
  return {product, hn::Add(rest, hn::Mul(a.low, b.low))};
#endif
}

// Returns true if two_product is exact on this machine. If fused operations are switched off, the MulSub of
// Highway rounds twice, and the low part is lost.
inline bool has_exact_products() {
  static const volatile double kNumber = 1 + 0x1p-30;  // not known to the compiler
  const Vector x = hn::Set(kTag, kNumber);
  return hn::AllTrue(kTag, hn::Eq(two_product(x, x).low, hn::Set(kTag, 0x1p-60)));
}

HWY_INLINE Pair add(const Pair& x, const Pair& y) {
  const Pair sum = two_sum(x.high, y.high);
  return two_sum(sum.high, hn::Add(sum.low, hn::Add(x.low, y.low)));
}

HWY_INLINE Pair multiply(const Pair& x, const Pair& y) {
  const Pair product = two_product(x.high, y.high);
  const Vector rest = hn::Add(hn::Mul(x.high, y.low), hn::Mul(x.low, y.high));
  return fast_two_sum(product.high, hn::Add(product.low, rest));
}

HWY_INLINE Pair set(const DoubleDouble& x) { return {hn::Set(kTag, x.high), hn::Set(kTag, x.low)}; }

// The quantities of PROOF.md at one vector of arguments along one direction.
struct Place {
  Pair a, b;
  Vector tau, growth;  // growth: at least ((|a| + |b|)/c)^degree
};

HWY_INLINE Place place(const DirectionPlan& direction, Vector x) {
  const Vector zero = hn::Zero(kTag);
  Place result{{zero, zero}, {zero, zero}, zero, hn::Set(kTag, 1)};
  if (direction.is_grid) {
    const Pair shift = multiply(set(direction.delta), Pair{x, zero});
    result.a = add(shift, set(direction.alpha));
    result.b = add(set(direction.beta), Pair{hn::Neg(shift.high), hn::Neg(shift.low)});
    const double ends = HWY_MAX(std::abs(direction.alpha.high), std::abs(direction.beta.high));
    result.tau =
        hn::Mul(hn::Add(hn::Abs(shift.high), hn::Set(kTag, ends)), hn::Set(kTag, kGridError * kUnitSquared));
  } else {
    const Vector scale = hn::Set(kTag, direction.scale);
    const auto scaled = [scale](const Pair& pair) {
      return Pair{hn::Mul(pair.high, scale), hn::Mul(pair.low, scale)};
    };
    result.a = scaled(two_sum(x, hn::Set(kTag, -direction.first)));
    result.b = scaled(two_sum(hn::Set(kTag, direction.last), hn::Neg(x)));
  }
  const auto outside = hn::Or(hn::Lt(result.a.high, zero), hn::Lt(result.b.high, zero));
  if (!hn::AllFalse(kTag, outside)) {
    const Vector base = hn::Mul(hn::Add(hn::Abs(result.a.high), hn::Abs(result.b.high)),
                                hn::Set(kTag, direction.inverse_width * (1 + kGrowthRoundings)));
    Vector power = hn::Set(kTag, 1);
    for (int i = 0; i < direction.degree; ++i) power = hn::Mul(power, base);
    result.growth = hn::IfThenElse(outside, hn::Max(power, result.growth), result.growth);
  }
  return result;
}

// The products a^i * b^(n-i) for i = 0..n.
class Weights {
 public:
  HWY_INLINE Weights(const Place& at, int degree) {
    const Pair one{hn::Set(kTag, 1), hn::Zero(kTag)};
    Pair power = one;
    store(0, one);
    for (int i = 1; i <= degree; ++i) {
      power = i == 1 ? at.a : multiply(power, at.a);
      store(i, power);
    }
    for (int i = degree - 1; i >= 0; --i) {
      power = i == degree - 1 ? at.b : multiply(power, at.b);
      store(i, i == 0 ? power : multiply(load(i), power));
    }
  }
  HWY_INLINE Pair load(int i) const {
    return {hn::Load(kTag, high_ + i * kLanes), hn::Load(kTag, low_ + i * kLanes)};
  }

 private:
  HWY_INLINE void store(int i, const Pair& x) {
    hn::Store(x.high, kTag, high_ + i * kLanes);
    hn::Store(x.low, kTag, low_ + i * kLanes);
  }
  HWY_ALIGN double high_[kMaxOrder * kLanes], low_[kMaxOrder * kLanes];
};

HWY_INLINE Pair dot(const DoubleDouble* coefficients, const Weights& weights, int degree) {
  Pair sum = multiply(set(coefficients[0]), weights.load(0));
  for (int i = 1; i <= degree; ++i) sum = add(sum, multiply(set(coefficients[i]), weights.load(i)));
  return sum;
}

// Returns x in lanes that satisfy the condition, otherwise infinity. Comparisons with NaN are false.
template <class Mask>
HWY_INLINE Vector if_or_infinite(Mask condition, Vector x) {
  return hn::IfThenElse(condition, x, hn::Set(kTag, std::numeric_limits<double>::infinity()));
}

void enclose(const KernelPlan& plan, const double* HWY_RESTRICT u, const double* HWY_RESTRICT v,
             std::size_t count, const EnclosureArrays& results) {
  if (!has_exact_products()) {
    std::fill_n(results.error, round_up_to_lanes(count), std::numeric_limits<double>::infinity());
    return;
  }
  const int n = plan.u.degree, m = plan.v.degree;
  const Vector theta = hn::Set(kTag, polynomial_error(n, m) * kUnitSquared);
  for (std::size_t k = 0; k < count; k += hn::Lanes(kTag)) {
    const Vector x = hn::LoadU(kTag, u + k), y = hn::LoadU(kTag, v + k);
    const Place along_u = place(plan.u, x), along_v = place(plan.v, y);
    const Weights weights_u(along_u, n);
    Pair sum;
    if (m == 0) {
      sum = dot(plan.coefficients.data(), weights_u, n);
    } else {
      const Weights weights_v(along_v, m);
      for (int i = 0; i <= n; ++i) {
        const Pair row = dot(&plan.coefficients[static_cast<std::size_t>(i) * (m + 1)], weights_v, m);
        const Pair term = multiply(row, weights_u.load(i));
        sum = i == 0 ? term : add(sum, term);
      }
    }
    const Vector growth = hn::Mul(along_u.growth, along_v.growth);
    const Vector taus =
        hn::Add(hn::Mul(along_u.tau, hn::Set(kTag, 4.0 * n)), hn::Mul(along_v.tau, hn::Set(kTag, 4.0 * m)));
    const Vector relative = hn::Mul(hn::Mul(hn::Set(kTag, plan.largest), growth), hn::Add(theta, taus));
    Vector error = hn::Add(relative, hn::Set(kTag, kTiny));
    error = hn::Mul(error, hn::Set(kTag, 1 + kBoundRoundings));
    const Vector largest_argument = hn::Set(kTag, kLargestArgument);
    error = if_or_infinite(hn::Le(hn::Abs(x), largest_argument), error);
    error = if_or_infinite(hn::Le(hn::Abs(y), largest_argument), error);
    error = if_or_infinite(hn::Le(growth, hn::Set(kTag, kLargestGrowth)), error);
    error = if_or_infinite(hn::Le(hn::Add(along_u.tau, along_v.tau), hn::Set(kTag, kLargestTau)), error);
    hn::StoreU(sum.high, kTag, results.high + k);
    hn::StoreU(sum.low, kTag, results.low + k);
    hn::StoreU(error, kTag, results.error + k);
  }
}

// Return bounds of the exact sum whose rounded value is x: x moved up or down by more than a rounding error.
HWY_INLINE Vector above(Vector x) { return hn::Add(x, hn::Mul(hn::Abs(x), hn::Set(kTag, kSumRoundings))); }
HWY_INLINE Vector below(Vector x) { return hn::Sub(x, hn::Mul(hn::Abs(x), hn::Set(kTag, kSumRoundings))); }

constexpr hn::Rebind<float, Tag> kFloatTag;

// Rounds to binary32.
HWY_INLINE hn::Vec<decltype(kFloatTag)> to_float(Vector x) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
  // DemoteTo() of these targets gives the largest finite number instead of infinity.
  HWY_ALIGN double wide[kLanes];
  HWY_ALIGN float narrow[kLanes] = {};
  hn::Store(x, kTag, wide);
  for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane) narrow[lane] = static_cast<float>(wide[lane]);
  return hn::Load(kFloatTag, narrow);
#else
  return hn::DemoteTo(kFloatTag, x);
#endif
}

void round_to_float(const EnclosureArrays& enclosures, double scale, std::size_t count,
                    float* HWY_RESTRICT results, double* HWY_RESTRICT decided) {
  const Vector zero = hn::Zero(kTag), factor = hn::Set(kTag, scale);
  for (std::size_t k = 0; k < count; k += hn::Lanes(kTag)) {
    const Vector high = hn::LoadU(kTag, enclosures.high + k), low = hn::LoadU(kTag, enclosures.low + k),
                 error = hn::LoadU(kTag, enclosures.error + k);
    const Vector most = above(hn::Add(high, above(hn::Add(low, error))));
    const Vector least = below(hn::Add(high, below(hn::Sub(low, error))));
    const auto rounded_most = to_float(hn::Mul(most, factor));
    const auto rounded_least = to_float(hn::Mul(least, factor));
    const auto one_sign = hn::Or(hn::Lt(zero, least), hn::Lt(most, zero));
    const auto equal = hn::Eq(hn::PromoteTo(kTag, rounded_most), hn::PromoteTo(kTag, rounded_least));
    hn::StoreU(rounded_most, kFloatTag, results + k);
    hn::StoreU(hn::IfThenElseZero(hn::And(one_sign, equal), hn::Set(kTag, 1)), kTag, decided + k);
  }
}

void round_to_double(const EnclosureArrays& enclosures, double scale, std::size_t count,
                     double* HWY_RESTRICT results, double* HWY_RESTRICT decided) {
  const Vector factor = hn::Set(kTag, scale), smallest = hn::Set(kTag, 0x1p-1000);
  for (std::size_t k = 0; k < count; k += hn::Lanes(kTag)) {
    const Vector high = hn::LoadU(kTag, enclosures.high + k), low = hn::LoadU(kTag, enclosures.low + k),
                 error = hn::LoadU(kTag, enclosures.error + k);
    const Vector most = hn::Mul(hn::Add(high, above(hn::Add(low, error))), factor);
    const Vector least = hn::Mul(hn::Add(high, below(hn::Sub(low, error))), factor);
    const auto normal = hn::Lt(smallest, hn::Abs(most));
    hn::StoreU(most, kTag, results + k);
    hn::StoreU(hn::IfThenElseZero(hn::And(normal, hn::Eq(most, least)), hn::Set(kTag, 1)), kTag, decided + k);
  }
}

}  // namespace evalcts::reference::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace evalcts::reference {

HWY_EXPORT(enclose);
HWY_EXPORT(round_to_float);
HWY_EXPORT(round_to_double);

void enclose_kernel(const KernelPlan& plan, const double* u, const double* v, std::size_t count,
                    const EnclosureArrays& results) {
  HWY_DYNAMIC_DISPATCH(enclose)(plan, u, v, count, results);
}

void to_float_kernel(const EnclosureArrays& enclosures, double scale, std::size_t count, float* results,
                     double* decided) {
  HWY_DYNAMIC_DISPATCH(round_to_float)(enclosures, scale, count, results, decided);
}

void to_double_kernel(const EnclosureArrays& enclosures, double scale, std::size_t count, double* results,
                      double* decided) {
  HWY_DYNAMIC_DISPATCH(round_to_double)(enclosures, scale, count, results, decided);
}

#ifdef HWY_COMPILE_ONLY_STATIC

std::vector<std::string> filter_targets() { return {hwy::TargetName(HWY_STATIC_TARGET)}; }

void use_filter_target(const std::string& name) {
  if (!name.empty() && name != filter_targets().front())
    throw std::invalid_argument("no such instruction set here: " + name);
}

#else

std::vector<std::string> filter_targets() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    names.emplace_back(hwy::TargetName(target));
  }
  return names;
}

void use_filter_target(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (name.empty()) return;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) return hwy::SetSupportedTargetsForTest(target);
  }
  throw std::invalid_argument("no such instruction set here: " + name);
}

#endif

}  // namespace evalcts::reference
#endif  // HWY_ONCE
