requirements = {"robotType": "Flex", "apiLevel": "2.24"}
metadata = {"protocolName": "Add water to samples"}


def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "C3")
    trash = protocol.load_trash_bin("A3")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", "D1")
    sample_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "D2", "sample plate")
    water = protocol.define_liquid("water")
    serum = protocol.define_liquid("sample", "serum")
    reservoir.load_liquid(["A1"], 10_000, water)
    sample_plate.load_liquid(["A1", "B1", "C1"], 50, serum)
    pipette = protocol.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])

    pipette.transfer_with_liquid_class(
        liquid_class=protocol.get_liquid_class("water"),
        volume=60,
        source=[reservoir["A1"]] * 3,
        dest=sample_plate.columns()[0][:3],
        new_tip="once",
        trash_location=trash,
    )
