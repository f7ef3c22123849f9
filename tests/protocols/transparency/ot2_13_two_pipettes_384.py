"""Two pipettes take turns; pipettes serve as dictionary keys and in sets."""
metadata = {'apiLevel': '2.13'}


def run(protocol):
    t20 = protocol.load_labware('opentrons_96_tiprack_20ul', 7)
    t300 = protocol.load_labware('opentrons_96_tiprack_300ul', 8)
    plate = protocol.load_labware('corning_384_wellplate_112ul_flat', 1)
    stock = protocol.load_labware('corning_12_wellplate_6.9ml_flat', 2)
    p20 = protocol.load_instrument('p20_single_gen2', 'left', tip_racks=[t20])
    m300 = protocol.load_instrument('p300_multi_gen2', 'right', tip_racks=[t300])
    trough = protocol.load_labware('nest_12_reservoir_15ml', 3)

    done = {p20: 0, m300: 0}
    assert p20 in done and {p20, m300} == set(done) and p20 != m300
    both = list(done)
    for pipette in both:
        pipette.pick_up_tip()
    for column in range(0, 8, 2):
        m300.aspirate(60, trough['A1'])
        p20.aspirate(9, stock['A1'])
        m300.dispense(30, plate.columns()[column][0])
        p20.dispense(4, plate['P24'])
        m300.dispense(30, plate.columns()[column][1])
        p20.dispense(5, plate.wells_by_name()['O24'].top(1))
        done[p20] += 1
        done[m300] += 2
        if column == 4:
            m300.blow_out(trough['A1'])
    while both:
        both.pop().drop_tip()
    protocol.comment('%d and %d' % (done[p20], done[m300]))
    assert hash(p20) == hash(protocol.loaded_instruments['left'])
