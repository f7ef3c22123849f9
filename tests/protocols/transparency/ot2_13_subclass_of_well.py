"""A well with a height of its own: a subclass of Well, and tubes that only carry one."""
from opentrons.protocol_api.labware import Well

metadata = {"apiLevel": "2.13"}


class WellH(Well):
    def __init__(self, well, height=5.0, volume=0):
        super().__init__(well.parent, well._core, well.api_version)
        self.height = height
        self.current_volume = volume

    def take(self, volume):
        self.current_volume -= volume
        self.height = max(1.0, self.height - volume / 100)
        return self.bottom(self.height)


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    stock = WellH(tubes["A1"], height=20, volume=1000)
    for target in plate.columns()[0][:3]:
        pipette.pick_up_tip()
        pipette.aspirate(100, stock.take(100))
        pipette.dispense(100, target)
        pipette.drop_tip()
    protocol.comment(f"{stock.current_volume} {isinstance(stock, Well)} {stock.height:.1f}")
