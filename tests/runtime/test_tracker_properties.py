"""What must hold for every sequence of operations, whatever a protocol does."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from aegis_ot.adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    Operation,
    OperationKind,
    PipetteInfo,
)
from aegis_ot.runtime.pipette_state import in_place
from aegis_ot.runtime.steps import Abandon, Capture, Hold, Lift, Step
from aegis_ot.runtime.tracker import Tracker
from aegis_ot.vocabulary import KeyframeKind, WellRef

K = OperationKind
WELLS = [WellRef("plate", name) for name in ("A1", "B1", "C1")]
LEFT = PipetteInfo("left", "p300_single_gen2", "left", 1, 300.0)
RIGHT = PipetteInfo("right", "p20_single_gen2", "right", 1, 20.0)
ENTERING = {K.ASPIRATE, K.DISPENSE, K.BLOW_OUT, K.TOUCH_TIP, K.MOVE}


@st.composite
def an_operation(draw: Any) -> Operation:
    kind = draw(st.sampled_from([k for k in K if k is not K.PICK_UP_TIP]))
    where = draw(st.sampled_from(["well", "well", "well", "trash", "nowhere", "in place"]))
    well = draw(st.sampled_from(WELLS)) if where == "well" else None
    if kind is K.AIR_GAP:
        well, where = None, "in place"
    return Operation(
        kind=kind,
        pipette=draw(st.sampled_from([LEFT, RIGHT])),
        nozzles=("A1",),
        wells=(well,),
        disposal=where == "trash",
        volume=draw(st.sampled_from([5.0, 10.0, 20.0])),
        from_top=draw(st.sampled_from([-5.0, -5.0, 0.0, None])) if well else None,
        in_place=where == "in place",
        mixing=draw(st.booleans()) and kind in (K.ASPIRATE, K.DISPENSE),
    )


EVENTS = st.sampled_from([Event(EventKind.PAUSED), Event(EventKind.LABWARE_MOVED, labware="plate")])
SEQUENCES = st.lists(st.one_of(an_operation(), an_operation(), EVENTS), max_size=40)


def run(sequence: list[Any], **options: Any) -> list[Any]:
    """Steps and operations in the order in which they happen."""
    tracker = Tracker("run", **options)
    happened: list[Any] = []
    for item in sequence:
        if isinstance(item, Event):
            happened += tracker.event(item)
        else:
            happened += tracker.before(item)
            happened.append(item)
            happened += tracker.after(item)
    return happened + tracker.finish()


def captures(happened: list[Any]) -> list[Any]:
    return [step.keyframe for step in happened if isinstance(step, Capture)]


@settings(max_examples=150, deadline=None)
@given(SEQUENCES, st.sampled_from(["boundary", "well", "off"]))
def test_numbers_have_no_gaps_and_kinds_come_in_order(sequence: list[Any], hold: str) -> None:
    happened = run(sequence, hold=hold)
    frames = captures(happened)
    assert [frame.sequence for frame in frames] == list(range(len(frames)))
    kinds: dict[int, list[KeyframeKind]] = {}
    for frame in frames:
        kinds.setdefault(frame.trajectory, []).append(frame.kind)
    assert list(kinds) == list(range(len(kinds)))
    abandoned = [step.trajectory for step in happened if isinstance(step, Abandon)]
    held = [n for step in happened if isinstance(step, Hold) for n in step.trajectories]
    assert len(set(abandoned)) == len(abandoned)
    assert len(set(held)) == len(held)
    for number, seen in kinds.items():
        whole = seen == list(KeyframeKind)
        assert seen == list(KeyframeKind)[: len(seen)]
        assert whole != (number in abandoned)
        assert whole == (number in held)


@settings(max_examples=150, deadline=None)
@given(SEQUENCES)
def test_no_other_well_is_entered_before_the_verdict(sequence: list[Any]) -> None:
    open_wells: dict[int, tuple[str, frozenset[WellRef]]] = {}
    for step in run(sequence):
        if isinstance(step, Capture) and step.keyframe.kind is KeyframeKind.DISPENSE:
            frame = step.keyframe
            open_wells[frame.trajectory] = (frame.mount, frozenset(frame.destinations))
        elif isinstance(step, Hold):
            for number in step.trajectories:
                open_wells.pop(number, None)
        elif isinstance(step, Operation):
            for mount, wells in open_wells.values():
                if mount != step.pipette.key:
                    continue
                assert step.kind is not K.DROP_TIP
                inside = step.from_top is None or step.from_top < 0
                enters = step.kind in ENTERING and (inside or step.kind is not K.MOVE)
                if step.kind is K.ASPIRATE and not inside:
                    enters = False
                if enters and step.well is not None and not in_place(step):
                    assert {step.well} == wells


@settings(max_examples=200, deadline=None)
@given(SEQUENCES)
def test_a_lift_is_followed_by_a_keyframe_and_never_comes_before_work_in_place(
    sequence: list[Any],
) -> None:
    happened = run(sequence)
    for step, following in pairwise(happened):
        if isinstance(step, Lift):
            assert isinstance(following, Capture)
            assert following.keyframe.kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
    lifted = False
    for item in happened:
        if isinstance(item, Lift):
            lifted = True
        elif isinstance(item, Operation):
            assert not (lifted and in_place(item) and item.wells == (None,))
            lifted = False


@settings(max_examples=100, deadline=None)
@given(SEQUENCES)
def test_moves_and_keyframes_do_not_depend_on_the_hold_mode(sequence: list[Any]) -> None:
    def shape(steps: list[Any]) -> list[Step]:
        return [step for step in steps if not isinstance(step, Hold)]

    assert shape(run(sequence, hold="off")) == shape(run(sequence, hold="boundary"))
    assert shape(run(sequence, hold="off")) == shape(run(sequence, hold="well"))


@settings(max_examples=100, deadline=None)
@given(SEQUENCES)
def test_volumes_are_never_negative(sequence: list[Any]) -> None:
    for frame in captures(run(sequence)):
        assert frame.expected_ul >= 0
        assert frame.commanded_ul >= 0
