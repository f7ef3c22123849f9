# expect: generic pass
"""Three plates, each with a reservoir of its own, all laid out alike; one set of tips."""

metadata = {"apiLevel": "2.13", "protocolName": "Reagent addition"}


def run(protocol):
    m300 = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_filtertiprack_200ul", 7)],
    )
    plates = [protocol.load_labware("nest_96_wellplate_200ul_flat", slot) for slot in (4, 5, 6)]
    reservoirs = [protocol.load_labware("nest_12_reservoir_15ml", slot) for slot in (1, 2, 3)]
    wash_buffers = [reservoir.wells()[:6] for reservoir in reservoirs]
    dest_wells = [plate.rows()[0] for plate in plates]

    def wash(number):
        m300.pick_up_tip()
        for wells, buffers in zip(dest_wells, wash_buffers):
            src = buffers[number]
            for well in wells:
                m300.aspirate(50, src)
                m300.dispense(50, well.top(-2))
                m300.blow_out()
        m300.drop_tip()

    for number in range(2):
        wash(number)
    m300.pick_up_tip()
    for wells, reservoir in zip(dest_wells, reservoirs):
        antibody = reservoir["A8"]
        for well in wells:
            m300.mix(3, 100, antibody)
            m300.aspirate(25, antibody)
            m300.dispense(25, well.top(-2))
            m300.blow_out()
    m300.drop_tip()
