"""Checks the pages of write_pages with parsers that are not part of the project: check_pages.py FOLDER"""

import html.parser
import json
import pathlib
import sys
import unittest
import xml.etree.ElementTree as ET

FOLDER = pathlib.Path(sys.argv.pop())

# The text that a page must show for hostile_text() of reports/tests/samples.h.
HOSTILE = (
    "<script>alert(1)</script> \" ' & ]]> --> {{name}} {{{name}}} \u2400\u2401\u241b[31m\u2421 \ufffd \ufffd "
)
HOSTILE_END = " \u00e9 \ufffd\ufffd"  # between the two: one or more U+FFFD for the surrogate

REGISTRY = "https://registry.khronos.org/OpenGL"
NAMES = ("one", "three", "none", "hostile", "compared", "hostile-compared")
VOID = {"meta", "link", "br", "input", "wbr"}


class Page(html.parser.HTMLParser):
    """Collects elements, ids, links, text and data of a page; complains about tags that do not nest."""

    def __init__(self, path):
        super().__init__(convert_charrefs=True)
        self.stack, self.tags, self.ids, self.links, self.words, self.data_text = [], [], [], [], [], None
        self.attributes = []
        self.feed(path.read_bytes().decode("utf-8", errors="strict"))
        self.close()
        if self.stack:
            raise ValueError(f"not closed: {self.stack}")
        self.text = "".join(self.words)
        self.data = json.loads(self.data_text)
        self.strings = "\n".join(self.data["strings"])

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        for name, value in attrs:
            self.attributes.append((tag, name, value))
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "action", "aria-labelledby", "for"):
                self.links += [(name, word) for word in value.split()] if name == "for" else [(name, value)]
        if tag not in VOID:
            self.stack.append(tag)

    def handle_endtag(self, tag):
        if not self.stack or self.stack.pop() != tag:
            raise ValueError(f"</{tag}> closes nothing at {self.getpos()}")

    def handle_data(self, data):
        if self.stack[-1:] == ["script"]:
            self.data_text = self.data_text or data
        elif self.stack[-1:] != ["style"]:
            self.words.append(data)


class Html(unittest.TestCase):
    def test_every_page_is_closed_in_itself(self):
        for name in NAMES:
            with self.subTest(name):
                page = Page(FOLDER / f"{name}.html")
                self.assertEqual(page.tags.count("script"), 2)
                self.assertEqual(page.tags.count("style"), 1)
                self.assertEqual(len(page.ids), len(set(page.ids)), "ids are unique")
                for kind, target in page.links:
                    if target.startswith(REGISTRY):
                        continue
                    if kind == "href" and not target.startswith("data:"):
                        self.assertTrue(target.startswith("#"), target)
                        if "=" in target:
                            continue  # a state of the page
                        target = target[1:]
                    if not target.startswith("data:"):
                        self.assertIn(target, page.ids)
                for tag, attribute, _ in page.attributes:
                    self.assertFalse(attribute.startswith("on"), f"{attribute} of {tag}")
                self.assertNotIn("http:", page.text)
                self.assertNotIn("https:", page.text)

    def test_numbers_in_the_data_are_those_of_something(self):
        for name in NAMES:
            with self.subTest(name):
                data = Page(FOLDER / f"{name}.html").data
                size = {key: len(value) for key, value in data.items() if isinstance(value, list)}
                self.assertEqual(len(data["strings"]), len(set(data["strings"])))
                self.assertEqual(len(data["outcomes"]), size["columns"])
                for column, commands in zip(data["outcomes"], data["commandsOf"]):
                    self.assertEqual(len(column), size["tests"])
                    self.assertLess(max(column, default=-1), size["records"])
                    self.assertLess(max(commands, default=-1), size["commands"])
                self.assertEqual(len(data["documentsOf"]), size["requirements"])
                for documents in data["documentsOf"] + [bug["documents"] for bug in data["bugs"]]:
                    self.assertLess(max(documents, default=-1), size["documents"])
                for test, level, source, *requirements in data["tests"]:
                    self.assertLess(max(test, source), size["strings"])
                    self.assertLess(level, size["levels"])
                    self.assertLess(max(requirements, default=-1), size["requirements"])
                for verdict, _, _, *texts in data["records"]:
                    self.assertLess(verdict, size["verdicts"])
                    self.assertLess(max(texts[:4]), size["strings"])
                    self.assertLess(texts[4], size["violations"])
                    self.assertLess(max(texts[5:], default=-1), size["failures"])
                for *texts, calls, plot in data["failures"]:
                    self.assertEqual(len(texts), 8)
                    self.assertLess(max(texts), size["strings"])
                    self.assertLess(calls, size["calls"])
                    self.assertLess(plot, size["plots"])
                for bug in data["bugs"]:
                    self.assertLess(bug["failure"], size["failures"])
                    self.assertTrue(bug["found"])
                    for column, known, *tests in bug["found"]:
                        self.assertLess(column, size["columns"])
                        self.assertLess(max(tests), size["tests"])
                        self.assertIn(known, (0, 1))

    def test_hostile_text_is_only_text(self):
        page = Page(FOLDER / "hostile.html")
        for text in (page.text, page.strings):
            self.assertGreater(text.count(HOSTILE), 5)
            self.assertEqual(text.count(HOSTILE), text.count(HOSTILE_END))
            for character in text:
                self.assertTrue(character in "\n\t\0" or character >= " ", repr(character))

    def test_every_verdict_and_its_evidence_are_there(self):
        page = Page(FOLDER / "one.html")
        for shown in (
            "0.25005 +- 5e-05 exact 0.25005",
            "1,676,000 ULP, condition-aware 838,000",
            "FeedbackBuffer",
            "glEvalCoord1f(0x1.8p+0f);",
            "./evalcts run --implementation osmesa --filter \0",
            "gdb --args build/evalcts-suite --implementation osmesa --gtest_filter=\0",
            "./evalcts reproduce osmesa:\0",
            "The argument is mapped affinely: uh = (u - u1)/(u2 - u1).",
            "Expected by the baseline: Mesa checks the stride after the pointer",
            "the pipeline ignores edge flags of quad strips",
            "20 % (96)",
        ):
            self.assertIn(shown, page.strings)
        for shown in ("interrupted by SIGINT", "not available: not in this process", "19.9 % (98)",
                      "EvalMesh2 behind CallList crashes", "glEvalMesh2(GL_FILL, 0, 1, 0, 1);"):
            self.assertIn(shown, page.text)
        data = page.data
        verdicts = {data["verdicts"][record[0]][0] for record in data["records"]}
        self.assertEqual(verdicts, {"internal-error", "crash", "timeout", "fail", "quality-warning", "not-observable",
                                    "not-supported", "skipped", "pass"})
        for verdict in verdicts:
            self.assertIn(f" {verdict.replace('not-observable', 'not observed')}", page.text)

    def test_what_was_not_judged(self):
        self.assertIn("No result record was given.", Page(FOLDER / "none.html").text)
        self.assertIn("Not judged: no X server: DISPLAY is not set", Page(FOLDER / "three.html").text)


class Junit(unittest.TestCase):
    # Jenkins' schema (junit-10.xsd of its xunit plugin), which GitLab, GitHub's actions and Azure read as well:
    # the attributes that an element must and may have, and its children.
    TEXT = (set(), {"type", "message"}, set())
    STRUCTURE = {
        "testsuites": (set(), {"name", "tests", "failures", "errors", "time"}, {"testsuite"}),
        "testsuite": ({"name", "tests", "failures", "errors"}, {"skipped", "time"}, {"properties", "testcase"}),
        "properties": (set(), set(), {"property"}),
        "property": ({"name", "value"}, set(), set()),
        "testcase": ({"name"}, {"classname", "time"}, {"failure", "error", "skipped", "system-out"}),
        "failure": TEXT,
        "error": TEXT,
        "skipped": TEXT,
        "system-out": (set(), set(), set()),
    }

    def test_structure(self):
        files = sorted(FOLDER.glob("*.xml"))
        self.assertGreaterEqual(len(files), 5)
        for file in files:
            for element in ET.parse(file).iter():
                with self.subTest(f"{file.name}: {element.tag}"):
                    required, optional, children = self.STRUCTURE[element.tag]
                    self.assertLessEqual(required, set(element.keys()))
                    self.assertLessEqual(set(element.keys()), required | optional)
                    self.assertLessEqual({child.tag for child in element}, children)
                    for name in {"tests", "failures", "errors", "skipped"} & set(element.keys()):
                        self.assertRegex(element.get(name), r"\A[0-9]+\Z")
                    if "time" in element.keys():
                        self.assertRegex(element.get("time"), r"\A[0-9]+(\.[0-9]+)?\Z")

    def read(self, name):
        root = ET.parse(FOLDER / f"{name}.xml").getroot()
        self.assertEqual(root.tag, "testsuites")
        (suite,) = root
        self.assertEqual(suite.tag, "testsuite")
        cases = suite.findall("testcase")
        self.assertEqual(int(suite.get("tests")), len(cases))
        for attribute, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            self.assertEqual(int(suite.get(attribute)), len(suite.findall(f"testcase/{tag}")), tag)
        for case in cases:
            self.assertTrue(case.get("classname") and case.get("name"))
            self.assertGreaterEqual(float(case.get("time")), 0)
            self.assertLessEqual(sum(child.tag in ("failure", "error", "skipped") for child in case), 1)
        return suite, {(case.get("classname"), case.get("name")): case for case in cases}

    def test_every_verdict(self):
        suite, cases = self.read("osmesa")
        self.assertEqual(len(cases), 12)  # 11 tests and the interrupted run
        self.assertEqual(suite.get("name"), "osmesa")
        expected = {
            ("evalcts", "the run"): ("error", "interrupted"),
            ("Map1Values", "Bezier/TEXTURE_COORD_1/f"): None,
            ("Map1Values", "Bezier/TEXTURE_COORD_1/d"): ("failure", "fail"),
            ("Map1Errors", "StrideBelowK/MAP1_VERTEX_3"): ("skipped", "fail"),
            ("Map2Output", "FillOrder"): ("error", "crash"),
            ("Map2Output", "HugeGrid"): ("error", "timeout"),
            ("Map2Values", "Rational"): ("error", "internal-error"),
            ("MeshQuality", "EvalPointBits"): None,
            ("ColorIndex", "Map1Index"): ("skipped", "not-supported"),
            ("AutoNormal", "EdgeFlags"): ("skipped", "not-observable"),
            ("AutoNormal", "Reversed"): ("skipped", "skipped"),
            ("AutoNormal", "InitiallyOff"): None,
        }
        for (theme, name), outcome in expected.items():
            with self.subTest(name):
                case = cases[f"osmesa.{theme}", name]
                found = [(child.tag, child.get("type")) for child in case if child.tag != "system-out"]
                self.assertEqual(found, [outcome] if outcome else [])

    def test_what_is_told(self):
        _, cases = self.read("osmesa")
        failure = cases["osmesa.Map1Values", "Bezier/TEXTURE_COORD_1/d"].find("failure")
        self.assertEqual(failure.get("message"), "2 of 12 values lie outside the acceptance interval")
        self.assertIn("expected: [0.25, 0.2501] exact 0.25005", failure.text)
        self.assertIn("distance: 1,676,000 ULP, condition-aware 838,000", failure.text)
        baseline = cases["osmesa.Map1Errors", "StrideBelowK/MAP1_VERTEX_3"]
        self.assertIn("Mesa checks the stride after the pointer", baseline.find("skipped").get("message"))
        self.assertIn("captured: GL_NO_ERROR", baseline.find("system-out").text)
        warning = cases["osmesa.MeshQuality", "EvalPointBits"].find("system-out")
        self.assertIn("EvalPoint1 and EvalMesh1 differ in the last bit", warning.text)
        unexpected_pass = cases["osmesa.AutoNormal", "InitiallyOff"].find("system-out")
        self.assertIn("the pages say TRUE", unexpected_pass.text)

    def test_properties(self):
        suite, _ = self.read("osmesa")
        properties = {item.get("name"): item.get("value") for item in suite.findall("properties/property")}
        self.assertEqual(properties["gl.renderer"], "llvmpipe (LLVM 15.0.6, 256 bits)")
        self.assertEqual(properties["evalcts.status"], "interrupted")

    def test_a_run_that_never_started(self):
        suite, cases = self.read("glx")
        (case,) = cases.values()
        self.assertEqual(case.find("skipped").get("message"), "no X server: DISPLAY is not set")

    def test_complete_run(self):
        suite, cases = self.read("reference")
        self.assertEqual(len(cases), 3)
        self.assertEqual((suite.get("failures"), suite.get("errors"), suite.get("skipped")), ("0", "0", "0"))

    def test_empty_record_is_not_green(self):
        suite, _ = self.read("empty")
        self.assertEqual(suite.get("errors"), "1")

    def test_hostile_text_is_only_text(self):
        _, cases = self.read("hostile")
        case = next(case for (_, name), case in cases.items() if case.find("failure") is not None)
        for text in (case.get("name"), case.find("failure").get("message"), case.find("failure").text):
            self.assertIn(HOSTILE, text)
            self.assertIn(HOSTILE_END, text)


if __name__ == "__main__":
    unittest.main(verbosity=1)
