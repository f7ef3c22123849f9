"""The smallest guarded protocol: one import, one line above ``run``."""

from aegis_ot import guard

metadata = {"protocolName": "Hello, guard", "apiLevel": "2.15"}


@guard
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    dye = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])

    p300.transfer(100, dye["A1"], plate.columns()[0], new_tip="always")
