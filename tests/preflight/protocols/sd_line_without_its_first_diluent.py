# expect: serial_dilution fail SD-3
"""The stock stands at the head of the column and is diluted down it."""

metadata = {"apiLevel": "2.13", "protocolName": "Compound dilution"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 2)
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", 3)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    dmso, compound = trough["A1"], tubes["A1"]
    column = plate.columns()[0][:7]
    p.transfer(100, dmso, column[2:], new_tip="once")
    p.transfer(200, compound, column[0])
    p.transfer(100, column[:6], column[1:], mix_after=(5, 100), new_tip="always")
