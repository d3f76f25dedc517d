#!/usr/bin/env python3
"""Tests of the checker: its arithmetic against known values, and that it notices everything that is wrong."""

import contextlib
import copy
import io
import json
import random
import struct
import sys
import tempfile
import unittest
from fractions import Fraction as F
from math import comb, hypot, inf, ldexp
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import check
from checker import gl, maps
from checker.accuracy import EPS, POINT, Component, Direction, Grid, quotient_interval
from checker.bernstein import de_casteljau
from checker.files import check_case
from checker.normals import Normal
from checker.number import (BINARY32, BINARY64, Malformed, exponent, float_text, greatest_not_above,
                            least_not_below, nearest, nearest_bits, nearest_root, read_float, read_rational)
from checker.sequences import accepted_answers

SAMPLES = sorted((Path(__file__).parent / "sample").glob("*.json"))


def to_binary32(x):
    """A double rounded by the machine."""
    try:
        return struct.unpack("f", struct.pack("f", x))[0]
    except OverflowError:
        return inf if x > 0 else -inf


def bits_of(x):
    return struct.unpack("I", struct.pack("f", x))[0]


def value(text):
    return float.fromhex(text)


class Numbers(unittest.TestCase):
    def test_rounding_agrees_with_the_machine(self):
        random.seed(1)
        for _ in range(4000):
            x = random.choice((-1, 1)) * ldexp(random.random(), random.randint(-160, 130))
            self.assertEqual(value(nearest(F(x), BINARY32)), to_binary32(x))
            self.assertEqual(nearest_bits(F(x)), bits_of(to_binary32(x)))
            n, d = random.getrandbits(200) + 1, random.getrandbits(random.choice((50, 190, 230))) + 1
            self.assertEqual(value(nearest(F(n, d), BINARY64)), n / d)
            self.assertEqual(value(nearest(F(n, d << 1150), BINARY64)), float(F(n, d << 1150)))

    def test_ties_underflow_and_overflow(self):
        for x, text in ((1 + F(1, 2**24), "0x1p+0"), (1 + F(3, 2**24), "0x1.000004p+0"),
                        (1 + F(1, 2**24) + F(1, 2**200), "0x1.000002p+0"), (-1 - F(1, 2**24), "-0x1p+0"),
                        (F(1, 2**149), "0x1p-149"), (F(1, 2**150), "0x0p+0"), (-F(1, 2**150), "-0x0p+0"),
                        (F(3, 2**150), "0x1p-148"), (F(5, 2**150), "0x1p-148"), (F(0), "0x0p+0"),
                        (F(1, 2**150) + F(1, 2**900), "0x1p-149"), (-F(1, 10**99), "-0x0p+0"),
                        (F(2**24 - 1, 2**150), "0x1p-126"), (F(2)**128 - F(2)**103, "inf"),
                        (F(2)**128 - F(2)**103 - 1, "0x1.fffffep+127"), (-F(2)**128, "-inf")):
            self.assertEqual(nearest(x, BINARY32), text)
            self.assertEqual(nearest_bits(x), bits_of(value(text)))
        self.assertEqual(nearest(F(2)**1024 - F(2)**970, BINARY64), "inf")
        self.assertEqual(nearest(F(2)**1024 - F(2)**970 - 1, BINARY64), "0x1.fffffffffffffp+1023")

    def test_neighbours(self):
        random.seed(2)
        for _ in range(500):
            x = F(random.randint(-10**9, 10**9), random.randint(1, 10**9)) * F(2)**random.randint(-160, 120)
            below, above = greatest_not_above(x, BINARY32), least_not_below(x, BINARY32)
            self.assertTrue(below <= x <= above and BINARY32.holds(below) and BINARY32.holds(above))
            self.assertIn(read_float(nearest(x, BINARY32), BINARY32), (below, above))
        self.assertEqual(greatest_not_above(F(2)**200, BINARY32), BINARY32.limit())
        self.assertIsNone(greatest_not_above(-F(2)**200, BINARY32))

    def test_roots(self):
        for x in (F(2), F(1, 3), F(1, 10**40), F(9, 16)):
            self.assertAlmostEqual(value(nearest_root(x, -1, BINARY64)) / float(x)**0.5, -1, places=15)
        tie = 1 + F(1, 2**24)
        for square, text in ((tie**2, "0x1p+0"), (tie**2 + F(1, 2**300), "0x1.000002p+0"),
                             ((1 + F(3, 2**24))**2 - F(1, 2**300), "0x1.000002p+0"), (F(0), "0x0p+0"),
                             (F(1, 2**300), "0x0p+0"), (F(1, 2**300) + F(1, 2**700), "0x1p-149")):
            self.assertEqual(nearest_root(square, 1, BINARY32), text)

    def test_texts(self):
        for text in ("0x0p+0", "-0x0p+0", "0x1p-149", "-0x1.8p-3", "0x1.fffffep+127", "0x1.0001p+0"):
            self.assertEqual(float_text(read_float(text, BINARY32), text == "-0x0p+0"), text)
        for text in ("0x1.0p+0", "0x1p0", "0x1p+00", "0x1p-0", "0x2p+0", "0x1.Ap+0", "1", "inf", "nan", "",
                     None, 1, "0x0p-0", "0x1p-150", "0x1.0000001p+0", "0x1p+128", "0x1p+99999999",
                     "0x1.8p-149", ["0x1p+0"]):
            self.assertRaises(Malformed, read_float, text, BINARY32)
        self.assertEqual(read_rational("-3/8"), F(-3, 8))
        for text in ("3", "6/8", "-0/1", "0/2", "3/-8", "+3/8", "03/8", "3/8 ", "3/0", None, 3):
            self.assertRaises(Malformed, read_rational, text)


def plain_error(net, u, v, single, k_more=0):
    """The accuracy rule of INTERPRETING.md, term by term."""
    n, m = len(net) - 1, len(net[0]) - 1

    def form(a, b, c, d):
        return sum(comb(n, i) * a**i * b**(n - i) * comb(m, j) * c**j * d**(m - j) * abs(net[i][j])
                   for i in range(n + 1) for j in range(m + 1))

    def widened(direction):
        width = abs(direction.last - direction.first)
        tau = F(1, 2**126) * (1 + 2 / width)
        grid = direction.grid
        if grid and grid.index not in (0, grid.segments):
            du = (grid.last - grid.first) / grid.segments
            tau += EPS * (4 * abs(grid.index * du) + abs(direction.u)) / width
        if not single:
            size = abs(direction.u)
            if grid:
                share = abs(F(grid.index, grid.segments))
                size = abs(grid.first) + share * (abs(grid.first) + abs(grid.last))
            size += abs(direction.s * direction.first) + abs(direction.t * direction.last)
            tau += F(1, 2**23) * size / width
        t, s = abs(direction.t), abs(direction.s)
        return (1 + 8 * EPS) * t + tau, (1 + 8 * EPS) * s + 8 * EPS * t + tau
    flat = v is POINT
    k = (5 * n + 4 if flat else n * m + 5 * (n + m) + 4) + (0 if single else 1) + k_more
    x = k * EPS
    underflow = k * F(1, 2**126) * max(1, abs(u.t), abs(u.s))**n * max(1, abs(v.t), abs(v.s))**m * sum(
        comb(n, i) * comb(m, j) * max(1, abs(net[i][j])) for i in range(n + 1) for j in range(m + 1))
    exact = form(abs(u.t), abs(u.s), abs(v.t), abs(v.s))
    wide = form(*widened(u), *((1, 1) if flat else widened(v)))
    return (1 + x + x * x) * wide - exact + underflow


def some(kind="f"):
    x = random.choice((0.0, 1.0, random.uniform(-4, 4), random.uniform(-1, 1) * 2**random.randint(-20, 20)))
    return F(x if kind == "d" else to_binary32(x))


def direction(degree, kind):
    first = some(kind)
    argument = some(kind)
    if random.random() < 0.4:
        argument = Grid(random.randint(1, 7), some(kind), some(kind), random.randint(-1, 8))
    return Direction(first, first + F(random.choice((-3, 1, F(1, 8)))), argument, degree)


class Evaluation(unittest.TestCase):
    def test_against_the_plain_formula(self):
        random.seed(3)
        for _ in range(60):
            kind, n, m = random.choice("fd"), random.randint(0, 5), random.randint(0, 4)
            u, v = direction(n, kind), direction(m, kind)
            if random.random() < 0.4:
                m, v = 0, POINT
            net = [[some(kind) for _ in range(m + 1)] for _ in range(n + 1)]
            component = Component(net, u, v)
            by_rows = [de_casteljau(row, v.t, v.s)[-1][0] for row in net]
            self.assertEqual(component.value, de_casteljau(by_rows, u.t, u.s)[-1][0])
            single = all(BINARY32.holds(x) for x in (*u.inputs, *v.inputs, *sum(net, [])))
            self.assertEqual(component.single, single)
            self.assertEqual(component.error, plain_error(net, u, v, single))

    def test_where_the_rule_applies(self):
        def judged(points, u=F(1, 2), first=F(0), last=F(1), color=False):
            direction_ = Direction(first, last, u if isinstance(u, Grid) else F(u), len(points) - 1)
            return Component([[F(x)] for x in points], direction_, POINT, color).judged
        self.assertTrue(judged([2**32]) and judged([2**10], color=True) and judged([F(1, 2**149)]))
        self.assertFalse(judged([2**32 + 1]) or judged([2**10 + 1], color=True))
        self.assertTrue(judged([1, 1], u=2**31))
        self.assertFalse(judged([0, 0], u=2**32) or judged([2, 2], u=2**31))
        self.assertTrue(judged([1], u=F(1, 2**149)))
        self.assertFalse(judged([1], first=F(1, 2**140)) or judged([1], last=F(1, 2**127)))
        self.assertFalse(judged([1], u=F(1), first=F(1), last=1 + F(1, 2**40)))
        self.assertTrue(judged([1], u=F(2)**128 - F(2)**103 - 1))
        self.assertFalse(judged([1], u=F(2)**128 - F(2)**103))
        self.assertTrue(judged([1], u=Grid(2, F(2)**127, -F(2)**126, 1)))
        self.assertFalse(judged([1], u=Grid(2, F(2)**127, -F(2)**127, 1)))
        self.assertFalse(judged([1], u=Grid(2, F(0), F(2)**126, 8)))
        self.assertTrue(judged([1], last=F(1, 2**60)) and judged([1], last=F(2**60)))
        self.assertFalse(judged([1], last=F(1, 2**61)) or judged([1], last=F(2**61)))

    def test_quotients_need_a_sure_denominator(self):
        u = Direction(F(0), F(1), F(1, 2), 1)
        ends = (1, 1), (1, 2), (1, -1 + F(1, 2**12))
        x, w, small = (Component([[F(a)], [F(b)]], u, POINT) for a, b in ends)
        low, high = quotient_interval(x, w)
        self.assertTrue(low < F(2, 3) < high and high - low < F(1, 1000))
        self.assertIsNone(quotient_interval(x, small))

    def test_normals(self):
        """A plane with w: the unit vector and its bound against ordinary arithmetic."""
        rows = [[[F(i), F(j), F(0), F(1 + i)] for j in range(2)] for i in range(2)]
        nets = [[[point[c] for point in row] for row in rows] for c in range(4)]
        normal = Normal(nets, Direction(F(0), F(1), F(1, 2), 1), Direction(F(0), F(1), F(1, 4), 1))
        self.assertEqual(normal.m, [0, 0, F(8, 27)])
        self.assertTrue(normal.judged())
        self.assertTrue(normal.at_least(2, F(1)) and normal.at_most(2, F(1)))
        self.assertFalse(normal.at_least(2, 1 + F(1, 2**200)) or normal.at_most(2, 1 - F(1, 2**200)))
        bound = normal.bound_estimate()
        exact = 2 * hypot(*self.plain_d(nets, normal)) / float(F(9, 4) * F(2, 3)) + 10 * float(EPS)
        self.assertAlmostEqual(bound / exact, 1, places=12)
        self.assertTrue(normal.bounds(F(bound * (1 + 5e-7))))
        self.assertFalse(normal.bounds(F(bound * (1 + 2e-6))) or normal.bounds(F(bound * (1 - 1e-9))))

    @staticmethod
    def plain_d(nets, normal):
        u, v = normal.u, normal.v
        values = [c.value for c in normal.components]
        errors = [plain_error(net, u, v, True) for net in nets]

        def derivative(net, c):
            first = [[y - x for x, y in zip(*net)]], [[abs(y) + abs(x) for x, y in zip(*net)]]
            second = ([[row[1] - row[0]] for row in net], [[abs(row[1]) + abs(row[0])] for row in net])
            flat_u, flat_v = Direction(u.first, u.last, u.u, 0), Direction(v.first, v.last, v.u, 0)
            return ((Component(first[0], flat_u, v).value, plain_error(first[1], flat_u, v, True, 3)),
                    (Component(second[0], u, flat_v).value, plain_error(second[1], u, flat_v, True, 3)))

        def product_error(x, y, z, w):
            first = (abs(x[0]) + x[1]) * (abs(y[0]) + y[1])
            second = (abs(z[0]) + z[1]) * (abs(w[0]) + w[1])
            return (1 + 3 * EPS) * (first + second) - abs(x[0] * y[0]) - abs(z[0] * w[0])
        slopes = [derivative(net, c) for c, net in enumerate(nets)]
        tangents = []
        for d in range(2):
            dw, w = slopes[3][d], (values[3], errors[3])
            tangents.append([(w[0] * slopes[c][d][0] - dw[0] * values[c],
                              product_error(w, slopes[c][d], dw, (values[c], errors[c]))) for c in range(3)])
        a, b = tangents
        return [product_error(a[i], b[j], a[j], b[i]) for i, j in ((1, 2), (2, 0), (0, 1))]


class Sequences(unittest.TestCase):
    """Tests of the model of the GL: commands with their expected errors and answers."""

    def run_all(self, *calls):
        context = gl.Context()
        for name, *arguments in calls:
            context.issue(name, arguments)
        return context

    def test_begin_end(self):
        context = self.run_all(("End",), ("Begin", "GL_POLYGON"), ("Begin", "GL_POINTS"), ("Vertex2i", 1, 2))
        self.assertEqual(context.errors, {gl.OPERATION})
        context.issue("End", [])
        self.assertEqual(context.emitted[0].mode, "GL_POLYGON")
        self.assertEqual(context.emitted[0].vertices[0]["position"], ["0x1p+0", "0x1p+1", "0x0p+0", "0x1p+0"])
        self.assertEqual(self.run_all(("Begin", "GL_LINE")).errors, {gl.ENUM})

    def test_map_errors(self):
        points = {"f32": ["0x0p+0"] * 16}

        def errors(target, u1, u2, stride, order):
            return self.run_all(("Map1f", target, u1, u2, stride, order, points)).errors
        self.assertEqual(errors("GL_MAP1_VERTEX_3", gl.ZERO, gl.ONE, 3, 2), set())
        self.assertEqual(errors("GL_MAP1_VERTEX_3", gl.ZERO, "-0x0p+0", 3, 2), {gl.VALUE})
        self.assertEqual(errors("GL_MAP1_VERTEX_4", gl.ZERO, gl.ONE, 3, 1), {gl.VALUE})
        self.assertEqual(errors("GL_MAP1_INDEX", gl.ZERO, gl.ONE, 1, 65), {gl.VALUE})
        self.assertEqual(errors("GL_MAP2_INDEX", gl.ONE, gl.ONE, 1, 1), {gl.ENUM, gl.VALUE})
        context = self.run_all(("ActiveTexture", "GL_TEXTURE1"),
                               ("Map1f", "GL_MAP1_INDEX", gl.ZERO, gl.ONE, 1, 1, points))
        self.assertEqual(context.errors, {gl.OPERATION})

    def test_lists(self):
        context = self.run_all(("NewList", 3, "GL_COMPILE"), ("MapGrid1f", 0, gl.ZERO, gl.ONE),
                               ("Enable", "GL_MAP1_INDEX"), ("EndList",))
        self.assertEqual(context.errors, set())
        self.assertFalse(context.enabled["GL_MAP1_INDEX"])
        context.issue("ListBase", [1])
        context.issue("CallLists", [1, "GL_2_BYTES", {"u8": [0, 2]}])
        self.assertEqual(context.errors, {gl.VALUE})
        self.assertTrue(context.enabled["GL_MAP1_INDEX"])

    def test_stack(self):
        context = self.run_all(("PushAttrib", "GL_EVAL_BIT"), ("MapGrid1f", 5, gl.ZERO, gl.ONE),
                               ("PushAttrib", "GL_ENABLE_BIT"), ("Enable", "GL_AUTO_NORMAL"),
                               ("MapGrid1f", 6, gl.ZERO, gl.ONE), ("PopAttrib",))
        self.assertEqual(context.grids[1][0][0], 6)
        self.assertFalse(context.enabled["GL_AUTO_NORMAL"])
        context.issue("PopAttrib", [])
        self.assertEqual(context.grids[1][0][0], 1)
        context.issue("PopAttrib", [])
        self.assertEqual(context.errors, {gl.UNDERFLOW})

    def test_enumerants_by_number(self):
        """Enumerants are numbers only where no valid name has this number."""
        self.assertEqual(self.run_all(("EvalMesh1", 7, 0, 1), ("Begin", 4096)).errors, {gl.ENUM})
        self.assertRaises(Malformed, self.run_all, ("EvalMesh1", 0x1B01, 0, 1))
        self.assertRaises(Malformed, self.run_all, ("Begin", 0))

    def test_answers(self):
        """Rounding, saturation, and what may be stored in single precision."""
        def accepted(kind, text, query):
            return accepted_answers(gl.Value(kind, text), query)
        self.assertEqual(accepted("float", "0x1.4p+1", "i32"), {2, 3})
        self.assertEqual(accepted("float", "-0x1.9p+0", "i32"), {-2})
        self.assertEqual(accepted("float", "0x1p+99", "i32"), {2**31 - 1})
        self.assertEqual(accepted("float", "-0x0p+0", "f32"), {"0x0p+0"})
        self.assertEqual(accepted("float", "0x1.00000001p+0", "f64"),
                         {"0x1p+0", "0x1.00000001p+0", "0x1.000002p+0"})
        self.assertEqual(accepted("flag", True, "f64"), {"0x1p+0"})
        self.assertEqual(accepted("integer", 2**31 - 1, "f64"), {"0x1.fffffffcp+30"})
        self.assertEqual(accepted("integer", 2**31 - 1, "f32"), {"0x1.fffffep+30", "0x1p+31"})
        self.assertEqual(accepted("either", "0x1p+0", "i32"), {1, 2**31 - 1})
        self.assertEqual(accepted("either", "0x1p+1", "i32"), {2, 2**31 - 1})

    def test_meshes(self):
        context = self.run_all(("EvalMesh1", "GL_FILL", 0, 1), ("EvalMesh2", "GL_LINE", 0, 1, 0, 2))
        self.assertEqual((context.errors, context.emitted), ({gl.ENUM}, []))
        context = self.run_all(("Enable", "GL_MAP2_VERTEX_3"), ("EvalMesh2", "GL_LINE", 0, 1, 0, 2),
                               ("EvalMesh2", "GL_FILL", 0, 2, 0, 2), ("EvalMesh2", "GL_POINT", 0, 2, 0, 2))
        self.assertEqual([(p.mode[3:], len(p.vertices)) for p in context.emitted],
                         [("LINE_STRIP", 2)] * 3 + [("LINE_STRIP", 3)] * 2 + [("QUAD_STRIP", 6)] * 2
                         + [("POINTS", 9)])

    def test_many_vertices_are_summarised(self):
        """A correct summary is accepted, and each change of it is found."""
        context = self.run_all(("Enable", "GL_MAP1_VERTEX_3"), ("EvalMesh1", "GL_POINT", 0, 64))
        vertex = {"position": [{"exact": "0/1", "magnitude": "0/1", "float": gl.ZERO, "double": gl.ZERO,
                                "accept": ["0x0p+0", "0x0p+0"]}] * 3 + [gl.ONE]}
        position = context.emitted[0].vertices[0]["position"]
        low, high = position[0].interval()
        for component in vertex["position"][:3]:
            component["accept"] = [float_text(low), float_text(high)]
        # FNV-1a of three zeros and a one, 65 times.
        digest = 0xcbf29ce484222325
        for byte in bytes([0] * 12 + [0, 0, 0x80, 0x3f]) * 65:
            digest = (digest ^ byte) * 0x100000001b3 % 2**64
        right = {"primitives": [["GL_POINTS", 65, 1]], "digest": f"{digest:016x}",
                 "samples": [{"number": 0, "vertex": vertex}, {"number": 64, "vertex": vertex}]}

        def outcome(**changes):
            steps = [{"call": ["Enable", "GL_MAP1_VERTEX_3"], "errors": []},
                     {"call": ["EvalMesh1", "GL_POINT", 0, 64], "errors": [], "emits": right | changes}]
            case = {"id": "a", "requirements": ["r"], "flags": [], "level": "must", "since": "1.0", "steps": steps}
            return check_case(("state", case))[1:]
        self.assertEqual(outcome(), ([], []))
        samples = right["samples"]
        for changes in ({"primitives": [["GL_POINTS", 64, 1]]}, {"primitives": [["GL_POINTS", 1, 65]]},
                        {"primitives": [["GL_LINE_STRIP", 65, 1]]}, {"digest": "0" * 16},
                        {"samples": [samples[0] | {"number": 65}]}, {"samples": []},
                        {"samples": samples[::-1]}, {"samples": [samples[0], samples[0]]},
                        {"samples": [{"number": 0, "vertex": {"position": [gl.ZERO] * 4}}]},
                        {"more": 1}):
            with self.subTest(changes=changes):
                self.assertTrue(any(outcome(**changes)))

    def test_levels_and_versions(self):
        """The level, the version and the levels of the steps that a sequence has to have."""
        room = {"out": "f32", "count": 16}
        point = {"f32": [gl.ONE] * 8}

        def found(*calls):
            steps = [{"call": list(call), "errors": [], "level": "x"} for call in calls]
            for step in steps:
                if step["call"][0].startswith(("Get", "Is")):
                    step["answers"] = []
            case = {"id": "a", "requirements": ["r"], "flags": [], "level": "x", "since": "x", "steps": steps}
            differences = {where: expected for where, expected, _ in check_case(("state", case))[1]}
            levels = [differences[f"steps[{i}].level"] for i in range(len(steps))]
            return differences["level"], differences["since"], levels

        def define(u2):
            return "Map1f", "GL_MAP1_TEXTURE_COORD_2", gl.ZERO, u2, 2, 2, point
        query = "GetMapfv", "GL_MAP1_TEXTURE_COORD_2"
        self.assertEqual(found(define(gl.ONE)), ("must", "1.0", ["must"]))
        self.assertEqual(found(define("-0x0p+0"))[:2], ("advisory", "1.0"))
        self.assertEqual(found((*query, "GL_DOMAIN", room)), ("must", "1.0", ["advisory"]))
        self.assertEqual(found((*query, "GL_COEFF", room)), ("must", "1.1", ["must"]))
        self.assertEqual(found((*query, "GL_ORDER", room)), ("must", "1.0", ["must"]))
        self.assertEqual(found(define(gl.ONE), (*query, "GL_DOMAIN", room), (*query, "GL_COEFF", room)),
                         ("must", "1.0", ["must"] * 3))
        color = ("Map1f", "GL_MAP1_COLOR_4", gl.ZERO, gl.ONE, 4, 1, {"f32": ["0x1p+1"] * 4})
        integers = ("GetMapiv", "GL_MAP1_COLOR_4", "GL_COEFF", {"out": "i32", "count": 4})
        self.assertEqual(found(integers, color, integers)[2], ["must", "must", "advisory"])
        self.assertEqual(found(("ActiveTexture", "GL_TEXTURE1"))[1], "1.3")
        self.assertEqual(found(("GetnMapfv", "GL_MAP1_INDEX", "GL_COEFF", 64, room))[1], "4.5")
        push = "PushAttrib", "GL_ENABLE_BIT"
        self.assertEqual(found(push, ("Enable", "GL_AUTO_NORMAL"), ("PopAttrib",))[1], "1.1")
        self.assertEqual(found(push, ("Enable", "GL_MAP1_INDEX"), ("PopAttrib",))[1], "1.0")
        self.assertEqual(found(("PushAttrib", "GL_ENABLE_BIT|GL_EVAL_BIT"), ("Enable", "GL_AUTO_NORMAL"))[1], "1.0")

    def test_texture_coordinates_beyond_2_to_the_10(self):
        """GL guarantees the range of large texture coordinates from version 2.0 on."""
        def needs(target, greatest):
            the_map = maps.Map(1, target, [F(0), F(1)], [[[F(greatest)]]])
            return the_map.components(the_map.directions([F(1, 2)]))[0].needs_gl_2
        self.assertTrue(needs("GL_MAP1_TEXTURE_COORD_1", 2**10 + 1))
        self.assertFalse(needs("GL_MAP1_TEXTURE_COORD_1", 2**10) or needs("GL_MAP1_INDEX", 2**11)
                         or needs("GL_MAP1_TEXTURE_COORD_1", 2**33))

    def test_refused_queries_answer_nothing(self):
        context = self.run_all(("Begin", "GL_POINTS"))
        self.assertEqual(context.issue("IsEnabled", ["GL_AUTO_NORMAL"]), [])

    def test_initial_maps(self):
        context = gl.Context()
        self.assertEqual(len(context.maps), 18)
        self.assertEqual(context.maps["GL_MAP2_NORMAL"].coefficients, [gl.ZERO, gl.ZERO, gl.ONE])
        self.assertEqual(sum(maps.SIZES.values()), 4 + 1 + 3 + 1 + 2 + 3 + 4 + 3 + 4)


def leaves(node, path=()):
    """Returns the places of all results, without the names of steps and of targets."""
    if isinstance(node, dict):
        inputs = "id", "requirements", "flags", "map", "call", "segments", "first", "last", "index"
        for name, child in node.items():
            if name not in inputs:
                yield from leaves(child, (*path, name))
    elif isinstance(node, list) and node:
        for i, child in enumerate(node):
            yield from leaves(child, (*path, i))
    else:
        yield path, node


def slightly_changed(x, path):
    if isinstance(x, bool):
        return [not x]
    if isinstance(x, int):
        return [x + 2]
    if x is None or x == []:
        return [["0x1p+0", "0x1p+1"]]
    if x in ("must", "advisory"):
        return ["advisory" if x == "must" else "must"]
    if path[-1] == "since":
        return ["1.1" if x == "1.0" else "1.0"]
    if x.startswith("GL_"):
        return ["GL_NO_ERROR"]
    if "/" in x:
        # An enclosure may have any ends, as long as they are near.
        little = F(1, 2**79) if "enclosure" in path else F(1, 10**30)
        return [f"{y.numerator}/{y.denominator}" for y in (F(x) + little, F(x) - little)]
    form = BINARY64 if path[-1] in ("double", "bound") else BINARY32
    y = F(value(x))
    step = F(2)**(form.quantum(exponent(y) if y else 0) + (33 if path[-1] == "bound" else 0))
    return [float_text(y + step), float_text(y - step)]


class WholeFiles(unittest.TestCase):
    def outcome(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = check.main([*map(str, arguments), "--jobs", "1"])
        return code, out.getvalue(), err.getvalue()

    def outcome_of_text(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "vectors.json"
            path.write_bytes(text.encode())
            return self.outcome(path)

    def test_samples_agree(self):
        code, out, err = self.outcome(*SAMPLES)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(len(out.splitlines()), 7)
        self.assertEqual(self.outcome("--quiet", *SAMPLES), (0, "", ""))

    def test_every_result_is_compared(self):
        for sample in SAMPLES:
            found = json.loads(sample.read_text())
            for case in found["cases"]:
                for path, x in leaves({name: case[name] for name in case
                                       if name not in ("u", "v") or isinstance(case[name], dict)}):
                    for other in slightly_changed(x, path):
                        with self.subTest(sample=sample.stem, case=case["id"], path=path, other=other):
                            changed = copy.deepcopy(case)
                            at = changed
                            for name in path[:-1]:
                                at = at[name]
                            at[path[-1]] = other
                            _, differences, faults = check_case((found["kind"], changed))
                            self.assertTrue(differences or (faults and isinstance(other, list)))

    def test_lists_of_another_length_are_noticed(self):
        case = json.loads(SAMPLES[-1].read_text())["cases"][0]
        call = next(step for step in case["steps"] if step["call"][0] == "CallList")
        call["emits"][0]["vertices"].pop()
        self.assertTrue(check_case(("state", case))[1])

    def test_differences_name_everything(self):
        sample = next(path for path in SAMPLES if path.stem == "grid")
        code, out, err = self.outcome_of_text(sample.read_text().replace('"exact": "1/3"', '"exact": "2/3"'))
        self.assertEqual(code, 1)
        self.assertIn("vectors.json: grid.plain.1: u.exact: expected 1/3, found 2/3", err)
        self.assertIn("2 differences", out)

    def test_malformed_files(self):
        good = next(path for path in SAMPLES if path.stem == "map1_eval").read_text()
        changes = (("{", ""), ("}", ""), ('"flags": ["plain"]', '"flags": ["plain", 1]'),
                   ('"flags": ["plain"]', '"flags": ["plain", "x"]'),
                   ('"flags": ["rational"]', '"flags": []'), ("map1_eval.plain.2", "map1_eval.rational.2"),
                   ("map1_eval.plain.2", "map1_eval.plain.02"),
                   ('"plain": "nothing special"', '"plain": "nothing special", "x": "never used"'),
                   ('"u": ', '"uu": '), ('"exact": "7/9"', '"exact": "14/18"'),
                   ('"exact": "7/9"', '"exact": 1'), ('"0x1.8p+1"', '"0x1.80p+1"'),
                   ('"0x1.8p+1"', '"0x3p+0"'), ('"0x1.8p+1"', "3.5"), ('"0x1.8p+1"', "NaN"),
                   ("GL_MAP1_VERTEX_4", "GL_MAP2_VERTEX_4"), ("GL_MAP1_VERTEX_4", "GL_MAP1_VERTEX_5"),
                   ('"f"', '"x"'), ('"f"', '["f"]'), ('"f"', "null"),
                   ("evalcts-vectors-1", "evalcts-vectors-2"), ('"1.1"', '"1.0"'), ('"1"', '"x"'),
                   ('"generatorVersion": "1"', '"generatorVersion": 1'),
                   ('"numberOfTests": 2', '"numberOfTests": 3'), ('"numberOfTests": 2, ', ""),
                   ('"level": "must", ', ""), ('"since": "1.0", ', ""), ("map1_eval", "map3_eval"),
                   ('["EV-MAP1-BEZIER"]', "[]"), ('["EV-MAP1-BEZIER"]', '["a", "a"]'),
                   ('"magnitude"', '"size"'), ('"u": ', '"u": 1, "u": '), ('"cases": [\n', '"cases": ['),
                   ('"A sample."', '""'), ('"A sample."', '"\u00fc"'),
                   ('["0x1p+1", "0x1.4p+2"]', '["0x1p+1", "0x1p+1"]'),
                   ('["0x1p+1", "0x1.4p+2"]', '["0x1p+1"]'), ('"quotients": [', '"quotients": [7, '),
                   ('"intermediate": {', '"intermediate": {"vh": "0/1", '),
                   ('"components": [', '"components": {}, "c": ['), (good, ""), (good, "[]"), (good, "{}"),
                   (good, "null"), (good, "\0"))
        for old, new in changes:
            with self.subTest(old=old[:40], new=new):
                self.assertIn(old, good)
                code, _, err = self.outcome_of_text(good.replace(old, new, 1))
                self.assertEqual(code, 2)
                self.assertTrue(err and "Traceback" not in err)
        self.assertEqual(self.outcome("/nonexistent/vectors.json")[0], 2)

    def test_malformed_steps(self):
        for call in ([], "End", ["Nonsense"], [["End"]], ["End", 1], ["MapGrid1f"],
                     ["MapGrid1f", True, gl.ZERO, gl.ONE], ["Enable", None],
                     ["Map1f", "GL_MAP1_INDEX", gl.ZERO, gl.ONE, 1, 2, {"f32": [gl.ZERO]}],
                     ["GetMapfv", "GL_MAP1_INDEX", "GL_ORDER"], ["Vertex2f", gl.ZERO, gl.ZERO],
                     ["GetIntegerv", "GL_X", {}],
                     ["GetMapfv", "GL_MAP1_INDEX", "GL_DOMAIN", {"out": "f32", "count": 1}],
                     ["PushAttrib", "GL_X"]):
            for step in ({"call": call, "errors": []}, {"call": call, "errors": [], "answers": []}):
                case = {"id": "a", "requirements": ["r"], "flags": [], "level": "must", "since": "1.0",
                        "steps": [step]}
                with self.subTest(call=call):
                    self.assertTrue(check_case(("errors", case))[2])

    def test_an_id_names_one_case(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "other.json"
            other.write_text(SAMPLES[0].read_text())
            self.assertEqual(self.outcome(SAMPLES[0], other)[0], 2)


if __name__ == "__main__":
    unittest.main()
