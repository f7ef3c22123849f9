"""What may be put right, and why not: decisions on made-up operations."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.instrumentation import Operation, OperationKind, PipetteInfo
from aegis_ot.runtime.recovery_policy import NotAllowed, Plan, plan_recovery
from aegis_ot.runtime.strokes import RecordedDelivery
from aegis_ot.vocabulary import (
    FailureType,
    Gate,
    Keyframe,
    KeyframeKind,
    Outcome,
    Route,
    Verdict,
    WellRef,
)

SINGLE = PipetteInfo("left", "p300_single_gen2", "left", 1, 300.0)
SOURCE, THERE, OTHER = (WellRef("plate", name, slot="2") for name in ("A1", "A2", "A3"))


class Core:
    """An engine core, as far as it is asked."""

    _engine_client = object()

    def __init__(self, volume: float = 0.0) -> None:
        self.volume = volume

    def get_current_volume(self) -> float:
        return self.volume


CORE, LOADED = Core(), Core(10.0)


def op(kind: OperationKind, well: WellRef | None = None, volume: float = 0.0, **more: Any) -> Any:
    given: dict[str, Any] = {"method": kind.value, "from_top": -5.0, "core": lambda: CORE}
    return Operation(kind, SINGLE, ("A1",), (well,), volume=volume, **(given | more))


DRAW = op(OperationKind.ASPIRATE, SOURCE, 100.0)
GIVE = op(OperationKind.DISPENSE, THERE, 100.0)
DROP = op(OperationKind.DROP_TIP, disposal=True)
NEXT = op(OperationKind.ASPIRATE, OTHER, 100.0)
POST = Keyframe(
    "run", 3, 0, KeyframeKind.POST_DISPENSE, "p300_single_gen2", "left", 1, "1:A1",
    (SOURCE,), (THERE,), 100.0, 0.0, 300.0,
)  # fmt: skip
GOOD = RecordedDelivery(POST, (DRAW, GIVE))


def verdict(kind: FailureType, **more: Any) -> Verdict:
    told = {"gate": Gate.VOLUMETRIC, "failure": kind, **more}
    return Verdict("run", 0, Outcome.FAIL, Route.GREY_ZONE, **told)


EMPTY = verdict(FailureType.NO_ASPIRATE, measured_ul=2.0)
STUCK = verdict(FailureType.NO_DISPENSE, measured_ul=98.0)
SHORT = verdict(FailureType.PARTIAL_DISPENSE, measured_ul=41.0, left_ul=40.0, left_sigma_ul=3.0)


def volumes(plan: Plan) -> list[tuple[str, float]]:
    return [
        (one.operation.kind.value, one.operation.volume if one.volume is None else one.volume)
        for one in plan.strokes
    ]


def test_a_retry_does_all_of_it_again() -> None:
    mix = op(OperationKind.DISPENSE, THERE, 30.0, mixing=True)
    touch = op(OperationKind.TOUCH_TIP, THERE)
    plan = plan_recovery(
        "retry", RecordedDelivery(POST, (DRAW, GIVE, mix), (touch,)), EMPTY, DROP, None
    )
    assert volumes(plan) == [
        ("aspirate", 100.0), ("dispense", 100.0), ("dispense", 30.0), ("touch_tip", 0.0),
    ]  # fmt: skip


def test_a_source_in_which_the_sensor_found_nothing_is_not_tried_again() -> None:
    for found in (True, None):
        told = replace(GOOD, keyframe=replace(POST, liquid_found=found))
        assert plan_recovery("retry", told, EMPTY, DROP, None).action == "retry"
    none = replace(GOOD, keyframe=replace(POST, liquid_found=False))
    with pytest.raises(NotAllowed, match="found no liquid in the source"):
        plan_recovery("retry", none, EMPTY, DROP, None)
    assert plan_recovery("retry", none, STUCK, DROP, None).action == "retry"


def test_a_top_up_delivers_what_is_missing_and_mixes_like_the_protocol() -> None:
    gap = op(OperationKind.AIR_GAP, SOURCE, 10.0)
    mix = op(OperationKind.ASPIRATE, THERE, 30.0, mixing=True)
    given = replace(GIVE, volume=110.0)
    plan = plan_recovery(
        "top_up", RecordedDelivery(POST, (DRAW, gap, given, mix)), SHORT, DROP, None
    )
    assert volumes(plan) == [("aspirate", 40.0), ("dispense", 40.0), ("aspirate", 30.0)]
    assert plan.missing_ul == 40.0


@pytest.mark.parametrize(
    ("verdict", "touched", "saves"),
    [
        (STUCK, {SOURCE}, True),
        (STUCK, {SOURCE, THERE}, False),
        (STUCK, None, False),
        (EMPTY, {SOURCE}, False),  # there is nothing in the tip
    ],
)
def test_liquid_goes_home_only_if_the_tip_touched_nothing_else(
    verdict: Verdict, touched: set[WellRef] | None, saves: bool
) -> None:
    history = None if touched is None else frozenset(touched)
    assert plan_recovery("retry", GOOD, verdict, DROP, history).saves is saves


RIGHT = replace(DROP, pipette=replace(SINGLE, key="right", mount="right"))
EIGHT = replace(DROP, pipette=replace(SINGLE, channels=8))
FROM_NOWHERE = replace(DRAW, in_place=True)


@pytest.mark.parametrize(
    ("action", "delivery", "verdict", "boundary", "why"),
    [
        ("retry", GOOD, EMPTY, None, "not between two moves"),
        ("retry", None, EMPTY, DROP, "not between two moves"),
        ("retry", GOOD, EMPTY, RIGHT, "not between two moves"),
        ("retry", GOOD, EMPTY, EIGHT, "one of several tips"),
        ("retry", replace(GOOD, keyframe=replace(POST, channels=8)), EMPTY, DROP, "several tips"),
        ("retry", GOOD, EMPTY, replace(NEXT, in_place=True), "where the tip stands"),
        ("retry", GOOD, EMPTY, replace(DROP, disposal=False), "puts its tip back"),
        ("retry", GOOD, EMPTY, replace(NEXT, core=lambda: LOADED), "air"),
        ("retry", replace(GOOD, keyframe=replace(POST, expected_ul=50.0)), EMPTY, DROP, "meant"),
        ("retry", replace(GOOD, keyframe=replace(POST, destinations=())), EMPTY, DROP, "one dest"),
        ("retry", RecordedDelivery(POST, (GIVE,)), EMPTY, DROP, "for this well alone"),
        ("retry", RecordedDelivery(POST, (DRAW, DRAW, GIVE)), EMPTY, DROP, "for this well alone"),
        ("retry", RecordedDelivery(POST, (FROM_NOWHERE, GIVE)), EMPTY, DROP, "where the tip stood"),
        (
            "retry",
            RecordedDelivery(POST, (DRAW, op(OperationKind.TOUCH_TIP, OTHER), GIVE)),
            EMPTY,
            DROP,
            "other places",
        ),
        ("retry", GOOD, replace(EMPTY, measured_ul=30.0), DROP, "30 µL were drawn"),
        ("retry", GOOD, replace(STUCK, measured_ul=60.0), DROP, "60 µL are left"),
        ("retry", replace(GOOD, since=(GIVE,)), STUCK, DROP, "moved liquid since"),
        (
            "retry",
            RecordedDelivery(POST, (DRAW, replace(GIVE, method=""))),
            EMPTY,
            DROP,
            "cannot be done",
        ),
        ("top_up", GOOD, replace(SHORT, left_ul=None), DROP, "could not be measured"),
        ("top_up", GOOD, replace(SHORT, left_sigma_ul=8.0), DROP, "too uncertain"),
        ("top_up", GOOD, replace(SHORT, measured_ul=140.0), DROP, "another measure"),
        ("top_up", GOOD, replace(SHORT, measured_ul=5.0, left_ul=5.0), DROP, "do not tell"),
        (
            "top_up",
            RecordedDelivery(POST, (replace(DRAW, volume=50.0), replace(DRAW, volume=50.0), GIVE)),
            SHORT,
            DROP,
            "several strokes",
        ),
        (
            "top_up",
            RecordedDelivery(POST, (DRAW, replace(GIVE, in_place=True))),
            SHORT,
            DROP,
            "in place",
        ),
    ],
)
def test_what_is_not_certain_is_refused_with_a_reason(
    action: str,
    delivery: RecordedDelivery | None,
    verdict: Verdict,
    boundary: Operation | None,
    why: str,
) -> None:
    with pytest.raises(NotAllowed, match=why):
        plan_recovery(action, delivery, verdict, boundary, None)


@pytest.mark.parametrize(
    "told",
    [
        {"measured_ul": None},
        {"measured_ul": 2.0, "gate": Gate.VLM},
        {"measured_ul": 2.0, "gate": Gate.OPERATOR},
    ],
)
def test_what_nobody_measured_is_not_given_twice(told: dict[str, Any]) -> None:
    seen = verdict(FailureType.NO_ASPIRATE, **told)
    with pytest.raises(NotAllowed, match="nothing was measured"):
        plan_recovery("retry", RecordedDelivery(POST, (DRAW, GIVE)), seen, DROP, None)
