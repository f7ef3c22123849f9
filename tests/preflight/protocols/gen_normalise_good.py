"""Normalise DNA to one concentration: water first, then DNA."""

import csv, io

metadata = {"protocolName": "DNA normalization", "apiLevel": "2.12"}
DATA = """source,dest,dna_ul,water_ul
A1,A1,5,15
B1,B1,8,12
C1,C1,10,10
"""


def run(protocol):
    rows = list(csv.DictReader(io.StringIO(DATA)))
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 4)]
    )
    src = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "source plate")
    dst = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "normalized plate")
    water = protocol.load_labware("nest_12_reservoir_15ml", 3)["A1"]
    p20.pick_up_tip()
    for r in rows:
        p20.transfer(float(r["water_ul"]), water, dst[r["dest"]], new_tip="never")
    p20.drop_tip()
    for r in rows:
        p20.transfer(float(r["dna_ul"]), src[r["source"]], dst[r["dest"]], mix_after=(2, 10))
