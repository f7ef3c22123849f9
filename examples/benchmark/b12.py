import csv

metadata = {
    'protocolName': 'Hit picking from compound library',
    'author': 'Screening group',
    'apiLevel': '2.13',
}

WORKLIST = '''source_plate,source_well,dest_well,ul
1,A3,A1,12
1,C7,B1,12
1,H11,C1,12
2,B2,D1,15
2,D5,E1,12
2,G9,F1,12
3,A12,G1,18
3,F4,H1,12
'''


def run(protocol):
    library = {
        str(n): protocol.load_labware('corning_384_wellplate_112ul_flat', slot, f'library {n}')
        for n, slot in ((1, '1'), (2, '2'), (3, '3'))
    }
    hits = protocol.load_labware('nest_96_wellplate_200ul_flat', '6', 'hits')
    tiprack = protocol.load_labware('opentrons_96_tiprack_20ul', '9')
    p20 = protocol.load_instrument('p20_single_gen2', 'left', tip_racks=[tiprack])

    picks = list(csv.DictReader(WORKLIST.splitlines()))

    p20.pick_up_tip()
    for pick in picks:
        source = library[pick['source_plate']][pick['source_well']]
        target = hits[pick['dest_well']]
        volume = float(pick['ul'])
        p20.aspirate(volume, source)
        p20.touch_tip(source, v_offset=-2)
        p20.dispense(volume, target)
        p20.blow_out(target.top())
    p20.drop_tip()
