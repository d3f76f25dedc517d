#include "reference/exact/binary.h"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace evalcts::reference {

Binary decompose(double x) {
  if (!std::isfinite(x)) throw std::domain_error("a real number is needed, not infinity or NaN");
  if (x == 0) return {0, 0};
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int exponent;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), kDigits));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(significand));
  return {significand / (std::int64_t{1} << zeros), exponent - kDigits + zeros};
}

unsigned trailing_zeros(const Integer& x) {
  // Boost's lsb() would copy, as it refuses negative numbers.
  const auto& backend = x.backend();
  for (unsigned i = 0; i < backend.size(); ++i) {
    if (const auto limb = backend.limbs()[i]; limb != 0) {
      return i * std::numeric_limits<boost::multiprecision::limb_type>::digits + std::countr_zero(limb);
    }
  }
  return 0;
}

}  // namespace evalcts::reference
