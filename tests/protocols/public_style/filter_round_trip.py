"""Every sample is drawn, spun through its filter by hand, and put back where it came from."""
metadata = {'apiLevel': '2.13', 'protocolName': 'Filter and return', 'author': 'proteomics'}


def run(protocol):
    tips = [protocol.load_labware('opentrons_96_filtertiprack_200ul', s) for s in ('7', '8')]
    a = protocol.load_labware('opentrons_24_tuberack_nest_2ml_snapcap', '1')
    b = protocol.load_labware('nest_96_wellplate_2ml_deep', '2')
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=tips)

    pairs = list(zip(a.wells(), b.wells()))
    for here, there in pairs:
        p300.pick_up_tip()
        p300.mix(3, 150, here)
        for _ in range(2):
            p300.aspirate(190, here)
            p300.dispense(190, there)
        p300.mix(2, 150, there)
        for _ in range(2):
            p300.aspirate(180, there)
            p300.dispense(180, here)
        p300.blow_out(here.top(-5))
        p300.drop_tip()
