# expect: serial_dilution pass
"""Twofold line of eight points, and a quality control made from the fourth by another factor."""

metadata = {"apiLevel": "2.13", "protocolName": "Calibration curve, serial dilution"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    block = ctx.load_labware("nest_96_wellplate_2ml_deep", 3)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, stock = tubes["A1"], tubes["A2"]
    line, control = block.rows()[0][:8], block["A9"]
    p.transfer(200, diluent, line[1:], new_tip="once")
    p.transfer(270, diluent, control)
    p.transfer(400, stock, line[0])
    for source, well in zip(line[:7], line[1:]):
        p.transfer(100, source, well, mix_after=(3, 150), new_tip="always")
    p.transfer(30, line[3], control, mix_after=(3, 150))
