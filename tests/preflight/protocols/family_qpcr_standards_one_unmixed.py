# expect: serial_dilution fail SD-1
"""Standard curve for the qPCR of tomorrow: plasmid, 1:10, six steps, in strips."""

metadata = {"protocolName": "qPCR standards", "apiLevel": "2.13"}


def run(ctx):
    tubes = ctx.load_labware(
        "opentrons_24_aluminumblock_nest_1.5ml_snapcap", 1, "plasmid 1e8 copies/uL"
    )
    strips = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "curve")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    diluent = trough["A1"]
    plasmid = tubes["A1"]
    wells = strips.columns()[0][:7]
    p300.transfer(72, diluent, wells[1:], new_tip="once")
    p300.transfer(60, plasmid, wells[0])
    for upper, lower in zip(wells, wells[1:]):
        p20.transfer(8, upper, lower)
        if lower is not wells[3]:
            p300.pick_up_tip()
            p300.mix(8, 50, lower)
            p300.drop_tip()
