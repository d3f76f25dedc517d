#!/usr/bin/env python3
"""Checks that a worker elsewhere gives the records of this machine: `production` and `reference` at quick depth, test by
test, except for what differs by nature: durations, and commands that name programs of this machine.

usage: own_records.py EVALCTS WORKER FOLDER [--except TEST]...

A test whose name begins with TEST is not compared. Exit code 0: the same; 1: differences, which are printed.
"""
import argparse
import json
import pathlib
import subprocess
import sys

OWN = ("production", "reference")
BY_NATURE = ("seconds", "rerun", "debug", "reproducer")


def records(folder, name):
    tests = json.loads((folder / f"results-{name}.json").read_text())["tests"]
    return {test["name"]: {key: value for key, value in test.items() if key not in BY_NATURE} for test in tests}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("evalcts")
    parser.add_argument("worker")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--except", action="append", default=[], dest="omitted")
    arguments = parser.parse_args()
    command = [arguments.evalcts, "run", "--depth", "quick", "--no-bugs", "--strict", "--timeout", "600"]
    for name in OWN:
        command += ["--implementation", name]
    here, elsewhere = arguments.folder / "here", arguments.folder / "elsewhere"
    subprocess.run([*command, "--output", here], check=True)
    subprocess.run([*command, "--output", elsewhere, "--worker", arguments.worker], check=True)

    different = compared = 0
    for name in OWN:
        expected, found = records(here, name), records(elsewhere, name)
        for test in sorted(expected.keys() | found.keys()):
            if test.startswith(tuple(arguments.omitted)):
                continue
            compared += 1
            if expected.get(test) != found.get(test):
                different += 1
                print(f"{name}: {test}: here {expected.get(test)}, elsewhere {found.get(test)}")
    print(f"{compared} records, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
