# expect: pcr pass PCR-4!
"""Otter scat, 16S PCR: as much DNA as there is, water up to 8 uL."""

metadata = {"protocolName": "Otter scat 16S PCR", "apiLevel": "2.13"}

DNA_UL = {"A1": 3.5, "B1": 5.0, "C1": 2.2, "D1": 6.4}


def run(ctx):
    scats = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "scat DNA")
    pcr = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    ntc = pcr["H1"]

    p20.transfer(12, master_mix, [pcr[well] for well in DNA_UL] + [ntc], new_tip="once")
    p20.pick_up_tip()
    for well, dna in DNA_UL.items():
        ctx.comment(f"{well}: {8 - dna:.1f} uL water")
        p20.transfer(8 - dna, water, pcr[well].top(), new_tip="never")
    p20.transfer(8, water, ntc.top(), new_tip="never")
    p20.drop_tip()
    for well, dna in DNA_UL.items():
        p20.transfer(dna, scats[well], pcr[well], new_tip="always")
