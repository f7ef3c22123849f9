"""Several plates one after the other; the plate stays where it is."""

metadata = {"apiLevel": "2.13", "protocolName": "PCR prep"}


def run(ctx):
    tips20 = [ctx.load_labware("opentrons_96_filtertiprack_20ul", 4)]
    m300 = ctx.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[ctx.load_labware("opentrons_96_filtertiprack_200ul", 2)],
    )
    m20 = ctx.load_instrument("p20_multi_gen2", "right", tip_racks=tips20)
    master_mix = ctx.load_labware("nest_12_reservoir_15ml", 1)["A1"]
    pcr_plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 5)
    samples = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "sample plate").rows()[0]
    for number in range(2):
        m300.pick_up_tip()
        for destination in pcr_plate.rows()[0][:4]:
            m300.aspirate(23, master_mix)
            m300.dispense(23, destination.bottom(2))
        m300.drop_tip()
        for source, destination in zip(samples[:4], pcr_plate.rows()[0]):
            m20.pick_up_tip()
            m20.aspirate(2, source)
            m20.dispense(2, destination)
            m20.mix(3, 10, destination)
            m20.drop_tip()
        m20.reset_tipracks()
        if number == 0:
            ctx.pause("Replace 20ul tiprack. Refill mastermix.")
