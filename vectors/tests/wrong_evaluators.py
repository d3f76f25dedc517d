"""Wrong evaluators, each with the theme of the vectors that has to catch it."""

from fractions import Fraction
from math import comb

from played import Evaluator, f32, f64, unit


def _counted(first, last, segments, index, rounding, fused=False):
    """index * du + first, rounded after each operation; `fused`: not after the product."""
    step = rounding(rounding(last - first) / segments)
    way = index * step
    return rounding((way if fused else rounding(way)) + first)


def _without_exact_end(rounding, fused=False):
    return lambda self, g: _counted(g.first, g.last, g.segments, g.index, rounding, fused)


def _from_last_end(rounding, fused=False):
    return lambda self, g: _counted(g.last, g.first, g.segments, g.segments - g.index, rounding, fused)


def _orders(condition, change):
    """`component` with other rows where condition(uorder, vorder) holds."""
    def component(self, rows, t, s):
        return Evaluator.component(self, change(rows) if condition(len(rows), len(rows[0])) else rows, t, s)
    return {"component": component}


def _components(condition, change):
    """`values` changed where condition(target, form) holds."""
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


# Name: (kind.theme, {method of Evaluator: what takes its place}).
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
}


def evaluator_of(methods):
    return type("Wrong", (Evaluator,), methods)()
