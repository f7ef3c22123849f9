metadata = {"protocolName": "Reagent aliquoting", "apiLevel": "2.13"}


def run(protocol):
    p = protocol.load_instrument(
        "p300_single_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 4)],
    )
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 1)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2)
    p.distribute(110, tubes["A1"], plate.columns()[0])
    p.transfer(110, tubes["A2"], plate.columns()[0], new_tip="always")
