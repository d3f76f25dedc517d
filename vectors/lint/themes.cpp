// The property of each theme, as a predicate on a case with its exact values.
#include "themes.h"

#include <fmt/format.h>
#include <reference/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "value_case.h"
#include "write/numbers.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;
using Claim = std::function<bool(const ValueCase&)>;

Rational power(int exponent) { return {std::ldexp(1.0, exponent)}; }

// --- Claims about values

Claim some_value(bool (*holds)(const Rational& value, const Rational& magnitude)) {
  return [=](const ValueCase& c) {
    for (std::size_t i = 0; i < c.values.size(); ++i)
      if (holds(c.values[i], c.magnitudes[i])) return true;
    return false;
  };
}

// Returns the number of the type adjacent to x in the direction of `towards`.
double next_after(double x, double towards, Type type) {
  if (type == Type::kReal) return std::nextafter(x, towards);
  return std::nextafter(static_cast<float>(x), static_cast<float>(towards));
}

// Returns the distance of x from the midpoint of the adjacent numbers of the type, as a fraction of their
// distance; 1/2 if x is a number of the type.
Rational distance_to_tie(const Rational& x, Type type) {
  const double nearest = rounded(x, type);
  if (!std::isfinite(nearest) || Rational(nearest) == x) return Rational(1) / 2;
  const double infinity = std::numeric_limits<double>::infinity();
  const double other = next_after(nearest, Rational(nearest) < x ? infinity : -infinity, type);
  const Rational gap = abs(Rational(other) - Rational(nearest));
  return Rational(1) / 2 - abs(x - Rational(nearest)) / gap;
}

Claim is_tie(Type type) {
  return [=](const ValueCase& c) {
    return std::ranges::any_of(c.values,
                               [&](const Rational& x) { return distance_to_tie(x, type).is_zero(); });
  };
}

// Claims that a value is no tie, but at most 2^-bits of the gap between two numbers away from one.
Claim is_near_tie(Type type, int bits) {
  return [=](const ValueCase& c) {
    return std::ranges::any_of(c.values, [&](const Rational& x) {
      const Rational distance = distance_to_tie(x, type);
      return !distance.is_zero() && distance <= power(-bits);
    });
  };
}

// Returns true if (x/w, y/w) has the distance 1 from the origin.
bool is_on_circle(const ValueCase& c) {
  if (c.values.size() != 4) return false;
  const Rational &x = c.values[0], &y = c.values[1], &w = c.values[3];
  return abs(x * x + y * y - w * w) <= power(-20) * w * w;
}

// --- Claims about control values

Claim all_points(bool (*holds)(double value)) {
  return [=](const ValueCase& c) { return std::ranges::all_of(c.map.points, holds); };
}

bool has_equal_points(const ValueCase& c) {
  const auto k = static_cast<std::size_t>(c.map.components());
  for (std::size_t i = k; i < c.map.points.size(); ++i)
    if (c.map.points[i] != c.map.points[i - k]) return false;
  return true;
}

bool is_line(const ValueCase& c) {
  const std::vector<double>& points = c.map.points;
  for (std::size_t i = 2; i < points.size(); ++i)
    if (points[i] - points[i - 1] != points[i - 1] - points[i - 2]) return false;
  return true;
}

bool is_unit(const ValueCase& c) {
  return std::ranges::count(c.map.points, 1.0) == 1 &&
         std::ranges::count(c.map.points, 0.0) == std::ssize(c.map.points) - 1;
}

bool spans(const ValueCase& c, int bits) {
  const auto less = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto [least, most] = std::ranges::minmax(c.map.points, less);
  return std::abs(most) >= std::ldexp(std::abs(least), bits);
}

// Claims a property of all w of a map with four components.
Claim all_w(bool (*holds)(double w)) {
  return [=](const ValueCase& c) {
    for (std::size_t i = 3; i < c.map.points.size(); i += 4)
      if (!holds(c.map.points[i])) return false;
    return true;
  };
}

bool has_four_components(const ValueCase& c) { return c.map.components() == 4; }

bool has_varying_w(const ValueCase& c) {
  const std::vector<double>& points = c.map.points;
  for (std::size_t i = 7; i < points.size(); i += 4)
    if (points[i] != points[3]) return true;
  return false;
}

double point(const ValueCase& c, int i, int j, int component) {
  return c.map.points[static_cast<std::size_t>((i * c.map.v.order + j) * c.map.components() + component)];
}

using HoldsAt = std::function<bool(int i, int j, int component)>;

// Returns true if the condition holds for each component of all R_ij with i < rows and j < columns.
bool all_of_net(const ValueCase& c, int rows, int columns, const HoldsAt& holds) {
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int component = 0; component < c.map.components(); ++component)
        if (!holds(i, j, component)) return false;
  return true;
}

bool is_bilinear(const ValueCase& c) {
  const int n = c.map.u.order, m = c.map.v.order;
  const auto p = [&](int i, int j, int k) { return Rational(point(c, i, j, k)); };
  return all_of_net(c, n - 2, m,
                    [&](int i, int j, int k) { return p(i, j, k) + p(i + 2, j, k) == 2 * p(i + 1, j, k); }) &&
         all_of_net(c, n, m - 2,
                    [&](int i, int j, int k) { return p(i, j, k) + p(i, j + 2, k) == 2 * p(i, j + 1, k); });
}

bool is_separable(const ValueCase& c) {
  const int n = c.map.u.order, m = c.map.v.order;
  return all_of_net(c, n, m, [&](int i, int j, int k) { return point(c, i, j, k) == point(c, 0, j, k); }) ||
         all_of_net(c, n, m, [&](int i, int j, int k) { return point(c, i, j, k) == point(c, i, 0, k); });
}

// Returns true if rows 0 and 1, or the points of row 0, are equal, and there is no normal at u1 only.
bool has_normal_away_from_row(const ValueCase& c, bool is_row_doubled) {
  if (c.map.u.order == 1) return false;
  const bool is_equal = all_of_net(c, 1, c.map.v.order, [&](int, int j, int k) {
    return point(c, 0, j, k) == (is_row_doubled ? point(c, 1, j, k) : point(c, 0, 0, k));
  });
  return is_equal && c.entry["normal"].is_null() == c.directions[0].t.is_zero();
}

int significant_bits(double x) {
  int exponent = 0, bits = 0;
  for (double rest = std::frexp(x, &exponent); rest != 0; ++bits) rest = 2 * rest - std::trunc(2 * rest);
  return bits;
}

// Claims that some control value has all bits of its type but 2 and the arguments have all but 13, because
// the last bits of random numbers may be 0.
bool has_all_bits(const ValueCase& c) {
  return std::ranges::any_of(c.map.points,
                             [&](double x) { return significant_bits(x) >= bits_of(c.type) - 2; }) &&
         std::ranges::all_of(c.directions, [&](const ValueDirection& d) {
           return !d.argument.is_grid() && significant_bits(d.argument.coordinate()) >= bits_of(c.type) - 13;
         });
}

// --- Claims about normals

using Vector = std::array<Rational, 3>;

Vector vector_of(const json& fractions) {
  return {rational(fractions[0]), rational(fractions[1]), rational(fractions[2])};
}
Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Returns true if all control points lie in a plane that is perpendicular to m.
bool is_plane(const ValueCase& c) {
  const json& m = c.entry["m"];
  if (m.is_null()) return false;
  const Vector normal = vector_of(m);
  const auto k = static_cast<std::size_t>(c.map.components());
  const std::vector<double>& points = c.map.points;
  for (std::size_t i = 0; i < points.size(); i += k) {
    Vector side;
    for (std::size_t d = 0; d < 3; ++d)
      side[d] = k == 4 ? Rational(points[i + d]) * points[3] - Rational(points[d]) * points[i + 3]
                       : Rational(points[i + d]) - Rational(points[d]);
    if (!dot(normal, side).is_zero()) return false;
  }
  return true;
}

// Returns true if the map is the surface z = x*y.
bool is_saddle(const ValueCase& c) {
  if (c.map.components() != 3) return false;
  for (std::size_t i = 0; i < c.map.points.size(); i += 3)
    if (c.map.points[i] * c.map.points[i + 1] != c.map.points[i + 2]) return false;
  return is_bilinear(c);
}

// Claims that the normal has the direction of the first `count` components of the point, up to its rounded
// weights, or that there is none at the end of v, the pole.
Claim is_radial(int count) {
  return [=](const ValueCase& c) {
    const json& m = c.entry["m"];
    if (c.entry["normal"].is_null()) return c.directions[1].t == 1;
    const auto map = std::make_shared<const Map>(c.map);
    Vector away;
    for (int d = 0; d < count; ++d)
      away[static_cast<std::size_t>(d)] = exact(reference::Component(
          reference::Sample(map, d, c.directions[0].argument, c.directions[1].argument)));
    const Vector normal = vector_of(m);
    const Rational along = dot(normal, away), squares = dot(normal, normal) * dot(away, away);
    return along > 0 && along * along >= (Rational(1) - power(-40)) * squares;
  };
}

// Returns the squares of the lengths of the derivatives of a surface without w.
std::pair<Rational, Rational> squares_of_derivatives(const ValueCase& c) {
  const Vector a = vector_of(c.entry["derivatives"]["u"]), b = vector_of(c.entry["derivatives"]["v"]);
  return {dot(a, a), dot(b, b)};
}

bool has_nearly_parallel_derivatives(const ValueCase& c) {
  if (c.entry["m"].is_null()) return false;
  const auto [u, v] = squares_of_derivatives(c);
  const Vector m = vector_of(c.entry["m"]);
  return 25 * dot(m, m) <= u * v;  // the sine of the angle is at most 1/5
}

bool has_derivatives_of_different_length(const ValueCase& c) {
  const auto [u, v] = squares_of_derivatives(c);
  return u >= 49 * v || v >= 49 * u;
}

std::vector<double> numbers_of(const ValueCase& c) {
  std::vector<double> all = c.map.points;
  for (const ValueDirection& d : c.directions)
    all.insert(all.end(), {d.domain.first, d.domain.last, d.argument.first(), d.argument.last()});
  return all;
}

// --- Claims about directions

Claim some_direction(bool (*holds)(const ValueDirection&)) {
  return [=](const ValueCase& c) { return std::ranges::any_of(c.directions, holds); };
}
Claim all_directions(bool (*holds)(const ValueDirection&)) {
  return [=](const ValueCase& c) { return std::ranges::all_of(c.directions, holds); };
}

Claim some_order(int least) {
  return [=](const ValueCase& c) {
    return std::ranges::any_of(c.directions, [&](const auto& d) { return d.domain.order >= least; });
  };
}
Claim all_orders(int least) {
  return [=](const ValueCase& c) {
    return std::ranges::all_of(c.directions, [&](const auto& d) { return d.domain.order >= least; });
  };
}

Rational width(const ValueDirection& d) { return abs(Rational(d.domain.last) - Rational(d.domain.first)); }
bool is_outside(const ValueDirection& d) { return d.t < 0 || d.t > 1; }
bool is_inside(const ValueDirection& d) { return !is_outside(d); }
bool is_at_end(const ValueDirection& d) { return d.t.is_zero() || d.t == 1; }
bool is_reversed(const ValueDirection& d) { return d.domain.first > d.domain.last; }
bool is_short(double x) {
  return static_cast<double>(static_cast<float>(std::ldexp(x, 10))) == std::trunc(std::ldexp(x, 10));
}

// Returns true if the argument of a curve is adjacent to an end of the domain, or +-2^-24 if the end is 0.
bool is_next_to_end(const ValueCase& c) {
  const ValueDirection& d = c.directions[0];
  const double u = d.argument.coordinate();
  for (const double end : {d.domain.first, d.domain.last})
    for (const double towards : {-100.0, 100.0})
      if (u == (end == 0 ? std::copysign(0x1p-24, towards) : next_after(end, towards, c.type))) return true;
  return false;
}

// --- Claims about grids

bool is_awkward(const ValueCase& c) {
  return std::ranges::any_of(c.directions, [&](const ValueDirection& d) {
    const Rational step =
        (Rational(d.argument.last()) - Rational(d.argument.first())) / d.argument.segments();
    return Rational(rounded(step, c.type)) != step;
  });
}

// Returns the claim of each theme or flag that has one. Longer than 100 lines, because it is one table.
const std::map<std::string, Claim>& claims() {
  const Claim no_normal = [](const ValueCase& c) { return c.entry["normal"].is_null(); };
  static const std::map<std::string, Claim> kAll = {
      {"tie-float", is_tie(Type::kSingle)},
      {"tie-double", is_tie(Type::kReal)},
      {"near-tie-float", is_near_tie(Type::kSingle, 7)},
      {"near-tie-double", is_near_tie(Type::kReal, 7)},
      {"hardest", is_near_tie(Type::kSingle, 18)},
      {"cancel-zero", some_value([](const auto& x, const auto& size) { return x.is_zero() && size > 0; })},
      {"cancel-nearly", some_value([](const auto& x, const auto& size) { return 2 * abs(x) <= size; })},
      {"roots", some_value([](const auto& x, const auto& size) { return abs(x) <= power(-25) * size; })},
      {"overflow", some_value([](const auto& x, const auto&) {
         return abs(x) >= Rational(std::numeric_limits<float>::max());
       })},
      {"underflow",
       some_value([](const auto& x, const auto&) { return !x.is_zero() && abs(x) < power(-126); })},
      {"elevated",
       some_value([](const auto& x, const auto&) { return abs(x - Rational(9) / 64) < power(-20); })},
      {"circle", is_on_circle},
      {"map2_eval.cylinder", is_on_circle},

      {"huge", all_points([](double x) { return std::abs(x) >= 0x1p90 && std::abs(x) < 0x1p128; })},
      {"promised-range", all_points([](double x) { return std::abs(x) <= 0x1p32; })},
      {"tiny", all_points([](double x) { return std::abs(x) < 0x1p-98; })},
      {"subnormal", all_points([](double x) { return std::abs(x) < 0x1p-126; })},
      {"huge-double", all_points([](double x) { return std::abs(x) >= 0x1p128; })},
      {"tiny-double", all_points([](double x) { return std::abs(x) < 0x1p-148; })},
      {"wide", [](const ValueCase& c) { return spans(c, 16); }},
      {"constant", has_equal_points},
      {"map2_eval.separable", is_separable},
      {"map2_eval.bilinear", is_bilinear},
      {"full-precision", has_all_bits},
      {"weights", has_four_components},
      {"linear", is_line},
      {"map1_eval.one-point", is_unit},
      {"map2_eval.one-point", is_unit},
      {"minus-zero",
       [](const ValueCase& c) {
         return std::ranges::any_of(numbers_of(c), [](double x) { return x == 0 && std::signbit(x); });
       }},
      {"double-only",
       [](const ValueCase& c) {
         return std::ranges::any_of(numbers_of(c), [](double x) { return x != static_cast<float>(x); });
       }},

      {"ordinary", all_directions(is_inside)},
      {"outside", some_direction(is_outside)},
      {"at-an-end", all_directions(is_at_end)},
      {"corner", all_directions(is_at_end)},
      {"edge", some_direction(is_at_end)},
      {"next-to-an-end", is_next_to_end},
      {"border", some_direction(is_at_end)},
      {"far-away", some_direction([](const ValueDirection& d) {
         return abs(d.t) >= power(15) || abs(d.t) <= power(-60);
       })},
      {"domain",
       some_direction([](const ValueDirection& d) { return d.domain.first != 0 || d.domain.last != 1; })},
      {"domain-huge", some_direction([](const ValueDirection& d) { return width(d) > power(19); })},
      {"domain-tiny", some_direction([](const ValueDirection& d) { return width(d) <= power(-10); })},
      {"domain-reversed", some_direction(is_reversed)},
      {"map1_eval.domain-negative",
       all_directions([](const ValueDirection& d) { return d.domain.first <= 0 && d.domain.last <= 0; })},
      {"domain-offset", some_direction([](const ValueDirection& d) {
         return abs(Rational(d.domain.first)) >= 100 * width(d);
       })},
      {"domain-inexact", some_direction([](const ValueDirection& d) {
         return !is_short(d.domain.first) || !is_short(d.domain.last);
       })},
      {"auto_normal.reversed", some_direction(is_reversed)},
      {"order-one", some_direction([](const ValueDirection& d) { return d.domain.order == 1; })},
      {"map1_eval.high-order", some_order(31)},
      {"map2_eval.high-order", some_order(9)},
      {"auto_normal.high-order", some_order(6)},
      {"high-order-targets", some_order(31)},
      {"map2_eval.every-order", [](const ValueCase& c) { return std::min(c.map.u.order, c.map.v.order) <= 4; }},
      {"map2_eval.highest-order", all_orders(33)},
      {"auto_normal.highest-order", all_orders(12)},

      {"grid.inside", all_directions([](const ValueDirection& d) {
         return d.argument.index() >= 0 && d.argument.index() <= d.argument.segments();
       })},
      {"grid.awkward", is_awkward},
      {"grid.first", all_directions([](const ValueDirection& d) { return d.argument.index() == 0; })},
      {"grid.last",
       all_directions([](const ValueDirection& d) { return d.argument.index() == d.argument.segments(); })},
      {"grid.index-outside", all_directions([](const ValueDirection& d) {
         return d.argument.index() < 0 || d.argument.index() > d.argument.segments();
       })},
      {"grid.reversed",
       all_directions([](const ValueDirection& d) { return d.argument.first() > d.argument.last(); })},
      {"grid.equal-ends",
       all_directions([](const ValueDirection& d) { return d.argument.first() == d.argument.last(); })},
      {"grid.outside-domain", some_direction([](const ValueDirection& d) {
         return d.argument.first() != d.domain.first || d.argument.last() != d.domain.last;
       })},
      {"grid.many-segments",
       all_directions([](const ValueDirection& d) { return d.argument.segments() >= 65536; })},
      {"grid.far-index", all_directions([](const ValueDirection& d) {
         using Limits = std::numeric_limits<std::int32_t>;
         return d.argument.index() == Limits::min() || d.argument.index() == Limits::max();
       })},
      {"grid.cancelling", all_directions([](const ValueDirection& d) {
         const Rational first = Rational(d.argument.first()), way = d.argument.value() - first;
         return first * way < 0;
       })},
      {"grid.offset", all_directions([](const ValueDirection& d) {
         const Rational first = Rational(d.argument.first());
         return abs(first) >= 100 * abs(Rational(d.argument.last()) - first);
       })},

      {"auto_normal.one-point", [=](const ValueCase& c) { return no_normal(c) && has_equal_points(c); }},
      {"collapsed-to-a-line", no_normal},
      {"collapsed-edge", [](const ValueCase& c) { return has_normal_away_from_row(c, false); }},
      {"corner-without-derivative", [](const ValueCase& c) { return has_normal_away_from_row(c, true); }},
      {"plane", is_plane},
      {"rational-plane", [](const ValueCase& c) { return has_varying_w(c) && is_plane(c); }},
      {"curved", [](const ValueCase& c) { return !is_plane(c); }},
      {"saddle", is_saddle},
      {"auto_normal.cylinder", is_radial(2)},
      {"sphere", is_radial(3)},
      {"nearly-parallel", has_nearly_parallel_derivatives},
      {"stretched", has_derivatives_of_different_length},
      {"size", [](const ValueCase& c) {
         const double largest = std::ranges::max(c.map.points, {}, [](double x) { return std::abs(x); });
         return std::abs(largest) < 0x1p-4 || std::abs(largest) > 0x1p6;
       }},
      {"auto_normal.offset", [](const ValueCase& c) {
         return all_of_net(c, c.map.u.order, c.map.v.order,
                           [&](int i, int j, int k) { return k == 2 || point(c, i, j, k) >= 1; });
       }},
      {"auto_normal.weights", all_w([](double w) { return w >= 0x1p-4 && w <= 4; })},
      {"either-w", has_varying_w},
      {"zero-w", [](const ValueCase& c) { return c.entry["m"].is_null(); }},
      {"negative-w", all_w([](double w) { return w < 0; })},
      {"constant-w", all_w([](double w) { return w == 2; })},
      {"auto_normal.grid", all_directions([](const ValueDirection& d) { return d.argument.is_grid(); })}};
  return kAll;
}

}  // namespace

std::string broken_theme(const json& entry) {
  const std::string id = entry["id"], theme = entry["flags"][0];
  const std::string kind = id.substr(0, id.find('.'));
  for (const std::string& name : {fmt::format("{}.{}", kind, theme), theme}) {
    const auto found = claims().find(name);
    if (found == claims().end()) continue;
    return found->second(ValueCase(entry)) ? "" : theme;
  }
  return {};
}

}  // namespace evalcts::vectors
