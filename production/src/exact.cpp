// Exact evaluation in integers. With t = a / (a + b) for integers a and b, V (a_u + b_u)^n (a_v + b_v)^m is
//   sum of C(n, i) a_u^i b_u^(n - i) sum of C(m, j) a_v^j b_v^(m - j) R_ij,
// an integer times the power of two that divides all control points. The sums are computed by Horner's rule
// from the last point,
//   sum = sum * a + C R_i * b^(n - i),
// with a running power of b, modulo a power of two that is large enough for the result. Therefore
// intermediate values need no bounds, and subtractions no signs.
//
// The control points of a derivative are sums of up to four control points, times an integer, over powers of
// the widths of the domain.
#include "exact.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "binomials.h"
#include "mutation_point.h"
#include "quotient.h"
#include "ratio.h"

namespace glev {
namespace {

// The quantities of the sum in one direction.
struct Direction {
  int degree = 0;
  std::ptrdiff_t step = 0;  // from a control point to the next
  const RatioPart* a = nullptr;
  const RatioPart* b = nullptr;
  IntegerPower whole = {nullptr, 0, 0};  // (a + b)^degree
  int bits = 0;                          // |a| + |b| <= 2^bits

  int binomial_bits() const { return bit_width(binomial_row(degree)[degree / 2]); }
};

// Each control point of the net of a derivative is a sum of terms: the points at these distances, times
// 1 << shift, with a sign.
struct Differences {
  struct Term {
    std::ptrdiff_t distance = 0;
    bool is_negative = false;
    int shift = 0;
  };
  std::array<Term, 4> terms;
  int count = 1;

  // Takes differences of points that are `step` apart.
  void add_direction(int order, std::ptrdiff_t step) {
    if (order == 2 && count == 1) {
      terms = {{{0, false, 0}, {step, true, 1}, {2 * step, false, 0}}};
      count = 3;
      return;
    }
    for (int k = 0; order == 1 && k < count; ++k) {
      terms[count + k] = {terms[k].distance + step, terms[k].is_negative, 0};
      terms[k].is_negative = !terms[k].is_negative;
    }
    if (order == 1) count *= 2;
  }
};

// A power of the width of a domain, for derivatives: +-power * 2^exponent.
struct WidthPower {
  WidthPower(const Domain& domain, int order) {
    if (order == 0) return;
    exponent = order * to_width(domain, width);
    power = {width.limbs.data(), width.size, order};
    is_negative = GLEV_AT(derivative_is_negative, width.negative && order % 2 != 0);
  }
  WidthPower(const WidthPower&) = delete;
  WidthPower& operator=(const WidthPower&) = delete;
  int bits() const { return power.exponent * (power.exponent == 0 ? 0 : bit_width(power.base, power.size)); }

  RatioPart width;
  IntegerPower power = {nullptr, 0, 0};
  int exponent = 0;
  bool is_negative = false;
};

struct Net {
  const double* points;
  const Direction &outer, &inner;
  const Differences& differences;
  Limb factor;  // of the control points
  std::array<const WidthPower*, 2> widths;
  int low = 0, bits = 0;  // each R is a multiple of 2^low, |R| < 2^(low + bits)

  // Return the numbers of bits of the inner sums and of the whole sum, in two's complement.
  int row_bits() const { return bits + inner.degree * inner.bits + 1; }
  int all_bits() const { return row_bits() + GLEV_AT(outer_degree, outer.degree) * outer.bits; }

  Denominator denominator() const {
    return {&outer.whole, &inner.whole, &widths[0]->power, &widths[1]->power};
  }

  // Calls function(decoded) for the terms of a control point that are not zero.
  template <class Function>
  void for_each_term(const double* point, const Function& function) const {
    for (int k = 0; k < differences.count; ++k) {
      const Differences::Term& term = differences.terms[k];
      Decoded decoded = decode(point[term.distance]);
      if (decoded.mantissa == 0) continue;
      decoded.exponent += term.shift;
      decoded.negative = decoded.negative != term.is_negative;
      function(decoded);
    }
  }
};

// Returns ceil(log2(|a| + |b|)), or at most one more if the signs of a and b differ.
int bits_of_sum(const Ratio& ratio) {
  const auto bits = [](const RatioPart& part) { return bit_width(part.limbs.data(), part.size); };
  if (ratio.a.negative || ratio.b.negative) return std::max(bits(ratio.a), bits(ratio.b)) + 1;
  const int whole = bits(ratio.whole);
  return GLEV_AT(bits_of_sum, whole - (trailing_zeros(ratio.whole.limbs.data()) == whole - 1 ? 1 : 0));
}

// Sets up one direction. If the argument is at an end of the domain, the direction keeps degree 0 and
// `points` is moved to the control points of that end.
void set_direction(int order, std::ptrdiff_t step, const Domain& domain, const GridArgument& argument,
                   const double*& points, Ratio& ratio, Direction& direction) {
  if (order == 1) return;
  const int degree = order - 1;
  const Parameter::End end = to_ratio(domain, argument, ratio);
  if (GLEV_AT(is_last_end, end == Parameter::End::kLast)) points += degree * step;
  if (end != Parameter::End::kNeither) return;
  direction.degree = direction.whole.exponent = degree;
  direction.whole.base = ratio.whole.limbs.data();
  direction.whole.size = ratio.whole.size;
  direction.bits = bits_of_sum(ratio);
  direction.step = step;
  direction.a = &ratio.a;
  direction.b = &ratio.b;
  const auto width = [](const RatioPart& part) { return bit_width(part.limbs.data(), part.size); };
  if (width(ratio.b) <= width(ratio.a)) return;
  // Control points are traversed backwards, because the running power is that of b.
  points += degree * step;
  direction.step = -step;
  std::swap(direction.a, direction.b);
}

// Sums of up to four terms need two more bits.
constexpr int kTermBits = 2;

// Sets the range of the control points. Returns false if all of them are zero.
bool find_range(Net& net) {
  int low = 1024, high = -1075;
  for (int i = 0; i <= net.outer.degree; ++i) {
    const double* point = net.points + i * net.outer.step;
    for (int j = 0; j <= net.inner.degree; ++j, point += net.inner.step) {
      net.for_each_term(point, [&](const Decoded& decoded) {
        low = std::min(low, decoded.exponent);
        high = std::max(high, decoded.exponent + bit_width(decoded.mantissa));
      });
    }
  }
  net.low = low;
  net.bits = GLEV_AT(bits_of_net, high - low);
  if (net.differences.count > 1) net.bits += kTermBits + bit_width(net.factor);
  return high >= low;
}

// ---- In an integer of 64 or 128 bits

template <class Integer>
Integer signed_narrow(const RatioPart& part) {
  Integer magnitude = part.limbs[0];
  if (sizeof(Integer) > sizeof(Limb) && part.size > 1)
    magnitude = static_cast<Integer>(Limb2{part.limbs[1]} << kLimbBits | part.limbs[0]);
  return part.negative ? 0 - magnitude : magnitude;
}

// Returns the sum by Horner's rule; term(i) is called for i from degree to 0.
template <class Integer, class Term>
Integer horner_narrow(const Direction& direction, const Term& term) {
  if (direction.degree == 0) return term(0);
  const std::uint64_t* const binomials = binomial_row(direction.degree);
  const auto a = signed_narrow<Integer>(*direction.a), b = signed_narrow<Integer>(*direction.b);
  Integer sum = term(direction.degree), power = b;
  for (int i = direction.degree - 1;; --i) {
    sum = sum * a + term(i) * binomials[i] * power;
    if (i == 0) return sum;
    power *= GLEV_AT(next_factor, b);
  }
}

template <class Integer>
Integer sum_narrow(const Net& net) {
  return horner_narrow<Integer>(net.outer, [&net](int i) {
    const double* const row = net.points + i * net.outer.step;
    return horner_narrow<Integer>(net.inner, [&net, row](int j) {
      Integer sum = 0;
      net.for_each_term(row + j * net.inner.step, [&](const Decoded& decoded) {
        const Integer magnitude = Integer{decoded.mantissa} << (decoded.exponent - net.low);
        sum += decoded.negative ? 0 - magnitude : magnitude;
      });
      return sum;
    });
  });
}

// ---- In limbs

// Computes sum += +-power * term * 2^(64 * position), modulo 2^(64 * size).
void add_term(Limb* sum, int size, const Limb* power, int power_size, Limb term, int position,
              bool negative) {
  if (term == 0 || position >= size) return;
  if (negative) {
    GLEV_AT(subtract_term, subtract_product(sum + position, size - position, power, power_size, term));
  } else {
    add_product(sum + position, size - position, power, power_size, term);
  }
}

// The running power of b.
struct RunningPower {
  explicit RunningPower(Limb* room) : limbs(room), size(1) { limbs[0] = 1; }
  void operator*=(const RatioPart& b) { size = multiply_and_grow(limbs, size, b.limbs.data(), b.size); }

  Limb* limbs;
  int size;
};

int power_room(const Direction& direction) {
  if (direction.degree == 0) return 1;
  const RatioPart& b = *direction.b;
  return limbs_for(direction.degree * bit_width(b.limbs.data(), b.size)) + b.size;
}

// Computes the sum of C(degree, i) a^i b^(degree - i) term_i in `bits` bits, sign included; terms have
// term_bits bits, sign included. add(i, size, power, negative) must add +-C(degree, i) * term_i * power to
// the sum, modulo 2^(64 * size).
template <class Add>
void horner(const Direction& direction, int term_bits, int bits, Limb* sum, Limb* room, const Add& add) {
  RunningPower power(room);
  const int all = limbs_for(bits);
  // The sum starts short and grows with the degree.
  const int first_bits = term_bits + direction.binomial_bits();
  int size = std::min(all, limbs_for(first_bits));
  std::fill_n(sum, size, Limb{0});
  for (int k = 0;; ++k) {
    const int i = direction.degree - k;
    const bool negative = direction.degree != 0 && ((direction.a->negative && (i & 1) != 0) ||
                                                    (direction.b->negative && (k & 1) != 0));
    add(i, size, power, negative);
    if (i == 0) break;
    const int next = std::min(all, limbs_for(first_bits + (k + 1) * direction.bits));
    sign_extend(sum, size, next);
    size = next;
    multiply(sum, size, direction.a->limbs.data(), direction.a->size);
    power *= *direction.b;
  }
  sign_extend(sum, size, all);
}

void sum_of_row(const Net& net, const double* row, Limb* sum, Limb* room) {
  const std::uint64_t* const binomials = binomial_row(net.inner.degree);
  horner(net.inner, net.bits + 1, net.row_bits(), sum, room,
         [&](int j, int size, const RunningPower& power, bool negative) {
           net.for_each_term(row + j * net.inner.step, [&](const Decoded& decoded) {
             const Limb2 factor = Limb2{decoded.mantissa} * binomials[j];
             const int shift = decoded.exponent - net.low, position = shift / kLimbBits;
             const int left = shift % kLimbBits, right = kLimbBits - 1 - left;
             const Limb low = static_cast<Limb>(factor), high = high_limb(factor);
             const bool minus = negative != decoded.negative;
             add_term(sum, size, power.limbs, power.size, low << left, position, minus);
             add_term(sum, size, power.limbs, power.size, low >> 1 >> right | high << left, position + 1,
                      minus);
             add_term(sum, size, power.limbs, power.size, high >> 1 >> right, position + 2, minus);
           });
         });
}

struct Layout {
  explicit Layout(const Net& net)
      : sum(limbs_for(net.all_bits())),
        row(net.outer.degree == 0 ? 0 : limbs_for(net.row_bits()) + 1),
        inner_power(power_room(net.inner)),
        outer_power(power_room(net.outer)),
        all(sum + std::max(row + inner_power + outer_power, rounding_room(net.denominator()))) {}

  // Sizes in limbs. Rounding reuses the memory of everything except the sum.
  int sum, row, inner_power, outer_power, all;
};

void sum_net(const Net& net, const Layout& layout, Limb* room) {
  Limb* const sum = room;
  Limb* const inner_power = sum + layout.sum;
  if (net.outer.degree == 0) return sum_of_row(net, net.points, sum, inner_power);
  Limb* const outer_power = inner_power + layout.inner_power;
  Limb* const row = outer_power + layout.outer_power;
  const std::uint64_t* const binomials = binomial_row(net.outer.degree);
  horner(net.outer, net.row_bits(), net.all_bits(), sum, outer_power,
         [&](int i, int size, const RunningPower& power, bool negative) {
           sum_of_row(net, net.points + i * net.outer.step, row, inner_power);
           int row_size = limbs_for(net.row_bits());
           const bool row_negative = is_negative(row, row_size);
           if (row_negative) negate(row, row_size);
           row[row_size] = GLEV_AT(carry_of_row, multiply(row, row_size, binomials[i]));
           row_size = trimmed_size(row, row_size + 1);
           for (int k = 0; k < row_size; ++k) {
             add_term(sum, size, power.limbs, power.size, row[k], k, negative != row_negative);
           }
         });
}

// ---- The result

// Rounds the sum, which is in two's complement at the beginning of `room`.
template <class Real>
Real round_sum(const Net& net, Limb* room, int size) {
  if (net.factor != 1) multiply(room, size, net.factor);
  bool negative = is_negative(room, size);
  if (GLEV_AT(sum_is_negative, negative)) negate(room, size);
  const int trimmed = trimmed_size(room, size);
  if (trimmed == 0) return 0;
  int exponent = net.low;
  for (const WidthPower* const width : net.widths) {
    exponent -= width->exponent;
    negative = negative != width->is_negative;
  }
  return round_quotient<Real>({room, trimmed, negative, exponent, net.denominator()}, room + size);
}

// One function for each size, so that only large problems use much stack.
template <class Real, int kLimbs>
[[gnu::noinline]] Real round_in(const Net& net, const Layout& layout) {
  std::array<Limb, kLimbs> room;
  sum_net(net, layout, room.data());
  return round_sum<Real>(net, room.data(), layout.sum);
}

constexpr int kSmallRoom = 192;
constexpr int kMediumRoom = 1536;

// The size of the largest problem: order 64 in both directions, with the widest control points, domain and
// grid.
constexpr int kMaxDegree = kMaxOrder - 1, kBinomialLimb = 1;
constexpr int kPointBits = 1074 + 1024 + 1 + kTermBits + bit_width(Limb{kMaxDegree} * kMaxDegree);
constexpr int kRatioLimbs = limbs_for(kRatioBits);
constexpr int kLargestSum = limbs_for(kPointBits + 2 * kMaxDegree * kRatioBits + 1);
constexpr int kLargestRow = limbs_for(kPointBits + kMaxDegree * kRatioBits + 1) + kBinomialLimb;
constexpr int kLargestPower = limbs_for(kMaxDegree * kRatioBits) + kRatioLimbs;
constexpr int kLargestRoom = kLargestSum + kLargestRow + 2 * kLargestPower;
static_assert(2 * kLargestPower + kLargestRow >= limbs_for(54 + 2 * kMaxDegree * kRatioBits) + kRatioLimbs,
              "room to round in");
static_assert(kLargestRoom * sizeof(Limb) < 90000, "the documented use of the stack");

}  // namespace

template <class Real>
Real round_exactly(const Component& component, const GridArgument& u, const GridArgument& v,
                   const std::array<int, 2>& derivative) {
  std::array<int, 2> order = component.order;
  const std::array<std::ptrdiff_t, 2> step = {order[1] * component.stride, component.stride};
  Differences differences;
  Limb factor = 1;
  for (const std::size_t d : {0, 1}) {
    differences.add_direction(derivative[d], step[d]);
    for (int k = 0; k < derivative[d]; ++k) factor *= static_cast<Limb>(--order[d]);
  }
  if (factor == 0) return 0;
  const double* points = component.points;
  Ratio ratio_u, ratio_v;
  Direction in_u, in_v;
  set_direction(order[0], step[0], component.domain[0], u, points, ratio_u, in_u);
  set_direction(order[1], step[1], component.domain[1], v, points, ratio_v, in_v);
  const bool curve_in_u = in_v.degree == 0;
  const WidthPower width_u(component.domain[0], derivative[0]), width_v(component.domain[1], derivative[1]);
  Net net = {points, curve_in_u ? in_v : in_u, curve_in_u ? in_u : in_v, differences,
             factor, {&width_u, &width_v}};
  if (!find_range(net)) return 0;

  const int bits = net.all_bits() + width_u.bits() + width_v.bits();
  if (bits <= 2 * kLimbBits) {
    const Limb2 sum = bits <= kLimbBits ? static_cast<Limb2>(static_cast<std::int64_t>(sum_narrow<Limb>(net)))
                                        : sum_narrow<Limb2>(net);
    constexpr int kSize = 2;
    std::array<Limb, kSize + limbs_for(2 * kLimbBits + 54) + kSize> room;
    room[0] = static_cast<Limb>(sum);
    room[1] = high_limb(sum);
    return round_sum<Real>(net, room.data(), kSize);
  }
  const Layout layout(net);
  if (layout.all <= kSmallRoom) return round_in<Real, kSmallRoom>(net, layout);
  if (layout.all <= kMediumRoom) return round_in<Real, kMediumRoom>(net, layout);
  return round_in<Real, kLargestRoom>(net, layout);
}

template float round_exactly(const Component&, const GridArgument&, const GridArgument&,
                             const std::array<int, 2>&);
template double round_exactly(const Component&, const GridArgument&, const GridArgument&,
                              const std::array<int, 2>&);

}  // namespace glev
