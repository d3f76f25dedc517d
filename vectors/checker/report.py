"""Collects comparisons and differences."""

from .number import BINARY32, BINARY64, Malformed, float_text, rational_text, read_float, read_rational, show


class Report:
    """The number of numbers compared in a case, and (member, expected, found) of those that differ."""

    def __init__(self):
        self.numbers = 0
        self.differences = []

    def differ(self, where, expected, found):
        self.differences.append((where, show(expected), show(found)))

    def same(self, where, expected, found):
        """Compares values with only one representation, such as integers and names."""
        self.numbers += 1
        if type(expected) is not type(found) or expected != found:
            self.differ(where, expected, found)

    def rational(self, where, expected, found):
        self.numbers += 1
        if found != rational_text(expected):
            read(where, read_rational, found)
            self.differ(where, rational_text(expected), found)

    def rationals(self, where, expected, found):
        for member, x, y in self.pairs(where, expected, found):
            self.rational(member, x, y)

    def number(self, where, expected, found, form):
        """A rounded result: `expected` is a text, and may be an infinity."""
        self.numbers += 1
        if found != expected:
            if found not in ("inf", "-inf"):
                read(where, read_float, found, form)
            self.differ(where, expected, found)

    def interval(self, where, expected, found):
        """Compares the least and the greatest accepted number, or null."""
        if expected is None or found is None:
            self.numbers += 1
            if expected is not found:
                self.differ(where, expected and list(map(float_text, expected)), found)
        else:
            for member, x, y in self.pairs(where, expected, found):
                self.number(member, float_text(x), y, BINARY32)

    def pairs(self, where, expected, found):
        """Returns (member, expected, found) for each item of two lists."""
        if not isinstance(found, list):
            raise Malformed(f"{where}: {show(found)} is not a list")
        if len(expected) != len(found):
            self.differ(where, f"{len(expected)} items", f"{len(found)} items")
        return [(f"{where}[{i}]", x, y) for i, (x, y) in enumerate(zip(expected, found))]


def read(where, reader, *arguments):
    """Returns reader(*arguments). Puts the name of the member in front of the message of Malformed."""
    try:
        return reader(*arguments)
    except Malformed as fault:
        raise Malformed(f"{where}: {fault}") from None


def members(found, where, required, optional=""):
    """Raises Malformed unless the members of an object are those that the format documents."""
    if not isinstance(found, dict):
        raise Malformed(f"{where}: {show(found)} is not an object")
    missing = [name for name in required.split() if name not in found]
    unknown = sorted(set(found) - set(required.split()) - set(optional.split()))
    for what, names in (("missing", missing), ("unknown", unknown)):
        if names:
            raise Malformed(f"{where}: {what} {', '.join(map(show, names))}")


def integer(where, found, least=None):
    if type(found) is not int or (least is not None and found < least):
        raise Malformed(f"{where}: {show(found)} is not a permitted integer")
    return found


# Levels of cases: some text of the GL requires the answer, or none does.
MUST, ADVISORY = "must", "advisory"
FIRST_VERSION = "1.0"

BOTH = (("float", BINARY32), ("double", BINARY64))
