"""Wrong state machines. Sequences of the vectors have to detect each (detections.json says which)."""

from checker.accuracy import Grid
from checker.gl import Value
from checker.gl_commands import command_named
from checker.maps import TARGETS, Map
from checker.number import BINARY64, Malformed, float_text, read_float
from correct_implementations import Machine, f32, f64
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
        grids = [sums(n, first, last, i) if d in along and 0 <= i <= 10**5 else
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


def _winner(change):
    """Replaces the kinds of maps, of which the first enabled one wins, by change(kinds)."""
    return {"winner": lambda self, dimension, kinds: Machine.winner(self, dimension, change(list(kinds)))}


def _after(method, change):
    """Calls change(machine, *arguments) after a command."""
    def command(self, *arguments):
        result = getattr(Machine, method)(self, *arguments)
        change(self, *arguments)
        return result
    return {method: command}


def _before(method, change):
    """Calls change(machine, *arguments) before a command."""
    def command(self, *arguments):
        change(self, *arguments)
        return getattr(Machine, method)(self, *arguments)
    return {method: command}


def _instead(method, condition, other):
    """Calls other(machine, *arguments) in place of a command if condition(machine, *arguments) is true."""
    def command(self, *arguments):
        return (other if condition(self, *arguments) else getattr(Machine, method))(self, *arguments)
    return {method: command}


def _keeps(name):
    """Makes an evaluated attribute current."""
    def vertex(self, attributes):
        Machine.vertex(self, attributes)
        key = {"Color": "color", "Normal": "normal", "TexCoord": "texture_coordinates"}[name]
        if key not in attributes:
            return
        values = attributes[key][0] if name == "TexCoord" else attributes[key]
        found = [x if isinstance(x, str) else float_text(f32(x.value)) for x in values]
        if name == "TexCoord":
            self.current[name][0] = found
        else:
            self.current[name] = found
    return {"vertex": vertex}


def _answers(query, change):
    """Replaces the answers to a query of a map by change(machine, target, answers)."""
    def get_map(self, form, target, asked, *rest):
        found = Machine.get_map(self, form, target, asked, *rest)
        return change(self, target, found) if asked == query else found
    return {"get_map": get_map}


def _transposed_answers(machine, target, found):
    the_map = machine.maps[target].map
    if the_map.dimension == 1:
        return found
    n, m, k = *the_map.orders, the_map.size
    return [found[(i * m + j) * k + c] for j in range(m) for i in range(n) for c in range(k)]


def _allowed_inside(*names):
    """Lets commands be executed between Begin and End."""
    def execute(self, command, form, arguments):
        return Machine.execute(self, command._replace(inside=True) if command.method in names else command, form,
                               arguments)
    return {"execute": execute}


def _mesh(change):
    """Replaces the indices of meshes by change(indices)."""
    return {"eval_mesh": lambda self, form, mode, *indices: (
        Machine.eval_mesh(self, form, mode, *change(list(indices))))}


def _saved(mask, *names):
    """Makes bits of PushAttrib save only these attributes of the context."""
    def push_attrib(self, form, given):
        Machine.push_attrib(self, form, given)
        if mask in given.split("|"):
            self.stack[-1] = {name: value for name, value in self.stack[-1].items() if name in names}
    return {"push_attrib": push_attrib}


def _saves_maps(self, form, mask):
    if "GL_EVAL_BIT" in mask:
        self.stack[-1]["maps"] = dict(self.maps)


def _line_mesh(self, form, mode, *indices):
    """Draws the lines of constant u first."""
    first, last, low, high = indices
    self.meshed = {}
    if self.winner(2, ("VERTEX_4", "VERTEX_3")):
        for i in range(first, last + 1):
            self.primitive_of("GL_LINE_STRIP", [(i, j) for j in range(low, high + 1)])


def _turned_strips(self, mode, points):
    if mode == "GL_QUAD_STRIP":
        points = [p for pair in zip(points[1::2], points[::2]) for p in pair]
    return Machine.primitive_of(self, mode, points)


def _executes_while_compiling(self, name, arguments):
    command, form = command_named(name)
    if self.open_list and command.compiled and self.open_list.mode == "GL_COMPILE":
        self.execute(command, form, arguments)
    return Machine.issue(self, name, arguments)


def _never_executes_while_compiling(self, name, arguments):
    command, _ = command_named(name)
    if self.open_list and command.compiled:
        self.open_list.commands.append((name, arguments))
        return None
    return Machine.issue(self, name, arguments)


def _clamped_colors(self, attributes):
    if not all(isinstance(x, str) for x in attributes["color"]):
        attributes["color"] = [Given(min(max(x.value, 0), 1)) for x in attributes["color"]]
    Machine.vertex(self, attributes)


def _without_error(code):
    """Raises no error of this code, and ignores the command."""
    def execute(self, command, form, arguments):
        before = set(self.errors)
        result = Machine.execute(self, command, form, arguments)
        if self.errors - before == {code}:
            self.errors = before
        return result
    return {"execute": execute}


def _with_code(wrong, right):
    """Raises one code in place of another."""
    def execute(self, command, form, arguments):
        before = set(self.errors)
        result = Machine.execute(self, command, form, arguments)
        if self.errors - before == {right}:
            self.errors = before | {wrong}
        return result
    return {"execute": execute}


def _sets_first_direction(self, form, *arguments):
    """Sets the grid of u although that of v is an error."""
    if form[0] == "2" and arguments[0] > 0:
        self.grids[2][0] = tuple(arguments[:3])


def _sets_order_1(self, form, target, *rest):
    codes = Machine.map_errors(self, form, target, *rest)
    if codes and target in self.maps:
        old = self.maps[target]
        self.maps[target] = type(old)(old.map.dimension, target, old.domain,
                                      [[old.coefficients[:old.map.size]]], "d")
    return codes


def _with_flag(machine, flag, value, arguments):
    """Evaluates as if the flag had this value."""
    before, machine.enabled[flag] = machine.enabled[flag], value
    Machine.evaluate(machine, *arguments)
    machine.enabled[flag] = before


# Name: {method or attribute of Machine: its replacement}.
WRONG_STATE_MACHINES = {
    # Ends of grids
    "last end by float arithmetic": _counted_from_first(f32),
    "last end by double arithmetic": _counted_from_first(f64),
    "first end by float arithmetic": _counted_from_last(f32),
    "last end of strips of lines": _counted_from_first(f32, _mode("GL_LINE_STRIP")),
    "last end of strips of quads": _counted_from_first(f32, _mode("GL_QUAD_STRIP")),
    "last end of v": _counted_from_first(f32, lambda m, d, g: d == 1),
    "first end of v in quads": _counted_from_last(f32, lambda m, d, g: (
        d == 1 and m.primitive.mode == "GL_QUAD_STRIP")),
    "last end of u in two dimensions": _counted_from_first(f32, lambda m, d, g: (
        d == 0 and m.primitive.mode != "GL_LINE_STRIP")),
    # Long meshes
    "arguments of curves summed up": _summed(f32),
    "arguments of surfaces summed up": _summed(f32),
    "arguments summed up along u": _summed(f32, (0,)),
    "arguments summed up along v": _summed(f32, (1,)),
    "forward differences in float": _forward_differences(f32),
    "forward differences in double": _forward_differences(f64),
    # Meshes and current values
    "a mesh leaves its colour": _leaves("Color", "color"),
    "a mesh leaves its normal": _leaves("Normal", "normal"),
    "a mesh leaves its texture coordinates": _leaves("TexCoord", 0),
    "a mesh leaves its texture coordinates in unit 1": _leaves("TexCoord", 1),
    "a mesh leaves its index": _after_mesh(
        lambda m: m.current.update(Index=["0x1p+0"])),
    "a mesh sets the edge flag": _after_mesh(lambda m: m.current.update(EdgeFlag=True)),
    "a mesh resets the grid": _after_mesh(
        lambda m: m.grids.update({1: [(1, "0x0p+0", "0x1p+0")]})),
    "a mesh resets the grid of v": _after_mesh(
        lambda m: m.grids[2].__setitem__(1, (2, "0x0p+0", "0x1p+0"))),
    "a mesh disables the map of colours": _after_mesh(
        lambda m: m.enabled.update(GL_MAP1_COLOR_4=False)),
    # Errors of strides, orders and lists
    "vstride is not looked at with vorder 1": _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[7] == 1),
    "vstride 0 to k - 1 is no error with vorder 1": _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[7] == 1 and rest[6] >= 0),
    "MAX_EVAL_ORDER is 7": {"state": lambda self, name: (
        [Value("limit", 7)] if name == "GL_MAX_EVAL_ORDER" else Machine.state(self, name))},
    "orders above 7 are errors": _order_limit(7),
    "orders above 30 are errors": _order_limit(30),
    "orders above 63 are errors": _order_limit(63),
    "lists lose errors of maps": _in_list(
        lambda name, codes: name.startswith("Map1")),
    "lists lose errors of surfaces": _in_list(
        lambda name, codes: name.startswith("Map2")),
    "lists lose INVALID_ENUM of maps": _in_list(
        lambda name, codes: codes == {"GL_INVALID_ENUM"}),
    "lists lose errors of grids": _in_list(lambda name, codes: name.startswith("MapGrid")),
    "lists lose errors of meshes": _in_list(
        lambda name, codes: name.startswith("EvalMesh")),
    "lists stop at the first error": _list_stops_at_errors(),
    "errors come when a list is compiled": _errors_when_compiled(),
    "lists take curves as packed": _packed_in_lists(
        lambda name, a: _with(a, _3=_size(a[0])) if name.startswith("Map1") else a),
    "lists take columns as packed": _packed_in_lists(
        lambda name, a: _with(a, _7=_size(a[0])) if name.startswith("Map2") else a),
    "lists swap the strides": _packed_in_lists(
        lambda name, a: _with(a, _3=min(a[3], a[7]), _7=min(a[3], a[7])) if name.startswith("Map2") else a),
    "points of order 33 and more are those of 32": {"winner": lambda self, dimension, kinds:
        (
        _cut(Machine.winner(self, dimension, kinds), 32))},
    # Precedence of maps
    "VERTEX_3 wins over VERTEX_4": _winner(
        lambda kinds: kinds[::-1] if "VERTEX_4" in kinds else kinds),
    "TEXTURE_COORD_1 wins": _winner(
        lambda kinds: kinds[::-1] if "TEXTURE_COORD_1" in kinds else kinds),
    "TEXTURE_COORD_3 wins over TEXTURE_COORD_4": _winner(
        lambda kinds: [kinds[1], kinds[0], *kinds[2:]] if "TEXTURE_COORD_4" in kinds else kinds),
    "TEXTURE_COORD_1 wins over TEXTURE_COORD_2": _winner(
        lambda kinds: [*kinds[:2], kinds[3], kinds[2]] if "TEXTURE_COORD_4" in kinds else kinds),
    "curves and surfaces share the enable of colours": {
        "winner": lambda self, dimension, kinds: (
            self.maps[f"GL_MAP{dimension}_COLOR_4"].map
            if kinds == ("COLOR_4",) and self.enabled[f"GL_MAP{3 - dimension}_COLOR_4"]
            else Machine.winner(self, dimension, kinds))},
    "the map of normals wins over AUTO_NORMAL": _instead(
        "evaluate", lambda m, dimension, arguments: m.enabled["GL_MAP2_NORMAL"] and dimension == 2,
        lambda m, *rest: _with_flag(m, "GL_AUTO_NORMAL", False, rest)),
    # Enables
    "Enable of VERTEX_4 disables VERTEX_3": _after("enable", lambda m, form, flag: (
        form[0] == "Enable" and flag.endswith("VERTEX_4") and m.enabled.update({flag[:-1] + "3": False}))),
    "Disable of VERTEX_4 disables VERTEX_3": _after(
        "enable", lambda m, form, flag: (
        form[0] == "Disable" and flag.endswith("VERTEX_4") and m.enabled.update({flag[:-1] + "3": False}))),
    "a map enables itself": _after(
        "map", lambda m, form, target, *rest: m.enabled.update({target: True})),
    "a map disables itself": _after(
        "map", lambda m, form, target, *rest: m.enabled.update({target: False})),
    "Enable sets the initial map": _after("enable", lambda m, form, flag: (
        flag in m.maps and form[0] == "Enable" and m.maps.update({flag: Machine().maps[flag]}))),
    # Current values
    "evaluated colours become current": _keeps("Color"),
    "evaluated normals become current": _keeps("Normal"),
    "evaluated texture coordinates become current": _keeps("TexCoord"),
    "colours of maps are clamped": {"vertex": _clamped_colors},
    # Attribute stack
    "EVAL_BIT does not save grids": _saved(
        "GL_EVAL_BIT", "enabled", "current", "list_base", "active_unit"),
    "EVAL_BIT does not save enables": _saved(
        "GL_EVAL_BIT", "grids", "current", "list_base", "active_unit"),
    "ENABLE_BIT does not save enables of maps": _saved(
        "GL_ENABLE_BIT", "grids", "current"),
    "EVAL_BIT saves maps": _after("push_attrib", _saves_maps),
    "CURRENT_BIT saves nothing": _saved("GL_CURRENT_BIT", "enabled", "grids"),
    "PopAttrib pops two levels": _after(
        "pop_attrib", lambda m, form: m.stack and m.stack.pop()),
    # Maps and grids
    "curves and surfaces share enables": _after("enable", lambda m, form, flag: (
        flag.startswith("GL_MAP") and m.enabled.update({flag.replace("MAP1", "MAP2"): form[0] == "Enable"}))),
    "MapGrid2 sets the grid of curves": _after("map_grid", lambda m, form, *a: (
        form[0] == "2" and m.grids.update({1: [m.grids[2][0]]}))),
    "MapGrid1 sets the grid of surfaces": _after("map_grid", lambda m, form, *a: (
        form[0] == "1" and m.grids[2].__setitem__(0, m.grids[1][0]))),
    "erroneous grids of v set that of u": _before(
        "map_grid_errors", _sets_first_direction),
    "erroneous maps set order 1": {"map_errors": _sets_order_1},
    "u1 = u2 is no error": _no_map_error_if(
        lambda m, form, target, first, last, *rest: first == last),
    "equal ends of v are no error": _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[4] == rest[5]),
    "order 0 is no error": _no_map_error_if(
        lambda m, form, target, a, b, stride, order, *rest: order == 0),
    "vorder 0 is no error": _no_map_error_if(
        lambda m, form, target, *rest: form[0] == "2" and rest[7] == 0),
    "stride k - 1 is no error": _no_map_error_if(
        lambda m, form, target, a, b, stride, *rest: (
            target in m.maps and stride == m.maps[target].map.size - 1)),
    "maps of unit 1 are no error": _errors("map_errors", lambda m, codes, *a: (
        codes - {"GL_INVALID_OPERATION"})),
    # Meshes
    "meshes from i2 to i1": _mesh(lambda i: [*sorted(i[:2]), *(sorted(i[2:]))]),
    "meshes leave out the last point": _mesh(lambda i: [i[0], i[1] - 1, *i[2:]]),
    "meshes leave out the last row": _mesh(lambda i: [*i[:3], i[3] - 1] if len(i) == 4 else i),
    "meshes begin at 0": _mesh(lambda i: [max(i[0], 0), *i[1:]]),
    "meshes end at the last segment of v": {"eval_mesh": lambda self, form, mode, *i: (
        Machine.eval_mesh(self, form, mode, *i[:3], min(i[3], self.grids[2][1][0])) if len(i) == 4
        else Machine.eval_mesh(self, form, mode, *i))},
    "line meshes have lines of constant u only": _instead(
        "eval_mesh", lambda m, form, mode, *i: mode == "GL_LINE" and len(i) == 4, _line_mesh),
    "quads are turned": {"primitive_of": _turned_strips},
    "FILL is accepted for curves": {"eval_mesh_errors": lambda self, form, mode, *i: (
        set() if mode == "GL_FILL" else Machine.eval_mesh_errors(self, form, mode, *i)),
        "eval_mesh": lambda self, form, mode, *i: (
            None if mode == "GL_FILL" and form[0] == "1" else Machine.eval_mesh(self, form, mode, *i))},
    # Between Begin and End
    "maps may be defined between Begin and End": _allowed_inside("map"),
    "grids may be set between Begin and End": _allowed_inside("map_grid"),
    "maps may be enabled between Begin and End": _allowed_inside("enable"),
    "maps may be queried between Begin and End": _allowed_inside("get_map"),
    # Errors
    "INVALID_VALUE is not raised": _without_error("GL_INVALID_VALUE"),
    "INVALID_ENUM is not raised": _without_error("GL_INVALID_ENUM"),
    "INVALID_ENUM is INVALID_VALUE": _with_code("GL_INVALID_VALUE", "GL_INVALID_ENUM"),
    "INVALID_VALUE is INVALID_OPERATION": _with_code(
        "GL_INVALID_OPERATION", "GL_INVALID_VALUE"),
    # Queries
    "ORDER answers degrees": _answers("GL_ORDER", lambda m, t, found: [
        Value(kind, x - 1) for kind, x in found]),
    "ORDER answers vorder first": _answers("GL_ORDER", lambda m, t, found: found[::-1]),
    "DOMAIN answers v first": _answers(
        "GL_DOMAIN", lambda m, t, found: [*found[2:], *found[:2]]),
    "DOMAIN answers the ends in ascending order": _answers(
        "GL_DOMAIN", lambda m, t, found: (
        [x for i in range(0, len(found), 2) for x in sorted(
            found[i:i + 2], key=lambda end: read_float(end.value, BINARY64))])),
    "COEFF answers columns": _answers("GL_COEFF", _transposed_answers),
    "COEFF answers the last point first": _answers(
        "GL_COEFF", lambda m, t, found: found[::-1]),
    # Display lists
    "lists are executed twice": {"call": lambda self, name: (
        [Machine.call(self, name) for _ in "12"] and None)},
    "COMPILE executes": {"issue": _executes_while_compiling},
    "COMPILE_AND_EXECUTE does not execute": {"issue": _never_executes_while_compiling},
    "lists in lists are not called": {"call": lambda self, name: (
        None if self.nesting else Machine.call(self, name))},
    "EndList does not keep the list": {"end_list": lambda self, form: (
        setattr(self, "open_list", None))},
}


def machine_of(members):
    return type("Wrong", (Machine,), members)
