// Computes the exact position of an argument in its domain.
#include "ratio.h"
#include "mutation_point.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace glev {
namespace {

// Compares bits, because a processor may be set to treat subnormal numbers as zero.
bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}

// The number +-magnitude * 2^exponent.
struct Product {
  Limb2 magnitude;  // below 2^88
  int exponent;
  bool negative;
};

Product multiply_exactly(std::int64_t multiplier, double x) {
  const Decoded decoded = decode(x);
  const auto factor = static_cast<Limb>(multiplier);
  return {Limb2{multiplier < 0 ? 0 - factor : factor} * decoded.mantissa, decoded.exponent,
          (multiplier < 0) != decoded.negative};
}

// The products of a grid argument: its argument times the segments is kFrom + kTo, and kFirst and kLast are
// u1 and u2 times the segments.
enum { kFrom, kTo, kFirst, kLast };
using Products = std::array<Product, 4>;

Limb odd_gcd(Limb x, Limb y) {  // x != 0, y odd
  while (true) {
    x >>= std::countr_zero(x);
    if (x == y) return x;
    if (x < y) std::swap(x, y);
    x -= y;
  }
}

void set_part(RatioPart& part, Limb2 magnitude, bool negative) {
  part.limbs[0] = static_cast<Limb>(magnitude);
  part.limbs[1] = high_limb(magnitude);
  part.size = part.limbs[1] != 0 ? 2 : 1;
  part.negative = negative;
}

// Sets the ratio of a and b, which must not be 0, without common factors if everything fits into a limb.
void set_reduced(Ratio& ratio, Limb2 a, Limb2 b, bool a_negative, bool b_negative) {
  const int zeros = trailing_zeros(a | b);
  a >>= zeros;
  b >>= zeros;
  const Limb2 whole = a_negative ? b - a : b_negative ? a - b : a + b;
  // If `whole` is a power of two, a and b have no common factor left.
  const bool power_of_two = (whole & (whole - 1)) == 0;
  if (!power_of_two && high_limb(a | b | whole) == 0) {
    const Limb gcd = (a & 1) != 0 ? odd_gcd(static_cast<Limb>(b), static_cast<Limb>(a))
                                  : odd_gcd(static_cast<Limb>(a), static_cast<Limb>(b));
    if (gcd != 1) {
      set_part(ratio.a, static_cast<Limb>(a) / gcd, a_negative);
      set_part(ratio.b, static_cast<Limb>(b) / gcd, b_negative);
      set_part(ratio.whole, static_cast<Limb>(whole) / gcd, false);
      return;
    }
  }
  set_part(ratio.a, a, a_negative);
  set_part(ratio.b, b, b_negative);
  set_part(ratio.whole, whole, false);
}

// Makes a ratio of products that fit into 127 bits above 2^low.
Parameter::End to_ratio_narrow(const Products& products, int low, Ratio& ratio) {
  const auto integer = [low](const Product& product) {
    if (product.magnitude == 0) return product.magnitude;
    const Limb2 shifted = product.magnitude << (product.exponent - low);
    return product.negative ? 0 - shifted : shifted;
  };
  const Limb2 argument = integer(products[kFrom]) + integer(products[kTo]);
  const Limb2 a = argument - integer(products[kFirst]), b = integer(products[kLast]) - argument;
  if (a == 0) return Parameter::End::kFirst;
  if (b == 0) return Parameter::End::kLast;
  const auto negative = [](Limb2 x) { return x >> 127 != 0; };
  const bool flip = negative(a + b);
  set_reduced(ratio, negative(a) ? 0 - a : a, negative(b) ? 0 - b : b, negative(a) != flip,
              negative(b) != flip);
  return Parameter::End::kNeither;
}

// Computes part += product * 2^-low, or part -= product * 2^-low if `subtract`.
void accumulate(RatioPart& part, const Product& product, int low, bool subtract) {
  if (product.magnitude == 0) return;
  const int shift = product.exponent - low;
  const int size = static_cast<int>(part.limbs.size()), first = shift / kLimbBits;
  const Limb power = Limb{1} << shift % kLimbBits;
  const std::array<Limb, 2> limbs = {static_cast<Limb>(product.magnitude), high_limb(product.magnitude)};
  if (product.negative == subtract) {
    add_product(part.limbs.data() + first, size - first, limbs.data(), 2, power);
  } else {
    subtract_product(part.limbs.data() + first, size - first, limbs.data(), 2, power);
  }
}

Parameter::End to_ratio_wide(const Products& products, int low, Ratio& ratio) {
  constexpr int kSize = static_cast<int>(std::tuple_size_v<decltype(RatioPart::limbs)>);
  for (RatioPart* const part : {&ratio.a, &ratio.b}) {
    const bool is_b = part == &ratio.b;
    part->limbs.fill(0);
    accumulate(*part, products[kFrom], low, is_b);
    accumulate(*part, products[kTo], low, is_b);
    accumulate(*part, products[is_b ? kLast : kFirst], low, !is_b);
    part->size = trimmed_size(part->limbs.data(), kSize);
  }
  if (ratio.a.size == 0) return Parameter::End::kFirst;
  if (ratio.b.size == 0) return Parameter::End::kLast;

  constexpr std::array<Limb, 1> kOne = {1};
  ratio.whole.limbs = ratio.a.limbs;
  for (int i = 0; i < kSize; ++i) {
    add_product(ratio.whole.limbs.data() + i, kSize - i, kOne.data(), 1, ratio.b.limbs[i]);
  }
  const bool flip = is_negative(ratio.whole.limbs.data(), kSize);
  const int zeros = std::min(trailing_zeros(ratio.a.limbs.data()), trailing_zeros(ratio.b.limbs.data()));
  for (RatioPart* const part : {&ratio.a, &ratio.b, &ratio.whole}) {
    Limb* const limbs = part->limbs.data();
    part->negative = is_negative(limbs, kSize);
    if (part->negative) negate(limbs, kSize);
    part->negative = part->negative != flip;
    shift_right(limbs, kSize, zeros);
    part->size = trimmed_size(limbs, kSize);
  }
  return Parameter::End::kNeither;
}

}  // namespace

Parameter::End to_ratio(const Domain& domain, const GridArgument& argument, Ratio& ratio) {
  const Grid& grid = argument.grid;
  std::int64_t to = argument.index, from = grid.segments - to, all = grid.segments;
  if (to == 0 || same_bits(grid.u1, grid.u2)) {
    from = all = 1;
    to = 0;
  } else if (from == 0) {
    to = all = 1;
  } else {
    const bool along = same_bits(grid.u1, domain.u1) && same_bits(grid.u2, domain.u2);
    const bool against = same_bits(grid.u1, domain.u2) && same_bits(grid.u2, domain.u1);
    if (along || against) {
      if (GLEV_AT(grid_is_against, against)) std::swap(from, to);
      const auto magnitude = [](std::int64_t x) { return static_cast<Limb2>(x < 0 ? -x : x); };
      set_reduced(ratio, magnitude(to), magnitude(from), to < 0, from < 0);
      return Parameter::End::kNeither;
    }
  }

  const Products products = {multiply_exactly(from, grid.u1), multiply_exactly(to, grid.u2),
                             multiply_exactly(all, domain.u1), multiply_exactly(all, domain.u2)};
  int low = 1024, high = -1074;
  for (const Product& product : products) {
    if (product.magnitude == 0) continue;
    low = std::min(low, product.exponent);
    high = std::max(high, product.exponent + bit_width(product.magnitude));
  }
  // Sums of up to four products and a sign need 3 more bits.
  return high - low + 3 <= 127 ? to_ratio_narrow(products, low, ratio) : to_ratio_wide(products, low, ratio);
}

int to_width(const Domain& domain, RatioPart& width) {
  const Product last = multiply_exactly(1, domain.u2), first = multiply_exactly(1, domain.u1);
  const int low = first.magnitude == 0  ? last.exponent
                  : last.magnitude == 0 ? first.exponent
                                        : std::min(first.exponent, last.exponent);
  constexpr int kSize = static_cast<int>(std::tuple_size_v<decltype(RatioPart::limbs)>);
  width.limbs.fill(0);
  accumulate(width, last, low, false);
  accumulate(width, first, low, true);
  width.negative = is_negative(width.limbs.data(), kSize);
  if (width.negative) negate(width.limbs.data(), kSize);
  width.size = trimmed_size(width.limbs.data(), kSize);
  return low;
}

}  // namespace glev
