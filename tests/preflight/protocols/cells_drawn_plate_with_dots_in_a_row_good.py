# expect: cell_treatment pass CELL-1!
"""Parasite cultures, eight antimalarials.

     1    2    3    4    5    6
A   veh  cpd  ...            veh
B   veh  cpd  ...            veh
C   veh  cpd  ...            veh
D   veh  cpd  ...            veh

veh = vehicle, cpd = compound
"""

metadata = {"protocolName": "Antimalarials", "apiLevel": "2.13"}


def run(ctx):
    library = ctx.load_labware("nest_96_wellplate_200ul_flat", 1, "compounds")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 3, "infected cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso = tubes["A1"]

    for row, name in enumerate("ABCD"):
        wells = plate.rows_by_name()[name]
        p20.transfer(5, dmso, [wells[0], wells[5]], new_tip="always")
        p20.transfer(5, library.rows()[row][1:5], wells[1:5], new_tip="always")
