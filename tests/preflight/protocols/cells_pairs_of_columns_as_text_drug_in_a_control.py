# expect: cell_treatment fail CELL-1 CELL-4?
"""Three kinase inhibitors on HCT116, columns of the stock block and of the cells in pairs."""

metadata = {"apiLevel": "2.15", "protocolName": "HCT116 inhibitors"}

PLAN = {
    "trametinib": [("2", "3"), ("3", "4")],
    "alpelisib": [("5", "5"), ("6", "6"), ("7", "7")],
    "palbociclib": [("9", "8"), ("10", "11")],
}
NO_DRUG = ["1", "12"]
VEHICLE = ["2", "11"]


def run(ctx):
    hct = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "HCT116 cells")
    stocks = ctx.load_labware("nest_96_wellplate_2ml_deep", 5, "inhibitors 6x")
    dmso = ctx.load_labware("nest_1_reservoir_195ml", 6, "vehicle, 0.6 % DMSO")["A1"]
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 7)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])

    for name in VEHICLE:
        m300.transfer(30, dmso, hct[f"A{name}"])
    for inhibitor in PLAN:
        m300.pick_up_tip()
        for taken, given in PLAN[inhibitor]:
            m300.aspirate(30, stocks["A" + taken])
            m300.dispense(30, hct["A" + given])
        m300.drop_tip()
