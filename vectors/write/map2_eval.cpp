// Surfaces.
#include <cmath>
#include <limits>

#include <evalcts/gl/tokens.h>
#include "kinds.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

using Ends = std::pair<double, double>;

Direction along(int order, const Ends& ends = {0, 1}) { return {order, ends.first, ends.second}; }

Argument at(double u) { return Argument::coordinate(u); }

GLenum any_target(int i) { return gl::kMap2Targets[static_cast<std::size_t>(i) % 9]; }
// A small target for what has many control points.
GLenum small_target(int i) { return i % 2 == 0 ? GL_MAP2_INDEX : GL_MAP2_TEXTURE_COORD_2; }

Map some_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v) {
  return surface(target, u, v, [&](int, int, int) { return simple(dice); });
}
Map full_surface(Dice& dice, GLenum target, const Direction& u, const Direction& v, Type type) {
  return surface(target, u, v, [&](int, int, int) { return full(dice, type); });
}

double inside(Dice& dice, const Direction& u, Type type) {
  return between(u.first, u.last, Rational(dice.below(33)) / 32, type);
}

// A surface at a random place inside of its domain.
Json inside_case(Dice& dice, const Map& map, Type type, Detail detail = Detail::none) {
  const double u = inside(dice, map.u, type);
  const double v = inside(dice, map.v, type);
  return value_case({map, type, at(u), at(v)}, detail);
}

// --- ordinary

void ordinary(Document& document) {
  Theme theme(document, "ordinary", "all pairs of orders up to 8 by 8, small numbers, inside of the domain",
              {"EV-MAP2-BEZIER", "EV-MAP2-K", "EV-MAP2-ORDER-ALL", "EV-NUM-ACCURACY"});
  constexpr Ends kEnds[] = {{0, 1}, {0, 1}, {2, 5}, {-1, 1}, {1, 0}};
  Dice& dice = theme.dice();
  for (int uorder = 1; uorder <= 8; ++uorder) {
    for (int vorder = 1; vorder <= 8; ++vorder) {
      for (int i = 0; i < 5; ++i) {
        const Direction u = along(uorder, dice.pick(kEnds)), v = along(vorder, dice.pick(kEnds));
        const GLenum target = uorder * vorder > 24 ? small_target(i) : any_target(theme.count());
        const Map map = some_surface(dice, target, u, v);
        const bool detailed = i == 0 && uorder <= 4 && vorder <= 4;
        theme.add(inside_case(dice, map, kTypes[i % 2], detailed ? Detail::intermediate : Detail::none));
      }
    }
  }
}

void every_target(Document& document) {
  Theme theme(document, "every-target", "every target, with the two types", {"EV-MAP2-BEZIER", "EV-MAP2-K"});
  Dice& dice = theme.dice();
  for (const GLenum target : gl::kMap2Targets)
    for (const Type type : kTypes)
      for (const auto& [uorder, vorder] : {std::pair(2, 2), std::pair(4, 3), std::pair(3, 4)})
        theme.add(inside_case(dice, some_surface(dice, target, along(uorder), along(vorder)), type));
}

void every_order(Document& document) {
  Theme theme(document, "every-order", "every order from 1 to 30 in one direction, few points in the other",
              {"EV-MAP2-BEZIER", "EV-MAP2-ORDER-ALL", "EV-MAP2-ASYM"});
  Dice& dice = theme.dice();
  for (int order = 1; order <= 30; ++order) {
    for (const Type type : kTypes) {
      const int other = 1 + order % 4;
      theme.add(inside_case(dice, some_surface(dice, small_target(order), along(order), along(other)), type));
      theme.add(inside_case(dice, some_surface(dice, small_target(order), along(other), along(order)), type));
    }
  }
}

void high_orders(Document& document) {
  Theme theme(document, "high-order", "orders from 9 to 64 in both directions, or in one",
              {"EV-MAP2-BEZIER", "EV-MAP2-ORDER-ALL", "EV-MAP2-ASYM"});
  constexpr std::pair<int, int> kOrders[] = {
      {9, 9},  {12, 12}, {16, 16}, {30, 30}, {30, 2},  {2, 30}, {17, 5}, {5, 17},  {64, 1},  {1, 64},
      {64, 2}, {2, 64},  {40, 3},  {3, 40},  {33, 33}, {31, 1}, {1, 31}, {20, 10}, {10, 20}, {64, 8}};
  Dice& dice = theme.dice();
  for (const auto& [uorder, vorder] : kOrders)
    for (const Type type : kTypes)
      theme.add(inside_case(dice, some_surface(dice, GL_MAP2_INDEX, along(uorder), along(vorder)), type));
}

void full_precision(Document& document) {
  Theme theme(document, "full-precision", "control values and arguments with all bits that their type has",
              {"EV-MAP2-BEZIER", "EV-NUM-ACCURACY"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 120; ++i) {
    const Type type = kTypes[i % 2];
    const int uorder = dice.between(1, 5), vorder = dice.between(1, 5);
    const GLenum target = uorder * vorder > 9 ? small_target(i) : any_target(i);
    const Map map = full_surface(dice, target, along(uorder), along(vorder), type);
    const double u = std::abs(dice.real(bits_of(type))), v = std::abs(dice.real(bits_of(type)));
    theme.add(value_case({map, type, at(u), at(v)}));
  }
}

void order_one(Document& document) {
  Theme theme(document, "order-one",
              "order 1 in one direction or in both: constant along it, whatever the argument",
              {"EV-MAP2-ORDER-ONE"});
  constexpr double kArguments[] = {0, 0.5, 1, -3, 7, 0x1p100};
  Dice& dice = theme.dice();
  for (int i = 0; i < 72; ++i) {
    const Type type = kTypes[i % 2];
    const int order = dice.between(2, 5);
    const Direction u = along(i % 3 == 0 ? order : 1), v = along(i % 3 == 1 ? order : 1);
    const Map map = full_surface(dice, any_target(i), u, v, type);
    const double far = dice.pick(kArguments), near = static_cast<double>(dice.below(9)) / 8;
    theme.add(value_case({map, type, at(u.order == 1 ? far : near), at(v.order == 1 ? far : near)}));
  }
}

void domains(Document& document) {
  struct Kind {
    const char *name, *meaning;
    std::vector<std::pair<Ends, Ends>> ends;
    Names requirements;
  };
  const Kind kKinds[] = {
      {"domain",
       "different intervals in the two directions",
       {{{2, 5}, {-1, 3}}, {{0, 10}, {0, 0.25}}, {{-7, -3}, {100, 104}}, {{0.5, 0.75}, {-1, 1}}},
       {"EV-MAP2-DOMAIN"}},
      {"domain-reversed",
       "u1 > u2, v1 > v2, or both",
       {{{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{1, 0}, {1, 0}}, {{5, -2}, {-3, 4}}, {{-1, 1}, {9, 7}}},
       {"EV-MAP2-DOMAIN", "EV-MAP2-REVERSED"}},
      {"domain-huge",
       "long domains, up to 2^60",
       {{{-0x1p32, 0x1p32}, {0, 1}}, {{0, 1}, {-0x1p59, 0x1p59}}, {{1, 0x1p20}, {-1e6, 3e7}}},
       {"EV-MAP2-DOMAIN", "EV-NUM-RANGE-POS"}},
      {"domain-tiny",
       "short domains, at zero and away from it",
       {{{1, 1 + 0x1p-20}, {0, 1}}, {{0, 1}, {0, 0x1p-60}}, {{-2, -2 + 0x1p-10}, {0x1p-40, 0x1p-39}}},
       {"EV-MAP2-DOMAIN"}},
      {"domain-offset",
       "domains that are short beside their distance from zero, so that their width cancels",
       {{{1000, 1001}, {0, 1}}, {{-4096, -4095.5}, {1e6, 1e6 + 1}}, {{0, 1}, {16777210, 16777215}}},
       {"EV-MAP2-DOMAIN", "EV-NUM-DOMAINSHIFT"}},
      {"domain-inexact",
       "domains whose ends and widths are no short binary numbers",
       {{{0.1, 0.7}, {-0.3, 1.1}}, {{1e-3, 2e-3}, {3.3, -1.7}}, {{1.0 / 3, 2.0 / 3}, {0, 1}}},
       {"EV-MAP2-DOMAIN"}}};
  for (const auto& [name, meaning, ends, requirements] : kKinds) {
    Theme theme(document, name, meaning, requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      const Type type = kTypes[i % 2];
      const auto& [u, v] = ends[static_cast<std::size_t>(i / 2) % ends.size()];
      const auto single = [&](const Ends& e) {
        return Ends(rounded(e.first, type), rounded(e.second, type));
      };
      const int uorder = dice.between(2, 4), vorder = dice.between(2, 4);
      const Map map = some_surface(dice, any_target(i), along(uorder, single(u)), along(vorder, single(v)));
      theme.add(inside_case(dice, map, type));
    }
  }
}

void edges(Document& document) {
  Theme corners(document, "corner", "exactly at a corner: its control point",
                {"EV-NUM-CORNERS", "EV-NUM-START", "EV-NUM-END"});
  Theme borders(document, "edge", "on an edge: the curve of the control points along it", {"EV-NUM-CORNERS"});
  constexpr Ends kEnds[] = {{0, 1}, {2, 5}, {1, 0}, {0.1, 0.7}, {-1000, -10}};
  for (int i = 0; i < 72; ++i) {
    const Type type = kTypes[i / 4 % 2];
    for (Theme* theme : {&corners, &borders}) {
      Dice& dice = theme->dice();
      const auto ends = [&] {
        const auto [first, last] = dice.pick(kEnds);
        return Ends(rounded(first, type), rounded(last, type));
      };
      const Ends u_ends = ends(), v_ends = ends();
      const Direction u = along(dice.between(1, 6), u_ends), v = along(dice.between(1, 6), v_ends);
      const Map map = full_surface(dice, small_target(i), u, v, type);
      const double u_end = i % 2 == 0 ? u.first : u.last, v_end = i / 2 % 2 == 0 ? v.first : v.last;
      if (theme == &corners)
        theme->add(value_case({map, type, at(u_end), at(v_end)}));
      else if (i % 2 == 0)
        theme->add(value_case({map, type, at(u_end), at(inside(dice, v, type))}));
      else
        theme->add(value_case({map, type, at(inside(dice, u, type)), at(v_end)}));
    }
  }
}

void outside(Document& document) {
  Theme theme(document, "outside", "arguments outside of the domain in one direction or both",
              {"EV-MAP2-EXTRAPOLATE"});
  constexpr double kParts[] = {-0.25, -1.5, 2.5, 1.0625, 0.5, 3};
  constexpr Ends kEnds[] = {{0, 1}, {2, 5}, {1, 0}, {-1, 1}};
  Dice& dice = theme.dice();
  for (int i = 0; i < 80; ++i) {
    const Type type = kTypes[i % 2];
    const Ends u_ends = dice.pick(kEnds), v_ends = dice.pick(kEnds);
    const Direction u = along(dice.between(2, 5), u_ends), v = along(dice.between(2, 5), v_ends);
    const Map map = some_surface(dice, any_target(i), u, v);
    const double x = between(u.first, u.last, Rational(dice.pick(kParts)), type);
    const double y = between(v.first, v.last, Rational(dice.pick(kParts)), type);
    theme.add(value_case({map, type, at(x), at(y)}));
  }
}

void double_only(Document& document) {
  Theme theme(document, "double-only",
              "Map2d with numbers that no binary32 holds: an implementation may round them to one",
              {"EV-MAP2-BEZIER", "EV-API-FD", "EV-NUM-ACCURACY"});
  Dice& dice = theme.dice();
  const auto direction = [&] {
    const double first = dice.real(53), width = dice.significand(40);
    return along(dice.between(1, 4), {first, rounded(Rational(first) + Rational(width), Type::real)});
  };
  for (int i = 0; i < 60; ++i) {
    const Direction u = direction(), v = direction();
    const Map map =
        full_surface(dice, u.order * v.order > 6 ? small_target(i) : any_target(i), u, v, Type::real);
    const double x = between(u.first, u.last, Rational(dice.real(53)), Type::real);
    const double y = between(v.first, v.last, Rational(dice.real(53)), Type::real);
    theme.add(value_case({map, Type::real, at(x), at(y)}));
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
    for (int i = 0; i < 20; ++i) {
      const Direction u = along(dice.between(1, 3)), v = along(dice.between(1, 3));
      const Map map = surface(small_target(i), u, v, [&](int, int, int) {
        return of_magnitude(dice, kind.type, kind.least, kind.most);
      });
      theme.add(inside_case(dice, map, kind.type));
    }
  }

  Theme overflow(document, "overflow", "the value rounds to infinity (the rule does not judge it)",
                 {"EV-NUM-SPECIAL-SAFE"});
  Theme underflow(
      document, "underflow",
      "the value is subnormal or rounds to zero (with its sign), though the control values are not",
      {"EV-NUM-DENORMAL"});
  for (int i = 0; i < 16; ++i) {
    const double sign = i % 4 < 2 ? 1 : -1;
    const double most = i % 2 == 0 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    const double outside = 1 + std::ldexp(1.0, -i);
    overflow.add(value_case({index_surface(along(2), along(2), {-sign * most, 1, 1, sign * most}),
                             kTypes[i % 2], at(outside), at(outside)}));
    const double small = std::ldexp(5.0, -65 - i);
    underflow.add(value_case(
        {index_surface(along(2), along(2), {0, 0, 0, sign * 1.5}), kTypes[i % 2], at(small), at(small)}));
  }
}

// --- adversarial

void ties(Document& document) {
  struct Kind {
    const char *name, *meaning;
    bool is_near;
  };
  for (const auto& [name, meaning, is_near] :
       {Kind{"tie-float", "exactly halfway between two binary32: rounds to the even one", false},
        Kind{"near-tie-float", "just beside the middle of two binary32", true}}) {
    Theme theme(document, name, meaning, {"EV-NUM-ACCURACY"});
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      // SUM C(n,i) * C(m,j) * R_ij / 2^(n+m) at (1/2, 1/2), the last control value chosen for a half.
      const int n = dice.between(1, 4), m = dice.between(1, 4);
      Values values;
      std::int64_t sum = 0, row = 1;
      for (int j = 0; j <= n; ++j, row = row * (n - j + 1) / j) {
        std::int64_t binomial = row;
        for (int k = 0; k <= m; ++k, binomial = binomial * (m - k + 1) / k) {
          const std::int64_t value = (std::int64_t{1} << 23) + dice.below(std::int64_t{1} << 22);
          values.push_back(static_cast<double>(value));
          sum += binomial * value;
        }
      }
      const std::int64_t whole = std::int64_t{1} << (n + m);
      const int more = !is_near ? 0 : dice.one_in(2) ? 1 : -1;
      const std::int64_t missing = whole / 2 - sum % whole + more;
      values.back() += static_cast<double>(missing);
      const double scale = dice.power(-30, 8);
      for (double& value : values) value *= scale;
      theme.add(
          value_case({index_surface(along(n + 1), along(m + 1), values), kTypes[i % 2], at(0.5), at(0.5)}));
    }
  }

  Theme doubles(document, "tie-double", "exactly halfway between two binary64: rounds to the even one",
                {"EV-NUM-ACCURACY"});
  for (int i = 0; i < 30; ++i) {
    const double a = doubles.dice().significand(53), b = next_after(a, 4, Type::real);
    doubles.add(value_case({index_surface(along(2), along(2), {a, b, b, a}), Type::real, at(0.5), at(0.5)}));
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
      // Odd in u about the middle.
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
  Theme constant(document, "constant", "all control points equal: the value is that of each, wherever",
                 {"EV-NUM-CONVEX"});
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
      one.add(inside_case(one.dice(), map, type, i < 8 ? Detail::intermediate : Detail::none));
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

// --- rational surfaces

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

}  // namespace

Document map2_eval() {
  Document document("map2_eval", "Values of two-dimensional maps (Map2f, Map2d, EvalCoord2).");
  ordinary(document);
  every_target(document);
  every_order(document);
  high_orders(document);
  full_precision(document);
  order_one(document);
  domains(document);
  edges(document);
  outside(document);
  double_only(document);
  magnitudes(document);
  ties(document);
  cancellation(document);
  special_nets(document);
  rational(document);
  return document;
}

}  // namespace evalcts::vectors
