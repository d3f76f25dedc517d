"""A model of the part of the GL that sequences touch: evaluators, current values, attributes, display lists.

Each command is a pair of methods of Context: `x_errors` returns the codes that it may raise, and `x` executes it if
there are none. Numbers that are only stored stay texts, because texts keep the sign of zero.
"""

from copy import deepcopy
from functools import cache, lru_cache
from inspect import signature
from typing import NamedTuple

from .accuracy import Grid
from .gl_arguments import (ONE, ZERO, array, attribute_values, directions_of_grid, directions_of_map, filled,
                           integer, one, room_of)
from .gl_commands import command_named
from .gl_names import (ALL_MAPS, COMPILE_MODES, ENUM, FLAGS, GROUPS, LIST_TYPES, MAP_QUERIES, MAPS,
                       MAX_TEXTURE_UNITS, MESH_MODES, MODES, NAME_TYPES, OPERATION, OTHER_FLAGS, OVERFLOW,
                       TEXTURE0, UNDERFLOW, VALUE, enumerant, groups_of, unit_of)
from .maps import FORMATS, TARGETS, Map
from .number import BINARY32, BINARY64, Malformed, read_float, show
from .report import FIRST_VERSION

# Limits that the files assume of the implementation.
LEAST_MAX_EVAL_ORDER = 8
MAX_EVAL_ORDER, MAX_LIST_NESTING, MAX_ATTRIB_STACK_DEPTH = 64, 64, 16


class Value(NamedTuple):
    """A value of the state. Kinds: "flag", "integer", "float", "scaled" (a colour or normal, whose integer answers are
    scaled to the range of int), "either" (integer answers are scaled or rounded), "limit" (at least this integer)."""
    kind: str
    value: object


@cache
def initial_map(dimension, target, size):
    """Returns the initial map of a target: order 1, one point, domain [0, 1]."""
    if target.endswith("NORMAL"):
        point = [ZERO, ZERO, ONE]
    elif target.endswith(("COLOR_4", "INDEX")):
        point = [ONE] * size
    else:
        point = [ZERO, ZERO, ZERO, ONE][:size]
    return StoredMap(dimension, target, [ZERO, ONE] * dimension, [[point]], "f", is_initial=True)


@lru_cache(1 << 14)
def grid_point(segments, first, last, index):
    """Returns the Grid of texts. The points of a mesh share these objects."""
    return Grid(segments, read_float(first, FORMATS["d"]), read_float(last, FORMATS["d"]), index)


class StoredMap:
    """A Map together with the texts of its numbers."""

    def __init__(self, dimension, target, domain, points, form, is_initial=False):
        self.is_initial = is_initial

        def read(text):
            return read_float(text, FORMATS[form])
        self.domain = domain
        self.coefficients = [x for row in points for point in row for x in point]
        exact = [[[read(x) for x in point] for point in row] for row in points]
        self.map = Map(dimension, target, [read(x) for x in domain], exact)

    def answer(self, query):
        if query == "GL_ORDER":
            return [Value("integer", order) for order in self.map.orders]
        if query == "GL_DOMAIN":
            return [Value("float", x) for x in self.domain]
        kind = "either" if self.map.target.endswith(("COLOR_4", "NORMAL")) else "float"
        return [Value(kind, x) for x in self.coefficients]


class Primitive:
    def __init__(self, mode):
        self.mode, self.vertices = mode, []


class Context:
    """A GL context. `errors` and `emitted` hold the errors and primitives since the caller last reset them."""

    def __init__(self):
        self.maps = {target: initial_map(d, target, k) for d in (1, 2) for target, k in TARGETS[d].items()}
        self.enabled = dict.fromkeys(FLAGS, False)
        self.grids = {1: [(1, ZERO, ONE)], 2: [(1, ZERO, ONE), (1, ZERO, ONE)]}
        self.current = {"Color": [ONE] * 4, "Normal": [ZERO, ZERO, ONE], "Index": [ONE], "EdgeFlag": True,
                        "TexCoord": [[ZERO, ZERO, ZERO, ONE] for _ in range(MAX_TEXTURE_UNITS)]}
        self.active_unit, self.list_base = 0, 0
        self.primitive = None
        self.stack = []
        self.lists, self.open_list, self.nesting = {}, None, 0
        self.errors, self.emitted = set(), []
        # The first version of GL that requires the answers; true if no text requires the sequence, or if only the
        # reference pages require the answer of the current step.
        self.since, self.advisory, self.advisory_step = FIRST_VERSION, False, False
        self.pushes_enables = self.names_automatic_normals = False
        self.meshed = {}  # vertices of the current mesh, by their indices

    def issue(self, name, arguments):
        """Executes a command, compiles it, or both. Returns the answer of a query, otherwise None."""
        command, form = command_named(name)
        self._note_version(name, arguments)
        if self.open_list and command.compiled:
            self.open_list.commands.append((name, arguments))
            if self.open_list.mode == "GL_COMPILE":
                return None
        return self.execute(command, form, arguments)

    def need(self, version):
        self.since = max(self.since, version)

    def _note_version(self, name, arguments):
        """Raises the first version by the name of a command, and for PushAttrib by its arguments."""
        if name.startswith(("ActiveTexture", "MultiTexCoord")):
            self.need("1.3")
        if name.startswith("Getn"):
            self.need("4.5")
        # ENABLE_BIT of GL 1.0 did not save AUTO_NORMAL.
        bits = str(arguments[0]).split("|") if name == "PushAttrib" and arguments else ()
        self.pushes_enables |= "GL_ENABLE_BIT" in bits and "GL_EVAL_BIT" not in bits
        self.names_automatic_normals |= (name in ("Enable", "Disable", "IsEnabled")
                                         and arguments == ["GL_AUTO_NORMAL"])
        if self.pushes_enables and self.names_automatic_normals:
            self.need("1.1")

    def execute(self, command, form, arguments):
        effect = getattr(self, command.method)
        try:
            _signature(effect.__func__).bind(self, form, *arguments)
        except TypeError:
            raise Malformed(f"wrong number of arguments: {show(arguments)}") from None
        codes = getattr(self, command.method + "_errors", lambda *_: set())(form, *arguments)
        if self.primitive and not command.inside:
            codes = codes | {OPERATION}
        if codes:
            self.errors |= codes
            return [] if command.answers else None
        return effect(form, *arguments)

    # Maps and grids

    def map_errors(self, form, target, *rest):
        dimension = int(form[0])
        directions, _ = directions_of_map(dimension, form[1], rest)
        size = TARGETS[dimension].get(enumerant(target, MAPS[dimension]))
        codes = set()
        if size is None:
            codes.add(ENUM)
            size = 1  # a stride that is too small for every target may be reported as well
        if self.active_unit != 0:
            codes.add(OPERATION)
        for first, last, stride, order in directions:
            self.advisory |= {first, last} == {ZERO, "-0x0p+0"}
            if (read_float(first, FORMATS[form[1]]) == read_float(last, FORMATS[form[1]])
                    or not 1 <= order <= MAX_EVAL_ORDER or stride < size):
                codes.add(VALUE)
        return codes

    def map(self, form, target, *rest):
        dimension = int(form[0])
        directions, points = directions_of_map(dimension, form[1], rest)
        size = TARGETS[dimension][target]
        strides, orders = [d[2] for d in directions] + [0], [d[3] for d in directions] + [1]

        def point(i, j):
            start = i * strides[0] + j * strides[1]
            if start + size > len(points):
                raise Malformed(f"an array of {len(points)} numbers is too short for its map")
            return points[start:start + size]
        rows = [[point(i, j) for j in range(orders[1])] for i in range(orders[0])]
        domain = [x for d in directions for x in d[:2]]
        self.maps[target] = StoredMap(dimension, target, domain, rows, form[1])

    def map_grid_errors(self, form, *arguments):
        return {VALUE} if any(grid[0] <= 0 for grid in directions_of_grid(form, arguments)) else set()

    def map_grid(self, form, *arguments):
        self.grids[int(form[0])] = directions_of_grid(form, arguments)

    # Enables

    def enable_errors(self, form, flag):
        return set() if enumerant(flag, FLAGS | OTHER_FLAGS) in FLAGS | OTHER_FLAGS else {ENUM}

    def enable(self, form, flag):
        if flag in FLAGS:
            self.enabled[flag] = form[0] == "Enable"

    is_enabled_errors = enable_errors

    def is_enabled(self, form, flag):
        if flag not in FLAGS:
            raise Malformed(f"IsEnabled of {flag} is not modelled here")
        return [Value("flag", self.enabled[flag])]

    # Vertices and current values

    def begin_errors(self, form, mode):
        codes = set() if enumerant(mode, MODES) in MODES else {ENUM}
        return codes | {OPERATION} if self.primitive else codes

    def begin(self, form, mode):
        self.primitive = Primitive(mode)

    def end_errors(self, form):
        return set() if self.primitive else {OPERATION}

    def end(self, form):
        if self.primitive.vertices:
            self.emitted.append(self.primitive)
        self.primitive = None

    def attribute(self, form, *arguments):
        name, count, kind, vector = form
        values = attribute_values(name, int(count or 1), kind, vector, arguments)
        if name == "Vertex":
            self.vertex(self.current_attributes() | {"position": filled(values, 4)})
        elif name == "TexCoord":
            self.current["TexCoord"][0] = filled(values, 4)
        else:
            self.current[name] = values + [ONE] if name == "Color" and len(values) == 3 else values

    def multi_tex_coord(self, form, unit, *arguments):
        coordinates = filled(attribute_values("TexCoord", int(form[0]), form[1], form[2], arguments), 4)
        if unit_of(unit) is None:
            raise Malformed(f"MultiTexCoord of {show(unit)} is undefined")
        self.current["TexCoord"][unit_of(unit)] = coordinates

    def edge_flag(self, form, flag):
        flag = array(flag, "u8", 1)[0] if form[0] else flag
        if flag not in (0, 1):
            raise Malformed(f"{show(flag)} is not a boolean")
        self.current["EdgeFlag"] = flag == 1

    def current_attributes(self):
        return {"color": self.current["Color"], "normal": self.current["Normal"],
                "texture_coordinates": list(self.current["TexCoord"])}

    def vertex(self, attributes):
        if not self.primitive:
            raise Malformed("a vertex outside Begin and End is undefined")
        self.primitive.vertices.append(attributes)

    # Evaluation

    def winner(self, dimension, kinds):
        """Returns the map of the first of these kinds that is enabled, or None."""
        targets = (f"GL_MAP{dimension}_{kind}" for kind in kinds)
        return next((self.maps[t].map for t in targets if self.enabled[t]), None)

    def evaluate(self, dimension, arguments):
        """Evaluates at arguments that are Fractions or Grids, and emits a vertex."""
        position = self.winner(dimension, ("VERTEX_4", "VERTEX_3"))
        if position is None:
            return

        def values(the_map):
            return the_map.components(the_map.directions(arguments))
        attributes = self.current_attributes()
        attributes["position"] = filled(values(position), 4)
        color = self.winner(dimension, ("COLOR_4",))
        if color:
            attributes["color"] = values(color)
        texture = self.winner(dimension, [f"TEXTURE_COORD_{n}" for n in (4, 3, 2, 1)])
        if texture:
            attributes["texture_coordinates"][0] = filled(values(texture), 4)
            attributes["initial_texture"] = self.maps[texture.target].is_initial
        normal = self.winner(dimension, ("NORMAL",))
        if dimension == 2 and self.enabled["GL_AUTO_NORMAL"]:
            del attributes["normal"]
            attributes["automatic_normal"] = position.normal(position.directions(arguments))
        elif normal:
            attributes["normal"] = values(normal)
        self.vertex(attributes)

    def eval_coord(self, form, *arguments):
        dimension, kind = int(form[0]), form[1]
        if form[2]:
            arguments = array(*one(arguments), "f64" if kind == "d" else "f32", dimension)
        if len(arguments) != dimension:
            raise Malformed(f"EvalCoord{dimension} of {show(arguments)}")
        self.evaluate(dimension, [read_float(x, FORMATS[kind]) for x in arguments])

    def eval_point(self, form, *indices):
        dimension = int(form[0])
        if len(indices) != dimension:
            raise Malformed(f"EvalPoint{dimension} of {show(indices)}")
        self.evaluate_point(dimension, [integer(i) for i in indices])

    def evaluate_point(self, dimension, indices):
        self.evaluate(dimension, [grid_point(*grid, i) for grid, i in zip(self.grids[dimension], indices)])

    def eval_mesh_errors(self, form, mode, *indices):
        allowed = dict(list(MESH_MODES.items())[:1 + int(form[0])])
        return set() if enumerant(mode, allowed) in allowed else {ENUM}

    def eval_mesh(self, form, mode, *indices):
        """Draws the Begin/End sequences by which the specification defines meshes."""
        dimension = int(form[0])
        if len(indices) != 2 * dimension:
            raise Malformed(f"EvalMesh{dimension} of {show(indices)}")
        self.meshed = {}
        us, *vs = [_few(integer(a), integer(b) + 1) for a, b in zip(indices[::2], indices[1::2])]
        if not self.winner(dimension, ("VERTEX_4", "VERTEX_3")):
            return
        if dimension == 1:
            self.primitive_of({"GL_POINT": "GL_POINTS", "GL_LINE": "GL_LINE_STRIP"}[mode], [(i,) for i in us])
            return
        vs, = vs
        if mode == "GL_POINT":
            self.primitive_of("GL_POINTS", [(i, j) for j in vs for i in us])
        elif mode == "GL_LINE":
            for j in vs:
                self.primitive_of("GL_LINE_STRIP", [(i, j) for i in us])
            for i in us:
                self.primitive_of("GL_LINE_STRIP", [(i, j) for j in vs])
        else:
            for j in vs[:-1]:
                self.primitive_of("GL_QUAD_STRIP", [(i, k) for i in us for k in (j, j + 1)])

    def primitive_of(self, mode, points):
        self.begin((), mode)
        for indices in points:
            if indices not in self.meshed:
                self.evaluate_point(len(indices), indices)
                self.meshed[indices] = self.primitive.vertices[-1]
            else:
                self.vertex(self.meshed[indices])
        self.end(())

    # Attribute stack

    def push_attrib_errors(self, form, mask):
        return {OVERFLOW} if len(self.stack) >= MAX_ATTRIB_STACK_DEPTH else set()

    def push_attrib(self, form, mask):
        names = {name for bit in groups_of(mask) for name in GROUPS.get(bit, ())}
        self.stack.append({name: deepcopy(getattr(self, name)) for name in names})

    def pop_attrib_errors(self, form):
        return set() if self.stack else {UNDERFLOW}

    def pop_attrib(self, form):
        for name, value in self.stack.pop().items():
            setattr(self, name, value)

    def active_texture_errors(self, form, unit):
        return {ENUM} if unit_of(unit) is None else set()

    def active_texture(self, form, unit):
        self.active_unit = unit_of(unit)

    # Display lists

    def new_list_errors(self, form, name, mode):
        codes = set()
        if integer(name, "u32") == 0:
            codes.add(VALUE)
        if enumerant(mode, COMPILE_MODES) not in COMPILE_MODES:
            codes.add(ENUM)
        if self.open_list:
            codes.add(OPERATION)
        return codes

    def new_list(self, form, name, mode):
        self.open_list = OpenList(name, mode)

    def end_list_errors(self, form):
        return set() if self.open_list else {OPERATION}

    def end_list(self, form):
        self.lists[self.open_list.name] = self.open_list.commands
        self.open_list = None

    def call_list(self, form, name):
        self.call(integer(name, "u32"))

    def call(self, name):
        if self.nesting >= MAX_LIST_NESTING:
            return
        self.nesting += 1
        for command, arguments in self.lists.get(name, ()):
            self.execute(*command_named(command), arguments)
        self.nesting -= 1

    def call_lists_errors(self, form, count, kind, names):
        codes = set()
        if integer(count) < 0:
            codes.add(VALUE)
        if enumerant(kind, NAME_TYPES) not in LIST_TYPES:
            codes.add(ENUM)
        return codes

    def call_lists(self, form, count, kind, names):
        holder, size = LIST_TYPES[kind]
        items = array(names, holder)
        if len(items) < count * size:
            raise Malformed(f"CallLists of {count} names out of {show(names)}")
        if holder == "f32":
            items = [int(read_float(x, BINARY32)) for x in items]
        base = self.list_base
        for start in range(0, count * size, size):
            offset = 0
            for byte in items[start:start + size]:
                offset = byte if size == 1 else offset * 256 + byte
            self.call((base + offset) % 2**32)

    def list_base_command(self, form, base):
        self.list_base = integer(base, "u32")

    def gen_lists_errors(self, form, count):
        return {VALUE} if integer(count) < 0 else set()

    def gen_lists(self, form, count):
        """Reserves the least free names; the GL may return any free ones."""
        names = _few(1, count + 1)
        while any(name in self.lists for name in names):
            names = range(names.start + 1, names.stop + 1)
        self.lists.update((name, []) for name in names)

    def is_list(self, form, name):
        return [Value("flag", integer(name, "u32") in self.lists)]

    def delete_lists_errors(self, form, first, count):
        return {VALUE} if integer(count) < 0 else set()

    def delete_lists(self, form, first, count):
        first = integer(first, "u32")
        self.lists = {name: body for name, body in self.lists.items() if not first <= name < first + count}

    def nothing(self, form):
        pass

    # Queries

    def get_map_errors(self, form, target, query, *rest):
        codes = set()
        if enumerant(target, ALL_MAPS) not in ALL_MAPS:
            codes.add(ENUM)
        if enumerant(query, MAP_QUERIES) not in MAP_QUERIES:
            codes.add(ENUM)
        size, _ = room_of(form[0], rest)
        if size is not None:
            if size < 0:
                codes |= {VALUE, OPERATION}
            elif not codes and size < len(self.maps[target].answer(query)) * (8 if form[1] == "d" else 4):
                codes.add(OPERATION)
        return codes

    def get_map(self, form, target, query, *rest):
        answer = self.maps[target].answer(query)
        if self.maps[target].is_initial:
            # Only the reference pages give the initial domain, and GL 1.0 does not give initial texture coordinates.
            self.advisory_step = query == "GL_DOMAIN"
            if query == "GL_COEFF" and "TEXTURE" in target:
                self.need("1.1")
        if form[1] == "i" and any(value.kind == "either" and abs(read_float(value.value, BINARY64)) > 1
                                  for value in answer):
            self.advisory_step = True
        return answer

    def get_errors(self, form, name, out):
        return set() if self.state(name) else {ENUM}

    def get(self, form, name, out):
        return self.state(name)

    def state(self, name):
        """Returns the values of a state variable, or None if the name is not one."""
        if name in FLAGS:
            return [Value("flag", self.enabled[name])]
        for dimension, grid in self.grids.items():
            if name == f"GL_MAP{dimension}_GRID_DOMAIN":
                return [Value("float", x) for _, *ends in grid for x in ends]
            if name == f"GL_MAP{dimension}_GRID_SEGMENTS":
                return [Value("integer", n) for n, *_ in grid]
        plain = {
            "GL_MAX_EVAL_ORDER": lambda: [Value("limit", LEAST_MAX_EVAL_ORDER)],
            "GL_CURRENT_COLOR": lambda: [Value("scaled", x) for x in self.current["Color"]],
            "GL_CURRENT_NORMAL": lambda: [Value("scaled", x) for x in self.current["Normal"]],
            "GL_CURRENT_INDEX": lambda: [Value("float", x) for x in self.current["Index"]],
            "GL_CURRENT_TEXTURE_COORDS":
                lambda: [Value("float", x) for x in self.current["TexCoord"][self.active_unit]],
            "GL_EDGE_FLAG": lambda: [Value("flag", self.current["EdgeFlag"])],
            "GL_ACTIVE_TEXTURE": lambda: [Value("integer", TEXTURE0 + self.active_unit)],
            "GL_ATTRIB_STACK_DEPTH": lambda: [Value("integer", len(self.stack))],
            "GL_LIST_BASE": lambda: [Value("integer", self.list_base)],
            "GL_LIST_INDEX": lambda: [Value("integer", self.open_list.name if self.open_list else 0)],
            "GL_LIST_MODE":
                lambda: [Value("integer", COMPILE_MODES[self.open_list.mode] if self.open_list else 0)],
        }
        if name in plain:
            return plain[name]()
        if name in MAP_QUERIES:
            return None
        raise Malformed(f"the query of {show(name)} is not modelled here")


class OpenList:
    def __init__(self, name, mode):
        self.name, self.mode, self.commands = name, mode, []


_signature = cache(signature)  # signature() takes longer than most commands


def _few(first, beyond):
    """Returns a range. Raises Malformed if it is too long for a sequence."""
    if beyond - first > 10**6:
        raise Malformed(f"{beyond - first} of something")
    return range(first, beyond)
