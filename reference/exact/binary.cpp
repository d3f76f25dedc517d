// Decomposition of doubles and integers into binary digits.
#include "binary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace evalcts::reference {

Binary decompose(double x) {
  if (!std::isfinite(x)) throw std::domain_error("a real number is needed, not infinity or NaN");
  if (x == 0) return {0, 0};
  // A double is significand * 2^(field - 1075), where the significand of a normal number has a leading 1 that
  // is not stored.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int field = static_cast<int>(bits >> 52 & 0x7FF);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  std::uint64_t significand = field == 0 ? fraction : fraction | std::uint64_t{1} << 52;
  const int zeros = std::countr_zero(significand);
  significand >>= zeros;
  const auto magnitude = static_cast<std::int64_t>(significand);
  return {x < 0 ? -magnitude : magnitude, std::max(field, 1) - 1075 + zeros};
}

int common_exponent(std::span<const Binary> numbers) {
  int least = 0;
  bool found = false;
  for (const Binary& x : numbers) {
    if (x.significand == 0 || (found && x.exponent >= least)) continue;
    least = x.exponent;
    found = true;
  }
  return least;
}

unsigned trailing_zeros(const Integer& x) {
  // Boost's lsb() rejects negative numbers, so it would need a copy.
  const auto& backend = x.backend();
  for (unsigned i = 0; i < backend.size(); ++i) {
    if (const auto limb = backend.limbs()[i]; limb != 0) {
      return i * std::numeric_limits<boost::multiprecision::limb_type>::digits + std::countr_zero(limb);
    }
  }
  return 0;
}

}  // namespace evalcts::reference
