"""The tap on the real simulator: every path, every core, and nothing left behind."""

from __future__ import annotations

import gc
import weakref

import pytest

from aegis_ot.adapters.opentrons.instrumentation import EventKind, OperationKind, tapped
from aegis_ot.adapters.opentrons.rehearsal.simulated_context import simulated_context
from tests.support.rehearsing import Heard, flex, ot2, run

K = OperationKind
LEVELS = ["2.0", "2.13", "2.14", "2.20"]


def addresses(operation):
    return [None if well is None else well.address for well in operation.wells]


@pytest.mark.parametrize("level", LEVELS)
def test_transfer_is_heard_move_by_move(level):
    heard, _ = run(ot2("single.transfer(50, reservoir['A1'], plate['B2'])", level))
    liquid = heard.of(K.PICK_UP_TIP, K.ASPIRATE, K.DISPENSE, K.DROP_TIP)
    assert [o.kind for o in liquid] == [K.PICK_UP_TIP, K.ASPIRATE, K.DISPENSE, K.DROP_TIP]
    assert addresses(liquid[1]) == ["2:A1"]
    assert addresses(liquid[2]) == ["1:B2"]
    assert [o.volume for o in liquid[1:3]] == [50, 50]
    assert {o.call for o in liquid} == {"transfer"}
    assert liquid[3].disposal
    assert liquid[2].from_bottom == pytest.approx(1.0, abs=0.01)
    assert liquid[2].from_top < 0


@pytest.mark.parametrize("level", ["2.13", "2.20"])
def test_heights_stay_true_when_a_labware_gets_another_offset(level):
    heard, _ = run(
        ot2(
            """
            single.pick_up_tip()
            single.aspirate(20, plate["B1"].bottom(2))
            plate.set_offset(0, 0, 3)
            single.dispense(20, plate["B1"].bottom(2))
            """,
            level,
        )
    )
    heights = [o.from_bottom for o in heard.of(K.ASPIRATE, K.DISPENSE)]
    assert heights == pytest.approx([2, 2], abs=0.01)


def test_heights_stay_true_when_a_plate_moves_onto_a_module():
    heard, _ = run(
        ot2(
            """
            block = protocol.load_module("temperature module gen2", 9)
            single.pick_up_tip()
            single.aspirate(20, plate["B1"].bottom(2))
            protocol.move_labware(plate, block)
            single.dispense(20, plate["B1"].bottom(2))
            """,
            "2.20",
        )
    )
    heights = [o.from_bottom for o in heard.of(K.ASPIRATE, K.DISPENSE)]
    assert heights == pytest.approx([2, 2], abs=0.01)


@pytest.mark.parametrize("level", LEVELS)
def test_each_operation_is_heard_once(level):
    heard, _ = run(
        ot2(
            """
            single.pick_up_tip()
            single.aspirate(20, plate["B1"])
            single.touch_tip()
            single.dispense(20, plate["A1"])
            single.blow_out(plate["A1"].top())
            single.return_tip()
            """,
            level,
        )
    )
    kinds = [o.kind for o in heard.operations if o.kind is not K.MOVE]
    assert kinds == [K.PICK_UP_TIP, K.ASPIRATE, K.TOUCH_TIP, K.DISPENSE, K.BLOW_OUT, K.DROP_TIP]
    assert [id(o) for o in heard.announced] == [id(o) for o in heard.operations]
    assert heard.operations[-1].well.name == "A1"  # the tip went home


@pytest.mark.parametrize("level", LEVELS)
def test_source_lines_through_helpers_innermost_first(level):
    text = ot2(
        """
        def give(volume, well):
            single.transfer(volume, reservoir["A1"], well)
        give(20, plate["A1"])
        """,
        level,
    )
    heard, _ = run(text)
    lines = text.splitlines()
    inner = next(i for i, line in enumerate(lines, 1) if "single.transfer" in line)
    outer = next(i for i, line in enumerate(lines, 1) if "give(20" in line)
    assert {o.lines for o in heard.operations} == {(inner, outer)}


@pytest.mark.parametrize("level", LEVELS)
def test_mixes_are_known_as_mixes(level):
    heard, _ = run(
        ot2("single.transfer(50, reservoir['A1'], plate['B2'], mix_after=(2, 30))", level)
    )
    assert [o.mixing for o in heard.of(K.ASPIRATE)] == [False, True, True]


@pytest.mark.parametrize("level", ["2.13", "2.20", "2.22"])
def test_an_air_gap_is_air(level):
    heard, _ = run(
        ot2(
            """
            single.pick_up_tip()
            single.aspirate(50, reservoir["A1"])
            single.air_gap(10)
            single.dispense(60, plate["A1"])
            single.drop_tip()
            """,
            level,
        )
    )
    gap = next(o for o in heard.operations if o.kind is K.AIR_GAP)
    assert gap.is_air
    assert gap.volume == 10
    assert heard.of(K.DISPENSE)[0].volume == 60


def test_eight_channels_are_eight_wells_and_one_reservoir_well():
    heard, _ = run(ot2("multi.transfer(50, reservoir['A3'], plate['A2'])"))
    aspirate, dispense = heard.of(K.ASPIRATE, K.DISPENSE)
    assert addresses(aspirate) == ["2:A3"] * 8
    assert addresses(dispense) == [f"1:{row}2" for row in "ABCDEFGH"]
    assert aspirate.nozzles == tuple(f"{row}1" for row in "ABCDEFGH")


def test_eight_channels_take_every_second_row_of_384():
    heard, _ = run(
        ot2(
            """
            big = protocol.load_labware("corning_384_wellplate_112ul_flat", 4)
            multi.transfer(20, reservoir["A1"], big["B3"])
            """
        )
    )
    assert addresses(heard.of(K.DISPENSE)[0]) == [f"4:{row}3" for row in "BDFHJLNP"]


@pytest.mark.parametrize("level", LEVELS)
def test_a_point_beside_the_well_is_over_another_well_or_none(level):
    """Half the tips of eight channels are taken to another row by an offset."""
    heard, _ = run(
        ot2(
            """
            from opentrons.types import Point
            multi.pick_up_tip()
            multi.aspirate(20, reservoir["A1"])
            multi.dispense(10, plate["A2"].bottom(2).move(Point(y=36)))
            multi.dispense(10, plate["A2"].bottom(2).move(Point(x=3)))
            multi.drop_tip()
            """,
            level,
        )
    )
    rear, wall = heard.of(K.DISPENSE)
    assert addresses(rear) == [None] * 4 + [f"1:{row}2" for row in "ABCD"]
    assert addresses(wall) == [f"1:{row}2" for row in "ABCDEFGH"]
    assert rear.from_bottom == wall.from_bottom == pytest.approx(2)


def test_a_partial_nozzle_layout_touches_its_wells_only():
    heard, _ = run(
        ot2(
            """
            from opentrons.protocol_api import PARTIAL_COLUMN, SINGLE
            multi.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[tips])
            multi.transfer(20, reservoir["A1"], plate["D5"])
            multi.configure_nozzle_layout(style=PARTIAL_COLUMN, start="H1", end="F1",
                                          tip_racks=[tips])
            multi.pick_up_tip(tips["C2"])
            multi.aspirate(20, reservoir["A1"])
            multi.dispense(20, plate["C6"])
            multi.drop_tip()
            """,
            "2.22",
        )
    )
    one, three = heard.of(K.DISPENSE)
    assert (one.nozzles, addresses(one)) == (("H1",), ["1:D5"])
    assert three.nozzles == ("F1", "G1", "H1")
    assert addresses(three) == ["1:A6", "1:B6", "1:C6"]


def test_liquid_class_transfers_are_heard():
    heard, _ = run(
        flex(
            """
            water = protocol.get_liquid_class("water")
            single.transfer_with_liquid_class(
                water, 50, [reservoir["A1"]], [plate["A1"]], new_tip="once", trash_location=trash)
            """,
            "2.24",
        )
    )
    drawn = [o for o in heard.of(K.ASPIRATE) if not o.is_air and not o.mixing]
    given = [o for o in heard.of(K.DISPENSE) if o.well is not None and o.well.slot == "D1"]
    assert [o.volume for o in drawn] == [50]
    air, liquid = given  # its air gap leaves above the well, the liquid inside
    assert (air.from_top > 0, air.volume, liquid.volume) == (True, 5, 50)
    assert addresses(liquid) == ["D1:A1"]
    assert {o.call for o in drawn + given} == {"transfer_with_liquid_class"}


@pytest.mark.parametrize("text", [ot2("pass"), flex("pass")], ids=["ot2", "flex"])
def test_labware_is_announced_with_its_geometry(text):
    heard, rehearsal = run(text)
    loaded = [e.labware_info for e in heard.events if e.kind is EventKind.LABWARE_LOADED]
    plate = next(info for info in loaded if info.label == "my plate")
    assert plate.wells["A1"].max_volume == 360
    assert plate.wells["A1"].depth == pytest.approx(10.67)
    assert rehearsal.labware[plate.key] == plate


def test_liquids_pauses_comments_and_fresh_tips_are_told():
    heard, _ = run(
        ot2(
            """
            dye = protocol.define_liquid("red dye", "dye", "#ff0000")
            plate["A1"].load_liquid(dye, 100)
            protocol.pause("swap the plate")
            protocol.comment("on we go")
            single.reset_tipracks()
            """
        )
    )
    told = {e.kind: e for e in heard.events}
    assert told[EventKind.LIQUID_LOADED].text == "red dye"
    assert told[EventKind.LIQUID_LOADED].volume == 100
    assert told[EventKind.LIQUID_LOADED].wells[0].name == "A1"
    assert told[EventKind.PAUSED].text == "swap the plate"
    assert told[EventKind.COMMENT].text == "on we go"
    assert told[EventKind.TIPS_RESET].labware


def test_a_moved_plate_keeps_its_key_and_changes_its_slot():
    heard, _ = run(
        flex(
            """
            single.transfer(20, reservoir["A1"], plate["A1"])
            protocol.move_labware(plate, "B2", use_gripper=True)
            single.transfer(20, reservoir["A1"], plate["A1"])
            """
        )
    )
    first, second = (o.well for o in heard.of(K.DISPENSE))
    assert first == second
    assert (first.slot, second.slot) == ("D1", "B2")


def test_names_are_bound_to_wells_even_in_helpers_that_only_speak():
    _, rehearsal = run(
        """
        metadata = {"apiLevel": "2.20"}
        ROWS = "AB"
        def layout(protocol, plate):
            protocol.comment("laying out")
            ntc = plate["H12"]
            return {"samples": [plate[f"{row}1"] for row in ROWS], "blank": ntc}
        def run(protocol):
            plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
            wells = layout(protocol, plate)
        """
    )
    bound = {(b.function, b.name): [w.name for w in b.wells] for b in rehearsal.names}
    assert bound[("layout", "ntc")] == ["H12"]
    assert bound[("run", "wells['samples']")] == ["A1", "B1"]
    assert bound[("run", "wells['blank']")] == ["H12"]
    assert ("run", "plate") in bound


@pytest.mark.parametrize("level", ["2.13", "2.20"])
def test_nothing_is_left_behind(level):
    from opentrons.protocols.api_support.types import APIVersion

    with simulated_context(APIVersion.from_string(level), "OT-2 Standard") as context:
        before = set(vars(context._core))
        heard = Heard()
        with tapped(context, [heard], "x.py") as tap:
            pipette = context.load_instrument("p300_single", "left")
            assert "aspirate" in vars(pipette._core)
        assert set(vars(context._core)) == before
        assert "aspirate" not in vars(pipette._core)
        alive = weakref.ref(tap)
        del tap
        gc.collect()
        assert alive() is None


def test_a_protocols_own_patch_of_a_core_survives():
    heard, _ = run(
        ot2(
            """
            seen = []
            inner = single._core.aspirate
            def spy(*args, **kwargs):
                seen.append(1)
                return inner(*args, **kwargs)
            single._core.aspirate = spy
            single.transfer(20, reservoir["A1"], plate["A1"])
            assert seen == [1]
            """
        )
    )
    assert len(heard.of(K.ASPIRATE)) == 1


def test_labware_that_a_stacker_hands_out_can_be_filled():
    body = """
    stacker = protocol.load_module("flexStackerModuleV1", "D4")
    stacker.set_stored_labware("corning_96_wellplate_360ul_flat", count=1)
    fresh = stacker.retrieve()
    water = protocol.define_liquid("water", "", "#0000ff")
    fresh["B2"].load_liquid(water, 100)
    """
    heard, _ = run(flex(body, "2.25"))
    loaded = [e for e in heard.events if e.kind is EventKind.LIQUID_LOADED]
    assert [(e.text, e.wells[0].name, e.volume) for e in loaded] == [("water", "B2", 100)]


def test_shaking_names_the_plate_on_the_module_and_its_adapter():
    body = """
    shaker = protocol.load_module("heaterShakerModuleV1", "D3")
    adapter = shaker.load_adapter("opentrons_96_flat_bottom_adapter")
    shaken = adapter.load_labware("nest_96_wellplate_200ul_flat")
    shaker.close_labware_latch()
    shaker.set_and_wait_for_shake_speed(500)
    shaker.deactivate_shaker()
    """
    heard, rehearsal = run(flex(body))
    told = [(e.text, e.labware) for e in heard.events if e.kind is EventKind.MODULE]
    assert [text for text, _ in told] == [
        "close labware latch",
        "set and wait for shake speed 500",
        "stop moving",
    ]
    assert {rehearsal.labware[key].load_name for _, key in told} == {"nest_96_wellplate_200ul_flat"}


@pytest.mark.parametrize("level", ["2.14", "2.20"])
def test_temperatures_and_lids_are_told(level):
    body = """
    cycler = protocol.load_module("thermocyclerModuleV2")
    cycler.open_lid()
    cycler.set_block_temperature(95)
    cold = protocol.load_module("temperature module gen2", 4)
    cold.set_temperature(4)
    """
    heard, _ = run(ot2(body, level).replace('360ul_flat", 1', '360ul_flat", 9'))
    texts = [e.text for e in heard.events if e.kind is EventKind.MODULE]
    assert texts[0] == "open lid"
    assert texts[1].startswith("set target block temperature 95")
    assert "set target temperature 4" in texts


def test_a_liquid_is_told_with_its_description():
    body = """
    dye = protocol.define_liquid("reagent 1", "no template control, water", "#ff0000")
    plate["A1"].load_liquid(dye, 100)
    """
    heard, _ = run(ot2(body))
    told = next(e for e in heard.events if e.kind is EventKind.LIQUID_LOADED)
    assert (told.text, told.description) == ("reagent 1", "no template control, water")


def test_a_plate_from_a_stacker_is_announced_and_stays_itself():
    body = """
    stacker = protocol.load_module("flexStackerModuleV1", "D4")
    stacker.set_stored_labware("corning_96_wellplate_360ul_flat", count=1)
    fresh = stacker.retrieve()
    stacker.store()
    again = stacker.retrieve()
    """
    heard, rehearsal = run(flex(body, "2.25"))
    keys = {b.name: b.labware for b in rehearsal.names if b.name in ("fresh", "again")}
    loaded = [e.labware for e in heard.events if e.kind is EventKind.LABWARE_LOADED]
    assert keys["fresh"][0] in loaded
    assert keys["again"] == keys["fresh"]
    texts = [e.text for e in heard.events if e.kind is EventKind.MODULE]
    assert texts == ["retrieve", "store", "retrieve"]
