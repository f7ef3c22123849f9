import csv

metadata = {'protocolName': 'Normalization', 'author': 'NGS', 'apiLevel': '2.11'}

DATA = """well,sample,water
A1,3.2,16.8
B1,5.5,14.5
C1,2.4,17.6
D1,9.8,10.2
E1,14.0,6.0
F1,4.1,15.9
"""


def run(ctx):
    before = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '1', 'before')
    after = ctx.load_labware('biorad_96_wellplate_200ul_pcr', '2', 'after')
    res = ctx.load_labware('nest_12_reservoir_15ml', '3')
    p20 = ctx.load_instrument('p20_single_gen2', 'right', tip_racks=[ctx.load_labware('opentrons_96_filtertiprack_20ul', '4')])
    for line in csv.DictReader(DATA.splitlines()):
        p20.pick_up_tip()
        p20.aspirate(float(line['water']), res['A1'])
        p20.aspirate(float(line['sample']), before[line['well']])
        p20.dispense(20, after[line['well']])
        p20.mix(3, 15, after[line['well']])
        p20.drop_tip()
