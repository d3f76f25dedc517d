"""Measures the page in Chromium: page_benchmark.py WRITE_PAGES RESULTS.json...

WRITE_PAGES is the built program evalcts_reports_write_pages. It writes two pages from copies of the records: one of six
implementations with the tests as they are, and one of 8 implementations with 20,000 tests each, in which calls and messages
differ from copy to copy. The program prints the size and the number of nodes of each page, the time until it is loaded and
painted, the time from each change of the filters to the next frame, and the processor time of the page's thread for these.
The aims are 1 s and 100 ms. No result is a failure, because other programs share the processor.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import browser_test

LOADS, ROUNDS = 5, 5

FILTER = """
  const [id, value, done] = arguments, field = document.getElementById(id), start = performance.now();
  if (field.type === 'checkbox') field.checked = value; else field.value = value;
  field.dispatchEvent(new Event(id === 'filter-q' ? 'input' : 'change', {bubbles: true}));
  requestAnimationFrame(() => setTimeout(() => done(performance.now() - start)));"""
CLICK = """
  const [selector, number, done] = arguments, start = performance.now();
  document.querySelectorAll(selector)[number].click();
  requestAnimationFrame(() => setTimeout(() => done(performance.now() - start)));"""
LOADED = """
  const done = arguments[0], [navigation] = performance.getEntriesByType('navigation');
  const paint = performance.getEntriesByName('first-contentful-paint')[0];
  requestAnimationFrame(() => setTimeout(() => done(Math.max(navigation.loadEventEnd, paint ? paint.startTime : 0))));"""
STEPS = (("filter-verdict", "fail"), ("filter-verdict", ""), ("filter-theme", "Map1Values"), ("filter-theme", ""),
         ("filter-q", "e"), ("filter-q", "glmap1f"), ("filter-q", "glmap1f vertex_4"), ("filter-q", "0.75"),
         ("filter-q", ""), ("filter-level", "quality"), ("filter-level", ""), ("filter-differs", True), ("filter-differs", False),
         ("filter-new", True), ("filter-new", False))
CLICKS = ("#views button[value=requirements]", "#views button[value='']", "#table .toggle", "#table .toggle")


def copy_of(test, number):
    """Returns a copy of the test that shares no text of its evidence with the original."""
    text = json.dumps({key: value for key, value in test.items() if key not in ("requirements", "verdict", "level")})
    text = text.replace("0.", f"0.{number}")
    return {**test, **json.loads(text), "name": f"{test['name']}/copy{number}",
            "message": test["message"] and f"{test['message']} ({number})"}


def multiplied(records, columns, tests):
    out = []
    for column in range(columns):
        record = records[column % len(records)]
        all_tests = record["tests"]
        if tests:
            copies = -(-tests // len(all_tests))
            all_tests = [copy_of(test, k) if k else test for k in range(copies) for test in record["tests"]][:tests]
        out.append({**record, "tests": all_tests,
                    "implementation": {**record["implementation"], "name": f"{record['implementation']['name']}-{column}"}})
    return out


def processor_ms():
    """Returns the processor time of the page's main thread up to now."""
    metrics = browser_test.driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return 1000 * next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration")


def line(name, samples):
    """Prints the medians of both numbers of the samples and the range of the first number."""
    waited, spent = zip(*samples)
    print(f"  {name:<45} {statistics.median(waited):6.0f} ms ({min(waited):.0f} to {max(waited):.0f}), "
          f"processor {statistics.median(spent):.0f} ms")


def measured(name, page, seconds):
    driver = browser_test.driver
    driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    samples = {}

    def sample(step, *script):
        before = processor_ms()
        waited = driver.execute_async_script(*script)
        samples.setdefault(step, []).append((waited, processor_ms() - before))

    for _ in range(LOADS):
        driver.get("about:blank")
        before = processor_ms()
        driver.get(page.as_uri())
        waited = driver.execute_async_script(LOADED)
        samples.setdefault("load", []).append((waited, processor_ms() - before))
    nodes = driver.execute_script("return document.querySelectorAll('*').length")
    for _ in range(ROUNDS):
        for field, value in STEPS:
            sample(f"{field[7:]} = {value!r}", FILTER, field, value)
        for number, selector in enumerate(CLICKS):
            sample(f"click {number + 1}: {selector}", CLICK, selector, 0 if "views" in selector else 3)
    print(f"{name}: {page.stat().st_size / 1e6:.1f} MB, written in {seconds:.1f} s, {nodes} nodes")
    for step, of_step in samples.items():
        line(step, of_step)


def main(write_pages, files):
    records = [json.loads(pathlib.Path(file).read_text()) for file in files]
    with tempfile.TemporaryDirectory() as folder:
        browser_test.pages = pathlib.Path(folder)
        browser_test.setUpModule()
        browser_test.driver.set_window_size(1400, 900)
        try:
            for columns, tests in ((6, 0), (8, 20000)):
                name = f"{columns}-of-{tests or len(records[0]['tests'])}"
                many = multiplied(records, columns, tests)
                start = time.monotonic()
                page = browser_test.write_page(write_pages, name, many)
                measured(name, page, time.monotonic() - start)
        finally:
            browser_test.tearDownModule()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
