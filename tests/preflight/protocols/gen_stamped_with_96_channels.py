requirements = {"robotType": "Flex", "apiLevel": "2.19"}
metadata = {"protocolName": "Replicate a library plate"}


def run(protocol):
    adapter = protocol.load_adapter("opentrons_flex_96_tiprack_adapter", "B1")
    tips = adapter.load_labware("opentrons_flex_96_tiprack_200ul")
    mother_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", "C1", "mother plate")
    other_mother_plate = protocol.load_labware("nest_96_wellplate_2ml_deep", "C2", "mother plate 2")
    daughters = [
        protocol.load_labware("nest_96_wellplate_200ul_flat", slot, f"daughter plate {n}")
        for n, slot in enumerate(("D1", "D2"), 1)
    ]
    protocol.load_waste_chute()
    head = protocol.load_instrument("flex_96channel_1000", "left", tip_racks=[tips])

    head.pick_up_tip(tips)
    for mother, daughter in zip((mother_plate, other_mother_plate), daughters):
        head.aspirate(150, mother["A1"])
        head.dispense(150, daughter["A1"])
    head.drop_tip()
