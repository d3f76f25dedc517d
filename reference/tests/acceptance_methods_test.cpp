// Tests that every usual method to evaluate a map stays within the acceptance bound, in single precision and
// with errors of one part in 10^5 in every operation. The bound is not much wider than necessary.
#include <gtest/gtest.h>
#include <reference/acceptance.h>

#include <algorithm>
#include <iostream>

#include "perturbed.h"
#include "random_data.h"

namespace evalcts::reference {
namespace {

// Converts a long double exactly.
Rational rational(long double x) {
  const double high = static_cast<double>(x);
  return Rational(high) + Rational(static_cast<double>(x - high));
}

struct MethodCase {
  std::vector<double> points;
  double u1, u2;
  Argument u;

  int order() const { return static_cast<int>(points.size()); }
  Surface curve() const { return {points.data(), {1, order(), u1, u2}}; }
};

// Keeps the largest ratio of error and bound.
class Worst {
 public:
  ~Worst() { std::cout << "largest error / bound: " << largest_ << "\n"; }
  void record(const MethodCase& c, long double got, const Rational& exact, const Rational& bound,
              Method method) {
    const Rational error = abs(rational(got) - exact);
    if (!bound.is_zero()) largest_ = std::max(largest_, (error / bound).to_double());
    EXPECT_LE(error, bound) << "order " << c.order() << " u1 " << c.u1 << " u2 " << c.u2 << " u "
                            << c.u.value().to_double() << " method " << static_cast<int>(method);
  }
  double largest() const { return largest_; }

 private:
  double largest_ = 0;
};

long double evaluate_case(Arithmetic& a, const MethodCase& c, Parameter how, Method method) {
  return evaluate_by(a, method, {c.points.begin(), c.points.end()},
                     parameter(a, how, coordinate(a, c.u), c.u1, c.u2));
}

MethodCase random_case(std::mt19937_64& generator, int order) {
  const Data kinds[] = {Data::kFloats, Data::kFloats, Data::kIntegers, Data::kCancelling, Data::kSparse};
  const double domains[][2] = {{0, 1},  {0, 1},       {0, 1},       {2, 5},
                               {5, -2}, {0.1f, 0.7f}, {1000, 1008}, {-0x1p20, 0x1p-20}};
  const auto& domain = domains[pick(generator, 0, 7)];
  const double low = order <= 30 ? -0.5 : 0, high = order <= 30 ? 1.5 : 1;
  const double t = pick(generator, 0, 2) == 0 ? uniform(generator, low, high) : uniform(generator, 0, 1);
  const Argument u =
      pick(generator, 0, 3) == 0
          ? Argument::grid(pick(generator, 0, 13), 13, static_cast<float>(domain[0]), domain[1])
          : Argument::coordinate(static_cast<float>(domain[0] + t * (domain[1] - domain[0])));
  return {control_values(generator, kinds[pick(generator, 0, 4)], order), domain[0], domain[1], u};
}

TEST(EveryMethod, IsAcceptedInSinglePrecision) {
  std::mt19937_64 generator = make_generator();
  Worst worst;
  SinglePrecision arithmetic;
  for (int order = 1; order <= kMaxOrder; ++order) {
    for (int repetition = 0; repetition < (order <= 30 ? 15 : 3); ++repetition) {
      const MethodCase c = random_case(generator, order);
      if (!must_applies(c.curve(), c.u)) continue;
      const Acceptance acceptance = reference::acceptance(c.curve(), c.u);
      for (const Parameter how : kParameters) {
        for (const Method method : kMethods) {
          const long double got = evaluate_case(arithmetic, c, how, method);
          worst.record(c, got, acceptance.exact, acceptance.bound, method);
          EXPECT_TRUE(is_within(static_cast<float>(got), acceptance.exact, acceptance.bound));
        }
      }
    }
  }
}

// Magnitudes go down to the smallest subnormals, with gradual underflow and with flush to zero.
TEST(EveryMethod, IsAcceptedWhereSinglePrecisionUnderflows) {
  class FlushToZero : public Arithmetic {
   public:
    long double round(long double exact) override {
      const float rounded = static_cast<float>(exact);
      return std::abs(rounded) < std::numeric_limits<float>::min() ? 0.0f : rounded;
    }
  };
  std::mt19937_64 generator = make_generator();
  Worst worst;
  SinglePrecision gradual;
  FlushToZero flushed;
  for (int repetition = 0; repetition < 300; ++repetition) {
    MethodCase c = random_case(generator, pick(generator, 1, 30));
    for (double& point : c.points) point = std::ldexp(static_cast<float>(point), pick(generator, -149, 0));
    for (double& point : c.points) point = static_cast<float>(point);
    if (pick(generator, 0, 1)) c.u = Argument::coordinate(std::ldexp(1.0, pick(generator, -149, 0)));
    if (!must_applies(c.curve(), c.u)) continue;
    const Acceptance acceptance = reference::acceptance(c.curve(), c.u);
    for (const Parameter how : kParameters) {
      for (const Method method : kMethods) {
        worst.record(c, evaluate_case(gradual, c, how, method), acceptance.exact, acceptance.bound, method);
        worst.record(c, evaluate_case(flushed, c, how, method), acceptance.exact, acceptance.bound, method);
      }
    }
  }
}

// The implementation stores double arguments in single precision.
TEST(EveryMethod, IsAcceptedWhenInputsAreStoredInSinglePrecision) {
  std::mt19937_64 generator = make_generator();
  Worst worst;
  SinglePrecision arithmetic;
  for (int repetition = 0; repetition < 400; ++repetition) {
    const int order = pick(generator, 1, 30);
    const double u1 = uniform(generator, -3, 3), u2 = u1 + uniform(generator, 0.01, 3);
    const Argument u = pick(generator, 0, 1) ? Argument::coordinate(uniform(generator, u1, u2))
                                             : Argument::grid(pick(generator, 0, 9), 9, u1, u2);
    const MethodCase c{control_values(generator, Data::kDoubles, order), u1, u2, u};
    MethodCase stored = c;
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    std::transform(c.points.begin(), c.points.end(), stored.points.begin(), single);
    stored.u1 = single(u1);
    stored.u2 = single(u2);
    stored.u = u.is_grid() ? Argument::grid(u.index(), u.segments(), single(u.first()), single(u.last()))
                           : Argument::coordinate(single(u.coordinate()));
    const Acceptance acceptance = reference::acceptance(c.curve(), c.u);
    ASSERT_TRUE(acceptance.must_applies);
    for (const Parameter how : kParameters) {
      for (const Method method : kMethods) {
        worst.record(c, evaluate_case(arithmetic, stored, how, method), acceptance.exact, acceptance.bound,
                     method);
      }
    }
  }
}

TEST(EveryMethod, IsAcceptedWithRandomErrors) {
  std::mt19937_64 generator = make_generator();
  Worst worst;
  RandomErrors arithmetic(generator);
  for (int order = 1; order <= kMaxOrder; ++order) {
    for (int repetition = 0; repetition < (order <= 30 ? 10 : 2); ++repetition) {
      const MethodCase c = random_case(generator, order);
      const Rational exact = evaluate(c.curve(), c.u), bound = acceptance_bound(c.curve(), c.u);
      for (const Parameter how : kParameters) {
        for (const Method method : kMethods) {
          worst.record(c, evaluate_case(arithmetic, c, how, method), exact, bound, method);
        }
      }
    }
  }
}

TEST(EveryMethod, IsAcceptedWithTheWorstErrors) {
  std::mt19937_64 generator = make_generator();
  Worst worst;
  for (int order = 1; order <= kMaxOrder; order += order < 30 ? 1 : 17) {
    for (int repetition = 0; repetition < (order <= 12 ? 6 : 1); ++repetition) {
      const MethodCase c = random_case(generator, order);
      const Rational exact = evaluate(c.curve(), c.u), bound = acceptance_bound(c.curve(), c.u);
      for (const Method method : kMethods) {
        if (order > 30 && method != Method::kHorner && method != Method::kDirectSum)
          continue;  // too many operations
        const Parameter how = kParameters[pick(generator, 0, 2)];
        search_worst_errors(
            [&](Arithmetic& a) { return evaluate_case(a, c, how, method); },
            [&](Arithmetic& a) { worst.record(c, evaluate_case(a, c, how, method), exact, bound, method); });
      }
    }
  }
  // A bound far above all real errors would prove nothing about an implementation.
  EXPECT_GT(worst.largest(), 0.25);
}

TEST(EveryMethod, IsAcceptedOnSurfaces) {
  std::mt19937_64 generator = make_generator();
  RandomErrors random(generator);
  SignedErrors outward;
  double largest = 0;
  for (int repetition = 0; repetition < 150; ++repetition) {
    const int n = pick(generator, 0, 7), m = pick(generator, 0, 7);
    const MethodCase u = random_case(generator, n + 1), v = random_case(generator, m + 1);
    const std::vector<double> points = control_values(
        generator, pick(generator, 0, 1) ? Data::kFloats : Data::kCancelling, (n + 1) * (m + 1));
    const Surface surface{points.data(), {m + 1, n + 1, u.u1, u.u2}, {1, m + 1, v.u1, v.u2}};
    const Rational exact = evaluate(surface, u.u, v.u), bound = acceptance_bound(surface, u.u, v.u);
    for (Arithmetic* a : {static_cast<Arithmetic*>(&random), static_cast<Arithmetic*>(&outward)}) {
      for (const Method method : kMethods) {
        outward.restart();
        outward.signs.clear();
        const auto coordinate = [&](const MethodCase& c) {
          const long double x = c.u.is_grid()
                                    ? grid_point(*a, c.u.index(), c.u.segments(), c.u.first(), c.u.last())
                                    : static_cast<long double>(c.u.coordinate());
          return parameter(*a, kParameters[pick(generator, 0, 2)], x, c.u1, c.u2);
        };
        const Weights along_u = coordinate(u), along_v = coordinate(v);
        std::vector<long double> rows;
        for (int i = 0; i <= n; ++i) {
          const auto row = points.begin() + i * (m + 1);
          rows.push_back(evaluate_by(*a, method, {row, row + m + 1}, along_v));
        }
        const Rational error = abs(rational(evaluate_by(*a, method, rows, along_u)) - exact);
        EXPECT_LE(error, bound) << "degrees " << n << " " << m << " method " << static_cast<int>(method);
        largest = std::max(largest, (error / bound).to_double());
      }
    }
  }
  std::cout << "largest error / bound: " << largest << "\n";
}

}  // namespace
}  // namespace evalcts::reference
