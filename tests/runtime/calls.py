"""The calls of the table in ``docs/reference/keyframes.md``, by the name in its first column."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

RuleContext = tuple[Callable[[Any], None], str, str, dict[str, Any]]
CASES: dict[str, RuleContext] = {}


def case(api: str = "2.15", robot: str = "OT-2", **settings: Any) -> Any:
    def register(function: Callable[[Any], None]) -> Callable[[Any], None]:
        CASES[function.__name__.replace("_", " ")] = (function, api, robot, settings)
        return function

    return register


def deck(context: Any, name: str = "p300_single_gen2", mount: str = "left") -> tuple[Any, Any]:
    slot = "1" if mount == "left" else "4"
    tips = context.load_labware("opentrons_96_tiprack_300ul", slot)
    plate = context.loaded_labwares.get(2) or context.load_labware(
        "corning_96_wellplate_360ul_flat", "2"
    )
    return plate, context.load_instrument(name, mount, [tips])


def flex(context: Any, name: str = "flex_1channel_1000") -> tuple[Any, Any, Any, Any]:
    tips = context.load_labware("opentrons_flex_96_tiprack_200ul", "C1")
    plate = context.load_labware("corning_96_wellplate_360ul_flat", "C2")
    trash = context.load_trash_bin("A3")
    return plate, context.load_instrument(name, "left", [tips]), trash, tips


@case()
def aspirate_and_dispense(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    pipette.drop_tip()


@case(lift=False)
def without_lift(context: Any) -> None:
    aspirate_and_dispense(context)


@case(hold="off")
def with_hold_off(context: Any) -> None:
    aspirate_and_dispense(context)


@case(hold="well")
def with_hold_well(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"].top())
    pipette.move_to(plate["A3"].top())
    pipette.drop_tip()


@case()
def dispense_from_above(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"].top(2))
    pipette.return_tip()


@case()
def moves_written_out(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.move_to(plate["A1"].bottom(1))
    pipette.aspirate(50)
    pipette.move_to(plate["A2"].bottom(1))
    pipette.dispense(50)
    pipette.move_to(plate["A2"].top())
    pipette.drop_tip()


@case()
def bare_coordinates(context: Any) -> None:
    from opentrons.types import Location, Point

    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, Location(Point(200, 200, 50), None))
    pipette.drop_tip()


@case()
def transfer(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10])


@case()
def transfer_with_one_tip(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10], new_tip="once")


@case()
def transfer_with_extras(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(
        50,
        plate["A1"],
        plate["A2"],
        mix_before=(2, 30),
        mix_after=(2, 30),
        air_gap=10,
        touch_tip=True,
        blow_out=True,
        blowout_location="destination well",
    )


@case()
def transfer_with_blow_out_in_source(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(50, plate["A1"], plate["A2"], blow_out=True, blowout_location="source well")


@case()
def transfer_in_two_strokes(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(400, plate["A1"], plate["A2"], new_tip="once")


@case()
def distribute(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.distribute(50, plate["A1"], plate.wells()[8:10])


@case()
def consolidate(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.consolidate(50, plate.wells()[:3], plate["A2"])


@case()
def consolidate_with_air_gap(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.consolidate(50, plate.wells()[:3], plate["A2"], air_gap=10)


@case()
def multi_dispense_with_rest_to_trash(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(120, plate["A1"])
    pipette.dispense(50, plate["A2"])
    pipette.dispense(50, plate["B2"])
    pipette.dispense(20, context.fixed_trash["A1"])
    pipette.drop_tip()


@case()
def two_dispenses_into_one_well(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(100, plate["A1"])
    pipette.dispense(50, plate["A2"])
    pipette.dispense(50, plate["A2"])
    pipette.drop_tip()


@case()
def mix(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.mix(3, 50, plate["A1"])
    pipette.drop_tip()


@case()
def mix_by_hand(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    for _ in range(3):
        pipette.aspirate(50, plate["A1"])
        pipette.dispense(50, plate["A1"])
    pipette.drop_tip()


@case()
def mix_by_hand_in_destination(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    for _ in range(2):
        pipette.aspirate(40, plate["A2"])
        pipette.dispense(40, plate["A2"])
    pipette.blow_out(plate["A2"].top())
    pipette.drop_tip()


@case()
def serial_dilution(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.transfer(
        50, plate.rows()[0][:2], plate.rows()[0][1:3], mix_after=(2, 50), new_tip="once"
    )


@case()
def blow_out_as_delivery(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.blow_out(plate["A2"])
    pipette.drop_tip()


@case()
def blow_out_in_trash(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    pipette.blow_out(context.fixed_trash["A1"])
    pipette.drop_tip()


@case()
def air_only(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"].top(5))
    pipette.dispense(50, plate["A2"].top(5))
    pipette.drop_tip()


@case()
def touch_tip_in_another_well(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    pipette.touch_tip(plate["A2"])
    pipette.touch_tip(plate["A3"])
    pipette.drop_tip()


@case()
def tip_dropped_full(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.drop_tip()


@case()
def put_back_after_a_walk(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.move_to(plate["A2"].top(10))
    pipette.dispense(50, plate["A1"])
    pipette.drop_tip()


@case()
def eight_channels(context: Any) -> None:
    plate, pipette = deck(context, "p300_multi_gen2")
    pipette.transfer(50, plate["A1"], plate["A2"])


@case(api="2.20", robot="Flex")
def part_of_the_nozzles(context: Any) -> None:
    from opentrons.protocol_api import PARTIAL_COLUMN

    plate, pipette, trash, tips = flex(context, "flex_8channel_1000")
    pipette.configure_nozzle_layout(PARTIAL_COLUMN, start="H1", end="G1", tip_racks=[tips])
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["B1"])
    pipette.dispense(50, plate["B2"])
    pipette.drop_tip(trash)


@case()
def two_pipettes(context: Any) -> None:
    plate, left = deck(context)
    _, right = deck(context, mount="right")
    left.pick_up_tip()
    right.pick_up_tip()
    left.aspirate(50, plate["A1"])
    right.aspirate(50, plate["B1"])
    left.dispense(50, plate["A2"])
    right.dispense(50, plate["B2"])
    left.drop_tip()
    right.drop_tip()


@case()
def two_pipettes_in_one_well(context: Any) -> None:
    plate, left = deck(context)
    _, right = deck(context, mount="right")
    left.pick_up_tip()
    left.aspirate(50, plate["A1"])
    left.dispense(50, plate["A2"])
    right.pick_up_tip()
    right.aspirate(50, plate["A2"])
    right.dispense(50, plate["A3"])
    right.drop_tip()
    left.drop_tip()


@case()
def pause_before_the_tip_goes(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    context.pause("look at it")
    pipette.drop_tip()


@case()
def destination_moved(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])
    context.move_labware(plate, "3")
    pipette.drop_tip()


@case()
def delay_after_the_dispense(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    context.delay(1)
    pipette.dispense(50, plate["A2"])
    context.delay(1)
    pipette.drop_tip()


@case()
def end_of_the_run_with_the_tip_on(context: Any) -> None:
    plate, pipette = deck(context)
    pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"])


@case(api="2.24", robot="Flex")
def transfer_with_liquid_class(context: Any) -> None:
    plate, pipette, trash, _ = flex(context)
    water = context.get_liquid_class("water")
    pipette.transfer_with_liquid_class(
        water, 50, plate.wells()[:2], plate.wells()[8:10], trash_location=trash
    )


@case(api="2.24", robot="Flex")
def distribute_with_liquid_class(context: Any) -> None:
    plate, pipette, trash, _ = flex(context)
    water = context.get_liquid_class("water")
    pipette.distribute_with_liquid_class(
        water, 30, plate["A1"], plate.wells()[8:10], trash_location=trash
    )


@case(api="2.24", robot="Flex")
def consolidate_with_liquid_class(context: Any) -> None:
    plate, pipette, trash, _ = flex(context)
    water = context.get_liquid_class("water")
    pipette.consolidate_with_liquid_class(
        water, 30, plate.wells()[:2], plate["A2"], trash_location=trash
    )
