// Formats numbers as hexadecimal floating-point constants of C.
#pragma once

#include <string>

namespace evalcts {

// Returns the exact value as printf's %a writes it, with the same bytes on every machine: "0x1.8p+0",
// "0x0p+0", "-inf". The digit before the point is 1 for subnormal numbers as well. ({:a} of fmt is not used,
// because some versions write zero as 0x0p-1022.)
std::string hexadecimal(double value);

}  // namespace evalcts
