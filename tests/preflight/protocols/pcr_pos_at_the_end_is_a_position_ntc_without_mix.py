# expect: pcr fail PCR-1
"""Zygosity by PCR: six ear clips, one no-template control, two tubes of mix."""

metadata = {"apiLevel": "2.13"}

MIX_POS = ["D1", "D2"]
SAMPLE_POS = ["A1", "B1", "C1", "D1", "E1", "F1"]


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    clips = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    pcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    box = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[box])
    water, ntc = rack["D6"], pcr["H1"]

    halves = [SAMPLE_POS[:3], SAMPLE_POS[3:]]
    for tube, half in zip(MIX_POS, halves):
        for spot in half:
            p20.transfer(15, rack[tube], pcr[spot])
    p20.transfer(5, water, ntc)
    for i, spot in enumerate(SAMPLE_POS):
        p20.transfer(5, clips.wells()[i], pcr[spot])
