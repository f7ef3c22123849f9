# expect: cell_treatment pass
"""Docetaxel on PC-3

Cell plate, slot 4
   column 1     vehicle control (ethanol), rows A-D
   column 2     2 nM     rows A-D
   column 3     6 nM     rows A-D
   column 4     20 nM    rows A-D
Tubes, slot 5
   A1 ethanol 1 mL; A2 2 nM, A3 6 nM, A4 20 nM (final), 2 mL each
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    p = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    r = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    k = ctx.load_labware("opentrons_96_filtertiprack_200ul", 9)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[k])
    for c, s in enumerate(("A1", "A2")):
        p300.transfer(40, r[s], [w.top() for w in p.columns()[c][:4]], new_tip="once")
    p300.pick_up_tip()
    for c, s in ((2, "A3"), (3, "A4")):
        for w in p.columns()[c][:4]:
            p300.aspirate(40, r[s])
            p300.dispense(40, w)
    p300.drop_tip()
