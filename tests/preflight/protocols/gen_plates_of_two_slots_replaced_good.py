metadata = {"protocolName": "Reagent plates, two rounds", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    buffer = protocol.load_labware("nest_1_reservoir_195ml", 3)["A1"]
    plates = [protocol.load_labware("nest_96_wellplate_200ul_flat", slot) for slot in (1, 4)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])

    for finished in range(2):
        m300.pick_up_tip()
        for plate in plates:
            for column in plate.rows()[0]:
                m300.aspirate(150, buffer)
                m300.dispense(150, column.top())
        m300.drop_tip()
        if not finished:
            protocol.pause("Replace the plates on slots 1 & 4 with new ones.")
