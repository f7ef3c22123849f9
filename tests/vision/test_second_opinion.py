"""A vision model's look at wells that nothing flagged."""

from __future__ import annotations

from dataclasses import replace

import pytest

from aegis_ot.vision.gates import Case, GateDecision, Gates, OperatorGate
from aegis_ot.vision.second_opinion import SecondOpinion, SpotCheck
from aegis_ot.vocabulary import Gate, Outcome, Route
from tests.vision.samples import sample

PASSED = GateDecision(Outcome.PASS, Gate.NONE, "Inside this run's band.")


class Model:
    gate = Gate.VLM
    screens = False

    def __init__(self, outcome: Outcome) -> None:
        self.outcome, self.asked = outcome, 0

    def examine(self, case: Case) -> GateDecision:
        self.asked += 1
        return GateDecision(self.outcome, self.gate, "A column is left in picture 4.")


def well(score: float, name: str = "s1", route: Route = Route.SILENT_PASS) -> Case:
    return Case(sample(name), route, score)


def test_it_sees_wells_near_the_band_first_wells_and_a_share_of_the_others() -> None:
    model = Model(Outcome.PASS)
    second = SecondOpinion(Gates([OperatorGate(), model]), SpotCheck(share=0.2))
    second.on(well(3.0), PASSED, 6, 3.5)
    assert model.asked == 1, "near the band"
    first = well(0.5, route=Route.CALIBRATION)
    for number in (1, 2, 3):
        second.on(first, PASSED, number, None)
    assert model.asked == 3, "two first wells"
    for number in range(200):
        second.on(well(0.1, f"run-{number}"), PASSED, 6, 3.5)
    assert 23 < model.asked < 63, "a fifth of two hundred"


@pytest.mark.parametrize("outcome", [Outcome.PASS, Outcome.UNDECIDED])
def test_only_a_fail_is_heard(outcome: Outcome) -> None:
    assert SecondOpinion(Gates([Model(outcome)])).on(well(3.0), PASSED, 6, 3.5) == PASSED


def test_alone_it_asks_the_operator() -> None:
    decision = SecondOpinion(Gates([Model(Outcome.FAIL)])).on(well(3.0), PASSED, 6, 3.5)
    assert decision.outcome is Outcome.UNDECIDED
    assert "column is left" in decision.reason


def test_a_well_that_was_flagged_is_not_its_business_and_without_a_model_nothing_is() -> None:
    model = Model(Outcome.FAIL)
    failed = replace(PASSED, outcome=Outcome.FAIL)
    assert SecondOpinion(Gates([model])).on(well(3.0), failed, 6, 3.5) == failed
    assert not model.asked
    assert SecondOpinion(Gates([OperatorGate()])).on(well(3.0), PASSED, 6, 3.5) == PASSED
