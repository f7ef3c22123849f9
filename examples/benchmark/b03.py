import csv
from io import StringIO

metadata = {
    'apiLevel': '2.14',
    'protocolName': 'Equal-volume amplicon pool',
    'description': 'Combines cleaned amplicons into one tube for sequencing',
}

PICKS = """well,volume
A1,75
B1,75
C1,75
D1,75
E1,75
F1,75
G1,75
H1,75
A2,75
B2,75
C2,75
D2,75
E2,75
F2,75
G2,75
H2,75
A3,75
B3,75
C3,75
D3,75
E3,75
F3,75
G3,75
H3,75
"""


def run(protocol):
    rack = protocol.load_labware('opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap', 2, 'pool rack')
    amplicons = protocol.load_labware('nest_96_wellplate_2ml_deep', 5, 'cleaned amplicons')
    tips = protocol.load_labware('opentrons_96_filtertiprack_200ul', 6)
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=[tips])
    amplicon = protocol.define_liquid('amplicon', 'eluted in EB', '#3366ff')

    rows = list(csv.DictReader(StringIO(PICKS)))
    for row in rows:
        amplicons[row['well']].load_liquid(amplicon, 120)

    pool = rack['A1']
    for row in rows:
        p300.pick_up_tip()
        p300.aspirate(float(row['volume']), amplicons[row['well']])
        p300.dispense(float(row['volume']), pool.bottom(5))
        p300.blow_out(pool.top(-2))
        p300.drop_tip()
