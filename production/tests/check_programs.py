#!/usr/bin/env python3
"""Compiles and runs the C programs of a page, and compares what they print with the next text block behind each.

check_programs.py PAGE COUNT LINES COMPILER INCLUDE LIBRARY WORK
COUNT: the number of programs. LINES: the most lines that a program may have.
"""
import pathlib
import re
import subprocess
import sys


def main():
    page, count, lines, compiler, include, library, work = sys.argv[1:]
    text = pathlib.Path(page).read_text(encoding="utf-8")
    programs = re.findall(r"^```c\n(.*?)^```$(?:(?!^```).)*?^```text\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    failures = []
    if len(programs) != int(count) or len(re.findall(r"^```c$", text, re.MULTILINE)) != int(count):
        failures.append(f"{len(programs)} programs with a text block behind them: expected {count}")
    folder = pathlib.Path(work)
    folder.mkdir(parents=True, exist_ok=True)
    for number, (source, expected) in enumerate(programs, 1):
        if source.count("\n") > int(lines):
            failures.append(f"program {number} has {source.count(chr(10))} lines: at most {lines}")
        file, program = folder / f"program{number}.c", folder / f"program{number}"
        file.write_text(source, encoding="utf-8")
        command = [compiler, "-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-DGLEV_STATIC", f"-I{include}",
                   str(file), library, "-lm", "-o", str(program)]
        built = subprocess.run(command, capture_output=True, text=True, check=False)
        if built.returncode != 0:
            failures.append(f"program {number} does not compile:\n{built.stderr}")
            continue
        ran = subprocess.run([str(program.resolve())], capture_output=True, text=True, check=False)
        if ran.returncode != 0 or ran.stdout != expected:
            failures.append(f"program {number} ends with {ran.returncode} and prints\n{ran.stdout}expected\n{expected}")
    print("\n".join(failures) or f"{len(programs)} programs")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
