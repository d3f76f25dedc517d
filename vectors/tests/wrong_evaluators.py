"""Wrong evaluators, each with the theme of the vectors that has to catch it."""

from fractions import Fraction

from played import Evaluator, f32, f64


def _counted(first, last, segments, index, rounding, fused=False):
    """index * du + first, rounded after each operation; `fused`: not after the product."""
    step = rounding(rounding(last - first) / segments)
    way = index * step
    return rounding((way if fused else rounding(way)) + first)


def _without_exact_end(rounding, fused=False):
    return lambda self, g: _counted(g.first, g.last, g.segments, g.index, rounding, fused)


def _from_last_end(rounding, fused=False):
    return lambda self, g: _counted(g.last, g.first, g.segments, g.segments - g.index, rounding, fused)


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
}


def evaluator_of(methods):
    return type("Wrong", (Evaluator,), methods)()
