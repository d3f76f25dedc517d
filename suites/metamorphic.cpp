// Section 17 of the requirements, metamorphic rules, which need no oracle: two maps that are the same
// polynomial, or of which one is a multiple of the other plus an offset, are evaluated by the same library.
//
// Points, domains and arguments of both are exact in single precision, so that no input is rounded. Both
// results may lie anywhere in their acceptance intervals (reference/acceptance.h): |a - p| <= Ea and
// |b - q| <= Eb with q = scale*p + offset imply |b - (scale*a + offset)| <= |scale|*Ea + Eb.
#include <fmt/format.h>
#include <reference/acceptance.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_metamorphic {
namespace {

using reference::Rational;

Rational bound_of(const Map& map, std::size_t component, const At& at) {
  const reference::Surface surface{map.points.data() + component,
                                   {map.ustride, map.uorder, map.u1, map.u2},
                                   {map.vstride, map.vorder, map.v1, map.v2}};
  return acceptance_bound(surface, reference::Argument::coordinate(at.u),
                          reference::Argument::coordinate(at.v));
}

float value_of(const ObservedVertex& vertex, GLenum target, std::size_t component) {
  switch (attribute_of(target)) {
    case kPosition:
      return vertex.position[component];
    case kColor:
      return vertex.color[component];
    case kNormal:
      return vertex.normal[component];
    default:
      return vertex.texture_coordinate[0][component];
  }
}

// --- Maps derived from other maps ------------------------------------------------------------------------

// Returns a map with the same target and domain, the orders, and the points value(i, j, component). Throws
// std::logic_error if a value is not exact in single precision.
template <class PointValue>
Map made_of(const Map& map, int uorder, int vorder, const PointValue& value) {
  std::vector<double> points;
  for (int i = 0; i < uorder; ++i)
    for (int j = 0; j < vorder; ++j)
      for (int component = 0; component < map.components(); ++component) {
        points.push_back(value(i, j, component));
        if (static_cast<double>(static_cast<float>(points.back())) != points.back())
          throw std::logic_error("a control point that is not exact in single precision");
      }
  return over(make_map2(map.target, uorder, vorder, points), {map.u1, map.u2}, {map.v1, map.v2});
}

double point(const Map& map, int i, int j, int component) {
  return map.points[static_cast<std::size_t>(i * map.ustride + j * map.vstride + component)];
}

Map reversed(const Map& map, bool along_u, bool along_v) {
  return made_of(map, map.uorder, map.vorder, [&](int i, int j, int component) {
    return point(map, along_u ? map.uorder - 1 - i : i, along_v ? map.vorder - 1 - j : j, component);
  });
}

Map scaled(const Map& map, double scale, double offset) {
  return made_of(map, map.uorder, map.vorder,
                 [&](int i, int j, int component) { return scale * point(map, i, j, component) + offset; });
}

Map transposed(const Map& map) {
  return over(made_of(map, map.vorder, map.uorder,
                      [&](int i, int j, int component) { return point(map, j, i, component); }),
              {map.v1, map.v2}, {map.u1, map.u2});
}

// Returns the same memory with u and v exchanged.
Map with_roles_swapped(Map map) {
  std::swap(map.u1, map.v1);
  std::swap(map.u2, map.v2);
  std::swap(map.ustride, map.vstride);
  std::swap(map.uorder, map.vorder);
  return map;
}

Rational binomial(int n, int k) {
  Rational value(1);
  for (int i = 0; i < k; ++i) value *= Rational(n - i) / Rational(i + 1);
  return value;
}

// Degree elevation in u to m = order - 1: Q_i = SUM over r of C(n,r) * C(m-n,i-r) / C(m,i) * R_r.
Map elevated_in_u(const Map& map, int order) {
  const int n = map.uorder - 1, m = order - 1;
  std::vector<std::vector<Rational>> weights;
  for (int i = 0; i <= m; ++i) {
    weights.emplace_back();
    for (int r = 0; r <= n; ++r) {
      const bool contributes = r <= i && i - r <= m - n;
      weights[static_cast<std::size_t>(i)].push_back(
          contributes ? binomial(n, r) * binomial(m - n, i - r) / binomial(m, i) : Rational());
    }
  }
  return made_of(map, order, map.vorder, [&](int i, int j, int component) {
    Rational sum;
    for (int r = 0; r <= n; ++r)
      sum += weights[static_cast<std::size_t>(i)][static_cast<std::size_t>(r)] *
             Rational(point(map, r, j, component));
    return sum.to_double();
  });
}

Map elevated(const Map& map, int uorder, int vorder) {
  const Map in_u = elevated_in_u(map, uorder);
  return vorder == map.vorder ? in_u : transposed(elevated_in_u(transposed(in_u), vorder));
}

// Returns a map of random points in [-1,1] that are multiples of unit * 2^-24.
Map random_multiples(Test& t, GLenum target, const Orders& orders, int unit) {
  Map map = random_map(t, target, orders);
  for (double& value : map.points) value = std::trunc(value * 0x1p24 / unit) * unit * 0x1p-24;
  return map;
}

// --- Relations -------------------------------------------------------------------------------------------

struct Side {
  std::vector<Map> maps;  // maps of the same dimension for different attributes
  std::vector<At> arguments;
};

struct SameUpTo {
  double scale = 1, offset = 0;
  bool bits = false;  // true if the bits have to be the same, -0 counting as +0
};

// Collects relations between maps in one case, which defines and evaluates all sides in turn, and checks
// them.
class Relations {
 public:
  Relations(Test& t, const std::string& identity) : t_(t), script_(identity) {}

  // Expects each value of `b` to be scale * (value of `a`) + offset. `what` describes `b` in messages.
  void add(const std::string& what, const Side& a, const Side& b, const SameUpTo& relation = {}) {
    const std::size_t first = draw(a);
    relations_.push_back({what, a, b, relation, first, draw(b)});
  }
  // Expects each value to lie between the least and the greatest of its control points.
  void add_convex(const Side& a) { convex_.push_back({a, draw(a)}); }

  void check() {
    shown_ = t_.shown_exactly(kUnit0);
    const Observation seen = t_.observe(script_, shown_, vertices_ + 8);
    seen_ = vertices_of(seen, vertices_);
    clamped_colors_ = seen.clamped_colors;
    for (const Relation& relation : relations_) check(relation);
    for (const Convex& convex : convex_) check(convex);
  }

 private:
  struct Relation {
    std::string what;
    Side a, b;
    SameUpTo relation;
    std::size_t first_a, first_b;
  };
  struct Convex {
    Side side;
    std::size_t first;
  };

  // Appends a side to the case. Returns the index of its first vertex.
  std::size_t draw(const Side& side) {
    for (const Map& map : side.maps) define_and_enable(script_, map);
    script_.Begin(GL_POINTS);
    for (const auto& [u, v] : side.arguments) eval_coord(script_, side.maps.front().two, u, v);
    script_.End();
    vertices_ += side.arguments.size();
    return vertices_ - side.arguments.size();
  }

  // Returns true if the value is not shown exactly: no capture shows its attribute, or a colour may have been
  // clamped to [0,1] by the capture.
  bool cannot_be_judged(GLenum target, float got) const {
    if (!(shown_ & attribute_of(target))) return true;
    return clamped_colors_ && attribute_of(target) == kColor && (got == 0.0f || got == 1.0f);
  }

  void check(const Relation& related) {
    const auto& [what, a, b, relation, first_a, first_b] = related;
    for (std::size_t m = 0; m < a.maps.size(); ++m)
      for (std::size_t i = 0; i < a.arguments.size(); ++i)
        for (std::size_t k = 0; k < static_cast<std::size_t>(a.maps[m].components()); ++k) {
          const float was = value_of(seen_[first_a + i], a.maps[m].target, k);
          const float is = value_of(seen_[first_b + i], b.maps[m].target, k);
          if (cannot_be_judged(a.maps[m].target, was) || cannot_be_judged(a.maps[m].target, is)) continue;
          double tolerance = 0;
          if (std::isfinite(was) && std::isfinite(is)) {
            const Rational scale(relation.scale);
            const Rational expected = scale * Rational(static_cast<double>(was)) + Rational(relation.offset);
            const Rational difference = Rational(static_cast<double>(is)) - expected;
            if (difference.is_zero()) continue;
            if (!relation.bits) {
              // A fast check that is stricter than the bound: Ea >= 4 * eps * |p|, because K is at least 4.
              if (std::abs(difference.to_double()) <= 1e-5 * std::abs(relation.scale * was)) continue;
              const Rational bound =
                  Rational(std::abs(relation.scale)) * bound_of(a.maps[m], k, a.arguments[i]) +
                  bound_of(b.maps[m], k, b.arguments[i]);
              if (difference <= bound && -bound <= difference) continue;
              tolerance = bound.to_double();
            }
          }
          fail(what, b.maps[m], b.arguments[i], k, is, relation.scale * was + relation.offset, tolerance,
               first_b + i);
        }
  }

  void check(const Convex& convex) {
    const Side& side = convex.side;
    for (const Map& map : side.maps)
      for (std::size_t i = 0; i < side.arguments.size(); ++i)
        for (std::size_t k = 0; k < static_cast<std::size_t>(map.components()); ++k) {
          const float got = value_of(seen_[convex.first + i], map.target, k);
          if (cannot_be_judged(map.target, got)) continue;
          double least = HUGE_VAL, greatest = -HUGE_VAL;
          for (int r = 0; r < map.uorder; ++r)
            for (int s = 0; s < map.vorder; ++s) {
              least = std::min(least, point(map, r, s, static_cast<int>(k)));
              greatest = std::max(greatest, point(map, r, s, static_cast<int>(k)));
            }
          if (got >= least && got <= greatest) continue;
          const double nearest = got > greatest ? greatest : least;
          const Rational bound = bound_of(map, k, side.arguments[i]);
          if (std::isfinite(got) && reference::is_within(got, Rational(nearest), bound)) continue;
          fail("leaves the range of its control points", map, side.arguments[i], k, got, nearest,
               bound.to_double(), convex.first + i);
        }
  }

  void fail(const std::string& what, const Map& map, const At& at, std::size_t component, float is,
            double expected, double tolerance, std::size_t vertex) {
    const std::string value =
        fmt::format("vertex {}, component {} of {}", vertex, component, gl::token_name(map.target));
    const std::string wanted = fmt::format("{:.9g} +- {:.3g}", expected, tolerance);
    const std::string captured = fmt::format("{:.9g} ({})", is, hexadecimal(is));
    const std::string message = fmt::format("{}: {} (order {}x{} at u = {}, v = {}) is {}, expected {}", what,
                                            value, map.uorder, map.vorder, at.u, at.v, captured, wanted);
    t_.fail(failure_of(script_, value, message, wanted, captured), [&] { return gl::all_calls(script_); });
  }

  Test& t_;
  gl::Case script_;
  std::size_t vertices_ = 0;
  std::vector<Relation> relations_;
  std::vector<Convex> convex_;
  std::vector<ObservedVertex> seen_;
  Attributes shown_ = 0;
  bool clamped_colors_ = false;
};

// --- Orders, arguments and maps --------------------------------------------------------------------------

std::vector<Orders> all_orders(Test& t, bool two) {
  const int max = t.max_order();
  if (!two) return {{1}, {2}, {3}, {4}, {5}, {8}, {std::min(13, max)}, {max}};
  return {{1, 1}, {2, 2}, {3, 4}, {4, 4}, {1, 5}, {6, 2}, {8, 7}, {max, 2}, {3, max}};
}

// Returns `count` pairs of multiples of 2^-6 in [0,1], beginning with (0,0) and (1,1).
std::vector<At> unit_arguments(Test& t, int count) {
  std::vector<At> all = {{0, 0}, {1, 1}};
  while (static_cast<int>(all.size()) < count)
    all.push_back({static_cast<double>(t.random()() % 65) / 64, static_cast<double>(t.random()() % 65) / 64});
  return all;
}
std::vector<At> unit_arguments(Test& t) { return unit_arguments(t, t.by_depth(4, 7, 60)); }

std::vector<At> over_domain(std::vector<At> unit, const Map& map) {
  for (auto& [u, v] : unit) {
    u = map.u1 + (map.u2 - map.u1) * u;
    v = map.v1 + (map.v2 - map.v1) * v;
  }
  return unit;
}

template <class Change>
std::vector<At> changed(std::vector<At> arguments, const Change& change) {
  for (At& at : arguments) at = change(at);
  return arguments;
}

template <class Change>
std::vector<Map> changed(std::vector<Map> maps, const Change& change) {
  for (Map& map : maps) map = change(map);
  return maps;
}

// Calls add(relations, kinds) with the targets of VERTEX_3 and of VERTEX_4 and three other attributes, and
// checks the relations that it adds.
template <class Add>
void expect_relations(Test& t, bool two, const std::string& identity, const Add& add) {
  for (const Kinds& kinds : two ? kKinds2 : kKinds1) {
    Relations relations(t, fmt::format("{}: {}", kinds.name, identity));
    add(relations, kinds);
    relations.check();
  }
}

std::vector<Map> random_maps(Test& t, const Kinds& kinds, const Orders& orders, int unit = 1 << 8) {
  std::vector<Map> maps;
  for (const GLenum target : kinds.targets) maps.push_back(random_multiples(t, target, orders, unit));
  return maps;
}

// --- EV-NUM-SYMMETRY -------------------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Metamorphic.ReversedCurve, Metamorphic.ReversedSurface, kMust,
                  decide("EV-NUM-SYMMETRY/1-D", "EV-NUM-SYMMETRY/2-D"), by(in_lists()))
(Test& t, bool two) {
  expect_relations(t, two, "points reversed", [&](Relations& relations, const Kinds& kinds) {
    for (const Orders& orders : all_orders(t, two)) {
      const std::vector<Map> maps = changed(random_maps(t, kinds, orders), [](const Map& map) {
        return over(map, {-2, 6}, {1, 3});
      });
      const Side plain = {maps, over_domain(unit_arguments(t), maps[0])};
      for (const auto& [u, v] : {std::pair{true, false}, {false, true}, {true, true}}) {
        if (v && !two) continue;
        const auto reverse = [&, u = u, v = v](const Map& map) { return reversed(map, u, v); };
        const auto reverse_domain = [&, u = u, v = v](const Map& map) {
          return over(map, {u ? map.u2 : map.u1, u ? map.u1 : map.u2},
                      {v ? map.v2 : map.v1, v ? map.v1 : map.v2});
        };
        const std::vector<At> mirrored = changed(plain.arguments, [&, u = u, v = v](const At& at) {
          return At{u ? 4 - at.u : at.u, v ? 4 - at.v : at.v};
        });
        relations.add("points reversed and arguments mirrored", plain, {changed(maps, reverse), mirrored});
        relations.add("points and domain reversed", plain,
                      {changed(changed(maps, reverse), reverse_domain), plain.arguments});
        relations.add("domain reversed and arguments mirrored", plain,
                      {changed(maps, reverse_domain), mirrored});
      }
    }
  });
};

// --- EV-NUM-ELEVATION ------------------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Metamorphic.ElevatedCurve, Metamorphic.ElevatedSurface, kMust,
                  decide("EV-NUM-ELEVATION/1-D", "EV-NUM-ELEVATION/2-D"), by(in_lists()))
(Test& t, bool two) {
  expect_relations(t, two, "a higher degree", [&](Relations& relations, const Kinds& kinds) {
    // All weights of elevation from degree 3 to m <= 7 are multiples of 1/420, so that elevated points are
    // exact.
    constexpr int kUnit = 420;
    const std::vector<Map> maps = random_maps(t, kinds, {4, two ? 4 : 1}, two ? kUnit * kUnit : kUnit);
    const Side plain = {maps, unit_arguments(t)};
    for (int order = 5; order <= 8; ++order)
      for (const auto& [uorder, vorder] : two ? std::vector<Orders>{{order, 4}, {4, order}, {order, order}}
                                              : std::vector<Orders>{{order, 1}})
        relations.add(
            "degree elevated", plain,
            {changed(maps, [&, u = uorder, v = vorder](const Map& map) { return elevated(map, u, v); }),
             plain.arguments});
    // A straight line can be elevated to any order.
    for (int order = 3; order <= t.max_order(); order += two || order > 10 ? 7 : 1) {
      const std::vector<Map> lines = random_maps(t, kinds, {2, two ? 2 : 1}, (order - 1) << 4);
      const Side line = {lines, unit_arguments(t, 4)};
      const auto straight = [&](const Map& map) { return elevated(map, order, map.vorder); };
      relations.add("a line of higher degree", line, {changed(lines, straight), line.arguments});
      if (!two) continue;
      const auto across = [&](const Map& map) { return elevated(map, 2, order); };
      relations.add("a line of higher degree", line, {changed(lines, across), line.arguments});
    }
  });
};

// --- EV-NUM-TRANSPOSE ------------------------------------------------------------------------------------

EVALCTS_TEST(Metamorphic, Transposed, kMust, "EV-NUM-TRANSPOSE", by(in_lists()))
(Test& t) {
  expect_relations(t, true, "u and v change their roles", [&](Relations& relations, const Kinds& kinds) {
    for (const Orders& orders : all_orders(t, true)) {
      const std::vector<Map> maps = changed(random_maps(t, kinds, orders), [](const Map& map) {
        return over(map, {0, 1}, {4, -1});
      });
      std::vector<At> arguments = over_domain(unit_arguments(t), maps[0]);
      if (orders.u * orders.v <= 16) arguments.push_back({-0.5, 4.5});
      const Side plain = {maps, arguments};
      const std::vector<At> swapped = changed(arguments, [](const At& at) { return At{at.v, at.u}; });
      relations.add("transposed", plain, {changed(maps, transposed), swapped});
      relations.add("strides swapped", plain, {changed(maps, with_roles_swapped), swapped});
    }
  });
};

// --- EV-NUM-AFFINE ---------------------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Metamorphic.MovedCurve, Metamorphic.MovedSurface, kMust,
                  decide("EV-NUM-AFFINE/1-D", "EV-NUM-AFFINE/2-D"), by(in_lists()))
(Test& t, bool two) {
  constexpr SameUpTo kChanges[] = {{1, 0.25}, {1, -8}, {0.5, 0}, {-4, 0}, {16, -4}};
  expect_relations(t, two, "points scaled and moved", [&](Relations& relations, const Kinds& kinds) {
    for (const Orders& orders : all_orders(t, two)) {
      const Side plain = {random_maps(t, kinds, orders), unit_arguments(t)};
      for (const SameUpTo& change : kChanges)
        relations.add(
            fmt::format("points times {} plus {}", change.scale, change.offset), plain,
            {changed(plain.maps, [&](const Map& map) { return scaled(map, change.scale, change.offset); }),
             plain.arguments},
            change);
    }
  });
};

// --- EV-NUM-CONVEX ---------------------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Metamorphic.ConvexHullOfCurve, Metamorphic.ConvexHullOfSurface, kMust,
                  decide("EV-NUM-CONVEX/1-D", "EV-NUM-CONVEX/2-D"), by(in_lists()))
(Test& t, bool two) {
  expect_relations(t, two, "inside the range of the points", [&](Relations& relations, const Kinds& kinds) {
    for (const Orders& orders : all_orders(t, two)) {
      const std::vector<At> arguments = unit_arguments(t, t.by_depth(8, 20, 200));
      const std::vector<Map> maps = random_maps(t, kinds, orders);
      relations.add_convex({maps, arguments});
      // All points are equal, so that the range is one value.
      relations.add_convex({changed(maps, [](const Map& map) { return scaled(map, 0, 0.625); }), arguments});
      // All points are 0 or 1.
      relations.add_convex({changed(maps,
                                    [](const Map& map) {
                                      return made_of(map, map.uorder, map.vorder, [&](int i, int j, int k) {
                                        return point(map, i, j, k) > 0 ? 1.0 : 0.0;
                                      });
                                    }),
                            arguments});
    }
  });
};

// --- EV-MAP2-SEPARABLE -----------------------------------------------------------------------------------

constexpr NamedValue<bool> kAlong[] = {{"ALONG_U", false}, {"ALONG_V", true}};

// A net that is constant in one direction has the values of the curve in the other direction.
EVALCTS_TEST(Metamorphic, CurveInSurface, kMust, "EV-MAP2-SEPARABLE", combine(kAlong).by(in_lists()))
(Test& t, const NamedValue<bool>& along) {
  for (std::size_t kind = 0; kind < std::size(kKinds1); ++kind) {
    Relations relations(t, fmt::format("{}: against the map of one dimension", kKinds1[kind].name));
    for (const int order : {1, 2, 3, 4, 8, t.max_order()})
      for (const int across : {1, 2, 3, 6}) {
        const std::vector<Map> curves = random_maps(t, kKinds1[kind], {order, 1});
        std::vector<Map> surfaces;
        for (std::size_t i = 0; i < curves.size(); ++i) {
          const Map& curve = curves[i];
          Map surface = made_of(curve, order, across,
                                [&](int r, int, int component) { return point(curve, r, 0, component); });
          surface.target = kKinds2[kind].targets[i];
          surface.two = true;
          surfaces.push_back(along.value ? transposed(surface) : surface);
        }
        std::vector<At> arguments = unit_arguments(t, t.by_depth(4, 6, 60));
        arguments.push_back({0.375, 1.25});
        arguments.push_back({0.75, -0.5});
        const std::vector<At> at = along.value ? changed(arguments,
                                                         [](const At& p) {
                                                           return At{p.v, p.u};
                                                         })
                                               : arguments;
        relations.add("constant across", {curves, arguments}, {surfaces, at});
      }
    relations.check();
  }
};

// --- EV-NUM-DOMAINSHIFT ----------------------------------------------------------------------------------

// Expects the same values after scaling domain and arguments by a power of two and adding an offset. Both are
// exact in single precision. Quotients by the widths of the domains, 3 and 5, are not, so that a large offset
// spoils the results of a library that computes u/(u2 - u1) - u1/(u2 - u1).
void expect_domain_shift(Test& t, bool two, bool bits) {
  struct Shift {
    double scale, offset;
  };
  constexpr Shift kShifts[] = {{1, 1},       {1, -2048},  {1, 131072}, {2, 0},
                               {0x1p-20, 0}, {0x1p20, 0}, {0.25, 64}};
  expect_relations(t, two, "domain moved and scaled", [&](Relations& relations, const Kinds& kinds) {
    for (const Orders& orders : all_orders(t, two)) {
      const std::vector<Map> maps = changed(random_maps(t, kinds, orders), [](const Map& map) {
        return over(map, {0.5, 3.5}, {3, -2});
      });
      const Side plain = {maps, over_domain(unit_arguments(t), over(maps[0], {0.5, 2.5}, {3, -1}))};
      for (const auto& [scale, offset] : kShifts) {
        const auto moved = [&, scale = scale, offset = offset](double x) { return scale * x + offset; };
        relations.add(
            fmt::format("domain and arguments times {} plus {}", scale, offset), plain,
            {changed(maps,
                     [&](const Map& map) {
                       return over(map, {moved(map.u1), moved(map.u2)}, {moved(map.v1), moved(map.v2)});
                     }),
             changed(plain.arguments,
                     [&](const At& at) {
                       return At{moved(at.u), moved(at.v)};
                     })},
            {.bits = bits});
      }
    }
  });
}

EVALCTS_TEST_PAIR(Metamorphic.ShiftedDomainOfCurve, Metamorphic.ShiftedDomainOfSurface, kMust,
                  decide("EV-NUM-DOMAINSHIFT/1-D", "EV-NUM-DOMAINSHIFT/2-D"), by(in_lists()))
(Test& t, bool two) { expect_domain_shift(t, two, false); };
// u - u1 and u2 - u1 are exact and their quotient is unchanged, so the formula of the specification gives the
// same bits.
EVALCTS_TEST_PAIR(Metamorphic.SameBitsOfCurve, Metamorphic.SameBitsOfSurface, kQuality,
                  decide("EV-NUM-DOMAINSHIFT/1-D", "EV-NUM-DOMAINSHIFT/2-D"), by(in_lists()))
(Test& t, bool two) { expect_domain_shift(t, two, true); };

}  // namespace
}  // namespace evalcts::suite_metamorphic
