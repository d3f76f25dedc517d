// Curves and surfaces of ordinary numbers: orders, domains, ends, arguments outside.
#include <cmath>

#include "eval.h"

namespace evalcts::vectors {

namespace curves {

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
        const Direction u = along(order, {u1, u2});
        const Map map = some_curve(dice, target, u);
        const bool detailed = order <= 6 && target == GL_MAP1_VERTEX_3;
        theme.add(value_case({map, type, at(inside(dice, u, type, 64))},
                             detailed ? Detail::kIntermediate : Detail::kNone));
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
    const Map map = full_curve(dice, target, along(dice.between(2, 12)), type);
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
        const Direction u = along(order);
        const Map map = some_curve(dice, small_target(order), u);
        const double argument = outside ? -0.125 : inside(dice, u, type, 64);
        theme.add(value_case({map, type, at(argument)}));
      }
    }
  }
}

void high_orders_of_targets(Document& document) {
  Theme theme(document, "high-order-targets",
              "every target with orders from 31 to 64, more than some implementations have",
              {"EV-MAP1-BEZIER", "EV-MAP1-ORDER-ALL", "EV-MAP1-K", "EV-MAP1-COMPORDER"});
  Dice& dice = theme.dice();
  const auto add = [&](int order, int target, Type type) {
    const Direction u = along(order);
    const Map map = some_curve(dice, gl::kMap1Targets[static_cast<std::size_t>(target % 9)], u);
    theme.add(value_case({map, type, at(inside(dice, u, type, 64))}));
  };
  for (int order = 31; order <= 63; ++order)
    for (int i = 0; i < 3; ++i) add(order, 3 * order + i + order / 3, kTypes[(order + i) % 2]);
  for (int target = 0; target < 9; ++target)
    for (const Type type : kTypes) add(64, target, type);
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
          theme.add(value_case({full_curve(dice, target, along(1), type), type, at(u)}));
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
       "domains that are short compared with their distance from zero, so that their width cancels",
       {{1000, 1001}, {1e6, 1e6 + 1}, {-4096, -4095.5}, {16777210, 16777215}, {100000, 100000.125}},
       {"EV-MAP1-DOMAIN", "EV-NUM-DOMAINSHIFT"}},
      {"domain-inexact",
       "domains whose ends and widths have many bits",
       {{0.1, 0.7}, {-0.3, 1.1}, {1e-3, 2e-3}, {3.3, -1.7}, {1.0 / 3, 2.0 / 3}},
       {"EV-MAP1-DOMAIN"}}};
  for (const auto& [name, meaning, ends, requirements] : kKinds) {
    Theme theme(document, name, meaning, requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 60; ++i) {
      const Type type = kTypes[i % 2];
      const auto [u1, u2] = ends[static_cast<std::size_t>(i / 2) % ends.size()];
      const Direction u = along(dice.between(2, 8), {rounded(u1, type), rounded(u2, type)});
      const GLenum target = gl::kMap1Targets[static_cast<std::size_t>(dice.below(9))];
      const Map map = some_curve(dice, target, u);
      theme.add(value_case({map, type, at(inside(dice, u, type, 64))}));
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
        const Direction u = along(order, {rounded(u1, type), rounded(u2, type)});
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
    const Direction u = i % 4 < 2 ? along(dice.between(2, 8), {1, 3}) : along(dice.between(2, 5));
    const Map map = some_curve(dice, small_target(i), u);
    const double end = i % 8 < 4 ? u.first : u.last;
    // The number adjacent to zero is the least subnormal one; 2^-24 is used instead.
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
    const Direction u = along(dice.between(2, 10), {u1, u2});
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
    const double last = rounded(Rational(first) + Rational(width), Type::kReal);
    const Direction u = along(dice.between(1, 7), {first, last});
    const Map map = full_curve(dice, gl::kMap1Targets[static_cast<std::size_t>(i) % 9], u, Type::kReal);
    const Rational part = Rational(dice.real(53)) * (i % 3 == 0 ? 2 : 1);
    theme.add(value_case({map, Type::kReal, at(between(first, last, part, Type::kReal))}));
  }
}

}  // namespace curves

namespace surfaces {

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
        theme.add(inside_case(dice, map, kTypes[i % 2], detailed ? Detail::kIntermediate : Detail::kNone));
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

void highest_orders(Document& document) {
  Theme both(document, "highest-order", "orders from 33 to 64 in both directions at once",
             {"EV-MAP2-BEZIER", "EV-MAP2-ORDER-ALL"});
  constexpr std::pair<int, int> kOrders[] = {{64, 64}, {40, 40}, {64, 33}, {35, 64}};
  for (std::size_t i = 0; i < 4; ++i)
    for (const Type type : kTypes) {
      if (i > 0 && type == kTypes[i % 2]) continue;  // both types for the largest orders only
      Dice& dice = both.dice();
      const Direction u = along(kOrders[i].first), v = along(kOrders[i].second);
      both.add(inside_case(dice, some_surface(dice, GL_MAP2_INDEX, u, v), type));
    }
  // Near the corner the last points matter. These nets have fewer than 64 by 64 points, for which the
  // accuracy rule accepts nearly everything, because the sum of binomials in its underflow term is 2^126.
  for (const auto& [uorder, vorder] : {std::pair(50, 50), std::pair(33, 64)}) {
    const Map map = some_surface(both.dice(), GL_MAP2_INDEX, along(uorder), along(vorder));
    both.add(value_case({map, kTypes[uorder % 2], at(0x1.f8p-1), at(0x1.f8p-1)}));
  }

  Theme targets(document, "high-order-targets",
                "every target with orders from 31 to 64 in one direction, up to 3 in the other",
                {"EV-MAP2-BEZIER", "EV-MAP2-ORDER-ALL", "EV-MAP2-K"});
  constexpr int kHigh[] = {31, 33, 36, 42, 50, 57, 63, 64};
  for (int target = 0; target < 9; ++target)
    for (int i = 0; i < 4; ++i) {
      Dice& dice = targets.dice();
      const Direction high = along(kHigh[(2 * target + i) % 8]), low = along(dice.between(1, 3));
      const Map map =
          some_surface(dice, any_target(target), i % 2 == 0 ? high : low, i % 2 == 0 ? low : high);
      targets.add(inside_case(dice, map, kTypes[i / 2]));
    }
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
       "domains that are short compared with their distance from zero, so that their width cancels",
       {{{1000, 1001}, {0, 1}}, {{-4096, -4095.5}, {1e6, 1e6 + 1}}, {{0, 1}, {16777210, 16777215}}},
       {"EV-MAP2-DOMAIN", "EV-NUM-DOMAINSHIFT"}},
      {"domain-inexact",
       "domains whose ends and widths have many bits",
       {{{0.1, 0.7}, {-0.3, 1.1}}, {{1e-3, 2e-3}, {3.3, -1.7}}, {{1.0 / 3, 2.0 / 3}, {0, 1}}},
       {"EV-MAP2-DOMAIN"}}};
  for (const auto& [name, meaning, ends, requirements] : kKinds) {
    Theme theme(document, name, meaning, requirements);
    Dice& dice = theme.dice();
    for (int i = 0; i < 40; ++i) {
      const Type type = kTypes[i % 2];
      const auto& [u, v] = ends[static_cast<std::size_t>(i / 2) % ends.size()];
      const int uorder = dice.between(2, 4), vorder = dice.between(2, 4);
      const Map map =
          some_surface(dice, any_target(i), along(uorder, rounded(u, type)), along(vorder, rounded(v, type)));
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
      const auto ends = [&] { return rounded(dice.pick(kEnds), type); };
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
    const double part_u = dice.pick(kParts), part_v = dice.pick(kParts);
    const bool is_inside = part_u == 0.5 && part_v == 0.5;
    const double x = between(u.first, u.last, Rational(part_u), type);
    const double y = between(v.first, v.last, Rational(is_inside ? 1.5 : part_v), type);
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
    return along(dice.between(1, 4), {first, rounded(Rational(first) + Rational(width), Type::kReal)});
  };
  for (int i = 0; i < 60; ++i) {
    const Direction u = direction(), v = direction();
    const Map map =
        full_surface(dice, u.order * v.order > 6 ? small_target(i) : any_target(i), u, v, Type::kReal);
    const double x = between(u.first, u.last, Rational(dice.real(53)), Type::kReal);
    const double y = between(v.first, v.last, Rational(dice.real(53)), Type::kReal);
    theme.add(value_case({map, Type::kReal, at(x), at(y)}));
  }
}

}  // namespace surfaces

}  // namespace evalcts::vectors
