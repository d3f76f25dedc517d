"""Wrong evaluators, each with the theme of the vectors that has to detect it."""

from fractions import Fraction
from math import comb

from checker.maps import Map
from checker.number import Format
from correct_implementations import Evaluator, f32, f64, rounded, unit


def _counted(first, last, segments, index, rounding, fused=False):
    """Returns index * du + first, rounded after each operation; if `fused`, not after the product."""
    step = rounding(rounding(last - first) / segments)
    way = index * step
    return rounding((way if fused else rounding(way)) + first)


def _without_exact_end(rounding, fused=False):
    return lambda self, g: _counted(g.first, g.last, g.segments, g.index, rounding, fused)


def _from_last_end(rounding, fused=False):
    return lambda self, g: _counted(g.last, g.first, g.segments, g.segments - g.index, rounding, fused)


def _orders(condition, change):
    """Returns the override of `component` that changes the rows if condition(uorder, vorder) is true."""
    def component(self, rows, t, s):
        return Evaluator.component(self, change(rows) if condition(len(rows), len(rows[0])) else rows, t, s)
    return {"component": component}


def _components(condition, change):
    """Returns the override of `values` that changes the values if condition(map, arguments) is true."""
    def values(self, the_map, arguments):
        found = Evaluator.values(self, the_map, arguments)
        return change(found) if condition(the_map, arguments) else found
    return {"values": values}


def _binomials(of):
    return {"basis": lambda self, n, t: [of(n, i) * t**i * (1 - t)**(n - i) for i in range(n + 1)]}


def _wrapped(x, bits):
    x %= 2**bits
    return x - 2**bits if x >= 2**(bits - 1) else x


def _normal_of(condition, change):
    def normal(self, the_map, arguments):
        found = Evaluator.normal(self, the_map, arguments)
        return change(found) if condition(the_map, arguments) else found
    return {"normal": normal}


def _is_high(order):
    return lambda the_map, arguments: max(the_map.orders) >= order


def _is(kind, order=0):
    return lambda the_map, arguments: the_map.target.endswith(kind) and max(the_map.orders) > order


def _first_and_last_swapped(values):
    return [values[-1], *values[1:-1], values[0]]


def _fraction(of):
    """Replaces `fraction_of` by of(u, first, last)."""
    return {"fraction_of": lambda self, u, first, last: of(u, first, last)}


def _parameters(change):
    """Replaces t and s by change(t, s)."""
    return {"parameters": lambda self, the_map, arguments: change(*Evaluator.parameters(self, the_map, arguments))}


def _basis(change):
    """Replaces the list of Bernstein polynomials by change(list, t)."""
    return {"basis": lambda self, n, t: change(Evaluator.basis(self, n, t), t)}


def _combined(of):
    return {"combined": lambda self, values, t: of(values, t)}


def _result(of):
    """Replaces each result by of(value)."""
    return {"result": lambda self, x: of(x)}


def _index(of):
    """Evaluates points of grids at the index of(grid)."""
    def grid_argument(self, g):
        return g.first + Fraction(of(g) * (g.last - g.first), g.segments)
    return {"grid_argument": grid_argument}


def _significant(bits):
    """Returns a function that rounds to `bits` significant bits."""
    form = Format("short", bits, -10**6, 10**6)
    return lambda x: rounded(x, form)


def _clamped(x, low=0, high=1):
    return min(max(x, low), high)


def _polygon(values, t):
    """Returns the point of the control polygon at t."""
    n = len(values) - 1
    if n == 0:
        return values[0]
    i = min(max(int(t * n), 0), n - 1)
    return values[i] + (t * n - i) * (values[i + 1] - values[i])


def _lagrange(values, t):
    """Interpolates the control points at equidistant arguments."""
    n = len(values) - 1
    total = Fraction(0)
    for i, value in enumerate(values):
        for j in range(n + 1):
            if j != i:
                value *= (n * t - j) / (i - j)
        total += value
    return total


def _replaced(place, x):
    return lambda values: [*values[:place], x(values) if callable(x) else x, *values[place + 1:]]


def _without_w(the_map):
    if the_map.size == 3:
        return the_map
    points = [[point[:3] for point in row] for row in the_map.points]
    return Map(2, "GL_MAP2_VERTEX_3", the_map.domain, points)


def _by_chords(self, rows, t, s):
    """Derivatives from the outer control points."""
    along_v = [self.combined(column, t) for column in zip(*rows)]
    along_u = [self.combined(row, s) for row in rows]
    return along_u[-1] - along_u[0], along_v[-1] - along_v[0]


def _by_differences(step):
    """Derivatives from divided differences."""
    def derivatives(self, rows, t, s):
        at = self.component(rows, t, s)
        return self.component(rows, t + step, s) - at, self.component(rows, t, s + step) - at
    return {"derivatives": derivatives}


# Name: (kind.theme, {method of Evaluator: its replacement}).
WRONG_EVALUATORS = {
    # Ends of grids
    "last end by float arithmetic": ("grid.exact-last", {"grid_argument": _without_exact_end(f32)}),
    "last end by fused float arithmetic": ("grid.exact-last", {"grid_argument": _without_exact_end(f32, True)}),
    "last end by double arithmetic": ("grid.exact-last", {"grid_argument": _without_exact_end(f64)}),
    "last end by fused double arithmetic": ("grid.exact-last", {"grid_argument": _without_exact_end(f64, True)}),
    "first end by float arithmetic": ("grid.exact-first", {"grid_argument": _from_last_end(f32)}),
    "first end by fused float arithmetic": ("grid.exact-first", {"grid_argument": _from_last_end(f32, True)}),
    "first end by double arithmetic": ("grid.exact-first", {"grid_argument": _from_last_end(f64)}),
    "last end of rising grids only": ("grid.exact-last", {"grid_argument": lambda self, g: (
        g.exact if g.first < g.last else _without_exact_end(f32)(self, g))}),
    "last end of falling grids only": ("grid.exact-last", {"grid_argument": lambda self, g: (
        g.exact if g.first > g.last else _without_exact_end(f32)(self, g))}),
    "last end of grids of one segment": ("grid.exact-last", {"grid_argument": lambda self, g: (
        g.exact if g.segments < 2 else _without_exact_end(f32)(self, g))}),
    # High orders
    "control points beyond the 30th are lost in curves": ("map1_eval.high-order-targets", _orders(
        lambda n, m: n > 30, lambda rows: rows[:30])),
    "control points beyond the 48th are lost in u": ("map2_eval.highest-order", _orders(
        lambda n, m: n > 48, lambda rows: rows[:48])),
    "control points beyond the 48th are lost in v": ("map2_eval.highest-order", _orders(
        lambda n, m: m > 48, lambda rows: [row[:48] for row in rows])),
    "nets above 2048 points lose their last row": ("map2_eval.highest-order", _orders(
        lambda n, m: n * m > 2048, lambda rows: [*rows[:-1], rows[-2]])),
    "binomials in 32 bits": ("map1_eval.high-order-targets", _binomials(
        lambda n, i: _wrapped(comb(n, i), 32))),
    "binomials in 32 bits in surfaces": ("map2_eval.high-order-targets", _binomials(
        lambda n, i: _wrapped(comb(n, i), 32))),
    "binomials of order 64 are those of 63": ("map1_eval.high-order-targets", _binomials(
        lambda n, i: comb(min(n, 62), i))),
    "colours above order 30 are BGRA": ("map1_eval.high-order-targets", _components(
        _is("COLOR_4", 30), lambda v: [v[2], v[1], v[0], v[3]])),
    "w of curves above order 30 is 1": ("map1_eval.high-order-targets", _components(
        _is("VERTEX_4", 30), lambda v: [*v[:3], Fraction(1)])),
    "normals above order 30 are turned": ("map2_eval.high-order-targets", _components(
        _is("NORMAL", 30), lambda v: [-x for x in v])),
    "q of surfaces above order 30 is 1": ("map2_eval.high-order-targets", _components(
        _is("TEXTURE_COORD_4", 30), lambda v: [*v[:3], Fraction(1)])),
    # Grids of every target
    "colours of grids are clamped": ("grid.targets", _components(
        _is("COLOR_4"), lambda v: [min(max(x, 0), 1) for x in v])),
    "normals of grids have length 1": ("grid.targets", _components(
        _is("NORMAL"), lambda v: unit(v) if any(v) else v)),
    "w of grids divides": ("grid.targets", _components(
        _is("VERTEX_4"), lambda v: [f32(x / v[3]) for x in v[:3]] + [Fraction(1)])),
    "s and r are swapped on grids": ("grid.targets", _components(
        _is("TEXTURE_COORD_3"), _first_and_last_swapped)),
    "t is lost on grids of order 30": ("grid.targets", _components(
        _is("TEXTURE_COORD_2", 29), lambda v: [v[0], Fraction(0)])),
    # Normals of high orders
    "normals above order 16 in both directions are turned": ("auto_normal.highest-order", _normal_of(
        lambda m, a: min(m.orders) > 16, lambda n: [-x for x in n])),
    "normals of order 30 leave z out": ("auto_normal.highest-order", _normal_of(
        lambda m, a: min(m.orders) > 29, lambda n: [*n[:2], Fraction(0)])),
    # Signs of normals
    "normals turned where both directions are reversed": ("auto_normal.reversed", _normal_of(
        lambda m, a: m.domain[0] > m.domain[1] and m.domain[2] > m.domain[3], lambda n: [-x for x in n])),
    "normals turned where a domain is negative": ("auto_normal.domain", _normal_of(
        lambda m, a: min(m.domain) < 0, lambda n: [-x for x in n])),
    # Arguments and domains
    "arguments are clamped to the domain": ("map1_eval.outside", _fraction(
        lambda u, a, b: _clamped((u - a) / (b - a)))),
    "arguments of surfaces are clamped to the domain": ("map2_eval.outside", _fraction(
        lambda u, a, b: _clamped((u - a) / (b - a)))),
    "arguments are clamped above only": ("map1_eval.outside", _fraction(lambda u, a, b: min((u - a) / (b - a), 1))),
    "arguments repeat": ("map1_eval.outside", _fraction(lambda u, a, b: (u - a) / (b - a) % 1)),
    "u1 is not subtracted": ("map1_eval.domain-offset", _fraction(lambda u, a, b: u / (b - a))),
    "the domain is not divided by": ("map1_eval.domain-huge", _fraction(lambda u, a, b: u - a)),
    "the width of the domain has no sign": ("map1_eval.domain-reversed", _fraction(
        lambda u, a, b: (u - a) / abs(b - a))),
    "ends of reversed domains are swapped": ("map1_eval.domain-reversed", _fraction(
        lambda u, a, b: (u - min(a, b)) / abs(b - a))),
    "domains begin at 0 where they are negative": ("map1_eval.domain-negative", _fraction(
        lambda u, a, b: (u - max(a, 0)) / (b - a))),
    "domains are rounded to 11 bits": ("map1_eval.domain-inexact", _fraction(
        lambda u, a, b: (u - _significant(11)(a)) / (_significant(11)(b) - _significant(11)(a)))),
    "narrow domains have a width of 2^-10": ("map1_eval.domain-tiny", _fraction(
        lambda u, a, b: (u - a) / (b - a if abs(b - a) >= Fraction(1, 2**10) else Fraction(1, 2**10)))),
    "arguments have 12 bits": ("map1_eval.full-precision", _fraction(
        lambda u, a, b: _significant(12)((u - a) / (b - a)))),
    "u and v are exchanged": ("map2_eval.transposed", _parameters(lambda t, s: (s, t))),
    "v is u": ("map2_eval.ordinary", _parameters(lambda t, s: (t, t))),
    "v runs backwards": ("map2_eval.edge", _parameters(lambda t, s: (t, 1 - s))),
    # Polynomials
    "u runs backwards": ("map1_eval.ordinary", _parameters(lambda t, s: (1 - t, s))),
    "0^0 is 0": ("map1_eval.at-an-end", _basis(lambda b, t: (
        [Fraction(0)] * len(b) if t in (0, 1) else b))),
    "the last term is missing": ("map1_eval.at-an-end", _basis(lambda b, t: [*b[:-1], Fraction(0)])),
    "the first term is missing": ("map1_eval.at-an-end", _basis(lambda b, t: [Fraction(0), *b[1:]])),
    "middle terms are missing above order 20": ("map1_eval.ordinary", _basis(lambda b, t: (
        b if len(b) <= 20 else [*b[:len(b) // 2], Fraction(0), *b[len(b) // 2 + 1:]]))),
    "there are no binomials": ("map1_eval.one-point", _binomials(lambda n, i: 1)),
    "binomials are those of the order": ("map1_eval.one-point", _binomials(lambda n, i: comb(n + 1, i))),
    "binomials in 16 bits": ("map1_eval.ordinary", _binomials(lambda n, i: _wrapped(comb(n, i), 16))),
    "terms below 2^-10 are left out": ("map1_eval.one-point", _basis(lambda b, t: [
        x if abs(x) >= Fraction(1, 2**10) else Fraction(0) for x in b])),
    "control points are coefficients of powers": ("map1_eval.ordinary", _combined(
        lambda values, t: sum(x * t**i for i, x in enumerate(values)))),
    "curves pass through all control points": ("map1_eval.ordinary", _combined(_lagrange)),
    "curves are their control polygons": ("map1_eval.ordinary", _combined(_polygon)),
    "surfaces are their control nets": ("map2_eval.ordinary", _combined(_polygon)),
    "orders above 8 are cut": ("map1_eval.ordinary", _orders(lambda n, m: n > 8, lambda rows: rows[:8])),
    "orders above 30 are cut": ("map1_eval.high-order", _orders(lambda n, m: n > 30, lambda rows: rows[:30])),
    "square nets are transposed": ("map2_eval.every-target", _orders(
        lambda n, m: n == m, lambda rows: [list(row) for row in zip(*rows)])),
    "maps of order 1 are 0": ("map1_eval.order-one", _orders(
        lambda n, m: n == 1 and m == 1, lambda rows: [[Fraction(0)]])),
    "vorder 1 is vorder 0": ("map2_eval.order-one", _orders(
        lambda n, m: m == 1 and n > 1, lambda rows: [[Fraction(0)] for _ in rows])),
    # Results
    "results have 11 bits": ("map1_eval.ordinary", _result(_significant(11))),
    "results are whole numbers": ("map1_eval.ordinary", _result(lambda x: Fraction(round(x)))),
    "results have 16 bits behind the point": ("map1_eval.tiny", _result(
        lambda x: Fraction(round(x * 2**16), 2**16))),
    "results end at 2^16": ("map1_eval.promised-range", _result(lambda x: _clamped(f32(x), -2**16, 2**16))),
    "results have no sign": ("map1_eval.ordinary", _result(lambda x: abs(f32(x)))),
    "colours are clamped": ("map1_eval.ordinary", _components(
        _is("COLOR_4"), lambda v: [_clamped(x) for x in v])),
    "colours are BGRA": ("map1_eval.ordinary", _components(_is("COLOR_4"), lambda v: [v[2], v[1], v[0], v[3]])),
    "alpha is 1": ("map1_eval.ordinary", _components(_is("COLOR_4"), _replaced(3, Fraction(1)))),
    "indices are whole numbers": ("map1_eval.ordinary", _components(
        _is("INDEX"), lambda v: [Fraction(int(x)) for x in v])),
    "normals have length 1": ("map1_eval.ordinary", _components(
        _is("NORMAL"), lambda v: unit(v) if any(v) else v)),
    "t is s": ("map1_eval.ordinary", _components(_is("TEXTURE_COORD_2"), _replaced(1, lambda v: v[0]))),
    "q divides texture coordinates": ("map1_eval.ordinary", _components(
        _is("TEXTURE_COORD_4"), lambda v: [f32(x / v[3]) if v[3] else x for x in v])),
    "z is 0": ("map1_eval.ordinary", _components(_is("VERTEX_3"), _replaced(2, Fraction(0)))),
    "w is 1": ("map1_eval.weights", _components(_is("VERTEX_4"), _replaced(3, Fraction(1)))),
    "w divides": ("map1_eval.weights", _components(
        _is("VERTEX_4"), lambda v: [f32(x / v[3]) if v[3] else x for x in v])),
    "w has no sign": ("map1_eval.weights", _components(_is("VERTEX_4"), _replaced(3, lambda v: abs(v[3])))),
    "w of surfaces has no sign": ("map2_eval.weights", _components(
        _is("VERTEX_4"), _replaced(3, lambda v: abs(v[3])))),
    # Points of grids
    "grids have one point less": ("grid.inside", {"grid_argument": lambda self, g: (
        g.first + Fraction(g.index * (g.last - g.first), g.segments + 1))}),
    "points of grids count from 1": ("grid.inside", _index(lambda g: g.index + 1)),
    "points of grids are the middles of segments": ("grid.inside", _index(lambda g: g.index + Fraction(1, 2))),
    "indices are clamped": ("grid.index-outside", _index(lambda g: _clamped(g.index, 0, g.segments))),
    "indices repeat": ("grid.index-outside", _index(lambda g: g.index % (g.segments + 1))),
    "indices have no sign": ("grid.index-outside", _index(lambda g: abs(g.index))),
    "indices have 16 bits": ("grid.many-segments", _index(lambda g: _wrapped(g.index, 16))),
    "indices have 31 bits and a sign": ("grid.far-index", _index(lambda g: _wrapped(g.index, 31))),
    "segments have 16 bits": ("grid.many-segments", {"grid_argument": lambda self, g: (
        g.first + Fraction(g.index * (g.last - g.first), g.segments % 2**16 or 1))}),
    "segments have 11 bits": ("grid.awkward", {"grid_argument": lambda self, g: (
        g.first + g.index * _significant(11)((g.last - g.first) / g.segments))}),
    "grids run upwards": ("grid.reversed", {"grid_argument": lambda self, g: (
        min(g.first, g.last) + Fraction(g.index * abs(g.last - g.first), g.segments))}),
    "grids begin at 0": ("grid.offset", {"grid_argument": lambda self, g: (
        Fraction(g.index * (g.last - g.first), g.segments))}),
    "grids are those of 0 to 1": ("grid.outside-domain", {"grid_argument": lambda self, g: (
        Fraction(g.index, g.segments))}),
    "points of grids of equal ends go on": ("grid.equal-ends", {"grid_argument": lambda self, g: (
        g.exact if g.first != g.last else g.first + Fraction(g.index, g.segments))}),
    # Automatic normals
    "normals are turned": ("auto_normal.plane", {"oriented": lambda self, n, d: [-x for x in n]}),
    "normals are not scaled to length 1": ("auto_normal.size", {"oriented": lambda self, n, d: [2 * x for x in n]}),
    "normals point upwards": ("auto_normal.plane", {"oriented": lambda self, n, d: [*n[:2], abs(n[2])]}),
    "normals have 8 bits": ("auto_normal.saddle", {"oriented": lambda self, n, d: [
        Fraction(round(x * 64), 64) for x in n]}),
    "normals are those of the outer control points": ("auto_normal.curved", {"derivatives": _by_chords}),
    "normals by differences of 1/16": ("auto_normal.curved", _by_differences(Fraction(1, 16))),
    "normals by differences of 1/64 at high orders": ("auto_normal.high-order", _by_differences(Fraction(1, 64))),
    "normals with u and v exchanged": ("auto_normal.curved", _parameters(lambda t, s: (s, t))),
    "normals are those at the nearer end outside": ("auto_normal.outside", _fraction(
        lambda u, a, b: _clamped((u - a) / (b - a)))),
    "normals leave w out": ("auto_normal.weights", {"normal": lambda self, the_map, arguments: (
        Evaluator.normal(self, _without_w(the_map), arguments))}),
    "normals are turned where w is negative": ("auto_normal.negative-w", _normal_of(
        lambda m, a: m.size == 4 and m.points[0][0][3] < 0, lambda n: [-x for x in n])),
    "normals of rational maps have no z": ("auto_normal.cylinder", _normal_of(
        lambda m, a: m.size == 4, lambda n: [n[0], n[2], n[1]])),
    "normals at grid points are those at the last one": ("auto_normal.grid", {
        "grid_argument": lambda self, g: g.last}),
}


def evaluator_of(methods):
    return type("Wrong", (Evaluator,), methods)()
