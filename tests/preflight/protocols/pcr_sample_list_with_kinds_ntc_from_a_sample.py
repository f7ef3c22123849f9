"""Meat species PCR of order 118, from the sample list of the LIMS."""
import csv

metadata = {"apiLevel": "2.15"}

# rack: C1 2x multiplex master mix, C6 water
SAMPLE_LIST = """tube,well,kind
A1,A1,sample
A2,B1,sample
A3,C1,sample
B1,D1,sample
D1,E1,positive control
A2,F1,no-template control
"""


def run(ctx):
    entries = list(csv.DictReader(SAMPLE_LIST.splitlines()))
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "rack")
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "PCR plate")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.pick_up_tip()
    for entry in entries:
        p20.aspirate(16, rack["C1"])
        p20.dispense(16, plate[entry["well"]])
    p20.drop_tip()
    for entry in entries:
        p20.pick_up_tip()
        p20.aspirate(4, rack[entry["tube"]])
        p20.dispense(4, plate[entry["well"]])
        p20.mix(2, 10, plate[entry["well"]])
        p20.drop_tip()
