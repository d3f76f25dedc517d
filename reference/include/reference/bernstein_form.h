// One component of a map, prepared for exact evaluation at many arguments. The functions of bernstein.h
// construct a BernsteinForm for each call.
//
// Evaluation is fast because it uses integers: with t = a/c, 1 - t = b/c and control values scaled to
// integers R_i, the value is
//
//   SUM C(n,i) * a^i * b^(n-i) * R_i / c^n,
//
// and neither the sum nor the powers contain fractions. If a, b, c fit in 62 bits and the R_i in 63, as for
// ordinary data, the sum is computed in natural numbers of bounded size on the stack. If c is a power of two,
// as for the domain [0,1], the result is rounded by shifting.
#pragma once

#include <memory>

#include <reference/bernstein.h>

namespace evalcts::reference {

class BernsteinForm {
 public:
  // Copies the control values. Throws std::invalid_argument if an order is outside 1..kMaxOrder,
  // std::domain_error if a domain is empty or a domain end or control value is not finite.
  explicit BernsteinForm(const Surface& surface);
  BernsteinForm(BernsteinForm&&) noexcept;
  BernsteinForm& operator=(BernsteinForm&&) noexcept;
  ~BernsteinForm();

  // Same as the functions of bernstein.h. Throw std::domain_error if an argument is not finite. Const member
  // functions may be called from several threads at once.
  Rational evaluate(const Argument& u, const Argument& v = {}) const;
  Evaluation evaluate_with_magnitude(const Argument& u, const Argument& v = {}) const;

  // Return round_to_float(evaluate(u, v)) and round_to_double(evaluate(u, v)), computed without a Rational.
  float to_float(const Argument& u, const Argument& v = {}) const;
  double to_double(const Argument& u, const Argument& v = {}) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace evalcts::reference
