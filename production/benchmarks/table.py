#!/usr/bin/env python3
"""Compares the evaluator with its peers and prints the tables of the README.

Every side of every workload is measured many times in one process, in random order; the result is the
fastest time. Numbers are ns of processor time of one core per point (all components of one result).
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILTERS = {"models": "^(Model|Patches|Plan|Double|Tangents|Batch|Scattered|Sink|Mesh/order:4/dim:3/ring/production)/",
           "peers": "^(Curve|Mesh|Call|Hard|Floor)/"}
HORNER, EXACT, FAST, PRODUCT = "float_Horner", "production", "production_fast", "Eigen"
LOOP = "constant_order"
WIDTHS = ("AVX2", "AVX-512")  # the instruction sets of the goals
FAMILY = {"AVX2": "AVX2", "AVX-512": "AVX3"}  # prefixes of the names in Highway


class Goal:
    """A line of the first table.

    must: ratios to float Horner on AVX2 and AVX-512. product: largest ratio to the time of the matrix product.
    fma and size are the multiply-adds and bytes of one point, store is the kind of memory they are stored to;
    without fma there is no floor.
    """

    def __init__(self, words, name, must, stretch, fma=None, size=12, product=None, side=EXACT,
                 store="store_ring", unit="double_FMA"):
        self.words, self.name, self.side = words, name, side
        self.must, self.stretch, self.product = must, stretch, product
        self.fma, self.size, self.store, self.unit = fma, size, store, unit


def grid(order, components, columns):
    """Multiply-adds of one point by Horner's rule: the point itself and its share of the curve of its row."""
    return components * (order - 1) * (1 + order / columns)


BICUBIC = grid(4, 3, 1024)
NORMALS = 9 + 2 * 6 + 14  # position; derivatives; cross product, length and scale
SHARE = "60 % of the floor"
GOALS = [
    Goal("scattered curve points, order 4, dim 3", "Curve/order:4/dim:3", (4, 6), "7x / 10x", 3 * 3),
    Goal("order 10, dim 3", "Curve/order:10/dim:3", (4, 8), "9x / 14x", 3 * 9),
    Goal("order 30, dim 3", "Curve/order:30/dim:3", (8, 18), "18x / 30x", 3 * 29),
    Goal("bicubic mesh 1024 x 1024, dim 3, full array", "Mesh/order:4/dim:3/array", (20, 30), SHARE, BICUBIC,
         product=1.1, store="store_array"),
    Goal("the same, ring of 16 rows", "Mesh/order:4/dim:3/ring", (None, 40), SHARE, BICUBIC, product=1.1),
    Goal("8 x 8 mesh 512 x 512, dim 4, ring", "Mesh/order:8/dim:4/ring", (50, 90), SHARE,
         grid(8, 4, 512), 16),
    Goal("30 x 30 mesh 512 x 512, dim 4, ring", "Mesh/order:30/dim:4/ring", (200, 400), SHARE,
         grid(30, 4, 512), 16),
    Goal("bicubic mesh with normals, ring", "Mesh/order:4/dim:3/normals/ring", (15, 15), "exact at 10x",
         NORMALS, 24),
    Goal("one call with its sink, order 4 curve", "Call/curve/order:4/dim:3", (1, 1), "1.5x"),
    Goal("one call with its sink, bicubic", "Call/surface/order:4/dim:3", (3, 3), "5x"),
    Goal("fast mode, bicubic mesh, ring", "Mesh/order:4/dim:3/ring", (60, 90), "75 % of the floor", BICUBIC,
         product=1 / 2.5, side=FAST, unit="float_FMA"),
]

PEER_WORK = [
    ("order 4, dim 3", "Curve/order:4/dim:3"),
    ("order 4, dim 4", "Curve/order:4/dim:4"),
    ("order 10, dim 3", "Curve/order:10/dim:3"),
    ("order 30, dim 3", "Curve/order:30/dim:3"),
    ("bicubic, array", "Mesh/order:4/dim:3/array"),
    ("bicubic, ring", "Mesh/order:4/dim:3/ring"),
    ("with normals", "Mesh/order:4/dim:3/normals/ring"),
    ("8 x 8, dim 4", "Mesh/order:8/dim:4/ring"),
    ("30 x 30, dim 4", "Mesh/order:30/dim:4/ring"),
]
PEERS = [
    (HORNER, "float Horner"),
    ("constant_order", "loop, order a constant"),
    (PRODUCT, "Eigen, matrix product"),
    ("OSMesa", "OSMesa, end to end"),
    ("GLU", "GLU, a vertex delivered"),
    ("SISL", "SISL (double)"),
    ("OpenCASCADE", "OpenCASCADE (double)"),
    ("OpenCASCADE_adaptor", "OpenCASCADE, adaptor (double)"),
    ("OpenSubdiv", "OpenSubdiv, same work"),
]

LINE = "points 0..3, order 4"
HARD = [
    ("(1-2u)^3, order 4", "Hard/power/order:4"),
    ("(1-2u)^9, order 10", "Hard/power/order:10"),
    ("(1-2u)^29, order 30", "Hard/power/order:30"),
    ("roots j/30 in (0,1), order 30", "Hard/roots/order:30"),
    ("integers -9..9 at u = i/1024, order 4", "Hard/integers/order:4"),
    (LINE, "Hard/line/order:4"),
    ("points 0..9, order 10", "Hard/line/order:10"),
    ("points 0..29, order 30", "Hard/line/order:30"),
    ("random x 1e6 + 1e6, order 4", "Hard/offset/order:4"),
]


class Model:
    """A line of the table of models: compared with a float loop whose order is a constant, which knows the grid.

    must: so many times what the loop takes, or None. unit: what the numbers are of.
    """

    def __init__(self, words, name, must=None, side=EXACT, loop=LOOP):
        self.words, self.name, self.must, self.side, self.loop = words, name, must, side, loop


WITH_MAP = "production_with_map"
PATCHES = "production_patches"
MODELS = [Model(f"teapot, {n} segments, plan at hand", f"Model/teapot/segments:{n}", must)
          for n, must in ((4, None), (8, 3), (10, None), (16, 3), (32, None), (64, 2))]
MODELS += [Model(f"teapot, {n} segments, with map and plan", f"Model/teapot/segments:{n}", must, WITH_MAP,
                 f"{LOOP}_with_map") for n, must in ((8, 8), (64, None))]
MODELS += [
    Model("10^6 random patches, 7 segments, glevEvaluatePatches", "Patches/million/segments:7"),
    Model("teapot, 8 segments, glevEvaluatePatches", "Model/teapot/segments:8", 8, PATCHES, f"{LOOP}_with_map"),
    Model("teapot, 64 segments, glevEvaluatePatches", "Model/teapot/segments:64", None, PATCHES, f"{LOOP}_with_map"),
    Model("random floats, 8 segments, plan at hand", "Model/random/segments:8"),
    Model("random floats, 64 segments, plan at hand", "Model/random/segments:64"),
    Model("random floats, 7 segments, with map and plan", "Model/random/segments:7", None, WITH_MAP,
          f"{LOOP}_with_map"),
    Model("multiples of 2^-24, 8 segments, plan at hand", "Model/dyadic/segments:8"),
    Model("bilinear random floats, 8 segments, plan at hand", "Model/bilinear/segments:8"),
    Model("teapot, 64 segments, GLEV_FAST, plan at hand", "Model/teapot/segments:64", None, FAST),
]

# Work without a peer, with its limit in ns, or None.
OTHERS = [
    ("Map2, plan and release, bicubic, a plan", "Plan/bicubic", 400),
    ("Map2, plan and release, 64 x 64, a plan", "Plan/order:64", 15000),
    ("MapGrid2, plan and release, a plan", "Plan/grid_alone", 50),
    ("10^6 random patches, 7 segments, glevEvaluatePatches: 2.5 million patches a second", "Patches/million/segments:7",
     6.25),
    ("bicubic mesh, doubles", "Double/mesh", 30),
    ("curve of order 4, scattered arguments, doubles", "Double/curve", 15),
    ("both tangents of a bicubic mesh, floats", "Tangents/float", 8),
    ("both tangents of a bicubic mesh, floats, GLEV_FAST", "Tangents/fast", 2),
    ("both tangents of a bicubic mesh, doubles", "Tangents/double", 60),
    ("glevEvaluate, curve of order 4, one argument", "Batch/count:1", 25),
    ("glevEvaluate, curve of order 4, 8 arguments", "Batch/count:8", 5),
    ("scattered bicubic points", "Scattered/bicubic", None),
    ("scattered bicubic points, GLEV_FAST", "Scattered/fast", 0.5),
    ("EvalMesh2 to a sink, 64 x 64 points", "Sink/mesh", 9),
]


class Results:
    def __init__(self, data):
        self.context = data["context"]
        self.rate = {}  # highest items per second, by name
        errors = {}
        for run in data["benchmarks"]:
            name = run.get("run_name", run["name"])
            if run.get("error_occurred"):
                errors[name] = run["error_message"]
            elif run.get("run_type", "iteration") == "iteration":
                self.rate[name] = max(self.rate.get(name, 0), run["items_per_second"])
        for name, error in errors.items():
            warn(f"{name}: {error}")
        targets = {name.rsplit("/", 1)[1] for name in self.rate if f"/{EXACT}/" in name}
        self.targets = sorted(targets)
        # Highway has several kinds of AVX-512; the table uses the fastest one at meshes.
        self.target = {width: max((t for t in self.targets if t.startswith(FAMILY[width])), default=None,
                                  key=lambda t: self.rate.get(f"Mesh/order:4/dim:3/ring/{EXACT}/{t}", 0))
                       for width in WIDTHS}

    def ns(self, name):
        return 1e9 / self.rate[name] if name in self.rate else None

    def side(self, work, side, width=None):
        return self.ns(f"{work}/{side}" + (f"/{self.target[width]}" if width else ""))

    def best_peer(self, work):
        known = [(self.side(work, side), words) for side, words in PEERS if side != HORNER]
        return min(((ns, words) for ns, words in known if ns), default=None)

    def floor(self, goal, width):
        """ns, and what binds: multiply-adds over the measured peak, or bytes over the measured bandwidth."""
        if not goal.fma:
            return None
        floors = []
        stores = [goal.store, goal.store.replace("store", "stream")]
        for words, kinds, amount in (("FMA", [goal.unit], goal.fma), ("store", stores, goal.size)):
            rates = [rate for name, rate in self.rate.items() for kind in kinds
                     if name.startswith(f"Floor/{kind}/{FAMILY[width]}")]
            if rates:
                floors.append((1e9 * amount / max(rates), words))
        return max(floors, default=None)


def three_digits(x):
    return f"{x:.2f}" if x < 9.995 else f"{x:.1f}" if x < 99.95 else f"{x:.0f}"


def number(ns):
    return "-" if ns is None else three_digits(ns)


def ratio(x):
    if x is None:
        return "-"
    return f"{x:.2f}x" if x < 0.995 else f"{x:.1f}x" if x < 9.95 else f"{x:.0f}x"


def over(a, b):
    return a / b if a and b else None


def line(cells):
    return "| " + " | ".join(cells) + " |"


def head(cells):
    return [line(cells), line(["---"] * len(cells))]


def warn(words):
    print(f"table.py: {words}", file=sys.stderr)


def first_value(file, key, separator):
    with open(file, encoding="utf-8") as lines:
        return next((text.split(separator, 1)[1].strip().strip('"') for text in lines
                     if text.startswith(key)), "unknown")


def environment(context):
    date = datetime.datetime.fromisoformat(context["date"]).astimezone(datetime.timezone.utc).date()
    caches = ", ".join(f"L{c['level']} {c['size'] // 1024} KiB" for c in context["caches"]
                       if c["type"] != "Instruction")
    processor = first_value("/proc/cpuinfo", "model name", ":")
    system = first_value("/etc/os-release", "PRETTY_NAME", "=")
    return f"{date}, one core of {processor} ({caches}), {context['compiler']}, peers as packaged by {system}"


def times(ns, peer):
    return "-" if not ns or not peer else f"{three_digits(ns / peer)}x"


def models(results):
    """The slowest first, compared with the loop."""
    rows = []
    for model in MODELS:
        loop, horner = results.side(model.name, model.loop), results.side(model.name, HORNER)
        cells, worst = [], 0
        for width in WIDTHS:
            ns = results.side(model.name, model.side, width)
            cells.append(f"{number(ns)} ({times(ns, loop)})" if ns else "-")
            worst = max(worst, over(ns, loop) or 0)
            if ns and loop and model.must and ns > model.must * loop:
                warn(f"{model.words}: {width} takes {times(ns, loop)} what the loop takes, may take {model.must}x")
        must = f"{model.must}x" if model.must else "-"
        rows.append((-worst, line([model.words, number(loop), *cells, must, number(horner)])))
    return head(["work", "loop, order a constant", "AVX2", "AVX-512", "must", "float Horner"]) + [
        text for _, text in sorted(rows, key=lambda row: row[0])]


def others(results):
    """Those first that miss most what they may take."""
    rows = []
    for words, work, must in OTHERS:
        cells, worst = [], 0
        for width in WIDTHS:
            ns = results.side(work, EXACT, width)
            cells.append(number(ns))
            worst = max(worst, over(ns, must) or 0)
            if ns and must and ns > must:
                warn(f"{words}: {width} takes {number(ns)} ns, may take {must}")
        rows.append((-worst, line([words, *cells, f"{must}" if must else "-"])))
    return head(["work", "AVX2", "AVX-512", "must"]) + [text for _, text in sorted(rows, key=lambda row: row[0])]


def goals(results):
    lines = head(["work", "float Horner", "AVX2", "AVX-512", "must", "stretch", "matrix product", "best peer",
                  "floor AVX2 / AVX-512"])
    for goal in GOALS:
        horner, product = results.side(goal.name, HORNER), results.side(goal.name, PRODUCT)
        cells, floors = [], []
        for width, must in zip(WIDTHS, goal.must):
            ns, floor = results.side(goal.name, goal.side, width), results.floor(goal, width)
            cells.append(f"{number(ns)} ({ratio(over(horner, ns))})" if ns else "-")
            share = f" ({100 * floor[0] / ns:.0f} %)" if floor and ns else ""
            floors.append(f"{number(floor[0])} {floor[1]}{share}" if floor else "-")
            if ns and must and horner < must * ns:
                warn(f"{goal.words}: {width} has {ratio(horner / ns)}, must be {must}x")
            if ns and goal.product and product and ns > goal.product * product:
                warn(f"{goal.words}: {width} takes {ns / product:.2f} of the matrix product, "
                     f"may take {goal.product:.2f}")
        peer = results.best_peer(goal.name)
        must = " / ".join("-" if m is None else f"{m}x" for m in dict.fromkeys(goal.must))
        if goal.product:
            must += f", {goal.product:.1f} of the product"
        lines.append(line([goal.words, number(horner), *cells, must, goal.stretch, number(product),
                           f"{number(peer[0])} {peer[1]}" if peer else "-",
                           " / ".join(floors) if goal.fma else "-"]))
    return lines


def peers(results):
    rows = PEERS + [(f"{EXACT}/{t}", f"correctly rounded, {t}") for t in results.targets]
    rows += [(f"{FAST}/{t}", f"fast mode, {t}") for t in results.targets]
    lines = head(["side"] + [words for words, _ in PEER_WORK])
    for side, words in rows:
        cells = [number(results.side(work, side)) for _, work in PEER_WORK]
        if any(cell != "-" for cell in cells):
            lines.append(line([words] + cells))
    return lines


def hard(results):
    lines = head(["control points", "float Horner", "AVX2", "AVX-512"])
    for words, work in HARD:
        horner = results.side(work, HORNER)
        cells = [number(horner)]
        for width in WIDTHS:
            ns = results.side(work, EXACT, width)
            cells.append(f"{number(ns)} ({ratio(over(horner, ns))})" if ns else "-")
            if ns and words == LINE and ns > 4 * horner:
                warn(f"{words}: {width} takes {ns / horner:.1f} times as long as float Horner, may take 4")
        lines.append(line([words] + cells))
    return lines


def where(results):
    wide = results.target["AVX-512"]
    return environment(results.context) + "." + (f" AVX-512 is what Highway calls {wide}." if wide else "")


def model_tables(results):
    words = (f"{where(results)} Times are in ns per point, with the ratio to the time of the loop in brackets; the rows are "
             "sorted by this ratio.")
    other_words = "Other work, in ns per point unless a row says otherwise, sorted by how far the goal is missed:"
    return "\n".join([words, "", *models(results), "", other_words, "", *others(results)]) + "\n"


def peer_tables(results):
    words = (f"{where(results)} Times are in ns per point; in brackets are the speedup over "
             "float Horner and the share of the floor that is reached.")
    hard_words = "Data that is hard to round; all rows but the last have the same polynomial in three components:"
    return "\n".join([words, "", *goals(results), "", "All sides:", "", *peers(results), "", hard_words, "",
                      *hard(results)]) + "\n"


TABLES = {"models": model_tables, "peers": peer_tables}


def measure(program, quick, repetitions, which):
    """The benchmark's JSON. Pinned, so that no measurement moves to another core."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "results.json")
        if not program:
            # Installs prerequisites and builds on all cores.
            subprocess.run([ROOT / "evalcts", "bench", "--benchmark_list_tests"], check=True,
                           stdout=subprocess.DEVNULL)
            program = ROOT / "build/release/harness/benchmarks/evalcts-bench"
        cores = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {max(cores)})
        subprocess.run([program, f"--benchmark_filter={'|'.join(FILTERS[w] for w in which)}",
                        "--benchmark_enable_random_interleaving=true",
                        f"--benchmark_repetitions={repetitions or (2 if quick else 12)}",
                        f"--benchmark_min_time={0.001 if quick else 0.05}",
                        f"--benchmark_out={out}", "--benchmark_out_format=json"],
                       check=True, stdout=subprocess.DEVNULL)
        os.sched_setaffinity(0, cores)
        return json.loads(out.read_text(encoding="utf-8"))


def update(file, which, text):
    """Puts the tables between their marks in the file."""
    first, last = f"<!-- {which} of table.py -->\n", f"<!-- end of {which} -->\n"
    whole = file.read_text(encoding="utf-8")
    before, rest = whole.split(first)
    file.write_text(f"{before}{first}{text}\n{last}{rest.split(last)[1]}", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=list(TABLES), help="these tables alone (default: all)")
    parser.add_argument("--quick", action="store_true", help="a look whether all of it runs")
    parser.add_argument("--repetitions", type=int, help="how often everything is measured (default: 12)")
    parser.add_argument("--program", type=pathlib.Path,
                        help="evalcts-bench (default: as ./evalcts bench builds it)")
    parser.add_argument("--save", type=pathlib.Path, help="where the measurements go, as JSON")
    parser.add_argument("--load", type=pathlib.Path, help="measurements of --save, instead of new ones")
    parser.add_argument("--update", type=pathlib.Path, help="a file: replaces its tables, and prints none")
    options = parser.parse_args()
    which = [options.only] if options.only else list(TABLES)
    data = json.loads(options.load.read_text(encoding="utf-8")) if options.load else measure(
        options.program, options.quick, options.repetitions, which)
    if options.save:
        options.save.write_text(json.dumps(data, indent=1), encoding="utf-8")
    results = Results(data)
    for tables in which:
        text = TABLES[tables](results)
        if options.update:
            update(options.update, tables, text)
        else:
            print(text, end="")


if __name__ == "__main__":
    main()
