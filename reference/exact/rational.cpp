// Arithmetic and text of exact rational numbers.
#include <reference/rational.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "binary.h"

namespace evalcts::reference {
namespace {

using boost::multiprecision::msb;

// The numerators of two values over their common denominator and common power of two.
struct Aligned {
  Integer a, b;
  std::int64_t exponent;
};

Aligned align(const Rational& a, const Rational& b) {
  Aligned aligned{a.numerator(), b.numerator(), std::min(a.exponent(), b.exponent())};
  aligned.a <<= a.exponent() - aligned.exponent;
  aligned.b <<= b.exponent() - aligned.exponent;
  if (a.denominator() != b.denominator()) {
    aligned.a *= b.denominator();
    aligned.b *= a.denominator();
  }
  return aligned;
}

// Returns 10^n for any n.
Rational power_of_ten(std::int64_t n) {
  const Rational power = pow(Rational(10), static_cast<unsigned>(std::abs(n)));
  return n < 0 ? 1 / power : power;
}

// Appends the digits with a point after the first digit and without trailing zeros.
void append_mantissa(std::string& text, const std::string& digits) {
  const std::size_t end = digits.find_last_not_of('0') + 1;
  text += digits[0];
  if (end > 1) text.append(1, '.').append(digits, 1, end - 1);
}

void append_exponent(std::string& text, char letter, std::int64_t exponent) {
  text += letter;
  text += exponent < 0 ? '-' : '+';
  text += std::to_string(std::abs(exponent));
}

void append_decimal(std::string& text, const Rational& x, int significant_digits) {
  // The position of the first digit is estimated from that of the first bit. The estimate is never too high.
  std::int64_t position = static_cast<std::int64_t>(floor_log2(x) * 0.30102999566398119521) - 1;
  while (abs(x) >= power_of_ten(position + 1)) ++position;
  std::string digits = round_to_integer(abs(x) * power_of_ten(significant_digits - 1 - position)).str();
  if (digits.size() > static_cast<std::size_t>(significant_digits)) {  // rounded up to a power of ten
    digits.pop_back();
    ++position;
  }
  if (x.sign() < 0) text += '-';
  if (position < -5 || position >= significant_digits) {
    append_mantissa(text, digits);
    append_exponent(text, 'e', position);
    return;
  }
  digits.insert(0, static_cast<std::size_t>(std::max<std::int64_t>(0, -position)), '0');
  const auto whole = static_cast<std::size_t>(std::max<std::int64_t>(0, position) + 1);
  const std::size_t end = std::max(whole, digits.find_last_not_of('0') + 1);
  text.append(digits, 0, whole);
  if (end > whole) text.append(1, '.').append(digits, whole, end - whole);
}

void append_hexadecimal(std::string& text, const Rational& x, int significant_bits) {
  const std::int64_t exponent = floor_log2(x);
  Integer rounded = round_to_integer(abs(x) * Rational::power_of_two(significant_bits - 1 - exponent));
  const bool carried = msb(rounded) == static_cast<unsigned>(significant_bits);  // up to a power of two
  // One bit before the point, then whole hexadecimal digits.
  rounded <<= (4 - msb(rounded) % 4) % 4;
  if (x.sign() < 0) text += '-';
  text += "0x";
  append_mantissa(text, rounded.str(0, std::ios_base::hex));
  append_exponent(text, 'p', carried ? exponent + 1 : exponent);
}

}  // namespace

Rational::Rational(double value) {
  const Binary binary = decompose(value);
  numerator_ = binary.significand;
  exponent_ = binary.exponent;
}

Rational::Rational(Integer numerator, Integer denominator, std::int64_t exponent)
    : numerator_(std::move(numerator)), denominator_(std::move(denominator)), exponent_(exponent) {
  if (denominator_.is_zero()) throw std::domain_error("division by zero");
  if (denominator_.sign() < 0) {
    numerator_.backend().negate();
    denominator_.backend().negate();
  }
  strip_powers_of_two();
}

Rational Rational::power_of_two(std::int64_t exponent) {
  Rational x;
  x.numerator_ = 1;
  x.exponent_ = exponent;
  return x;
}

void Rational::strip_powers_of_two() {
  if (numerator_.is_zero()) {
    denominator_ = 1;
    exponent_ = 0;
    return;
  }
  if (const unsigned zeros = trailing_zeros(numerator_)) {
    numerator_ >>= zeros;
    exponent_ += zeros;
  }
  if (const unsigned zeros = trailing_zeros(denominator_)) {
    denominator_ >>= zeros;
    exponent_ -= zeros;
  }
}

Rational Rational::operator-() const {
  Rational negated = *this;
  negated.numerator_.backend().negate();
  return negated;
}

Rational& Rational::operator+=(const Rational& other) {
  if (other.is_zero()) return *this;
  if (is_zero()) return *this = other;
  Aligned aligned = align(*this, other);
  if (denominator_ != other.denominator_) denominator_ *= other.denominator_;
  numerator_ = std::move(aligned.a);
  numerator_ += aligned.b;
  exponent_ = aligned.exponent;
  strip_powers_of_two();
  return *this;
}

Rational& Rational::operator-=(const Rational& other) { return *this += -other; }

Rational& Rational::operator*=(const Rational& other) {
  // Products of odd numbers are odd: nothing to strip, unless one is zero.
  numerator_ *= other.numerator_;
  denominator_ *= other.denominator_;
  exponent_ += other.exponent_;
  if (numerator_.is_zero()) strip_powers_of_two();
  return *this;
}

Rational& Rational::operator/=(const Rational& other) {
  return *this *= Rational(other.denominator_, other.numerator_, -other.exponent_);
}

double Rational::to_double() const { return round_to_double(*this); }

bool operator==(const Rational& a, const Rational& b) { return (a <=> b) == 0; }

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  if (a.sign() != b.sign() || a.is_zero()) return a.sign() <=> b.sign();
  const Aligned aligned = align(a, b);
  return aligned.a.compare(aligned.b) <=> 0;
}

Rational operator+(Rational a, const Rational& b) { return a += b; }
Rational operator-(Rational a, const Rational& b) { return a -= b; }
Rational operator*(Rational a, const Rational& b) { return a *= b; }
Rational operator/(Rational a, const Rational& b) { return a /= b; }

Rational abs(Rational x) { return x.sign() < 0 ? -x : x; }

Rational pow(const Rational& x, unsigned n) {
  return Rational(boost::multiprecision::pow(x.numerator(), n),
                  boost::multiprecision::pow(x.denominator(), n), x.exponent() * n);
}

std::int64_t floor_log2(const Rational& x) {
  if (x.is_zero()) throw std::domain_error("zero has no logarithm");
  const Integer numerator = abs(x.numerator());
  // The type of msb() depends on the version of Boost.
  const auto difference =
      static_cast<std::int64_t>(msb(numerator)) - static_cast<std::int64_t>(msb(x.denominator()));
  // numerator/denominator lies in (2^(difference - 1), 2^(difference + 1)).
  const bool reached =
      x.denominator() == 1 || (difference >= 0 ? numerator >= (x.denominator() << difference)
                                               : (numerator << -difference) >= x.denominator());
  return x.exponent() + (reached ? difference : difference - 1);
}

std::string describe(const Rational& x) {
  if (x.is_zero()) return "0 (0x0p+0)";
  std::string text;
  append_decimal(text, x, 17);
  text += " (";
  append_hexadecimal(text, x, 41);
  text += ')';
  return text;
}

std::ostream& operator<<(std::ostream& stream, const Rational& x) { return stream << describe(x); }

}  // namespace evalcts::reference
