// Exact rational numbers for the oracle.
//
// A value is numerator / denominator * 2^exponent. Numerator and denominator are odd (or the numerator is
// zero) and not reduced otherwise, because computing greatest common divisors makes ordinary rationals slow.
// Powers of two, which are frequent in floating-point data, cost only a shift.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace evalcts::reference {

using Integer = boost::multiprecision::cpp_int;

class Rational {
 public:
  // Zero.
  Rational() = default;
  // The integer itself.
  template <std::integral T>
  Rational(T value) : Rational(Integer(value)) {}
  // The exact value of a double; -0 is 0. Throws std::domain_error if it is not finite.
  Rational(double value);
  Rational(long double) = delete;
  // numerator / denominator * 2^exponent, any signs. Throws std::domain_error if the denominator is zero.
  explicit Rational(Integer numerator, Integer denominator = 1, std::int64_t exponent = 0);

  // 2^exponent.
  static Rational power_of_two(std::int64_t exponent);

  // The three parts; the denominator is positive.
  const Integer& numerator() const { return numerator_; }
  const Integer& denominator() const { return denominator_; }
  std::int64_t exponent() const { return exponent_; }

  bool is_zero() const { return numerator_.is_zero(); }
  // -1, 0 or 1.
  int sign() const { return numerator_.sign(); }

  Rational operator-() const;
  Rational& operator+=(const Rational& other);
  Rational& operator-=(const Rational& other);
  Rational& operator*=(const Rational& other);
  // Throws std::domain_error if `other` is zero.
  Rational& operator/=(const Rational& other);

  // Returns the nearest binary64, ties to even; infinity beyond its range. Used in statistics and reports.
  double to_double() const;

  // Compare values: 2/6 equals 1/3.
  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  void strip_powers_of_two();

  Integer numerator_ = 0;
  Integer denominator_ = 1;
  std::int64_t exponent_ = 0;
};

Rational operator+(Rational a, const Rational& b);
Rational operator-(Rational a, const Rational& b);
Rational operator*(Rational a, const Rational& b);
// Throws std::domain_error if b is zero.
Rational operator/(Rational a, const Rational& b);

Rational abs(Rational x);
// Returns x^n; x^0 is 1, also for x = 0.
Rational pow(const Rational& x, unsigned n);

// Returns floor(log2 |x|). Throws std::domain_error if x is zero.
std::int64_t floor_log2(const Rational& x);

// Returns a text for reports: 17 significant decimal digits and, in parentheses, a hexadecimal float of 41
// significant bits, both rounded to nearest, without trailing zeros: "0.33333333333333333
// (0x1.5555555555p-2)".
std::string describe(const Rational& x);

// Writes describe(x).
std::ostream& operator<<(std::ostream& stream, const Rational& x);

}  // namespace evalcts::reference
