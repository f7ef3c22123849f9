# expect: pcr fail PCR-1
metadata = {"protocolName": "qPCR from sheet", "apiLevel": "2.13"}
SHEET = """well,src,type
A1,B1,sample
B1,B2,sample
C1,B3,sample
D1,B4,ptc
E1,A2,ntc"""


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    import csv

    rows = list(csv.DictReader(SHEET.splitlines()))
    mm = rack["A1"]
    for r in rows:
        if r["type"] != "ntc":
            p.transfer(15, mm, plate[r["well"]])
    for r in rows:
        p.transfer(5, rack[r["src"]], plate[r["well"]], mix_after=(2, 10))
