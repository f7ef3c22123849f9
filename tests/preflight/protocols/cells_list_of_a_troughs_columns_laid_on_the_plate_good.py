# expect: cell_treatment pass
"""Library in a trough against HeLa; the plate is filled from the right."""

metadata = {"protocolName": "HeLa, library", "apiLevel": "2.13"}
# what stands in the columns of the trough
LANES = "DMSO drug drug drug drug drug drug drug drug drug drug drug".split()


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2, "library")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    vehicle_control = plate.columns()[11]
    for lane, what, column in zip(trough.wells(), LANES, reversed(plate.columns())):
        protocol.comment(what)
        m20.transfer(10, lane, column[0], new_tip="always")
