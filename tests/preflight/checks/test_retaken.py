"""Tips are taken only where some are: places of a rack that the run has emptied hold none."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aegis_ot.adapters.opentrons.instrumentation import EventKind
from aegis_ot.preflight import Report
from tests.support.bench import Bench

from .test_handling import flex, found, ot2, told

TWICE = """
pip.pick_up_tip(racks[1]["A1"])
pip.transfer(50, trough["A1"], plate["A1"], new_tip="never")
pip.{drop}
{between}
pip.pick_up_tip(racks[1]["A1"])
pip.transfer(50, trough["A2"], plate["A2"], new_tip="never")
pip.drop_tip()
"""


def is_open(report: Report) -> bool:
    return "HND-1" in {one.rule for one in report.undecided}


@pytest.mark.parametrize("level", ["2.2", "2.13", "2.14", "2.20"])
def test_a_place_that_was_emptied_holds_no_tip(level: str) -> None:
    message = told(ot2(TWICE.format(drop="drop_tip()", between=""), level), "HND-1")
    assert message.startswith("error: The right p300_single_gen2 goes to A1 of Opentrons")
    assert "at line 20, and none is there: it took that tip at line 16" in message
    assert "such as B1" in message
    assert "reset()" in message


@pytest.mark.parametrize("level", ["2.2", "2.13", "2.14", "2.20"])
@pytest.mark.parametrize(
    ("drop", "between"),
    [
        ("return_tip()", ""),
        ("drop_tip(racks[1]['A1'])", ""),
        ("drop_tip(racks[1]['A1'].top(-10))", ""),
        ("drop_tip()", "pip.reset_tipracks()"),
        ("drop_tip()", "racks[1].reset()"),
        ("drop_tip()", "ctx.pause('Replace the tips, then resume')"),
        ("drop_tip()", "ctx.pause('Put a new tip box in slot 8')"),
        ("drop_tip()", "ctx.pause('Replace the rack in slot 8')"),
    ],
)
def test_tips_that_came_back_or_are_new_are_there(drop: str, between: str, level: str) -> None:
    report = ot2(TWICE.format(drop=drop, between=between), level)
    assert not found(report, "HND-1")
    assert not is_open(report)


@pytest.mark.parametrize(
    ("pause", "severity"),
    [
        ("", "open"),
        ("Go on?", "open"),
        ("Swap, then resume", "open"),
        ("Fresh racks, please", "open"),
        ("Seal the plate, and spin it down", "warning"),
        ("Put the reservoir in slot 3", "warning"),
    ],
)
def test_in_a_pause_somebody_may_fill_the_rack(pause: str, severity: str) -> None:
    report = ot2(TWICE.format(drop="drop_tip()", between=f"ctx.pause('{pause}')"))
    assert is_open(report) is (severity == "open")
    if severity != "open":
        assert told(report, "HND-1").startswith(severity)
        assert "in the pause at line 19, let its message say so" in told(report, "HND-1")


def test_a_loop_that_begins_again_is_told_once() -> None:
    loop = """
    for well in {wells}:
        pip.pick_up_tip(racks[1][well.well_name])
        pip.transfer(50, trough["A1"], plate[well.well_name], new_tip="never")
        pip.drop_tip()
    """
    report = ot2(loop.format(wells="plate.wells()") + loop.format(wells="plate.wells()"))
    message = told(report, "HND-1")
    assert "It does so 96 times." in message
    assert "No other place of the rack has tips for it" in message
    assert len(found(report, "HND-1")[0].wells) == 96
    half = "plate.wells()[:48]"
    assert "such as A7" in told(ot2(loop.format(wells=half) + loop.format(wells=half)), "HND-1")


COLUMN = """
for name in {singles}:
    {first}.pick_up_tip(racks[0][name])
    {first}.transfer(30, trough["A2"], plate["A12"], new_tip="never")
    {first}.drop_tip()
m300.pick_up_tip(racks[0]["{then}"])
m300.transfer(50, trough["A1"], plate["A1"], new_tip="never")
m300.drop_tip()
"""


@pytest.mark.parametrize(
    ("singles", "first", "then", "said"),
    [
        (["A1"], "pip", "A1", "not there: the right p300_single_gen2 took that of A1"),
        (["C1", "D1"], "pip", "A1", "2 of them are not there"),
        (["A1"], "m300", "A1", "8 of them are not there: it took that of A1"),
        (["A1", "B1"], "pip", "A2", ""),
        (["H1", "G1", "F1"], "m300", "E1", ""),
        (["G1"], "m300", "E1", ""),
        (["H1"], "pip", "A1", "open"),
    ],
)  # fmt: skip
def test_a_column_with_gaps(singles: list[str], first: str, then: str, said: str) -> None:
    """Eight nozzles take fewer tips where the others stand beside the rack, or over its gaps."""
    report = ot2(COLUMN.format(singles=singles, first=first, then=then))
    message = told(report, "HND-1")
    assert is_open(report) is (said == "open")
    assert said in message if said not in ("", "open") else not message


PARTIAL = """
pip.configure_nozzle_layout(style=PARTIAL_COLUMN, start="H1", end="E1")
for place in {places}:
    pip.pick_up_tip(rack[place])
    pip.aspirate(50, trough["A1"].bottom(2))
    pip.dispense(50, plate["D1"])
    pip.drop_tip()
"""


@pytest.mark.parametrize(
    ("places", "missing"), [(["D1", "H1"], 0), (["D1", "F1"], 2), (["D1", "D1"], 4)]
)
def test_parts_of_a_column_that_overlap(places: list[str], missing: int) -> None:
    message = told(flex(PARTIAL.format(places=places)), "HND-1")
    assert f"for 4 tips at line 16, and {missing} of them" in message if missing else not message


HEAD = """
adapter = ctx.load_adapter("opentrons_flex_96_tiprack_adapter", "A2")
if {first}:
    pip.configure_nozzle_layout(style=COLUMN, start="A12")
    pip.pick_up_tip(rack["A1"])
    pip.transfer(50, trough["A1"], plate["A1"], new_tip="never")
    pip.drop_tip()
ctx.move_labware(rack, adapter, use_gripper=True)
pip.configure_nozzle_layout(style=ALL)
for drop in (pip.return_tip, pip.drop_tip):
    pip.pick_up_tip(rack["A1"])
    pip.aspirate(50, bath["A1"])
    pip.dispense(50, plate["A1"])
    drop()
"""


@pytest.mark.parametrize("first", [True, False])
def test_a_head_over_a_rack_without_a_column(first: bool) -> None:
    report = flex(HEAD.format(first=first), "flex_96channel_1000")
    assert ("8 of them are not there" in told(report, "HND-1")) is first


@pytest.mark.parametrize(("slot", "accused"), [("C2", True), ("OFF_DECK", False)])
def test_a_rack_that_was_off_the_deck_may_be_full_again(slot: str, accused: bool) -> None:
    code = f"""
        from opentrons.protocol_api import OFF_DECK

        for slot in ({slot!r}, None):
            pip.pick_up_tip(rack["A1"])
            pip.transfer(50, trough["A1"], plate["A1"], new_tip="never")
            pip.drop_tip()
            if slot:
                ctx.move_labware(rack, slot)
                ctx.move_labware(rack, "B2")
    """
    code = code.replace("'OFF_DECK'", "OFF_DECK")
    assert bool(found(flex(code, "flex_1channel_1000"), "HND-1")) is accused


STEPS = st.lists(
    st.tuples(st.sampled_from(["A1", "B1", "C1"]), st.sampled_from(["", "A1", "B1", "C1"])),
    max_size=12,
)


@given(STEPS, st.integers(0, 12))
def test_places_are_counted_as_a_rack_on_the_bench_has_them(
    steps: list[tuple[str, str]], renewed: int
) -> None:
    """Each step takes a tip from a place and drops it, into the trash or a place that is free."""
    bench, rack, missing = Bench(), Counter({"A1": 1, "B1": 1, "C1": 1}), []
    for number, (place, back) in enumerate(steps):
        if number == renewed:
            bench.say(EventKind.TIPS_RESET, "", "rack")
            rack.update({name: 1 - rack[name] for name in rack})
        bench.pick(place)
        if not rack[place]:
            missing.append(bench.line)
        rack[place] = 0
        if rack[back]:
            back = ""
        bench.drop(back)
        if back:
            rack[back] = 1
    retaken = bench.trace().retakings
    assert [step.line for step, _ in retaken] == missing
