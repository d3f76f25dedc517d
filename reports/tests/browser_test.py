"""Tests the pages in a real browser: browser_test.py WRITE_PAGES [--screenshots FOLDER]

WRITE_PAGES is the built program evalcts_reports_write_pages. Needs Chromium, its driver and Selenium, as the
distribution packages them. With --screenshots it also writes pictures into FOLDER.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time
import unittest
import urllib.parse

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.select import Select

BROWSER, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
DESKTOP, PHONE = (1400, 900), (390, 740)
PATIENCE = 20
LOAD_SECONDS = 90  # enough on a busy machine
ALL = "#on=osmesa&on=reference&on=glx"  # shows the columns of three.html without failures, too
VERDICTS = ("pass", "pass", "pass", "fail", "quality-warning", "not-observable", "crash", "pass")

# Text that would run a script, load a file or end an element if a part of the page did not escape it.
HOSTILE = (
    "\"><img src=x onerror=\"document.title='owned'\"><script>document.title='owned'</script>"
    "</style></script><svg onload=\"document.title='owned'\"> ' onclick=document.title='owned' "
    "javascript:document.title='owned' {{{style}}} https://example.org/"
)

driver = None
pages = None


def setUpModule():
    global driver
    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for argument in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "disable-gpu", "hide-scrollbars",
                     "disable-background-networking", "disable-component-update", "no-first-run",
                     "window-size=%d,%d" % DESKTOP):
        options.add_argument("--" + argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(DRIVER), options=options)
    driver.set_page_load_timeout(LOAD_SECONDS)
    driver.set_script_timeout(LOAD_SECONDS)


def tearDownModule():
    driver.quit()


def record(name, tests, **more):
    return {"format": "evalcts-results-1", "status": "complete", "depth": "full", "seed": 1,
            "implementation": {"name": name, "renderer": "renderer of " + name}, "tests": tests, **more}


def large_records(tests, implementations):
    """Returns records of that many tests and implementations, with every kind of verdict and evidence of failures."""
    records = []
    for column in range(implementations):
        results = []
        for number in range(tests):
            verdict = VERDICTS[(number // 7 + column * (number % 3)) % len(VERDICTS)]
            test = {"name": f"Theme{number % 40}.Rule{number // 40}/MAP1_VERTEX_3",
                    "requirements": [f"EV-{number % 300}"], "level": "must" if number % 5 else "quality",
                    "verdict": verdict, "cases": 12, "failed_cases": 0, "seed": 1, "seconds": 0.01, "message": ""}
            if verdict in ("fail", "crash"):
                calls = [f"glMap1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, {k}, points{number});" for k in range(12)]
                test.update(message=f"2 of 12 cases, {number}", failed_cases=2, rerun=f"./evalcts run {number}",
                            failures=[{"case": f"order={k}", "what": "position.x", "expected": "[0, 1]",
                                       "captured": "2", "ulp": 1e6, "calls": calls} for k in range(3)])
            results.append(test)
        records.append(record(f"implementation-{column}", results))
    return records


def write_page(write_pages, name, records):
    folder = pages / name
    folder.mkdir()
    files = []
    for number, one in enumerate(records):
        files.append(folder / f"{number}.json")
        files[-1].write_text(json.dumps(one))
    subprocess.run([write_pages, folder, "-", *files], check=True, stdout=subprocess.DEVNULL)
    return folder / "index.html"


class Browser(unittest.TestCase):
    def open(self, page, size=DESKTOP, features=(), media="", state=""):
        driver.get("about:blank")
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                               {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": size == PHONE})
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "media": media, "features": [{"name": name, "value": value} for name, value in features]})
        driver.get_log("browser"), driver.get_log("performance")
        driver.get(((pages / page) if isinstance(page, str) else page).as_uri() + state)

    def js(self, code, *arguments):
        return driver.execute_script(code, *arguments)

    def texts(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])].filter((e) => e.checkVisibility())"
                       ".map((e) => e.textContent)", selector)

    # Opens all groups, tests, requirements, bugs and folds.
    OPEN_ALL = """
      for (let more = true; more;) {
        const closed = [...document.querySelectorAll('.toggle[aria-expanded=false]')];
        more = closed.length > 0;
        for (const button of closed) button.click();
      }
      for (let more = true; more;) {
        const closed = [...document.querySelectorAll('details:not([open])')];
        more = closed.length > 0;
        for (const fold of closed) { fold.open = true; fold.dispatchEvent(new Event('toggle')); }
      }"""

    def open_all(self):
        self.js(self.OPEN_ALL)

    def eventually(self, expected, look):
        """Expects look() to return `expected` within PATIENCE seconds, because the browser reacts to a click later."""
        deadline = time.monotonic() + PATIENCE
        while look() != expected and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(look(), expected)

    def choose(self, field, value):
        Select(driver.find_element(By.ID, field)).select_by_value(value)

    def active(self, what="textContent"):
        return self.js(f"return document.activeElement.{what}")

    def fragment(self):
        return urllib.parse.parse_qs(urllib.parse.urlsplit(driver.current_url).fragment)

    def toggle(self, text, within="main"):
        """Returns the button that unfolds the row of this name."""
        return self.js("return [...document.querySelectorAll(`${arguments[1]} .toggle`)]"
                       ".find((e) => e.textContent === arguments[0])", text, within)

    def press_toggle(self, text, within="main"):
        self.js("arguments[0].click()", self.toggle(text, within))


class Pages(Browser):
    EVERY = ("one.html", "three.html", "none.html", "compared.html", "hostile.html", "hostile-compared.html")

    def test_nothing_is_fetched_and_nothing_complains(self):
        for page in self.EVERY:
            with self.subTest(page):
                self.open(page)
                self.open_all()
                if page != "none.html":
                    self.js("document.querySelector('#views button[value=requirements]').click()")
                    self.open_all()
                self.assertEqual(driver.get_log("browser"), [])
                messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
                urls = {message["params"]["request"]["url"] for message in messages
                        if message["method"] == "Network.requestWillBeSent"}
                self.assertLessEqual({url.split("#")[0] for url in urls}, {(pages / page).as_uri(), "data:,"})
                self.assertEqual(self.js("return performance.getEntriesByType('resource').length"), 0)
                policy = self.js("return document.querySelector('meta[http-equiv=Content-Security-Policy]').content")
                self.assertTrue(policy.startswith("default-src 'none';"))

    def test_every_link_leads_somewhere(self):
        for page in ("one.html", "three.html", "compared.html"):
            with self.subTest(page):
                self.open(page)
                self.open_all()
                links = set(self.js("return [...document.querySelectorAll('main a')].map((a) => a.getAttribute('href'))"))
                self.assertGreater(len(links), 10)
                for link in links:
                    if link.startswith("https://registry.khronos.org/OpenGL"):
                        continue
                    self.js("location.hash = arguments[0]", link)
                    kind, _, name = self.fragment().get("at", ["="])[0].partition("=")
                    if kind:
                        self.eventually(f"{kind}={name}", lambda: self.active("dataset.key"))
                        self.assertEqual(self.active("getAttribute('aria-expanded')"), "true")
                    else:
                        self.eventually(False, lambda: self.texts("#table").count("No test matches the filters.") > 0)

    def test_names_for_screen_readers(self):
        asked = {"link", "button", "combobox", "searchbox", "checkbox", "DisclosureTriangle", "region", "search",
                 "table", "heading"}
        for page in self.EVERY:
            with self.subTest(page):
                self.open(page)
                self.open_all()
                nodes = driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
                seen, level = set(), 0
                for node in nodes:
                    role = node.get("role", {}).get("value")
                    if node["ignored"] or role not in asked | {"main", "banner", "navigation"}:
                        continue
                    seen.add(role)
                    if role not in ("table", "main", "banner"):  # the region of a table has the name
                        self.assertTrue(node.get("name", {}).get("value", "").strip(), node)
                    if role == "heading":
                        now = next(p["value"]["value"] for p in node["properties"] if p["name"] == "level")
                        self.assertLessEqual(now, level + 1, node)
                        level = now
                self.assertLessEqual({"heading", "main", "banner", "navigation"}, seen)
                nameless = self.js("return [...document.querySelectorAll('[tabindex=\"0\"]')]"
                                   ".filter((e) => !e.getAttribute('aria-label')).map((e) => e.outerHTML)")
                self.assertEqual(nameless, [])
                if page != "none.html":
                    self.assertLessEqual(asked, seen)

    def test_rows_are_cards_on_a_phone(self):
        self.open("compared.html", PHONE, state="#on=osmesa&on=reference&group=Map1Values")
        for selector in ("#bug-table", "#table"):
            names = self.js("return [...document.querySelectorAll(`${arguments[0]} tbody th`)].map((e) => e.clientWidth)", selector)
            self.assertGreater(min(names), 300)
        self.assertEqual(self.js("return [...document.querySelectorAll('#table .test')[0].children].slice(1)"
                                 ".map((e) => getComputedStyle(e, '::before').content)"),
                         ['"osmesa: "', '"reference: "'])
        self.assertEqual(self.texts("#table thead th"), [])

    def test_no_sideways_scrolling_on_a_phone(self):
        for page in self.EVERY:
            with self.subTest(page):
                self.open(page, PHONE)
                for _ in range(2):
                    self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), PHONE[0])
                    self.open_all()

    def test_figures_are_not_cut_on_a_phone(self):
        self.open("three.html", PHONE)
        self.open_all()
        cut = self.js("""
          const out = [];
          for (const e of document.querySelectorAll('.overview td, .detail dd, .detail p, .detail h3')) {
            const box = e.getBoundingClientRect();
            if (e.checkVisibility() && box.width && (box.left < 0 || box.right > innerWidth || e.scrollWidth > e.clientWidth + 1))
              out.push(e.outerHTML.slice(0, 200));
          }
          return out;""")
        self.assertEqual(cut, [])

    def test_every_column_is_in_view_on_a_desktop(self):
        self.open(write_page(arguments.write_pages, "eight", large_records(40, 8)))
        self.assertEqual(self.js("return [...document.querySelectorAll('#table thead th')]"
                                 ".filter((e) => e.getBoundingClientRect().right > innerWidth).length"), 0)
        self.assertEqual(len(self.texts("#table thead th")), 9)
        self.js("document.querySelectorAll('.column-switch').forEach((e, i) => { if (i !== 6) e.click(); })")
        self.eventually(["Theme", "implementation-6"], lambda: self.texts("#table thead th"))

    # Returns the least contrast after WCAG 2, the ratio of the relative luminances of text and background, and its place.
    CONTRAST = """
      const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
      const luminance = (colour) => numbers(colour).slice(0, 3)
        .map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
      const opaque = (colour) => numbers(colour).length < 4 || numbers(colour)[3] === 1;
      const back = (e) => (opaque(getComputedStyle(e).backgroundColor) ? getComputedStyle(e).backgroundColor
        : e.parentElement ? back(e.parentElement) : 'rgb(255, 255, 255)');
      let least = [100, ''];
      for (const e of document.querySelectorAll('main *, header *')) {
        if (![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim()) || !e.checkVisibility()) continue;
        const pair = [luminance(getComputedStyle(e).color), luminance(back(e))].sort((a, b) => b - a);
        const ratio = (pair[0] + 0.05) / (pair[1] + 0.05);
        if (ratio < least[0]) least = [ratio, e.outerHTML.slice(0, 200)];
      }
      return least;"""

    def test_text_can_be_read_in_light_and_in_dark(self):
        for scheme in ("light", "dark"):
            for page in ("three.html", "compared.html"):
                with self.subTest(f"{page}, {scheme}"):
                    self.open(page, features=[("prefers-color-scheme", scheme)])
                    self.open_all()
                    colour = self.js("return getComputedStyle(document.body).backgroundColor")
                    brightness = sum(int(part) for part in colour[4:-1].split(","))
                    self.assertEqual(brightness > 3 * 128, scheme == "light", colour)
                    ratio, where = self.js(self.CONTRAST)
                    self.assertGreaterEqual(ratio, 4.5, where)

    def test_verdicts_are_words_and_known_failures_are_not_green(self):
        self.open("three.html", state=ALL)
        self.open_all()
        cells = self.js("return [...document.querySelectorAll('#table .test td')].map((td) => [td.className, td.textContent])")
        self.assertGreater(len(cells), 20)
        words = {"bad": ("fail", "crash", "timeout", "internal-error", "pass unexpected"), "known": ("fail known",),
                 "notice": ("quality-warning",), "good": ("pass",), "none": ("not observed", "not-supported", "skipped"),
                 "absent": ("no test",)}
        for state, text in cells:
            self.assertTrue(any(text.endswith(word) for word in words[state]), (state, text))
        self.assertLessEqual({"bad", "known", "good"}, {state for state, _ in cells})

    def test_printed(self):
        self.open("three.html", media="print", features=[("prefers-color-scheme", "dark")])
        self.assertEqual(self.js("return getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)")
        self.assertEqual(self.js("return getComputedStyle(document.body).color"), "rgb(0, 0, 0)")
        self.assertFalse(driver.find_element(By.ID, "filters").is_displayed())
        opened = "return [...document.querySelectorAll('tr.detail')].length"
        self.js("dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.js(opened), 4 + 5)  # 4 bugs and 5 unexpected results
        self.js("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.js(opened), 0)
        self.assertGreater(len(driver.execute_cdp_cmd("Page.printToPDF", {})["data"]), 10000)

    def test_without_scripts(self):
        driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        try:
            self.open("three.html")
            self.assertFalse(driver.find_element(By.ID, "filters").is_displayed())
            text = driver.find_element(By.TAG_NAME, "main").text
            for words in ("1 internal error; 3 new failures; 1 known; 1 unexpected pass", "EvalMesh2 behind CallList crashes",
                          "glEvalMesh2(GL_FILL, 0, 1, 0, 1);", "The tests, the requirements and the filters need scripts"):
                self.assertIn(words, text)
        finally:
            driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


class Bugs(Browser):
    def test_come_first(self):
        self.open("three.html")
        order = self.js("return ['bugs', 'table', 'runs'].map((id) => document.getElementById(id).getBoundingClientRect().top)")
        self.assertEqual(order, sorted(order))
        self.assertEqual(self.texts("#bug-table .toggle"), [
            "EvalMesh2 behind CallList crashes", "Map2Output.HugeGrid does not end",
            "EvalCoord with a map of texture coordinates: texture coordinate s of the vertex is wrong",
            "Map1 with a stride below the number of values of a point raises no error"])
        cells = self.js("return [...document.querySelectorAll('#bug-table tbody td')].map((td) => [td.className, td.textContent])")
        self.assertEqual(cells, 3 * [["bad", "1 test new"]] + [["known", "1 test known"]])
        self.assertEqual(self.texts("#bug-table > p")[0], "No bug was found in: reference. Not searched: glx.")

    def test_evidence_and_way_to_the_tests(self):
        self.open("three.html")
        self.press_toggle("EvalCoord with a map of texture coordinates: texture coordinate s of the vertex is wrong")
        text = driver.find_element(By.CSS_SELECTOR, "#bug-table .detail").text
        for words in ("EV-MAP1-BEZIER", "GL 1.0 §5.1; glMap1 page (OpenGL 1.0, the reference page of glMap1)",
                      "glEvalCoord1d(0x1p-1 /* 0.5 */);", "Copy reproducer", "1 test of osmesa"):
            self.assertIn(words, text)
        self.js("document.querySelector('#bug-table .detail details').open = true")
        self.eventually(1, lambda: len(self.texts("#bug-table .detail li a")))
        driver.find_element(By.CSS_SELECTOR, "#bug-table .detail li a").click()
        self.eventually("Map1Values.Bezier/TEXTURE_COORD_1/d", self.active)
        back = "#table .detail a[href*='at=bug']"
        self.assertIn("EvalCoord with a map", driver.find_element(By.CSS_SELECTOR, back).text)
        reduced = driver.find_element(By.CSS_SELECTOR, "#table .detail details.case").text
        for words in ("Reduced case", "glEvalCoord1d(0x1p-1 /* 0.5 */);", "Copy reduced case"):
            self.assertIn(words, reduced)

    # Columns without failures are folded until they are asked for.
    def test_columns_without_failures_are_folded(self):
        self.open("three.html")
        self.assertEqual(self.texts("#table thead th"), ["Theme", "osmesa"])
        self.assertIn("Nothing failed in: reference. Not judged: glx.", self.texts("#table > p")[0])
        driver.find_element(By.CSS_SELECTOR, "#table > p button").click()
        self.assertEqual(self.texts("#table thead th"), ["Theme", "osmesa", "reference", "glx"])
        self.assertEqual(self.fragment(), {"on": ["osmesa", "reference", "glx"]})
        self.open("three.html", state="#on=reference")
        self.assertEqual(self.texts("#table thead th"), ["Theme", "reference"])

    def test_details(self):
        known = {"id": "EV-X-1", "title": "a bug", "clause": "GL 2.1 5.1", "requirements": ["EV-COORD-MIX"], "tests": ["A.b"],
                 "known": "mesa-mesh-steps", "known_in": "Mesa", "why_not_reduced": "no time"}
        test = {"name": "A.b", "verdict": "fail", "requirements": ["EV-1"], "source": "suites/maps.cpp:7",
                "expected_by_baseline": True}
        self.open(write_page(arguments.write_pages, "details", [record("x", [test], bugs=[known])]), state="#bug=EV-X-1")
        terms = self.texts("#bug-table dt")
        self.assertEqual(terms[:5], ["Known bug", "Affected", "Cause", "Real programs", "Clause"])
        self.assertEqual(self.js("return document.querySelector('#bug-table dd a').href"),
                         "https://registry.khronos.org/OpenGL/specs/gl/glspec21.pdf")
        self.assertEqual(self.texts("#bug-table .rule"), ["EV-COORD-MIX Not in the catalogue"])
        self.assertEqual(self.js("return document.querySelectorAll('#bug-table .rule a').length"), 0)  # no test has it
        self.press_toggle("A.b")
        self.assertIn("Source: suites/maps.cpp:7", self.texts("#table .detail .tools")[0])
        self.open("details/index.html", state="#at=requirement%3DEV-COORD-MIX")  # nothing to show
        self.assertEqual(self.texts("#table .toggle"), ["A", "A.b"])
        self.assertEqual(driver.get_log("browser"), [])


class Filters(Browser):
    def setUp(self):
        self.open("three.html", state=ALL)
        self.everything = self.shown()
        self.assertEqual(len(self.everything), 11)

    def shown(self):
        """Returns the names of the tests that are shown; few are shown at once."""
        return set(self.texts("#table .test .toggle"))

    def count(self):
        return driver.find_element(By.ID, "filter-count").text

    def test_each(self):
        self.choose("filter-theme", "Map2Output")
        self.assertEqual(self.shown(), {"Map2Output.FillOrder", "Map2Output.HugeGrid"})
        self.choose("filter-theme", "")
        self.assertEqual(self.shown(), self.everything)
        self.choose("filter-verdict", "timeout")
        self.assertEqual(self.shown(), {"Map2Output.HugeGrid"})
        self.choose("filter-verdict", "")
        driver.find_element(By.ID, "filter-new").click()
        self.assertEqual(len(self.shown()), 5)
        driver.find_element(By.ID, "filter-new").click()
        self.choose("filter-verdict", "known")
        self.assertEqual(self.shown(), {"Map1Errors.StrideBelowK/MAP1_VERTEX_3"})
        self.choose("filter-verdict", "")
        self.choose("filter-level", "quality")
        self.assertEqual(self.shown(), {"MeshQuality.EvalPointBits"})
        self.assertEqual(self.count(), "0 of 4 bugs, 1 of 11 tests, 1 of 10 requirements shown")

    def test_text_finds_names_calls_and_requirements(self):
        field = driver.find_element(By.ID, "filter-q")
        for typed, found in (("hugegrid", {"Map2Output.HugeGrid"}), ("glEvalCoord1f(0x1.8p+0f)", {"Map1Values.Bezier/TEXTURE_COORD_1/d"}),
                             ("ev-mesh2-fill  FillOrder", {"Map2Output.FillOrder"}),
                             ("mapped affinely", {"Map1Values.Bezier/TEXTURE_COORD_1/d", "Map1Values.Bezier/TEXTURE_COORD_1/f"}),
                             ("no such text", set())):
            field.clear()
            field.send_keys(typed)
            self.assertEqual(self.shown(), found, typed)
        self.assertEqual(self.texts("#table"), ["No test matches the filters."])
        self.assertEqual(self.texts("#bug-table"), ["No bug matches the filters."])

    def test_act_on_bugs(self):
        bugs = lambda: [text.split()[0] for text in self.texts("#bug-table .toggle")]
        self.assertEqual(bugs(), ["EvalMesh2", "Map2Output.HugeGrid", "EvalCoord", "Map1"])
        self.choose("filter-theme", "Map2Output")
        self.assertEqual(bugs(), ["EvalMesh2", "Map2Output.HugeGrid"])
        self.choose("filter-verdict", "crash")
        self.assertEqual(bugs(), ["EvalMesh2"])
        driver.find_element(By.CSS_SELECTOR, "#filters button[type=reset]").click()
        driver.find_element(By.ID, "filter-new").click()
        self.assertEqual(bugs(), ["EvalMesh2", "Map2Output.HugeGrid", "EvalCoord"])
        self.assertEqual(self.fragment()["new"], ["1"])
        self.js("location.hash = '#at=bug%3DEV-MAP1-ERR-STRIDE-e301&new=1'")  # a link leads to what the filter hides
        self.eventually("Map1 with a stride below the number of values of a point raises no error", self.active)
        field = driver.find_element(By.ID, "filter-q")
        field.send_keys("behind callLIST")  # the title of the bug
        self.assertEqual(bugs(), ["EvalMesh2"])
        self.choose("filter-theme", "Map1Errors")
        self.assertEqual(bugs(), [])

    def test_combined_and_reset(self):
        self.choose("filter-verdict", "pass")
        self.choose("filter-theme", "Map1Values")
        self.assertEqual(len(self.shown()), 2)  # reference passes both
        self.js("document.querySelectorAll('.column-switch')[1].click()")
        self.assertEqual(self.shown(), {"Map1Values.Bezier/TEXTURE_COORD_1/f"})
        driver.find_element(By.CSS_SELECTOR, "#filters button[type=reset]").click()
        self.assertEqual(self.shown(), self.everything)
        self.js("document.querySelectorAll('.column-switch')[1].click()")
        driver.find_element(By.ID, "filter-differs").click()
        self.assertEqual(self.shown(), {"Map1Values.Bezier/TEXTURE_COORD_1/d", "Map1Errors.StrideBelowK/MAP1_VERTEX_3"})

    def test_requirements(self):
        driver.find_element(By.CSS_SELECTOR, "#views button[value=requirements]").click()
        rows = set(self.texts("#table .requirement .toggle"))
        self.assertEqual(len(rows), 10)
        self.press_toggle("EV-MESH2-FILL")
        self.assertEqual(set(self.texts("#table .detail li > a")), {"Map2Output.FillOrder", "Map2Output.HugeGrid"})
        cells = self.js("return [...arguments[0].closest('tr').children].map((e) => e.className + ': ' + e.textContent)",
                        self.toggle("EV-MESH2-FILL"))
        self.assertEqual(cells[1:3], ["bad: ‼ crash 1 of 2", "absent: no test"])
        self.choose("filter-theme", "Map1Errors")
        self.assertLess(len(self.texts("#table .requirement .toggle")), 10)


class Violations(Browser):
    def test_a_failure_for_another_requirement_decides_nothing(self):
        fail = {"name": "A.a", "verdict": "fail", "requirements": ["EV-1", "EV-2"], "violated": ["EV-2", "EV-3"]}
        good = {"name": "A.b", "verdict": "pass", "requirements": ["EV-1"]}
        self.open(write_page(arguments.write_pages, "violated", [record("x", [fail]), record("y", [fail, good])]),
                  state="#view=requirements")
        cells = {name: self.js("return [...arguments[0].closest('tr').children].slice(1).map((e) => e.textContent)", self.toggle(name))
                 for name in ("EV-1", "EV-2", "EV-3")}
        self.assertEqual(cells, {"EV-1": ["not observed other failures hide it", "✓ pass 1 of 2"], "EV-2": ["✗ fail", "✗ fail"],
                                 "EV-3": ["✗ fail", "✗ fail"]})
        self.open("violated/index.html", state="#open=A.a")
        text = driver.find_element(By.CSS_SELECTOR, "#table .detail").text
        self.assertIn("Violated: EV-2, EV-3", text)
        self.assertIn("Not observed because of this failure: EV-1", text)


class Address(Browser):
    """The address contains the state, and the browser's history goes through states."""

    def shown(self):
        return set(self.texts("#table .test .toggle"))

    def test_holds_filters_open_rows_and_implementations(self):
        self.open("three.html")
        driver.find_element(By.ID, "filter-new").click()
        self.js("document.querySelectorAll('.column-switch')[1].click()")
        self.press_toggle("Map2Output.FillOrder")
        self.press_toggle("EvalMesh2 behind CallList crashes")
        self.assertEqual(self.fragment(), {"new": ["1"], "on": ["osmesa", "reference"],
                                           "open": ["Map2Output.FillOrder"], "bug": ["EV-MESH2-FILL-1a2b"]})
        view = lambda: (self.js("return document.getElementById('table').innerHTML"),
                        self.js("return document.getElementById('bug-table').innerHTML"))
        expected, address = view(), driver.current_url
        self.open("one.html")
        driver.get(address)
        self.assertEqual(view(), expected)

    def test_back_and_forward(self):
        self.open("three.html")
        start = self.shown()
        self.choose("filter-theme", "Map2Output")
        self.press_toggle("Map2Output.FillOrder")
        field = driver.find_element(By.ID, "filter-q")
        field.send_keys("huge")
        self.eventually(["huge"], lambda: self.fragment().get("q"))
        field.send_keys("grid")
        self.eventually(["hugegrid"], lambda: self.fragment().get("q"))
        driver.back()  # undoes the whole text, not only its last part
        self.eventually({"Map2Output.FillOrder", "Map2Output.HugeGrid"}, self.shown)
        self.assertEqual(len(self.texts("#table .detail")), 1)
        self.assertEqual(field.get_attribute("value"), "")
        driver.back()
        self.eventually(0, lambda: len(self.texts("#table .detail")))
        driver.back()
        self.eventually(start, self.shown)
        driver.forward()
        self.eventually({"Map2Output.FillOrder", "Map2Output.HugeGrid"}, self.shown)

    def test_a_link_leads_to_what_is_hidden(self):
        self.open("three.html", state="#theme=ColorIndex&on=reference&at=open%3DAutoNormal.EdgeFlags")
        self.eventually("AutoNormal.EdgeFlags", self.active)
        self.assertEqual(self.active("getAttribute('aria-expanded')"), "true")
        driver.find_element(By.CSS_SELECTOR, "#table .detail .rule a").click()
        self.eventually("requirement", lambda: self.js("return document.activeElement.closest('tr').className"))

    # The address of a page with an open item, too, although it names no target.
    def test_links_scroll(self):
        top = "return document.activeElement.getBoundingClientRect().top"
        page = write_page(arguments.write_pages, "scroll", large_records(4000, 2))
        for size in (DESKTOP, PHONE):
            for state in ("#at=open%3DTheme39.Rule3%2FMAP1_VERTEX_3", "#open=Theme39.Rule3%2FMAP1_VERTEX_3",
                          "#view=requirements&requirement=EV-299"):
                with self.subTest(f"{size} {state}"):
                    self.open(page, size, state=state)
                    self.eventually("toggle", lambda: self.active("className"))
                    self.assertGreater(self.js("return scrollY"), size[1])
                    self.assertTrue(0 <= self.js(top) < size[1] / 2)
        self.open("three.html", PHONE, state="#bug=EV-MAP1-BEZIER-09d4")
        self.assertTrue(0 <= self.js(top) < PHONE[1] / 2)

    def test_copied_link_and_reproducer(self):
        self.open("three.html")
        driver.execute_cdp_cmd("Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
        self.press_toggle("Map1Values.Bezier/TEXTURE_COORD_1/d")
        buttons = {button.text: button for button in driver.find_elements(By.CSS_SELECTOR, "#table .detail button")}
        read = "const done = arguments[0]; navigator.clipboard.readText().then(done, (e) => done(String(e)));"
        for label, expected in (("Copy reproducer", "./evalcts reproduce osmesa:Map1Values.Bezier/TEXTURE_COORD_1/d"),
                                ("Copy link", "at=open%3DMap1Values.Bezier%2FTEXTURE_COORD_1%2Fd"),
                                ("Copy calls", "glEvalCoord1f(0x1.8p+0f);")):
            self.js("arguments[0].scrollIntoView({block: 'center'})", buttons[label])
            buttons[label].click()
            self.eventually(True, lambda: expected in driver.execute_async_script(read))

    # One captured vertex is out of place, one is not finite.
    def test_picture_of_the_vertices(self):
        self.open("three.html")
        self.press_toggle("Map1Values.Bezier/TEXTURE_COORD_1/d")
        self.assertEqual(self.texts(".plot figcaption"),
                         ["Expected: 1 LINE_STRIP, 3 vertices", "Captured: 1 LINE_STRIP, 4 vertices, 1 not finite"])
        shapes = "return [...document.querySelectorAll('.plot svg')].map((svg) => svg.querySelectorAll(arguments[0]).length)"
        self.assertEqual(self.js(shapes, "circle"), [3, 3])
        self.assertEqual(self.js(shapes, "circle.wrong"), [0, 1])
        self.assertEqual(self.js(shapes, "line"), [2, 1])
        self.assertIn("Captured vertices where none is expected are filled. The first vertices only.", self.texts("p.faint"))
        self.assertEqual(driver.get_log("browser"), [])

    # The sample has five pixels: two differ visibly, one by 2 of 255. The image ends one pixel beyond the outermost ones.
    def test_picture_of_pixels(self):
        self.open("three.html")
        self.press_toggle("Map1Values.Bezier/TEXTURE_COORD_1/d")
        self.js("[...document.querySelectorAll('#table .detail .case')].filter((fold) => !fold.open).forEach((fold) => fold.firstChild.click())")
        self.eventually(["Expected: 5 pixels", "Captured: 5 pixels", "Different: 2 of 5 pixels"],
                        lambda: self.texts(".plot canvas + figcaption"))
        self.assertEqual(self.js("const canvas = document.querySelector('.plot canvas'); return [canvas.width, canvas.height]"), [7, 4])
        self.assertEqual(driver.get_log("browser"), [])  # before the readbacks below, which Chromium complains of
        at = "return [...document.querySelectorAll('.plot canvas')].map((canvas) => " \
             "[...canvas.getContext('2d').getImageData(arguments[0], arguments[1], 1, 1).data].slice(0, 4).join(' '))"
        self.assertEqual(self.js(at, 2, 1), ["255 0 0 255", "0 255 0 255", "204 34 34 255"])  # the upper row of the square
        self.assertEqual(self.js(at, 1, 2), ["0 0 0 255", "0 0 0 255", "0 0 0 0"])
        self.assertEqual(self.js(at, 4, 2), ["0 0 0 0"] * 3)  # between the areas

    def test_addresses_that_are_none(self):
        self.open("three.html")
        everything = self.shown()
        for state in ("#at=open%3Dnothing", "#%", "#%E0%A4%A", "#filters", "#", "#verdict=constructor&on=x&level=1&view=y&from=z",
                      "#at=bug%3D__proto__&open=__proto__&theme=toString"):
            driver.get("about:blank")
            driver.get((pages / "three.html").as_uri() + state)
            self.assertEqual(self.shown(), everything, state)
            self.assertEqual(driver.get_log("browser"), [])


class Changes(Browser):
    def test_since_earlier_results(self):
        self.open("compared.html")
        self.assertIn("1 regression, 1 new failing test, 1 fix, 1 vanished test", self.texts("#change-list")[0])
        lines = self.texts("#change-list li")
        self.assertTrue(lines[0].startswith("Map1Values.Bezier/TEXTURE_COORD_1/d ✓ pass → ✗ fail"), lines)
        self.assertTrue(any(line.startswith("Map1Values.Bezier/TEXTURE_COORD_1/f ✗ fail → ✓ pass") for line in lines), lines)

    def test_between_two_implementations(self):
        self.open("three.html")
        self.choose("from", "0")
        self.choose("to", "1")
        self.eventually(2, lambda: len([t for t in self.texts("#change-list li") if "→" in t]))
        self.assertEqual(self.fragment(), {"from": ["osmesa"], "to": ["reference"]})
        self.assertNotIn("regression", " ".join(self.texts("#change-list")))
        self.assertIn("better test", self.texts("#change-list")[0])
        driver.find_element(By.CSS_SELECTOR, "#change-list li a").click()
        self.eventually("true", lambda: self.active("getAttribute('aria-expanded')"))
        self.assertEqual(self.fragment()["from"], ["osmesa"])


class Keyboard(Browser):
    def press(self, *keys):
        for key in keys:
            driver.switch_to.active_element.send_keys(key)

    def test_all_of_it(self):
        self.open("three.html")
        self.press(Keys.TAB)
        self.assertEqual(self.active(), "Skip to the tests")
        self.assertGreaterEqual(self.js("return document.activeElement.getBoundingClientRect().left"), 0)
        self.press(Keys.ENTER)
        self.assertEqual(self.active(), "Tests and requirements")
        reached = []
        while "Theme" not in self.js("return document.activeElement.closest('.scroll')?.textContent || ''"):
            self.press(Keys.TAB)
            reached.append(self.active("id") or self.active())
        self.assertEqual(reached[:-1], ["Themes", "Requirements", "Show them"])
        self.press(Keys.TAB)
        group = self.active()
        self.assertEqual(self.active("className"), "toggle")
        self.assertNotEqual(self.js("return getComputedStyle(document.activeElement).outlineStyle"), "none")
        self.press(Keys.ENTER)
        self.assertEqual((self.active(), self.active("getAttribute('aria-expanded')")), (group, "false"))
        self.press(Keys.SPACE)
        self.assertEqual((self.active(), self.active("getAttribute('aria-expanded')")), (group, "true"))
        self.press(Keys.TAB, Keys.ENTER)
        self.assertEqual(self.active("getAttribute('aria-expanded')"), "true")
        self.press(Keys.TAB)
        self.assertEqual(self.active(), "Copy link")

    def test_filters(self):
        self.open("three.html")
        self.js("document.getElementById('filter-q').focus()")
        reached = []
        while self.active() != "Copy link":
            self.press(Keys.TAB)
            reached.append(self.active("id") or self.active())
        self.assertEqual(reached, ["filter-theme", "filter-verdict", "filter-level", "filter-new", "filter-differs", "Show all", "Copy link"])


class Hostile(Browser):
    def test_nothing_runs(self):
        def spread(value):
            if isinstance(value, str):
                return value + HOSTILE
            return [spread(item) for item in value] if isinstance(value, list) else (
                {key: spread(item) for key, item in value.items()} if isinstance(value, dict) else value)

        sample = large_records(12, 1)[0]
        for test in sample["tests"]:
            kept = {key: test[key] for key in ("verdict", "level")}
            test.update(spread(test))
            test.update(kept, debug=HOSTILE, reproducer=HOSTILE, baseline_reason=HOSTILE)
        bug = spread({"id": "x", "title": "x", "clause": "x", "requirements": ["x"], "why_not_reduced": "x", "known": "x",
                      "known_in": "x", "failure": {"calls": ["x"], "expected": "x", "captured": "x", "message": "x"}})
        hostile = {**sample, "implementation": spread({"name": "x", "library": "x", "vendor": "x", "renderer": "x",
                   "version": "x", "machine": "x", "captures": [{"name": "x", "available": False, "reason": "x"}]}),
                   "bugs": [{**bug, "tests": [sample["tests"][0]["name"]]}], "bugs_note": HOSTILE,
                   "readings": {HOSTILE: [HOSTILE]}, "reason": HOSTILE, "command": HOSTILE}
        self.open(write_page(arguments.write_pages, "hostile", [hostile, hostile]))
        self.choose("from", "0")
        self.choose("to", "1")
        self.open_all()
        Select(driver.find_element(By.ID, "filter-theme")).select_by_index(1)
        self.js("document.querySelectorAll('[onclick]').forEach((e) => e.click())")
        time.sleep(0.2)
        self.assertNotEqual(driver.title, "owned")
        self.assertEqual(self.js("return document.querySelectorAll('img, svg, script, style, iframe, object').length"), 3)
        self.assertEqual(self.js("return [...document.querySelectorAll('*')].flatMap((e) => [...e.attributes])"
                                 ".filter((a) => a.name.startsWith('on') || /^(javascript|https?):/.test(a.value)).length"), 0)
        self.assertGreater(self.js("return document.querySelector('main').textContent.split('onerror=').length"), 50)
        self.assertEqual(driver.get_log("browser"), [])


class Large(Browser):
    def test_few_rows_at_once(self):
        self.open(write_page(arguments.write_pages, "large", large_records(4000, 3)))
        self.assertLess(self.js("return document.querySelectorAll('*').length"), 3000)
        self.press_toggle("Theme7")
        self.assertEqual(len(self.texts("#table .test")), 100)
        self.choose("filter-verdict", "crash")
        self.assertLess(self.js("return document.querySelectorAll('*').length"), 5000)
        self.open("large/index.html", state="#group=Theme7")
        self.assertEqual(len(self.texts("#table .test")), 100)

    def test_more_rows_one_after_the_other(self):
        records = large_records(300, 1)
        for test in records[0]["tests"]:
            test["name"] = test["name"].replace("Theme", "One.Theme")
        self.open(write_page(arguments.write_pages, "more", records))
        self.press_toggle("One")
        for rows in (200, 300):
            driver.find_element(By.CSS_SELECTOR, "#table .more button").click()
            self.eventually(rows, lambda: len(self.texts("#table .test")))
        self.assertEqual(self.texts("#table .more"), [])


def take_screenshots(folder):
    folder.mkdir(parents=True, exist_ok=True)
    browser = Browser()
    for name, page, size, scheme, state, script in (
            ("light", "three.html", DESKTOP, "light", "", ""),
            ("dark", "three.html", DESKTOP, "dark", "#bug=EV-MAP1-BEZIER-09d4", ""),
            ("test", "three.html", DESKTOP, "light", "#at=open%3DMap1Values.Bezier%2FTEXTURE_COORD_1%2Fd", ""),
            ("requirements", "three.html", DESKTOP, "light", "#at=requirement%3DEV-MESH2-FILL", ""),
            ("phone", "three.html", PHONE, "light", "", ""),
            ("phone-filters", "three.html", PHONE, "light", "", "document.getElementById('tests').scrollIntoView()"),
            ("phone-test", "three.html", PHONE, "dark", "#at=open%3DMap1Values.Bezier%2FTEXTURE_COORD_1%2Fd", ""),
            ("comparison", "compared.html", DESKTOP, "light", "", "document.getElementById('changes').scrollIntoView()")):
        browser.open(page, size, [("prefers-color-scheme", scheme)], state=state)
        browser.js(script)
        time.sleep(0.5)
        driver.save_screenshot(str(folder / f"{name}.png"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("write_pages")
    parser.add_argument("--screenshots", type=pathlib.Path)
    parser.add_argument("rest", nargs="*", help="for unittest")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pages = pathlib.Path(folder)
        subprocess.run([arguments.write_pages, pages], check=True)
        if arguments.screenshots:
            setUpModule()
            take_screenshots(arguments.screenshots)
            tearDownModule()
        unittest.main(argv=["browser_test.py", *arguments.rest], verbosity=2)
