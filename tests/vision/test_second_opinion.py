"""A vision model's look at wells that passed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from aegis_ot.vision.gates import GateDecision, GateInput, Gates, OperatorGate, VolumetricGate
from aegis_ot.vision.second_opinion import SecondOpinion, SpotCheck
from aegis_ot.vocabulary import Gate, Outcome, Route
from tests.vision.samples import sample

PASSED = GateDecision(Outcome.PASS, Gate.NONE, "Inside this run's band.")


class Model:
    gate = Gate.VLM
    screens = False

    def __init__(self, outcome: Outcome) -> None:
        self.outcome = outcome
        self.seen: list[GateInput] = []

    @property
    def asked(self) -> int:
        return len(self.seen)

    def examine(self, case: GateInput) -> GateDecision:
        self.seen.append(case)
        return GateDecision(self.outcome, self.gate, "A column is left in picture 4.")


def well(score: float, name: str = "s1", route: Route = Route.SILENT_PASS) -> GateInput:
    return GateInput(sample(name), route, score)


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


MEASURED = GateDecision(
    Outcome.PASS, Gate.VOLUMETRIC, "Above the band. The volumes agree.", None, 0.1, 0.0
)
ROUTED = [Route.GREY_ZONE, Route.ALWAYS_GATE, Route.UNCALIBRATED, Route.BLANK_FLOOR]


@pytest.mark.parametrize("route", ROUTED)
def test_what_the_volumes_alone_cleared_it_sees_without_any_spot_check(route: Route) -> None:
    model = Model(Outcome.FAIL)
    second = SecondOpinion(Gates([VolumetricGate(), model, OperatorGate()]), SpotCheck(share=0.0))
    decision = second.on(well(0.1, route=route), MEASURED, 6, 3.5)
    assert (model.asked, decision.outcome, decision.gate) == (1, Outcome.UNDECIDED, Gate.VLM)
    assert decision.reason == (
        "Above the band. The volumes agree. But a vision model fails it. A column is left in "
        "picture 4."
    )
    assert (decision.measured_ul, decision.expected_ul) == (0.1, 0.0)
    second.on(well(3.0), PASSED, 6, 3.5)
    assert model.asked == 1, "of the silent passes none is wanted"


def test_a_model_that_stands_before_the_volumes_is_not_asked_twice() -> None:
    model = Model(Outcome.FAIL)
    second = SecondOpinion(Gates([model, VolumetricGate(), OperatorGate()]))
    assert second.on(well(9.0, route=Route.GREY_ZONE), MEASURED, 6, 3.5) == MEASURED
    assert not model.asked


@pytest.mark.parametrize("outcome", [Outcome.PASS, Outcome.UNDECIDED])
def test_where_the_model_finds_nothing_the_volumes_word_stands(outcome: Outcome) -> None:
    gates = Gates([VolumetricGate(), Model(outcome), OperatorGate()])
    assert SecondOpinion(gates).on(well(9.0, route=Route.GREY_ZONE), MEASURED, 6, 3.5) == MEASURED


def test_the_model_is_told_which_wells_are_near_the_band() -> None:
    model = Model(Outcome.PASS)
    second = SecondOpinion(Gates([model]), SpotCheck(share=1.0))
    for one in (well(3.0), well(0.1), well(3.0, route=Route.GREY_ZONE)):
        second.on(one, PASSED, 6, 3.5)
    assert [case.near_band for case in model.seen] == [True, False, False]


def test_a_well_that_was_flagged_is_not_its_business_and_without_a_model_nothing_is() -> None:
    model = Model(Outcome.FAIL)
    failed = replace(PASSED, outcome=Outcome.FAIL)
    assert SecondOpinion(Gates([model])).on(well(3.0), failed, 6, 3.5) == failed
    assert not model.asked
    assert SecondOpinion(Gates([OperatorGate()])).on(well(3.0), PASSED, 6, 3.5) == PASSED
