"""The table in the documentation, row by row, against Opentrons' simulator."""

from __future__ import annotations

from typing import Any

import pytest

from .calls import CASES, aspirate_and_dispense, deck, transfer_with_extras
from .recorded import record
from .table import rows

TABLE = rows()


def test_every_call_has_a_row_and_every_row_a_call() -> None:
    assert set(TABLE) == set(CASES)


@pytest.mark.parametrize("name", sorted(CASES))
def test_row(name: str) -> None:
    function, api, robot, settings = CASES[name]
    assert " ".join(record(function, api, robot, **settings).words) == TABLE[name]


@pytest.mark.parametrize("api", ["2.0", "2.10", "2.13", "2.14", "2.22"])
def test_other_api_levels_yield_the_same_steps(api: str) -> None:
    steps = [word for word in TABLE["aspirate and dispense"].split() if ":" not in word]
    assert record(aspirate_and_dispense, api).line.split() == steps


@pytest.mark.parametrize("api", ["2.8", "2.10", "2.24"])
def test_extras_at_other_api_levels(api: str) -> None:
    steps = [word for word in TABLE["transfer with extras"].split() if ":" not in word]
    assert record(transfer_with_extras, api).line.split() == steps


def test_loaded_liquids_name_the_reagent() -> None:
    def protocol(context: Any) -> None:
        plate, pipette = deck(context)
        water = context.define_liquid("water", "", "#0000ff")
        plate["A1"].load_liquid(water, 200)
        pipette.transfer(50, plate["A1"], plate["A2"])
        pipette.transfer(50, plate["B1"], plate["B2"])

    reagents = [frame.reagent for frame in record(protocol, "2.15").keyframes]
    assert reagents == ["water"] * 4 + [None] * 4


def test_a_multi_channel_keyframe_names_every_well_once() -> None:
    def protocol(context: Any) -> None:
        plate, pipette = deck(context, "p300_multi_gen2")
        trough = context.load_labware("nest_12_reservoir_15ml", "3")
        pipette.transfer(50, trough["A1"], plate["A2"])

    frame = record(protocol, "2.15").keyframes[-1]
    assert frame.channels == 8
    assert [well.name for well in frame.sources] == ["A1"]
    assert [well.name for well in frame.destinations] == [f"{row}2" for row in "ABCDEFGH"]
    assert frame.nozzles == tuple(f"{row}1" for row in "ABCDEFGH")
    assert [well and well.name for well in frame.targets] == [f"{row}2" for row in "ABCDEFGH"]


def test_channels_that_share_a_trough_have_one_well_each_all_the_same() -> None:
    def protocol(context: Any) -> None:
        rack = context.load_labware("opentrons_96_tiprack_300ul", "1")
        trough = context.load_labware("nest_12_reservoir_15ml", "2")
        pipette = context.load_instrument("p300_multi_gen2", "left", [rack])
        pipette.transfer(50, trough["A1"], trough["A2"])

    frame = record(protocol, "2.15").keyframes[-1]
    assert [well.name for well in frame.destinations] == ["A2"]
    assert [well and well.name for well in frame.targets] == ["A2"] * 8


def test_a_single_tip_names_no_nozzles() -> None:
    def protocol(context: Any) -> None:
        plate, pipette = deck(context)
        pipette.transfer(50, plate["A1"], plate["A2"])

    frame = record(protocol, "2.15").keyframes[-1]
    assert (frame.channels, frame.nozzles, frame.targets) == (1, (), ())


@pytest.mark.parametrize("api", ["2.13", "2.20"])
def test_a_pipette_that_replaces_another_is_named_by_itself(api: str) -> None:
    def protocol(context: Any) -> None:
        plate, pipette = deck(context)
        pipette.transfer(50, plate["A1"], plate["A2"])
        tips = context.load_labware("opentrons_96_tiprack_20ul", "4")
        small = context.load_instrument("p20_single_gen2", pipette.mount, [tips], replace=True)
        small.transfer(5, plate["A1"], plate["A3"])

    frames = record(protocol, api).keyframes
    assert [f.pipette for f in frames] == ["p300_single_gen2"] * 4 + ["p20_single_gen2"] * 4
    assert [f.capacity_ul for f in frames] == [300] * 4 + [20] * 4
    assert [f.tip for f in frames][4:] == ["4:A1"] * 4


def test_what_a_replaced_pipette_owes_is_taken_and_judged() -> None:
    def protocol(context: Any) -> None:
        plate, pipette = deck(context)
        pipette.pick_up_tip()
        pipette.aspirate(50, plate["A1"])
        pipette.dispense(50, plate["A2"])
        tips = context.load_labware("opentrons_96_tiprack_20ul", "4")
        small = context.load_instrument("p20_single_gen2", pipette.mount, [tips], replace=True)
        small.pick_up_tip()
        small.aspirate(5, plate["B1"])
        small.dispense(5, plate["B2"])
        small.drop_tip()

    assert record(protocol, "2.20").line == "A0 ^A2 T0 D0 P0 [0] A1 ^B2 T1 D1 ^B2 P1 [1]"
