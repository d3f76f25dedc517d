// Evaluates in long double, with a bound on the rounding error.
#include "estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace evalcts::vectors {
namespace {

using Real = long double;

// Bound on the relative error of one operation: twice the unit roundoff, which leaves some reserve.
constexpr Real kUnit = std::numeric_limits<Real>::epsilon();
// Largest relative error of an argument's distance from the ends of the domain; otherwise exact arithmetic
// decides.
constexpr Real kWorst = 0x1p-20L;

// t, s = 1 - t, and a bound on their relative errors.
struct Fraction {
  Real t, s, error;
};

std::optional<Fraction> fraction_of(const Argument& argument, const Direction& domain) {
  const Real first = domain.first, last = domain.last, width = last - first;
  Real u = argument.first(), absolute = 0;
  if (argument.is_grid() && argument.index() == argument.segments()) {
    u = argument.last();
  } else if (argument.is_grid() && argument.index() != 0) {
    const Real way = (Real{argument.last()} - u) * static_cast<Real>(argument.index()) /
                     static_cast<Real>(argument.segments());
    absolute = 4 * kUnit * (std::abs(way) + std::abs(u));
    u += way;
  }
  const Real above = u - first, below = last - u;
  const Real least = std::min(std::abs(above), std::abs(below));
  if (absolute > kWorst * least) return std::nullopt;
  return Fraction{above / width, below / width, (absolute == 0 ? 0 : absolute / least) + 3 * kUnit};
}

// The values of the Bernstein polynomials, and a bound on their relative errors.
struct Basis {
  std::vector<Real> values;
  Real error;
};

Basis basis(int degree, const Fraction& at) {
  Basis result{std::vector<Real>(static_cast<std::size_t>(degree) + 1), 0};
  Real power = 1, binomial = 1;
  for (int i = 0; i <= degree; ++i) {
    result.values[static_cast<std::size_t>(i)] = binomial * power;
    binomial = binomial * (degree - i) / (i + 1);
    power *= at.t;
  }
  power = 1;
  for (int i = degree; i >= 0; --i) {
    result.values[static_cast<std::size_t>(i)] *= power;
    power *= at.s;
  }
  result.error = static_cast<Real>(degree + 2) * (at.error + 4 * kUnit);
  return result;
}

// Returns the sum of u_i * v_j * value(i, j). size(i, j) bounds the magnitude of value(i, j).
template <class Value, class Size>
Estimate weighed(const Basis& u, const Basis& v, const Value& value, const Size& size) {
  Real sum = 0, magnitude = 0;
  for (std::size_t i = 0; i < u.values.size(); ++i) {
    Real row = 0, row_size = 0;
    for (std::size_t j = 0; j < v.values.size(); ++j) {
      row += v.values[j] * value(i, j);
      row_size += std::abs(v.values[j]) * size(i, j);
    }
    sum += u.values[i] * row;
    magnitude += std::abs(u.values[i]) * row_size;
  }
  const auto terms = static_cast<Real>(u.values.size() + v.values.size() + 4);
  return {sum, magnitude, magnitude * (u.error + v.error + terms * kUnit)};
}

// The control values of one component.
class Net {
 public:
  Net(const Map& map, int component) : map_(&map), component_(static_cast<std::size_t>(component)) {}
  Real operator()(std::size_t i, std::size_t j) const {
    const auto columns = static_cast<std::size_t>(map_->v.order),
               k = static_cast<std::size_t>(map_->components());
    return map_->points[(i * columns + j) * k + component_];
  }

 private:
  const Map* map_;
  std::size_t component_;
};

// Returns t and s of both directions. Curves have one point along v.
std::optional<std::pair<Fraction, Fraction>> place_of(const Problem& problem) {
  const auto u = fraction_of(problem.u, problem.map.u);
  const auto v = problem.v ? fraction_of(*problem.v, problem.map.v) : Fraction{0, 1, 0};
  if (!u || !v) return std::nullopt;
  return std::pair(*u, *v);
}

// Returns x*y - z*w.
Estimate difference(const Estimate& x, const Estimate& y, const Estimate& z, const Estimate& w) {
  const Real first = x.value * y.value, second = z.value * w.value;
  const Real magnitude = x.magnitude * y.magnitude + z.magnitude * w.magnitude;
  const Real error = x.error * y.magnitude + x.magnitude * y.error + z.error * w.magnitude +
                     z.magnitude * w.error + 4 * kUnit * magnitude;
  return {first - second, magnitude, 2 * error};
}

}  // namespace

std::optional<std::vector<Estimate>> estimate(const Problem& problem) {
  const auto place = place_of(problem);
  if (!place) return std::nullopt;
  const Map& map = problem.map;
  const Basis u = basis(map.u.order - 1, place->first), v = basis(map.v.order - 1, place->second);
  const auto growth_of = [](const Fraction& at, int degree) {
    return std::pow(std::abs(at.t) + std::abs(at.s), static_cast<Real>(degree));
  };
  const Real growth = growth_of(place->first, map.u.order - 1) * growth_of(place->second, map.v.order - 1);
  std::vector<Estimate> estimates;
  for (int c = 0; c < map.components(); ++c) {
    const Net net(map, c);
    estimates.push_back(weighed(u, v, net, [&](auto i, auto j) { return std::abs(net(i, j)); }));
    Real greatest = 0;
    for (std::size_t i = 0; i < u.values.size(); ++i)
      for (std::size_t j = 0; j < v.values.size(); ++j) greatest = std::max(greatest, std::abs(net(i, j)));
    estimates.back().reach = greatest * growth;
  }
  return estimates;
}

std::optional<NormalEstimate> estimate_normal(const Problem& problem) {
  const auto place = place_of(problem);
  const Map& map = problem.map;
  if (!place || map.u.order == 1 || map.v.order == 1) return std::nullopt;
  const Basis u = basis(map.u.order - 1, place->first), v = basis(map.v.order - 1, place->second);
  const Basis du = basis(map.u.order - 2, place->first), dv = basis(map.v.order - 2, place->second);
  std::vector<Estimate> value, along_u, along_v;
  for (int c = 0; c < map.components(); ++c) {
    const Net net(map, c);
    const auto size = [&](auto i, auto j) { return std::abs(net(i, j)); };
    // The factors order - 1 do not change the direction, but must be the same in all components.
    along_u.push_back(weighed(
        du, v, [&](auto i, auto j) { return net(i + 1, j) - net(i, j); },
        [&](auto i, auto j) { return size(i + 1, j) + size(i, j); }));
    along_v.push_back(weighed(
        u, dv, [&](auto i, auto j) { return net(i, j + 1) - net(i, j); },
        [&](auto i, auto j) { return size(i, j + 1) + size(i, j); }));
    if (map.components() == 4) value.push_back(weighed(u, v, net, size));
  }
  for (std::vector<Estimate>* tangent : {&along_u, &along_v})
    for (std::size_t c = 0; c < 3 && !value.empty(); ++c)
      (*tangent)[c] = difference(value[3], (*tangent)[c], (*tangent)[3], value[c]);
  std::array<Real, 3> m{};
  Real square = 0, error = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
    const Estimate product = difference(along_u[d], along_v[e], along_u[e], along_v[d]);
    m[c] = product.value;
    square += product.value * product.value;
    error += product.error;
  }
  const Real length = std::sqrt(square);
  if (!(error < 0x1p-20L * length)) return std::nullopt;
  const auto component = [&](std::size_t c) { return static_cast<double>(m[c] / length); };
  // The last term covers the rounding to double.
  return NormalEstimate{{component(0), component(1), component(2)},
                        static_cast<double>(4 * error / length + 0x1p-50L)};
}

}  // namespace evalcts::vectors
