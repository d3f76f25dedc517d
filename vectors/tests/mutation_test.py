#!/usr/bin/env python3
"""The vectors detect each wrong evaluator and each wrong state machine, and do not reject the correct ones.

detections.json records the first case that detects each; for an evaluator, the first one of its theme. With --write, this program
writes the file.
"""

import json
import sys
import unittest
from functools import lru_cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from correct_implementations import Evaluator, Machine, wrong_evaluator, wrong_state_machine
from wrong_evaluators import WRONG_EVALUATORS, evaluator_of
from wrong_state_machines import WRONG_STATE_MACHINES, machine_of

VECTORS = Path(__file__).resolve().parent.parent
RECORD = Path(__file__).resolve().with_name("detections.json")
TABLES = {"evaluator": WRONG_EVALUATORS, "state machine": WRONG_STATE_MACHINES}


@lru_cache(None)
def cases_of(kind):
    return json.loads((VECTORS / f"{kind}.json").read_text())["cases"]


@lru_cache(None)
def theme(name):
    kind, flag = name.split(".")
    return [case for case in cases_of(kind) if case["flags"][0] == flag]


def sequences():
    return [case for kind in ("errors", "get_map", "state") for case in cases_of(kind)]


def first_detected(kind, entry):
    """Returns the first case that detects a wrong evaluator (a case of its theme) or state machine, or None."""
    if kind == "evaluator":
        where, methods = entry
        evaluator = evaluator_of(methods)
        return next((case for case in theme(where) if wrong_evaluator(evaluator, case)), None)
    machine = machine_of(entry)
    return next((case for case in sequences() if wrong_state_machine(machine, case)), None)


class WrongOnes(unittest.TestCase):
    def recorded(self, kind, table):
        """Returns the ids of the recorded cases by name."""
        detections = json.loads(RECORD.read_text())
        found = {name.partition(": ")[2]: case for name, case in detections.items() if name.startswith(kind)}
        self.assertEqual(set(found), set(table), "the record is not complete: run mutation_test.py --write")
        return found

    def test_evaluators(self):
        recorded = self.recorded("evaluator", WRONG_EVALUATORS)
        for name, entry in WRONG_EVALUATORS.items():
            with self.subTest(name):
                case = first_detected("evaluator", entry)
                self.assertIsNotNone(case, entry[0])
                self.assertEqual(recorded[name], case["id"])

    def test_state_machines(self):
        recorded = self.recorded("state machine", WRONG_STATE_MACHINES)
        by_id = {case["id"]: case for case in sequences()}
        for name, members in WRONG_STATE_MACHINES.items():
            with self.subTest(name):
                self.assertTrue(wrong_state_machine(machine_of(members), by_id[recorded[name]]), recorded[name])


class RightOnes(unittest.TestCase):
    def test_normals_by_either_reading_of_the_derivatives(self):
        """With derivatives by u and v, each reversed direction turns the normal; both interpretations conform."""
        class ByDomain(Evaluator):
            def oriented(self, normal, domain):
                turned = (domain[0] > domain[1]) != (domain[2] > domain[3])
                return [-x for x in normal] if turned else normal
        for case in theme("auto_normal.reversed"):
            for evaluator in (Evaluator(), ByDomain()):
                self.assertEqual(wrong_evaluator(evaluator, case), "", case["id"])

    def test_evaluator(self):
        for where in sorted({name for name, _ in WRONG_EVALUATORS.values()}):
            for case in theme(where):
                self.assertEqual(wrong_evaluator(Evaluator(), case), "", case["id"])

    def test_state_machine(self):
        for case in sequences():
            self.assertEqual(wrong_state_machine(Machine, case), "", case["id"])


def write():
    """Writes the first case that detects each. Raises ValueError if one is not detected."""
    detections = {}
    for kind, table in TABLES.items():
        for name, entry in table.items():
            case = first_detected(kind, entry)
            if not case:
                raise ValueError(f"no case detects the wrong {kind} '{name}'")
            detections[f"{kind}: {name}"] = case["id"]
    RECORD.write_text(json.dumps(detections, indent=1) + "\n")


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write()
    else:
        unittest.main()
