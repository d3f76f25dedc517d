#!/usr/bin/env python3
"""Checks that verdicts and signatures depend on nothing but the implementation: three runs, a run in a random
order, and runs of each test alone in a separate process must give the same verdicts. Tests that are known to be
flaky are left out, because the library itself decides them by chance.

usage: stability.py EVALCTS [--implementation NAME]... [--depth quick] [--shuffle SEED]

Exit code 0: the same; 1: differences, which are printed; 2: a run could not be made.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time


def outcome(record):
    """Verdict and signature: which cases failed, and how often each."""
    return record["verdict"], (*record.get("mismatches", ()), *filter(None, [record.get("signature_of_all")]))


def whole_run(program, name, depth, folder, *options):
    """The outcome of each test in one run of all, those that are known to be flaky, and the captures that were
    proved."""
    command = [program, "run", "--implementation", name, "--depth", depth, "--output", str(folder), "--retry", "0",
               *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        print(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}", file=sys.stderr)
        sys.exit(2)
    result = json.loads((folder / f"results-{name}.json").read_text())
    captures = [c["name"] for c in result["implementation"]["captures"] if c["available"]]
    flaky = {test["name"] for test in result["tests"] if test.get("baseline_reason", "").startswith("flaky: ")}
    return {test["name"]: outcome(test) for test in result["tests"]}, flaky, captures


def alone(program, name, depth, captures, test, folder):
    """Returns the outcome of one test that runs alone in a separate process. If the process dies, `evalcts run` decides
    with its controls what that means."""
    suite = str(pathlib.Path(program).with_name("evalcts-suite"))
    stem = test.replace("/", "~")
    records = folder / f"{stem}.jsonl"
    command = [suite, "--implementation", name, "--depth", depth, "--worker", str(records),
               "--captures", ",".join(captures) or "none"]
    try:
        subprocess.run(command, input=json.dumps({"job": "test", "name": test}) + "\n", text=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    except subprocess.TimeoutExpired:
        pass
    for line in records.read_text().splitlines() if records.exists() else ():
        event = json.loads(line)
        if event["event"] == "result":
            return outcome(event["record"])
    return whole_run(program, name, depth, folder / stem, "--filter", test, "--no-bugs", "--allow-unobserved")[0][test]


def in_short(outcome):
    verdict, mismatches = outcome
    return verdict + "".join(f"; {mismatch}" for mismatch in mismatches[:3]) + ("; ..." if mismatches[3:] else "")


def compare(name, what, expected, found, flaky):
    """Prints what differs; the number of differences."""
    not_run = ("not run", ())
    differing = [test for test in (expected.keys() | found.keys()) - flaky if expected.get(test) != found.get(test)]
    for test in sorted(differing)[:20]:
        print(f"{name}: {test}: {what}: {in_short(found.get(test, not_run))} -- the first run: "
              f"{in_short(expected.get(test, not_run))}")
    return len(differing)


def check(program, name, depth, seed, folder):
    differences = 0
    begin = time.monotonic()
    first, flaky, captures = whole_run(program, name, depth, folder)
    for what, options in (("second run", ()), ("third run", ()), (f"shuffled by {seed}", ("--shuffle", str(seed)))):
        outcomes, flaky_now, _ = whole_run(program, name, depth, folder, *options)
        flaky |= flaky_now
        differences += compare(name, what, first, outcomes, flaky)
    runs = time.monotonic() - begin
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        each = dict(zip(first, pool.map(lambda test: alone(program, name, depth, captures, test, folder), first)))
    differences += compare(name, "alone", first, each, flaky)
    failing = sum(verdict not in ("pass", "skipped", "not-observable", "not-supported") for verdict, _ in first.values())
    print(f"{name}: {len(first)} tests ({failing} not passing, {len(flaky)} known to be flaky and left out), "
          f"{differences} differences between three runs, a "
          f"shuffled one ({runs:.0f} s) and each test alone ({time.monotonic() - begin - runs:.0f} s)", flush=True)
    return differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--implementation", action="append")
    parser.add_argument("--depth", default="quick")
    parser.add_argument("--shuffle", type=int, default=1)
    arguments = parser.parse_args()
    names = arguments.implementation or ["osmesa", "production", "reference"]
    differences = 0
    for name in names:
        with tempfile.TemporaryDirectory(prefix="evalcts-stability-") as folder:
            differences += check(arguments.program, name, arguments.depth, arguments.shuffle, pathlib.Path(folder))
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
