# expect: cell_treatment fail CELL-4
from opentrons import protocol_api

metadata = {"protocolName": "gefitinib, HCC827", "apiLevel": "2.11"}

# HCC827 plate: cells in columns 2-11
# gefitinib 10 nM (col 3) to 30 uM (col 9), DMSO control in col 2


def run(protocol: protocol_api.ProtocolContext):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "HCC827 plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "stocks")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "3")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    vehicle = tubes["D6"]
    gefitinib = tubes.wells()[:7]
    pairs = list(zip(gefitinib, range(3, 10)))

    p20.distribute(10, vehicle, [plate[f"{row}2"] for row in "CDE"], new_tip="once")
    p20.pick_up_tip()
    for tube, column in reversed(pairs):
        for row in "CDE":
            p20.transfer(10, tube, plate[f"{row}{column}"], new_tip="never")
    p20.drop_tip()
