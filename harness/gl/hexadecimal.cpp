// Implements hexadecimal() with the %a of the C library.
#include <evalcts/gl/hexadecimal.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace evalcts {

std::string hexadecimal(double value) {
  // C libraries write subnormal numbers differently, so their significand is formatted as a normal number.
  const int exponent = std::fpclassify(value) == FP_SUBNORMAL ? std::ilogb(value) : 0;
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%a", std::scalbn(value, -exponent));
  std::string text = buffer.data();
  if (exponent != 0) text.replace(text.find('p'), std::string::npos, "p" + std::to_string(exponent));
  return text;
}

}  // namespace evalcts
