#!/usr/bin/env python3
"""An evaluator to be judged, normals included: evalcts vectors emit | bezier.py | evalcts vectors check.

Bernstein polynomials in fractions, so its values are exact up to the last rounding."""
import math
import sys
from fractions import Fraction


def number(words):
    return Fraction(float.fromhex(next(words)))


def coordinate(is_grid, words):
    if not is_grid:
        return number(words)
    segments, first, last, index = int(next(words)), number(words), number(words), int(next(words))
    return index * (last - first) / segments + first


def bernstein(values, t):
    n = len(values) - 1
    return sum(math.comb(n, i) * t**i * (1 - t) ** (n - i) * value for i, value in enumerate(values))


def derivative(values, t):
    n = len(values) - 1
    return n * bernstein([b - a for a, b in zip(values, values[1:])], t) if n > 0 else Fraction(0)


def text(x):
    """A float if it can be one."""
    try:
        return float(x).hex()
    except OverflowError:
        return "inf" if x > 0 else "-inf"


def answer(kind, words):
    two, is_grid, is_normal = kind not in ("map1", "grid1"), kind.startswith("grid"), kind.endswith("normal")
    k, uorder, vorder = int(next(words)), int(next(words)), int(next(words)) if two else 1
    domain = [number(words) for _ in range(4 if two else 2)] + [Fraction(0), Fraction(1)]
    u = (coordinate(is_grid, words) - domain[0]) / (domain[1] - domain[0])
    v = (coordinate(is_grid, words) - domain[2]) / (domain[3] - domain[2]) if two else Fraction(0)
    points = [[[number(words) for _ in range(k)] for _ in range(vorder)] for _ in range(uorder)]

    def along(component, of_u, of_v):
        return of_u([of_v([point[component] for point in row], v) for row in points], u)

    p = [along(c, bernstein, bernstein) for c in range(k)]
    if not is_normal:
        return p
    p_u, p_v = ([along(c, *rules) for c in range(k)] for rules in ((derivative, bernstein), (bernstein, derivative)))
    if k == 4:
        p_u, p_v = ([p[3] * d[c] - d[3] * p[c] for c in range(3)] for d in (p_u, p_v))
    m = [p_u[i - 2] * p_v[i - 1] - p_u[i - 1] * p_v[i - 2] for i in range(3)]
    largest = max(abs(x) for x in m)
    if largest == 0:
        return None
    m = [float(x / largest) for x in m]
    return [x / math.hypot(*m) for x in m]


def main():
    for line in sys.stdin:
        kind, name, _, *rest = line.split()
        result = answer(kind, iter(rest))
        print(name, *(["skip"] if result is None else map(text, result)))


if __name__ == "__main__":
    main()
