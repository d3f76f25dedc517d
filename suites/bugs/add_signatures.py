#!/usr/bin/env python3
"""Adds the failing cases of runs to the signatures of a product, so that they are known from then on. Look at the
failures first. Signatures that no run has any more are harmless; to remove those of a function, delete its line before
the runs are added.

usage: add_signatures.py PRODUCT.signatures.json results-NAME.json...
"""
import json
import pathlib
import sys


def fnv1a(text):
    value = 0xcbf29ce484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return value


def signature(test):
    """As TestRecord::signature()."""
    mismatches = sorted(test.get("mismatches", []))
    return test.get("signature_of_all") or \
        f"{len(mismatches)}-{fnv1a(''.join(identity + chr(10) for identity in mismatches)):016x}"


def main(path, *results):
    known = {function: set(text.split()) for function, text in json.loads(path.read_text()).items()}
    for result in map(json.loads, (pathlib.Path(name).read_text() for name in results)):
        if result["depth"] == "thorough" or result["seed"] != 1:
            sys.exit("only runs of quick or full depth with seed 1 are compared by signatures")
        for test in result["tests"]:
            if test["verdict"] == "fail" and "also_in_fresh_context" not in test and \
                    not test["baseline_reason"].startswith("flaky"):
                known.setdefault(test["name"].split("/")[0], set()).add(signature(test))

    def by_number(text):
        return int(text.split("-")[0]), text

    lines = (f' "{function}": "{" ".join(sorted(known[function], key=by_number))}"' for function in sorted(known))
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), *sys.argv[2:])
