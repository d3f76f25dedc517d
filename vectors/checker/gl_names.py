"""Enumerants and bits of the GL, which the files have by name."""

from .maps import TARGETS
from .number import Malformed, show

ENUM, VALUE, OPERATION = "GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION"
OVERFLOW, UNDERFLOW = "GL_STACK_OVERFLOW", "GL_STACK_UNDERFLOW"

# Cases that use more than two units have a flag.
TEXTURE0, MAX_TEXTURE_UNITS = 0x84C0, 8
UNITS = {f"GL_TEXTURE{i}": TEXTURE0 + i for i in range(MAX_TEXTURE_UNITS)}
# Types of CallLists: the kind of array that holds the names, and its number of items for a name.
LIST_TYPES = {"GL_BYTE": ("i8", 1), "GL_UNSIGNED_BYTE": ("u8", 1), "GL_SHORT": ("i16", 1),
              "GL_UNSIGNED_SHORT": ("u16", 1), "GL_INT": ("i32", 1), "GL_UNSIGNED_INT": ("u32", 1),
              "GL_FLOAT": ("f32", 1), "GL_2_BYTES": ("u8", 2), "GL_3_BYTES": ("u8", 3),
              "GL_4_BYTES": ("u8", 4)}
_PRIMITIVES = ("GL_POINTS", "GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES",
               "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON")
MODES = {name: i for i, name in enumerate(_PRIMITIVES)}
MESH_MODES = {"GL_POINT": 0x1B00, "GL_LINE": 0x1B01, "GL_FILL": 0x1B02}
MAPS = {d: {name: first + i for i, name in enumerate(TARGETS[d])} for d, first in ((1, 0x0D90), (2, 0x0DB0))}
ALL_MAPS = MAPS[1] | MAPS[2]
MAP_QUERIES = {"GL_COEFF": 0x0A00, "GL_ORDER": 0x0A01, "GL_DOMAIN": 0x0A02}
FLAGS = ALL_MAPS | {"GL_AUTO_NORMAL": 0x0D80}
# Some capabilities of Enable that have nothing to do with evaluators.
OTHER_FLAGS = {"GL_LIGHTING": 0x0B50, "GL_COLOR_MATERIAL": 0x0B57, "GL_NORMALIZE": 0x0BA1,
               "GL_DEPTH_TEST": 0x0B71, "GL_BLEND": 0x0BE2, "GL_CULL_FACE": 0x0B44, "GL_FOG": 0x0B60,
               "GL_TEXTURE_1D": 0x0DE0, "GL_TEXTURE_2D": 0x0DE1, "GL_DITHER": 0x0BD0,
               "GL_SCISSOR_TEST": 0x0C11}
COMPILE_MODES = {"GL_COMPILE": 0x1300, "GL_COMPILE_AND_EXECUTE": 0x1301}
NAME_TYPES = {name: 0x1400 + i for i, name in enumerate(LIST_TYPES)}
# Groups of state that PushAttrib saves: attributes of Context.
GROUPS = {"GL_CURRENT_BIT": ("current",), "GL_ENABLE_BIT": ("enabled",), "GL_EVAL_BIT": ("enabled", "grids"),
          "GL_LIST_BIT": ("list_base",), "GL_TEXTURE_BIT": ("active_unit",)}
GROUPS["GL_ALL_ATTRIB_BITS"] = tuple({name for names in GROUPS.values() for name in names})
OTHER_GROUPS = ("GL_POINT_BIT", "GL_LINE_BIT", "GL_POLYGON_BIT", "GL_POLYGON_STIPPLE_BIT",
                "GL_PIXEL_MODE_BIT", "GL_LIGHTING_BIT", "GL_FOG_BIT", "GL_DEPTH_BUFFER_BIT",
                "GL_ACCUM_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_VIEWPORT_BIT", "GL_TRANSFORM_BIT",
                "GL_COLOR_BUFFER_BIT", "GL_HINT_BIT", "GL_SCISSOR_BIT", "GL_MULTISAMPLE_BIT")


def enumerant(x, valid):
    """Returns an enumerant for which `valid` (a dictionary of names and numbers) lists the valid values.

    An invalid one may be a number, because it may have no name.
    """
    if isinstance(x, str) or (type(x) is int and 0 <= x < 2**32 and x not in valid.values()):
        return x
    raise Malformed(f"{show(x)} is not the name of an enumerant")


def unit_of(x):
    """Returns the index of a texture unit, or None if there is no such unit."""
    return UNITS[x] - TEXTURE0 if enumerant(x, UNITS) in UNITS else None


def groups_of(mask):
    """Returns the names of the bits of a mask."""
    if not isinstance(mask, str):
        raise Malformed(f"{show(mask)} is not the names of bits")
    names = mask.split("|")
    for name in names:
        if name not in GROUPS and name not in OTHER_GROUPS:
            raise Malformed(f"{show(name)} is not a bit of PushAttrib")
    return names
