#!/usr/bin/env python3
"""Writes results-egl-nvidia.json from the page of 2026-11-23, which has the only record of a run on NVIDIA's driver:

    git show b886938a:reports/published/index.html | reports/published/convert_nvidia.py > results-egl-nvidia.json

Names, verdicts, requirements, counts and messages are the page's. JUDGEMENTS states, for the failing tests, the bug and the
requirements that the recorded mismatches violate, as the suite judges today: a mismatch violates the requirement of its own subject
only. WITHDRAWN names the failures that say nothing of evaluators. Of the tests that passed, those of the violated requirements are
kept, so that each requirement has the number of tests that decided it.
"""
import collections
import html
import json
import re
import sys

NAME = "egl-nvidia"
# Length to which the texts of a failure are cut. Only the first failure of each test is kept; the page has up to eight.
MOST_OF_TEXT = 160

ORDER = "the lines and points of a mesh may have any order here, which other tests judge (EV-MESH2-POINT, EV-MESH2-LINE)"
WITHDRAWN = [  # (pattern of tests, reason)
    (r"Feedback\.(PointMesh|LineMesh|FlatColors)$", ORDER),
    (r"Ordering\.SeesEarlierState2/EVALMESH$", ORDER),
    (r"Pipeline\.(RasterizerDiscard|TransformFeedback|VertexShaderAttributes)$", ORDER),
    (r"Pipeline\.FlatLines$", "the second vertex of a segment is another one if the line runs in the other direction, which "
                              "EV-MESH2-LINE forbids"),
    (r"Pipeline\.FogBy", "without fog the pixels differ as well: the last pixel of a line is not drawn, and the lines run in the "
                         "other direction, which EV-MESH2-LINE forbids"),
    (r"Pipeline\.TextureMatrix$", "explicit lines are wrong, too: the record has 4 and -1.5 where the matrices give "
                                  "-2 and 0; the matrix was applied twice, and three times in the mesh"),
]

# (bug, title, clause, [(pattern of tests, violated requirements)]). {d} is the dimension in the name of the test; no requirements:
# those of the test that the page names, without the ones of a delivery through display lists, because the test fails without lists,
# too.
JUDGEMENTS = [
    ("stride", "Map1 and Map2 with a stride below k raise the error and define the map nevertheless, from memory around the points",
     "GL 2.1 2.5", [(r"Map[12]Errors\.(StrideBelowK|[UV]Stride|StridesAtManyOrders|EvaluatesAsBefore|RefusedWhile|SeveralAtOnce)",
                     ["EV-MAP{d}-ERR-NOEFFECT"]),
                    (r"AfterRandomCommands\.", ["EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT"])]),
    ("unit", "Map1 and Map2 raise no error if another unit than TEXTURE0 is active", "GL 1.3 5.1",
     [(r"Map[12]Errors\.ActiveTexture", ["EV-MAP{d}-ERR-ACTIVETEX"]),
      (r"DisplayLists\.ActiveTexture", ["EV-MAP1-ERR-ACTIVETEX"])]),
    ("current", "What Color, Normal and TexCoord set between Begin and an evaluation in the same primitive is lost",
     "GL 2.1 2.7, 5.1", [(r"CurrentValues\.|Evaluation\.CurrentValuesOfTheMoment", []),
                         (r"Findings\.GivenTexture", ["EV-COORD-NOVERTEX"])]),
    ("order", "EvalMesh2 draws the right points, lines and quads in another order and direction", "GL 2.1 5.1",
     [(r"Mesh2\.Points", ["EV-MESH2-POINT"]), (r"Mesh2\.Lines", ["EV-MESH2-LINE"]), (r"Mesh2\.Quads", ["EV-MESH2-FILL"]),
      (r"Mesh2\.(FlatShading|Stipple)", [])]),
    ("empty", "EvalMesh2 of LINE over an empty range draws lines", "GL 2.1 5.1",
     [(r"Mesh2\.EmptyRange|Selection\.EmptyMesh", ["EV-MESH2-EMPTY"])]),
    ("integers", "GetMapiv of values above 2147483647 returns -2147483648", "GL 2.1 6.1.2", [(r"GetMap2?\.IntegersSaturate", [])]),
    ("size", "GetnMap accepts a negative bufSize and writes", "GL 4.6 2.3.1",
     [(r"GetnMap\.NegativeSize|Interpretations\.NegativeSize", [])]),
    ("length", "Automatic normals are normalized with a vertex shader or program, too",
     "GL 2.1 5.1; ARB_vertex_program issue 92; NV_vertex_program 5.1",
     [(r"AutomaticNormals\.NotNormalised|NvVertexProgram\.AutoNormal", [])]),
    ("core", "GetMap and some queries by Get answer in core profiles", "GL 4.6 core E.2", [(r"Profiles\.", [])]),
    ("w", "w = 0 of a vertex of MAP1_VERTEX_4 becomes 1 if Vertex3 follows in the primitive", "GL 2.1 5.1",
     [(r"Findings\.PositionBeforeVertex", [])]),
]


def text(markup):
    return html.unescape(re.sub(r"<[^>]+>", "", markup)).strip()


def cut(words):
    return words if len(words) <= MOST_OF_TEXT else words[:MOST_OF_TEXT - 3] + "..."


def failure_of(part):
    """Returns the first failing case of the part of the page about this implementation."""
    case = part.split('<details class="case"')[1]
    fields = {text(key): text(value) for key, value in re.findall(r"<dt>(.*?)</dt><dd>(.*?)</dd>", case, re.S)}
    out = {"case": text(re.search(r"<summary>(.*?)(?:<span|</summary>)", case, re.S)[1])}
    for key in ("Message", "What", "Expected", "Captured", "Exact", "Capture"):
        if key in fields:
            out[key.lower()] = cut(fields[key])
    return out


def read_tests(page):
    """Returns the tests of the page as records."""
    requirements, tests = page[page.index('<h2 id="requirements"'):].split('<h2 id="tests"', 1)
    ids = re.findall(r'<tr id="requirement-([^"]+)"', requirements)
    place = re.findall(r"<h3>([^<]+)</h3>", page[:page.index('<h2 id="requirements"')]).index(NAME)
    for markup in tests.split('<details class="test ')[1:]:
        head = re.search(r'id="test-([^"]+)".*?data-verdicts="([^"]+)" data-level="(\w+)" data-rows="([^"]*)"', markup)
        record = {"name": html.unescape(head[1]), "verdict": head[2].split(" ")[place], "level": head[3],
                  "requirements": [ids[int(row)] for row in head[4].split()]}
        if record["verdict"] == "fail":
            part = next(p for p in markup.split('<section class="outcome">') if re.search(rf"</span> [^<]*{NAME}</h3>", p))
            counts = re.search(r"(\d+) of (\d+) cases? failed", part)
            record.update(failed_cases=int(counts[1]), cases=int(counts[2]), seed=1, expected_by_baseline=True,
                          failures=[failure_of(part)])
            record["message"] = record["failures"][0].pop("message")
        yield record


def judge(record):
    """Sets the violated requirements of a failing test, or withdraws it. Returns the bug; None if it was withdrawn."""
    name = record["name"]
    for pattern, reason in WITHDRAWN:
        if re.match(pattern, name):
            record["verdict"] = "not-observable"
            record["message"] = f"withdrawn: {reason}; recorded as fail: {record['message']}"
            for key in ("failures", "failed_cases", "expected_by_baseline"):
                del record[key]
            return None
    for bug, _, _, rules in JUDGEMENTS:
        for pattern, violated in rules:
            if re.match(pattern, name):
                own = [i for i in record["requirements"] if not i.startswith("EV-DL-")]
                dimension = re.match(r"Map([12])", name)
                record["violated"] = [i.format(d=dimension and dimension[1]) for i in violated] or own
                return bug
    raise SystemExit(f"no judgement of {name}")


def main():
    page = sys.stdin.read()
    tests = list(read_tests(page))
    by_bug = collections.defaultdict(list)
    for record in tests:
        if record["verdict"] == "fail" and (bug := judge(record)):
            by_bug[bug].append(record)
    violated = {i for records in by_bug.values() for record in records for i in record["violated"]}
    kept = [record for record in tests if "message" in record or violated & set(record["requirements"])]
    for record in kept:
        if "message" not in record:
            record["requirements"] = [i for i in record["requirements"] if i in violated]

    bugs = []
    for bug, title, clause, _ in JUDGEMENTS:
        records = by_bug[bug]
        requirements = [i for i, _ in collections.Counter(i for r in records for i in r["violated"]).most_common()]
        bugs.append({"id": f"egl-nvidia-{bug}", "title": title, "clause": clause, "level": "must", "verdict": "fail",
                     "requirements": requirements, "explains": sorted(requirements),
                     "failure": records[0]["failures"][0] | {"message": records[0]["message"]},
                     "tests": sorted(r["name"] for r in records),
                     "why_not_reduced": "the run was made before programs were reduced"})
    result = {
        "format": "evalcts-results-1", "evalcts_version": "0.1.0", "status": "interrupted",
        "reason": f"converted from the page of 2026-11-23: the failing tests and those of the requirements that they violate, "
                  f"{len(kept)} of {len(tests)}",
        "command": f"./evalcts run --implementation egl --name {NAME}", "depth": "full", "seed": 1, "baseline": NAME,
        "implementation": {"name": NAME, "kind": "egl", "library": "/lib/x86_64-linux-gnu/libEGL.so.1",
                           "vendor": "NVIDIA Corporation", "renderer": "NVIDIA H100 80GB HBM3/PCIe/SSE2",
                           "version": "4.6.0 NVIDIA 580.159.04", "max_eval_order": 8},
        "summary": collections.Counter(record["verdict"] for record in kept),
        "tests": kept, "bugs": bugs,
        "bugs_note": "grouped by hand by root cause; see convert_nvidia.py",
    }
    rows = {key: value for key, value in result.items() if key not in ("tests", "bugs")}
    lines = [json.dumps(rows)[:-1]]
    for key in ("tests", "bugs"):
        lines.append(f', "{key}": [')
        lines.append(",\n".join(json.dumps(item, separators=(",", ":")) for item in result[key]))
        lines.append("]")
    print("\n".join(lines) + "}")


main()
