# expect: pcr fail PCR-4
metadata = {"protocolName": "Mosquito barcoding PCR", "apiLevel": "2.13"}
PICKS = """
A1;A1;larva
B1;B1;larva
C1;C1;larva
D1;D1;larva
H12;G1;NTC
D1;H1;NTC
"""


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 4)]
    source = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "DNA")
    target = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    mix = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5, "COI master mix")["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    for line in PICKS.split():
        start, end, kind = line.split(";")
        p20.transfer(18, mix, target[end], new_tip="always")
        p20.transfer(2, source[start], target[end], new_tip="always")
