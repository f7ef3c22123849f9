# expect: cell_treatment warn CELL-2
"""Staurosporine on HeLa, one plate.

columns 11 and 12, rows A through H: vehicle controls
columns 1 to 5: staurosporine 100 nM
"""

metadata = {"protocolName": "Staurosporine", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    vehicle, staurosporine = tubes["D1"], tubes["D2"]
    edge = [well for column in plate.columns()[10:] for well in column[:6]]
    p300.transfer(30, vehicle, edge, new_tip="always")
    for column in plate.columns()[:5]:
        p300.transfer(30, staurosporine, column, new_tip="always")
