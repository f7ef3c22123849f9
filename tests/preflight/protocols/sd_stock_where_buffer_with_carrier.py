# expect: serial_dilution fail SD-4 GEN-3?
metadata = {"apiLevel": "2.14", "protocolName": "standard curve, tenfold dilution"}


def run(ctx):
    block = ctx.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1)
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    te = ctx.define_liquid("TE + 10 ng/uL yeast tRNA", "carrier keeps DNA off the wall", "#ddd")
    dna = ctx.define_liquid("plasmid DNA 1e8 copies/uL", "stock", "#95e")
    trough["A1"].load_liquid(te, 5000)
    block["A1"].load_liquid(dna, 200)
    curve = strips.columns()[0]
    p300.distribute(45, block["A1"], curve[1:], disposal_volume=0)
    p300.transfer(50, block["A1"], curve[0])
    for one, other in zip(curve, curve[1:]):
        p300.transfer(5, one, other, mix_after=(5, 30), new_tip="always")
