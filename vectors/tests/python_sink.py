"""The correct or a wrong state machine as a sink (evalcts_sink.h) that the suite can judge.

The environment variable EVALCTS_WRONG names a wrong evaluator ("evaluator: NAME") or a wrong state machine
("state machine: NAME"); if it is not set, the machine is correct. `ADDRESS` is the address of the sink.
"""

import ctypes
import os
import sys
from ctypes import (CFUNCTYPE, POINTER, Structure, addressof, c_char_p, c_double, c_float, c_int, c_uint,
                    c_void_p, cast)
from fractions import Fraction
from functools import lru_cache
from math import copysign

from correct_implementations import Evaluator, Machine
from checker import gl
from checker.gl import Value
from checker.gl_commands import command_named
from checker.gl_names import (ALL_MAPS, COMPILE_MODES, FLAGS, LIST_TYPES, MAP_QUERIES, MAPS, MESH_MODES, MODES,
                              NAME_TYPES, OPERATION, OTHER_FLAGS, TEXTURE0, UNITS)
from checker.maps import TARGETS, Map
from checker.number import Malformed, float_text
from checker.sequences import OUTPUTS, accepted_answers
from wrong_evaluators import WRONG_EVALUATORS, evaluator_of
from wrong_state_machines import WRONG_STATE_MACHINES, machine_of

MAX_ORDER, UNIT_COUNT = gl.MAX_EVAL_ORDER, len(UNITS)
ROWS = 8  # the texture units whose coordinates the suite reads at vertices
ERRORS = {"GL_INVALID_ENUM": 0x500, "GL_INVALID_VALUE": 0x501, "GL_INVALID_OPERATION": 0x502,
          "GL_STACK_OVERFLOW": 0x503, "GL_STACK_UNDERFLOW": 0x504}
BITS = {"GL_CURRENT_BIT": 0x1, "GL_ENABLE_BIT": 0x2000, "GL_EVAL_BIT": 0x10000, "GL_LIST_BIT": 0x20000,
        "GL_TEXTURE_BIT": 0x40000}
STATES = FLAGS | {
    "GL_CURRENT_COLOR": 0x0B00, "GL_CURRENT_INDEX": 0x0B01, "GL_CURRENT_NORMAL": 0x0B02,
    "GL_CURRENT_TEXTURE_COORDS": 0x0B03, "GL_LIST_MODE": 0x0B30, "GL_LIST_BASE": 0x0B32, "GL_LIST_INDEX": 0x0B33,
    "GL_EDGE_FLAG": 0x0B43, "GL_ATTRIB_STACK_DEPTH": 0x0BB0, "GL_MAX_EVAL_ORDER": 0x0D30,
    "GL_MAP1_GRID_DOMAIN": 0x0DD0, "GL_MAP1_GRID_SEGMENTS": 0x0DD1, "GL_MAP2_GRID_DOMAIN": 0x0DD2,
    "GL_MAP2_GRID_SEGMENTS": 0x0DD3, "GL_ACTIVE_TEXTURE": TEXTURE0 + 0x20}
LIMITS = {0x84E2: UNIT_COUNT, 0x8871: UNIT_COUNT, 0x0D35: gl.MAX_ATTRIB_STACK_DEPTH, 0x0B31: gl.MAX_LIST_NESTING}
C_TYPES = {"b": ctypes.c_byte, "ub": ctypes.c_ubyte, "s": ctypes.c_short, "us": ctypes.c_ushort, "i": c_int,
           "ui": c_uint, "f": c_float, "d": c_double, "p": c_void_p}
ITEMS = {"u8": "ub", "i8": "b", "u16": "us", "i16": "s", "u32": "ui", "i32": "i", "f32": "f", "f64": "d"}
KINDS = {c: kind for kind, c in ITEMS.items()}


# The evaluators of maps are those of correct_implementations.py.

class Known:
    """A component or normal of an evaluated map."""

    def __init__(self, value):
        self.value = self.m = value


class EvaluatedMap(Map):
    """A map that is evaluated in double precision, or exactly after an overflow or if arguments of grids are wrong."""

    def directions(self, arguments):
        return arguments

    @lru_cache(100)
    def nets_of(self, number):
        return [[[number(x) for x in row] for row in rows] for rows in Map.nets(self)]

    def nets(self):
        return self.nets_of(Evaluator.number)

    def evaluated(self, method, arguments):
        Evaluator.number = Fraction if IS_EXACT else float
        try:
            return method(self, arguments)
        except (OverflowError, ValueError):
            Evaluator.number = Fraction
            return method(self, arguments)

    def components(self, arguments):
        return [Known(x) for x in self.evaluated(EVALUATOR.values, arguments)]

    def normal(self, arguments):
        return Known(self.evaluated(EVALUATOR.normal, arguments))


def _subject():
    """Returns the evaluator and the class of state machines that EVALCTS_WRONG selects, and the replaced methods."""
    kind, _, name = os.environ.get("EVALCTS_WRONG", "").partition(": ")
    if not kind:
        return Evaluator(), Machine, {}
    methods = WRONG_EVALUATORS[name][1] if kind == "evaluator" else WRONG_STATE_MACHINES[name]
    if kind == "evaluator":
        return evaluator_of(methods), Machine, methods
    return Evaluator(), machine_of(methods), methods


gl.Map = EvaluatedMap
# Results are rounded when hand_over() converts them to floats.
Evaluator.result = lambda self, x: x
# Without these caches, most of the time is spent on computing the same values again.
Evaluator.basis = lru_cache(1000)(Evaluator.basis)
text_of = lru_cache(10**5)(lambda x: float_text(Fraction(x)))
accepted_answers = lru_cache(10**5)(accepted_answers)
EVALUATOR, MACHINE, REPLACED = _subject()
# A wrong end of a grid may be so near to the correct one that double precision does not distinguish them.
IS_EXACT = not REPLACED.keys().isdisjoint(("grid_argument", "evaluate_point"))


# Arguments of commands, as the vectors write them

def text(x):
    return text_of(x) if x != 0 else "-0x0p+0" if copysign(1, x) < 0 else "0x0p+0"


def name_in(names, x):
    return next((name for name, number in names.items() if number == x), x)


def items(address, kind, places):
    """Returns the items at these places of an array, as texts or integers."""
    array = cast(address, POINTER(C_TYPES[ITEMS[kind]]))
    return [text(array[i]) if kind[0] == "f" else array[i] for i in places]


def map_arguments(form, target, *rest):
    dimension = int(form[0])
    kind = "f64" if form[1] == "d" else "f32"
    target = name_in(MAPS[dimension], target)
    rest, address = list(rest[:-1]), rest[-1]
    for i in range(0, len(rest), 4):
        rest[i:i + 2] = text(rest[i]), text(rest[i + 1])
    points = []
    size = TARGETS[dimension].get(target)
    strides, orders = [*rest[2::4], 0][:2], [*rest[3::4], 1][:2]
    if size and min(orders) > 0 and max(orders) <= MAX_ORDER and min(rest[2::4]) >= size:
        points = ["0x0p+0"] * ((orders[0] - 1) * strides[0] + (orders[1] - 1) * strides[1] + size)
        places = sorted({i * strides[0] + j * strides[1] + c for i in range(orders[0]) for j in range(orders[1])
                         for c in range(size)})
        for place, x in zip(places, items(address, kind, places)):
            points[place] = x
    return [target, *rest, {kind: points}]


def lists_arguments(count, kind, address):
    kind = name_in(NAME_TYPES, kind)
    holder, size = LIST_TYPES.get(kind, ("u8", 0))
    return [count, kind, {holder: items(address, holder, range(max(count, 0) * size))}]


def mask_arguments(mask):
    return ["|".join(name for name, bit in BITS.items() if mask & bit) or "GL_POINT_BIT"]


def vector(kind, count):
    """Returns the reader of an array argument."""
    return lambda address: [{kind: items(address, kind, range(count))}]


def numbers(*arguments):
    return [text(x) if isinstance(x, float) else x for x in arguments]


def named(names):
    """Returns the reader of arguments that begin with an enumerant."""
    return lambda first, *rest: [name_in(names, first), *numbers(*rest)]


def attribute_commands():
    counts = {"Vertex": (2, 3, 4), "Color": (3, 4), "Normal": (3,), "TexCoord": (1, 2, 3, 4), "Index": (1,)}
    kinds = {"Color": "b s i f d ub us ui", "Normal": "b s i f d", "Index": "s i f d ub"}
    for name, sizes in counts.items():
        for n in sizes:
            for c in kinds.get(name, "s i f d").split():
                place = f"{name}{n if name != 'Index' else ''}{c}"
                yield place, [c] * n, numbers
                yield place + "v", "p", vector(KINDS[c], n)
    for n in (1, 2, 3, 4):
        for c in "sifd":
            yield f"MultiTexCoord{n}{c}", ["ui", *[c] * n], named(UNITS)
            yield f"MultiTexCoord{n}{c}v", ["ui", "p"], lambda unit, address, c=c, n=n: [
                name_in(UNITS, unit), *vector(KINDS[c], n)(address)]


def commands():
    """Yields name, types of the arguments, and reader of the arguments of each command without an answer."""
    yield from attribute_commands()
    for c in "fd":
        for d in "12":
            n = int(d)
            yield f"Map{d}{c}", ["ui", *[c, c, "i", "i"] * n, "p"], (
                lambda *arguments, form=(d, c): map_arguments(form, *arguments))
            yield f"MapGrid{d}{c}", ["i", c, c] * n, numbers
            yield f"EvalCoord{d}{c}", [c] * n, numbers
            yield f"EvalCoord{d}{c}v", "p", vector(KINDS[c], n)
    for name in ("Enable", "Disable"):
        yield name, ["ui"], named(FLAGS | OTHER_FLAGS)
    yield "Begin", ["ui"], named(MODES)
    yield "End", [], numbers
    yield "EdgeFlag", ["ub"], numbers
    yield "EdgeFlagv", "p", vector("u8", 1)
    yield "EvalPoint1", ["i"], numbers
    yield "EvalPoint2", ["i", "i"], numbers
    yield "EvalMesh1", ["ui", "i", "i"], named(MESH_MODES)
    yield "EvalMesh2", ["ui", "i", "i", "i", "i"], named(MESH_MODES)
    yield "PushAttrib", ["ui"], mask_arguments
    yield "PopAttrib", [], numbers
    yield "ActiveTexture", ["ui"], named(UNITS)
    yield "NewList", ["ui", "ui"], lambda name, mode: [name, name_in(COMPILE_MODES, mode)]
    yield "EndList", [], numbers
    yield "CallList", ["ui"], numbers
    yield "CallLists", ["i", "ui", "p"], lists_arguments
    yield "ListBase", ["ui"], numbers
    yield "DeleteLists", ["ui", "i"], numbers
    yield "Flush", [], numbers
    yield "Finish", [], numbers


# The context

class Receiver(Structure):
    _fields_ = [("user", c_void_p),
                ("begin", CFUNCTYPE(None, c_void_p, c_uint)),
                ("end", CFUNCTYPE(None, c_void_p)),
                ("vertex", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_uint))]


class Play:
    machine, receiver, error = None, None, 0


def reset(receiver):
    Play.machine, Play.receiver, Play.error = MACHINE(), receiver.contents, 0


def issue(name, arguments):
    """Executes a command and hands its vertices over. Returns the answer of a query."""
    machine, answer = Play.machine, None
    try:
        answer = machine.issue(name, arguments)
    except (Malformed, ArithmeticError, ValueError):
        pass  # not modelled, such as non-finite arguments, or a division by zero in a wrong evaluator
    if machine.errors and not Play.error:
        Play.error = ERRORS[min(machine.errors)]
    machine.errors = set()
    emitted, machine.emitted = machine.emitted, []
    for primitive in emitted:
        hand_over(primitive)
    return answer


def single(x):
    """Returns a number of a vertex as a float, or infinity if it is too large, because ctypes does the same."""
    if isinstance(x, str):
        return float.fromhex(x)
    try:
        return float(x.value)
    except OverflowError:
        return float("inf") if x.value > 0 else float("-inf")


def row(values):
    return (c_float * len(values))(*map(single, values))


def hand_over(primitive):
    receiver = Play.receiver
    receiver.begin(receiver.user, MODES[primitive.mode])
    for vertex in primitive.vertices:
        if "automatic_normal" in vertex:
            normal = [Known(x) for x in vertex["automatic_normal"].m]
        else:
            normal = vertex["normal"]
        coordinates = [x for unit_of in vertex["texture_coordinates"] for x in unit_of]
        coordinates += ["0x0p+0", "0x0p+0", "0x0p+0", "0x1p+0"] * (ROWS - UNIT_COUNT)
        receiver.vertex(receiver.user, row(vertex["position"]), row(vertex["color"]), row(normal),
                        row(coordinates), ROWS)
    receiver.end(receiver.user)


def get_error():
    if Play.machine.primitive:
        Play.error = Play.error or ERRORS[OPERATION]
        return 0
    error, Play.error = Play.error, 0
    return error


def flag_of(names):
    """Returns the function of IsEnabled or IsList."""
    def answer_of(name):
        def function(x):
            answer = issue(name, [name_in(names, x)])
            return int(answer[0].value) if answer else 0
        return function
    return answer_of


def gen_lists(count):
    before = set(Play.machine.lists)
    issue("GenLists", [count])
    return min(set(Play.machine.lists) - before, default=0)


def written(answer, kind, address):
    array = cast(address, POINTER(C_TYPES[ITEMS[kind]]))
    for i, value in enumerate(answer or ()):
        if value == Value("limit", gl.LEAST_MAX_EVAL_ORDER):
            value = Value("limit", MAX_ORDER)
        if value.kind == "either":
            value = value._replace(kind="float")
        accepted = accepted_answers(value, kind)
        if accepted is None:  # the specification leaves the answer open
            array[i] = 0
        elif kind[0] == "f":
            array[i] = min(map(float.fromhex, accepted))
        else:
            array[i] = min(accepted)


def getter(name):
    kind = OUTPUTS[name]

    def function(pname, address):
        if pname in LIMITS:
            written([Value("integer", LIMITS[pname])], kind, address)
            return
        query = name_in(STATES, pname)
        if query == pname:
            query = "GL_ORDER"  # INVALID_ENUM
        written(issue(f"Get{name}v", [query, {"out": kind, "count": 1}]), kind, address)
    return function


def map_getter(c):
    def function(target, query, *rest):
        arguments = [name_in(ALL_MAPS, target), name_in(MAP_QUERIES, query),
                     *rest[:-1], {"out": OUTPUTS[c], "count": 1}]
        written(issue(f"GetMap{c}v", arguments), OUTPUTS[c], rest[-1])
    return function


def queries():
    """Yields name, type of the result, types of the arguments, and function of each query."""
    yield "GetError", c_uint, [], get_error
    yield "IsEnabled", ctypes.c_ubyte, ["ui"], flag_of(FLAGS | OTHER_FLAGS)("IsEnabled")
    yield "IsList", ctypes.c_ubyte, ["ui"], flag_of({})("IsList")
    yield "GenLists", c_uint, ["i"], gen_lists
    for name in ("Boolean", "Integer", "Float", "Double"):
        yield f"Get{name}v", None, ["ui", "p"], getter(name)
    for c in "fdi":
        yield f"GetMap{c}v", None, ["ui", "ui", "p"], map_getter(c)


def guarded(function):
    """Returns the function so that an exception ends the process, because ctypes would ignore it."""
    def guard(*arguments):
        try:
            return function(*arguments)
        except BaseException:
            sys.excepthook(*sys.exc_info())
            sys.stderr.flush()
            os._exit(70)
    return guard


def issuer(name, reader):
    def function(*arguments):
        try:
            arguments = reader(*arguments)
        except (OverflowError, ValueError):
            return  # arguments that are not finite
        issue(name, arguments)
    return function


class Command(Structure):
    _fields_ = [("name", c_char_p), ("function", c_void_p)]


class Sink(Structure):
    _fields_ = [("version", c_uint), ("attributes", c_uint), ("commands", POINTER(Command)), ("reset", c_void_p),
                ("targets", c_void_p), ("max_order", c_int), ("vendor", c_char_p), ("name", c_char_p),
                ("gl_version", c_char_p)]


def functions():
    for name, types, reader in commands():
        yield name, CFUNCTYPE(None, *(C_TYPES[t] for t in types))(guarded(issuer(name, reader)))
    for name, result, types, function in queries():
        yield name, CFUNCTYPE(result, *(C_TYPES[t] for t in types))(guarded(function))


FUNCTIONS = list(functions())  # keeps them alive, as ctypes requires
TABLE = (Command * (len(FUNCTIONS) + 1))(*((b"gl" + name.encode(), cast(function, c_void_p))
                                           for name, function in FUNCTIONS))
RESET = CFUNCTYPE(c_void_p, POINTER(Receiver))(guarded(reset))
SINK = Sink(2, 31, TABLE, cast(RESET, c_void_p), None, 0, b"evalcts", b"state machine in Python", b"1.5")
ADDRESS = addressof(SINK)
