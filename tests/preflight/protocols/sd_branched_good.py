# expect: serial_dilution pass
"""1:10 for the line, 1:5 for the points between: the tree is meant"""

metadata = {"apiLevel": "2.13", "protocolName": "ELISA sample dilution"}

# source, destination, µL of the source, µL of diluent
STEPS = [
    ("sample", "A2", 50, 450),
    ("A2", "A5", 50, 450),
    ("A2", "A4", 80, 320),
    ("A5", "A7", 50, 450),
    ("A5", "A6", 80, 320),
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
