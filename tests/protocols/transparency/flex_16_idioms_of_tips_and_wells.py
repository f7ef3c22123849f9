"""A well with a height of its own; tips that run out, are pointed at, and go back to their rack."""
from opentrons.protocol_api.labware import OutOfTipsError, Well

metadata = {"apiLevel": "2.16"}
requirements = {"robotType": "Flex"}


class Tube(Well):
    def __init__(self, well, height):
        super().__init__(well.parent, well._core, well.api_version)
        self.height = height

    def take(self, volume):
        self.height = max(1.0, self.height - volume / 100)
        return self.bottom(self.height)


def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    spare = protocol.load_labware("corning_96_wellplate_360ul_flat", "D1")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "D2")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])
    pipette.starting_tip = tips["F12"]
    stock, waits = Tube(tubes["A1"], 20.0), 0
    for target in plate.wells()[:4]:
        try:
            pipette.pick_up_tip()
        except OutOfTipsError:
            waits += 1
            protocol.pause("Put in a new rack and take the plate out.")
            protocol.move_labware(spare, "C1")
            pipette.reset_tipracks()
            pipette.pick_up_tip()
        pipette.aspirate(50, stock.take(50))
        pipette.dispense(50, target)
        if target is plate["B1"]:
            pipette.return_tip()
        else:
            pipette.drop_tip()
    protocol.comment(f"{waits} {stock.height:.1f} {isinstance(stock, Well)} {pipette.starting_tip}")
