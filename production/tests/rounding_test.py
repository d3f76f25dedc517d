"""Tests the program glevaluator_rounding: its results, its shards and their merge, its messages and exit codes.
usage: rounding_test.py PROGRAM MUTATED_PROGRAM MUTATIONS
MUTATED_PROGRAM is the same program with the mutated library, or empty; MUTATIONS is mutations.json."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MUTATED, MUTATIONS = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1)
CHECK = ["check", "--values", "3000", "--filter", "*/4*/ordinary"]


def run(*arguments, program=PROGRAM, mutation=0):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True,
                          env=os.environ | {"GLEV_MUTATION": str(mutation)})


class Rounding(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def shards(self, count, *task, **how):
        """Runs all shards of a task, and returns their files."""
        files = [self.folder / f"{k}.json" for k in range(1, count + 1)]
        for k, file in enumerate(files, 1):
            file.write_text(run(*task, "--shard", f"{k}/{count}", **how).stdout)
        return files

    def expect_rejected(self, message, *arguments):
        outcome = run(*arguments)
        self.assertEqual(outcome.returncode, 2, arguments)
        self.assertEqual(outcome.stdout, "")
        self.assertIn(message, outcome.stderr)

    def test_digest_is_the_same_on_every_instruction_set(self):
        # This number may change only if the generator of inputs changes.
        targets = json.loads(run("digest", "--values", 1).stdout)["task"]["targets"]
        for target in targets:
            outcome = run("digest", "--values", 100000, "--target", target)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            self.assertEqual(json.loads(outcome.stdout)["results"]["digest"],
                             {"digest": "29484933260707d9", "values": 100000, "wrong": 0}, target)
        other = json.loads(run("digest", "--values", 100000, "--seed", 2).stdout)
        self.assertNotEqual(other["results"]["digest"]["digest"], "29484933260707d9")

    def test_merged_shards_are_the_whole_task(self):
        for task in (CHECK, ["digest", "--values", "10001"],
                     ["sweep", "--filter", "curve/4/[ow]*", "--from", "-0x1p-140", "--to", "0x1p-130"]):
            whole = run(*task)
            self.assertEqual(whole.returncode, 0, whole.stderr)
            merged = run("merge", *reversed(self.shards(3, *task)))
            self.assertEqual((merged.returncode, merged.stdout), (0, whole.stdout), merged.stderr)
        # The last task: 2^9 floats from -2^-140 up to -2^-149, zero, and 2^19 floats; 1 to 4 components.
        for name, result in json.loads(whole.stdout)["results"].items():
            self.assertIn(result["values"] / (2**9 + 1 + 2**19), (1, 2, 3, 4), name)

    def test_lost_and_repeated_shards_are_named(self):
        one, two, three = files = self.shards(3, *CHECK)
        self.expect_rejected("shards are missing: 1/3 3/3", "merge", two)
        self.expect_rejected(f"{two} and {two} are both shard 2", "merge", one, two, two, three)
        other = self.folder / "other.json"
        other.write_text(run(*CHECK, "--seed", 2, "--shard", "3/3").stdout)
        self.expect_rejected(f"{other} has the task", "merge", one, two, other)
        text = three.read_text()
        for wrong in ("", text[:-20], "[]", text.replace('"shard": 3', '"shard": "3"'), text.replace('"wrong"', '"w"')):
            three.write_text(wrong)
            self.expect_rejected(f"{three}: is not the result of a shard that has ended", "merge", *files)
        three.write_text(text.replace("rounding-1", "rounding-9"))
        self.expect_rejected("its format is not glevaluator-rounding-1", "merge", *files)
        self.expect_rejected("no-such-file", "merge", "no-such-file")

    def test_wrong_use_is_rejected(self):
        for arguments in ([], ["nonsense"], ["check", "--values", 0], ["check", "--values", -1], ["merge"],
                          ["check", "--shard", "0/2"], ["check", "--shard", "3/2"], ["check", "--shard", "1/2x"],
                          ["digest", "--filter", "x"], ["sweep", "--to", "nan"], ["sweep", "--from", 1, "--to", 0]):
            self.expect_rejected("", *arguments)
        self.expect_rejected("no instruction set nonsense", "check", "--target", "nonsense")
        self.expect_rejected("matches no class", "check", "--filter", "nonsense")
        self.expect_rejected("matches no class", "sweep", "--filter", "surface/*")
        self.assertEqual(run("--help").returncode, 0)

    @unittest.skipUnless(MUTATED, "no mutated library")
    def test_wrong_values_are_found(self):
        names = [mutation["name"] for mutation in json.loads(pathlib.Path(MUTATIONS).read_text())]
        mutated = {"program": MUTATED, "mutation": 1 + names.index("SFromRoundedT")}
        for task in (CHECK, ["check", "--values", "3000", "--filter", "surface/2x2/decimal"]):
            whole = run(*task, **mutated)
            self.assertEqual(whole.returncode, 1)
            self.assertRegex(whole.stderr, r": expected .*0x.*, got .*0x.* control points .*0x")
            merged = run("merge", *self.shards(4, *task, **mutated))
            self.assertEqual((merged.returncode, merged.stdout), (1, whole.stdout))
        self.assertEqual(run(*CHECK, program=MUTATED).returncode, 0)


if __name__ == "__main__":
    unittest.main()
