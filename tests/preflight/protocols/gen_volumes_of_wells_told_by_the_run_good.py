# expect: generic pass
"""Otter scat extracts to 4 ng/uL in TE, each from its own well."""

metadata = {"protocolName": "Otter scat, dilution to 4 ng/uL", "apiLevel": "2.13"}

EXTRACTS = {"A1": 11.5, "B1": 16.0, "C1": 8.2, "D1": 23.4}
END = 60


def run(ctx):
    extracts = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1, "scat extracts")
    even = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2, "even plate")
    te = ctx.load_labware("nest_12_reservoir_15ml", 3, "TE")["A1"]
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 5)]
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)

    volumes = {well: round(END * 4 / found, 1) for well, found in EXTRACTS.items()}
    for well, dna in volumes.items():
        ctx.comment(f"{well}: {dna} uL DNA + {END - dna:.1f} uL TE")
    p300.pick_up_tip()
    for well, dna in volumes.items():
        p300.transfer(END - dna, te, even[well], new_tip="never")
    p300.drop_tip()
    for well, dna in volumes.items():
        p300.transfer(dna, extracts[well], even[well], new_tip="always")
