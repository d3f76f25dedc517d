// Implements hexadecimal() with the %a of the C library.
#include <evalcts/gl/hexadecimal.h>

#include <array>
#include <cstdio>

namespace evalcts {

std::string hexadecimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%a", value);
  return text.data();
}

}  // namespace evalcts
