#!/usr/bin/env python3
"""Compares the evaluator with its peers and prints the table of the README.

Every side of every workload is measured many times in one process, in random order; the result is the
fastest time. Numbers are ns of processor time of one core per point (all components of one result).
"""
import argparse
import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXACT, FAST, LOOP, HORNER = "production", "production_fast", "constant_order", "float_Horner"
WITH_MAP = ("production_with_map", "constant_order_with_map")
PATCHES = ("production_patches", "constant_order_with_map")
WIDTHS = {"AVX2": "AVX2", "AVX-512": "AVX3"}  # prefixes of the names in Highway
PEERS = {"loop": LOOP, "Eigen": "Eigen", "OpenSubdiv": "OpenSubdiv", "OSMesa": "OSMesa", "float Horner": HORNER}

# Words, name of the benchmark, and the sides of the evaluator and the loop if they are not EXACT and LOOP.
ROWS = [
    ("random curve, order 4, dim 3", "Curve/order:4/dim:3"),
    ("random curve, order 4, dim 4", "Curve/order:4/dim:4"),
    ("random curve, order 10, dim 3", "Curve/order:10/dim:3"),
    ("random curve, order 30, dim 3", "Curve/order:30/dim:3"),
    ("random bicubic mesh, array", "Mesh/order:4/dim:3/array"),
    ("random bicubic mesh, ring", "Mesh/order:4/dim:3/ring"),
    ("random bicubic mesh, ring, GLEV_FAST", "Mesh/order:4/dim:3/ring", FAST),
    ("random bicubic mesh with normals, ring", "Mesh/order:4/dim:3/normals/ring"),
    ("random 8 x 8 mesh, dim 4, ring", "Mesh/order:8/dim:4/ring"),
    ("random 8 x 8 mesh, dim 4, ring, GLEV_FAST", "Mesh/order:8/dim:4/ring", FAST),
    ("random 30 x 30 mesh, dim 4, ring", "Mesh/order:30/dim:4/ring"),
    ("random 30 x 30 mesh, dim 4, ring, GLEV_FAST", "Mesh/order:30/dim:4/ring", FAST),
    ("one call with its sink, random curve, order 4", "Call/curve/order:4/dim:3"),
    ("one call with its sink, random bicubic surface", "Call/surface/order:4/dim:3"),
    ("hard: (1-2u)^3, order 4", "Hard/power/order:4"),
    ("hard: (1-2u)^9, order 10", "Hard/power/order:10"),
    ("hard: (1-2u)^29, order 30", "Hard/power/order:30"),
    ("hard: roots j/30 in (0,1), order 30", "Hard/roots/order:30"),
    ("hard: integers -9..9 at u = i/1024, order 4", "Hard/integers/order:4"),
    ("hard: points 0..3, order 4", "Hard/line/order:4"),
    ("hard: points 0..9, order 10", "Hard/line/order:10"),
    ("hard: points 0..29, order 30", "Hard/line/order:30"),
    ("hard: random x 1e6 + 1e6, order 4", "Hard/offset/order:4"),
    *[(f"teapot, {n} segments, plan at hand", f"Model/teapot/segments:{n}") for n in (4, 8, 10, 16, 32, 64)],
    ("teapot, 64 segments, plan at hand, GLEV_FAST", "Model/teapot/segments:64", FAST),
    *[(f"teapot, {n} segments, with map and plan", f"Model/teapot/segments:{n}", *WITH_MAP) for n in (8, 64)],
    *[(f"teapot, {n} segments, glevEvaluatePatches", f"Model/teapot/segments:{n}", *PATCHES) for n in (8, 64)],
    *[(f"random patches, {n} segments, plan at hand", f"Model/random/segments:{n}") for n in (8, 64)],
    ("random patches, 7 segments, with map and plan", "Model/random/segments:7", *WITH_MAP),
    ("10^6 random patches, 7 segments, glevEvaluatePatches", "Patches/million/segments:7"),
    ("multiples of 2^-24, 8 segments, plan at hand", "Model/dyadic/segments:8"),
    ("random bilinear patches, 8 segments, plan at hand", "Model/bilinear/segments:8"),
    # Work of the evaluator alone.
    ("Map2, plan and release, bicubic, a plan", "Plan/bicubic"),
    ("Map2, plan and release, 64 x 64, a plan", "Plan/order:64"),
    ("MapGrid2, plan and release, a plan", "Plan/grid_alone"),
    ("bicubic mesh, doubles", "Double/mesh"),
    ("curve of order 4, scattered arguments, doubles", "Double/curve"),
    ("both tangents of a bicubic mesh, floats", "Tangents/float"),
    ("both tangents of a bicubic mesh, floats, GLEV_FAST", "Tangents/fast"),
    ("both tangents of a bicubic mesh, doubles", "Tangents/double"),
    ("glevEvaluate, curve of order 4, one argument", "Batch/count:1"),
    ("glevEvaluate, curve of order 4, 8 arguments", "Batch/count:8"),
    ("scattered bicubic points", "Scattered/bicubic"),
    ("scattered bicubic points, GLEV_FAST", "Scattered/fast"),
    ("EvalMesh2 to a sink, 64 x 64 points", "Sink/mesh"),
]
FILTER = f"^({'|'.join(sorted({row[1].split('/')[0] for row in ROWS}))})/"


class Results:
    def __init__(self, data):
        self.context = data["context"]
        self.rate = {}  # highest items per second, by name
        for run in data["benchmarks"]:
            name = run.get("run_name", run["name"])
            if run.get("error_occurred"):
                print(f"table.py: {name}: {run['error_message']}", file=sys.stderr)
            elif run.get("run_type", "iteration") == "iteration":
                self.rate[name] = max(self.rate.get(name, 0), run["items_per_second"])
        targets = {name.rsplit("/", 1)[1] for name in self.rate if f"/{EXACT}/" in name}
        # Highway has several kinds of AVX-512; the table uses the fastest one at meshes.
        self.target = {width: max((t for t in targets if t.startswith(prefix)), default=None,
                                  key=lambda t: self.rate.get(f"Mesh/order:4/dim:3/ring/{EXACT}/{t}", 0))
                       for width, prefix in WIDTHS.items()}

    def ns(self, *name):
        rate = self.rate.get("/".join(map(str, name)))
        return 1e9 / rate if rate else None


def three_digits(x):
    return "-" if x is None else f"{x:.2f}" if x < 9.995 else f"{x:.1f}" if x < 99.95 else f"{x:.0f}"


def first_value(file, key, separator):
    with open(file, encoding="utf-8") as lines:
        return next((text.split(separator, 1)[1].strip().strip('"') for text in lines
                     if text.startswith(key)), "unknown")


def environment(context):
    date = datetime.datetime.fromisoformat(context["date"]).astimezone(datetime.timezone.utc).date()
    caches = ", ".join(f"L{c['level']} {c['size'] // 1024} KiB" for c in context["caches"]
                       if c["type"] != "Instruction") or "caches unknown"
    processor = first_value("/proc/cpuinfo", "model name", ":")
    system = first_value("/etc/os-release", "PRETTY_NAME", "=")
    return f"{date}, one core of {processor} ({caches}), {context['compiler']}, peers as packaged by {system}."


def table(results):
    """The rows in which the evaluator is slowest, compared with the fastest peer, first."""
    rows = []
    for words, work, *sides in ROWS:
        side, loop = (*sides, *(EXACT, LOOP)[len(sides):])
        own = [results.ns(work, side, results.target[width]) for width in WIDTHS]
        peers = [results.ns(work, loop if name == LOOP else name) for name in PEERS.values()]
        fastest = min(filter(None, peers), default=None)
        cells = [three_digits(ns) + (f" ({three_digits(ns / fastest)}x)" if ns and fastest else "") for ns in own]
        slowest = max(filter(None, own), default=0)
        rows.append((slowest / (fastest or float("inf")), slowest, [words, *cells, *map(three_digits, peers)]))
    rows = [["work", *WIDTHS, *PEERS], ["---"] * (1 + len(WIDTHS) + len(PEERS)),
            *[cells for _, _, cells in sorted(rows, reverse=True)]]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in rows)


def measure(quick, repetitions):
    """The benchmark's JSON. Pinned, so that no measurement moves to another core."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "results.json")
        # Installs prerequisites and builds on all cores.
        subprocess.run([ROOT / "evalcts", "bench", "--benchmark_list_tests"], check=True, stdout=subprocess.DEVNULL)
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
        subprocess.run([ROOT / "build/release/harness/benchmarks/evalcts-bench", f"--benchmark_filter={FILTER}",
                        "--benchmark_enable_random_interleaving=true",
                        f"--benchmark_repetitions={repetitions or (2 if quick else 12)}",
                        f"--benchmark_min_time={0.001 if quick else 0.05}",
                        f"--benchmark_out={out}", "--benchmark_out_format=json"],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads(out.read_text(encoding="utf-8"))


def update(file, text):
    """Puts the table between its marks in the file."""
    first, last = "<!-- table.py -->\n", "<!-- end of table.py -->\n"
    whole = file.read_text(encoding="utf-8")
    before, rest = whole.split(first)
    file.write_text(f"{before}{first}{text}\n{last}{rest.split(last)[1]}", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="only check that everything runs")
    parser.add_argument("--repetitions", type=int, help="number of measurements of each side (default: 12)")
    parser.add_argument("--update", type=pathlib.Path, help="replace the table in this file, and print nothing")
    options = parser.parse_args()
    results = Results(measure(options.quick, options.repetitions))
    text = f"{environment(results.context)}\n\n{table(results)}"
    if options.update:
        update(options.update, text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
