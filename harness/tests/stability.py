#!/usr/bin/env python3
"""Checks that verdicts and signatures depend on nothing but the implementation: three runs, a run in a random
order, and runs of each test alone in a separate process must give the same verdicts. Tests that are known to be
flaky are left out, because the library itself decides them by chance. Behind each legal variation, a worker with a
warm context, another with the tests in a random order, and one with fresh contexts only must give the same.

usage: stability.py EVALCTS [--implementation NAME]... [--variation NAME]... [--depth quick] [--shuffle SEED]

Exit code 0: the same; 1: differences, which are printed; 2: a run could not be made.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
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
    command = [suite, "--implementation", name, "--depth", depth, "--events", str(records),
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


def of_worker(command, tests, folder):
    """Returns the outcome of each test that one worker runs in this order. The tests behind one that kills the process
    run in another one. Below this project's evaluator is softpipe, which need not compile shaders in each context."""
    outcomes, left, log = {}, list(tests), folder / "log.txt"
    environment = os.environ | {"GALLIUM_DRIVER": "softpipe", "DRAW_USE_LLVM": "0"}
    while left:
        records = folder / f"{len(left)}.jsonl"
        jobs = "".join(json.dumps({"job": "test", "name": test}) + "\n" for test in left)
        with log.open("a") as output:
            subprocess.run([*command, "--events", str(records)], input=jobs, text=True, stdout=output, stderr=output,
                           timeout=3600, env=environment)
        events = [json.loads(line) for line in records.read_text().splitlines()] if records.exists() else []
        started = [event["name"] for event in events if event["event"] == "start"]
        outcomes |= {event["record"]["name"]: outcome(event["record"]) for event in events if event["event"] == "result"}
        if not started:
            print(f"{' '.join(command)} runs no test; see its output:\n{log.read_text()}", file=sys.stderr)
            sys.exit(2)
        if started[-1] not in outcomes:
            outcomes[started[-1]] = "ends the process", ()
        left = left[len(started):]
    return outcomes


def check_variation(suite, variation, depth, seed, folder):
    """Compares workers with and without a warm context behind a legal variation."""
    name = variation["name"]
    command = [suite, *variation["arguments"], "--depth", depth, "--variation", name]
    folder.mkdir()
    listing = folder / "list.jsonl"
    subprocess.run([suite, "--events", str(listing)], input='{"job": "list", "name": "list"}\n', text=True,
                   stdout=subprocess.DEVNULL, check=True)
    listed = next(event for event in map(json.loads, listing.read_text().splitlines()) if event["event"] == "tests")
    order = ("quick", "full", "thorough")
    tests = sorted(name for group in listed["groups"] if order.index(group["from"]) <= order.index(depth)
                   for name in group["names"])
    shuffled = random.Random(seed).sample(tests, len(tests))
    runs = {}
    for what, options, names in (("warm", ["--warm"], tests), ("shuffled", ["--warm"], shuffled), ("fresh", [], tests)):
        (folder / what).mkdir()
        runs[what] = of_worker([*command, *options], names, folder / what)
    differences = sum(compare(name, what, runs["fresh"], runs[what], set()) for what in ("warm", "shuffled"))
    print(f"{name}: {len(tests)} tests, {differences} differences between warm, shuffled and fresh", flush=True)
    return differences


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
    parser.add_argument("--variation", action="append")
    parser.add_argument("--depth", default="quick")
    parser.add_argument("--shuffle", type=int, default=1)
    arguments = parser.parse_args()
    depth, seed = arguments.depth, arguments.shuffle
    is_all = not arguments.implementation and not arguments.variation
    differences = 0
    for name in ["osmesa", "egl", "production", "reference"] if is_all else arguments.implementation or []:
        with tempfile.TemporaryDirectory(prefix="evalcts-stability-") as folder:
            differences += check(arguments.program, name, depth, seed, pathlib.Path(folder))
    if is_all or arguments.variation:
        suite = str(pathlib.Path(arguments.program).with_name("evalcts-faulty-suite"))
        with tempfile.TemporaryDirectory(prefix="evalcts-stability-") as folder:
            listing = pathlib.Path(folder) / "variations.json"
            subprocess.run([suite, "--list-variations", str(listing)], check=True)
            variations = json.loads(listing.read_text())["faults"]
            names = [one["name"] for one in variations]
            if unknown := sorted(set(arguments.variation or []) - set(names)):
                parser.error(f"no variation is called {', '.join(unknown)}; there are {', '.join(names)}")
            variations = [one for one in variations if is_all or one["name"] in arguments.variation]
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
                differences += sum(pool.map(lambda one: check_variation(
                    suite, one, depth, seed, pathlib.Path(folder) / one["name"]), variations))
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
