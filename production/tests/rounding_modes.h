// Rounding modes that callers of the library may have set.
#pragma once

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace glev_tests {

// -1: flush-to-zero and denormals-are-zero.
constexpr int kModes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, -1};

template <class Call>
void call_in_mode(int mode, const Call& call) {
#if defined(__SSE2__)
  const unsigned control = _mm_getcsr();
  if (mode < 0) _mm_setcsr(control | 0x8040);
#endif
  if (mode >= 0) std::fesetround(mode);
  call();
  std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
  _mm_setcsr(control);
#endif
}

}  // namespace glev_tests
