"""Checks the structure of files, and their cases in parallel."""

import json
import re
from collections import Counter
from itertools import chain
from multiprocessing import Pool

from .number import Malformed, show
from .report import Report, members
from .sequences import check_sequence
from .values import check_values

SEQUENCES = ("errors", "get_map", "state")
KINDS = ("map1_eval", "map2_eval", "grid", "auto_normal", *SEQUENCES)
CHUNK = 8
# The name of a test in the id of a sequence: the function, which is the theme, and its parameters.
TEST = r"([A-Za-z0-9]+\.[A-Za-z0-9]+)(?:/[A-Za-z0-9_.-]+)*"


class File:
    """A file of cases. `malformed` and `differences` are lists of messages."""

    def __init__(self, path):
        self.path, self.kind, self.cases, self.numbers = path, None, [], 0
        self.malformed, self.differences = [], []
        try:
            self._read()
        except Malformed as fault:
            self.malformed.append(str(fault))

    def _read(self):
        try:
            text = self.path.read_bytes().decode("ascii")
            found = json.loads(text, object_pairs_hook=_object, parse_float=_refuse, parse_constant=_refuse)
        except OSError as fault:
            raise Malformed(f"cannot be read: {fault.strerror}") from None
        except (ValueError, RecursionError) as fault:
            raise Malformed(f"is not JSON in ASCII: {show(fault)}") from None
        members(found, "file", "format schemaVersion generatorVersion kind description numberOfTests notes cases")
        for name, expected in (("format", "evalcts-vectors-1"), ("schemaVersion", "1.1")):
            if found[name] != expected:
                raise Malformed(f"{name} {show(found[name])} is not {expected}")
        version = found["generatorVersion"]
        if not isinstance(version, str) or not re.fullmatch("[1-9][0-9]*", version):
            raise Malformed(f"generatorVersion {show(version)} is not the text of a number")
        if found["kind"] not in KINDS:
            raise Malformed(f"kind {show(found['kind'])} is not a known one")
        if not isinstance(found["cases"], list):
            raise Malformed("cases: not a list")
        if found["numberOfTests"] != len(found["cases"]):
            raise Malformed(f"numberOfTests is {show(found['numberOfTests'])}, not {len(found['cases'])}")
        _check_names(found)
        _check_lines(text, found["cases"])
        self.kind, self.cases = found["kind"], found["cases"]

    def merge(self, case, result):
        numbers, differences, malformed = result
        self.numbers += numbers
        self.differences += [f"{case['id']}: {member}: expected {expected}, found {found}"
                             for member, expected, found in differences]
        self.malformed += [f"{case['id']}: {fault}" for fault in malformed]


def _refuse(text):
    raise Malformed(f"{show(text)} is a JSON number that is not an integer")


def _object(pairs):
    repeated = [name for name, times in Counter(name for name, _ in pairs).items() if times > 1]
    if repeated:
        raise Malformed(f"member {show(repeated[0])} occurs twice in an object")
    return dict(pairs)


def _check_lines(text, cases):
    """Each case has its own line, so that line-based tools can find and compare cases."""
    lines = text.splitlines()
    start = next((i for i, line in enumerate(lines, 1) if line.endswith('"cases": [')), len(lines))
    end = start + len(cases)
    try:
        found = [json.loads(line.removesuffix(",")) for line in lines[start:end]]
    except ValueError:
        found = None
    if found != cases or "".join(lines[end:]).replace(" ", "") != "]}":
        raise Malformed("not one case a line")


def _check_names(found):
    """Checks the description, the notes, and the members that all cases have."""
    def text(where, value):
        if not isinstance(value, str) or not value.strip():
            raise Malformed(f"{where}: {show(value)} should be a text")

    def texts(where, value, least):
        if not isinstance(value, list) or len(value) < least:
            raise Malformed(f"{where}: {show(value)} should be a list of names")
        for name in value:
            text(where, name)
        if len(set(value)) != len(value):
            raise Malformed(f"{where}: {show(value)} has a name twice")
    text("description", found["description"])
    if not isinstance(found["notes"], dict):
        raise Malformed("notes: not an object")
    for flag, note in found["notes"].items():
        text(f"notes: {flag}", note)
    used, ids = set(), set()
    for i, case in enumerate(found["cases"]):
        if not isinstance(case, dict):
            raise Malformed(f"cases[{i}]: not an object")
        name = case.get("id")
        theme = TEST if found["kind"] in SEQUENCES else "([a-z0-9-]+)"
        parts = isinstance(name, str) and re.fullmatch(rf"{found['kind']}\.{theme}\.[1-9][0-9]*", name)
        if not parts:
            raise Malformed(f"cases[{i}]: id {show(name)} is not kind, theme and number")
        if name in ids:
            raise Malformed(f"{name}: the id occurs twice")
        ids.add(name)
        texts(f"{name}: requirements", case.get("requirements"), 1)
        texts(f"{name}: flags", case.get("flags"), 0)
        if parts[1] not in case["flags"]:
            raise Malformed(f"{name}: its theme is not among its flags")
        unknown = set(case["flags"]) - set(found["notes"])
        if unknown:
            raise Malformed(f"{name}: flag {min(unknown)} is not in the notes")
        used |= set(case["flags"])
    if set(found["notes"]) - used:
        raise Malformed(f"notes: no case has the flag {min(set(found['notes']) - used)}")


def check_case(job):
    """Returns the number of numbers compared, the differences and the format errors of one case."""
    kind, case = job
    report = Report()
    try:
        (check_sequence if kind in SEQUENCES else check_values)(kind, case, report)
    except Malformed as fault:
        return report.numbers, report.differences, [str(fault)]
    except (AttributeError, LookupError, TypeError, ValueError, ArithmeticError) as fault:
        text = f"members of the wrong types ({type(fault).__name__}: {show(fault)})"
        return report.numbers, report.differences, [text]
    return report.numbers, report.differences, []


def check_files(paths, jobs):
    """Yields each File as soon as its cases are checked."""
    files = [File(path) for path in paths]
    _check_ids_across(files)
    with Pool(jobs) as pool:
        work = ((file.kind, case) for file in files for case in file.cases)
        results = pool.imap(check_case, work, CHUNK)
        for file in files:
            for case in file.cases:
                file.merge(case, next(results))
            yield file


def _check_ids_across(files):
    """Ids are unique across files, because answers in a pipe name cases by their ids only."""
    times = Counter(chain.from_iterable((case["id"] for case in file.cases) for file in files))
    for file in files:
        file.malformed += [f"{case['id']}: the id stands in another file too"
                           for case in file.cases if times[case["id"]] > 1]
