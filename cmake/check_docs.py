"""Checks the documentation: README.md, CONTRIBUTING.md and docs/*.md.
usage: check_docs.py links CHECKOUT
       check_docs.py programs CHECKOUT
       check_docs.py commands CHECKOUT EVALCTS LAYER [PAGE...]

links: every relative link leads to a file and a heading that exist, each page of docs/ begins with a title and one sentence that
answers its question, and README.md has at most 150 lines.

programs: runs each fenced block of `python` that is followed by a `text` block, with CHECKOUT as working directory; the `text` block
must be what the program prints.

commands: runs every fenced block of `sh`, and the lines of `console` blocks that begin with "$ ", in a folder that looks like a
checkout. The blocks of a page share the folder. The examples of docs/help/evalcts*.txt are run as well, except those that name
files which the folder lacks. Options that make a command expensive are replaced (see cheap_arguments). A
comment above a block changes that:
  <!-- not run: KEY -->       the block is not run; KEY is one of NOT_RUN
  <!-- needs: KEY -->         the block is skipped unless the machine has what NEEDS[KEY] looks for
  <!-- exit code: N -->       the exit code of the block, or `any` for 0 or 1; 0 without this comment
  <!-- output -->             the block shows output of a command that is not run
EVALCTS is the built program and LAYER a GL layer over OpenGL ES. Exit code 77: there was nothing to run."""
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

NOT_RUN = {
    "launcher": "commands of the launcher that install, build, package or test: the stages of `./evalcts test --all` run them",
    "faults": "needs the programs with injected faults: the stages faults and legal run it",
    "another Mesa": "needs a Mesa outside the system's directories",
    "deqp-runner": "deqp-runner is not packaged",
    "Slurm": "needs a cluster",
    "last run": "needs the last run, or a failure of it",
    "vectors.check": "takes a minute: the test vectors.check runs it",
    "vectors.lint": "takes seconds: the test vectors.lint runs it",
    "vectors write": "takes 20 seconds: the test vectors.VectorsCommand.WritesTheShippedFiles runs it",
    "another machine": "needs another machine, Wine or QEMU: the stages wine and aarch64-suite run it",
    "CI services": "needs the environment of a CI service",
    "release": "makes a commit and a tag",
    "bisection": "needs the repository of a library: the test harness.CommandLine.ChecksDecideABisection does the same",
    "recording": "needs an application: the tests harness.Record.* and harness.Convert.* do the same",
    "virgl": "needs a server, and takes twenty minutes",
    "gl4es": "needs a build of gl4es",
}
# Examples of docs/help that are not run: patterns of their beginnings, and keys of NOT_RUN.
NOT_RUN_EXAMPLES = {
    "evalcts faults": "faults",
    "(git bisect|evalcts check)": "bisection",
    "evalcts (record|convert)": "recording",
    "evalcts (reproduce|bugs|waive|report --history)": "last run",
    "evalcts vectors lint$": "vectors.lint",
    "evalcts vectors write": "vectors write",
}
NEEDS = {
    "osmesa": lambda machine: "osmesa" in machine.available,
    "lavapipe": lambda machine: os.path.exists("/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"),
    "mpirun": lambda machine: bool(shutil.which("mpirun")),
    "parallel": lambda machine: bool(shutil.which("parallel")),
}
# Pages that a tool writes from data, and that may not have been written yet.
GENERATED = {"docs/known-bugs.md"}
SECONDS_FOR_A_BLOCK = 600  # a few seconds, except on a busy machine


def pages(root):
    return [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]


# --- links -------------------------------------------------------------------------------------------------


def without_code(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


def anchors(text):
    """Returns the anchors that GitHub and GitLab give to the headings of a page."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", without_code(text), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-"))
    return found


def check_links(root):
    complaints = []
    for page in pages(root):
        text = page.read_text()
        name = str(page.relative_to(root))
        for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
            if re.match(r"\w+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.exists():
                if str(file.relative_to(root.resolve())) not in GENERATED:
                    complaints.append(f"{name}: there is no {target}")
            elif anchor and anchor not in anchors(file.read_text()):
                complaints.append(f"{name}: {path or name} has no heading #{anchor}")
        if name.startswith("docs/") and name not in GENERATED:
            opening = re.match(r"# [^\n]+\n\n([^\n]+(?:\n[^\n]+)*)\n\n", text)
            if not opening or not re.search(r"[.:]$", opening[1]):
                complaints.append(f"{name}: does not begin with a title and a paragraph that answers its question")
    lines = len((root / "README.md").read_text().splitlines())
    if lines > 150:
        complaints.append(f"README.md has {lines} lines; 150 are the most")
    return complaints


# --- programs ----------------------------------------------------------------------------------------------


def check_programs(root):
    complaints, ran = [], 0
    for page in pages(root):
        programs = re.findall(r"^```python\n(.*?)^```$(?:(?!^```).)*?^```text\n(.*?)^```$", page.read_text(), re.M | re.S)
        for program, expected in programs:
            ran += 1
            outcome = subprocess.run([sys.executable, "-"], input=program, cwd=root, text=True, stdout=subprocess.PIPE,
                                     stderr=subprocess.STDOUT)
            if outcome.returncode != 0 or outcome.stdout != expected:
                complaints.append(f"{page.relative_to(root)}: a program ends with {outcome.returncode} and prints\n{outcome.stdout}"
                                  f"expected\n{expected}")
    return complaints if ran else ["no page has a Python program with its output"]


# --- commands ----------------------------------------------------------------------------------------------


class Block:
    def __init__(self, page, line, markers, language, text):
        self.page, self.line, self.markers = page, line, markers
        if language == "sh":
            self.script = text
        else:  # the lines after "$ ", with those that they continue on
            commands = re.findall(r"^\$ ((?:.*\\\n)*.*)$", text, re.M)
            self.script = "\n".join(commands) + "\n"


def blocks_of(page):
    """Returns the blocks of sh and console, each with the comments directly above it."""
    found, markers = [], {}
    lines = page.read_text().splitlines()
    i = 0
    while i < len(lines):
        if marker := re.fullmatch(r"<!-- (not run|needs|exit code|output)(?:: (.*))? -->", lines[i]):
            markers[marker[1]] = marker[2]
        elif fence := re.fullmatch(r"```(\w*)", lines[i]):
            end = lines.index("```", i + 1)
            if fence[1] in ("sh", "console"):
                found.append(Block(page, i + 1, markers, fence[1], "\n".join(lines[i + 1:end]) + "\n"))
            markers, i = {}, end
        elif lines[i]:
            markers = {}
        i += 1
    return found


def examples_of(page):
    """Returns the examples of a help text, each as a block. Their exit codes are 0, or 1 if an example finds something."""
    found = []
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if example := re.match(r"  \$ (evalcts .*)", line):
            markers = {"exit code": "any"}
            reason = next((reason for start, reason in NOT_RUN_EXAMPLES.items() if re.match(start, example[1])), None)
            if reason:
                markers["not run"] = reason
            found.append(Block(page, number, markers, "sh", example[1] + "\n"))
    return found


def missing_file(script, folder):
    """Returns a file that a command names and that does not exist, or None."""
    for word in script.split(" #")[0].split():
        if re.match(r"\./|.*\.json$", word) and not (folder / word).exists():
            return word
    return None


class Machine:
    def __init__(self, program):
        listed = subprocess.run([program, "list", "implementations"], capture_output=True, text=True, check=True).stdout
        self.available = set(re.findall(r"^(\S+) +available", listed, re.M))
        listed = subprocess.run([program, "list", "tests", "--json"], capture_output=True, text=True, check=True).stdout
        # The tests of quick depth first, because cheap_arguments() takes the first ones.
        self.tests = [test["name"] for test in sorted(json.loads(listed)["tests"], key=lambda test: test["from"] != "quick")]


def reason_to_skip(block, machine):
    """Returns the reason why the block is not run on this machine, or None. Raises KeyError for an unknown marker."""
    if "output" in block.markers:
        return ""
    if "not run" in block.markers:
        return NOT_RUN[block.markers["not run"]]
    if "needs" in block.markers and not NEEDS[block.markers["needs"]](machine):
        return f"this machine lacks {block.markers['needs']}"
    known = {"osmesa", "egl", "glx", "glx-indirect", "dropin", "dropin-egl", "dropin-glx"}
    for name in set(re.findall(r"--implementation (\S+)", block.script)) & known - machine.available:
        return f"the implementation {name} is not available"
    return None


def chosen(tests, pattern):
    """Returns the tests that a filter in GoogleTest's syntax selects."""
    positive, _, negative = pattern.partition(":-") if not pattern.startswith("-") else ("*", "", pattern[1:])
    return [name for name in tests if any(fnmatch.fnmatchcase(name, one) for one in positive.split(":"))
            and not any(fnmatch.fnmatchcase(name, one) for one in negative.split(":") if one)]


def cheap_arguments(arguments, tests):
    """Returns a command with the same options and less to do. Ends the program if a filter selects no test."""
    if not arguments or "--help" in arguments:
        return arguments
    command, rest = arguments[0], list(arguments[1:])

    def value_of(option):
        for i, argument in enumerate(rest):
            if argument == option:
                return rest[i + 1]
            if argument.startswith(option + "="):
                return argument.partition("=")[2]
        return None

    def replace(option, value):
        if value_of(option) is None:
            rest.extend([option, value])
        elif option in rest:
            rest[rest.index(option) + 1] = value
        else:
            rest[rest.index(f"{option}={value_of(option)}")] = f"{option}={value}"

    def default(option, value):
        if value_of(option) is None:
            rest.extend([option, value])

    if command == "run":
        # Tests without a capture are the cheapest. A baseline is written only if something fails, as this test does on Mesa.
        usual = "Evaluation.NothingWithoutVertexMap/*" if "--write-baseline" in rest else "GetMap.AnyTextureUnit/*"
        names = chosen(tests, value_of("--filter") or usual)
        if not names:
            sys.exit(f"no test matches {value_of('--filter')}")
        replace("--filter", ":".join(names[:4]))
        default("--depth", "quick")
        default("--jobs", "1")
    elif command == "fuzz":
        if "--seconds" in rest:  # a fixed number of programs, because a busy machine runs few in a second
            rest[rest.index("--seconds"):rest.index("--seconds") + 2] = []
        replace("--programs", "2")
        rest.append("--allow-unobserved")
        default("--jobs", "1")
    elif command == "ulp" and value_of("--at") is None:
        replace("--values", "100")
    elif command in ("test", "bench", "package", "faults"):
        sys.exit(f"'{command}' takes long: mark the block with <!-- not run: ... -->")
    return [command, *rest]


def library(name):
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True).stdout
    found = re.search(rf"^\s*{re.escape(name)} .*=> (.*)$", listed, re.M)
    return found[1] if found else None


def make_folder(folder, root, program, layer, tests):
    """Fills the folder so that it looks like a checkout with a build and has the libraries that the pages name."""
    for entry in root.iterdir():
        if entry.name not in ("build", "evalcts", "reports", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "reports").mkdir()
    (folder / "build/release/harness").mkdir(parents=True)
    (folder / "build/release/harness/cli").symlink_to(program.parent)
    (folder / "build/release/production").symlink_to(program.parents[2] / "production")
    for name in ("libEGL.so.1", "libGL.so.1", "libOSMesa.so.8"):
        if found := library(name):
            (folder / name).symlink_to(found)
    (folder / "liblayer.so").symlink_to(layer)
    (folder / "tests.json").write_text(json.dumps(tests))
    launcher = folder / "evalcts"
    launcher.write_text(f"#!/bin/sh\nexec python3 '{pathlib.Path(__file__).resolve()}' as-evalcts '{folder}/tests.json' "
                        f"'{program}' \"$@\"\n")
    launcher.chmod(0o755)


def run_block(block, folder):
    """Runs a block; returns a text with its time and exit code, and a complaint or None."""
    expected = block.markers.get("exit code", "0")
    start = time.monotonic()
    try:
        outcome = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", block.script], cwd=folder, text=True, timeout=SECONDS_FOR_A_BLOCK,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 env=os.environ | {"NO_COLOR": "1", "EVALCTS_OUTPUT": str(folder / "reports/out"),
                                                   "PATH": f"{folder}:{os.environ['PATH']}", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                                                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                                   "OMPI_MCA_rmaps_base_oversubscribe": "1",  # until Open MPI 4
                                                   "PRTE_MCA_rmaps_default_mapping_policy": ":OVERSUBSCRIBE"})  # from Open MPI 5 on
    except subprocess.TimeoutExpired:
        return "  no end", f"did not end within {SECONDS_FOR_A_BLOCK} s"
    words = f"  {time.monotonic() - start:5.1f} s  exit code {outcome.returncode}"
    if str(outcome.returncode) == expected or expected == "any" and outcome.returncode in (0, 1):
        return words, None
    return words, f"exit code {outcome.returncode}, expected {expected}; the end of its output:\n" + outcome.stdout[-3000:]


def check_page(page, root, program, layer, machine):
    """Runs the blocks of a page; returns the complaints, a line for each block, and the number of blocks that were run."""
    complaints, lines, ran = [], [], 0
    with tempfile.TemporaryDirectory(prefix="evalcts-docs-") as folder:
        folder = pathlib.Path(folder)
        make_folder(folder, root, program, layer, machine.tests)
        for block in examples_of(page) if page.suffix == ".txt" else blocks_of(page):
            place = f"{page.relative_to(root)}:{block.line}"
            try:
                reason = reason_to_skip(block, machine)
            except KeyError as unknown:
                complaints.append(f"{place}: unknown marker {unknown}; cmake/check_docs.py lists them")
                continue
            if reason is None and page.suffix == ".txt" and (file := missing_file(block.script, folder)):
                reason = f"there is no {file}"
            if reason is not None:
                if reason:
                    lines.append(f"{place}: not run: {reason}")
                continue
            ran += 1
            if not block.script.strip():
                complaints.append(f"{place}: has no command; mark it with <!-- output -->")
                continue
            lines.append(f"{place}: {block.script.strip().splitlines()[0]}")
            outcome, complaint = run_block(block, folder)
            lines.append(outcome)
            if complaint:
                complaints.append(f"{place}: {complaint}")
    return complaints, lines, ran


def check_commands(root, program, layer, only):
    machine = Machine(program)
    chosen_pages = [page for page in pages(root) + sorted((root / "docs/help").glob("evalcts*.txt")) if not only or page.name in only]
    complaints, ran = [], 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found, lines, number in pool.map(lambda page: check_page(page, root, program, layer, machine), chosen_pages):
            print("\n".join(lines), flush=True)
            complaints += found
            ran += number
    print(f"{ran} blocks were run")
    return complaints, ran


def main():
    if sys.argv[1] == "as-evalcts":
        tests, program = json.loads(pathlib.Path(sys.argv[2]).read_text()), sys.argv[3]
        os.execv(program, [program, *cheap_arguments(sys.argv[4:], tests)])
    root = pathlib.Path(sys.argv[2]).resolve()
    ran = 1
    if sys.argv[1] == "links":
        complaints = check_links(root)
    elif sys.argv[1] == "programs":
        complaints = check_programs(root)
    else:
        complaints, ran = check_commands(root, pathlib.Path(sys.argv[3]).resolve(), pathlib.Path(sys.argv[4]).resolve(), sys.argv[5:])
    print("\n".join(complaints))
    return 1 if complaints else 0 if ran else 77


if __name__ == "__main__":
    sys.exit(main())
