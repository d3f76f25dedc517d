// Enclosures of values and derivatives in double-double arithmetic.
#include "enclosure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mutation_point.h"

namespace glev {
namespace {

bool is_ordinary(double x) { return x == 0 || (std::fabs(x) >= 0x1p-300 && std::fabs(x) <= 0x1p300); }

// Horner's rule, from the last point with the ratio t / s or from the first point with s / t.
template <class Coefficient>
DoubleDouble horner(int degree, const PreparedDirection& direction, const Coefficient& coefficient) {
  const auto term = [&](int i) { return coefficient(i) * exact_binomial(degree, i); };
  const int last = direction.from_last ? degree : 0, step = direction.from_last ? -1 : 1;
  DoubleDouble sum = term(last);
  for (int k = 1; k <= degree; ++k) sum = sum * direction.ratio + term(last + k * step);
  return sum;
}

// Encloses the value for control points point(i, j).
template <class Point>
Enclosure enclose_net(std::array<int, 2> degree, const std::array<Domain, 2>& domain, double largest,
                      const GridArgument& u, const GridArgument& v, const Point& point) {
  const int n = degree[0], m = degree[1];
  const PreparedDirection in_u = prepare_direction(domain[0], u, n),
                          in_v = prepare_direction(domain[1], v, m);
  if (!is_claimed(in_u, in_v, largest)) return {{}, HUGE_VAL};
  const DoubleDouble sum =
      horner(n, in_u, [&](int i) { return horner(m, in_v, [&](int j) { return point(i, j); }); });
  return enclosure_of(sum, degree, in_u, in_v, largest);
}

}  // namespace

PreparedDirection prepare_direction(const Domain& domain, const GridArgument& argument, int degree) {
  PreparedDirection direction;
  if (degree == 0) return direction;
  const Grid& grid = argument.grid;
  const double i = static_cast<double>(argument.index), n = grid.segments;
  DoubleDouble a, b, width;
  if (spans(grid, domain)) {
    a = {i}, b = {n - i}, width = {n};
  } else if (spans_backwards(grid, domain)) {
    a = {n - i}, b = {i}, width = {n};
  } else {
    const DoubleDouble start = two_sum(grid.u1, -domain.u1), rest = two_sum(domain.u2, -grid.u1);
    width = two_sum(domain.u2, -domain.u1);
    if (i == 0 || grid.u1 == grid.u2) {
      a = start, b = rest;
    } else {
      const DoubleDouble run = two_sum(grid.u2, -grid.u1) * i, from = start * n, to = rest * n;
      width = width * n;
      a = from + run, b = to - run;
      const double parts = std::fabs(from.high) + std::fabs(to.high) + 2 * std::fabs(run.high);
      direction.argument_error =
          GLEV_AT(argument_error, 16 * parts / std::max(std::fabs(a.high), std::fabs(b.high)));
    }
  }
  for (const DoubleDouble* x : {&a, &b, &width}) {
    if (!is_ordinary(x->high) || !(direction.argument_error <= 0x1p40)) {
      direction.growth = HUGE_VAL;
      return direction;
    }
  }
  direction.from_last = std::fabs(a.high) <= std::fabs(b.high);
  const DoubleDouble &smaller = direction.from_last ? a : b, &larger = direction.from_last ? b : a;
  direction.ratio = smaller / larger;
  direction.power = raise_to_power(larger / width, degree);
  const double base = (std::fabs(a.high) + std::fabs(b.high)) / std::fabs(width.high) * (1 + 0x1p-50);
  // Inside the domain, the power is avoided because it would double the time.
  direction.growth = base <= 1 + 0x1p-48 ? 1 + 0x1p-40 : std::pow(base, degree) * (1 + 0x1p-40);
  if (!(direction.growth <= 0x1p300)) direction.growth = HUGE_VAL;
  return direction;
}

bool is_claimed(const PreparedDirection& in_u, const PreparedDirection& in_v, double largest) {
  return in_u.growth * in_v.growth <= 0x1p300 && is_ordinary(largest);
}

Enclosure enclosure_of(const DoubleDouble& sum, std::array<int, 2> degree, const PreparedDirection& in_u,
                       const PreparedDirection& in_v, double largest) {
  const auto [n, m] = degree;
  const double growth = in_u.growth * in_v.growth;
  const double units = 48 + (90 + 3 * in_u.argument_error) * n + (90 + 3 * in_v.argument_error) * m;
  return {sum * in_u.power * in_v.power,
          GLEV_AT(bound_of_enclosure, units * 0x1p-106) * (1 + 0x1p-20) * largest * growth + 0x1p-700};
}

Enclosure enclose(const Component& component, double largest, const GridArgument& u, const GridArgument& v) {
  const int order_v = component.order[1];
  return enclose_net(
      {component.order[0] - 1, order_v - 1}, component.domain, largest, u, v, [&](int i, int j) {
        return DoubleDouble{
            component.points[(static_cast<std::ptrdiff_t>(i) * order_v + j) * component.stride], 0};
      });
}

Enclosure enclose_derivative(const Component& component, const Derivative& derivative, const GridArgument& u,
                             const GridArgument& v) {
  const std::ptrdiff_t row = component.order[1] * component.stride;
  std::array<int, 2> degree = {component.order[0] - 1, component.order[1] - 1};
  int factor = 1;
  for (const std::size_t d : {0, 1}) {
    for (int k = 0; k < derivative[d]; ++k) factor *= degree[d]--;
  }
  if (factor == 0) return {};
  const bool is_second = derivative[0] + derivative[1] == 2;
  const std::ptrdiff_t first = derivative[0] > 0 ? row : component.stride,
                       second = derivative[1] > 0 ? component.stride : row;
  const auto point = [&](int i, int j) { return component.points + i * row + j * component.stride; };
  const auto difference = [&](int i, int j) {
    const double* const own = point(i, j);
    const DoubleDouble near = two_sum(own[first], -*own);
    return is_second ? two_sum(own[first + second], -own[second]) - near : near;
  };
  double largest = 0;
  for (int i = 0; i <= degree[0]; ++i) {
    for (int j = 0; j <= degree[1]; ++j) {
      const double* const own = point(i, j);
      const double far = is_second ? std::fabs(own[first + second] - own[second]) : 0;
      largest = std::max(largest, std::fabs(own[first] - *own) + far);
    }
  }
  if (largest == 0) return {};
  const Enclosure net = enclose_net(degree, component.domain, largest, u, v, difference);
  // The sum of two differences has an error of 4 units of their magnitudes, and the bound has at least 48.
  return {net.value * factor, net.error * (factor * (is_second ? 1.125 : 1 + 0x1p-20))};
}

bool settle(const DoubleDouble& value, double error, float* result) {
  if (!(error < HUGE_VAL)) return false;
  // The sums are moved outward by more than their rounding errors.
  const auto outward = [](double x, double direction) { return x + direction * 0x1p-51 * std::fabs(x); };
  const double least = outward(value.high + outward(GLEV_AT(lower_end, value.low - error), -1), -1);
  const double most = outward(value.high + outward(value.low + error, 1), 1);
  const float low = static_cast<float>(least), high = static_cast<float>(most);
  *result = high;
  // NaN is not a valid result.
  return GLEV_AT(ends_are_equal,
                 std::bit_cast<std::uint32_t>(low) == std::bit_cast<std::uint32_t>(high) && low == high);
}

}  // namespace glev
