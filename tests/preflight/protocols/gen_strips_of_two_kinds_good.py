# expect: generic pass
metadata = {"protocolName": "Incubation mix to a strip", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    inc_mix = protocol.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 2)[
        "A1"
    ]
    strips = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "sample and dilution strips")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 4, "incubation plate")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    inc_strip = strips.columns()[0]
    sample_strip = strips.columns()[3]

    p300.pick_up_tip()
    p300.aspirate(20, inc_mix)
    for well in inc_strip:
        p300.aspirate(50, inc_mix)
        p300.dispense(50, well)
    p300.dispense(20, inc_mix)
    p300.drop_tip()
    for stock, sample, well in zip(inc_strip, sample_strip, plate.columns()[0]):
        p300.transfer(30, stock, well)
        p300.transfer(30, sample, well)
