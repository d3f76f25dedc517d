"""Cases that are sequences of commands: errors, get_map, state."""

import struct
from fractions import Fraction

from .gl import Context
from .gl_commands import command_named
from .number import (BINARY32, BINARY64, Malformed, float_text, greatest_not_above, least_not_below,
                     nearest_bits, read_float, show)
from .report import ADVISORY, MUST, integer, members
from .values import check_component, check_normal

OUTPUTS = {"Boolean": "u8", "Integer": "i32", "Float": "f32", "Double": "f64",
           "i": "i32", "f": "f32", "d": "f64"}
HALF = Fraction(1, 2)
# The steps of a case list at most this number of vertices; those of a step that would list more are summarised.
MOST_LISTED = 24
DIGESTED = "position", "color", "normal", "texture_coordinates"
EMITTERS = ("End", "EvalMesh1", "EvalMesh2", "CallList", "CallLists")


def check_sequence(kind, case, report):
    members(case, "case", "id requirements flags level since steps")
    if not isinstance(case["steps"], list) or not case["steps"]:
        raise Malformed("steps: not a list with something in it")
    context, listed = Context(), 0
    for i, step in enumerate(case["steps"]):
        where = f"steps[{i}]"
        members(step, where, "call", "errors answers emits level")
        call, context.advisory_step = step["call"], False
        if not isinstance(call, list) or not call:
            raise Malformed(f"{where}.call: {show(call)}")
        try:
            answer = context.issue(call[0], call[1:])
        except Malformed as fault:
            raise Malformed(f"{where}: {show(call[0])}: {fault}") from None
        _check_errors(f"{where}.errors", context, step, report)
        _check_answers(f"{where}.answers", call, answer, step, report)
        listed += _check_emits(f"{where}.emits", context, step, listed, report)
        report.same(f"{where}.level", ADVISORY if context.advisory_step else MUST, step.get("level", MUST))
    report.same("level", ADVISORY if context.advisory else MUST, case["level"])
    report.same("since", context.since, case["since"])


def _check_errors(where, context, step, report):
    """Compares the errors of a step. They can be queried outside Begin and End only."""
    if context.primitive:
        if "errors" in step:
            raise Malformed(f"{where}: between Begin and End nobody may ask")
        return
    if "errors" not in step:
        raise Malformed(f"{where}: missing")
    _check_set(where, context.errors, step["errors"], report)
    context.errors = set()


def _check_set(where, expected, found, report):
    """Compares lists as sets; -0 counts as 0."""
    if not isinstance(found, list) or any(type(x) not in (int, str) for x in found):
        raise Malformed(f"{where}: {show(found)} should be a list of integers or texts")
    if len(set(found)) != len(found):
        raise Malformed(f"{where}: {show(found)} has something twice")
    report.numbers += 1
    if set(expected) != {"0x0p+0" if x == "-0x0p+0" else x for x in found}:
        report.differ(where, sorted(expected, key=str), found)


def _check_answers(where, call, answer, step, report):
    if not isinstance(answer, list):
        if "answers" in step:
            raise Malformed(f"{where}: {call[0]} answers nothing")
        return
    if "answers" not in step:
        raise Malformed(f"{where}: missing")
    _, form = command_named(call[0])
    kind = _kind_of_answer(call, form)
    if kind in OUTPUTS.values():
        _check_room(where, call[-1], kind, len(answer))
    if kind != "u8" and [value.kind for value in answer] == ["limit"]:
        report.same(where, [[{"at_least": answer[0].value}]], step["answers"])
        return
    accepted = [accepted_answers(value, kind) for value in answer]
    for member, values, found in report.pairs(where, accepted, step["answers"]):
        if values is None:
            report.differ(member, "not to be asked, since no answer is certain", found)
        else:
            _check_set(member, values, found, report)


def _kind_of_answer(call, form):
    """Returns f32, f64, i32 or u8, or "return" if the command returns its answer."""
    if call[0].startswith("Get") and form:
        return OUTPUTS[form[-1]]
    return "return"


def _check_room(where, room, kind, count):
    members(room, f"{where}: room", "out count")
    if room["out"] != kind or type(room["count"]) is not int or room["count"] < count:
        raise Malformed(f"{where}: {show(room)} is no room for {count} values of {kind}")


def accepted_answers(value, kind):
    """Returns all correct answers for a Value in this type, or None if the specification leaves them open."""
    whole = value.kind in ("flag", "integer", "limit")
    x = Fraction(int(value.value)) if whole else read_float(value.value, BINARY64)
    if whole and kind == "f64":
        return {float_text(x)}
    if kind in ("f32", "f64"):
        return _stored(x, kind)
    if kind == "u8":
        return {int(x != 0)}
    if value.kind in ("scaled", "either"):
        return _scaled(x) | (_rounded(x) if value.kind == "either" else set())
    return _rounded(x)


def _stored(x, kind):
    """Returns the answers for a value that an implementation may store in single precision."""
    if abs(x) > BINARY32.limit():
        return None
    singles = {float_text(y) for y in (greatest_not_above(x, BINARY32), least_not_below(x, BINARY32))}
    return singles | {float_text(x)} if kind == "f64" else singles


def _rounded(x):
    """Returns the nearest integers (two for ties), saturated to the range of int."""
    floor = x.__floor__()
    rest = x - floor
    nearby = {floor} if rest < HALF else {floor + 1} if rest > HALF else {floor, floor + 1}
    return {min(max(n, -2**31), 2**31 - 1) for n in nearby}


def _scaled(x):
    """Returns a number scaled by the greatest int, by the older and the newer rule; 0 stays 0."""
    return {0} if x == 0 else _rounded(((2**32 - 1) * x - 1) / 2) | _rounded((2**31 - 1) * x)


def _check_emits(where, context, step, listed, report):
    """Returns the number of vertices that the step lists; `listed` is that of the steps before."""
    emitted, context.emitted = context.emitted, []
    if ("emits" in step) != (step["call"][0] in EMITTERS):
        raise Malformed(f"{where}: {'not here' if 'emits' in step else 'missing'}")
    if "emits" not in step:
        return 0
    count = sum(len(primitive.vertices) for primitive in emitted)
    if listed + count > MOST_LISTED:
        _check_summary(where, context, emitted, step["emits"], report)
        return 0
    for member, primitive, found in report.pairs(where, emitted, step["emits"]):
        members(found, member, "mode vertices")
        report.same(f"{member}.mode", primitive.mode, found["mode"])
        for place, vertex, entry in report.pairs(f"{member}.vertices", primitive.vertices, found["vertices"]):
            _check_vertex(place, context, vertex, entry, report)
    return count


def _check_summary(where, context, emitted, found, report):
    """Compares the summary of many vertices: runs of primitives of the same size, a digest, and some vertices."""
    members(found, where, "primitives digest samples")
    runs = []
    for primitive in emitted:
        run = [primitive.mode, len(primitive.vertices)]
        if not runs or runs[-1][:2] != run:
            runs.append([*run, 0])
        runs[-1][2] += 1
    report.same(f"{where}.primitives", runs, found["primitives"])
    vertices = [vertex for primitive in emitted for vertex in primitive.vertices]
    samples = found["samples"]
    if not isinstance(samples, list) or not samples:
        raise Malformed(f"{where}.samples: {show(samples)} should be a list of vertices")
    last = -1
    for i, sample in enumerate(samples):
        member = f"{where}.samples[{i}]"
        members(sample, member, "number vertex")
        number = integer(f"{member}.number", sample["number"], last + 1)
        if number >= len(vertices):
            report.differ(f"{member}.number", f"below {len(vertices)}", number)
            return
        _check_vertex(f"{member}.vertex", context, vertices[number], sample["vertex"], report)
        last = number
    shown = [name for name in DIGESTED if name in samples[0]["vertex"]]
    units = len(samples[0]["vertex"].get("texture_coordinates", ()))
    report.same(f"{where}.digest", digest_of(vertices, shown, units), found["digest"])


def digest_of(vertices, shown, units):
    """Returns the FNV-1a hash of the bits of all numbers, rounded to binary32, the least significant byte first."""
    bits = 0xcbf29ce484222325
    for vertex in vertices:
        for name in shown:
            rows = vertex[name][:units] if name == "texture_coordinates" else [vertex[name]]
            for x in (x for row in rows for x in row):
                number = (struct.pack("<f", float.fromhex(x)) if isinstance(x, str)
                          else struct.pack("<I", nearest_bits(x.value)))
                for byte in number:
                    bits = (bits ^ byte) * 0x100000001b3 % 2**64
    return f"{bits:016x}"


def _check_vertex(where, context, vertex, found, report):
    members(found, where, "position", "color normal automatic_normal texture_coordinates")
    for name, entry in found.items():
        member = f"{where}.{name}"
        if name not in vertex:
            report.differ(member, "no such member", "one")
        elif name == "automatic_normal":
            members(entry, member, "m normal accept")
            check_normal(entry, vertex[name], report, f"{member}.")
        elif name == "texture_coordinates":
            if not isinstance(entry, list) or not 1 <= len(entry) <= len(vertex[name]):
                raise Malformed(f"{member}: not a list of units")
            for i, coordinates in enumerate(entry):
                _check_attribute(f"{member}[{i}]", vertex[name][i], coordinates, report)
                if any(not isinstance(x, str) and x.needs_gl_2 for x in vertex[name][i]):
                    context.need("2.0")
            if vertex.get("initial_texture"):
                context.need("1.1")
        else:
            _check_attribute(member, vertex[name], entry, report)


def _check_attribute(where, expected, found, report):
    for member, x, entry in report.pairs(where, expected, found):
        if isinstance(x, str):
            report.number(member, x, entry, BINARY32)
        else:
            check_component(member, x, entry, report)
