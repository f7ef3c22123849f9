"""The volumetric gate: what contradicts the protocol, what agrees, what cannot be told."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from aegis_ot.vision.gates import GateInput, Gates, OperatorGate, VolumetricGate, in_sentences
from aegis_ot.vision.measuring import ColumnReading
from aegis_ot.vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route

from .samples import sample

FULL = ColumnReading(100.0, 2.0, tested=6)
EMPTY = ColumnReading(0.0, 0.5, tested=6)


def case(
    transit: ColumnReading | None = FULL,
    last: ColumnReading | None = EMPTY,
    route: Route = Route.GREY_ZONE,
    missing: tuple[KeyframeKind, ...] = (),
) -> GateInput:
    readings = {KeyframeKind.TRANSIT: transit, KeyframeKind.POST_DISPENSE: last}
    present = {kind: reading for kind, reading in readings.items() if reading is not None}
    return GateInput(sample(), route, None, present, missing)


@pytest.mark.parametrize(
    ("transit", "last", "failure"),
    [
        (FULL, ColumnReading(50.0, 2.0), FailureType.PARTIAL_DISPENSE),
        (FULL, ColumnReading(98.0, 2.0), FailureType.NO_DISPENSE),
        (ColumnReading(0.0, 1.0), EMPTY, FailureType.NO_ASPIRATE),
        (ColumnReading(60.0, 2.0), EMPTY, FailureType.OTHER),
        (ColumnReading(140.0, 2.0), EMPTY, FailureType.PARTIAL_DISPENSE),
    ],
)
def test_contradictions_fail_with_a_name(transit, last, failure) -> None:
    decision = VolumetricGate().examine(case(transit, last))
    assert decision.outcome is Outcome.FAIL
    assert decision.failure is failure
    assert decision.reason


def test_agreement_passes_and_says_what_was_measured() -> None:
    decision = VolumetricGate().examine(case())
    assert decision.outcome is Outcome.PASS
    assert decision.measured_ul == 0
    assert decision.expected_ul == 0


def test_differences_within_the_uncertainty_do_not_fail() -> None:
    decision = VolumetricGate().examine(case(FULL, ColumnReading(10.0, 4.0)))
    assert decision.outcome is Outcome.PASS


@pytest.mark.parametrize(
    "seen",
    [case(None, None), case(FULL, None), case(ColumnReading(100, 40.0, tested=6), EMPTY)],
)
def test_what_cannot_be_measured_is_undecided(seen: GateInput) -> None:
    assert VolumetricGate().examine(seen).outcome is Outcome.UNDECIDED


def test_a_liquid_that_hardly_shows_passes_with_a_caveat_only_if_drawn_as_expected() -> None:
    vague = ColumnReading(0.0, math.inf, vague=True)
    decision = VolumetricGate().examine(case(FULL, vague))
    assert decision.outcome is Outcome.PASS
    assert decision.measured_ul is None
    assert "hardly shows" in decision.reason
    assert VolumetricGate().examine(case(None, vague)).outcome is Outcome.UNDECIDED


def test_no_tip_where_it_hangs_free_fails() -> None:
    both = (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
    decision = VolumetricGate().examine(case(None, None, missing=both))
    assert decision.failure is FailureType.NO_TIP


def test_where_tips_are_hardly_to_be_seen_none_is_no_proof() -> None:
    both = (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
    seen = replace(case(None, None, missing=both), clearly_absent=False)
    assert VolumetricGate().examine(seen).outcome is Outcome.UNDECIDED


def test_calibration_wells_fail_for_gross_mismatches_only() -> None:
    slight = case(FULL, ColumnReading(16.0, 2.0), Route.CALIBRATION)
    gross = case(FULL, ColumnReading(80.0, 2.0), Route.CALIBRATION)
    assert VolumetricGate().examine(slight).outcome is not Outcome.FAIL
    assert VolumetricGate().examine(gross).outcome is Outcome.FAIL


def test_agreeing_volumes_do_not_explain_away_a_very_unusual_tip() -> None:
    assert VolumetricGate().examine(replace(case(), p_value=0.04)).outcome is Outcome.PASS
    decision = VolumetricGate().examine(replace(case(), p_value=1e-5))
    assert decision.outcome is Outcome.UNDECIDED
    assert "unusual" in decision.reason


def test_an_unusual_tip_is_asked_about_though_its_column_cannot_be_measured() -> None:
    blind = replace(case(None, None), p_value=1e-5)
    assert VolumetricGate().examine(blind).outcome is Outcome.UNDECIDED


def test_in_a_long_run_an_image_score_alone_stops_nothing_that_happens_by_chance() -> None:
    decision = VolumetricGate().examine(replace(case(None, None), p_value=0.01))
    assert decision.outcome is Outcome.PASS
    assert "cannot be measured" in decision.reason


def test_an_unusual_tip_that_seems_to_hold_some_liquid_is_asked_about() -> None:
    """Two weak signs of one thing: neither alone stops anything."""
    for reading in (replace(EMPTY, excess=2.5), ColumnReading(0.0, 9.0, vague=True, excess=2.5)):
        seen = case(FULL, reading)
        decision = VolumetricGate().examine(replace(seen, p_value=0.01))
        assert decision.outcome is Outcome.UNDECIDED
        assert "as if liquid were left" in decision.reason
        assert VolumetricGate().examine(replace(seen, p_value=0.2)).outcome is Outcome.PASS
    leaning = case(FULL, replace(EMPTY, excess=1.5))
    assert VolumetricGate().examine(replace(leaning, p_value=0.01)).outcome is Outcome.PASS


def test_agreement_of_untested_readings_is_no_proof() -> None:
    untested = case(ColumnReading(100.0, 2.0), ColumnReading(0.0, 0.5))
    assert VolumetricGate().examine(untested).outcome is Outcome.UNDECIDED


def test_a_calibration_wells_column_of_another_height_proves_little_an_empty_tip_much() -> None:
    for seen, outcome in ((60.0, Outcome.PASS), (5.0, Outcome.FAIL)):
        reading = ColumnReading(seen, 2.0, tested=4)
        first = replace(case(reading, EMPTY, Route.CALIBRATION), p_value=1.0)
        assert VolumetricGate().examine(first).outcome is outcome


def test_gates_are_asked_in_turn_until_one_decides() -> None:
    gates = [VolumetricGate(), OperatorGate()]
    assert Gates(gates).confirm(case()).gate is Gate.VOLUMETRIC
    blind = Gates(gates).confirm(case(None, None))
    assert blind.outcome is Outcome.UNDECIDED
    assert blind.gate is Gate.OPERATOR
    assert Gates([]).confirm(case()).outcome is Outcome.UNDECIDED


def test_a_model_counts_as_not_asked_only_if_it_stands_after_the_gate_that_decided() -> None:
    class Model(OperatorGate):
        gate = Gate.VLM

    volumes, model, operator = VolumetricGate(), Model(), OperatorGate()
    assert Gates([volumes, model, operator]).model_after(Gate.VOLUMETRIC) is model
    assert Gates([model, volumes, operator]).model_after(Gate.VOLUMETRIC) is None
    assert Gates([model, volumes]).model_after(Gate.NONE) is model
    assert Gates([volumes, operator]).model_after(Gate.NONE) is None


def test_no_reason_is_said_twice() -> None:
    odd, look = "The tip looks odd.", "Please look at it."
    assert in_sentences(odd, odd) == odd
    assert in_sentences(odd, f"{odd} {look}") == f"{odd} {look}"
    assert in_sentences("", odd, look) == f"{odd} {look}"
