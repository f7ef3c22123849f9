# expect: cell_treatment fail CELL-1 CELL-2?
from opentrons import types

metadata = {"protocolName": "Agonists on HEK293", "apiLevel": "2.8"}

AGONIST_PLATE = {
    "A1": "agonist 10 nM", "B1": "agonist 100 nM", "C1": "agonist 1 uM", "D1": "vehicle",
}
CONTROL_WELLS = ["D1", "D2", "D3"]
TOUCH = types.Point(x=0, y=0, z=1)


def run(ctx):
    agonist_plate = ctx.load_labware("nest_96_wellplate_2ml_deep", 1)
    hek = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "HEK293 cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for name in AGONIST_PLATE:
        for column in "123":
            p20.pick_up_tip()
            p20.aspirate(15, agonist_plate["C1" if name == "D1" and column == "3" else name])
            p20.dispense(15, hek[name[0] + column].bottom().move(TOUCH))
            p20.drop_tip()
