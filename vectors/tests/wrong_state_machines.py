"""Wrong state machines, each with the theme of the vectors that has to catch it."""

from checker.accuracy import Grid
from checker.number import BINARY64, read_float
from played import Machine, f32, f64
from wrong_evaluators import _counted


def _points(coordinate):
    """Evaluates points of grids at coordinate(grid)."""
    def evaluate_point(self, dimension, indices):
        def exact(text):
            return read_float(text, BINARY64)
        grids = [Grid(n, exact(first), exact(last), i)
                 for (n, first, last), i in zip(self.grids[dimension], indices)]
        self.evaluate(dimension, [coordinate(self, d, grid) for d, grid in enumerate(grids)])
    return evaluate_point


def _counted_from_first(rounding, condition=lambda machine, d, g: True):
    return {"evaluate_point": _points(lambda machine, d, g: (
        _counted(g.first, g.last, g.segments, g.index, rounding) if condition(machine, d, g) else g))}


def _counted_from_last(rounding, condition=lambda machine, d, g: True):
    return {"evaluate_point": _points(lambda machine, d, g: (
        _counted(g.last, g.first, g.segments, g.segments - g.index, rounding) if condition(machine, d, g)
        else g))}


def _mode(*modes):
    return lambda machine, d, g: machine.primitive.mode in modes


# Name: (kind.theme, {method or attribute of Machine: what takes its place}).
WRONG_STATE_MACHINES = {
    # Ends of grids
    "last end by float arithmetic": ("state.exact-ends", _counted_from_first(f32)),
    "last end by double arithmetic": ("state.exact-ends", _counted_from_first(f64)),
    "first end by float arithmetic": ("state.exact-ends", _counted_from_last(f32)),
    "last end of strips of lines": ("state.exact-ends", _counted_from_first(f32, _mode("GL_LINE_STRIP"))),
    "last end of strips of quads": ("state.exact-ends", _counted_from_first(f32, _mode("GL_QUAD_STRIP"))),
    "last end of v": ("state.exact-ends", _counted_from_first(f32, lambda m, d, g: d == 1)),
    "first end of v in quads": ("state.exact-ends", _counted_from_last(f32, lambda m, d, g: (
        d == 1 and m.primitive.mode == "GL_QUAD_STRIP"))),
    "last end of u in two dimensions": ("state.exact-ends", _counted_from_first(f32, lambda m, d, g: (
        d == 0 and m.primitive.mode != "GL_LINE_STRIP"))),
}


def machine_of(members):
    return type("Wrong", (Machine,), members)
