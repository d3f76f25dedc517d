"""Cases that ask for one value of a map: map1_eval, map2_eval, grid, auto_normal."""

from .accuracy import Grid, quotient_interval
from .bernstein import de_casteljau
from .maps import read_map
from .number import BINARY32, BINARY64, Malformed, nearest, read_float, read_rational
from .report import ADVISORY, BOTH, FIRST_VERSION, MUST, integer, members, read

TARGETS_OF = {"map1_eval": "GL_MAP1_", "map2_eval": "GL_MAP2_", "grid": "GL_MAP",
              "auto_normal": "GL_MAP2_VERTEX_"}
COMMON = "id requirements flags level since map u"


def check_values(kind, case, report):
    """Checks a case of one of the four kinds."""
    target = case["map"].get("target") if isinstance(case.get("map"), dict) else None
    if not isinstance(target, str) or not target.startswith(TARGETS_OF[kind]):
        raise Malformed(f"map: target {target!r} in a case of {kind}")
    common = COMMON + (" v" if target.startswith("GL_MAP2") else "")
    if kind == "auto_normal":
        members(case, "case", f"{common} derivatives m normal accept")
        if isinstance(case["u"], dict) != isinstance(case["v"], dict):
            raise Malformed("u, v: both are numbers, or both points of a grid")
    else:
        members(case, "case", f"{common} components", "intermediate quotients")
    the_map, form = read_map(case["map"], members)
    arguments = [_argument(name, case[name], form, kind, report) for name in "uv"[:the_map.dimension]]
    directions = the_map.directions(arguments)
    if kind == "auto_normal":
        normal = the_map.normal(directions)
        check_normal(case, normal, report, derivatives=True)
        report.same("level", MUST if normal.judged() else ADVISORY, case["level"])
        report.same("since", FIRST_VERSION, case["since"])
        return
    components = the_map.components(directions)
    accepts = any(component.interval() for component in components)
    report.same("level", MUST if accepts else ADVISORY, case["level"])
    needs_gl_2 = any(component.needs_gl_2 for component in components)
    report.same("since", "2.0" if needs_gl_2 else FIRST_VERSION, case["since"])
    for member, component, found in report.pairs("components", components, case["components"]):
        check_component(member, component, found, report)
    if ("quotients" in case) != (target.endswith("VERTEX_4") and components[3].value != 0):
        raise Malformed("quotients: present exactly where there is a w and it is not zero")
    if "quotients" in case:
        _check_quotients(components, case["quotients"], report)
    if "intermediate" in case:
        _check_intermediate(the_map, directions, components, case["intermediate"], report)


def _argument(where, found, form, kind, report):
    """Returns a Fraction, or a Grid if the member describes a point of one."""
    if not (kind == "grid" or (kind == "auto_normal" and isinstance(found, dict))):
        return read(where, read_float, found, form)
    members(found, where, "segments first last index exact")
    grid = Grid(integer(f"{where}.segments", found["segments"], 1),
                read(f"{where}.first", read_float, found["first"], form),
                read(f"{where}.last", read_float, found["last"], form),
                integer(f"{where}.index", found["index"]))
    report.rational(f"{where}.exact", grid.exact, found["exact"])
    return grid


def check_component(where, component, found, report):
    members(found, where, "exact magnitude float double accept")
    report.rational(f"{where}.exact", component.value, found["exact"])
    report.rational(f"{where}.magnitude", component.magnitude, found["magnitude"])
    for name, form in BOTH:
        report.number(f"{where}.{name}", nearest(component.value, form), found[name], form)
    report.interval(f"{where}.accept", component.interval(), found["accept"])


def _check_quotients(components, found, report):
    *position, w = components
    for member, x, entry in report.pairs("quotients", position, found):
        members(entry, member, "exact float double accept")
        report.rational(f"{member}.exact", x.value / w.value, entry["exact"])
        for name, form in BOTH:
            report.number(f"{member}.{name}", nearest(x.value / w.value, form), entry[name], form)
        report.interval(f"{member}.accept", quotient_interval(x, w), entry["accept"])


def _check_intermediate(the_map, directions, components, found, report):
    where = "intermediate"
    members(found, where, "uh vh basis_u basis_v" if the_map.dimension == 2 else "uh basis_u de_casteljau")
    for name, direction in zip("uv"[:the_map.dimension], directions):
        report.rational(f"{where}.{name}h", direction.t, found[name + "h"])
        basis = direction.weights(direction.degree).fractions()
        report.rationals(f"{where}.basis_{name}", basis, found["basis_" + name])
    if the_map.dimension == 1:
        triangle = de_casteljau([row[0] for row in the_map.nets()[0]], directions[0].t, directions[0].s)
        for member, row, entry in report.pairs(f"{where}.de_casteljau", triangle, found["de_casteljau"]):
            report.rationals(member, row, entry)
        assert triangle[-1] == [components[0].value]


def check_normal(found, normal, report, where="", derivatives=False):
    """Checks the members about a normal of the object `found`."""
    if derivatives:
        members(found["derivatives"], where + "derivatives", "u v")
        for name, vector in (("u", normal.along_u), ("v", normal.along_v)):
            values = [x.value for x in vector]
            report.rationals(f"{where}derivatives.{name}", values, found["derivatives"][name])
    if _both_given(where + "m", normal.m, found["m"], report):
        report.rationals(where + "m", normal.m, found["m"])
    unit = range(3) if normal.m and any(normal.m) else None
    if _both_given(where + "normal", unit, found["normal"], report):
        for member, c, entry in report.pairs(where + "normal", unit, found["normal"]):
            _check_unit_component(member, normal, c, entry, report)
    bound = normal.judged() or None
    if _both_given(where + "accept", bound, found["accept"], report):
        _check_acceptance(where + "accept", normal, found["accept"], report)


def _both_given(where, expected, found, report):
    """True if neither is None. Reports a difference if only one of them is."""
    if expected is not None and found is not None:
        return True
    report.numbers += 1
    if expected is not found:
        report.differ(where, "null" if expected is None else "not null", found)
    return False


def _check_unit_component(where, normal, c, found, report):
    members(found, where, "enclosure float double")
    enclosure = found["enclosure"]
    if not isinstance(enclosure, list) or len(enclosure) != 2:
        raise Malformed(f"{where}.enclosure: not a list of two numbers")
    low, high = (read(f"{where}.enclosure[{i}]", read_rational, enclosure[i]) for i in (0, 1))
    report.numbers += 2
    if not (normal.at_least(c, low) and normal.at_most(c, high)):
        report.differ(f"{where}.enclosure", f"numbers around {normal.rounded(c, BINARY64)}", enclosure)
    elif (high - low) * 2**80 > 1:
        report.differ(f"{where}.enclosure", "numbers at most 2^-80 apart", enclosure)
    for name, form in BOTH:
        report.number(f"{where}.{name}", normal.rounded(c, form), found[name], form)


def _check_acceptance(where, normal, found, report):
    members(found, where, "bound either_sign")
    bound = read(f"{where}.bound", read_float, found["bound"], BINARY32)
    report.numbers += 1
    if not normal.bounds(bound):
        report.differ(f"{where}.bound", f"just above {normal.bound_estimate():.9g}", found["bound"])
    # Two interpretations of the derivatives differ in sign for each reversed direction.
    open_ = sum(d.first > d.last for d in (normal.u, normal.v)) == 1
    report.same(f"{where}.either_sign", open_, found["either_sign"])
