"""Coomassie protein assay. Standards in column 1-2 in duplicate, unknowns after."""

metadata = {"apiLevel": "2.13"}
STD_CONC = [0, 125, 250, 500, 750, 1000, 1500, 2000]  # ug/mL


def run(ctx):
    t20 = [ctx.load_labware("opentrons_96_tiprack_20ul", s) for s in (7, 8)]
    t300 = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (10, 11)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=t20)
    m300 = ctx.load_instrument("p300_multi_gen2", "right", tip_racks=t300)
    std_rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "BSA standards")
    unk_rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5, "unknowns")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    coomassie = ctx.load_labware("nest_12_reservoir_15ml", 2)["A1"]
    stds = std_rack.wells()[:8]
    for rep in range(2):
        p20.pick_up_tip()
        for s, w in zip(stds, plate.columns()[rep]):
            p20.aspirate(5, s)
            p20.dispense(5, w)
        p20.drop_tip()
    for i, u in enumerate(unk_rack.wells()[:8]):
        p20.transfer(5, u, [plate.rows()[i][2], plate.rows()[i][3]], new_tip="once")
    m300.pick_up_tip()
    for col in range(4):
        m300.aspirate(250, coomassie)
        m300.dispense(250, plate.columns()[col][0])
        m300.mix(3, 150, plate.columns()[col][0])
    m300.drop_tip()
