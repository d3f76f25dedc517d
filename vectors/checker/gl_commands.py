"""The GL commands that are known here, by name."""

import re
from functools import cache
from typing import NamedTuple

from .number import Malformed, show


class Command(NamedTuple):
    pattern: re.Pattern
    method: str
    inside: bool        # legal between Begin and End
    compiled: bool      # into an open display list
    answers: bool       # a query


def _commands(*rows):
    return [Command(re.compile(pattern), method, mark == "inside", mark not in ("immediate", "query"),
                    mark == "query")
            for pattern, method, mark in (row if len(row) == 3 else (*row, "") for row in rows)]


COMMANDS = _commands(
    ("Map([12])([fd])", "map"),
    ("MapGrid([12])([fd])", "map_grid"),
    ("(Enable|Disable)", "enable"),
    ("IsEnabled", "is_enabled", "query"),
    ("Begin", "begin", "inside"),
    ("End", "end", "inside"),
    ("(Vertex)([234])(s|i|f|d)(v?)", "attribute", "inside"),
    ("(Color)([34])(b|s|i|f|d|ub|us|ui)(v?)", "attribute", "inside"),
    ("(Normal)(3)(b|s|i|f|d)(v?)", "attribute", "inside"),
    ("(TexCoord)([1234])(s|i|f|d)(v?)", "attribute", "inside"),
    ("(Index)()(s|i|f|d|ub)(v?)", "attribute", "inside"),
    ("MultiTexCoord([1234])(s|i|f|d)(v?)(?:ARB)?", "multi_tex_coord", "inside"),
    ("EdgeFlag(v?)", "edge_flag", "inside"),
    ("EvalCoord([12])([fd])(v?)", "eval_coord", "inside"),
    ("EvalPoint([12])", "eval_point", "inside"),
    ("EvalMesh([12])", "eval_mesh"),
    ("PushAttrib", "push_attrib"),
    ("PopAttrib", "pop_attrib"),
    ("ActiveTexture(?:ARB)?", "active_texture"),
    ("NewList", "new_list", "immediate"),
    ("EndList", "end_list", "immediate"),
    ("CallList", "call_list", "inside"),
    ("CallLists", "call_lists", "inside"),
    ("ListBase", "list_base_command"),
    ("GenLists", "gen_lists", "immediate"),
    ("IsList", "is_list", "query"),
    ("DeleteLists", "delete_lists", "immediate"),
    ("Get(n?)Map([fdi])v(?:ARB)?", "get_map", "query"),
    ("Get(Boolean|Integer|Float|Double)v", "get", "query"),
    ("(?:Flush|Finish)", "nothing", "immediate"),
)


def command_named(name):
    found = _find(name) if isinstance(name, str) else None
    if found is None:
        raise Malformed(f"command {show(name)} is not known here")
    return found


@cache
def _find(name):
    matches = ((command, command.pattern.fullmatch(name)) for command in COMMANDS)
    return next(((command, match.groups()) for command, match in matches if match), None)
