#!/usr/bin/env python3
"""The named theme detects each wrong evaluator and each wrong state machine; no theme rejects the correct ones.

detections.json, which record_detections.py writes, records the case and the test of the suite that detect each.
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


@lru_cache(None)
def cases_of(kind):
    return json.loads((VECTORS / f"{kind}.json").read_text())["cases"]


@lru_cache(None)
def theme(name):
    kind, flag = name.split(".")
    return [case for case in cases_of(kind) if case["flags"][0] == flag]


def themes_of(table):
    return sorted({name for name, _ in table.values()})


def first_detected(kind, entry):
    """Returns the first case of the named theme that detects a wrong evaluator or state machine, or None."""
    where, methods = entry
    if kind == "evaluator":
        evaluator = evaluator_of(methods)
        return next((case for case in theme(where) if wrong_evaluator(evaluator, case)), None)
    machine = machine_of(methods)
    return next((case for case in theme(where) if wrong_state_machine(machine, case)), None)


class WrongOnes(unittest.TestCase):
    def check(self, kind, table):
        detections = json.loads(RECORD.read_text())
        recorded = {name.partition(": ")[2] for name in detections if name.startswith(kind)}
        self.assertEqual(recorded, set(table), "the record is not complete: run record_detections.py")
        for name, entry in table.items():
            with self.subTest(name):
                case = first_detected(kind, entry)
                self.assertIsNotNone(case, entry[0])
                self.assertEqual(detections[f"{kind}: {name}"]["vectors"], case["id"])

    def test_evaluators(self):
        self.check("evaluator", WRONG_EVALUATORS)

    def test_state_machines(self):
        self.check("state machine", WRONG_STATE_MACHINES)


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
        for where in themes_of(WRONG_EVALUATORS):
            for case in theme(where):
                self.assertEqual(wrong_evaluator(Evaluator(), case), "", case["id"])

    def test_state_machine(self):
        for where in themes_of(WRONG_STATE_MACHINES):
            for case in theme(where):
                self.assertEqual(wrong_state_machine(Machine, case), "", case["id"])


if __name__ == "__main__":
    unittest.main()
