"""A leftover that was reported is known; what comes on top of it is new."""

from __future__ import annotations

from dataclasses import replace

import pytest

from aegis_ot.vision.delivery import Delivery, Shown
from aegis_ot.vision.gates import GateDecision, GateInput
from aegis_ot.vision.leftover import Leftover, Leftovers, explains
from aegis_ot.vision.measuring import ColumnReading
from aegis_ot.vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route

from .samples import sample
from .test_run_analyser_factory import keyframes

TRANSIT, LAST = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
KEYFRAME = next(iter(keyframes(1)))
LEFT = Leftover("1:A1", 50.0, "A1")
UNKNOWN = Delivery(Shown.UNKNOWN)


def case(transit: float | None = None, last: float | None = None) -> GateInput:
    """A well that should get 100 µL."""
    found = {TRANSIT: transit, LAST: last}
    readings = {kind: ColumnReading(v, 2.0) for kind, v in found.items() if v is not None}
    return GateInput(sample(), Route.GREY_ZONE, readings=readings)


def fail(measured: float | None, expected: float | None) -> GateDecision:
    failure = FailureType.PARTIAL_DISPENSE
    return GateDecision(Outcome.FAIL, Gate.VOLUMETRIC, "", failure, measured, expected)


@pytest.mark.parametrize(
    ("transit", "last", "explained"),
    [
        (150.0, 50.0, True),
        (100.0, 0.0, True),
        (None, None, True),
        (150.0, 100.0, False),
        (150.0, 150.0, False),
        (20.0, 20.0, False),
        (220.0, None, False),
    ],
)
def test_only_what_was_left_is_explained(transit, last, explained) -> None:
    assert explains(LEFT, case(transit, last), UNKNOWN) is explained


def test_a_missing_tip_is_not_explained_by_a_leftover() -> None:
    assert not explains(LEFT, replace(case(), missing=(LAST,)), UNKNOWN)


@pytest.mark.parametrize(
    ("shown", "explained"), [(Shown.EMPTIED, True), (Shown.NOTHING, False), (Shown.LEFT, False)]
)
def test_what_leaves_a_tip_that_held_the_leftover_all_along_is_what_counts(
    shown: Shown, explained: bool
) -> None:
    assert explains(LEFT, case(), Delivery(shown)) is explained


@pytest.mark.parametrize(
    ("decision", "volume"),
    [
        (fail(50.0, 0.0), 50.0),
        (fail(140.0, 100.0), 40.0),
        (fail(None, None), 100.0),
        (GateDecision(Outcome.UNDECIDED, Gate.OPERATOR, "", None, 30.0, 0.0), 30.0),
    ],
)
def test_what_a_verdict_says_stayed_is_known_of_that_tip(decision, volume) -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), decision)
    known = tips.known(KEYFRAME)
    assert known is not None
    assert known.volume_ul == pytest.approx(volume)
    assert tips.known(replace(KEYFRAME, mount="right")) is None


def test_what_was_not_dispensed_comes_on_top_of_what_was_left() -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), fail(45.0, 0.0))
    nothing = GateDecision(Outcome.FAIL, Gate.VOLUMETRIC, "", FailureType.NO_DISPENSE, 100.0, 0.0)
    tips.note(KEYFRAME, case(), nothing)
    known = tips.known(KEYFRAME)
    assert known is not None
    assert known.volume_ul == pytest.approx(145.0)


def test_another_tip_starts_clean() -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), fail(50.0, 0.0))
    assert tips.known(replace(KEYFRAME, tip="1:B1")) is None
    assert tips.known(KEYFRAME) is None


@pytest.mark.parametrize("failure", [FailureType.NO_ASPIRATE, FailureType.NO_TIP, None])
def test_failures_that_leave_nothing_are_forgotten(failure) -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), GateDecision(Outcome.FAIL, Gate.VLM, "", failure))
    assert tips.known(KEYFRAME) is None


def test_what_was_left_went_with_the_tip() -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), fail(50.0, 0.0))
    tips.note(KEYFRAME, case(), GateDecision(Outcome.FAIL, Gate.VLM, "", FailureType.NO_TIP))
    assert tips.known(KEYFRAME) is None


@pytest.mark.parametrize(("free_ul", "explained"), [(110.0, True), (90.0, False)])
def test_a_tip_without_room_for_what_was_drawn_is_not_explained(free_ul, explained) -> None:
    """100 µL are drawn, into a tip in which all that can be seen is full before and after."""
    tips = Leftovers()
    tips.note(KEYFRAME, case(), fail(case().sample.tip.capacity_ul - free_ul, 0.0))
    found = tips.explaining(KEYFRAME, case(), lambda held: UNKNOWN)
    assert (found is not None) is explained


def test_no_more_is_left_than_a_tip_holds() -> None:
    tips = Leftovers()
    most = case().sample.tip.capacity_ul
    nothing = GateDecision(Outcome.FAIL, Gate.VOLUMETRIC, "", FailureType.NO_DISPENSE, 100.0, 0.0)
    tips.note(KEYFRAME, case(), fail(most - 10.0, 0.0))
    tips.note(KEYFRAME, case(), nothing)
    known = tips.known(KEYFRAME)
    assert known is not None
    assert known.volume_ul == pytest.approx(most)


def unseen() -> GateInput:
    """A well of which nothing was seen to leave."""
    return replace(case(), delivery=Delivery(Shown.NOTHING))


@pytest.mark.parametrize(
    ("shown", "left"),
    [
        ({50.0: Shown.EMPTIED, 150.0: Shown.NOTHING}, 50.0),
        ({50.0: Shown.NOTHING, 150.0: Shown.EMPTIED}, 150.0),
        ({50.0: Shown.NOTHING, 150.0: Shown.NOTHING}, None),
        ({50.0: Shown.NOTHING, 150.0: Shown.UNKNOWN}, None),
    ],
)
def test_whether_what_was_not_seen_to_leave_is_still_there_is_told_by_the_next_well(
    shown: dict[float, Shown], left: float | None
) -> None:
    tips = Leftovers()
    tips.note(KEYFRAME, case(), fail(50.0, 0.0))
    tips.note(KEYFRAME, unseen(), GateDecision(Outcome.FAIL, Gate.VLM, "", FailureType.OTHER))
    found = tips.explaining(KEYFRAME, unseen(), lambda held: Delivery(shown[held]))
    assert (None if found is None else found.volume_ul) == left


def test_a_tip_that_seems_to_hold_liquid_is_asked_about_once() -> None:
    """A film in a tip that serves many wells is one question, not one for each."""
    left = Leftovers()
    seems = {LAST: ColumnReading(0.0, 2.0, excess=3.0)}
    doubtful = replace(case(), readings=seems, p_value=0.01)
    assert doubtful.seems_left
    assert not left.doubted(KEYFRAME)
    left.note(KEYFRAME, doubtful, GateDecision(Outcome.UNDECIDED, Gate.OPERATOR, ""))
    assert left.doubted(KEYFRAME)
    assert not replace(doubtful, tip_doubted=True).seems_left
    assert not left.doubted(replace(KEYFRAME, tip="another"))
