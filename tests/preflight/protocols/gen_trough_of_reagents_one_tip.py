# expect: generic fail GEN-1
metadata = {"protocolName": "Antibody panel onto samples", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    samples = protocol.load_labware("nest_96_wellplate_2ml_deep", 2, "samples")
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    sources = trough.wells()[:3]

    m300.pick_up_tip()
    for number, source in enumerate(sources):
        for column in samples.rows()[0][4 * number : 4 * number + 4]:
            m300.aspirate(50, source)
            m300.dispense(50, column.top())
    m300.drop_tip()
