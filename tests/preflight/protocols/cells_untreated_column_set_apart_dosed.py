# expect: cell_treatment warn CELL-1
"""Rapamycin on MEFs, a deep dose to the right.

* MEF plate, column 12 - untreated, no additions
* MEF plate, columns 5 - 11 - rapamycin, rising
* MEF plate, column 4 - vehicle (ethanol)
"""

metadata = {"apiLevel": "2.14", "protocolName": "Rapamycin on MEFs"}

NM = [0.1, 0.3, 1, 3, 10, 30, 100]


def run(ctx):
    mefs = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "MEF plate")
    lanes = ctx.load_labware("nest_12_reservoir_15ml", 2, "rapamycin 5x and vehicle")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    treated_columns = mefs.columns()[5:12]

    m300.transfer(40, lanes["A12"], mefs["A4"], new_tip="always")
    for number, column in enumerate(treated_columns):
        ctx.comment(f"rapamycin {NM[number]} nM")
        m300.pick_up_tip()
        m300.aspirate(40, lanes.wells()[number])
        m300.dispense(40, column[0])
        m300.drop_tip()
