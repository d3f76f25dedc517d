// Defines Natural, a natural number of bounded size on the stack, with the operations that exact sums of
// Bernstein terms need (short_sum.cpp).
#pragma once

#include <reference/rational.h>

#include <array>
#include <bit>
#include <cstdint>

#include "leading_bits.h"

namespace evalcts::reference {

class Natural {
 public:
  // Number of limbs for the numerator of a value of a surface of orders 64 x 64, if the numerators of t and s
  // have 62 bits and control values 63 bits, and for a carry. No operation checks this limit.
  static constexpr int kCapacity = 132;
  using Limb = std::uint64_t;
  using TwoLimbs = unsigned __int128;

  // Zero.
  Natural() = default;
  explicit Natural(Limb value) : size_(value != 0 ? 1 : 0) { limbs_[0] = value; }
  // Only the limbs in use are copied.
  Natural(const Natural& other) { *this = other; }
  Natural& operator=(const Natural& other) {
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) limbs_[i] = other.limbs_[i];
    return *this;
  }

  bool is_zero() const { return size_ == 0; }
  int bits() const { return size_ == 0 ? 0 : size_ * 64 - std::countl_zero(limbs_[size_ - 1]); }

  // *this *= factor.
  void multiply(Limb factor) {
    if (factor == 0) size_ = 0;
    Limb carry = 0;
    for (int i = 0; i < size_; ++i) {
      const TwoLimbs product = TwoLimbs{limbs_[i]} * factor + carry;
      limbs_[i] = static_cast<Limb>(product);
      carry = static_cast<Limb>(product >> 64);
    }
    if (carry != 0) limbs_[size_++] = carry;
  }

  // *this += x * factor * 2^(64 * shift). `x` must be another number.
  void add_product(const Natural& x, Limb factor, int shift = 0) {
    if (factor == 0 || x.is_zero()) return;
    while (size_ < x.size_ + shift) limbs_[size_++] = 0;
    Limb carry = 0;
    int i = shift;
    for (int k = 0; k < x.size_; ++k, ++i) {
      const TwoLimbs sum = TwoLimbs{x.limbs_[k]} * factor + limbs_[i] + carry;  // cannot overflow
      limbs_[i] = static_cast<Limb>(sum);
      carry = static_cast<Limb>(sum >> 64);
    }
    for (; carry != 0; ++i) {
      if (i == size_) limbs_[size_++] = 0;
      limbs_[i] += carry;
      carry = limbs_[i] < carry ? 1 : 0;
    }
  }

  void add_product(const Natural& x, TwoLimbs factor) {
    add_product(x, static_cast<Limb>(factor));
    add_product(x, static_cast<Limb>(factor >> 64), 1);
  }

  void add_product(const Natural& x, const Natural& y) {
    for (int k = 0; k < y.size_; ++k) add_product(x, y.limbs_[k], k);
  }

  // Sets `difference` to |a - b|. Returns true if a < b.
  static bool subtract(const Natural& a, const Natural& b, Natural& difference) {
    const bool less = is_less(a, b);
    const Natural& large = less ? b : a;
    const Natural& small = less ? a : b;
    Limb borrow = 0;
    for (int i = 0; i < large.size_; ++i) {
      const Limb taken = i < small.size_ ? small.limbs_[i] : 0;
      const Limb first = large.limbs_[i] - taken;
      difference.limbs_[i] = first - borrow;
      borrow = (large.limbs_[i] < taken ? 1 : 0) + (first < borrow ? 1 : 0);
    }
    difference.size_ = large.size_;
    while (difference.size_ > 0 && difference.limbs_[difference.size_ - 1] == 0) --difference.size_;
    return less;
  }

  // Returns the 64 leading bits, for round_leading(). Must not be called for zero.
  LeadingBits leading_bits() const {
    const int zeros = std::countl_zero(limbs_[size_ - 1]);
    Limb leading = limbs_[size_ - 1] << zeros;
    Limb rest = 0;
    if (size_ > 1 && zeros != 0) {
      leading |= limbs_[size_ - 2] >> (64 - zeros);
      rest = limbs_[size_ - 2] << zeros;
    } else if (size_ > 1) {
      rest = limbs_[size_ - 2];
    }
    for (int i = 0; i + 2 < size_; ++i) rest |= limbs_[i];
    return {leading, rest != 0};
  }

  Integer to_integer(bool negative = false) const {
    Integer result;
    if (size_ == 0) return result;
    import_bits(result, limbs_.begin(), limbs_.begin() + size_, 64, false);
    if (negative) result.backend().negate();
    return result;
  }

 private:
  static bool is_less(const Natural& a, const Natural& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (int i = a.size_ - 1; i >= 0; --i) {
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i];
    }
    return false;
  }

  int size_ = 0;                       // the highest limb is not zero
  std::array<Limb, kCapacity> limbs_;  // lowest first; beyond size_ undefined
};

}  // namespace evalcts::reference
