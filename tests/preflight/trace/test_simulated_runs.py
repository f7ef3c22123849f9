"""From a protocol's text to its trace, in Opentrons' simulator: real labware, real pipettes."""

from __future__ import annotations

import textwrap

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script, record
from aegis_ot.preflight.rule_set import load_rules
from aegis_ot.preflight.trace import Trace, Visit, Well, build_trace
from tests.support.rehearsing import flex, ot2

COLUMN = "ABCDEFGH"


def traced(text: str) -> Trace:
    recording = record(Script(textwrap.dedent(text), "protocol.py"))
    return build_trace(recording.log, recording.labware, load_rules().common.pauses)


def well(trace: Trace, address: str) -> Well:
    """The last plate's well that ever stood there under this address."""
    return [one for one in trace.wells.values() if one.ref.address == address][-1]


def told(visit: Visit) -> tuple[str, str, float, bool]:
    return (visit.kind.value, visit.well.ref.address, round(visit.volume, 2), visit.touches)


def test_heights_are_judged_by_the_level_in_real_labware() -> None:
    """50 µL stand 1.5 mm high in a well of 6.86 mm, and 10.67 mm deep."""
    trace = traced(
        ot2(
            """
            single.pick_up_tip()
            single.aspirate(100, reservoir["A1"])
            single.dispense(50, plate["A1"])                 # empty
            single.dispense(10, plate["A1"].bottom(1))       # in the liquid
            single.dispense(10, plate["A1"].bottom(8))       # below the rim, clear of it
            single.dispense(10, plate["A1"].top())
            single.blow_out(plate["A1"].top(2))
            single.touch_tip(plate["A1"])
            single.drop_tip()
            """
        )
    )
    assert [told(visit) for visit in trace.visits] == [
        ("aspirate", "2:A1", 100, True),
        ("dispense", "1:A1", 50, False),
        ("dispense", "1:A1", 10, True),
        ("dispense", "1:A1", 10, False),
        ("dispense", "1:A1", 10, False),
        ("blow_out", "1:A1", 20, False),
        ("touch_tip", "1:A1", 0, False),
    ]
    assert [visit.contact.name for visit in trace.visits] == [
        "WET", "WET", "WET", "CLEAR", "CLEAR", "CLEAR", "CLEAR",
    ]  # fmt: skip
    assert well(trace, "1:A1").volume == pytest.approx(100)


def test_a_nearly_full_tube_is_touched_where_an_empty_one_is_not() -> None:
    trace = traced(
        ot2(
            """
            tubes = protocol.load_labware(
                "opentrons_10_tuberack_falcon_4x50ml_6x15ml_conical", 4)
            water = protocol.define_liquid("Water", "", "#0000ff")
            tubes["A1"].load_liquid(water, 14900)
            tubes["A3"].load_liquid(water, 40000)
            single.pick_up_tip()
            for tube in ("A1", "B1", "B1"):
                single.aspirate(200, tubes["A3"])
                single.dispense(200, tubes[tube].top(-6))
            single.drop_tip()
            """
        )
    )
    given = [told(visit) for visit in trace.visits if visit.kind.value == "dispense"]
    assert given == [
        ("dispense", "4:A1", 200, True),
        ("dispense", "4:B1", 200, False),
        ("dispense", "4:B1", 200, False),
    ]
    assert well(trace, "4:A3").capacity == 50_000
    assert well(trace, "4:B1").capacity == 15_000


def test_heights_over_the_meniscus_are_taken_at_their_word() -> None:
    trace = traced(
        flex(
            """
            water = protocol.define_liquid("Water", "", "#0000ff")
            plate["A1"].load_liquid(water, 200)
            plate["A2"].load_liquid(water, 100)
            single.pick_up_tip()
            single.aspirate(60, plate["A1"].meniscus(z=-1, target="end"))
            single.dispense(20, plate["A2"].meniscus(z=3, target="end"))
            single.dispense(20, plate["A2"].meniscus(z=-1, target="end"))
            single.dispense(20, plate["A2"].meniscus(z=3, target="start"))   # and it rises
            single.drop_tip()
            """,
            "2.23",
        )
    )
    assert [visit.touches for visit in trace.visits] == [True, False, True, True]


@pytest.mark.parametrize("call", ["detect_liquid_presence", "measure_liquid_height"])
def test_a_probe_meets_the_liquid_wherever_it_stands(call: str) -> None:
    """Not at its height, which is unknown: it goes down until it feels the liquid."""
    trace = traced(
        flex(
            f"""
            water = protocol.define_liquid("Water", "", "#0000ff")
            plate["A1"].load_liquid(water, 40)
            single.pick_up_tip()
            single.{call}(plate["A1"])
            single.touch_tip(plate["A1"])
            single.drop_tip()
            """
        )
    )
    assert [visit.contact.name for visit in trace.visits] == ["WET", "CLEAR"]


@pytest.mark.parametrize("level", ["2.13", "2.20"])
def test_a_point_of_a_plate_is_the_well_it_lies_in(level: str) -> None:
    trace = traced(
        ot2(
            """
            from opentrons.types import Location, Point
            single.pick_up_tip()
            single.aspirate(50, Location(reservoir["A3"].bottom(1).point, reservoir))
            single.aspirate(20, Location(plate["B2"].top(5).point, plate))     # air
            single.dispense(70, Location(plate["B3"].bottom(1).point + Point(1, 1, 0), plate))
            single.drop_tip()
            """,
            level,
        )
    )
    assert [told(visit) for visit in trace.visits] == [
        ("aspirate", "2:A3", 50, True),
        ("dispense", "1:B3", 50, False),
    ]


@pytest.mark.parametrize("level", ["2.2", "2.13", "2.20"])
def test_a_returned_tip_is_dirty_even_after_a_reset(level: str) -> None:
    trace = traced(
        ot2(
            """
            single.pick_up_tip(tips["A1"])
            single.aspirate(10, plate["A1"])
            single.return_tip()
            single.pick_up_tip(tips["A1"])
            single.drop_tip(tips["C1"])        # home changes, history does not
            tips.reset()
            single.pick_up_tip(tips["C1"])
            single.aspirate(10, plate["B1"])
            single.drop_tip()
            tips.reset()
            single.pick_up_tip(tips["C1"])     # went to the trash: a new one now
            single.aspirate(10, plate["C1"])
            single.drop_tip()
            """,
            level,
        )
    )
    assert [(v.tip.number, v.session, v.carried) for v in trace.visits] == [
        (0, 1, 0),
        (0, 3, 1),
        (1, 1, 0),
    ]


def test_channels_are_tips_of_their_own_in_plates_reservoirs_and_384() -> None:
    trace = traced(
        ot2(
            """
            trough = protocol.load_labware("nest_1_reservoir_195ml", 4)
            deep = protocol.load_labware("nest_96_wellplate_2ml_deep", 5)
            big = protocol.load_labware("corning_384_wellplate_112ul_flat", 6)
            water = protocol.define_liquid("Water", "", "#0000ff")
            reservoir["A1"].load_liquid(water, 10000)
            multi.pick_up_tip()
            multi.aspirate(50, reservoir["A1"])
            multi.dispense(50, trough["A1"])
            multi.aspirate(40, trough["A1"])
            multi.dispense(40, deep["A1"])
            multi.aspirate(20, deep["A1"])
            multi.dispense(20, big["B1"])
            multi.drop_tip()
            """
        )
    )
    assert len(trace.tips) == 8
    assert well(trace, "2:A1").volume == pytest.approx(10_000 - 8 * 50)
    assert well(trace, "4:A1").volume == pytest.approx(8 * 10)
    assert [well(trace, f"5:{row}1").volume for row in COLUMN] == [20] * 8
    assert [well(trace, f"6:{row}1").volume for row in "BDFHJLNP"] == [20] * 8
    assert "6:A1" not in {one.ref.address for one in trace.wells.values()}
    assert [visit.well.ref.name for visit in trace.visits if visit.tip.number == 2] == [
        "A1", "A1", "A1", "C1", "C1", "F1",
    ]  # fmt: skip


def test_96_channels_all_at_once_and_by_column_row_and_one() -> None:
    trace = traced(
        """
        requirements = {"robotType": "Flex", "apiLevel": "2.24"}
        from opentrons.protocol_api import ALL, COLUMN, ROW, SINGLE

        def run(protocol):
            adapter = protocol.load_adapter("opentrons_flex_96_tiprack_adapter", "A1")
            full = adapter.load_labware("opentrons_flex_96_tiprack_1000ul")
            loose = protocol.load_labware("opentrons_flex_96_tiprack_1000ul", "C2")
            chute = protocol.load_waste_chute()
            bin_ = protocol.load_trash_bin("A3")
            deep = protocol.load_labware("nest_96_wellplate_2ml_deep", "D2")
            trough = protocol.load_labware("nest_1_reservoir_195ml", "D1")
            pipette = protocol.load_instrument("flex_96channel_1000")
            water = protocol.define_liquid("Water", "", "#0000ff")
            trough.load_liquid(["A1"], 100_000, water)
            pipette.configure_nozzle_layout(ALL, tip_racks=[full])
            pipette.pick_up_tip()
            pipette.aspirate(100, trough["A1"])
            pipette.dispense(100, deep["A1"])
            pipette.drop_tip(chute)
            pipette.configure_nozzle_layout(COLUMN, start="A12", tip_racks=[loose])
            pipette.pick_up_tip()
            pipette.aspirate(10, deep["A3"])
            pipette.dispense(10, deep["A4"])
            pipette.drop_tip(bin_)
            pipette.configure_nozzle_layout(SINGLE, start="A12", tip_racks=[loose])
            pipette.pick_up_tip()
            pipette.aspirate(10, deep["A6"])
            pipette.dispense(4, chute)
            pipette.blow_out(bin_)
            pipette.drop_tip()
            pipette.configure_nozzle_layout(ROW, start="A1", tip_racks=[loose])
            pipette.pick_up_tip(loose["A1"])
            pipette.aspirate(5, deep["C1"])
            pipette.dispense(5, deep["D1"])
            pipette.drop_tip()
        """
    )
    assert len(trace.tips) == 96 + 8 + 1 + 12
    volumes = {one.ref.name: one.volume for one in trace.wells.values() if one.capacity < 10_000}
    wanted = {f"{row}{column}": 100.0 for row in COLUMN for column in range(1, 13)}
    for row in COLUMN:
        wanted[f"{row}3"] -= 10
        wanted[f"{row}4"] += 10
    wanted["A6"] -= 10  # into the chute and the bin
    for column in range(1, 13):
        wanted[f"C{column}"] -= 5
        wanted[f"D{column}"] += 5
    assert volumes == pytest.approx(wanted)
    assert well(trace, "D1:A1").volume == pytest.approx(100_000 - 9_600)


def test_air_gaps_are_no_volume_however_they_are_drawn() -> None:
    trace = traced(
        ot2(
            """
            single.pick_up_tip()
            single.aspirate(50, reservoir["A1"])
            single.air_gap(10)
            single.dispense(60, plate["A1"])
            single.aspirate(20, reservoir["A2"].top(3))      # air as well
            single.aspirate(50, reservoir["A1"])
            single.dispense(70, plate["B1"])
            single.drop_tip()
            single.transfer(30, reservoir["A1"], plate["C1"], air_gap=15)
            """
        )
    )
    assert [well(trace, f"1:{name}").volume for name in ("A1", "B1", "C1")] == [50, 50, 30]
    assert "2:A2" not in {one.ref.address for one in trace.wells.values() if one.prefilled}


def test_what_is_returned_to_a_source_is_in_it_and_mixes_nothing() -> None:
    trace = traced(
        ot2(
            """
            water = protocol.define_liquid("Water", "", "#0000ff")
            reservoir["A1"].load_liquid(water, 1000)
            single.distribute(30, reservoir["A1"], plate.columns()[0][:3], disposal_volume=20,
                              blow_out=True, blowout_location="source well")
            single.pick_up_tip()
            single.aspirate(100, reservoir["A1"])
            single.dispense(10, reservoir["A1"])
            single.dispense(60, plate["A2"])
            single.dispense(30, reservoir["A1"])
            single.drop_tip()
            single.distribute(30, reservoir["A1"], plate.columns()[2][:3], disposal_volume=20)
            """
        )
    )
    stock = well(trace, "2:A1")
    assert stock.volume == pytest.approx(1000 - 90 - 60 - 110)  # what went to the trash is gone
    assert stock.mixes == []
    assert not any(visit.mixing for visit in trace.visits)


MIXES = {
    "mix": "single.mix(2, 30, plate['A1'])",
    "mix_after": "single.transfer(20, reservoir['A1'], plate['A1'], mix_after=(2, 30), "
    "new_tip='never')",
    "mix_before": "single.transfer(20, plate['A1'], plate['B1'], mix_before=(2, 30), "
    "new_tip='never')",
    "by hand": "for _ in range(3):\n    single.aspirate(30, plate['A1'].bottom(1))\n"
    "    single.dispense(30, plate['A1'].bottom(6), rate=2)",
    "once by hand, blown out": "single.aspirate(30, plate['A1'])\nsingle.blow_out(plate['A1'])",
    "by hand in two portions": "single.aspirate(30, plate['A1'])\n"
    "single.dispense(20, plate['A1'])\nsingle.dispense(10, plate['A1'])",
}


@pytest.mark.parametrize("how", MIXES)
@pytest.mark.parametrize("level", ["2.13", "2.20"])
def test_every_way_of_mixing_counts(how: str, level: str) -> None:
    body = "single.pick_up_tip()\n" + MIXES[how] + "\nsingle.drop_tip()\n"
    mixed = well(traced(ot2(body, level)), "1:A1")
    assert len(mixed.mixes) == 1


def test_a_mix_in_the_air_above_a_well_is_none() -> None:
    trace = traced(
        ot2("single.pick_up_tip()\nsingle.mix(2, 30, plate['A1'].top(3))\nsingle.drop_tip()")
    )
    assert well(trace, "1:A1").mixes == []


def test_a_liquid_class_mixes_where_it_says_so_and_conditions_without_mixing() -> None:
    trace = traced(
        flex(
            """
            water = protocol.get_liquid_class("water")
            mix = water.get_for(single, tips).dispense.mix
            mix.repetitions, mix.volume = 2, 20
            mix.enabled = True
            single.transfer_with_liquid_class(
                water, 50, reservoir["A1"], plate["A1"], trash_location=trash)
            glycerol = protocol.get_liquid_class("glycerol_50")
            single.distribute_with_liquid_class(
                glycerol, 10, reservoir["A2"], [plate["A2"], plate["B2"], plate["C2"]],
                trash_location=trash)
            """,
            "2.24",
        )
    )
    assert len(well(trace, "D1:A1").mixes) == 1
    conditioned = well(trace, "D2:A2")
    assert any(visit.kind.value == "dispense" for visit in conditioned.visits)
    assert conditioned.mixes == []


def test_declared_liquids_in_all_their_ways() -> None:
    trace = traced(
        flex(
            """
            water = protocol.define_liquid("Water", "from the tap", "#0000ff")
            plate.load_liquid(["A1", "A2"], 50, water)
            plate.load_liquid_by_well({"B1": 10, "B2": 20}, water)
            plate["C1"].load_liquid(water, 30)
            plate.load_empty(["D1"])
            plate["G1"].load_liquid(protocol.define_liquid("Empty tube", "", "#ffffff"), 1)
            plate["H1"].load_liquid(protocol.define_liquid("Empty vector", "", "#ffffff"), 1)
            single.pick_up_tip()
            single.aspirate(25, plate["B2"])
            single.dispense(25, plate["E1"])
            single.aspirate(5, plate["D1"])
            single.aspirate(5, plate["F1"])
            single.drop_tip()
            """
        )
    )
    declared = {one.ref.name: one.declared for one in trace.wells.values()}
    assert declared == {
        "A1": 50, "A2": 50, "B1": 10, "B2": 20, "C1": 30, "D1": 0, "E1": None, "F1": None,
        "G1": 0, "H1": 1,
    }  # fmt: skip
    assert well(trace, "D1:A1").liquids == ["Water"]
    assert well(trace, "D1:G1").liquids == []
    assert trace.descriptions == {"Water": "from the tap"}
    # Declared to be empty is known; a well that nobody spoke of may have held anything.
    assert [(item.visit.well.ref.name, item.limit) for item in trace.imbalances] == [
        ("B2", 20),
        ("D1", 0),
    ]


def test_a_plate_moved_on_the_deck_stays_itself_and_one_taken_off_does_not() -> None:
    trace = traced(
        """
        requirements = {"robotType": "Flex", "apiLevel": "2.23"}

        def run(protocol):
            tips = protocol.load_labware("opentrons_flex_96_tiprack_50ul", "C2")
            chute = protocol.load_waste_chute()
            shaker = protocol.load_module("heaterShakerModuleV1", "D1")
            adapter = shaker.load_adapter("opentrons_96_pcr_adapter")
            cycler = protocol.load_module("thermocyclerModuleV2")
            kind = "opentrons_96_wellplate_200ul_pcr_full_skirt"
            first = protocol.load_labware(kind, "D2", "first")
            second = protocol.load_labware(kind, "C3", "second")
            pipette = protocol.load_instrument("flex_1channel_50", "left", [tips])

            def use(plate):
                pipette.aspirate(10, plate["A1"])
                pipette.dispense(10, plate["B1"])

            cycler.open_lid()
            shaker.close_labware_latch()
            pipette.pick_up_tip()
            use(first)
            shaker.open_labware_latch()
            protocol.move_labware(first, adapter, use_gripper=True)
            shaker.close_labware_latch()
            shaker.set_and_wait_for_shake_speed(500)
            shaker.deactivate_shaker()
            use(first)
            shaker.open_labware_latch()
            protocol.move_labware(first, cycler, use_gripper=True)
            shaker.close_labware_latch()
            use(first)
            protocol.move_labware(first, chute, use_gripper=True)
            protocol.move_labware(second, "D2", use_gripper=True)
            use(second)
            pipette.drop_tip(chute)
        """
    )
    given = [visit for visit in trace.visits if visit.kind.value == "dispense"]
    assert [visit.touches for visit in given] == [False, True, True, False]
    assert given[0].well is given[1].well is given[2].well
    assert given[3].well.ref.label == "second"
    (shaken,) = trace.shaken
    assert shaken[1] == {given[0].well.ref.labware}


@pytest.mark.parametrize("level", ["2.0", "2.13"])
def test_a_plate_deleted_from_the_deck_makes_room_for_a_new_one(level: str) -> None:
    trace = traced(
        ot2(
            """
            single.pick_up_tip()
            for _ in range(2):
                single.aspirate(10, reservoir["A1"])
                single.dispense(10, plate["B1"])
                del protocol.deck["1"]
                plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
            single.drop_tip()
            """,
            level,
        )
    )
    given = [visit for visit in trace.visits if visit.kind.value == "dispense"]
    assert [visit.touches for visit in given] == [False, False]
    assert given[0].well is not given[1].well
    assert [visit.well.volume for visit in given] == [10, 10]


@pytest.mark.parametrize("level", ["2.2", "2.13", "2.20"])
def test_plates_on_modules_are_followed_at_every_api_level(level: str) -> None:
    trace = traced(
        f"""
        metadata = {{"apiLevel": "{level}"}}

        def run(protocol):
            cool = protocol.load_module("temperature module gen2", 3)
            blocks = cool.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap")
            magnet = protocol.load_module("magnetic module gen2", 1)
            beads = magnet.load_labware("biorad_96_wellplate_200ul_pcr")
            cycler = protocol.load_module("thermocycler")
            plate = cycler.load_labware("nest_96_wellplate_100ul_pcr_full_skirt")
            tips = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
            pipette = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
            cycler.open_lid()
            pipette.transfer(15, blocks["A1"], beads["C2"])
            magnet.engage(height_from_base=5)
            pipette.transfer(10, beads["C2"], plate["D3"])
            cycler.close_lid()
            cycler.set_block_temperature(95, hold_time_seconds=3)
        """
    )
    assert well(trace, "1:C2").volume == pytest.approx(5)
    assert well(trace, "7:D3").volume == pytest.approx(10)
    assert len(trace.tips) == 2
