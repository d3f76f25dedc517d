#!/usr/bin/env python3
"""Writes detections.json: what detects each wrong evaluator and each wrong state machine.

    record_detections.py BUILD_FOLDER [--check] [--jobs N] [NAME...]

`vectors` is the first case that detects it (for an evaluator, the first of its theme). `suite` is a test of quick
depth that detects it, otherwise the recorded test of another depth, or null; then `reason`, written by hand,
says why. Each wrong evaluator or state machine runs as a sink (python_sink.c) through the tests, the likely ones first, until one
fails that the correct machine passes. If names ("evaluator: NAME", "state machine: NAME") are given, the entries
of all others are kept. With --check nothing is written: all recorded tests must exist, and those of the names
must pass with the correct machine and fail with the wrong one.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path

from mutation_test import RECORD, first_detected
from wrong_evaluators import WRONG_EVALUATORS
from wrong_state_machines import WRONG_STATE_MACHINES

HERE = Path(__file__).resolve().parent
TABLES = {"evaluator": WRONG_EVALUATORS, "state machine": WRONG_STATE_MACHINES}
ALL = [f"{kind}: {name}" for kind, table in TABLES.items() for name in table]
# Tests that take the state machine in Python many seconds, because they have many vertices or many large nets.
EXPENSIVE = re.compile(r"CurrentValues\.Long|LongPrimitives\.|.*Accuracy\.|.*\.CopyOnCall|.*\.SquareNet|"
                       r"Map2State\.(EveryOrder|IndependentLarge|Layouts|LargeStrides)")
# GoogleTest keeps the tests of a suite together, so only batches of tests run in the wanted order.
FIRST_BATCH, GROWTH = 6, 5
SECONDS_OF_BATCH = 1200
NOT_FAILED = "pass", "not-observable", "not-supported"
CANNOT_RUN = 77


def build_sink(folder):
    """Compiles python_sink.c. Ends the program with code 77 if Python cannot be embedded."""
    sink = Path(folder) / "python_sink.so"
    options = shutil.which("pkg-config") and subprocess.run(
        ["pkg-config", "--cflags", "--libs", "python3-embed"], capture_output=True, text=True, check=False)
    if not options or options.returncode != 0:
        print("pkg-config does not know python3-embed (package libpython3-dev)")
        sys.exit(CANNOT_RUN)
    header = HERE.parent.parent / "harness/backends/plugin"
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", f"-I{header}", "-o", sink,
                    HERE / "python_sink.c", *options.stdout.split()], check=True)
    return sink


class Suite:
    def __init__(self, program, sink):
        self.program, self.sink = program, sink

    @lru_cache(None)
    def listed(self, depth=None):
        """Returns the requirements of each test of one depth, or of all."""
        with tempfile.TemporaryDirectory() as folder:
            events = Path(folder) / "events"
            subprocess.run([self.program, "--worker", events], input=b'{"job": "list", "name": "list"}\n', check=True)
            listing = next(event for event in map(json.loads, events.read_text().splitlines())
                           if event["event"] == "tests")
        return {name: set(group["requirements"]) for group in listing["groups"] if depth in (None, group["from"])
                for name in group["names"]}

    def run(self, wrong, tests):
        """Runs tests with a wrong evaluator or state machine ("": the correct one) until one fails.

        Returns their names and verdicts; a test in flight at the time limit has none.
        """
        with tempfile.TemporaryDirectory() as folder:
            events = Path(folder) / "events"
            events.touch()
            command = [self.program, "--library", self.sink, "--depth", "quick", "--worker", events]
            environment = {**os.environ, "EVALCTS_WRONG": wrong, "PYTHONPATH": str(HERE),
                           "PYTHONDONTWRITEBYTECODE": "1"}
            worker = subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)
            found, end = {}, time.monotonic() + SECONDS_OF_BATCH
            with worker, open(events) as lines:
                for test in tests:
                    try:
                        worker.stdin.write(json.dumps({"job": "test", "name": test}).encode() + b"\n")
                        worker.stdin.flush()
                    except BrokenPipeError:
                        pass
                    verdict, partial = None, ""
                    while verdict is None and time.monotonic() < end:
                        partial += lines.readline()
                        if not partial.endswith("\n"):
                            if worker.poll() is not None and not partial:
                                verdict = "crash"
                            time.sleep(0.0002)
                            continue
                        event = json.loads(partial)
                        partial = ""
                        if event["event"] == "result":
                            verdict = event["record"]["verdict"]
                    if verdict is None:
                        break
                    found[test] = verdict
                    if verdict not in NOT_FAILED:
                        break
                worker.kill()
            return found

    @lru_cache(None)
    def is_passed(self, test):
        """Returns true if the correct machine passes the test."""
        return self.run("", [test]) == {test: "pass"}

    def detects(self, wrong, tests):
        """Returns the first test that fails although the correct machine passes it, or None."""
        size = FIRST_BATCH
        while tests:
            found = self.run(wrong, tests[:size])
            failed = next((name for name, verdict in found.items() if verdict not in NOT_FAILED), None)
            if failed and self.is_passed(failed):
                return failed
            # After a failure that does not count, the tests that have not run yet are still to be run.
            tests = [test for test in tests[:size] if failed and test not in found] + tests[size:]
            size *= GROWTH
        return None


def family_of(name):
    """Returns the name of the test without its parameters."""
    return name.partition("/")[0]


def in_order(suite, about, recorded):
    """Returns the tests of quick depth and the recorded one, the likely ones first.

    These are the recorded test if it belongs to quick depth, the same test with other parameters, tests about one
    of the requirements, and the recorded test of another depth. Among equals, all tests with their first
    parameters precede those with their second ones.
    """
    tests, counts = suite.listed("quick"), Counter()

    def likelihood(name):
        family = family_of(name)
        if name == recorded:
            kind = 0 if name in tests else 3
        elif recorded and family == family_of(recorded):
            kind = 1
        else:
            kind = 2 if tests[name] & about else 4
        counts[kind, family] += 1
        return kind, counts[kind, family]
    names = [name for name in tests if not EXPENSIVE.match(name)]
    if recorded in suite.listed() and recorded not in names:
        names.append(recorded)
    return sorted(names, key=likelihood)


def check(suite, names, detections):
    """Runs the recorded tests again. Returns the number of entries that are not true."""
    existing = suite.listed()
    wrong = 0
    for name, entry in detections.items():
        test = entry["suite"]
        complaint = None
        if test is None:
            complaint = not entry.get("reason") and "no test of the suite is recorded, and no reason"
        elif test not in existing:
            complaint = f"{test} does not exist"
        elif name in names and not suite.is_passed(test):
            complaint = f"the correct machine does not pass {test}"
        elif name in names and suite.detects(name, [test]) != test:
            complaint = f"{test} does not detect it"
        if complaint:
            wrong += 1
            print(f"{name}: {complaint}", flush=True)
    return wrong


def write(suite, names, jobs):
    detections = json.loads(RECORD.read_text()) if RECORD.exists() else {}

    def entry_of(name):
        kind, _, wrong = name.partition(": ")
        case = first_detected(kind, TABLES[kind][wrong])
        about = set(case["requirements"]) if case else set()
        old = detections.get(name, {})
        test = suite.detects(name, in_order(suite, about, old.get("suite")))
        entry = {"vectors": case and case["id"], "suite": test}
        if test is None:
            entry["reason"] = old.get("reason", "")
        return entry
    with ThreadPoolExecutor(jobs) as pool:
        for name, entry in zip(names, pool.map(entry_of, names)):
            detections[name] = entry
            print(name, entry, flush=True)
            known = {each: detections[each] for each in ALL if each in detections}
            lines = (f" {json.dumps(each)}: {json.dumps(entry)}" for each, entry in known.items())
            RECORD.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as folder:
        suite = Suite(options.build / "harness/cli/evalcts-suite", build_sink(folder))
        names = options.names or ALL
        if options.check:
            sys.exit(min(check(suite, names, json.loads(RECORD.read_text())), 1))
        write(suite, names, options.jobs)


if __name__ == "__main__":
    main()
