# expect: cell_treatment pass
"""BMDM priming with IFN in a 48-well plate; a comment lists what each column is."""

# col 2 RPMI ctrl, cols 3-6 IFN 0.5 2 8 32 ng/ml, col 7 BSA ctrl (IFN is in BSA)

metadata = {"apiLevel": "2.14", "protocolName": "IFN on BMDM"}

NG_ML = (0.5, 2, 8, 32)


def run(ctx):
    bmdm = ctx.load_labware("corning_48_wellplate_1.6ml_flat", 5, "BMDM")
    ifn_rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "IFN 10x")
    bottles = ctx.load_labware("opentrons_6_tuberack_falcon_50ml_conical", 3, "RPMI / BSA")
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    rpmi, bsa = bottles["A1"], bottles["B1"]

    for row in bmdm.rows():
        p300.transfer(20, rpmi, row[1])
        p300.transfer(20, bsa, row[6])
        p300.pick_up_tip()
        for n in range(len(NG_ML)):
            p300.aspirate(20, ifn_rack.wells()[n])
            p300.dispense(20, row[2 + n])
            p300.mix(2, 60, row[2 + n])
        p300.drop_tip()
    p300.transfer(80, rpmi, [row[n].top() for row in bmdm.rows() for n in range(1, 7)])
