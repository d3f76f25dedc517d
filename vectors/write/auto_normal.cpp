// Writes auto_normal.json: automatic normals.
#include <cmath>

#include "kinds.h"
#include "normals.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

// Returns a case with the map at random arguments inside its domain.
Json inside_case(Dice& dice, const Map& map, Type type) {
  const double u = inside(dice, map.u, type);
  const double v = inside(dice, map.v, type);
  return normal_case({map, type, at(u), at(v)});
}

// Return surfaces of VERTEX_3 and VERTEX_4 with the control values value(i, j, component).
Map three(const Direction& u, const Direction& v, const ValueOf& value) {
  return surface(GL_MAP2_VERTEX_3, u, v, value);
}
Map four(const Direction& u, const Direction& v, const ValueOf& value) {
  return surface(GL_MAP2_VERTEX_4, u, v, value);
}

// Returns a surface with the points (i, j, height) of small random heights, times `scale`.
Map landscape(Dice& dice, const Direction& u, const Direction& v, double scale = 1) {
  return three(u, v, [&](int i, int j, int c) {
    const double height = simple(dice);
    return scale * (c == 0 ? i : c == 1 ? j : height / 4);
  });
}

// --- Ordinary surfaces

void planes(Document& document) {
  Theme theme(document, "plane", "planes: the same normal everywhere",
              {"EV-AUTON-DIRECTION", "EV-AUTON-UNIT"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 60; ++i) {
    const Direction u = along(dice.between(2, 6)), v = along(dice.between(2, 6));
    double sides[2][3];
    for (auto& side : sides)
      for (double& x : side) x = simple(dice);
    // The sides of the first planes lie along the axes, so that the normals are exact, such as (0, 0, -1).
    if (i < 12)
      for (int c = 0; c < 3; ++c) {
        sides[0][c] = c == i % 3 ? 1 : 0;
        sides[1][c] = c == (i % 3 + 1 + i / 3 % 2) % 3 ? 1 : 0;
      }
    const Map map = three(u, v, [&](int j, int k, int c) { return j * sides[0][c] + k * sides[1][c]; });
    theme.add(inside_case(dice, map, kTypes[i % 2]));
  }
}

void curved(Document& document) {
  Theme theme(document, "curved", "ordinary curved surfaces", {"EV-AUTON-CURVED", "EV-AUTON-DIRECTION"});
  Dice& dice = theme.dice();
  for (int i = 0; i < 80; ++i) {
    const Direction u = along(dice.between(2, 5)), v = along(dice.between(2, 5));
    theme.add(inside_case(dice, landscape(dice, u, v), kTypes[i % 2]));
  }

  Theme saddle(document, "saddle", "z = x*y: normals in all directions, with lengths that are irrational",
               {"EV-AUTON-CURVED", "EV-AUTON-UNIT"});
  const Map map = three(along(2), along(2), [](int i, int j, int c) {
    return c == 0 ? i : c == 1 ? j : i * j;
  });
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      saddle.add(normal_case({map, kTypes[(i + j) % 2], at(i / 4.0), at(j / 4.0)}));

  Theme full_bits(document, "full-precision",
                  "control values and arguments with all bits that their type has", {"EV-AUTON-CURVED"});
  for (int i = 0; i < 40; ++i) {
    Dice& some = full_bits.dice();
    const Type type = kTypes[i % 2];
    const Direction u = along(some.between(2, 3)), v = along(some.between(2, 3));
    const Map random = three(u, v, [&](int, int, int) { return full(some, type); });
    const double x = std::abs(some.real(bits_of(type))), y = std::abs(some.real(bits_of(type)));
    full_bits.add(normal_case({random, type, at(x), at(y)}));
  }

  Theme high(document, "high-order", "orders from 6 to 30", {"EV-AUTON-CURVED"});
  constexpr std::pair<int, int> kOrders[] = {{6, 6},  {8, 8},  {10, 3}, {3, 10},
                                             {30, 2}, {2, 30}, {12, 4}, {4, 16}};
  for (const auto& [uorder, vorder] : kOrders)
    for (const Type type : kTypes)
      high.add(inside_case(high.dice(), landscape(high.dice(), along(uorder), along(vorder)), type));
}

void places(Document& document) {
  Theme borders(document, "border", "on the edges and at the corners of the domain", {"EV-AUTON-CURVED"});
  Theme outside(document, "outside", "arguments outside of the domain",
                {"EV-AUTON-CURVED", "EV-MAP2-EXTRAPOLATE"});
  for (int i = 0; i < 36; ++i) {
    {
      Dice& dice = borders.dice();
      const Direction u = along(dice.between(2, 5)), v = along(dice.between(2, 5));
      const Map map = landscape(dice, u, v);
      constexpr double kPlaces[] = {0, 0.5, 1};
      // The centre (0.5, 0.5) is replaced by a point of a border.
      const double x = kPlaces[i % 3], y = kPlaces[i / 3 % 3];
      borders.add(normal_case({map, kTypes[i % 2], at(x), at(x == 0.5 && y == 0.5 ? 1 : y)}));
    }
    Dice& dice = outside.dice();
    const Direction u = along(dice.between(2, 4)), v = along(dice.between(2, 4));
    const Map map = landscape(dice, u, v);
    const double x = 3 * dice.real(5), y = 3 * dice.real(5);
    const bool is_inside = x >= 0 && x <= 1 && y >= 0 && y <= 1;
    outside.add(normal_case({map, kTypes[i % 2], at(x), at(is_inside ? y + 1.5 : y)}));
  }

  Theme domains(document, "domain",
                "domains of another length or place than [0, 1]: the direction does not change",
                {"EV-AUTON-DIRECTION", "EV-MAP2-DOMAIN"});
  Theme reversed(document, "reversed",
                 "u1 > u2 or v1 > v2: either sign is accepted; with both, the sign is determined",
                 {"EV-AUTON-DIRECTION"});
  constexpr std::pair<Ends, Ends> kDomains[] = {
      {{2, 5}, {-1, 1}}, {{0, 0x1p-10}, {0, 1}}, {{0, 1000}, {0, 0.001}}, {{100, 101}, {-7, -5}}};
  constexpr std::pair<Ends, Ends> kReversed[] = {
      {{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{1, 0}, {1, 0}}, {{5, 2}, {1, -1}}};
  for (Theme* theme : {&domains, &reversed}) {
    Dice& dice = theme->dice();
    for (int i = 0; i < 32; ++i) {
      const Type type = kTypes[i % 2];
      const auto& [u, v] = theme == &domains ? kDomains[i / 2 % 4] : kReversed[i / 2 % 4];
      const int uorder = dice.between(2, 4), vorder = dice.between(2, 4);
      const Map map = landscape(dice, along(uorder, rounded(u, type)), along(vorder, rounded(v, type)));
      theme->add(inside_case(dice, map, type));
    }
  }

  Theme grids(document, "grid", "at the points of a grid, as EvalPoint2 and EvalMesh2 evaluate",
              {"EV-AUTON-MESH", "EV-POINT2-EQUIV"});
  for (int i = 0; i < 24; ++i) {
    Dice& dice = grids.dice();
    const Type type = kTypes[i % 2];
    const Direction u = along(dice.between(2, 4)), v = along(dice.between(2, 4));
    const Map map = landscape(dice, u, v);
    const Argument x = Argument::grid(dice.below(8), 7, 0, 1);
    const Argument y = Argument::grid(dice.below(11), 10, rounded(0.1, type), rounded(0.7, type));
    grids.add(normal_case({map, type, x, y}));
  }
}

// --- Rational surfaces

constexpr double kHalfRoot = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)

// Returns component c (cosine, sine, weight) of control point i of a rational quarter circle.
double circle(int i, int c, double w) {
  const double weight = i == 1 ? w : 1;
  return c == 0 ? (i < 2 ? weight : 0) : c == 1 ? (i > 0 ? weight : 0) : weight;
}

void rational(Document& document) {
  Theme cylinder(document, "cylinder",
                 "a quarter of a rational cylinder: its normals point away from the axis",
                 {"EV-AUTON-RATIONAL"});
  Theme sphere(
      document, "sphere",
      "an eighth of a rational sphere: its normals point away from the centre, and there is none at the pole",
      {"EV-AUTON-RATIONAL", "EV-AUTON-DEGENERATE"});
  for (const Type type : kTypes) {
    const double w = rounded(kHalfRoot, type);
    const Map round = four(along(3), along(2), [&](int i, int j, int c) {
      return c == 2 ? 2 * j * circle(i, 2, w) : circle(i, c == 3 ? 2 : c, w);
    });
    const Map ball = four(along(3), along(3), [&](int i, int j, int c) {
      // The points are products of two circles, the second of which goes from the equator to the pole.
      if (c == 2) return rounded(Rational(circle(i, 2, w)) * Rational(circle(j, 1, w)), type);
      return rounded(Rational(circle(i, c == 3 ? 2 : c, w)) * Rational(circle(j, c == 3 ? 2 : 0, w)), type);
    });
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) {
        if (j % 2 == 0) cylinder.add(normal_case({round, type, at(i / 4.0), at(j / 4.0)}));
        sphere.add(normal_case({ball, type, at(i / 4.0), at(j / 4.0)}));
      }
  }

  struct Kind {
    const char *name, *meaning;
    double (*weight)(Dice&, int i, int j);
  };
  const Kind kKinds[] = {
      {"weights", "four components, w from 1/16 to 4",
       [](Dice& dice, int, int) { return static_cast<double>(dice.between(1, 64)) / 16; }},
      {"negative-w", "w below zero throughout: the normal is that of (x/w, y/w, z/w)",
       [](Dice& dice, int, int) { return -static_cast<double>(dice.between(1, 64)) / 16; }},
      {"constant-w", "w is 2 everywhere: the normals of a surface of three components",
       [](Dice&, int, int) { return 2.0; }},
      {"either-w", "w from -8 to 8, nearly always of either sign",
       [](Dice& dice, int, int) { return simple(dice); }}};
  for (const auto& [name, meaning, weight] : kKinds) {
    Theme theme(document, name, meaning, {"EV-AUTON-RATIONAL"});
    Dice& dice = theme.dice();
    for (int i = 0; i < 30; ++i) {
      const Direction u = along(dice.between(2, 4)), v = along(dice.between(2, 4));
      const Map map = four(u, v, [&, weight = weight](int j, int k, int c) {
        if (c == 3) return weight(dice, j, k);
        const double height = simple(dice);
        return c == 0 ? 2 * j : c == 1 ? 2 * k : height;
      });
      theme.add(inside_case(dice, map, kTypes[i % 2]));
    }
  }

  Theme planar(document, "rational-plane", "a plane whose w varies: its normal does not change",
               {"EV-AUTON-RATIONAL"});
  for (int i = 0; i < 20; ++i) {
    Dice& dice = planar.dice();
    const Map map = four(along(3), along(3), [&](int j, int k, int c) {
      const double w = 1 + j + k * k;
      return c == 0 ? j * w : c == 1 ? k * w : c == 2 ? 0.0 : w;
    });
    planar.add(inside_case(dice, map, kTypes[i % 2]));
  }

  Theme no_w(document, "zero-w", "w = 0 at the point: there is no normal, and the GL must not crash or hang",
             {"EV-AUTON-DEGENERATE"});
  for (int i = 0; i < 12; ++i) {
    Dice& dice = no_w.dice();
    const Map map = four(along(2), along(i % 3 == 0 ? 3 : 2), [&](int j, int, int c) {
      const double x = simple(dice);
      return c < 3 ? x : i % 4 == 3 ? 0.0 : j == 0 ? 1.0 : -1.0;
    });
    no_w.add(normal_case({map, kTypes[i % 2], at(0.5), at(dice.one_in(2) ? 0.5 : 0.25)}));
  }
}

// --- Degenerate and extreme surfaces

void degenerate(Document& document) {
  const Names requirements = {"EV-AUTON-DEGENERATE"};
  Theme points(document, "one-point", "all control points equal: no derivative, no normal", requirements);
  Theme order(document, "order-one", "order 1 in a direction: no derivative along it, no normal",
              requirements);
  Theme lines(document, "collapsed-to-a-line", "derivatives that are parallel everywhere: no normal",
              requirements);
  Theme edges(document, "collapsed-edge",
              "an edge whose control points are equal: no normal on it, a normal near it", requirements);
  Theme folds(
      document, "corner-without-derivative",
      "the first two rows of control points equal: the analytic normal is undefined at u1, and only there",
      requirements);
  for (int i = 0; i < 12; ++i) {
    const Type type = kTypes[i % 2];
    const double x = full(points.dice(), type);
    points.add(
        normal_case({three(along(3), along(2), [&](int, int, int) { return x; }), type, at(0.25), at(0.5)}));

    const Direction u = along(i % 3 == 0 ? 3 : 1), v = along(i % 3 == 1 ? 3 : 1);
    order.add(normal_case({landscape(order.dice(), u, v), type, at(0.5), at(0.25)}));

    const Map line = three(along(3), along(3), [&](int j, int k, int c) { return (c + 1) * (j + 2 * k); });
    lines.add(inside_case(lines.dice(), line, type));

    Dice& dice = edges.dice();
    const Map pole = three(along(3), along(3), [&](int j, int k, int c) {
      const double height = simple(dice);
      return j == 0 ? (c == 2 ? 1.0 : 0.0) : c == 0 ? j : c == 1 ? j * (k - 1) : height;
    });
    constexpr double kDistances[] = {0, 0x1p-20, 0x1p-4, 0.5};
    edges.add(normal_case({pole, type, at(kDistances[i % 4]), at(0.25)}));

    const Map fold = three(along(3), along(3), [&](int j, int k, int c) {
      const int row = std::max(j, 1), column = k;
      return c == 0 ? row : c == 1 ? column : row * row + column;
    });
    folds.add(normal_case({fold, type, at(i % 3 == 0 ? 0.5 : 0.0), at(i / 3 % 2 == 0 ? 0.0 : 1.0)}));
  }
}

void extreme(Document& document) {
  Theme sizes(document, "size", "surfaces very small and very large: normals have length 1",
              {"EV-AUTON-UNIT", "EV-NUM-RANGE-POS"});
  constexpr int kExponents[] = {-140, -100, -60, -20, -14, -7, 7, 10, 14, 20, 28, 60, 100};
  for (const int exponent : kExponents)
    for (const Type type : kTypes)
      for (int i = 0; i < 2; ++i) {
        Dice& dice = sizes.dice();
        const Map map = landscape(dice, along(3), along(2), std::ldexp(1.0, exponent));
        sizes.add(inside_case(dice, map, type));
      }

  Theme parallel(
      document, "nearly-parallel",
      "nearly parallel derivatives: the rule applies as long as their difference is larger than the "
      "errors",
      {"EV-AUTON-DIRECTION", "EV-AUTON-METHOD"});
  for (int bits = 1; bits <= 20; ++bits)
    for (const Type type : kTypes) {
      Dice& dice = parallel.dice();
      const double little = std::ldexp(1.0, -bits);
      const Map map = three(along(2), along(2), [&](int i, int j, int c) {
        return c == 0 ? i + j : c == 1 ? i + (1 + little) * j : 0.0;
      });
      parallel.add(inside_case(dice, map, type));
    }

  Theme stretched(document, "stretched", "derivatives of very different length", {"EV-AUTON-UNIT"});
  for (int i = 0; i < 24; ++i) {
    Dice& dice = stretched.dice();
    const double along_u = dice.power(-12, 0), along_v = dice.power(0, 12);
    const Map map = three(along(3), along(3), [&](int j, int k, int c) {
      const double height = simple(dice);
      return c == 0 ? along_u * j : c == 1 ? along_v * k : std::ldexp(height, -14);
    });
    stretched.add(inside_case(dice, map, kTypes[i % 2]));
  }

  Theme offset(document, "offset",
               "surfaces whose x and y are moved by 1 to 2^19, so that differences cancel more and more",
               {"EV-AUTON-METHOD", "EV-AUTON-CURVED"});
  for (int i = 0; i < 20; ++i) {
    Dice& dice = offset.dice();
    const double far = std::ldexp(1.0, i);
    const Map map = three(along(3), along(3), [&](int j, int k, int c) {
      const double height = simple(dice);
      return far + (c == 0 ? j : c == 1 ? k : height);
    });
    offset.add(inside_case(dice, map, kTypes[i % 2]));
  }
}

// Adds surfaces of high orders with nets around the origin, evaluated near it, because elsewhere the errors
// of the values would exceed the differences of control points.
void highest_orders(Document& document) {
  Theme theme(document, "highest-order", "orders from 12 to 30 in both directions",
              {"EV-AUTON-CURVED", "EV-AUTON-RATIONAL"});
  constexpr std::pair<int, int> kOrders[] = {{12, 12}, {16, 30}, {20, 20}, {30, 16}, {30, 30}};
  for (const bool is_rational : {false, true})
    for (const auto& [uorder, vorder] : kOrders) {
      Dice& dice = theme.dice();
      const double u_middle = (uorder - 1) / 2.0, v_middle = (vorder - 1) / 2.0;
      const auto value = [&](int i, int j, int c) {
        if (c == 2) return simple(dice) / 16;
        if (c == 3) return 1 + std::abs(simple(dice)) / 64;
        return c == 0 ? i - u_middle : j - v_middle;
      };
      const Map map = is_rational ? four(along(uorder), along(vorder), value)
                                  : three(along(uorder), along(vorder), value);
      const double u = 0.5 + dice.real(4) / 16;
      const double v = 0.5 + dice.real(4) / 16;
      theme.add(normal_case({map, kTypes[theme.count() % 2], at(u), at(v)}));
    }
}

}  // namespace

Document auto_normal() {
  Document document("auto_normal", "Normals that GL_AUTO_NORMAL generates (no vertex shader or program).");
  planes(document);
  curved(document);
  places(document);
  rational(document);
  degenerate(document);
  extreme(document);
  highest_orders(document);
  return document;
}

}  // namespace evalcts::vectors
