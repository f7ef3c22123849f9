"""1:10 in every step; two of them draw from the well before the last"""

metadata = {"apiLevel": "2.13", "protocolName": "ELISA sample dilution"}

# source, destination, µL of the source, µL of diluent
STEPS = [
    ("sample", "A2", 50, 450),
    ("A2", "A3", 50, 450),
    ("A2", "A4", 50, 450),
    ("A4", "A5", 50, 450),
    ("A4", "A6", 50, 450),
]


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    block = ctx.load_labware("nest_96_wellplate_2ml_deep", 3)
    p = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    diluent, sample = tubes["A1"], tubes["A2"]
    for _, well, _, volume in STEPS:
        p.transfer(volume, diluent, block[well], new_tip="always")
    for source, well, volume, _ in STEPS:
        start = sample if source == "sample" else block[source]
        p.transfer(volume, start, block[well], mix_after=(3, 150), new_tip="always")
