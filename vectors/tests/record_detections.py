#!/usr/bin/env python3
"""Writes detections.json: what detects each wrong evaluator and each wrong state machine.

    record_detections.py BUILD_FOLDER [--check] [--jobs N] [NAME...]

`vectors` is the first case of the theme that has to detect it. `suite` is a test of the suite that detects it
with the values of quick depth, which may since have moved to full depth; null if no test does within 90
seconds. Each wrong evaluator or state machine runs as a sink (python_sink.c) through the tests that the correct
machine passes, until a test fails. Tests about requirements of the detecting case run first, and among equals
the fastest. If names ("evaluator: NAME", "state machine: NAME") are given, the entries of all others are kept.
With --check nothing is written; the recorded tests must pass with the correct machine and fail with the wrong
one.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutation_test import RECORD, first_detected
from wrong_evaluators import WRONG_EVALUATORS
from wrong_state_machines import WRONG_STATE_MACHINES

HERE = Path(__file__).resolve().parent
TABLES = {"evaluator": WRONG_EVALUATORS, "state machine": WRONG_STATE_MACHINES}
ALL = [f"{kind}: {name}" for kind, table in TABLES.items() for name in table]
SECONDS_OF_ONE = 90
# Tests with so many vertices that the state machine in Python takes minutes are left out, and so are tests that
# take longer than MOST_SECONDS.
EXPENSIVE = "CurrentValues.Long*:LongPrimitives.*:*Accuracy.*:*.CopyOnCall*:*.SquareNet*"
MOST_SECONDS = 10
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

    def run(self, wrong, tests=None, until_failure=False):
        """Runs tests with a wrong evaluator or state machine ("": the correct one). Returns their records."""
        with tempfile.TemporaryDirectory() as folder:
            records, names = Path(folder) / "records", Path(folder) / "names"
            records.touch()
            command = [self.program, "--library", self.sink, "--depth", "quick", "--records", records,
                       "--gtest_brief=1", f"--gtest_filter=-{EXPENSIVE}"]
            if tests is not None:
                names.write_text("\n".join(tests) + "\n")
                command += ["--tests", names]
            if until_failure:
                command.append("--gtest_fail_fast")
            environment = {**os.environ, "EVALCTS_WRONG": wrong, "PYTHONPATH": str(HERE),
                           "PYTHONDONTWRITEBYTECODE": "1"}
            try:
                subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               timeout=SECONDS_OF_ONE if until_failure else None, check=False)
                is_complete = True
            except subprocess.TimeoutExpired:
                is_complete = False
            found, in_flight = [], None
            for event in map(json.loads, records.read_text().splitlines()):
                if event["event"] == "start":
                    in_flight = event["name"]
                elif event["event"] == "result":
                    found.append(event["record"])
                    in_flight = None
            if in_flight and is_complete:
                found.append({"name": in_flight, "verdict": "crash"})
            return found

    def passed_tests(self):
        """Returns the tests that the correct machine passes, with their requirements, fastest first."""
        found = self.run("")
        failed = [record["name"] for record in found if record["verdict"] not in NOT_FAILED]
        if failed:
            raise SystemExit(f"the correct machine fails {' '.join(failed)}")
        passed = [record for record in found
                  if record["verdict"] == "pass" and record["seconds"] <= MOST_SECONDS]
        return {record["name"]: set(record["requirements"])
                for record in sorted(passed, key=lambda record: record["seconds"])}

    def detects(self, wrong, tests):
        """Returns the first test that fails, or None."""
        found = self.run(wrong, tests, until_failure=True)
        return next((record["name"] for record in found if record["verdict"] not in NOT_FAILED), None)


def check(suite, names, detections):
    """Runs the recorded tests again. Returns the number of those that do not detect what they detected."""
    wrong = 0
    for name in names:
        test = detections[name]["suite"]
        if test is None:
            if len(names) < len(ALL):
                wrong += 1
                print(f"{name}: no test of the suite is recorded")
            continue
        alone = suite.run("", [test])[0]["verdict"]
        if alone != "pass" or suite.detects(name, [test]) != test:
            wrong += 1
            print(f"{name}: {test} does not detect it (correct machine: {alone})")
    return wrong


def write(suite, names, jobs):
    detections = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    tests = suite.passed_tests()

    def entry_of(name):
        kind, _, wrong = name.partition(": ")
        case = first_detected(kind, TABLES[kind][wrong])
        about = set(case["requirements"]) if case else set()
        # Sorting is stable, so fast tests stay first.
        order = sorted(tests, key=lambda test: not tests[test] & about)
        return {"vectors": case and case["id"], "suite": suite.detects(name, order)}
    with ThreadPoolExecutor(jobs) as pool:
        for name, entry in zip(names, pool.map(entry_of, names)):
            detections[name] = entry
            print(name, entry, flush=True)
            known = {each: detections[each] for each in ALL if each in detections}
            RECORD.write_text(json.dumps(known, indent=1) + "\n")


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
