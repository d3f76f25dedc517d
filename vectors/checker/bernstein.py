"""Bernstein polynomials, exactly.

A form of degree n is SUM C(n,i) * a^i * b^(n-i) * R_i; a = uh and b = 1 - uh make it the value of a map.
Everything is taken over a common denominator: reducing each term would cost far more than long integers do.
"""

from fractions import Fraction
from functools import cache, cached_property
from math import comb, lcm


@cache
def binomials(n):
    return [comb(n, i) for i in range(n + 1)]


class Weights:
    """C(n,i) * a^i * b^(n-i) for i = 0 ... n: integers over one denominator."""

    def __init__(self, a, b, n):
        q = lcm(a.denominator, b.denominator)
        a, b = a.numerator * (q // a.denominator), b.numerator * (q // b.denominator)
        ups, downs = [1], [1]
        for _ in range(n):
            ups.append(ups[-1] * a)
            downs.append(downs[-1] * b)
        self.numerators = [binomial * up * down for binomial, up, down in zip(binomials(n), ups, reversed(downs))]
        self.denominator = q**n

    @cached_property
    def magnitudes(self):
        """The weights of |a| and |b|."""
        other = object.__new__(Weights)
        other.numerators = [abs(x) for x in self.numerators]
        other.denominator = self.denominator
        return other

    def fractions(self):
        return [Fraction(x, self.denominator) for x in self.numerators]


class Net:
    """Control values of one component, net[i][j], over one denominator. Curves have one column."""

    def __init__(self, rows):
        self.denominator = lcm(*(x.denominator for row in rows for x in row))
        self.rows = [[x.numerator * (self.denominator // x.denominator) for x in row] for row in rows]

    @classmethod
    def of(cls, rows, denominator):
        net = object.__new__(cls)
        net.rows, net.denominator = rows, denominator
        return net

    @cached_property
    def magnitudes(self):
        return Net.of([[abs(x) for x in row] for row in self.rows], self.denominator)

    def along_u(self, combine):
        """The net of combine(R_(i+1)j, R_ij)."""
        rows = [[combine(y, x) for y, x in zip(*pair)] for pair in zip(self.rows[1:], self.rows)]
        return Net.of(rows, self.denominator)

    def along_v(self, combine):
        """The net of combine(R_i(j+1), R_ij)."""
        rows = [[combine(y, x) for y, x in zip(row[1:], row)] for row in self.rows]
        return Net.of(rows, self.denominator)

    @cached_property
    def greatest(self):
        """The greatest magnitude."""
        return Fraction(max(abs(x) for row in self.rows for x in row), self.denominator)

    def weighed(self, u, v):
        """SUM over i and j of u_i * v_j * R_ij."""
        total = 0
        for weight, row in zip(u.numerators, self.rows):
            total += weight * sum(w * x for w, x in zip(v.numerators, row))
        return Fraction(total, u.denominator * v.denominator * self.denominator)

    @cached_property
    def binomial_sum(self):
        """SUM C(n,i) * C(m,j) * max(1, |R_ij|)."""
        in_u, in_v = binomials(len(self.rows) - 1), binomials(len(self.rows[0]) - 1)
        total = sum(a * sum(b * max(self.denominator, abs(x)) for b, x in zip(in_v, row))
                    for a, row in zip(in_u, self.rows))
        return Fraction(total, self.denominator)


def de_casteljau(values, a, b):
    """The rows of the triangle, from the control values down to the one value."""
    rows = [values]
    while len(rows[-1]) > 1:
        rows.append([b * x + a * y for x, y in zip(rows[-1], rows[-1][1:])])
    return rows
