// Arithmetic of limited accuracy, and the usual methods to evaluate a map with it.
#pragma once

#include <reference/bernstein.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace evalcts::reference {

// Arithmetic whose operations have a relative error that a derived class chooses, except that 1 * x = x and x
// + 0 = x, as the GL requires (GL 2.1 section 2.1.1). Values are long doubles, whose own rounding is
// negligible beside 1e-5.
class Arithmetic {
 public:
  virtual ~Arithmetic() = default;
  virtual long double round(long double exact) = 0;
  long double add(long double a, long double b) { return a == 0 ? b : b == 0 ? a : round(a + b); }
  long double sub(long double a, long double b) { return round(a - b); }
  long double mul(long double a, long double b) { return a == 1 ? b : b == 1 ? a : round(a * b); }
  long double div(long double a, long double b) { return round(a / b); }
  long double fma(long double a, long double b, long double c) { return round(a * b + c); }
};

// IEEE single precision. (Sums, products and quotients of floats can be rounded from long double, which has
// more than twice the digits.)
class SinglePrecision : public Arithmetic {
 public:
  long double round(long double exact) override { return static_cast<float>(exact); }
};

constexpr long double kPerturbation = 1e-5L;

// A random error of at most one part in 10^5, in half of the operations the largest.
class RandomErrors : public Arithmetic {
 public:
  explicit RandomErrors(std::mt19937_64& generator) : generator_(generator) {}
  long double round(long double exact) override {
    std::uniform_real_distribution<double> error(-2, 2);
    return exact * (1 + std::fmax(-1, std::fmin(1, error(generator_))) * kPerturbation);
  }

 private:
  std::mt19937_64& generator_;
};

// Errors of one part in 10^5 with the given signs, operation by operation; positive if no sign is given.
class SignedErrors : public Arithmetic {
 public:
  long double round(long double exact) override {
    if (next_ == signs.size()) signs.push_back(1);
    return exact * (1 + signs[next_++] * kPerturbation);
  }
  void restart() { next_ = 0; }
  std::vector<signed char> signs;

 private:
  std::size_t next_ = 0;
};

// Chooses the sign of every single error for the largest result, then for the smallest, and calls check()
// with each choice. `result` runs the method. To first order, the errors are independent, so flipping one
// sign at a time finds the worst signs.
template <typename Result, typename Check>
void search_worst_errors(const Result& result, const Check& check) {
  SignedErrors arithmetic;
  const auto run = [&] {
    arithmetic.restart();
    return result(arithmetic);
  };
  const long double outward = run();
  std::vector<signed char> best = arithmetic.signs;
  for (std::size_t k = 0; k < best.size(); ++k) {
    arithmetic.signs[k] = -1;
    if (run() > outward) best[k] = -1;
    arithmetic.signs[k] = 1;
  }
  for (const int direction : {1, -1}) {
    for (std::size_t k = 0; k < best.size(); ++k)
      arithmetic.signs[k] = static_cast<signed char>(direction * best[k]);
    arithmetic.restart();
    check(arithmetic);
  }
}

enum class Parameter { kDivision, kReciprocal, kTwoDivisions };  // the computation of t and s
enum class Method { kDeCasteljau, kDeCasteljauFused, kLerp, kLerpFused, kHorner, kHornerFused, kDirectSum };

constexpr Parameter kParameters[] = {Parameter::kDivision, Parameter::kReciprocal, Parameter::kTwoDivisions};
constexpr Method kMethods[] = {Method::kDeCasteljau, Method::kDeCasteljauFused, Method::kLerp,
                               Method::kLerpFused,   Method::kHorner,           Method::kHornerFused,
                               Method::kDirectSum};

struct Weights {
  long double t, s;
};

// Returns t = (u - u1)/(u2 - u1), and s as 1 - t or (u2 - u)/(u2 - u1).
inline Weights parameter(Arithmetic& a, Parameter how, long double u, long double u1, long double u2) {
  const long double width = a.sub(u2, u1);
  if (how == Parameter::kReciprocal) {
    const long double t = a.mul(a.sub(u, u1), a.div(1, width));
    return {t, a.sub(1, t)};
  }
  const long double t = a.div(a.sub(u, u1), width);
  return {t, how == Parameter::kTwoDivisions ? a.div(a.sub(u2, u), width) : a.sub(1, t)};
}

// Returns u = i * ((g2 - g1)/n) + g1, exact at the ends.
inline long double grid_point(Arithmetic& a, long double i, long double n, long double g1, long double g2) {
  if (i == 0) return g1;
  if (i == n) return g2;
  return a.add(a.mul(i, a.div(a.sub(g2, g1), n)), g1);
}

// Returns the argument, computed if it is a point of a grid.
inline long double coordinate(Arithmetic& a, const Argument& u) {
  return u.is_grid() ? grid_point(a, u.index(), u.segments(), u.first(), u.last())
                     : static_cast<long double>(u.coordinate());
}

inline long double evaluate_by(Arithmetic& a, Method method, std::vector<long double> r, Weights w) {
  const std::size_t order = r.size(), n = order - 1;
  switch (method) {
    case Method::kDeCasteljau:
    case Method::kDeCasteljauFused:
    case Method::kLerp:
    case Method::kLerpFused:
      for (std::size_t last = n; last > 0; --last) {
        for (std::size_t i = 0; i < last; ++i) {
          if (method == Method::kDeCasteljau) r[i] = a.add(a.mul(w.s, r[i]), a.mul(w.t, r[i + 1]));
          if (method == Method::kDeCasteljauFused) r[i] = a.fma(w.t, r[i + 1], a.mul(w.s, r[i]));
          if (method == Method::kLerp) r[i] = a.add(r[i], a.mul(w.t, a.sub(r[i + 1], r[i])));
          if (method == Method::kLerpFused) r[i] = a.fma(w.t, a.sub(r[i + 1], r[i]), r[i]);
        }
      }
      return r[0];
    case Method::kHorner:
    case Method::kHornerFused: {
      // The binomial coefficient is computed incrementally, with reciprocals.
      long double sum = r[0], binomial = 1, power = 1;
      for (std::size_t i = 1; i <= n; ++i) {
        power = i == 1 ? w.t : a.mul(power, w.t);
        binomial = a.mul(a.mul(binomial, order - i), a.div(1, i));
        const long double factor = a.mul(binomial, power);
        sum = method == Method::kHorner ? a.add(a.mul(w.s, sum), a.mul(factor, r[i]))
                                        : a.fma(factor, r[i], a.mul(w.s, sum));
      }
      return sum;
    }
    case Method::kDirectSum: {
      std::vector<long double> powers(order, 1);  // powers of s
      for (std::size_t i = 1; i < order; ++i) powers[i] = i == 1 ? w.s : a.mul(powers[i - 1], w.s);
      long double sum = 0, binomial = 1, power = 1;  // power of t
      for (std::size_t i = 0; i <= n; ++i) {
        if (i > 0) {
          power = i == 1 ? w.t : a.mul(power, w.t);
          binomial = a.div(a.mul(binomial, order - i), i);
        }
        const long double term = a.mul(a.mul(a.mul(binomial, power), powers[n - i]), r[i]);
        sum = i == 0 ? term : a.add(sum, term);
      }
      return sum;
    }
  }
  return 0;
}

}  // namespace evalcts::reference
