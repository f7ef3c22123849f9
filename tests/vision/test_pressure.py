"""What the pipette's pressure sensor says of the source, weighed against the frames."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.sidecar.decisions import effective
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.delivery import Delivery, Shown
from aegis_ot.vision.gates import GateDecision
from aegis_ot.vision.pressure import weighed
from aegis_ot.vision.run_analyser_factory import RunAnalyserFactory
from aegis_ot.vocabulary import ChannelOutcome, FailureType, Gate, Keyframe, Outcome

from .test_run_analyser_factory import Told, judge_run, keyframes

LAST = list(keyframes(1))[-1]
PASSED = GateDecision(Outcome.PASS, Gate.VOLUMETRIC, "Inside this run's band.")
NONE_FOUND = "The pipette's pressure sensor found no liquid in A1 before the aspirate"
LOOK = "found liquid in A1 before the aspirate, though: look for a clogged or loose tip."


def probed(found: bool | None) -> Keyframe:
    return replace(LAST, liquid_found=found)


def failed(failure: FailureType) -> GateDecision:
    return GateDecision(Outcome.FAIL, Gate.VOLUMETRIC, "It failed.", failure)


def test_what_was_not_asked_changes_nothing() -> None:
    for decision in (PASSED, failed(FailureType.NO_ASPIRATE)):
        assert weighed(decision, LAST, None) == decision


@pytest.mark.parametrize("failure", FailureType)
def test_liquid_that_was_found_points_to_the_tip_where_none_was_drawn(
    failure: FailureType,
) -> None:
    told = weighed(failed(failure), probed(True), None)
    assert (told.outcome, told.failure) == (Outcome.FAIL, failure)
    assert (LOOK in told.reason) == (failure is FailureType.NO_ASPIRATE)
    assert weighed(PASSED, probed(True), None) == PASSED


@pytest.mark.parametrize("shown", [*Shown, None])
def test_only_a_column_that_is_seen_to_leave_speaks_against_no_liquid(shown: Shown | None) -> None:
    delivery = None if shown is None else Delivery(shown)
    told = weighed(PASSED, probed(False), delivery)
    assert told.outcome is (Outcome.PASS if shown is Shown.EMPTIED else Outcome.UNDECIDED)
    assert told.gate is (PASSED.gate if shown is Shown.EMPTIED else Gate.OPERATOR)
    assert NONE_FOUND in told.reason


@pytest.mark.parametrize("failure", FailureType)
def test_no_liquid_says_which_of_two_failures_it_was_and_takes_none_away(
    failure: FailureType,
) -> None:
    told = weighed(failed(failure), probed(False), Delivery(Shown.NOTHING))
    settled = failure if failure is not FailureType.OTHER else FailureType.NO_ASPIRATE
    assert (told.outcome, told.failure) == (Outcome.FAIL, settled)
    assert told.reason == f"It failed. {NONE_FOUND}."
    unsettled = weighed(failed(failure), probed(False), Delivery(Shown.LEFT))
    assert unsettled.failure is failure


def test_a_first_well_that_shows_nothing_is_asked_about_all_the_same() -> None:
    (asked, _), (plain, _) = (
        judge_run(1, reagent="water", seed=1, probed=found)[0] for found in ({0: True}, {})
    )
    assert asked.outcome is plain.outcome is Outcome.UNDECIDED
    assert "found some in A1: a clogged or loose tip drew none, none was dispensed" in asked.reason
    assert "sensor" not in plain.reason


def test_in_a_run_no_liquid_is_never_passed_over_in_silence() -> None:
    """After the operator's word on the first well, clear wells pass; not where none was found."""
    judged = judge_run(8, reagent="water", seed=2, operator=True, probed={4: False, 5: True})
    outcomes = [verdict.outcome for verdict, _ in judged]
    assert [n for n, one in enumerate(outcomes) if one is Outcome.UNDECIDED] == [0, 4]
    assert judged[4][0].gate is Gate.OPERATOR
    assert judged[4][0].reason.startswith(NONE_FOUND)


def test_who_goes_on_where_none_was_found_vouches_for_nothing() -> None:
    """The source was filled, perhaps: the first well that may count is still asked about."""
    judged = judge_run(4, reagent="water", seed=1, operator=True, probed={0: False})
    assert [verdict.outcome for verdict, _ in judged] == [
        Outcome.UNDECIDED, Outcome.UNDECIDED, Outcome.PASS, Outcome.PASS
    ]  # fmt: skip
    assert "Calibration well 2" in judged[2][0].reason


def test_in_a_run_the_sensor_stands_beside_what_the_frames_show() -> None:
    faults = ("no_aspirate@#4", "no_aspirate@#5")
    judged = judge_run(7, faults, seed=1, probed={3: True, 4: False, 5: False, 6: True})
    verdicts = [verdict for verdict, _ in judged]
    assert [one.outcome for one in verdicts[3:]] == [
        Outcome.FAIL, Outcome.FAIL, Outcome.PASS, Outcome.PASS
    ]  # fmt: skip
    assert verdicts[3].failure is verdicts[4].failure is FailureType.NO_ASPIRATE
    assert LOOK in verdicts[3].reason
    assert NONE_FOUND in verdicts[4].reason
    assert "but the frames show liquid leave the tip" in verdicts[5].reason
    assert "sensor" not in verdicts[6].reason


@pytest.mark.parametrize("found", [True, False, None])
def test_of_tips_that_nobody_sees_the_sensor_is_the_only_witness(found: bool | None) -> None:
    head = tuple(f"{row}{column}" for column in range(1, 13) for row in "ABCDEFGH")
    analyser = RunAnalyserFactory(Told()).begin("run")
    for keyframe in keyframes(1, channels=96):
        whole = replace(keyframe, nozzles=head, targets=(None,) * 96, liquid_found=found)
        analyser.observe(whole, Frame(b"", np.zeros((32, 32, 3), np.uint8), 0.0))
    verdict, _ = analyser.judge(0)
    assert len(verdict.channels) == 96
    if found is False:
        assert (verdict.outcome, verdict.gate) == (Outcome.UNDECIDED, Gate.OPERATOR)
        assert verdict.reason.startswith(NONE_FOUND)
        assert {one.outcome for one in verdict.channels} == {ChannelOutcome.UNDECIDED}
        decision = {"outcome": "pass", "by": "Ada", "note": ""}
        assert effective(verdict, [decision]).channels[95].outcome is ChannelOutcome.PASS
    else:
        assert verdict.unobserved


def test_what_an_earlier_well_left_in_the_tip_explains_no_empty_source() -> None:
    told = {
        found: judge_run(
            5, ("partial:50@#4",), seed=1, volumes=(100.0,), tip="1:A1", probed={4: found}
        )[4][0]
        for found in (True, False)
    }
    assert "as reported there" in told[True].reason
    assert NONE_FOUND in told[False].reason
