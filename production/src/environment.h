// The floating-point environment that evaluation requires.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#include <cfenv>
#endif

namespace glev {

#if defined(__aarch64__)
// Access to FPCR, the control register, which is 0 by default, and to FPSR, the register of flags.
inline std::uint64_t read_fpcr() {
  std::uint64_t value;
  asm volatile("mrs %0, fpcr" : "=r"(value) : : "memory");
  return value;
}
inline std::uint64_t read_fpsr() {
  std::uint64_t value;
  asm volatile("mrs %0, fpsr" : "=r"(value) : : "memory");
  return value;
}
inline void write_fpcr(std::uint64_t value) { asm volatile("msr fpcr, %0" : : "r"(value) : "memory"); }
inline void write_fpsr(std::uint64_t value) { asm volatile("msr fpsr, %0" : : "r"(value) : "memory"); }
#endif

// Sets rounding to nearest, gradual underflow and no traps during its lifetime, then restores the environment
// of the caller. If that was different, its flags do not change. Reading the environment is cheap enough for
// calls that evaluate a single point.
class DefaultEnvironment {
 public:
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;
#if defined(__x86_64__) || defined(_M_X64)
  DefaultEnvironment() : callers_(_mm_getcsr()) {
    if ((callers_ & kControl) != kDefault) _mm_setcsr(kDefault);
  }
  ~DefaultEnvironment() {
    if ((callers_ & kControl) != kDefault) _mm_setcsr(callers_);
  }

 private:
  static constexpr unsigned kFlags = 0x3F, kDefault = 0x1F80, kControl = 0xFFFF & ~kFlags;
  unsigned callers_;
#elif defined(__aarch64__)
  DefaultEnvironment() : callers_(read_fpcr()) {
    if (callers_ == 0) return;
    callers_flags_ = read_fpsr();
    write_fpcr(0);
  }
  ~DefaultEnvironment() {
    if (callers_ == 0) return;
    write_fpsr(callers_flags_);
    write_fpcr(callers_);
  }

 private:
  std::uint64_t callers_, callers_flags_ = 0;
#else
  // If the C library supports flush-to-zero, it is part of the environment and off in the default one.
  DefaultEnvironment() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultEnvironment() { std::fesetenv(&callers_); }

 private:
  std::fenv_t callers_;
#endif
};

// Returns true if the environment is the default one, apart from flags. Takes longer than the evaluation of a
// cubic.
inline bool in_default_environment() {
#if defined(__x86_64__) || defined(_M_X64)
  constexpr unsigned kFlags = 0x3F, kDefault = 0x1F80;
  return (_mm_getcsr() & 0xFFFF & ~kFlags) == kDefault;
#elif defined(__aarch64__)
  return read_fpcr() == 0;
#elif defined(__GLIBC__)
  return std::fegetround() == FE_TONEAREST && fegetexcept() == 0;
#else
  return false;
#endif
}

inline bool is_subnormal(float x) { return (std::bit_cast<std::uint32_t>(x) & 0x7FFFFFFF) - 1 < 0x7FFFFF; }
inline bool is_subnormal(double x) {
  return (std::bit_cast<std::uint64_t>(x) & 0x7FFFFFFFFFFFFFFF) - 1 < 0xFFFFFFFFFFFFF;
}

// Converts a float exactly in every environment. The conversion of the processor would turn subnormal floats
// into zero if the caller has set denormals-are-zero, and could trap for a signalling NaN.
inline double widen(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t exponent = bits >> 23 & 0xFF, fraction = bits & 0x7FFFFF;
  if (exponent != 0 && exponent != 0xFF) return x;
  constexpr double kUnit = std::numeric_limits<float>::denorm_min();
  const double magnitude = exponent == 0   ? static_cast<std::int32_t>(fraction) * kUnit
                           : fraction == 0 ? HUGE_VAL
                                           : std::numeric_limits<double>::quiet_NaN();
  return std::copysign(magnitude, bits >> 31 != 0 ? -1.0 : 1.0);
}

}  // namespace glev
