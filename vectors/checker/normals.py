"""Automatic normals: derivatives, their cross product, the unit vector and the bound on its error.

Lengths are square roots, which are never computed: comparisons of squares decide about them.
"""

from fractions import Fraction
from functools import cached_property

from .accuracy import EPS, RANGE, Component, all_single, applies, error_bound
from .number import nearest_root

# Largest relative excess of a bound over the exact one.
SLACK = Fraction(1, 10**6)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def square(vector):
    return sum(x * x for x in vector)


class Uncertain:
    """An exact number and the bound on its error."""

    def __init__(self, value, error):
        self.value, self.error = value, error

    def most(self):
        return abs(self.value) + self.error


def difference_of_products(x, y, z, w):
    """x*y - z*w of uncertain numbers."""
    first, second = x.value * y.value, z.value * w.value
    most = (1 + 3 * EPS) * (x.most() * y.most() + z.most() * w.most())
    return Uncertain(first - second, most - abs(first) - abs(second))


class Normal:
    """The normal of a surface; `nets` holds the control values [i][j] of each of its 3 or 4 components."""

    def __init__(self, nets, u, v):
        self.u, self.v = u, v
        self.single = all_single((x for rows in nets for row in rows for x in row), u, v)
        self.components = [Component(rows, u, v, single=self.single) for rows in nets]
        self.rational = len(nets) == 4

    def _derivative(self, net, along_u):
        """n times a sum of degree n - 1 over the differences."""
        n, m = self.u.degree, self.v.degree
        degrees, times = ((n - 1, m), n) if along_u else ((n, m - 1), m)
        if times == 0:
            return Uncertain(Fraction(0), Fraction(0))
        along = net.along_u if along_u else net.along_v
        weights = self.u.weights(degrees[0]), self.v.weights(degrees[1])
        value = times * along(lambda after, before: after - before).weighed(*weights)
        sums = along(lambda after, before: abs(after) + abs(before))
        error = times * error_bound(sums, self.u, self.v, degrees, self.single, more_operations=3)
        return Uncertain(value, error)

    @cached_property
    def along_u(self):
        return [self._derivative(c.net, True) for c in self.components]

    @cached_property
    def along_v(self):
        return [self._derivative(c.net, False) for c in self.components]

    @cached_property
    def _w(self):
        return self.components[3].value if self.rational else Fraction(1)

    @cached_property
    def _tangents(self):
        """a and b, which are parallel to the derivatives of q."""
        if not self.rational:
            return self.along_u, self.along_v
        p = [Uncertain(c.value, c.error) for c in self.components]
        return tuple([difference_of_products(p[3], d[c], d[3], p[c]) for c in range(3)]
                     for d in (self.along_u, self.along_v))

    @cached_property
    def _product(self):
        """m' = a x b."""
        a, b = self._tangents
        return cross([x.value for x in a], [x.value for x in b])

    @cached_property
    def m(self):
        """dq/duh x dq/dvh; None where w is 0. Each tangent is w^2 times the derivative."""
        return [x / self._w**4 for x in self._product] if self._w else None

    def judged(self):
        """True if the rule applies and the error bound is small enough compared with the normal."""
        greatest = max(c.net.greatest for c in self.components)
        if not applies(greatest, self.u, self.v) or not self._w:
            return False
        if self.rational and 2 * self.components[3].error >= abs(self._w):
            return False
        return self._squarable() and 16 * self._error_square < square(self._product)

    def _squarable(self):
        """True if single precision can hold the squares of intermediate values."""
        a, b = ([x.most() for x in vector] for vector in self._tangents)
        for f in {Fraction(1), self._w**2}:
            for g, h in ((1, 1), (self.u.width, self.v.width)):
                length = square(self._product) / (f**2 * g * h)**2
                if (max(a) > RANGE * f * g or max(b) > RANGE * f * h
                        or not Fraction(1, RANGE**2) <= length <= RANGE**2):
                    return False
        return True

    @cached_property
    def _error_square(self):
        """The square of d."""
        a, b = self._tangents
        pairs = ((1, 2), (2, 0), (0, 1))
        return square([difference_of_products(a[i], b[j], a[j], b[i]).error for i, j in pairs])

    def bounds(self, number):
        """True if `number` is 2*d/|m'| + 10*eps, rounded up by less than SLACK."""
        ratio = 4 * self._error_square / square(self._product)

        def reaches(x):
            return x - 10 * EPS >= 0 and (x - 10 * EPS)**2 >= ratio
        return reaches(number) and not reaches(number / (1 + SLACK))

    def bound_estimate(self):
        """Returns the bound to a few digits, for messages."""
        return 2 * float(self._error_square / square(self._product))**0.5 + float(10 * EPS)

    def rounded(self, c, form):
        """Returns component c of m/|m| rounded to the format, as a text."""
        m = self.m
        return nearest_root(m[c]**2 / square(m), -1 if m[c] < 0 else 1, form)

    def at_least(self, c, x):
        """True if component c of m/|m| is at least x."""
        y, length = self.m[c], square(self.m)
        if (x < 0) != (y < 0):
            return x < 0 or x == y == 0
        return y * y >= x * x * length if y >= 0 else y * y <= x * x * length

    def at_most(self, c, x):
        y, length = self.m[c], square(self.m)
        if (x < 0) != (y < 0):
            return y < 0
        return y * y <= x * x * length if y >= 0 else y * y >= x * x * length
