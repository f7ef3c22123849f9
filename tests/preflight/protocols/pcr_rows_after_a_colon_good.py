# expect: pcr pass
"""Sex typing of larvae.

rows: A-E samples, F positive, G NTC
"""

metadata = {"apiLevel": "2.13"}


def run(ctx):
    pcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mm = rack["D1"]
    columns = range(3)

    p20.pick_up_tip()
    for c in columns:
        for r in range(7):
            p20.transfer(18, mm, pcr.rows()[r][c], new_tip="never")
    p20.drop_tip()
    for r, tube in enumerate(["A1", "A2", "A3", "A4", "A5", "B1", "B6"]):
        for c in columns:
            p20.transfer(2, rack[tube], pcr.rows()[r][c])
