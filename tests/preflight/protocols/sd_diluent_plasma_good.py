# expect: serial_dilution pass
metadata = {"protocolName": "calibrators in plasma, serial dilution", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 1)
    res = ctx.load_labware("nest_12_reservoir_15ml", 2)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent_plasma = res["A1"]
    spiked_plasma = tubes["A1"]
    cal = tubes.wells()[1:8]
    p.transfer(200, diluent_plasma, cal)
    for left, right in zip([spiked_plasma] + cal, cal):
        p.transfer(200, left, right, mix_after=(5, 150), new_tip="always")
