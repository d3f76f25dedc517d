// Curves and surfaces that are hard to evaluate: ties, cancellation, special nets, weights of any sign.
#include <cmath>

#include "eval.h"
#include "hardest.h"

namespace evalcts::vectors {

namespace {

// From this degree on, a sum over 2^degree of integers is near a tie if its numerator is off by 1.
constexpr int kNearDegree = 7;

// Control values of one component whose weighted sum over 2^degree is exactly or nearly a tie of binary32.
class Tie {
 public:
  // Adds a random integer control value in [2^23, 3 * 2^22). The first weight is 1.
  void add(Dice& dice, std::int64_t weight) {
    values_.push_back(static_cast<double>((std::int64_t{1} << 23) + dice.below(std::int64_t{1} << 22)));
    weights_.push_back(weight);
  }

  // Returns the values after a change of the last one, whose weight is 1: the sum over 2^degree becomes an
  // odd multiple of 1/2, plus more / 2^degree. If the degree is so low that this is not near a tie, the last
  // value becomes a small fraction with the sign of `more` instead, and the sum of the others becomes a tie.
  Values values(int degree, int more) const {
    const std::int64_t whole = std::int64_t{1} << degree, half = whole / 2;
    Values values = values_;
    if (more == 0 || degree >= kNearDegree) {
      values.back() += static_cast<double>(half - sum(values) % whole + more);
      return values;
    }
    for (double& value : values) value += 0x1p22;
    values.back() = 0;
    values.front() += static_cast<double>(half - sum(values) % whole);
    if (values.front() >= 0x1p24) values.front() -= static_cast<double>(whole);
    values.back() = more * 0x1p-12;
    return values;
  }

 private:
  std::int64_t sum(const Values& values) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += weights_[i] * static_cast<std::int64_t>(values[i]);
    return sum;
  }

  Values values_;
  std::vector<std::int64_t> weights_;
};

}  // namespace

namespace curves {

namespace {

// Returns control values whose value at 1/2, SUM C(n,i) * R_i / 2^n, is a tie or near it, see Tie.
Values tied(Dice& dice, int n, int more) {
  Tie tie;
  std::int64_t binomial = 1;
  for (int i = 0; i <= n; ++i) {
    tie.add(dice, binomial);
    binomial = binomial * (n - i) / (i + 1);
  }
  return tie.values(n, more);
}

}  // namespace

void float_ties(Document& document) {
  Theme exactly(document, "tie-float", "exactly halfway between two binary32: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  Theme nearly(document, "near-tie-float", "near the midpoint of two binary32", {"EV-NUM-ACCURACY"});
  for (const auto& [theme, is_near] : {std::pair(&exactly, false), std::pair(&nearly, true)}) {
    Dice& dice = theme->dice();
    for (int i = 0; i < 72; ++i) {
      const int n = 1 + i % 12;
      const double sign = dice.sign();
      const int exponent = dice.between(-40, 40);
      const int more = !is_near ? 0 : dice.one_in(2) ? 1 : -1;
      if (is_near && n == 1) continue;  // the value is an integer or a tie
      Values values = tied(dice, n, more);
      for (double& value : values) value = sign * std::ldexp(value, exponent);
      theme->add(value_case({index_curve(0, 1, values), kTypes[i / 12 % 2], at(0.5)}));
    }
  }
  // The sum of the first two terms is a tie, and the last term is so small that a few more bits of precision
  // do not show it.
  for (int i = 0; i < 24; ++i) {
    const double a = std::abs(nearly.dice().significand(24));
    const double crumb = std::ldexp(i % 2 == 0 ? 1.0 : -1.0, -nearly.dice().between(60, 120));
    nearly.add(value_case({index_curve(0, 1, {4 * a, 0x1p-23, crumb}), kTypes[i / 2 % 2], at(0.5)}));
  }
}

void double_ties(Document& document) {
  Theme exactly(document, "tie-double", "exactly halfway between two binary64: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  Theme nearly(document, "near-tie-double", "near the midpoint of two binary64", {"EV-NUM-ACCURACY"});
  for (const auto& [theme, is_near] : {std::pair(&exactly, false), std::pair(&nearly, true)}) {
    Dice& dice = theme->dice();
    // (2^30 * R_0 - R_0 + R_1)/2^30 has 54 bits, the last of which is set if R_1 - R_0 is odd.
    for (int i = 0; i < 40; ++i) {
      const double sign = dice.sign();
      // With a crumb, R_0 is odd, so that the value is a tie except for the crumb.
      const std::int64_t first =
          ((std::int64_t{1} << 23) + 2 + dice.below(std::int64_t{1} << 22)) | (is_near ? 1 : 0);
      const std::int64_t second = first - 1 - 2 * dice.below(1 << 20);
      const double crumb = !is_near ? 0 : dice.power(-90, -30);
      const double a = sign * static_cast<double>(first), b = sign * static_cast<double>(second);
      // The crumb is the last control value of a quadratic curve; the others make the line.
      if (is_near)
        theme->add(value_case({index_curve(0, 1, {a, a, crumb}), kTypes[i % 2], at(0x1p-15)}));
      else
        theme->add(value_case({index_curve(0, 1, {a, b}), kTypes[i % 2], at(0x1p-30)}));
    }
    // Adjacent numbers a and b.
    for (int i = 0; i < 30; ++i) {
      const double a = dice.significand(53), b = next_after(a, 4, Type::kReal);
      if (is_near)  // the value is (2*a + 2*b + crumb)/4, a tie except for the crumb
        theme->add(value_case({index_curve(0, 1, {2 * a, b, 0x1p-80}), Type::kReal, at(0.5)}));
      else
        theme->add(value_case({index_curve(0, 1, {a, b}), Type::kReal, at(0.5)}));
    }
  }
}

void cancellation(Document& document) {
  Theme zero(document, "cancel-zero", "the terms cancel exactly: the value is zero, its magnitude is not",
             {"EV-NUM-ACCURACY"});
  for (int i = 0; i < 60; ++i) {
    Dice& dice = zero.dice();
    const Type type = kTypes[i % 2];
    const int order = dice.between(2, 24);
    Values values(static_cast<std::size_t>(order));
    for (int j = 0; j < order / 2; ++j) {
      values[static_cast<std::size_t>(j)] = full(dice, type);
      values[static_cast<std::size_t>(order - 1 - j)] = -values[static_cast<std::size_t>(j)];
    }
    constexpr std::pair<double, double> kDomains[] = {{0, 1}, {-1, 1}, {4, -2}};
    const auto [u1, u2] = dice.pick(kDomains);
    zero.add(value_case({index_curve(u1, u2, values), type, at((u1 + u2) / 2)}));
  }

  Theme nearly(
      document, "cancel-nearly",
      "(1 - 2u)^n, control values 1, -1, 1, ...: next to 1/2 hardly anything is left of a magnitude of 1",
      {"EV-NUM-ACCURACY", "EV-NUM-CONVEX"});
  for (int n = 1; n <= 24; ++n) {
    for (const Type type : kTypes) {
      for (int i = 0; i < 2; ++i) {
        Values values;
        for (int j = 0; j <= n; ++j) values.push_back(j % 2 == 0 ? 1 : -1);
        const double offset = nearly.dice().scaled(3, -12, -3);
        nearly.add(value_case({index_curve(0, 1, values), type, at(0.5 + offset)}));
      }
    }
  }

  Theme roots(document, "roots",
              "products of (u - i/8) as in Wilkinson's polynomial, with rounded coefficients, at a root and "
              "next to it",
              {"EV-NUM-ACCURACY"});
  for (int n = 2; n <= 16; ++n) {
    std::vector<Rational> zeros;
    for (int i = 1; i <= n; ++i) zeros.push_back(Rational(i) / (n <= 7 ? 8 : 32));
    const std::vector<Rational> coefficients = with_roots(zeros);
    for (const Type type : kTypes) {
      Values values;
      for (const Rational& x : coefficients) values.push_back(rounded(x, type));
      const Rational root = zeros[static_cast<std::size_t>(roots.dice().below(n))];
      const double u = rounded(root, type);
      roots.add(value_case({index_curve(0, 1, values), type, at(u)}));
      roots.add(value_case({index_curve(0, 1, values), type, at(next_after(u, 1, type))}));
    }
  }
}

void special_nets(Document& document) {
  Theme constant(document, "constant",
                 "all control points equal: the value is that of each, at every argument", {"EV-NUM-CONVEX"});
  Theme linear(document, "linear", "equally spaced control values: a straight line, however high the order",
               {"EV-NUM-ELEVATION", "EV-NUM-AFFINE"});
  Theme one(document, "one-point",
            "a single control value 1 among zeros: the Bernstein polynomials themselves, which sum up to 1",
            {"EV-MAP1-BEZIER", "EV-MAP1-ZEROPOW"});
  Theme elevated(
      document, "elevated",
      "one parabola, its degree elevated, with rounded coefficients: the same values for all orders",
      {"EV-NUM-ELEVATION"});
  for (int order = 2; order <= 30; ++order) {
    const auto count = static_cast<std::size_t>(order);
    for (const Type type : kTypes) {
      const double value = full(constant.dice(), type);
      constant.add(value_case({index_curve(0, 1, Values(count, value)), type, at(constant.dice().real(8))}));

      Values ramp;
      for (int i = 0; i < order; ++i) ramp.push_back(2 * i - 5);
      linear.add(value_case({index_curve(0, 4, ramp), type, at(4 + 6 * linear.dice().real(6))}));

      Values single(count, 0.0);
      single[static_cast<std::size_t>(one.dice().below(order))] = 1;
      const double u = one.dice().one_in(4) ? 1.5 : std::abs(one.dice().real(6));
      one.add(value_case({index_curve(0, 1, single), type, at(u)},
                         order < 12 ? Detail::kIntermediate : Detail::kNone));

      if (order < 3) continue;
      // The Bernstein coefficients of t^2 are i*(i-1)/(n*(n-1)).
      Values parabola;
      for (int i = 0; i < order; ++i)
        parabola.push_back(rounded(Rational(i * (i - 1)) / ((order - 1) * (order - 2)), type));
      elevated.add(value_case({index_curve(0, 1, parabola), type, at(0.375)}));
    }
  }

  Theme minus_zero(document, "minus-zero",
                   "control values and arguments -0: as good as 0, in a result as well", {"EV-NUM-DENORMAL"});
  for (const Type type : kTypes) {
    for (const double u : {0.0, -0.0, 0.5, 1.0, -1.0}) {
      minus_zero.add(value_case({index_curve(0, 1, {-0.0, -0.0}), type, at(u)}));
      minus_zero.add(value_case({index_curve(0, 1, {-0.0, 1, -0.0}), type, at(u)}));
      minus_zero.add(value_case({index_curve(-0.0, 2, {3, -0.0, 5, 1}), type, at(u)}));
    }
  }
}

void rational(Document& document) {
  Theme circle(document, "circle",
               "a rational quarter circle: every point at distance 1, up to its rounded weights",
               {"EV-ATTR-VERTEX4"});
  constexpr double kHalfRoot = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
  for (const Type type : kTypes) {
    const double w = rounded(kHalfRoot, type);
    const Values values = {1, 0, 0, 1, w, w, 0, w, 0, 1, 0, 1};
    const Map map{GL_MAP1_VERTEX_4, {3, 0, 1}, {}, values};
    for (int i = 0; i <= 16; ++i) circle.add(value_case({map, type, at(i / 16.0)}));
  }

  Theme weights(document, "weights", "rational curves: w of either sign, near zero, far from one",
                {"EV-ATTR-VERTEX4", "EV-MAP1-BEZIER"});
  Dice& dice = weights.dice();
  for (int i = 0; i < 90; ++i) {
    const Type type = kTypes[i % 2];
    const Direction u = along(dice.between(1, 9));
    const int kind = i % 5;
    const Map map = curve(GL_MAP1_VERTEX_4, u, [&](int j, int c) {
      const double x = simple(dice);
      if (c < 3) return x;
      const double size = static_cast<double>(dice.between(1, 64)) / 16;
      if (kind == 0) return size;                             // positive
      if (kind == 1) return -size;                            // negative
      if (kind == 2) return std::ldexp(size, -12 * (j % 3));  // very different magnitudes
      if (kind == 3) return x;                                // any sign: w may be near zero
      return j % 2 == 0 ? 1.0 : -1.0;                         // zero at 1/2, for even orders
    });
    const double argument = kind == 4 ? 0.5 : inside(dice, u, type, 64);
    weights.add(value_case({map, type, at(argument)}, i < 10 ? Detail::kIntermediate : Detail::kNone));
  }
}

void hardest(Document& document) {
  Theme theme(
      document, "hardest",
      "of all binary32 from 1/4 to 1 the arguments at which the value lies nearest to the midpoint of two "
      "binary32, found by trying all",
      {"EV-NUM-ACCURACY"});
  for (const int order : {2, 3, 4, 5, 8, 10}) {
    for (int i = 0; i < 2; ++i) {
      Values values;
      for (int k = 0; k < order; ++k) values.push_back(full(theme.dice(), Type::kSingle));
      const Map map = index_curve(0, 1, values);
      for (const float argument : hardest_arguments(map.curve(0), 0x1p-2f, 1, 4)) {
        theme.add(value_case({map, Type::kSingle, at(argument)}));
      }
    }
  }
}

}  // namespace curves

namespace surfaces {

void ties(Document& document) {
  struct Kind {
    const char *name, *meaning;
    bool is_near;
  };
  for (const auto& [name, meaning, is_near] :
       {Kind{"tie-float", "exactly halfway between two binary32: rounds to the even one", false},
        Kind{"near-tie-float", "near the midpoint of two binary32", true}}) {
    Theme theme(document, name, meaning, {"EV-NUM-ACCURACY"});
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      // The value at (1/2, 1/2) is SUM C(n,i) * C(m,j) * R_ij / 2^(n+m). The last control value makes it a
      // tie.
      const int n = dice.between(1, 4), m = dice.between(1, 4);
      Tie tie;
      std::int64_t row = 1;
      for (int j = 0; j <= n; ++j, row = row * (n - j + 1) / j) {
        std::int64_t binomial = row;
        for (int k = 0; k <= m; ++k, binomial = binomial * (m - k + 1) / k) tie.add(dice, binomial);
      }
      const int more = !is_near ? 0 : dice.one_in(2) ? 1 : -1;
      Values values = tie.values(n + m, more);
      const double scale = dice.power(-30, 8);
      for (double& value : values) value *= scale;
      theme.add(
          value_case({index_surface(along(n + 1), along(m + 1), values), kTypes[i % 2], at(0.5), at(0.5)}));
    }
  }

  Theme doubles(document, "tie-double", "exactly halfway between two binary64: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  for (int i = 0; i < 30; ++i) {
    const double a = doubles.dice().significand(53), b = next_after(a, 4, Type::kReal);
    doubles.add(value_case({index_surface(along(2), along(2), {a, b, b, a}), Type::kReal, at(0.5), at(0.5)}));
  }
}

void cancellation(Document& document) {
  Theme zero(document, "cancel-zero", "the terms cancel exactly: the value is zero, its magnitude is not",
             {"EV-NUM-ACCURACY"});
  Theme nearly(
      document, "cancel-nearly",
      "(1 - 2u)^n * (1 - 2v)^m, control values 1 and -1: hardly anything is left of a magnitude of 1",
      {"EV-NUM-ACCURACY", "EV-NUM-CONVEX"});
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    {
      Dice& dice = zero.dice();
      const Direction u = along(dice.between(2, 6)), v = along(dice.between(1, 6));
      // The map is an odd function of u about 1/2.
      Map map = full_surface(dice, GL_MAP2_INDEX, u, v, type);
      for (int j = 0; j < u.order; ++j)
        for (int k = 0; k < v.order; ++k) {
          const auto place = [&](int row) { return static_cast<std::size_t>(row * v.order + k); };
          double& value = map.points[place(j)];
          if (2 * j + 1 == u.order) value = 0;
          if (2 * j + 1 > u.order) value = -map.points[place(u.order - 1 - j)];
        }
      zero.add(value_case({map, type, at(0.5), at(inside(dice, v, type))}));
    }
    Dice& dice = nearly.dice();
    const Direction u = along(dice.between(2, 8)), v = along(dice.between(2, 8));
    const Map map = surface(GL_MAP2_INDEX, u, v, [](int j, int k, int) { return (j + k) % 2 == 0 ? 1 : -1; });
    const double x = 0.5 + dice.scaled(3, -12, -3);
    const double y = 0.5 + dice.scaled(3, -12, -3);
    nearly.add(value_case({map, type, at(x), at(y)}));
  }
}

void special_nets(Document& document) {
  Theme constant(document, "constant",
                 "all control points equal: the value is that of each, at every argument", {"EV-NUM-CONVEX"});
  Theme bilinear(document, "bilinear",
                 "control points of i, j and i*j: a bilinear surface, however high the orders",
                 {"EV-NUM-ELEVATION", "EV-COORD-ARGORDER"});
  Theme one(document, "one-point", "a single control value 1 among zeros: products of Bernstein polynomials",
            {"EV-MAP2-BEZIER"});
  Theme separable(document, "separable", "control points that are the same along v, or along u: a curve",
                  {"EV-MAP2-SEPARABLE"});
  for (int i = 0; i < 36; ++i) {
    const Type type = kTypes[i % 2];
    const auto directions = [](Dice& dice) {
      const Direction u = along(dice.between(2, 9));
      return std::pair(u, along(dice.between(2, 9)));
    };
    {
      const auto [u, v] = directions(constant.dice());
      const double value = full(constant.dice(), type);
      const Map map = surface(GL_MAP2_INDEX, u, v, [&](int, int, int) { return value; });
      const double x = constant.dice().real(7), y = constant.dice().real(7);
      constant.add(value_case({map, type, at(x), at(y)}));
    }
    {
      const auto [u, v] = directions(bilinear.dice());
      const Map map = surface(GL_MAP2_VERTEX_3, {u.order, 0, 4}, {v.order, -1, 1}, [](int j, int k, int c) {
        return c == 0 ? j : c == 1 ? k : j * k;
      });
      const double x = 2 + 3 * bilinear.dice().real(5), y = 2 * bilinear.dice().real(5);
      bilinear.add(value_case({map, type, at(x), at(y)}));
    }
    {
      const auto [u, v] = directions(one.dice());
      const int j = one.dice().between(0, u.order - 1), k = one.dice().between(0, v.order - 1);
      const Map map =
          surface(GL_MAP2_INDEX, u, v, [&](int p, int q, int) { return p == j && q == k ? 1 : 0; });
      one.add(inside_case(one.dice(), map, type, i < 8 ? Detail::kIntermediate : Detail::kNone));
    }
    {
      const auto [u, v] = directions(separable.dice());
      Values row;
      for (int j = 0; j < 9; ++j) row.push_back(full(separable.dice(), type));
      const Map map = surface(GL_MAP2_INDEX, u, v, [&](int j, int k, int) {
        return row[static_cast<std::size_t>(i % 4 < 2 ? j : k)];
      });
      separable.add(inside_case(separable.dice(), map, type));
    }
  }

  Theme transposed(document, "transposed",
                   "in pairs: the same surface with u and v exchanged, which has the same value",
                   {"EV-NUM-TRANSPOSE", "EV-COORD-ARGORDER", "EV-MAP2-ASYM"});
  for (int i = 0; i < 20; ++i) {
    const Type type = kTypes[i % 2];
    Dice& dice = transposed.dice();
    const Direction u = along(dice.between(1, 6), {0, 2}), v = along(dice.between(1, 6), {3, -1});
    const Map map = some_surface(dice, GL_MAP2_INDEX, u, v);
    const Map turned = surface(GL_MAP2_INDEX, v, u, [&](int j, int k, int) {
      return map.points[static_cast<std::size_t>(k * v.order + j)];
    });
    const double x = inside(dice, u, type), y = inside(dice, v, type);
    transposed.add(value_case({map, type, at(x), at(y)}));
    transposed.add(value_case({turned, type, at(y), at(x)}));
  }

  Theme minus_zero(document, "minus-zero",
                   "control values and arguments -0: as good as 0, in a result as well", {"EV-NUM-DENORMAL"});
  for (const Type type : kTypes) {
    for (const double u : {-0.0, 0.5, 1.0}) {
      minus_zero.add(
          value_case({index_surface(along(2), along(2), {-0.0, -0.0, -0.0, -0.0}), type, at(u), at(-0.0)}));
      minus_zero.add(
          value_case({index_surface(along(2), along(2), {-0.0, 3, -0.0, 5}), type, at(-0.0), at(u)}));
    }
  }
}

void rational(Document& document) {
  Theme cylinder(document, "cylinder",
                 "a quarter of a rational cylinder: x/w and y/w at distance 1 from the axis",
                 {"EV-ATTR-VERTEX4"});
  constexpr double kHalfRoot = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
  for (const Type type : kTypes) {
    const double w = rounded(kHalfRoot, type);
    const Map map = surface(GL_MAP2_VERTEX_4, along(3), along(2), [&](int i, int j, int c) {
      const double weight = i == 1 ? w : 1;
      const double circle[] = {i < 2 ? weight : 0, i > 0 ? weight : 0, j * 2 * weight, weight};
      return circle[c];
    });
    for (int i = 0; i <= 8; ++i) cylinder.add(value_case({map, type, at(i / 8.0), at((i * 3 % 9) / 8.0)}));
  }

  Theme weights(document, "weights", "rational surfaces: w of either sign, near zero, far from one",
                {"EV-ATTR-VERTEX4", "EV-MAP2-BEZIER"});
  Dice& dice = weights.dice();
  for (int i = 0; i < 60; ++i) {
    const Direction u = along(dice.between(1, 4)), v = along(dice.between(1, 4));
    const int kind = i % 4;
    const Map map = surface(GL_MAP2_VERTEX_4, u, v, [&](int j, int k, int c) {
      const double x = simple(dice);
      if (c < 3) return x;
      const double size = static_cast<double>(dice.between(1, 64)) / 16;
      if (kind == 0) return size;
      if (kind == 1) return -size;
      if (kind == 2) return std::ldexp(size, -12 * ((j + k) % 3));
      return x;
    });
    weights.add(inside_case(dice, map, kTypes[i % 2]));
  }
}

}  // namespace surfaces

}  // namespace evalcts::vectors
