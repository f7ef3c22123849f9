# expect: bradford pass
"""Two peaks of a gel filtration against ovalbumin, in duplicate; the blank is the buffer."""

metadata = {"apiLevel": "2.14", "protocolName": "Bradford, gel filtration"}

TUBES = [
    ("blank (running buffer)", "A1"),
    ("ovalbumin 0.25 mg/ml", "A2"),
    ("ovalbumin 0.5 mg/ml", "A3"),
    ("ovalbumin 1 mg/ml", "A4"),
    ("peak 1", "B1"),
    ("peak 2", "B2"),
]


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 3, "Bradford dye")["A1"]
    small = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = ctx.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    wells = iter(plate.wells())
    filled = []
    for _, tube in TUBES:
        pair = [next(wells), next(wells)]
        p20.transfer(5, rack[tube], pair, new_tip="once")
        filled.extend(pair)
    for well in filled:
        p300.transfer(195, dye, well, new_tip="always", mix_after=(3, 100))
