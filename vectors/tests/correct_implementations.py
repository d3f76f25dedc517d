"""A correct evaluator and a correct state machine, of which tests replace single steps by wrong ones.

Both are exact up to a final rounding. `wrong_evaluator` and `wrong_state_machine` run a case and return a message
about the first answer that is not accepted, or an empty string.
"""

import sys
from fractions import Fraction
from math import comb, isqrt
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from checker.accuracy import Grid
from checker.gl import Context, Value
from checker.gl_commands import command_named
from checker.maps import read_map
from checker.normals import cross
from checker.number import BINARY32, BINARY64, exponent, float_text, power, read_float, read_rational
from checker.report import members
from checker.sequences import _kind_of_answer, accepted_answers

METHOD = Fraction(2, 1000)


def rounded(x, form=BINARY32):
    """x in the format, ties to even, without overflow."""
    if x == 0:
        return x
    place = power(form.quantum(exponent(x)))
    return round(x / place) * place


def f32(x):
    return rounded(x, BINARY32)


def f64(x):
    return rounded(x, BINARY64)


def unit(vector):
    """The vector scaled to length 1, to some 30 digits."""
    length = Fraction(isqrt(int(sum(x * x for x in vector) * 4**200)), 2**200)
    return [x / length for x in vector]


class Evaluator:
    """The steps of the evaluation of maps. Numbers are Fractions; `form` is the format of the numbers of the map.

    If `number` is float and the control values are floats, polynomials are computed in double precision.
    """
    form = BINARY32
    number = Fraction

    def grid_argument(self, grid):
        return grid.exact

    def fraction_of(self, u, first, last):
        return (u - first) / (last - first)

    def basis(self, n, t):
        return [comb(n, i) * t**i * (1 - t)**(n - i) for i in range(n + 1)]

    def combined(self, values, t):
        """The value of a polynomial of one variable."""
        return sum(b * x for b, x in zip(self.basis(len(values) - 1, t), values))

    def component(self, rows, t, s):
        """The value of the surface rows[i][j] at (t, s); a curve has one column."""
        return self.combined([self.combined(row, s) for row in rows], t)

    def derivative(self, values, t):
        n = len(values) - 1
        return n * self.combined([b - a for a, b in zip(values, values[1:])], t) if n else Fraction(0)

    def derivatives(self, rows, t, s):
        return (self.derivative([self.combined(row, s) for row in rows], t),
                self.combined([self.derivative(row, s) for row in rows], t))

    def oriented(self, normal, domain):
        return normal

    def result(self, x):
        return f32(x)

    # Composition of cases

    def parameters(self, the_map, arguments):
        found = []
        for argument, first, last in zip(arguments, the_map.domain[::2], the_map.domain[1::2]):
            u = self.grid_argument(argument) if isinstance(argument, Grid) else argument
            found.append(self.number(self.fraction_of(u, first, last)))
        return (*found, self.number(0))[:2]

    def values(self, the_map, arguments):
        t, s = self.parameters(the_map, arguments)
        return [self.result(Fraction(self.component(rows, t, s))) for rows in the_map.nets()]

    def normal(self, the_map, arguments):
        t, s = self.parameters(the_map, arguments)
        p_u, p_v = zip(*(self.derivatives(rows, t, s) for rows in the_map.nets()))
        if the_map.size == 4:
            p = [self.component(rows, t, s) for rows in the_map.nets()]
            p_u, p_v = ([p[3] * d[c] - d[3] * p[c] for c in range(3)] for d in (p_u, p_v))
        m = [Fraction(x) for x in cross(p_u, p_v)]
        return self.oriented(unit(m), the_map.domain) if any(m) else [Fraction(0)] * 3


def _number(text, form=BINARY32):
    return read_float(text, form)


def outside(x, accept):
    return accept is not None and not _number(accept[0]) <= x <= _number(accept[1])


def wrong_normal(found, normal):
    accept = found["accept"]
    if accept is None:
        return ""
    bound = _number(accept["bound"]) + METHOD + Fraction(1, 2**70)
    right = [read_rational(c["enclosure"][0]) for c in found["normal"]]
    for sign in (1, -1) if accept["either_sign"] else (1,):
        if all(abs(x - sign * y) <= bound for x, y in zip(normal, right)):
            return ""
    return f"normal {[float(x) for x in normal]}"


def wrong_evaluator(evaluator, case):
    """Returns a message about the answer to a case of map1_eval, map2_eval, grid or auto_normal; empty if accepted."""
    the_map, form = read_map(case["map"], members)
    evaluator.form = form

    def argument(found):
        if isinstance(found, str):
            return read_float(found, form)
        return Grid(found["segments"], read_float(found["first"], form), read_float(found["last"], form),
                    found["index"])
    arguments = [argument(case[name]) for name in "uv"[:the_map.dimension]]
    if "derivatives" in case:
        return wrong_normal(case, evaluator.normal(the_map, arguments)) if case["accept"] else ""
    if all(component["accept"] is None for component in case["components"]):
        return ""
    for c, (x, found) in enumerate(zip(evaluator.values(the_map, arguments), case["components"])):
        if outside(x, found["accept"]):
            return f"component {c} is {float(x)}"
    return ""


class Machine(Context):
    """A state machine whose evaluator can be replaced."""
    evaluator = Evaluator()

    def value_of(self, component):
        return component


def _text(x):
    return "0x0p+0" if x == "-0x0p+0" else x


def _wrong_vertex(machine, vertex, found):
    for name, entry in found.items():
        expected = vertex.get(name)
        if expected is None:
            return f"no {name}"
        if name == "automatic_normal":
            if entry["accept"] is not None:
                message = wrong_normal(entry, unit(expected.m) if expected.m else [Fraction(0)] * 3)
                if message:
                    return message
            continue
        rows = zip(expected, entry) if name == "texture_coordinates" else ((expected, entry),)
        for values, entries in rows:
            if len(values) != len(entries):
                return f"{name}: {len(values)} components"
            for x, y in zip(values, entries):
                is_given = isinstance(x, str)
                number = read_float(x, BINARY32) if is_given else f32(x.value)
                if isinstance(y, str):
                    if number != read_float(y, BINARY32):
                        return f"{name} is {float(number)}, not {y}"
                elif outside(number, y["accept"]):
                    return f"{name} is {float(number)}, not {y['float']}"
    return ""


def _wrong_summary(machine, emitted, found):
    sizes = [(mode, size) for mode, size, times in found["primitives"] for _ in range(times)]
    if [(p.mode, len(p.vertices)) for p in emitted] != sizes:
        return "other primitives"
    vertices = [vertex for p in emitted for vertex in p.vertices]
    messages = (_wrong_vertex(machine, vertices[s["number"]], s["vertex"]) for s in found["samples"])
    return next(filter(None, messages), "")


def _wrong_step(machine, step, answer, primitive):
    if not machine.primitive and "errors" in step:
        codes, machine.errors = machine.errors, set()
        if bool(codes) != bool(step["errors"]) or (codes and not codes & set(step["errors"])):
            return f"errors {sorted(codes)}, not {step['errors']}"
    if "answers" in step:
        kind = _kind_of_answer(step["call"], command_named(step["call"][0])[1])
        if len(answer or []) != len(step["answers"]):
            return f"{len(answer or [])} answers"
        for value, accepted in zip(answer, step["answers"]):
            if isinstance(accepted[0], dict):
                if value.value < accepted[0]["at_least"]:
                    return f"answers {value.value}"
                continue
            given = accepted_answers(value, kind)
            if given is not None and not set(given) & set(map(_text, accepted)):
                return f"answers {given}, not {accepted}"
    if "emits" in step:
        emitted, machine.emitted = machine.emitted, []
        if isinstance(step["emits"], dict):
            return _wrong_summary(machine, emitted, step["emits"])
        if [(p.mode, len(p.vertices)) for p in emitted] != [(p["mode"], len(p["vertices"]))
                                                              for p in step["emits"]]:
            return "other primitives"
        for p, found in zip(emitted, step["emits"]):
            for vertex, entry in zip(p.vertices, found["vertices"]):
                message = _wrong_vertex(machine, vertex, entry)
                if message:
                    return message
    return ""


def wrong_state_machine(kind, case):
    """Returns a message about a sequence that a machine of this class runs; empty if all steps are accepted."""
    machine = kind()
    for i, step in enumerate(case["steps"]):
        answer = machine.issue(step["call"][0], step["call"][1:])
        message = _wrong_step(machine, step, answer, None)
        if message:
            return f"step {i} ({step['call'][0]}): {message}"
    return ""
