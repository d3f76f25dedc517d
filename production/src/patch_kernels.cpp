// Evaluates patches of low degree, one patch in each lane of a vector, correctly rounded, in powers of x and
// y, the values of t - s in both directions, correctly rounded or with GLEV_FAST. This file is compiled once
// for each instruction set. prepared_map.h derives the bound by which a value is known to be correctly
// rounded.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "exact.h"
#include "instruction_sets.h"
#include "kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/patch_kernels.cpp"
#include <hwy/foreach_target.h>

#include "centred-inl.h"
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
constexpr std::size_t kHalvesOfLanes = kPatchLanes / kLanes;  // vectors that hold one value of each patch

// Returns 2^(bits - exponent) for numbers in [2^(exponent - 1), 2^exponent).
HWY_INLINE Vector scale_by(Vector number, int bits) {
  constexpr hn::RebindToSigned<Doubles> kWords;
  const auto biased = hn::ShiftRight<52>(hn::BitCast(kWords, number));
  return hn::BitCast(kDoubles, hn::ShiftLeft<52>(hn::Sub(hn::Set(kWords, 2045 + bits), biased)));
}
HWY_INLINE hn::Mask<Doubles> is_whole(Vector value) {
  const Vector magic = hn::Set(kDoubles, 0x1.8p52);
  return hn::Eq(hn::Sub(hn::Add(value, magic), magic), value);
}
HWY_INLINE hn::Mask<Doubles> is_zero(Vector value) { return hn::Eq(value, hn::Zero(kDoubles)); }

// One value of each patch.
struct OfPatches {
  HWY_ALIGN double lane[kPatchLanes];
  HWY_INLINE Vector load(std::size_t h) const { return hn::Load(kDoubles, lane + h * kLanes); }
  HWY_INLINE void store(Vector value, std::size_t h) { hn::Store(value, kDoubles, lane + h * kLanes); }
};

// One component of the patches: the coefficients of x^i y^j, and the bound on the error of values. A value is
// correctly rounded if value - error and value + error round to the same float.
struct Component {
  OfPatches power[kMostValues];  // that of x^i y^j has number j * (n + 1) + i
  OfPatches error, line_error;   // line_error: along lines, 0 in patches that Horner's rule does not round

  // `step`: distance between control points, in units of kPatchLanes values. Returns the patches that have
  // bounds, for GLEV_FAST if `fast`.
  template <int kDegree>
  HWY_INLINE hn::Mask<Doubles> set(const double* net, std::size_t step, const PatchBlock& block,
                                   std::size_t h) {
    const int m = block.degree[1];
    const double* const points = net;
    const auto columns = static_cast<std::size_t>(kDegree) + 1, rows = static_cast<std::size_t>(m) + 1;
    Lanes centred[kMostValues];
    Vector largest = hn::Zero(kDoubles);
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t j = 0; j < rows; ++j, net += step * kPatchLanes) {
        // Adding zero turns -0 into +0, so that no sum is -0.
        const Vector point = hn::Add(hn::LoadU(kDoubles, net), hn::Zero(kDoubles));
        centred[j * columns + i].value = point;
        largest = hn::Max(largest, hn::Abs(point));
      }
    }
    for (std::size_t i = 0; i < columns; ++i) centre_along(m, kDegree + 1, &centred[i]);
    for (std::size_t j = 0; j < rows; ++j) centre_along(kDegree, 1, &centred[j * columns]);
    Vector sum = hn::Zero(kDoubles);
    for (std::size_t i = 0; i < columns * rows; ++i) {
      sum = hn::Add(sum, hn::Abs(centred[i].value));
      power[i].store(centred[i].value, h);
    }

    // Computes error_bound(component, centred_units(...), 1) for coefficients that are not exact.
    constexpr double kUnit = 0x1p-53 * (1 + 0x1p-20);
    const double of_sum = centred_units(kDegree, m, 1, true) - centred_units(kDegree, m, 0, true),
                 of_largest = centred_units(kDegree, m, 0, false) + 2;
    Vector bound =
        hn::Mul(hn::MulAdd(sum, hn::Set(kDoubles, of_sum), hn::Mul(largest, hn::Set(kDoubles, of_largest))),
                hn::Set(kDoubles, kUnit));
    // Sums of NaN are NaN, and so is this error.
    const auto is_bounded = hn::And(
        hn::Ge(bound, hn::Set(kDoubles, 0x1p-145)),
        hn::And(hn::Le(largest, hn::Set(kDoubles, 0x1p127)), hn::Le(sum, hn::Set(kDoubles, 0x1p140))));
    const auto is_zero_everywhere = hn::And(is_zero(sum), is_zero(largest));
    bound = hn::IfThenElseZero(is_bounded, bound);
    const auto is_centred = is_centred_exactly(points, step, columns * rows, largest);
    const auto tighten = [&](int bits) HWY_ATTR {
      return hn::IfThenZeroElse(hn::And(is_centred, is_exact(columns * rows, h, sum, bits)), bound);
    };
    line_error.store(block.has_lines ? tighten(bits_along_lines(kDegree, m)) : bound, h);
    error.store(block.bits_of_places < kExactBits ? tighten(block.bits_of_places) : bound, h);
    const auto is_claimed = hn::Or(is_bounded, is_zero_everywhere);
    if (!block.fast) return is_claimed;
    const auto is_moderate = hn::And(hn::Ge(largest, hn::Set(kDoubles, kLeastFast)),
                                     hn::Le(largest, hn::Set(kDoubles, kMostFast)));
    return hn::And(is_claimed, hn::Or(is_moderate, is_zero_everywhere));
  }

 private:
  // Return the lanes in which centring or Horner's rule does not round, as is_centred_exactly() and
  // PreparedMap::centred_bits do for a single map.
  static HWY_INLINE hn::Mask<Doubles> is_centred_exactly(const double* points, std::size_t step,
                                                         std::size_t count, Vector largest) {
    auto is_exact =
        hn::And(hn::Ge(largest, hn::Set(kDoubles, 0x1p-600)), hn::Le(largest, hn::Set(kDoubles, 0x1p120)));
    const Vector scale = scale_by(largest, 45);
    for (std::size_t i = 0; i < count; ++i)
      is_exact =
          hn::And(is_exact, is_whole(hn::Mul(hn::LoadU(kDoubles, points + i * step * kPatchLanes), scale)));
    return is_exact;
  }
  HWY_INLINE hn::Mask<Doubles> is_exact(std::size_t count, std::size_t h, Vector sum,
                                        int bits_of_places) const {
    // the sum may be rounded
    const Vector scale = scale_by(hn::Mul(sum, hn::Set(kDoubles, 1 + 0x1p-40)), kExactBits - bits_of_places);
    auto is_exact = is_whole(hn::Mul(power[0].load(h), scale));
    for (std::size_t i = 1; i < count; ++i)
      is_exact = hn::And(is_exact, is_whole(hn::Mul(power[i].load(h), scale)));
    return is_exact;
  }
};

// The curves of some columns of the patches.
struct PatchCurves {
  const Component* component;
  std::size_t components;
  int n, m;
  bool has_lines;
  const double* x = nullptr;
  std::size_t columns = 0;

  HWY_INLINE void choose(const double* places, std::size_t count) { x = places, columns = count; }

  void compute(bool has_ends, Strip<double>* strip) const {
    static constexpr decltype(&compute_of<1>) kOf[kMaxCentredDegree] = {compute_of<1>, compute_of<2>,
                                                                        compute_of<3>};
    kOf[n - 1](*this, has_ends, strip);
  }
  // Evaluates the row at y as a curve in x, correctly rounded. resolve(position) returns a value that its
  // interval does not decide.
  template <class Resolver>
  void round_row(double y, float* to, const Resolver& resolve) const {
    static constexpr decltype(&round_row_of<1, Resolver>) kOf[kMaxCentredDegree] = {
        round_row_of<1, Resolver>, round_row_of<2, Resolver>, round_row_of<3, Resolver>};
    kOf[n - 1](*this, y, to, resolve);
  }

 private:
  // The curves are passed by value, so that the compiler keeps their members in registers between stores.
  template <int kDegree>
  static void compute_of(PatchCurves curves, bool has_ends, Strip<double>* strip) {
    for (std::size_t k = 0; k < curves.components; ++k) {
      const Component& own = curves.component[k];
      for (int j = 0; j <= curves.m; ++j)
        curves.compute_power<kDegree>(own.power + j * (kDegree + 1), j, k, strip);
      if (has_ends) curves.set_ends(own, k, strip);
    }
  }

  template <int kDegree, class Resolver>
  static void round_row_of(PatchCurves curves, double y_of_row, float* to, const Resolver& resolve) {
    const int m = curves.m;
    const Vector y = hn::Set(kDoubles, y_of_row);
    for (std::size_t k = 0; k < curves.components; ++k) {
      const Component& own = curves.component[k];
      for (std::size_t h = 0; h < kHalvesOfLanes; ++h) {
        Vector row[kDegree + 1], error[2] = {own.error.load(h), own.error.load(h)};  // second: on lines
        auto is_constant = is_zero(hn::Zero(kDoubles));
        for (int i = kDegree; i >= 0; --i) {
          row[i] = own.power[m * (kDegree + 1) + i].load(h);
          for (int j = m - 1; j >= 0; --j)
            row[i] = hn::MulAdd(row[i], y, own.power[j * (kDegree + 1) + i].load(h));
          if (i > 0) is_constant = hn::And(is_constant, is_zero(row[i]));
        }
        if (is_line(y_of_row)) {
          error[0] = hn::IfThenElse(is_constant, own.line_error.load(h), error[0]);
          if (curves.has_lines) error[1] = own.line_error.load(h);
        }
        for (std::size_t c = 0; c < curves.columns; ++c) {
          const Vector place = hn::Set(kDoubles, curves.x[c]),
                       own_error = error[is_line(curves.x[c]) ? 1 : 0];
          Vector sum = row[kDegree];
          for (int i = kDegree - 1; i >= 0; --i) sum = hn::MulAdd(sum, place, row[i]);
          const Half low = hn::DemoteTo(kHalves, hn::Sub(sum, own_error)),
                     high = hn::DemoteTo(kHalves, hn::Add(sum, own_error));
          const std::size_t p = curves.position(c, k, h);
          hn::Store(high, kHalves, to + p);
          const Half bits = hn::Xor(low, high);
          if (HWY_UNLIKELY(!are_zero(bits))) resolve_lanes(bits, p, p + kLanes, to, resolve);
        }
      }
    }
  }

  std::size_t position(std::size_t column, std::size_t k, std::size_t h) const {
    return (column * components + k) * kPatchLanes + h * kLanes;
  }

  template <int kDegree>
  HWY_INLINE void compute_power(const OfPatches* coefficient, int j, std::size_t k,
                                Strip<double>* strip) const {
    for (std::size_t h = 0; h < kHalvesOfLanes; ++h) {
      Vector own[kDegree + 1];
      for (int i = 0; i <= kDegree; ++i) own[i] = coefficient[i].load(h);
      for (std::size_t c = 0; c < columns; ++c) {
        const Vector place = hn::Set(kDoubles, x[c]);
        Vector sum = own[kDegree];
        for (int i = kDegree - 1; i >= 0; --i) sum = hn::MulAdd(sum, place, own[i]);
        hn::Store(sum, kDoubles, strip->power[j] + position(c, k, h));
      }
    }
  }

  // Computes the ends of intervals around the coefficients of y^0. Curves that are constant along a line have
  // the tighter error.
  HWY_INLINE void set_ends(const Component& own, std::size_t k, Strip<double>* strip) const {
    for (std::size_t c = 0; c < columns; ++c) {
      const bool is_on_line = has_lines && is_line(x[c]);
      for (std::size_t h = 0; h < kHalvesOfLanes; ++h) {
        const std::size_t p = position(c, k, h);
        const Vector value = hn::Load(kDoubles, strip->power[0] + p);
        Vector error = own.error.load(h);
        if (is_on_line) {
          auto is_constant = is_zero(hn::Zero(kDoubles));
          for (int j = 1; j <= m; ++j)
            is_constant = hn::And(is_constant, is_zero(hn::Load(kDoubles, strip->power[j] + p)));
          error = hn::IfThenElse(is_constant, own.line_error.load(h), error);
        }
        hn::Store(hn::Sub(value, error), kDoubles, strip->low + p);
        hn::Store(hn::Add(value, error), kDoubles, strip->high + p);
      }
    }
  }
};

// Transposes a block of kBlock vectors.
#if HWY_TARGET != HWY_SCALAR
constexpr hn::CappedTag<float, kPatchLanes> kBlockTag;
constexpr std::size_t kBlock = hn::MaxLanes(kBlockTag);
using Block = hn::Vec<decltype(kBlockTag)>;
HWY_INLINE void transpose(Block (&block)[kBlock]) {
  constexpr hn::Repartition<double, decltype(kBlockTag)> kPairs;
  Block half[kBlock], whole[kBlock];
  // Transposes blocks of four by four.
  for (std::size_t i = 0; i < kBlock; i += 2) {
    half[i] = hn::InterleaveLower(kBlockTag, block[i], block[i + 1]);
    half[i + 1] = hn::InterleaveUpper(kBlockTag, block[i], block[i + 1]);
  }
  for (std::size_t i = 0; i < kBlock; i += 4) {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto a = hn::BitCast(kPairs, half[i + k]), b = hn::BitCast(kPairs, half[i + k + 2]);
      whole[i + 2 * k] = hn::BitCast(kBlockTag, hn::InterleaveLower(kPairs, a, b));
      whole[i + 2 * k + 1] = hn::BitCast(kBlockTag, hn::InterleaveUpper(kPairs, a, b));
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if constexpr (kBlock == 4) {
      block[i] = whole[i];
    } else {
      block[i] = hn::ConcatLowerLower(kBlockTag, whole[i + 4], whole[i]);
      block[i + 4] = hn::ConcatUpperUpper(kBlockTag, whole[i + 4], whole[i]);
    }
  }
}
#endif

// Writes `count` values of each patch to to[patch], which need not be aligned.
HWY_INLINE void transpose_all(const float* values, std::size_t count, float* const* to) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + kBlock <= count; i += kBlock) {
    for (std::size_t first = 0; first < kPatchLanes; first += kBlock) {
      Block block[kBlock];
      for (std::size_t j = 0; j < kBlock; ++j)
        block[j] = hn::LoadU(kBlockTag, values + (i + j) * kPatchLanes + first);
      transpose(block);
      for (std::size_t p = 0; p < kBlock; ++p) hn::StoreU(block[p], kBlockTag, to[first + p] + i);
    }
  }
#endif
  for (; i < count; ++i) {
    for (std::size_t p = 0; p < kPatchLanes; ++p)
      std::memcpy(to[p] + i, values + i * kPatchLanes + p, sizeof(float));
  }
}

// Writes the control points as doubles: see Kernels::load_patches.
void load(const float* const* points, std::size_t count, double* net) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + kBlock <= count; i += kBlock) {
    for (std::size_t first = 0; first < kPatchLanes; first += kBlock) {
      Block block[kBlock];
      for (std::size_t p = 0; p < kBlock; ++p) block[p] = hn::LoadU(kBlockTag, points[first + p] + i);
      transpose(block);
      for (std::size_t j = 0; j < kBlock; ++j) {
        HWY_ALIGN float values[kBlock];
        hn::Store(block[j], kBlockTag, values);
        for (std::size_t p = 0; p < kBlock; p += kLanes)
          hn::StoreU(hn::PromoteTo(kDoubles, hn::Load(kHalves, values + p)), kDoubles,
                     net + (i + j) * kPatchLanes + first + p);
      }
    }
  }
#endif
  for (; i < count; ++i) {
    for (std::size_t p = 0; p < kPatchLanes; ++p) {
      float value;
      std::memcpy(&value, points[p] + i, sizeof value);
      net[i * kPatchLanes + p] = value;
    }
  }
}

// Collects rows of a strip, and writes them to the patches.
class PatchSink {
 public:
  // `left`: patches that are not evaluated, as bits.
  PatchSink(const PatchBlock& block, unsigned patches_left)
      : left(patches_left), block_(block), components_(static_cast<std::size_t>(block.components)) {
    const Destination& to = block.to;
    is_packed_ = to.components == block.components && to.stride == components_ * sizeof(float);
  }

  // Chooses the columns on the boundary, whose values are kept for set_columns().
  void start_edges(std::size_t first_row) { first_row_ = first_row, is_on_edges_ = true; }
  void start(std::size_t first_row, std::size_t first_column, std::size_t columns) {
    first_row_ = first_row, first_column_ = first_column, columns_ = columns, is_on_edges_ = false;
    first_ = count_ = 0;
  }
  HWY_INLINE void begin(std::size_t r, std::size_t rows, float** row) {
    if (is_on_edges_) {
      for (std::size_t i = 0; i < rows; ++i) row[i] = edges_[r + i];
      return;
    }
    if ((count_ + rows) * row_values() > kMostValues) flush();
    for (std::size_t i = 0; i < rows; ++i) row[i] = values_ + (count_ + i) * row_values();
    if (count_ == 0) first_ = r;
    count_ += rows;
  }
  void end(std::size_t, const float*) const {}
  HWY_INLINE void set_columns(std::size_t r, float* row) const {
    const std::size_t width = components_ * kPatchLanes;
    if (first_column_ == 0) std::copy_n(edges_[r], width, row);
    if (first_column_ + columns_ == block_.columns)
      std::copy_n(edges_[r] + width, width, row + (columns_ - 1) * width);
  }
  // Rounds a value exactly. A patch with many undecided values is left, because a plan has faster methods.
  float resolve(std::size_t r, std::size_t position) {
    const std::size_t patch = position % kPatchLanes, value = position / kPatchLanes;
    if ((left >> patch & 1) != 0) return 0;
    if (block_.range == nullptr || resolved_[patch]++ == kMostResolved) {
      left |= 1U << patch;
      return 0;
    }
    const std::size_t own = value / components_,
                      column = is_on_edges_ ? own * (block_.columns - 1) : first_column_ + own;
    const auto [n, m] = block_.degree;
    const glev::Component component = {block_.net + value % components_ * kPatchLanes + patch,
                                       static_cast<std::ptrdiff_t>(components_ * kPatchLanes),
                                       {n + 1, m + 1},
                                       block_.domain};
    return round_exactly(component, block_.range->u_of(column), block_.range->v_of(first_row_ + r));
  }

  HWY_INLINE void flush() {
    const Destination& to = block_.to;
    const bool joins_rows = is_packed_ && to.row_stride == columns_ * to.stride;
    const std::size_t parts = joins_rows ? 1 : count_, elements = joins_rows ? count_ * columns_ : columns_;
    for (std::size_t part = 0; part < parts; ++part) {
      std::byte* const data =
          to.data + (first_row_ + first_ + part) * to.row_stride + first_column_ * to.stride;
      float* at[kPatchLanes];
      for (std::size_t p = 0; p < kPatchLanes; ++p) {
        const bool is_direct = is_packed_ && p < block_.patches;
        at[p] = is_direct ? reinterpret_cast<float*>(data + p * block_.patch_stride) : packed_[p];
      }
      transpose_all(values_ + part * row_values(), elements * components_, at);
      for (std::size_t p = 0; p < block_.patches && !is_packed_; ++p)
        scatter(components_, packed_[p], elements, to, data + p * block_.patch_stride);
    }
    count_ = 0;
  }

  unsigned left;

 private:
  static constexpr std::size_t kMostValues = 4 * kMostPositions;
  static constexpr int kMostResolved = 6;
  std::size_t row_values() const { return columns_ * components_ * kPatchLanes; }

  const PatchBlock& block_;
  std::size_t components_;
  bool is_packed_, is_on_edges_ = false;
  std::size_t first_row_ = 0, first_column_ = 0, columns_ = 0;
  std::size_t first_ = 0, count_ = 0;  // rows that are not yet written
  std::array<int, kPatchLanes> resolved_{};
  HWY_ALIGN float values_[kMostValues + kFewestPositions];
  HWY_ALIGN float edges_[Rows::kMost][2 * 4 * kPatchLanes];  // of the first and the last column
  HWY_ALIGN float packed_[kPatchLanes][kMostValues / kPatchLanes];
};

// Sets the components. Returns the patches without bounds as bits.
template <int kDegree>
unsigned set_components(const PatchBlock& block, Component* component, bool* is_exact) {
  const auto components = static_cast<std::size_t>(block.components);
  unsigned left = 0;
  bool exact = true;
  for (std::size_t h = 0; h < kHalvesOfLanes; ++h) {
    auto is_claimed = is_zero(hn::Zero(kDoubles));
    for (std::size_t k = 0; k < components; ++k) {
      const double* const net = block.net + k * kPatchLanes + h * kLanes;
      is_claimed = hn::And(is_claimed, component[k].set<kDegree>(net, components, block, h));
      exact = exact && hn::AllTrue(kDoubles, is_zero(component[k].error.load(h)));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kDoubles, hn::Not(is_claimed), bits);
    left |= static_cast<unsigned>(bits[0]) << (h * kLanes);
  }
  *is_exact = exact;
  return left;
}

// Evaluates patches. Returns those that are not evaluated, as bits.
unsigned evaluate(const PatchBlock& block) {
  const auto components = static_cast<std::size_t>(block.components);
  const auto [n, m] = block.degree;
  static constexpr decltype(&set_components<1>) kSet[kMaxCentredDegree] = {
      set_components<1>, set_components<2>, set_components<3>};
  Component component[4];
  bool is_exact;
  const unsigned left = kSet[n - 1](block, component, &is_exact);
  const Method method = block.fast ? Method::kFast : is_exact ? Method::kExact : Method::kIntervals;
  const std::size_t most_columns = kMostPositions / (components * kPatchLanes), last = block.columns - 1;
  PatchCurves curves = {component, components, n, m, block.has_lines};
  const double ends[2] = {block.x[0], block.x[last]};
  PatchSink sink(block, left | ~((1U << block.patches) - 1));
  Rows rows;
  const auto evaluate_chosen = [&](Method own) {
    evaluate_strip(curves, own, block.degree[1], rows, curves.columns * components * kPatchLanes, sink);
  };
  for (std::size_t r0 = 0; r0 < block.rows; r0 += Rows::kMost) {
    rows.count = std::min(Rows::kMost, block.rows - r0);
    std::copy_n(block.y + r0, rows.count, rows.y);
    rows.own.count = 0;
    if (block.has_lines && !is_exact && m > 0)
      rows.own.find(block.range->v, static_cast<std::int64_t>(r0), rows.count);
    if (block.fast) {
      curves.choose(ends, 2);
      sink.start_edges(r0);
      evaluate_chosen(Method::kIntervals);
      rows.choose_ends(r0 == 0, r0 + rows.count == block.rows);
    }
    for (std::size_t c0 = 0; c0 < block.columns; c0 += most_columns) {
      curves.choose(block.x + c0, std::min(most_columns, block.columns - c0));
      sink.start(r0, c0, curves.columns);
      evaluate_chosen(method);
      sink.flush();
    }
  }
  return sink.left & ((1U << block.patches) - 1);
}

}  // namespace patches
}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
