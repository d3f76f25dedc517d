// Evaluates patches of low degree, one patch in each lane of a vector, correctly rounded, in powers of x and
// y, the values of t - s in both directions. This file is compiled once for each instruction set.
// prepared_map.h derives the bound by which a value is known to be correctly rounded.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "instruction_sets.h"
#include "kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/patch_kernels.cpp"
#include <hwy/foreach_target.h>

#include "vectors-inl.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {
namespace patches {

#include "centring-inl.h"

// A vector with the operations that centre_along() needs.
struct Lanes {
  Vector value;

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return {hn::Add(a.value, b.value)}; }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return {hn::Sub(a.value, b.value)}; }
  friend HWY_INLINE Lanes operator*(Lanes a, double factor) {
    return {hn::Mul(a.value, hn::Set(kDoubles, factor))};
  }
};

constexpr int kMostValues = (kMaxCentredDegree + 1) * (kMaxCentredDegree + 1);

// One component of the patches in the lanes of a vector: the coefficients of x^i y^j, and the bound on the
// error of values. A value is correctly rounded if value - error and value + error round to the same float.
template <int kDegree>
class Component {
 public:
  // `step`: distance between control points, in units of kPatchLanes values.
  HWY_INLINE void set(const double* net, std::size_t step, int m, int bits_of_places) {
    degree_v_ = m;
    const double* const points = net;
    const auto columns = static_cast<std::size_t>(kDegree) + 1, rows = static_cast<std::size_t>(m) + 1;
    Vector largest = hn::Zero(kDoubles);
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t j = 0; j < rows; ++j, net += step * kPatchLanes) {
        // Adding zero turns -0 into +0, so that no sum is -0.
        const Vector point = hn::Add(hn::LoadU(kDoubles, net), hn::Zero(kDoubles));
        power_[j * columns + i].value = point;
        largest = hn::Max(largest, hn::Abs(point));
      }
    }
    for (std::size_t i = 0; i < columns; ++i) centre_along(m, kDegree + 1, &power_[i]);
    for (std::size_t j = 0; j < rows; ++j) centre_along(kDegree, 1, &power_[j * columns]);
    Vector sum = hn::Zero(kDoubles);
    for (std::size_t i = 0; i < columns * rows; ++i) sum = hn::Add(sum, hn::Abs(power_[i].value));

    // Computes error_bound(component, centred_units(...), 1) for coefficients that are not exact.
    constexpr double kUnit = 0x1p-53 * (1 + 0x1p-20);
    const double of_sum = centred_units(kDegree, m, 1, true) - centred_units(kDegree, m, 0, true),
                 of_largest = centred_units(kDegree, m, 0, false) + 2;
    const Vector error =
        hn::Mul(hn::MulAdd(sum, hn::Set(kDoubles, of_sum), hn::Mul(largest, hn::Set(kDoubles, of_largest))),
                hn::Set(kDoubles, kUnit));
    // Sums of NaN are NaN, and so is this error.
    const auto is_bounded = hn::And(
        hn::Ge(error, hn::Set(kDoubles, 0x1p-145)),
        hn::And(hn::Le(largest, hn::Set(kDoubles, 0x1p127)), hn::Le(sum, hn::Set(kDoubles, 0x1p140))));
    const Vector zero = hn::Zero(kDoubles);
    error_ = hn::IfThenElseZero(is_bounded, error);
    is_claimed_ = hn::Or(is_bounded, hn::And(hn::Eq(sum, zero), hn::Eq(largest, zero)));
    if (bits_of_places < kExactBits)
      error_ = hn::IfThenZeroElse(is_exact(points, step, largest, sum, bits_of_places), error_);
  }

  hn::Mask<Doubles> is_claimed() const { return is_claimed_; }

  // Evaluates one row: both ends of each interval, as floats. Returns the bits in which the ends differ.
  HWY_INLINE Half evaluate(double y_of_row, const double* x, std::size_t columns, std::size_t step,
                           float* to) const {
    const Vector y = hn::Set(kDoubles, y_of_row);
    Vector row[kDegree + 1];
    for (int i = 0; i <= kDegree; ++i) {
      Vector sum = power_[degree_v_ * (kDegree + 1) + i].value;
      for (int j = degree_v_ - 1; j >= 0; --j) sum = hn::MulAdd(sum, y, power_[j * (kDegree + 1) + i].value);
      row[i] = sum;
    }
    const Vector first = hn::Sub(row[0], error_), last = hn::Add(row[0], error_);
    Half open = hn::Zero(kHalves);
    for (std::size_t c = 0; c < columns; ++c, to += step) {
      const Vector place = hn::Set(kDoubles, x[c]);
      Vector sum = row[kDegree];
      for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, place, row[i]);
      const Half low = hn::DemoteTo(kHalves, hn::MulAdd(sum, place, first)),
                 high = hn::DemoteTo(kHalves, hn::MulAdd(sum, place, last));
      open = hn::Or(open, hn::Xor(low, high));
      hn::StoreU(high, kHalves, to);
    }
    return open;
  }

 private:
  // Returns 2^(bits - exponent) for numbers in [2^(exponent - 1), 2^exponent).
  static HWY_INLINE Vector scale_by(Vector number, int bits) {
    constexpr hn::RebindToSigned<Doubles> kWords;
    const auto biased = hn::ShiftRight<52>(hn::BitCast(kWords, number));
    return hn::BitCast(kDoubles, hn::ShiftLeft<52>(hn::Sub(hn::Set(kWords, 2045 + bits), biased)));
  }
  static HWY_INLINE hn::Mask<Doubles> is_whole(Vector value) {
    const Vector magic = hn::Set(kDoubles, 0x1.8p52);
    return hn::Eq(hn::Sub(hn::Add(value, magic), magic), value);
  }

  // Returns the lanes in which neither centring nor Horner's rule rounds, as is_centred_exactly() and
  // PreparedMap::centred_bits do for a single map.
  HWY_INLINE hn::Mask<Doubles> is_exact(const double* points, std::size_t step, Vector largest, Vector sum,
                                        int bits_of_places) const {
    const std::size_t count = static_cast<std::size_t>(kDegree + 1) * static_cast<std::size_t>(degree_v_ + 1);
    auto is_exact =
        hn::And(hn::Ge(largest, hn::Set(kDoubles, 0x1p-600)), hn::Le(largest, hn::Set(kDoubles, 0x1p120)));
    const Vector of_points = scale_by(largest, 45),
                 // the sum may be rounded
        of_powers = scale_by(hn::Mul(sum, hn::Set(kDoubles, 1 + 0x1p-40)), kExactBits - bits_of_places);
    for (std::size_t i = 0; i < count; ++i) {
      const Vector point = hn::LoadU(kDoubles, points + i * step * kPatchLanes);
      is_exact = hn::And(is_exact, hn::And(is_whole(hn::Mul(point, of_points)),
                                           is_whole(hn::Mul(power_[i].value, of_powers))));
    }
    return is_exact;
  }

  int degree_v_;
  Lanes power_[kMostValues];
  Vector error_;
  hn::Mask<Doubles> is_claimed_;
};

// Transposes kLanes vectors of one value of all lanes into kLanes vectors of one lane each.
#if HWY_TARGET != HWY_SCALAR
template <std::size_t kLanes>
HWY_INLINE void transpose(const float* from, float* const* to) {
  if constexpr (kLanes >= 4) {
    constexpr hn::Repartition<double, decltype(kHalves)> kPairs;
    Half in[kLanes], half[kLanes], whole[kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) in[i] = hn::LoadU(kHalves, from + i * kLanes);
    // Transposes blocks of four lanes and four values.
    for (std::size_t i = 0; i < kLanes; i += 2) {
      half[i] = hn::InterleaveLower(kHalves, in[i], in[i + 1]);
      half[i + 1] = hn::InterleaveUpper(kHalves, in[i], in[i + 1]);
    }
    for (std::size_t i = 0; i < kLanes; i += 4) {
      for (std::size_t k = 0; k < 2; ++k) {
        const auto a = hn::BitCast(kPairs, half[i + k]), b = hn::BitCast(kPairs, half[i + k + 2]);
        whole[i + 2 * k] = hn::BitCast(kHalves, hn::InterleaveLower(kPairs, a, b));
        whole[i + 2 * k + 1] = hn::BitCast(kHalves, hn::InterleaveUpper(kPairs, a, b));
      }
    }
    if constexpr (kLanes == 4) {
      for (std::size_t lane = 0; lane < 4; ++lane) hn::StoreU(whole[lane], kHalves, to[lane]);
    } else {
      for (std::size_t lane = 0; lane < 4; ++lane) {
        hn::StoreU(hn::ConcatLowerLower(kHalves, whole[lane + 4], whole[lane]), kHalves, to[lane]);
        hn::StoreU(hn::ConcatUpperUpper(kHalves, whole[lane + 4], whole[lane]), kHalves, to[lane + 4]);
      }
    }
  }
}

#endif

// Writes `count` values of each lane to to[lane].
HWY_INLINE void transpose_all(const float* values, std::size_t count, float* const* to) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes >= 4) {
    for (; i + kLanes <= count; i += kLanes) {
      float* at[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) at[lane] = to[lane] + i;
      transpose<kLanes>(values + i * kLanes, at);
    }
  }
#endif
  for (; i < count; ++i) {
    // The memory of the caller need not be aligned.
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      std::memcpy(to[lane] + i, values + i * kLanes + lane, sizeof(float));
  }
}

template <int kComponents>
void write_elements(const float* values, std::size_t count, const Destination& to, std::byte* data) {
  scatter<kComponents>(values, count, to, data);
}

// Evaluates the patches of one vector, from patch `first` on. Returns the undecided patches as bits.
template <int kDegree>
unsigned evaluate_lanes(const PatchBlock& block, std::size_t first) {
  constexpr std::size_t kStrip = 512;  // values of each lane that fit into the L1 cache
  constexpr decltype(&write_elements<1>) kWrite[] = {write_elements<1>, write_elements<2>, write_elements<3>,
                                                     write_elements<4>};
  const auto components = static_cast<std::size_t>(block.components);
  HWY_ALIGN float values[kStrip * kLanes];
  HWY_ALIGN float packed[kLanes][kStrip];
  Component<kDegree> component[4];
  auto is_claimed = hn::Eq(hn::Zero(kDoubles), hn::Zero(kDoubles));
  for (std::size_t k = 0; k < components; ++k) {
    component[k].set(block.net + k * kPatchLanes + first, components, block.degree[1], block.bits_of_places);
    is_claimed = hn::And(is_claimed, component[k].is_claimed());
  }
  const std::size_t lanes = block.patches - first < kLanes ? block.patches - first : kLanes;
  const Destination& to = block.to;
  const bool is_packed = to.components == block.components && to.stride == components * sizeof(float);
  const bool joins_rows = is_packed && to.row_stride == block.columns * to.stride;
  const std::size_t most_columns = kStrip / components,
                    strip_columns = block.columns < most_columns ? block.columns : most_columns,
                    strip_rows =
                        joins_rows && strip_columns == block.columns ? most_columns / strip_columns : 1;
  Half open = hn::Zero(kHalves);
  for (std::size_t r0 = 0; r0 < block.rows; r0 += strip_rows) {
    const std::size_t rows = block.rows - r0 < strip_rows ? block.rows - r0 : strip_rows;
    for (std::size_t c0 = 0; c0 < block.columns; c0 += strip_columns) {
      const std::size_t columns = block.columns - c0 < strip_columns ? block.columns - c0 : strip_columns;
      for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t k = 0; k < components; ++k) {
          open =
              hn::Or(open, component[k].evaluate(block.y[r0 + r], block.x + c0, columns, components * kLanes,
                                                 values + (r * columns * components + k) * kLanes));
        }
      }
      const std::size_t elements = rows * columns;
      std::byte* const data = to.data + r0 * to.row_stride + c0 * to.stride;
      float* at[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const bool is_direct = is_packed && lane < lanes;
        at[lane] =
            is_direct ? reinterpret_cast<float*>(data + (first + lane) * block.patch_stride) : packed[lane];
      }
      transpose_all(values, elements * components, at);
      for (std::size_t lane = 0; lane < lanes && !is_packed; ++lane)
        kWrite[components - 1](packed[lane], elements, to, data + (first + lane) * block.patch_stride);
    }
  }
  std::uint32_t differs[kLanes];
  double claimed[kLanes];
  hn::StoreU(hn::BitCast(hn::RebindToUnsigned<decltype(kHalves)>(), open),
             hn::RebindToUnsigned<decltype(kHalves)>(), differs);
  hn::StoreU(hn::IfThenElseZero(is_claimed, hn::Set(kDoubles, 1)), kDoubles, claimed);
  unsigned undecided = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    undecided |= static_cast<unsigned>(differs[lane] != 0 || claimed[lane] == 0) << (first + lane);
  return undecided;
}

}  // namespace patches

unsigned evaluate_patches(const PatchBlock& block) {
  constexpr decltype(&patches::evaluate_lanes<1>) kOf[kMaxCentredDegree] = {
      patches::evaluate_lanes<1>, patches::evaluate_lanes<2>, patches::evaluate_lanes<3>};
  unsigned undecided = 0;
  for (std::size_t first = 0; first < block.patches; first += kLanes)
    undecided |= kOf[block.degree[0] - 1](block, first);
  return undecided;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
