"""Maps: targets, their description in the files, and evaluation."""

from functools import cached_property

from .accuracy import POINT, Component, Direction
from .bernstein import Net
from .normals import Normal
from .number import BINARY32, BINARY64, Malformed, read_float, show

SIZES = {"COLOR_4": 4, "INDEX": 1, "NORMAL": 3, "TEXTURE_COORD_1": 1, "TEXTURE_COORD_2": 2,
         "TEXTURE_COORD_3": 3, "TEXTURE_COORD_4": 4, "VERTEX_3": 3, "VERTEX_4": 4}
# The targets of each dimension, with the number of components.
TARGETS = {d: {f"GL_MAP{d}_{kind}": k for kind, k in SIZES.items()} for d in (1, 2)}
FORMATS = {"f": BINARY32, "d": BINARY64}


class Map:
    """points[i][j][c]; a curve has a single j. `domain` has two numbers a dimension."""

    def __init__(self, dimension, target, domain, points):
        self.dimension, self.target, self.domain, self.points = dimension, target, domain, points
        self.size = TARGETS[dimension][target]
        self.orders = (len(points), len(points[0]))[:dimension]
        self._directions = {}

    def directions(self, arguments):
        """Returns the Directions of u and v. `arguments`: a Fraction or a Grid for each dimension of the map."""
        found = [self._direction(d, argument) for d, argument in zip(range(self.dimension), arguments)]
        return found if self.dimension == 2 else [*found, POINT]

    def _direction(self, d, argument):
        """Returns the Direction of u (d = 0) or v. It is kept, because the points of a mesh share their arguments."""
        if (d, argument) not in self._directions:
            first, last = self.domain[2 * d:2 * d + 2]
            self._directions[d, argument] = Direction(first, last, argument, self.orders[d] - 1)
        return self._directions[d, argument]

    def nets(self):
        return [[[point[c] for point in row] for row in self.points] for c in range(self.size)]

    @cached_property
    def _components(self):
        return [(rows, Net(rows)) for rows in self.nets()]

    def components(self, directions):
        color, texture = self.target.endswith("COLOR_4"), "TEXTURE" in self.target
        return [Component(rows, *directions, color=color, net=net, texture=texture)
                for rows, net in self._components]

    def normal(self, directions):
        return Normal(self.nets(), *directions)


def read_map(found, members):
    """Returns the Map of a `map` member and the format of its numbers. `members` checks the members of an object."""
    members(found, "map", "target type domain points")
    target, form = str(found["target"]), FORMATS.get(str(found["type"]))
    dimension = next((d for d in TARGETS if target in TARGETS[d]), None)
    if dimension is None or form is None:
        raise Malformed(f"map: target {show(target)}, type {show(found['type'])}")
    size = TARGETS[dimension][target]

    def numbers(values, count):
        if not isinstance(values, list) or len(values) != count:
            raise Malformed(f"map: {show(values)} should be a list of {count} numbers")
        return [read_float(x, form) for x in values]

    def items(values):
        if not isinstance(values, list) or not values:
            raise Malformed(f"map: points: {show(values)} should be a list that is not empty")
        return values
    points = [[numbers(point, size) for point in (items(row) if dimension == 2 else [row])]
              for row in items(found["points"])]
    if len({len(row) for row in points}) != 1:
        raise Malformed("map: rows of points of different lengths")
    domain = numbers(found["domain"], 2 * dimension)
    if any(a == b for a, b in zip(domain[::2], domain[1::2])):
        raise Malformed("map: empty domain")
    return Map(dimension, target, domain, points), form
