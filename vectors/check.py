#!/usr/bin/env python3
"""Recomputes every number of the vector files from their inputs.

    python3 check.py [--jobs N] [--quiet] [FILE]...         default: all *.json next to this program

Exit code: 0 all agree, 1 something differs, 2 a file is unreadable or not what INTERPRETING.md describes.
This shares no code with the program that wrote the files: their description is all that it knows.
"""

import argparse
import os
import sys
from pathlib import Path

from checker.files import check_files

# A file that is wrong in one way is wrong in thousands of places.
SHOWN = 40


def main(arguments=None):
    parser = argparse.ArgumentParser(description="recomputes every number of the vector files")
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE",
                        help="default: all *.json next to this program")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N",
                        help="processes (default: all cores)")
    parser.add_argument("--quiet", action="store_true", help="no line for files that agree")
    parser.add_argument("--all", action="store_true", help=f"every difference, not {SHOWN} a file")
    options = parser.parse_args(arguments)
    paths = options.files or sorted(Path(__file__).parent.glob("*.json"))
    if not paths:
        print("check.py: no files", file=sys.stderr)
        return 2
    code = 0
    for file in check_files(paths, max(1, options.jobs or 1)):
        problems = file.malformed + file.differences
        for message in problems if options.all else problems[:SHOWN]:
            print(f"{file.path}: {message}", file=sys.stderr)
        if len(problems) > SHOWN and not options.all:
            print(f"{file.path}: and {len(problems) - SHOWN} more", file=sys.stderr)
        if problems or not options.quiet:
            counts = ((len(file.cases), "cases"), (file.numbers, "numbers checked"),
                      (len(file.differences), "differences"), (len(file.malformed), "faults"))
            print(f"{file.path}:", ", ".join(f"{count} {what}" for count, what in counts), flush=True)
        code = max(code, 2 if file.malformed else 1 if file.differences else 0)
    return code


if __name__ == "__main__":
    sys.exit(main())
