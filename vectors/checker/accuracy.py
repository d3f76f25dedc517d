"""The accuracy rule: the largest error that a conforming result may have.

A map has one or two directions. A curve is treated as a surface of degree 0 in v: all formulas of the rule
for surfaces turn into those for curves.
"""

from fractions import Fraction
from functools import cached_property

from .bernstein import Net, Weights
from .number import BINARY32, LEAST_NORMAL, greatest_not_above, least_not_below, nearest

EPS = Fraction(10738, 2**30)
NARROWEST, WIDEST = Fraction(1, 2**60), Fraction(2**60)
RANGE, COLOR_RANGE = 2**32, 2**10
# The least number that rounds to infinity in single precision.
OVERFLOW = Fraction(2**128 - 2**103)


class Grid:
    """The argument i*(g2 - g1)/n + g1."""

    def __init__(self, segments, first, last, index):
        self.segments, self.first, self.last, self.index = segments, first, last, index
        self.exact = first + Fraction(index * (last - first), segments)

    def inputs(self):
        return self.first, self.last

    def sizes(self):
        """Numbers that must not overflow in single precision when the argument is computed."""
        step = Fraction(self.last - self.first, self.segments)
        return self.first, self.last, self.last - self.first, self.index * step

    def inner(self):
        return self.index not in (0, self.segments)


class Direction:
    """One direction of a map: its domain, its degree, and its argument, a Fraction or a Grid."""

    def __init__(self, first, last, argument, degree):
        self.first, self.last, self.degree = first, last, degree
        self.grid = argument if isinstance(argument, Grid) else None
        self.u = argument.exact if self.grid else argument
        self.width = abs(last - first)
        self.t = (self.u - first) / (last - first)
        self.s = (last - self.u) / (last - first)
        self.inputs = (first, last, *(argument.inputs() if self.grid else (argument,)))
        self._known = {}

    @cached_property
    def single(self):
        return all(BINARY32.holds(x) for x in self.inputs)

    @cached_property
    def regular(self):
        """True if the domain and the argument do not exclude the accuracy rule."""
        ends = self.first, self.last
        return (NARROWEST <= self.width <= WIDEST and not any(0 < abs(x) < LEAST_NORMAL for x in ends)
                and nearest(self.first, BINARY32) != nearest(self.last, BINARY32)
                and all(abs(x) < OVERFLOW for x in (*ends, *(self.grid.sizes() if self.grid else [self.u]))))

    def tau(self, single):
        tau = LEAST_NORMAL * (1 + 2 / self.width)
        grid = self.grid
        if grid and grid.inner():
            step = (grid.last - grid.first) / grid.segments
            tau += EPS * (4 * abs(grid.index * step) + abs(self.u)) / self.width
        if not single:
            argument = abs(self.u)
            if grid:
                share = Fraction(abs(grid.index), grid.segments)
                argument = abs(grid.first) + share * (abs(grid.first) + abs(grid.last))
            ends = abs(self.s * self.first) + abs(self.t * self.last)
            tau += Fraction(1, 2**23) * (argument + ends) / self.width
        return tau

    def weights(self, degree):
        """The values of the Bernstein polynomials of the degree: that of the map, or one less for its derivative."""
        return self._once(("exact", degree), lambda: Weights(self.t, self.s, degree))

    def widened_weights(self, degree, single):
        """The same at T and S in place of t and s."""
        return self._once(("widened", degree, single), lambda: Weights(*self._widened(single), degree))

    def _widened(self, single):
        tau = self.tau(single)
        return ((1 + 8 * EPS) * abs(self.t) + tau,
                (1 + 8 * EPS) * abs(self.s) + 8 * EPS * abs(self.t) + tau)

    def _once(self, key, compute):
        """Returns compute(), which is called only once for each key, because all components of a map ask for the same."""
        if key not in self._known:
            self._known[key] = compute()
        return self._known[key]

    def growth(self, degree):
        return self._once(("growth", degree), lambda: (abs(self.t) + abs(self.s))**degree)

    def reach(self, degree):
        return self._once(("reach", degree), lambda: max(1, abs(self.t), abs(self.s))**degree)


# The v direction of a curve: one control point, nothing rounded.
POINT = Direction(Fraction(0), Fraction(1), Fraction(0), 0)


def error_bound(net, u, v, degrees, single, more_operations=0):
    """The error bound of a sum of these degrees over control values with the magnitudes `net`."""
    n, m = degrees
    k = n * m + 5 * (n + m) + 4 + (not single) + more_operations
    x = k * EPS
    widened = net.weighed(u.widened_weights(n, single), v.widened_weights(m, single))
    plain = net.weighed(u.weights(n).magnitudes, v.weights(m).magnitudes)
    underflow = k * LEAST_NORMAL * u.reach(n) * v.reach(m) * net.binomial_sum
    return (1 + x + x * x) * widened - plain + underflow


def applies(greatest, u, v, limit=RANGE):
    """True if the rule applies to a sum over control values of magnitude up to `greatest`."""
    growth = u.growth(u.degree) * v.growth(v.degree)
    return u.regular and v.regular and growth <= RANGE and growth * greatest <= limit


def all_single(values, u, v):
    return u.single and v.single and all(BINARY32.holds(x) for x in values)


class Component:
    """One component of a map at an argument. `rows` are its control values [i][j], `net` the Net of them."""

    def __init__(self, rows, u, v, color=False, single=None, net=None, texture=False):
        self.rows, self.net, self.u, self.v, self.texture = rows, net or Net(rows), u, v, texture
        self.degrees = (u.degree, v.degree)
        self.given_single = single
        self.limit = COLOR_RANGE if color else RANGE

    @cached_property
    def single(self):
        if self.given_single is not None:
            return self.given_single
        return all_single((x for row in self.rows for x in row), self.u, self.v)

    @cached_property
    def value(self):
        return self.net.weighed(self.u.weights(self.degrees[0]), self.v.weights(self.degrees[1]))

    @cached_property
    def magnitude(self):
        weights = (d.weights(n).magnitudes for d, n in zip((self.u, self.v), self.degrees))
        return self.net.magnitudes.weighed(*weights)

    @cached_property
    def judged(self):
        return applies(self.net.greatest, self.u, self.v, self.limit)

    @cached_property
    def needs_gl_2(self):
        """True if the rule applies from GL 2.0 on only, because earlier versions guarantee less for texture coordinates."""
        return self.texture and self.judged and not applies(self.net.greatest, self.u, self.v, COLOR_RANGE)

    @cached_property
    def error(self):
        return error_bound(self.net.magnitudes, self.u, self.v, self.degrees, self.single)

    def interval(self):
        """The least and the greatest finite binary32 accepted; None if the rule does not apply."""
        return floats_within(self.value, self.error) if self.judged else None


def quotient_interval(x, w):
    """The same for x/w of two components."""
    if not (x.judged and w.judged) or 2 * w.error >= abs(w.value):
        return None
    exact = x.value / w.value
    q = (x.error + abs(exact) * w.error) / (abs(w.value) - w.error)
    return floats_within(exact, q + 4 * EPS * (abs(exact) + q))


def floats_within(centre, distance):
    return least_not_below(centre - distance, BINARY32), greatest_not_above(centre + distance, BINARY32)
