"""The arguments of GL commands as the files write them."""

from fractions import Fraction

from .maps import FORMATS
from .number import BINARY32, BINARY64, Malformed, nearest, read_float, show

ZERO, ONE = "0x0p+0", "0x1p+0"
RANGES = {"i8": (-2**7, 2**7), "u8": (0, 2**8), "i16": (-2**15, 2**15), "u16": (0, 2**16),
          "i32": (-2**31, 2**31), "u32": (0, 2**32)}
INTEGERS = {"b": "i8", "ub": "u8", "s": "i16", "us": "u16", "i": "i32", "ui": "u32"}


def integer(x, kind="i32"):
    least, beyond = RANGES[kind]
    if type(x) is not int or not least <= x < beyond:
        raise Malformed(f"{show(x)} is not a {kind}")
    return x


def number(x, form):
    """Returns the text of a number of type f or d; raises Malformed if it is none."""
    read_float(x, FORMATS[form])
    return x


def array(x, kind, count=None):
    """Returns the items of an array argument of this kind. Raises Malformed if there are not `count` of them."""
    if not isinstance(x, dict) or list(x) != [kind] or not isinstance(x[kind], list):
        raise Malformed(f"{show(x)} is not an array of {kind}")
    if count is not None and len(x[kind]) != count:
        raise Malformed(f"{show(x)} should have {count} items")
    for item in x[kind]:
        if kind[0] == "f":
            number(item, "d" if kind == "f64" else "f")
        else:
            integer(item, kind)
    return x[kind]


def one(arguments):
    if len(arguments) != 1:
        raise Malformed(f"{show(arguments)} should be one array")
    return arguments


def directions_of_map(dimension, form, rest):
    """Returns (first, last, stride, order) of each direction, and the control values."""
    if len(rest) != 4 * dimension + 1:
        raise Malformed(f"a map with {len(rest)} arguments behind the target")
    directions = []
    for d in range(dimension):
        first, last, stride, order = rest[4 * d:4 * d + 4]
        directions.append((number(first, form), number(last, form), integer(stride), integer(order)))
    return directions, array(rest[-1], "f64" if form == "d" else "f32")


def directions_of_grid(form, arguments):
    """Returns (segments, first, last) of each direction."""
    dimension = int(form[0])
    if len(arguments) != 3 * dimension:
        raise Malformed(f"MapGrid{dimension} of {show(arguments)}")
    return [(integer(n), number(first, form[1]), number(last, form[1]))
            for n, first, last in zip(*(arguments[i::3] for i in range(3)))]


def attribute_values(name, count, kind, vector, arguments):
    """Returns the texts of the values of Vertex, Color and so on in single precision."""
    holder = {"f": "f32", "d": "f64"}.get(kind) or INTEGERS[kind]
    items = array(*(one(arguments) if vector else [{holder: list(arguments)}]), holder, count)
    if kind in FORMATS:
        return [x if kind == "f" or x == "-0x0p+0" else nearest(read_float(x, BINARY64), BINARY32)
                for x in items]
    if name not in ("Color", "Normal"):
        return [nearest(Fraction(x), BINARY32) for x in items]
    greatest = RANGES[holder][1] - 1
    if any(x != greatest and (x or holder[0] == "i") for x in items):
        raise Malformed(f"{name}{count}{kind} of {show(items)}: its conversion is not modelled here")
    return [ONE if x else ZERO for x in items]


def filled(values, count):
    return [*values, *[ZERO, ZERO, ZERO, ONE][len(values):count]]


def room_of(n, rest):
    """Returns the bufSize of GetnMap, otherwise None, and the output array."""
    if len(rest) != 1 + (n == "n"):
        raise Malformed(f"GetMap with {show(rest)} behind the query")
    return (integer(rest[0]) if n else None), rest[-1]
