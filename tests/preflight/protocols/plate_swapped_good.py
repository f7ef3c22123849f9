# expect: generic pass
metadata = {"protocolName": "Fill many plates", "apiLevel": "2.13"}


def run(protocol):
    m = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 4)],
    )
    buffer = protocol.load_labware("nest_1_reservoir_195ml", 1)["A1"]
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2)
    m.pick_up_tip()
    for n in range(3):
        for col in plate.rows()[0]:
            m.transfer(150, buffer, col, new_tip="never")
        protocol.pause("Replace the plate in slot 2 with an empty one")
    m.drop_tip()
