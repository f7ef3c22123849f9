"""Pipettes as keys, in module globals, with attributes and methods of the protocol's own."""
from types import MethodType

metadata = {"apiLevel": "2.15"}
requirements = {"robotType": "Flex"}
PIPETTE = None
COUNTS = {}


def measured(self, volume, source, target):
    COUNTS[self] = COUNTS.get(self, 0) + 1
    self.delivered = getattr(self, "delivered", 0) + volume
    return self.transfer(volume, source, target, new_tip="once")


def deliver(target):
    PIPETTE.measured(20, target.parent["A1"], target)


def run(protocol):
    global PIPETTE
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    PIPETTE = protocol.load_instrument("flex_1channel_1000", "right", tip_racks=[tips])
    multi = protocol.load_instrument("flex_8channel_1000", "left", tip_racks=[tips])
    setattr(PIPETTE, "measured", MethodType(measured, PIPETTE))
    PIPETTE.purpose, plate.kept = "samples", []
    smallest = {PIPETTE: 5, multi: 50}
    for target in plate.columns()[1][:2]:
        deliver(target)
        plate.kept.append(target)
    assert protocol.loaded_instruments["right"] is PIPETTE and multi in smallest
    protocol.comment(f"{PIPETTE.purpose} {PIPETTE.delivered} {COUNTS[PIPETTE]} {len(plate.kept)}")
    PIPETTE.pick_up_tip(tips["A2"])
    state = PIPETTE.hw_pipette
    protocol.comment(f"{sorted(state)[:3]} {state.get('has_tip')} {PIPETTE._core.has_tip()}")
    PIPETTE.aspirate(20, plate["A1"])
    protocol.comment(f"{PIPETTE._core.get_current_volume()} {PIPETTE.current_volume}")
    PIPETTE.dispense(20, plate["A3"])
    PIPETTE.drop_tip()
    protocol.comment(f"{[rack is tips for rack in PIPETTE.tip_racks]} {len(protocol.commands()) > 0}")
