# expect: pcr pass PCR-4!
"""Two assays on nine soil extracts.

Plate:
  columns 1-3  DNA with assay 1, columns 5-7  DNA with assay 2
  columns 4, 8  controls of the assay on their left:
     rows A-C positive control, rows D-F no template
"""

metadata = {"apiLevel": "2.13"}
LEFT, RIGHT = 4, 8


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in ("7", "8", "9")]
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "1", "plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "reagents")
    dna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "3", "DNA extracts")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    mixes, plasmid, water = (rack["A1"], rack["A2"]), rack["B1"], rack["C1"]
    for mix, last in zip(mixes, (LEFT, RIGHT)):
        for column in range(last - 3, last + 1):
            for row in "ABCDEF":
                p20.transfer(15, mix, plate[f"{row}{column}"], new_tip="always")
        for column in range(last - 3, last):
            for row in "ABCDEF":
                source = dna[f"{row}{(column - 1) % 4 + 1}"]
                p20.transfer(5, source, plate[f"{row}{column}"], new_tip="always")
        for row in "ABC":
            p20.transfer(5, plasmid, plate[f"{row}{last}"], new_tip="always")
        for row in "DEF":
            p20.transfer(5, water, plate[f"{row}{last}"], new_tip="always")
