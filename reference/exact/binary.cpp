// Decomposition of doubles and integers into binary digits.
#include "binary.h"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace evalcts::reference {

Binary decompose(double x) {
  if (!std::isfinite(x)) throw std::domain_error("a real number is needed, not infinity or NaN");
  if (x == 0) return {0, 0};
  int exponent;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(significand));
  return {significand >> zeros, exponent - 53 + zeros};
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
