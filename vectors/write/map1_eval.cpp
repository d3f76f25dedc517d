// Curves.
#include <cmath>
#include <limits>

#include <evalcts/gl/tokens.h>
#include "hardest.h"
#include "kinds.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

constexpr double kFloatMost = std::numeric_limits<float>::max();
constexpr double kFloatLeast = std::numeric_limits<float>::denorm_min();
constexpr double kDoubleMost = std::numeric_limits<double>::max();
constexpr double kDoubleLeast = std::numeric_limits<double>::denorm_min();

Direction domain_of(int order, double u1 = 0, double u2 = 1) { return {order, u1, u2}; }

Argument at(double u) { return Argument::coordinate(u); }

// A curve of simple numbers, or of full ones.
Map some_curve(Dice& dice, GLenum target, const Direction& u) {
  return curve(target, u, [&](int, int) { return simple(dice); });
}
Map full_curve(Dice& dice, GLenum target, const Direction& u, Type type) {
  return curve(target, u, [&](int, int) { return full(dice, type); });
}

// A place inside the domain, a multiple of a 64th of it as far as the type can say.
double inside(Dice& dice, const Direction& u, Type type) {
  return between(u.first, u.last, Rational(dice.below(65)) / 64, type);
}

// A small target for what grows with the order.
GLenum small_target(int i) {
  constexpr GLenum kTargets[] = {GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2};
  return kTargets[i % 3];
}

// --- ordinary

void ordinary(Document& document) {
  Theme theme(document, "ordinary",
              "every target with every order from 1 to 30, small numbers, arguments inside of the domain",
              {"EV-MAP1-BEZIER", "EV-MAP1-K", "EV-MAP1-COMPORDER", "EV-MAP1-ORDER-ALL", "EV-NUM-ACCURACY"});
  constexpr std::pair<double, double> kDomains[] = {{0, 1}, {0, 1}, {2, 5}, {-1, 1}, {1, 0}, {0, 10}};
  Dice& dice = theme.dice();
  for (const GLenum target : gl::kMap1Targets) {
    for (int order = 1; order <= 30; ++order) {
      for (const Type type : kTypes) {
        const auto [u1, u2] = dice.pick(kDomains);
        const Direction u = domain_of(order, u1, u2);
        const Map map = some_curve(dice, target, u);
        const bool detailed = order <= 6 && target == GL_MAP1_VERTEX_3;
        theme.add(value_case({map, type, at(inside(dice, u, type))},
                             detailed ? Detail::intermediate : Detail::none));
      }
    }
  }
}

void full_precision(Document& document) {
  Theme theme(document, "full-precision", "control values and arguments with all bits that their type has",
              {"EV-MAP1-BEZIER", "EV-NUM-ACCURACY"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 160; ++i) {
    const Type type = kTypes[i % 2];
    const GLenum target = gl::kMap1Targets[static_cast<std::size_t>(i) % 9];
    const Map map = full_curve(dice, target, domain_of(dice.between(2, 12)), type);
    theme.add(value_case({map, type, at(std::abs(dice.real(bits_of(type))))}));
  }
}

void high_orders(Document& document) {
  Theme theme(document, "high-order", "orders from 31 to 64, more than some implementations have",
              {"EV-MAP1-BEZIER", "EV-MAP1-ORDER-ALL", "EV-NUM-ACCURACY"});
  Dice& dice = theme.dice();
  for (int order = 31; order <= 64; ++order) {
    for (const Type type : kTypes) {
      for (const bool outside : {false, true}) {
        const Direction u = domain_of(order);
        const Map map = some_curve(dice, small_target(order), u);
        const double argument = outside ? -0.125 : inside(dice, u, type);
        theme.add(value_case({map, type, at(argument)}));
      }
    }
  }
}

void order_one(Document& document) {
  Theme theme(document, "order-one", "a single control point: a constant, whatever the argument",
              {"EV-MAP1-ORDER-ONE"});
  Dice& dice = theme.dice();
  constexpr double kArguments[] = {0, 0.5, -3, 7, 0x1p100};
  for (const GLenum target : gl::kMap1Targets)
    for (const Type type : kTypes)
      for (const double u : kArguments)
        if (dice.one_in(2) || u == 7)
          theme.add(value_case({full_curve(dice, target, domain_of(1), type), type, at(u)}));
}

void domains(Document& document) {
  struct Kind {
    const char *name, *meaning;
    std::vector<std::pair<double, double>> domains;
    Names requirements;
  };
  const Kind kKinds[] = {
      {"domain-huge",
       "long domains, up to 2^60",
       {{-0x1p32, 0x1p32}, {0, 0x1p40}, {-0x1p59, 0x1p59}, {1, 0x1p20}, {0, 16777213}, {-1e6, 3e7}},
       {"EV-MAP1-DOMAIN", "EV-NUM-RANGE-POS"}},
      {"domain-tiny",
       "short domains, at zero and away from it",
       {{1, 1 + 0x1p-23},
        {1, 1 + 0x1p-20},
        {-2, -2 + 0x1p-10},
        {0, 0x1p-60},
        {0, 0x1p-30},
        {0x1p-40, 0x1p-39}},
       {"EV-MAP1-DOMAIN"}},
      {"domain-reversed",
       "u1 > u2",
       {{1, 0}, {5, -2}, {0.75, 0.125}, {1000, 10}, {-1, -3}},
       {"EV-MAP1-DOMAIN", "EV-MAP1-REVERSED"}},
      {"domain-negative",
       "domains on the negative side",
       {{-3, -1}, {-1000, -10}, {-0.75, -0.5}, {-7, 0}},
       {"EV-MAP1-DOMAIN"}},
      {"domain-offset",
       "domains that are short beside their distance from zero, so that their width cancels",
       {{1000, 1001}, {1e6, 1e6 + 1}, {-4096, -4095.5}, {16777210, 16777215}, {100000, 100000.125}},
       {"EV-MAP1-DOMAIN", "EV-NUM-DOMAINSHIFT"}},
      {"domain-inexact",
       "domains whose ends and widths are no short binary numbers",
       {{0.1, 0.7}, {-0.3, 1.1}, {1e-3, 2e-3}, {3.3, -1.7}, {1.0 / 3, 2.0 / 3}},
       {"EV-MAP1-DOMAIN"}}};
  for (const auto& [name, meaning, ends, requirements] : kKinds) {
    Theme theme(document, name, meaning, requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 60; ++i) {
      const Type type = kTypes[i % 2];
      const auto [u1, u2] = ends[static_cast<std::size_t>(i / 2) % ends.size()];
      const Direction u = domain_of(dice.between(2, 8), rounded(u1, type), rounded(u2, type));
      const GLenum target = gl::kMap1Targets[static_cast<std::size_t>(dice.below(9))];
      const Map map = some_curve(dice, target, u);
      theme.add(value_case({map, type, at(inside(dice, u, type))}));
    }
  }
}

void ends(Document& document) {
  Theme theme(document, "at-an-end", "exactly at u1 or at u2: the first or the last control point",
              {"EV-MAP1-ZEROPOW", "EV-NUM-START", "EV-NUM-END"});
  constexpr std::pair<double, double> kDomains[] = {{0, 1}, {2, 5}, {1, 0}, {0.1, 0.7}, {-1000, -10}};
  Dice& dice = theme.dice();
  for (int order = 1; order <= 30; ++order) {
    for (const Type type : kTypes) {
      for (const bool last : {false, true}) {
        const auto [u1, u2] = dice.pick(kDomains);
        const Direction u = domain_of(order, rounded(u1, type), rounded(u2, type));
        const Map map = full_curve(dice, small_target(order), u, type);
        theme.add(value_case({map, type, at(last ? u.last : u.first)}));
      }
    }
  }
}

void near_ends(Document& document) {
  Theme theme(document, "next-to-an-end", "the numbers next to u1 and u2, on either side",
              {"EV-MAP1-BEZIER", "EV-NUM-START", "EV-NUM-END"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    const Direction u = i % 4 < 2 ? domain_of(dice.between(2, 8), 1, 3) : domain_of(dice.between(2, 5));
    const Map map = some_curve(dice, small_target(i), u);
    const double end = i % 8 < 4 ? u.first : u.last;
    // Next to zero is the least subnormal number: a step of 2^-24 is enough there.
    const double towards = dice.one_in(2) ? 100 : -100;
    const double argument = end == 0 ? std::copysign(0x1p-24, towards) : next_after(end, towards, type);
    theme.add(value_case({map, type, at(argument)}));
  }
}

void outside(Document& document) {
  Theme theme(document, "outside", "arguments outside of the domain: neither clamped nor an error",
              {"EV-MAP1-EXTRAPOLATE"});
  constexpr double kParts[] = {-0.25, -1.5, 2.5, 1.0625, -7, 20};
  constexpr std::pair<double, double> kDomains[] = {{0, 1}, {2, 5}, {1, 0}, {-1, 1}};
  Dice& dice = theme.dice();
  for (int i = 0; i < 120; ++i) {
    const Type type = kTypes[i % 2];
    const auto [u1, u2] = dice.pick(kDomains);
    const Direction u = domain_of(dice.between(2, 10), u1, u2);
    const Map map = some_curve(dice, gl::kMap1Targets[static_cast<std::size_t>(i) % 9], u);
    const Rational part = dice.pick(kParts);
    theme.add(value_case({map, type, at(between(u1, u2, part, type))}));
  }
}

void double_only(Document& document) {
  Theme theme(document, "double-only",
              "Map1d with numbers that no binary32 holds: an implementation may round them to one",
              {"EV-MAP1-BEZIER", "EV-API-FD", "EV-NUM-ACCURACY"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 90; ++i) {
    const double first = dice.real(53);
    const double width = dice.scaled(40, -3, 4);
    const double last = rounded(Rational(first) + Rational(width), Type::real);
    const Direction u = domain_of(dice.between(1, 7), first, last);
    const Map map = full_curve(dice, gl::kMap1Targets[static_cast<std::size_t>(i) % 9], u, Type::real);
    const Rational part = Rational(dice.real(53)) * (i % 3 == 0 ? 2 : 1);
    theme.add(value_case({map, Type::real, at(between(first, last, part, Type::real))}));
  }
}

// --- extreme

void magnitudes(Document& document) {
  struct Kind {
    const char *name, *meaning;
    Type type;
    int least, most;  // exponents of two of the control values
    Names requirements;
  };
  const Kind kKinds[] = {
      {"huge", "control values up to the largest binary32", Type::single, 90, 127, {"EV-NUM-RANGE-POS"}},
      {"promised-range",
       "control values up to 2^32, which every implementation can hold",
       Type::single,
       24,
       31,
       {"EV-NUM-RANGE-POS", "EV-NUM-RANGE-COLOR"}},
      {"tiny",
       "control values down to the least normal binary32",
       Type::single,
       -126,
       -100,
       {"EV-NUM-DENORMAL"}},
      {"subnormal",
       "control values that are subnormal in binary32",
       Type::single,
       -149,
       -127,
       {"EV-NUM-DENORMAL"}},
      {"wide", "huge and tiny control values side by side", Type::single, -120, 120, {"EV-NUM-ACCURACY"}},
      {"huge-double",
       "control values beyond the range of binary32",
       Type::real,
       128,
       1023,
       {"EV-NUM-SPECIAL-SAFE"}},
      {"tiny-double",
       "control values below the range of binary32",
       Type::real,
       -1074,
       -150,
       {"EV-NUM-DENORMAL"}}};
  for (const Kind& kind : kKinds) {
    Theme theme(document, kind.name, kind.meaning, kind.requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      const Direction u = domain_of(dice.between(1, 5));
      const GLenum target = gl::kMap1Targets[static_cast<std::size_t>(i) % 9];
      const Map map =
          curve(target, u, [&](int, int) { return of_magnitude(dice, kind.type, kind.least, kind.most); });
      theme.add(value_case({map, kind.type, at(static_cast<double>(dice.below(17)) / 16)}));
    }
  }
}

void overflow(Document& document) {
  Theme theme(
      document, "overflow",
      "the value rounds to infinity, or to the largest number just below (the rule does not judge it)",
      {"EV-NUM-SPECIAL-SAFE"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    const double most = type == Type::single ? kFloatMost : kDoubleMost;
    const int order = dice.between(2, 4);
    const double sign = dice.sign();
    // Inside the domain, constant: exactly the largest. Outside: beyond it by more or less.
    Values values(static_cast<std::size_t>(order), sign * most);
    if (i % 6 >= 2) values.front() = -sign * std::ldexp(most, -dice.between(1, 40));
    constexpr double kArguments[] = {0.5, 1, 1.25, 2, 1 + 0x1p-20, 1 + 0x1p-23};
    theme.add(value_case({index_curve(0, 1, values), type, at(kArguments[i % 6])}));
  }
  // Halfway between the largest number and the power of two above, and one step below: 2^128 - 2^103.
  for (const double sign : {1.0, -1.0}) {
    for (const double step : {0.0, 0x1p75}) {
      const double beyond = 0x1p128 - 0x1p103 - step;
      theme.add(value_case({index_curve(0, 1, {sign * beyond, sign * beyond}), Type::real, at(0.5)}));
    }
    const double step = 0x1p104;
    theme.add(value_case(
        {index_curve(0, 1, {sign * (kFloatMost - step), sign * kFloatMost}), Type::single, at(1.5)}));
    theme.add(value_case(
        {index_curve(0, 1, {sign * (kFloatMost - step), sign * kFloatMost}), Type::single, at(1.25)}));
  }
}

void underflow(Document& document) {
  Theme theme(document, "underflow",
              "the value is subnormal or rounds to zero (with its sign), though the control values are not",
              {"EV-NUM-DENORMAL"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 48; ++i) {
    const Type type = kTypes[i % 2];
    const int degree = dice.between(1, 6);
    // Only the last control value is not zero: V = R * u^n.
    const int exponent = -dice.between(126, degree == 1 ? 144 : 160) / degree;
    const double u = std::abs(std::ldexp(dice.significand(6), exponent));
    Values values(static_cast<std::size_t>(degree) + 1, 0.0);
    values.back() = dice.significand(8);
    theme.add(value_case({index_curve(0, 1, values), type, at(u)}));
  }
  // Half the least subnormal number, and a little more: 0, and that number.
  for (const double least : {kFloatLeast, kDoubleLeast}) {
    const Type type = least == kFloatLeast ? Type::single : Type::real;
    for (const double u : {0.5, 0.5 + 0x1p-20, 0.5 - 0x1p-20, 0.25, 0.75})
      for (const double sign : {1.0, -1.0})
        theme.add(value_case({index_curve(0, 1, {0, sign * least}), type, at(u)}));
  }
}

void extreme_arguments(Document& document) {
  Theme theme(document, "far-away", "arguments that are huge or tiny beside the domain",
              {"EV-MAP1-EXTRAPOLATE"});
  constexpr double kArguments[] = {0x1p60,    -0x1p31,  0x1p15,   1e6, 0x1p-100,
                                   -0x1p-126, 0x1p-149, -0x1p-60, 1e30};
  Dice& dice = theme.dice();
  for (const double u : kArguments)
    for (const Type type : kTypes)
      for (int order = 2; order <= 4; ++order)
        theme.add(value_case(
            {some_curve(dice, small_target(order), domain_of(order)), type, at(rounded(u, type))}));
}

// --- adversarial

// Control values, all integers, whose sum SUM C(n,i) * R_i / 2^n at 1/2 is an odd multiple of 1/2, `more`
// added to the numerator.
Values tied(Dice& dice, int n, int more) {
  Values values;
  std::int64_t sum = 0, binomial = 1;
  for (int i = 0; i <= n; ++i) {
    const std::int64_t value = (std::int64_t{1} << 23) + dice.below(std::int64_t{1} << 22);
    values.push_back(static_cast<double>(value));
    sum += binomial * value;
    binomial = binomial * (n - i) / (i + 1);
  }
  const std::int64_t whole = std::int64_t{1} << n;
  const std::int64_t missing = whole / 2 - sum % whole + more;
  values.back() += static_cast<double>(missing);
  return values;
}

void float_ties(Document& document) {
  Theme exactly(document, "tie-float", "exactly halfway between two binary32: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  Theme nearly(document, "near-tie-float", "just beside the middle of two binary32", {"EV-NUM-ACCURACY"});
  for (const auto& [theme, is_near] : {std::pair(&exactly, false), std::pair(&nearly, true)}) {
    Dice& dice = theme->dice();
    for (int i = 0; i < 72; ++i) {
      const int n = 1 + i % 12;
      const double sign = dice.sign();
      const int exponent = dice.between(-40, 40);
      const int more = !is_near ? 0 : dice.one_in(2) ? 1 : -1;
      if (is_near && n == 1) continue;  // half an integer: nothing lies between
      Values values = tied(dice, n, more);
      for (double& value : values) value = sign * std::ldexp(value, exponent);
      theme->add(value_case({index_curve(0, 1, values), kTypes[i / 12 % 2], at(0.5)}));
    }
  }
  // The middle of two numbers in the first two terms, and a crumb in the last that no few bits more would
  // see.
  for (int i = 0; i < 24; ++i) {
    const double a = std::abs(nearly.dice().significand(24));
    const double crumb = std::ldexp(i % 2 == 0 ? 1.0 : -1.0, -nearly.dice().between(60, 120));
    nearly.add(value_case({index_curve(0, 1, {4 * a, 0x1p-23, crumb}), kTypes[i / 2 % 2], at(0.5)}));
  }
}

void double_ties(Document& document) {
  Theme exactly(document, "tie-double", "exactly halfway between two binary64: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  Theme nearly(document, "near-tie-double", "just beside the middle of two binary64", {"EV-NUM-ACCURACY"});
  for (const auto& [theme, is_near] : {std::pair(&exactly, false), std::pair(&nearly, true)}) {
    Dice& dice = theme->dice();
    // (2^30 * R_0 - R_0 + R_1)/2^30 has 54 bits, the last of which is set where R_1 - R_0 is odd.
    for (int i = 0; i < 40; ++i) {
      const double sign = dice.sign();
      const std::int64_t first = (std::int64_t{1} << 23) + 2 + dice.below(std::int64_t{1} << 22);
      const std::int64_t second = first - 1 - 2 * dice.below(1 << 20);
      const double crumb = !is_near ? 0 : dice.power(-90, -30);
      const double a = sign * static_cast<double>(first), b = sign * static_cast<double>(second);
      // The crumb is the last control value of a quadratic whose others give the line.
      if (is_near)
        theme->add(value_case({index_curve(0, 1, {a, a, crumb}), kTypes[i % 2], at(0x1p-15)}));
      else
        theme->add(value_case({index_curve(0, 1, {a, b}), kTypes[i % 2], at(0x1p-30)}));
    }
    // Two neighbours.
    for (int i = 0; i < 30; ++i) {
      const double a = dice.significand(53), b = next_after(a, 4, Type::real);
      if (is_near)  // (a + 2*b + crumb)/4 is no tie, 2*(a + b)/4 + crumb/4 is one but for the crumb
        theme->add(value_case({index_curve(0, 1, {2 * a, b, 0x1p-80}), Type::real, at(0.5)}));
      else
        theme->add(value_case({index_curve(0, 1, {a, b}), Type::real, at(0.5)}));
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
              "Wilkinson's way: a product of (u - i/8), its coefficients rounded, at a root and next to it",
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
  Theme constant(document, "constant", "all control points equal: the value is that of each, wherever",
                 {"EV-NUM-CONVEX"});
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
                         order < 12 ? Detail::intermediate : Detail::none));

      if (order < 3) continue;
      // t^2 has the coefficients i*(i-1)/(n*(n-1)).
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

// --- rational curves

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
    const Direction u = domain_of(dice.between(1, 9));
    const int kind = i % 5;
    const Map map = curve(GL_MAP1_VERTEX_4, u, [&](int j, int c) {
      const double x = simple(dice);
      if (c < 3) return x;
      const double size = static_cast<double>(dice.between(1, 64)) / 16;
      if (kind == 0) return size;                             // positive
      if (kind == 1) return -size;                            // negative
      if (kind == 2) return std::ldexp(size, -12 * (j % 3));  // of very different size
      if (kind == 3) return x;                                // any: w may come near zero
      return j % 2 == 0 ? 1.0 : -1.0;                         // zero at 1/2, for even orders
    });
    const double argument = kind == 4 ? 0.5 : inside(dice, u, type);
    weights.add(value_case({map, type, at(argument)}, i < 10 ? Detail::intermediate : Detail::none));
  }
}

// --- found by search

void hardest(Document& document) {
  Theme theme(
      document, "hardest",
      "of all binary32 from 1/4 to 1 the arguments at which the value lies nearest to the middle of two "
      "binary32, found by trying all",
      {"EV-NUM-ACCURACY"});
  for (const int order : {2, 3, 4, 5, 8, 10}) {
    for (int i = 0; i < 2; ++i) {
      Values values;
      for (int k = 0; k < order; ++k) values.push_back(full(theme.dice(), Type::single));
      const Map map = index_curve(0, 1, values);
      for (const float argument : hardest_arguments(map.curve(0), 0x1p-2f, 1, 4)) {
        theme.add(value_case({map, Type::single, at(argument)}));
      }
    }
  }
}

}  // namespace

Document map1_eval() {
  Document document("map1_eval", "Values of one-dimensional maps (Map1f, Map1d, EvalCoord1).");
  ordinary(document);
  full_precision(document);
  high_orders(document);
  order_one(document);
  domains(document);
  ends(document);
  near_ends(document);
  outside(document);
  double_only(document);
  magnitudes(document);
  overflow(document);
  underflow(document);
  extreme_arguments(document);
  float_ties(document);
  double_ties(document);
  cancellation(document);
  special_nets(document);
  rational(document);
  hardest(document);
  return document;
}

}  // namespace evalcts::vectors
