"""Wrong state machines, each with the theme of the vectors that has to detect it."""

from checker.accuracy import Grid
from checker.gl import Value
from checker.gl_commands import command_named
from checker.maps import TARGETS, Map
from checker.number import BINARY64, Malformed, float_text, read_float
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


class Given:
    """An evaluated component whose value is known."""

    def __init__(self, value):
        self.value = value


def _summed(rounding, along=(0, 1)):
    """Computes arguments of grids as sums of steps from the first end, each sum rounded."""
    def evaluate_point(self, dimension, indices):
        def sums(n, first, last, upto):
            sums_of = self.__dict__.setdefault("sums", {}).setdefault((n, first, last), [
                read_float(first, BINARY64)])
            step = rounding(rounding(read_float(last, BINARY64) - sums_of[0]) / n)
            while len(sums_of) <= upto:
                sums_of.append(rounding(sums_of[-1] + step))
            return sums_of[upto]
        grids = [sums(n, first, last, i) if d in along else
                 Grid(n, read_float(first, BINARY64), read_float(last, BINARY64), i)
                 for d, ((n, first, last), i) in enumerate(zip(self.grids[dimension], indices))]
        self.evaluate(dimension, grids)
    return {"evaluate_point": evaluate_point}


def _forward_differences(rounding):
    """Computes positions of long primitives by forward differences."""
    def primitive_of(self, mode, points):
        if len(points) < 8:
            return Machine.primitive_of(self, mode, points)
        Machine.primitive_of(self, mode, points)
        vertices = self.emitted[-1].vertices
        degree = max(self.winner(len(points[0]), ("VERTEX_4", "VERTEX_3")).orders) - 1
        for c in range(3):
            row = [v["position"][c].value for v in vertices[:degree + 1]]
            differences = []
            while row:
                differences.append(rounding(row[0]))
                row = [b - a for a, b in zip(row, row[1:])]
            for vertex in vertices:
                vertex["position"][c] = Given(differences[0])
                for k in range(degree):
                    differences[k] = rounding(differences[k] + differences[k + 1])
        return None
    return {"primitive_of": primitive_of}


def _leaves(kind, name):
    """Sets a current value to that of the last vertex of a mesh."""
    def eval_mesh(self, form, mode, *indices):
        before = len(self.emitted)
        Machine.eval_mesh(self, form, mode, *indices)
        if len(self.emitted) > before and kind in ("Color", "Normal") and name in self.emitted[-1].vertices[-1]:
            last = self.emitted[-1].vertices[-1][name]
            self.current[kind] = [x if isinstance(x, str) else float_text(f32(x.value)) for x in last]
        elif len(self.emitted) > before and kind == "TexCoord":
            last = self.emitted[-1].vertices[-1]["texture_coordinates"][0]
            self.current[kind][name] = [x if isinstance(x, str) else float_text(f32(x.value)) for x in last]
    return {"eval_mesh": eval_mesh}


def _after_mesh(change):
    def eval_mesh(self, form, mode, *indices):
        Machine.eval_mesh(self, form, mode, *indices)
        change(self)
    return {"eval_mesh": eval_mesh}


def _errors(method, change):
    """Replaces the error codes of a command by change(machine, codes, form, *arguments)."""
    def errors(self, form, *arguments):
        return change(self, getattr(Machine, method)(self, form, *arguments), form, *arguments)
    return {method: errors}


def _no_error_if(condition):
    return lambda machine, codes, form, *arguments: set() if condition(machine, form, *arguments) else codes


def _no_map_error_if(condition):
    """Raises no error for an erroneous map if condition(machine, form, target, *rest)."""
    def map_(self, form, target, *rest):
        try:
            Machine.map(self, form, target, *rest)
        except (LookupError, Malformed):
            pass
    return _errors("map_errors", _no_error_if(condition)) | {"map": map_}


def _order_limit(most):
    return _errors("map_errors", lambda machine, codes, form, target, *rest: (
        codes | ({"GL_INVALID_VALUE"} if any(o > most for o in rest[3:-1:4]) else set())))


def _in_list(lost):
    """Loses the errors of compiled commands if lost(command name, codes)."""
    def call(self, name):
        for command, arguments in self.lists.get(name, ()):
            held, self.errors = self.errors, set()
            self.execute(*command_named(command), arguments)
            self.errors = held | (set() if lost(command, self.errors) else self.errors)
    return {"call": call}


def _list_stops_at_errors():
    def call(self, name):
        for command, arguments in self.lists.get(name, ()):
            held, self.errors = self.errors, set()
            self.execute(*command_named(command), arguments)
            failed, self.errors = bool(self.errors), held | self.errors
            if failed:
                return
    return {"call": call}


def _errors_when_compiled():
    def issue(self, name, arguments):
        command, form = command_named(name)
        if self.open_list and command.compiled and self.open_list.mode == "GL_COMPILE":
            self.errors |= getattr(self, command.method + "_errors", lambda *_: set())(form, *arguments)
        return Machine.issue(self, name, arguments)
    return {"issue": issue}


def _packed_in_lists(wrong_stride):
    """Changes the arguments of compiled maps by wrong_stride(name, arguments), but not their data."""
    def issue(self, name, arguments):
        if self.open_list and name.startswith("Map") and not name.startswith("MapGrid"):
            arguments = wrong_stride(name, list(arguments))
        return Machine.issue(self, name, arguments)
    return {"issue": issue}


def _with(arguments, **changes):
    for place, x in changes.items():
        arguments[int(place[1:])] = x
    return arguments


def _cut(the_map, most):
    if the_map is None or the_map.orders[0] <= most:
        return the_map
    return Map(the_map.dimension, the_map.target, the_map.domain, the_map.points[:most])


def _size(target):
    return TARGETS[int(target[6])][target]


# Name: (kind.theme, {method or attribute of Machine: its replacement}).
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
    # Long meshes
    "arguments of curves summed up": ("state.long-mesh1", _summed(f32)),
    "arguments of surfaces summed up": ("state.long-mesh2", _summed(f32)),
    "arguments summed up along u": ("state.long-mesh2", _summed(f32, (0,))),
    "arguments summed up along v": ("state.long-mesh2", _summed(f32, (1,))),
    "forward differences in float": ("state.steep-mesh", _forward_differences(f32)),
    "forward differences in double": ("state.steep-mesh", _forward_differences(f64)),
    # Meshes and current values
    "a mesh leaves its colour": ("state.mesh-current", _leaves("Color", "color")),
    "a mesh leaves its normal": ("state.mesh-current", _leaves("Normal", "normal")),
    "a mesh leaves its texture coordinates": ("state.mesh-current", _leaves("TexCoord", 0)),
    "a mesh leaves its texture coordinates in unit 1": ("state.mesh-current", _leaves("TexCoord", 1)),
    "a mesh leaves its index": ("state.mesh-current", _after_mesh(
        lambda m: m.current.update(Index=["0x1p+0"]))),
    "a mesh sets the edge flag": ("state.mesh-current", _after_mesh(lambda m: m.current.update(EdgeFlag=True))),
    "a mesh resets the grid": ("state.mesh-current", _after_mesh(
        lambda m: m.grids.update({1: [(1, "0x0p+0", "0x1p+0")]}))),
    "a mesh resets the grid of v": ("state.mesh-current", _after_mesh(
        lambda m: m.grids[2].__setitem__(1, (2, "0x0p+0", "0x1p+0")))),
    "a mesh disables the map of colours": ("state.mesh-current", _after_mesh(
        lambda m: m.enabled.update(GL_MAP1_COLOR_4=False))),
    # Errors of strides, orders and lists
    "vstride is not looked at with vorder 1": ("errors.map2-vstride-order1", _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[7] == 1)),
    "vstride 0 to k - 1 is no error with vorder 1": ("errors.map2-vstride-order1", _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[7] == 1 and rest[6] >= 0)),
    "MAX_EVAL_ORDER is 7": ("state.max-eval-order", {"state": lambda self, name: (
        [Value("limit", 7)] if name == "GL_MAX_EVAL_ORDER" else Machine.state(self, name))}),
    "orders above 7 are errors": ("state.max-eval-order", _order_limit(7)),
    "orders above 30 are errors": ("get_map.high-order", _order_limit(30)),
    "orders above 63 are errors": ("get_map.high-order", _order_limit(63)),
    "lists lose errors of maps": ("errors.map1-compiled", _in_list(lambda name, codes: name.startswith("Map1"))),
    "lists lose errors of surfaces": ("errors.map2-compiled", _in_list(
        lambda name, codes: name.startswith("Map2"))),
    "lists lose INVALID_ENUM of maps": ("errors.map1-compiled", _in_list(
        lambda name, codes: codes == {"GL_INVALID_ENUM"})),
    "lists lose errors of grids": ("errors.compiled", _in_list(lambda name, codes: name.startswith("MapGrid"))),
    "lists lose errors of meshes": ("errors.compiled", _in_list(lambda name, codes: name.startswith("EvalMesh"))),
    "lists stop at the first error": ("errors.map1-compiled", _list_stops_at_errors()),
    "errors come when a list is compiled": ("errors.compiled", _errors_when_compiled()),
    "lists take curves as packed": ("get_map.list-stride", _packed_in_lists(
        lambda name, a: _with(a, _3=_size(a[0])) if name.startswith("Map1") else a)),
    "lists take columns as packed": ("get_map.list-stride", _packed_in_lists(
        lambda name, a: _with(a, _7=_size(a[0])) if name.startswith("Map2") else a)),
    "lists swap the strides": ("get_map.list-stride", _packed_in_lists(
        lambda name, a: _with(a, _3=min(a[3], a[7]), _7=min(a[3], a[7])) if name.startswith("Map2") else a)),
    "points of order 33 and more are those of 32": ("state.high-order", {"winner": lambda self, dimension, kinds: (
        _cut(Machine.winner(self, dimension, kinds), 32))}),
}


def machine_of(members):
    return type("Wrong", (Machine,), members)
