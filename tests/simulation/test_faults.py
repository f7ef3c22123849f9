"""Planted faults: what is accepted, and what a tip truly holds because of them."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.simulation.fault_plan import FaultPlan
from aegis_ot.simulation.faults import Fault, FaultKind, Where
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

ORDER = tuple(KeyframeKind)


def run_of(
    wells: list[str],
    volume: float = 100.0,
    *,
    channels: int = 1,
    one_tip: bool = False,
    known: bool = False,
    run: str = "r",
) -> list[Keyframe]:
    """The keyframes of one transfer per well, destinations told from TRANSIT on."""
    frames = []
    counter = itertools.count()
    for number, name in enumerate(wells):
        column = name[1:]
        names = [name] if channels == 1 else [f"{row}{column}" for row in "ABCDEFGH"[:channels]]
        destinations = tuple(WellRef("plate", n, slot="2") for n in names)
        for kind in ORDER:
            holds = kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
            frames.append(
                Keyframe(
                    run=run,
                    sequence=next(counter),
                    trajectory=number,
                    kind=kind,
                    pipette="p300_single_gen2",
                    mount="left",
                    channels=channels,
                    tip="1:A1" if one_tip else f"1:{name}",
                    sources=(WellRef("reservoir", "A1", slot="1"),),
                    destinations=destinations if known or kind is not ORDER[0] else (),
                    commanded_ul=volume,
                    expected_ul=volume if holds else 0.0,
                    capacity_ul=300.0,
                )
            )
    return frames


def liquid(plan: FaultPlan, frames: list[Keyframe]) -> list[float]:
    return [round(plan.apply(frame).contents[0].liquid_ul, 3) for frame in frames]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("partial:50@B3", Fault(FaultKind.PARTIAL, Where("B3"), 0.5)),
        (" Partial:12.5% @ b3 ", Fault(FaultKind.PARTIAL, Where("B3"), 0.125)),
        ("no_aspirate@C4", Fault(FaultKind.NO_ASPIRATE, Where("C4"))),
        ("no-dispense@#12", Fault(FaultKind.NO_DISPENSE, Where(number=12))),
        ("air_bubble@D1", Fault(FaultKind.AIR_BUBBLE, Where("D1"), 0.08)),
        ("air_bubble:15@C2:D1", Fault(FaultKind.AIR_BUBBLE, Where("D1", "C2"), 0.15)),
        ("no_tip@10:E1", Fault(FaultKind.NO_TIP, Where("E1", "10"))),
        ("no_aspirate@2:C11x2", Fault(FaultKind.NO_ASPIRATE, Where("C11", "2", times=2))),
    ],
)
def test_accepted_forms(text: str, fault: Fault) -> None:
    assert Fault.parse(text) == fault
    assert Fault.parse(str(fault)) == fault


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("partial@B3", "percentage"),
        ("partial:0@B3", "between 0 and 100"),
        ("partial:130@B3", "between 0 and 100"),
        ("partial:nan@B3", "between 0 and 100"),
        ("partial:half@B3", "no percentage"),
        ("leak@B3", "no kind of fault"),
        ("no_tip:5@B3", "takes no percentage"),
        ("no_tip", "no well"),
        ("no_tip@", "no well"),
        ("no_tip@3B", "no well name"),
        ("no_tip@B0", "no well name"),
        ("no_tip@E9:B1", "no deck slot"),
        ("no_tip@#0", "count from #1"),
        ("no_tip@#x", "count from #1"),
        ("", "no well"),
    ],
)
def test_wrong_forms_are_explained(text: str, why: str) -> None:
    with pytest.raises(ConfigurationError, match=why) as caught:
        Fault.parse(text)
    assert "partial:50@B3" in str(caught.value)


@pytest.mark.parametrize(
    ("fault", "held"),
    [
        ("partial:25@B1", [100, 100, 75, 75]),
        ("no_aspirate@B1", [100, 0, 0, 0]),
        ("no_dispense@B1", [100, 100, 100, 100]),
        ("no_dispense@#2", [100, 100, 100, 100]),
        ("no_aspirate@#2", [0, 0, 0, 0]),
        ("air_bubble:10@#2", [90, 90, 0, 0]),
    ],
)
def test_a_fault_strikes_its_own_well_only(fault: str, held: list[float]) -> None:
    frames = run_of(["A1", "B1", "C1"])
    amounts = liquid(FaultPlan([fault]), frames)
    assert amounts[4:8] == held
    assert amounts[:4] == amounts[8:] == [100, 100, 0, 0]


def test_a_rehearsal_lets_a_fault_act_from_the_aspirate_on() -> None:
    frames = run_of(["A1", "B1"])
    plan = FaultPlan(["no_aspirate@B1", "no_tip@A1"])
    plan.expect(run_of(["A1", "B1"], run="rehearsal"))
    states = [plan.apply(frame) for frame in frames]
    assert [s.contents[0].present for s in states] == [False] * 4 + [True] * 4
    assert [s.contents[0].liquid_ul for s in states[4:]] == [0.0] * 4
    assert {str(f) for f in states[4].struck} == {"no_aspirate@B1"}


def test_retained_liquid_stays_in_a_tip_used_again_and_leaves_with_it() -> None:
    again = liquid(FaultPlan(["partial:60@A1"]), run_of(["A1", "B1"], one_tip=True))
    fresh = liquid(FaultPlan(["partial:60@A1"]), run_of(["A1", "B1"]))
    assert again == [100, 100, 40, 40, 140, 140, 40, 40]
    assert fresh == [100, 100, 40, 40, 100, 100, 0, 0]


def test_a_bubble_parts_the_column_until_the_dispense() -> None:
    plan = FaultPlan(["air_bubble:10@A1"])
    states = [plan.apply(frame).contents[0] for frame in run_of(["A1"], known=True)]
    assert len(states[0].slugs) == len(states[1].slugs) == 2
    assert states[0].slugs[1][0] - states[0].slugs[0][1] == pytest.approx(10.0)
    assert states[2].slugs == ()


def test_one_channel_of_eight_can_fail() -> None:
    plan = FaultPlan(["no_dispense@C2"])
    state = [plan.apply(frame) for frame in run_of(["A2"], channels=8)][3]
    assert [round(tip.liquid_ul) for tip in state.contents] == [0, 0, 100, 0, 0, 0, 0, 0]


def test_slot_must_match_where_given() -> None:
    frames = run_of(["A1"])
    assert liquid(FaultPlan(["no_dispense@2:A1"]), frames)[3] == 100
    assert liquid(FaultPlan(["no_dispense@5:A1"]), frames)[3] == 0


def test_a_resent_keyframe_is_counted_once() -> None:
    frames = run_of(["A1", "B1"])
    plan = FaultPlan(["partial:50@A1"])
    first = [plan.apply(frame) for frame in frames[:3]]
    assert plan.apply(frames[1]) == first[1]
    assert plan.apply(frames[2]) == first[2]
    assert liquid(plan, frames[3:]) == [50, 100, 100, 0, 0]


def test_multi_dispense_draws_once_and_empties_step_by_step() -> None:
    frames = run_of(["A1", "B1"], one_tip=True)
    levels = [90, 90, 60, 60, 60, 60, 30, 30]
    told = [
        Keyframe(**{**vars(f), "expected_ul": float(v), "commanded_ul": 30.0})
        for f, v in zip(frames, levels, strict=True)
    ]
    assert liquid(FaultPlan(), told) == levels
    assert liquid(FaultPlan(["partial:50@B1"]), told) == [90, 90, 60, 60, 60, 60, 45, 45]


def test_a_mistyped_well_is_found() -> None:
    plan = FaultPlan(["no_tip@A1", "no_tip@H9", "no_tip@#3"])
    missing = plan.unmatched(run_of(["A1", "B1"]))
    assert [str(fault) for fault in missing] == ["no_tip@H9", "no_tip@#3"]


def test_a_transient_fault_is_gone_when_the_well_is_served_again() -> None:
    assert liquid(FaultPlan(["no_aspirate@A1x1"]), run_of(["A1", "A1"]))[1::4] == [0.0, 100.0]


def test_a_recovery_goes_where_the_failed_delivery_was_planned_to_go() -> None:
    planned = run_of(["A1", "B1"], known=True)
    plan = FaultPlan(["no_aspirate@A1x1", "no_aspirate@B1x1"])
    plan.expect(planned)
    frames = run_of(["A1", "A1", "B1"])
    frames[4:8] = [replace(frame, recovers=0) for frame in frames[4:8]]
    # At the ASPIRATE keyframe, where no destination is told, only the rehearsal knows.
    assert liquid(plan, frames)[::4] == [0.0, 100.0, 0.0]
