# expect: generic fail GEN-1
"""Re-array of six hits of a compound library (10 mM in DMSO) into a fresh plate."""

metadata = {"apiLevel": "2.15"}

HITS = """\
id,from,to
C-04,B4,A1
C-17,C9,B1
C-23,D2,C1
C-31,F6,D1
C-40,G11,E1
C-52,H3,F1
"""


def read(text):
    lines = [line.split(",") for line in text.strip().splitlines()]
    return [tuple(cells) for cells in lines[1:]]


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    library = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])

    p20.pick_up_tip()
    for _, origin, goal in read(HITS):
        p20.aspirate(5, library[origin])
        p20.dispense(5, plate[goal])
    p20.drop_tip()
