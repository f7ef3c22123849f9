"""What a pipette's pressure sensor said of a source travels with the delivery drawn from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from opentrons.protocol_api import PARTIAL_COLUMN

from aegis_ot.adapters.opentrons.instrumentation import Operation

from .recorded import Recorder, record

WITH_TIP = "opentrons_flex_96_tiprack_200ul"


def flex(context: Any, name: str = "flex_1channel_1000") -> tuple[Any, Any, Any]:
    tips = context.load_labware(WITH_TIP, "B2")
    plate = context.load_labware("nest_96_wellplate_200ul_flat", "C2")
    reservoir = context.load_labware("nest_12_reservoir_15ml", "C1")
    context.load_trash_bin("A3")
    return context.load_instrument(name, "left", [tips]), reservoir, plate


def deliver(pipette: Any, source: Any, target: Any) -> None:
    pipette.aspirate(50, source)
    pipette.dispense(50, target)


class Sensor:
    """Says in turn what it is told to, and counts how often it was asked."""

    def __init__(self, *words: bool | None) -> None:
        self._words: Iterator[bool | None] = iter(words)
        self.asked = 0

    def __call__(self, operation: Operation) -> bool | None:
        assert operation.probes
        self.asked += 1
        return next(self._words, True)


def told(
    protocol: Callable[[Any], None], *words: bool | None, api: str = "2.20"
) -> list[bool | None]:
    """What the keyframes of each trajectory say, which is one thing."""
    recorder: Recorder = record(protocol, api, "Flex", probe=Sensor(*words))
    said: dict[int, set[bool | None]] = {}
    for keyframe in recorder.keyframes:
        said.setdefault(keyframe.trajectory, set()).add(keyframe.liquid_found)
    assert all(len(one) == 1 for one in said.values())
    return [one.pop() for one in said.values()]


@pytest.mark.parametrize("word", [True, False, None])
@pytest.mark.parametrize("how", ["detect_liquid_presence", "require_liquid_presence"])
def test_an_explicit_probe_is_told_with_the_delivery_after_it_alone(
    how: str, word: bool | None
) -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        getattr(pipette, how)(reservoir["A1"])
        deliver(pipette, reservoir["A1"], plate["A1"])
        deliver(pipette, reservoir["A1"], plate["B1"])  # nobody asked before this draw
        pipette.drop_tip()

    assert told(protocol, word) == [word, None]


def test_the_robots_own_probe_before_a_clean_tip_draws_is_told() -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.liquid_presence_detection = True
        pipette.transfer(50, reservoir["A1"], plate.wells()[:2], new_tip="always")
        pipette.transfer(50, reservoir["A1"], plate.wells()[2:4], new_tip="once")

    assert told(protocol) == [True, True, True, None]


def test_nothing_is_told_of_another_well_or_another_tip() -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        deliver(pipette, reservoir["A2"], plate["A1"])
        pipette.drop_tip()
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        pipette.drop_tip()
        pipette.pick_up_tip()
        deliver(pipette, reservoir["A1"], plate["B1"])
        pipette.drop_tip()

    assert told(protocol) == [None, None]


def test_a_mix_and_an_air_gap_change_nothing_and_all_wells_of_a_draw_are_told() -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        pipette.mix(2, 20, reservoir["A1"])
        pipette.aspirate(10, reservoir["A2"].top(5))
        pipette.aspirate(60, reservoir["A1"])
        pipette.aspirate(40, reservoir["A1"])
        pipette.air_gap(5)
        pipette.dispense(55, plate["A1"])
        pipette.dispense(60, plate["B1"])
        pipette.drop_tip()

    assert told(protocol, False) == [False, False]


def test_after_liquid_is_put_back_by_hand_nothing_is_told() -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        deliver(pipette, reservoir["A1"], reservoir["A1"])
        deliver(pipette, reservoir["A1"], plate["A1"])
        pipette.drop_tip()

    assert told(protocol) == [None]


def test_liquids_of_several_wells_and_tips_over_several_wells_are_told_of_as_unknown() -> None:
    def pooled(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        pipette.aspirate(50, reservoir["A1"])
        pipette.aspirate(50, reservoir["A2"])
        pipette.dispense(100, plate["A1"])
        pipette.drop_tip()

    def row(context: Any) -> None:
        pipette, reservoir, plate = flex(context, "flex_8channel_1000")
        for source in (reservoir["A1"], plate["A2"]):
            pipette.pick_up_tip()
            pipette.detect_liquid_presence(source)
            deliver(pipette, source, plate["A1"])
            pipette.drop_tip()

    assert told(pooled, True) == told(pooled, False) == [None]
    assert told(row) == [True, None]


def each(protocol: Callable[[Any], None], word: bool) -> dict[str, bool]:
    """What the keyframes of one delivery say of its nozzles, where they say anything."""
    recorder = record(protocol, "2.20", "Flex", probe=Sensor(word))
    said = {(keyframe.nozzles, keyframe.channels_found) for keyframe in recorder.keyframes}
    assert {keyframe.liquid_found for keyframe in recorder.keyframes} == {None}
    nozzles, found = said.pop()
    assert not said
    return {n: known for n, known in zip(nozzles, found, strict=False) if known is not None}


def between_plates(name: str, first: str = "A1", **layout: Any) -> Callable[[Any], None]:
    """One delivery of a head of which ``first`` is the nozzle that the protocol names."""

    def protocol(context: Any) -> None:
        pipette, _, plate = flex(context, name)
        target = context.load_labware("nest_96_wellplate_200ul_flat", "D2")
        tips = pipette.tip_racks
        if name == "flex_96channel_1000":
            adapter = context.load_adapter("opentrons_flex_96_tiprack_adapter", "A1")
            tips = [adapter.load_labware(WITH_TIP)]
        if layout:
            pipette.configure_nozzle_layout(**layout, start=first, tip_racks=tips)
        pipette.pick_up_tip(None if layout else tips[0]["A1"])
        pipette.detect_liquid_presence(plate[first])
        deliver(pipette, plate[first], target[first])
        pipette.drop_tip()

    return protocol


def test_of_a_column_no_liquid_holds_for_the_ends_and_liquid_for_none() -> None:
    column = between_plates("flex_8channel_1000")
    assert each(column, False) == {"A1": False, "H1": False}
    assert each(column, True) == {}


def test_of_a_part_of_a_column_the_one_tip_with_a_sensor_speaks() -> None:
    part = between_plates("flex_8channel_1000", "H1", style=PARTIAL_COLUMN, end="E1")
    assert each(part, True) == {"H1": True}
    assert each(part, False) == {"H1": False}


def test_of_a_whole_head_two_corners_speak() -> None:
    whole = between_plates("flex_96channel_1000")
    assert each(whole, False) == {"A1": False, "H12": False}
    assert each(whole, True) == {}


@pytest.mark.parametrize("meanwhile", ["pause", "moved", "filled", "other"])
def test_what_was_said_holds_until_the_well_may_be_another(meanwhile: str) -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        tips = context.load_labware(WITH_TIP, "B3")
        other = context.load_instrument("flex_1channel_1000", "right", [tips])
        target = reservoir["A1"] if meanwhile == "filled" else reservoir["A3"]
        other.pick_up_tip()
        other.aspirate(50, reservoir["A2"])
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        if meanwhile == "pause":
            context.pause("Please fill it.")
        elif meanwhile == "moved":
            context.move_labware(reservoir, "D1", use_gripper=False)
        else:
            other.dispense(50, target)
        deliver(pipette, reservoir["A1"], plate["A1"])
        pipette.drop_tip()
        other.drop_tip()

    assert told(protocol, False)[-1] is (False if meanwhile == "other" else None)


def test_a_probe_that_raised_leaves_no_older_word_behind() -> None:
    def protocol(context: Any) -> None:
        pipette, reservoir, plate = flex(context)
        pipette.pick_up_tip()
        pipette.detect_liquid_presence(reservoir["A1"])
        with pytest.raises(ValueError, match="no liquid"):
            pipette.require_liquid_presence(reservoir["A1"])
        deliver(pipette, reservoir["A1"], plate["A1"])
        pipette.drop_tip()

    def refusing(operation: Operation) -> bool | None:
        return True

    recorder = record(_failing(protocol), "2.20", "Flex", probe=refusing)
    assert {keyframe.liquid_found for keyframe in recorder.keyframes} == {None}


def _failing(protocol: Callable[[Any], None]) -> Callable[[Any], None]:
    """``protocol`` on a robot that finds no liquid when liquid is required."""

    def run(context: Any) -> None:
        from opentrons.protocol_api.core.engine.instrument import InstrumentCore

        def fail(*_: Any) -> None:
            raise ValueError("no liquid")

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(InstrumentCore, "liquid_probe_with_recovery", fail)
            protocol(context)

    return run
